/* Halves by F16C, which every CPU with AVX2 has: the same bits as lrb_up_ps_float16 and lrb_down_ps_float16, NaNs too. */
#ifndef LRBNI_HOST_AVX2_HALF_H
#define LRBNI_HOST_AVX2_HALF_H

#include "lrbni/host/avx2/lanes64.h"

#define LANES_HALF

LANES_INLINE lrb_f32x16 lanes_up_half(const void *m)
{
    const __m128i *half = (const __m128i *)m;
    return (lrb_f32x16){_mm256_cvtph_ps(_mm_loadu_si128(half)), _mm256_cvtph_ps(_mm_loadu_si128(half + 1))};
}

LANES_INLINE void lanes_down_half(void *m, lrb_f32x16 a)
{
    __m128i *half = (__m128i *)m;
    _mm_storeu_si128(half, _mm256_cvtps_ph(a.lo, _MM_FROUND_TO_NEAREST_INT));
    _mm_storeu_si128(half + 1, _mm256_cvtps_ph(a.hi, _MM_FROUND_TO_NEAREST_INT));
}

#endif
