/* Conversions, exponents and transcendentals as AVX-512F has them: the same bits as the shared loops, which tests compare. */
#ifndef LRBNI_HOST_AVX512_CONVERT_H
#define LRBNI_HOST_AVX512_CONVERT_H

#include "lrbni/host/avx512/arith.h"

#include "lrbni/host/common/each_lane.h"

/* LANES_IN_MODE(mode, r = _mm512_cvt_roundps_epi32, x): the intrinsic with the rounding as the constant that it needs */
#define LANES_IN_MODE(mode, call, ...)                                                       \
    switch (mode) {                                                                          \
    case LRB_RD: call(__VA_ARGS__, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); break;        \
    case LRB_RU: call(__VA_ARGS__, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC); break;        \
    case LRB_RZ: call(__VA_ARGS__, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC); break;           \
    default: call(__VA_ARGS__, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC); break;        \
    }

LANES_INLINE __m512 lanes_power_ps(int n) { return _mm512_set1_ps((float)lrb_power_of_two(n)); }

/* The instruction gives 0x80000000 for all that does not fit; scaling by 2^n is exact or gives an infinity, which does not. */
LANES_INLINE lrb_i32x16 lanes_cvtps2pi(lrb_f32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m512 x = _mm512_mul_ps(a.v, lanes_power_ps((int)adjust));
    __m512i r;
    LANES_IN_MODE(mode, r = _mm512_cvt_roundps_epi32, x)
    r = _mm512_mask_mov_epi32(r, _mm512_cmp_ps_mask(x, _mm512_set1_ps(0x1p31f), _CMP_GE_OQ), _mm512_set1_epi32(INT32_MAX));
    return (lrb_i32x16){_mm512_maskz_mov_epi32(_mm512_cmp_ps_mask(x, x, _CMP_ORD_Q), r)};
}

/* The instruction gives all ones for all that does not fit, so what is not above 0 is left out. */
LANES_INLINE lrb_i32x16 lanes_cvtps2pu(lrb_f32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m512 x = _mm512_mul_ps(a.v, lanes_power_ps((int)adjust));
    __mmask16 above = _mm512_cmp_ps_mask(x, _mm512_setzero_ps(), _CMP_GT_OQ);
    __m512i r;
    LANES_IN_MODE(mode, r = _mm512_maskz_cvt_roundps_epu32, above, x)
    return (lrb_i32x16){r};
}

LANES_INLINE lrb_f32x16 lanes_cvtpi2ps(lrb_i32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m512 r;
    LANES_IN_MODE(mode, r = _mm512_cvt_roundepi32_ps, a.v)
    return (lrb_f32x16){_mm512_mul_ps(r, lanes_power_ps(-(int)adjust))};
}

LANES_INLINE lrb_f32x16 lanes_cvtpu2ps(lrb_i32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    __m512 r;
    LANES_IN_MODE(mode, r = _mm512_cvt_roundepu32_ps, a.v)
    return (lrb_f32x16){_mm512_mul_ps(r, lanes_power_ps(-(int)adjust))};
}

LANES_INLINE lrb_f32x16 lanes_cvtpd2ps(lrb_f64x8 a, lrb_rounding mode)
{
    __m256 r;
    LANES_IN_MODE(mode, r = _mm512_cvt_roundpd_ps, a.v)
    return (lrb_f32x16){_mm512_zextps256_ps512(r)};
}

LANES_INLINE lrb_i32x16 lanes_cvtpd2pi(lrb_f64x8 a, lrb_rounding mode)
{
    __mmask8 ordered = _mm512_cmp_pd_mask(a.v, a.v, _CMP_ORD_Q);
    __m512d x = _mm512_min_pd(a.v, _mm512_set1_pd(INT32_MAX));
    __m256i r;
    LANES_IN_MODE(mode, r = _mm512_maskz_cvt_roundpd_epi32, ordered, x)
    return (lrb_i32x16){_mm512_zextsi256_si512(r)};
}

LANES_INLINE lrb_i32x16 lanes_cvtpd2pu(lrb_f64x8 a, lrb_rounding mode)
{
    __mmask8 above = _mm512_cmp_pd_mask(a.v, _mm512_setzero_pd(), _CMP_GT_OQ);
    __m256i r;
    LANES_IN_MODE(mode, r = _mm512_maskz_cvt_roundpd_epu32, above, a.v)
    return (lrb_i32x16){_mm512_zextsi256_si512(r)};
}

LANES_INLINE lrb_f64x8 lanes_cvtps2pd(lrb_f32x16 a) { return (lrb_f64x8){_mm512_cvtps_pd(_mm512_castps512_ps256(a.v))}; }
LANES_INLINE lrb_f64x8 lanes_cvtpi2pd(lrb_i32x16 a) { return (lrb_f64x8){_mm512_cvtepi32_pd(_mm512_castsi512_si256(a.v))}; }
LANES_INLINE lrb_f64x8 lanes_cvtpu2pd(lrb_i32x16 a) { return (lrb_f64x8){_mm512_cvtepu32_pd(_mm512_castsi512_si256(a.v))}; }

