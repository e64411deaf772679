/* Halves by AVX-512F: the same bits as lrb_up_ps_float16 and lrb_down_ps_float16, NaNs too. */
#ifndef LRBNI_HOST_AVX512_HALF_H
#define LRBNI_HOST_AVX512_HALF_H

#include "lrbni/host/avx512/lanes64.h"

#define LANES_HALF

LANES_INLINE lrb_f32x16 lanes_up_half(const void *m)
{
    return (lrb_f32x16){_mm512_cvtph_ps(_mm256_loadu_si256((const __m256i *)m))};
}

LANES_INLINE void lanes_down_half(void *m, lrb_f32x16 a)
{
    _mm256_storeu_si256((__m256i *)m, _mm512_cvtps_ph(a.v, _MM_FROUND_TO_NEAREST_INT));
}

#endif
