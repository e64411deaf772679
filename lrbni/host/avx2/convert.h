/* Conversions, exponents and transcendentals: those for which AVX2 has instructions; the others are the shared loops. */
#ifndef LRBNI_HOST_AVX2_CONVERT_H
#define LRBNI_HOST_AVX2_CONVERT_H

#include "lrbni/host/avx2/arith.h"

#include "lrbni/host/common/each_lane.h"

#define lanes_cvtps2pu lanes_each_cvtps2pu
#define lanes_cvtpu2ps lanes_each_cvtpu2ps
#define lanes_cvtpd2pu lanes_each_cvtpd2pu
#define lanes_getexp_ps lanes_each_getexp_ps
#define lanes_getexp_pd lanes_each_getexp_pd
#define lanes_getmant_ps lanes_each_getmant_ps
#define lanes_getmant_pd lanes_each_getmant_pd
#define lanes_scale_ps lanes_each_scale_ps

LANES_INLINE __m256 lanes_power_ps(int n) { return _mm256_set1_ps((float)lrb_power_of_two(n)); }
LANES_INLINE __m256d lanes_power_pd(int n) { return _mm256_set1_pd(lrb_power_of_two(n)); }

/* Rounded to whole numbers; the instructions need the mode as a constant. */
LANES_INLINE __m256 lanes_whole_ps(__m256 x, lrb_rounding mode)
{
    switch (mode) {
    case LRB_RD: return _mm256_round_ps(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    case LRB_RU: return _mm256_round_ps(x, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
    case LRB_RZ: return _mm256_round_ps(x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    default: return _mm256_round_ps(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    }
}

LANES_INLINE __m256d lanes_whole_pd(__m256d x, lrb_rounding mode)
{
    switch (mode) {
    case LRB_RD: return _mm256_round_pd(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    case LRB_RU: return _mm256_round_pd(x, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
    case LRB_RZ: return _mm256_round_pd(x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    default: return _mm256_round_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    }
}

/* The instruction gives 0x80000000 for all that does not fit; all ones turn that into the largest integer. */
LANES_INLINE __m256i lanes_half_ps2pi(__m256 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m256 x = lanes_whole_ps(_mm256_mul_ps(a, lanes_power_ps((int)adjust)), mode);
    __m256i above = _mm256_castps_si256(_mm256_cmp_ps(x, lanes_power_ps(31), _CMP_GE_OQ));
    __m256i ordered = _mm256_castps_si256(_mm256_cmp_ps(x, x, _CMP_ORD_Q));
    return _mm256_and_si256(_mm256_xor_si256(_mm256_cvttps_epi32(x), above), ordered);
}

LANES_INLINE lrb_i32x16 lanes_cvtps2pi(lrb_f32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    return (lrb_i32x16){lanes_half_ps2pi(a.lo, mode, adjust), lanes_half_ps2pi(a.hi, mode, adjust)};
}

LANES_INLINE lrb_f32x16 lanes_cvtpi2ps(lrb_i32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    if (mode != LRB_RN)
        return lanes_each_cvtpi2ps(a, mode, adjust);
    const __m256 scale = lanes_power_ps(-(int)adjust);
    return (lrb_f32x16){_mm256_mul_ps(_mm256_cvtepi32_ps(a.lo), scale), _mm256_mul_ps(_mm256_cvtepi32_ps(a.hi), scale)};
}

LANES_INLINE __m256 lanes_join_ps(__m128 lo, __m128 hi)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(lo), hi, 1);
}

LANES_INLINE lrb_f32x16 lanes_cvtpd2ps(lrb_f64x8 a, lrb_rounding mode)
{
    if (mode != LRB_RN)
        return lanes_each_cvtpd2ps(a, mode);
    return (lrb_f32x16){lanes_join_ps(_mm256_cvtpd_ps(a.lo), _mm256_cvtpd_ps(a.hi)), _mm256_setzero_ps()};
}

/* The second source of vminpd is the result for a NaN, which the last step clears. */
LANES_INLINE __m128i lanes_half_pd2pi(__m256d a, lrb_rounding mode)
{
    __m256d ordered = _mm256_cmp_pd(a, a, _CMP_ORD_Q);
    __m256d x = _mm256_min_pd(lanes_whole_pd(a, mode), _mm256_set1_pd(INT32_MAX));
    return _mm256_cvttpd_epi32(_mm256_and_pd(x, ordered));
}

LANES_INLINE lrb_i32x16 lanes_cvtpd2pi(lrb_f64x8 a, lrb_rounding mode)
{
    __m128i lo = lanes_half_pd2pi(a.lo, mode), hi = lanes_half_pd2pi(a.hi, mode);
    return (lrb_i32x16){_mm256_inserti128_si256(_mm256_castsi128_si256(lo), hi, 1), _mm256_setzero_si256()};
}

LANES_INLINE lrb_f64x8 lanes_cvtps2pd(lrb_f32x16 a)
{
    return (lrb_f64x8){_mm256_cvtps_pd(_mm256_castps256_ps128(a.lo)), _mm256_cvtps_pd(_mm256_extractf128_ps(a.lo, 1))};
}

LANES_INLINE lrb_f64x8 lanes_cvtpi2pd(lrb_i32x16 a)
{
    return (lrb_f64x8){_mm256_cvtepi32_pd(_mm256_castsi256_si128(a.lo)), _mm256_cvtepi32_pd(_mm256_extracti128_si256(a.lo, 1))};
}

/* As signed numbers less 2^31, which is added again, exactly. */
LANES_INLINE lrb_f64x8 lanes_cvtpu2pd(lrb_i32x16 a)
{
    const __m256i top = _mm256_set1_epi32(INT32_MIN);
    lrb_f64x8 x = lanes_cvtpi2pd((lrb_i32x16){_mm256_xor_si256(a.lo, top), top});
    return (lrb_f64x8){_mm256_add_pd(x.lo, lanes_power_pd(31)), _mm256_add_pd(x.hi, lanes_power_pd(31))};
}

/* Scaled, rounded, scaled back; what is too large to have a fraction stays, and a NaN goes through the products. */
LANES_INLINE __m256 lanes_half_round_ps(__m256 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m256 size = _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
    __m256 r = lanes_whole_ps(_mm256_mul_ps(a, lanes_power_ps((int)adjust)), mode);
    r = _mm256_mul_ps(r, lanes_power_ps(-(int)adjust));
    return _mm256_blendv_ps(r, a, _mm256_cmp_ps(size, lanes_power_ps(23), _CMP_GE_OQ));
}

LANES_INLINE lrb_f32x16 lanes_round_ps(lrb_f32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    return (lrb_f32x16){lanes_half_round_ps(a.lo, mode, adjust), lanes_half_round_ps(a.hi, mode, adjust)};
}

LANES_INLINE __m256d lanes_half_round_pd(__m256d a, lrb_rounding mode, lrb_adjust adjust)
{
    __m256d size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
    __m256d r = lanes_whole_pd(_mm256_mul_pd(a, lanes_power_pd((int)adjust)), mode);
    r = _mm256_mul_pd(r, lanes_power_pd(-(int)adjust));
    return _mm256_blendv_pd(r, a, _mm256_cmp_pd(size, lanes_power_pd(52), _CMP_GE_OQ));
}

LANES_INLINE lrb_f64x8 lanes_round_pd(lrb_f64x8 a, lrb_rounding mode, lrb_adjust adjust)
{
    return (lrb_f64x8){lanes_half_round_pd(a.lo, mode, adjust), lanes_half_round_pd(a.hi, mode, adjust)};
}

LANES_INLINE lrb_f32x16 lanes_rcp23_ps(lrb_f32x16 a)
{
    const __m256 one = _mm256_set1_ps(1.0f);
    return (lrb_f32x16){_mm256_div_ps(one, a.lo), _mm256_div_ps(one, a.hi)};
}

LANES_INLINE __m128 lanes_rsqrt_quarter(__m128 x)
{
    return _mm256_cvtpd_ps(_mm256_div_pd(_mm256_set1_pd(1.0), _mm256_sqrt_pd(_mm256_cvtps_pd(x))));
}

LANES_INLINE __m256 lanes_rsqrt_half(__m256 x)
{
    return lanes_join_ps(lanes_rsqrt_quarter(_mm256_castps256_ps128(x)), lanes_rsqrt_quarter(_mm256_extractf128_ps(x, 1)));
}

LANES_INLINE lrb_f32x16 lanes_rsqrt23_ps(lrb_f32x16 a)
{
    return (lrb_f32x16){lanes_rsqrt_half(a.lo), lanes_rsqrt_half(a.hi)};
}

#endif