/* Scaled, rounded, scaled back; what is too large to have a fraction stays, and a NaN goes through the products. */
LANES_INLINE lrb_f32x16 lanes_round_ps(lrb_f32x16 a, lrb_rounding mode, lrb_adjust adjust)
{
    __mmask16 whole = _mm512_cmp_ps_mask(_mm512_abs_ps(a.v), _mm512_set1_ps(0x1p23f), _CMP_GE_OQ);
    __m512 x = _mm512_mul_ps(a.v, lanes_power_ps((int)adjust)), r;
    LANES_IN_MODE(mode, r = _mm512_roundscale_ps, x)
    return (lrb_f32x16){_mm512_mask_mov_ps(_mm512_mul_ps(r, lanes_power_ps(-(int)adjust)), whole, a.v)};
}

LANES_INLINE lrb_f64x8 lanes_round_pd(lrb_f64x8 a, lrb_rounding mode, lrb_adjust adjust)
{
    __mmask8 whole = _mm512_cmp_pd_mask(_mm512_abs_pd(a.v), _mm512_set1_pd(0x1p52), _CMP_GE_OQ);
    __m512d x = _mm512_mul_pd(a.v, _mm512_set1_pd(lrb_power_of_two((int)adjust))), r;
    LANES_IN_MODE(mode, r = _mm512_roundscale_pd, x)
    r = _mm512_mul_pd(r, _mm512_set1_pd(lrb_power_of_two(-(int)adjust)));
    return (lrb_f64x8){_mm512_mask_mov_pd(r, whole, a.v)};
}

LANES_INLINE lrb_f32x16 lanes_getexp_ps(lrb_f32x16 a) { return (lrb_f32x16){_mm512_getexp_ps(a.v)}; }
LANES_INLINE lrb_f64x8 lanes_getexp_pd(lrb_f64x8 a) { return (lrb_f64x8){_mm512_getexp_pd(a.v)}; }

/* LANES_GETMANT(r, _mm512_getmant_ps, a.v): the intrinsic with interval and sign as constants */
#define LANES_GETMANT_SIGN(r, call, x, interval)                                    \
    r = sign == LRB_SIGN_SOURCE ? call(x, interval, _MM_MANT_SIGN_src)              \
        : sign == LRB_SIGN_PLUS ? call(x, interval, _MM_MANT_SIGN_zero)             \
                                : call(x, interval, _MM_MANT_SIGN_nan)
#define LANES_GETMANT(r, call, x)                                                                    \
    switch (interval) {                                                                              \
    case LRB_MANTISSA_1_2: LANES_GETMANT_SIGN(r, call, x, _MM_MANT_NORM_1_2); break;                 \
    case LRB_MANTISSA_P5_2: LANES_GETMANT_SIGN(r, call, x, _MM_MANT_NORM_p5_2); break;               \
    case LRB_MANTISSA_P5_1: LANES_GETMANT_SIGN(r, call, x, _MM_MANT_NORM_p5_1); break;               \
    default: LANES_GETMANT_SIGN(r, call, x, _MM_MANT_NORM_p75_1p5); break;                           \
    }

LANES_INLINE lrb_f32x16 lanes_getmant_ps(lrb_f32x16 a, lrb_mantissa interval, lrb_mantissa_sign sign)
{
    __m512 r;
    LANES_GETMANT(r, _mm512_getmant_ps, a.v)
    return (lrb_f32x16){r};
}

LANES_INLINE lrb_f64x8 lanes_getmant_pd(lrb_f64x8 a, lrb_mantissa interval, lrb_mantissa_sign sign)
{
    __m512d r;
    LANES_GETMANT(r, _mm512_getmant_pd, a.v)
    return (lrb_f64x8){r};
}

/* The count as a float is rounded if it is large, and then it is as good as infinite. */
LANES_INLINE lrb_f32x16 lanes_scale_ps(lrb_f32x16 a, lrb_i32x16 b)
{
    return (lrb_f32x16){_mm512_scalef_ps(a.v, _mm512_cvtepi32_ps(b.v))};
}

LANES_INLINE lrb_f32x16 lanes_rcp23_ps(lrb_f32x16 a) { return (lrb_f32x16){_mm512_div_ps(_mm512_set1_ps(1.0f), a.v)}; }

LANES_INLINE __m256 lanes_rsqrt_half(__m512d x)
{
    return _mm512_cvtpd_ps(_mm512_div_pd(_mm512_set1_pd(1.0), _mm512_sqrt_pd(x)));
}

LANES_INLINE lrb_f32x16 lanes_rsqrt23_ps(lrb_f32x16 a)
{
    __m256 lo = lanes_rsqrt_half(lanes_cvtps2pd(a).v), hi = lanes_rsqrt_half(lanes_cvtps2pd(lanes_upper_half_ps(a)).v);
    return (lrb_f32x16){_mm512_castpd_ps(_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_castps_pd(lo)), _mm256_castps_pd(hi), 1))};
}

#undef LANES_GETMANT
#undef LANES_GETMANT_SIGN
#undef LANES_IN_MODE

#endif
