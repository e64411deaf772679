/* Arithmetic of floats and doubles with AVX and FMA.
 *
 * add, mul and the multiply-adds are written as instructions, not as intrinsics: compilers may swap the operands of an
 * intrinsic that looks commutative, and with two NaNs the first one must win (numeric.h).
 */
#ifndef LRBNI_HOST_AVX2_ARITH_H
#define LRBNI_HOST_AVX2_ARITH_H

#include "lrbni/host/avx2/lanes64.h"

/* LANES_F2(add, ps, f32x16, "vaddps"): r = a + b, the first source first */
#define LANES_F2(name, suffix, type, instruction)                                                  \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                    \
    {                                                                                              \
        lrb_##type r;                                                                              \
        __asm__(instruction " %2, %1, %0" : "=x"(r.lo) : "x"(a.lo), "x"(b.lo));                    \
        __asm__(instruction " %2, %1, %0" : "=x"(r.hi) : "x"(a.hi), "x"(b.hi));                    \
        return r;                                                                                  \
    }
/* LANES_F3(fmadd, ps, f32x16, "vfmadd231ps"): c = a * b + c */
#define LANES_F3(name, suffix, type, instruction)                                                  \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b, lrb_##type c)      \
    {                                                                                              \
        __asm__(instruction " %2, %1, %0" : "+x"(c.lo) : "x"(a.lo), "x"(b.lo));                    \
        __asm__(instruction " %2, %1, %0" : "+x"(c.hi) : "x"(a.hi), "x"(b.hi));                    \
        return c;                                                                                  \
    }
/* LANES_CMP(cmplt, ps, f32x16, _CMP_LT_OS, 8) */
#define LANES_CMP(name, suffix, type, predicate, half)                                             \
    LANES_INLINE uint32_t lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                      \
    {                                                                                              \
        return (uint32_t)_mm256_movemask_##suffix(_mm256_cmp_##suffix(a.lo, b.lo, predicate)) |    \
               (uint32_t)_mm256_movemask_##suffix(_mm256_cmp_##suffix(a.hi, b.hi, predicate)) << half; \
    }
/* gmin: one half of a where a < b or b is a NaN, of b elsewhere; where both are NaNs, a made quiet. */
#define LANES_CHOICE(name, suffix, vector, predicate)                                              \
    LANES_INLINE vector lanes_half_##name##_##suffix(vector a, vector b, vector quiet)             \
    {                                                                                              \
        vector b_nan = _mm256_cmp_##suffix(b, b, _CMP_UNORD_Q);                                    \
        vector first = _mm256_or_##suffix(_mm256_cmp_##suffix(a, b, predicate), b_nan);            \
        vector both_nan = _mm256_and_##suffix(_mm256_cmp_##suffix(a, a, _CMP_UNORD_Q), b_nan);     \
        return _mm256_or_##suffix(_mm256_blendv_##suffix(b, a, first), _mm256_and_##suffix(both_nan, quiet)); \
    }
#define LANES_G(name, suffix, type)                                                                \
    LANES_INLINE lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)                    \
    {                                                                                              \
        return (lrb_##type){lanes_half_##name##_##suffix(a.lo, b.lo, lanes_quiet_bit_##suffix()),  \
                            lanes_half_##name##_##suffix(a.hi, b.hi, lanes_quiet_bit_##suffix())}; \
    }
LANES_INLINE __m256 lanes_quiet_bit_ps(void) { return _mm256_castsi256_ps(_mm256_set1_epi32(0x00400000)); }
LANES_INLINE __m256d lanes_quiet_bit_pd(void) { return _mm256_castsi256_pd(_mm256_set1_epi64x(0x0008000000000000)); }

/* LANES_ARITH(ps, f32x16, __m256, 8): all of it, for floats or for doubles */
#define LANES_ARITH(suffix, type, vector, half)                 \
    LANES_F2(add, suffix, type, "vadd" #suffix)                 \
    LANES_F2(sub, suffix, type, "vsub" #suffix)                 \
    LANES_F2(mul, suffix, type, "vmul" #suffix)                 \
    LANES_F2(min, suffix, type, "vmin" #suffix)                 \
    LANES_F2(max, suffix, type, "vmax" #suffix)                 \
    LANES_F3(fmadd, suffix, type, "vfmadd231" #suffix)          \
    LANES_F3(fmsub, suffix, type, "vfmsub231" #suffix)          \
    LANES_F3(fnmadd, suffix, type, "vfnmadd231" #suffix)        \
    LANES_F3(fnmsub, suffix, type, "vfnmsub231" #suffix)        \
    LANES_CHOICE(gmin, suffix, vector, _CMP_LT_OS)              \
    LANES_CHOICE(gmax, suffix, vector, _CMP_GE_OS)              \
    LANES_G(gmin, suffix, type)                                 \
    LANES_G(gmax, suffix, type)                                 \
    LANES_CMP(cmpeq, suffix, type, _CMP_EQ_OQ, half)            \
    LANES_CMP(cmplt, suffix, type, _CMP_LT_OS, half)            \
    LANES_CMP(cmple, suffix, type, _CMP_LE_OS, half)            \
    LANES_CMP(cmpunord, suffix, type, _CMP_UNORD_Q, half)       \
    LANES_CMP(cmpneq, suffix, type, _CMP_NEQ_UQ, half)          \
    LANES_CMP(cmpnlt, suffix, type, _CMP_NLT_US, half)          \
    LANES_CMP(cmpnle, suffix, type, _CMP_NLE_US, half)          \
    LANES_CMP(cmpord, suffix, type, _CMP_ORD_Q, half)
LANES_ARITH(ps, f32x16, __m256, 8)
LANES_ARITH(pd, f64x8, __m256d, 4)
#undef LANES_F2
#undef LANES_F3
#undef LANES_CMP
#undef LANES_CHOICE
#undef LANES_G
#undef LANES_ARITH

/* (-a) + (-b) as -(a * 1) - b: a NaN keeps its sign. */
LANES_INLINE lrb_f32x16 lanes_addn_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    const __m256 one = _mm256_set1_ps(1.0f);
    return lanes_fnmsub_ps(a, (lrb_f32x16){one, one}, b);
}

LANES_INLINE lrb_f64x8 lanes_addn_pd(lrb_f64x8 a, lrb_f64x8 b)
{
    const __m256d one = _mm256_set1_pd(1.0);
    return lanes_fnmsub_pd(a, (lrb_f64x8){one, one}, b);
}

/* Sign bits of the lanes, and lanes without them. */
LANES_INLINE uint32_t lanes_signs_ps(lrb_f32x16 a) { return lanes_sign_bits(a.lo, a.hi); }

LANES_INLINE lrb_f32x16 lanes_abs_ps(lrb_f32x16 a)
{
    const __m256 rest = _mm256_castsi256_ps(_mm256_set1_epi32(INT32_MAX));
    return (lrb_f32x16){_mm256_and_ps(a.lo, rest), _mm256_and_ps(a.hi, rest)};
}

#include "lrbni/host/common/arith.h"

#endif
