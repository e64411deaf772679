/* Arithmetic of floats and doubles with AVX-512F. See host/avx2/arith.h for why it is written as instructions. */
#ifndef LRBNI_HOST_AVX512_ARITH_H
#define LRBNI_HOST_AVX512_ARITH_H

#include "lrbni/host/avx512/lanes64.h"

/* LANES_F2(add, ps, f32x16, "vaddps"): r = a + b, the first source first */
#define LANES_F2(name, suffix, type, instruction)                                                  \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                    \
    {                                                                                              \
        lrb_##type r;                                                                              \
        __asm__(instruction " %2, %1, %0" : "=v"(r.v) : "v"(a.v), "v"(b.v));                       \
        return r;                                                                                  \
    }
/* LANES_F3(fmadd, ps, f32x16, "vfmadd231ps"): c = a * b + c */
#define LANES_F3(name, suffix, type, instruction)                                                  \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b, lrb_##type c)      \
    {                                                                                              \
        __asm__(instruction " %2, %1, %0" : "+v"(c.v) : "v"(a.v), "v"(b.v));                       \
        return c;                                                                                  \
    }
/* LANES_CMP(cmplt, ps, f32x16, _CMP_LT_OS) */
#define LANES_CMP(name, suffix, type, predicate)                                                   \
    LANES_INLINE uint32_t lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                      \
    {                                                                                              \
        return _mm512_cmp_##suffix##_mask(a.v, b.v, predicate);                                    \
    }
/* gmin: a where a < b or b is a NaN, b elsewhere; where both are NaNs, a made quiet. */
#define LANES_CHOICE(name, suffix, type, mask, predicate)                                          \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                    \
    {                                                                                              \
        mask b_nan = _mm512_cmp_##suffix##_mask(b.v, b.v, _CMP_UNORD_Q);                           \
        mask first = _mm512_cmp_##suffix##_mask(a.v, b.v, predicate) | b_nan;                      \
        mask both_nan = _mm512_mask_cmp_##suffix##_mask(b_nan, a.v, a.v, _CMP_UNORD_Q);            \
        return (lrb_##type){lanes_quieted_##suffix(both_nan, _mm512_mask_blend_##suffix(first, b.v, a.v))}; \
    }
/* The quiet bit set in lanes of k. */
LANES_INLINE __m512 lanes_quieted_ps(__mmask16 k, __m512 a)
{
    __m512i bits = _mm512_castps_si512(a);
    return _mm512_castsi512_ps(_mm512_mask_or_epi32(bits, k, bits, _mm512_set1_epi32(0x00400000)));
}

LANES_INLINE __m512d lanes_quieted_pd(__mmask8 k, __m512d a)
{
    __m512i bits = _mm512_castpd_si512(a);
    return _mm512_castsi512_pd(_mm512_mask_or_epi64(bits, k, bits, _mm512_set1_epi64(0x0008000000000000)));
}

/* LANES_ARITH(ps, f32x16, __mmask16): all of it, for floats or for doubles */
#define LANES_ARITH(suffix, type, mask)                   \
    LANES_F2(add, suffix, type, "vadd" #suffix)           \
    LANES_F2(sub, suffix, type, "vsub" #suffix)           \
    LANES_F2(mul, suffix, type, "vmul" #suffix)           \
    LANES_F2(min, suffix, type, "vmin" #suffix)           \
    LANES_F2(max, suffix, type, "vmax" #suffix)           \
    LANES_F3(fmadd, suffix, type, "vfmadd231" #suffix)    \
    LANES_F3(fmsub, suffix, type, "vfmsub231" #suffix)    \
    LANES_F3(fnmadd, suffix, type, "vfnmadd231" #suffix)  \
    LANES_F3(fnmsub, suffix, type, "vfnmsub231" #suffix)  \
    LANES_CHOICE(gmin, suffix, type, mask, _CMP_LT_OS)    \
    LANES_CHOICE(gmax, suffix, type, mask, _CMP_GE_OS)    \
    LANES_CMP(cmpeq, suffix, type, _CMP_EQ_OQ)            \
    LANES_CMP(cmplt, suffix, type, _CMP_LT_OS)            \
    LANES_CMP(cmple, suffix, type, _CMP_LE_OS)            \
    LANES_CMP(cmpunord, suffix, type, _CMP_UNORD_Q)       \
    LANES_CMP(cmpneq, suffix, type, _CMP_NEQ_UQ)          \
    LANES_CMP(cmpnlt, suffix, type, _CMP_NLT_US)          \
    LANES_CMP(cmpnle, suffix, type, _CMP_NLE_US)          \
    LANES_CMP(cmpord, suffix, type, _CMP_ORD_Q)
LANES_ARITH(ps, f32x16, __mmask16)
LANES_ARITH(pd, f64x8, __mmask8)
#undef LANES_F2
#undef LANES_F3
#undef LANES_CMP
#undef LANES_CHOICE
#undef LANES_ARITH

/* (-a) + (-b) as -(a * 1) - b: a NaN keeps its sign. */
LANES_INLINE lrb_f32x16 lanes_addn_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    return lanes_fnmsub_ps(a, (lrb_f32x16){_mm512_set1_ps(1.0f)}, b);
}

LANES_INLINE lrb_f64x8 lanes_addn_pd(lrb_f64x8 a, lrb_f64x8 b)
{
    return lanes_fnmsub_pd(a, (lrb_f64x8){_mm512_set1_pd(1.0)}, b);
}

/* Sign bits of the lanes, and lanes without them. */
LANES_INLINE uint32_t lanes_signs_ps(lrb_f32x16 a)
{
    return _mm512_cmplt_epi32_mask(_mm512_castps_si512(a.v), _mm512_setzero_si512());
}

LANES_INLINE lrb_f32x16 lanes_abs_ps(lrb_f32x16 a)
{
    return (lrb_f32x16){_mm512_castsi512_ps(_mm512_and_si512(_mm512_castps_si512(a.v), _mm512_set1_epi32(INT32_MAX)))};
}

#include "lrbni/host/common/arith.h"

#endif
