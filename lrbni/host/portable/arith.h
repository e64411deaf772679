/* Arithmetic of floats and doubles in plain C.
 *
 * The loops have no branch, so compilers make vector instructions of them. A NaN among the results is rare: only then does
 * each lane go through the rule of numeric.h, in a function of its own that keeps the loops short.
 */
#ifndef LRBNI_HOST_PORTABLE_ARITH_H
#define LRBNI_HOST_PORTABLE_ARITH_H

#include "lrbni/host/portable/lanes64.h"

/* LANES_NAN_RULES(ps, f32x16, 16, lrb_nan_rule2, lrb_nan_rule3) */
#define LANES_NAN_RULES(suffix, type, count, rule2, rule3)                                                           \
    static inline int lanes_any_nan_##suffix(lrb_##type a)                                                           \
    {                                                                                                                \
        uint32_t any = 0;                                                                                            \
        for (int i = 0; i < count; i++)                                                                              \
            any |= a.f[i] != a.f[i];                                                                                 \
        return any != 0;                                                                                             \
    }                                                                                                                \
    static __attribute__((cold, noinline, unused)) void lanes_nan_rule2_##suffix(lrb_##type *r, const lrb_##type *a, \
                                                                                 const lrb_##type *b)                \
    {                                                                                                                \
        for (int i = 0; i < count; i++)                                                                              \
            r->f[i] = rule2(r->f[i], a->f[i], b->f[i]);                                                              \
    }                                                                                                                \
    static __attribute__((cold, noinline, unused)) void lanes_nan_rule3_##suffix(lrb_##type *r, const lrb_##type *a, \
                                                                                 const lrb_##type *b, const lrb_##type *c) \
    {                                                                                                                \
        for (int i = 0; i < count; i++)                                                                              \
            r->f[i] = rule3(r->f[i], a->f[i], b->f[i], c->f[i]);                                                     \
    }
LANES_NAN_RULES(ps, f32x16, 16, lrb_nan_rule2, lrb_nan_rule3)
LANES_NAN_RULES(pd, f64x8, 8, lrb_nan_rule2_double, lrb_nan_rule3_double)
#undef LANES_NAN_RULES

/* LANES_F2(add, ps, f32x16, 16, a.f[i] + b.f[i], lanes_nan_rule2_ps): every lane; NaN by the rule */
#define LANES_F2(name, suffix, type, count, expression)                                    \
    static inline lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)           \
    {                                                                                      \
        lrb_##type r;                                                                      \
        for (int i = 0; i < count; i++)                                                    \
            r.f[i] = expression;                                                           \
        if (lanes_any_nan_##suffix(r))                                                     \
            lanes_nan_rule2_##suffix(&r, &a, &b);                                          \
        return r;                                                                          \
    }
/* LANES_F3(fmadd, ps, f32x16, 16, fmaf(a.f[i], b.f[i], c.f[i])): the same for three sources */
#define LANES_F3(name, suffix, type, count, expression)                                    \
    static inline lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b, lrb_##type c) \
    {                                                                                      \
        lrb_##type r;                                                                      \
        for (int i = 0; i < count; i++)                                                    \
            r.f[i] = expression;                                                           \
        if (lanes_any_nan_##suffix(r))                                                     \
            lanes_nan_rule3_##suffix(&r, &a, &b, &c);                                      \
        return r;                                                                          \
    }
/* LANES_CHOICE(min, ps, f32x16, 16, a.f[i] < b.f[i] ? a.f[i] : b.f[i]): one of the sources as it is */
#define LANES_CHOICE(name, suffix, type, count, expression)                                \
    static inline lrb_##type lanes_##name##_##suffix(lrb_##type a, lrb_##type b)           \
    {                                                                                      \
        lrb_##type r;                                                                      \
        for (int i = 0; i < count; i++)                                                    \
            r.f[i] = expression;                                                           \
        return r;                                                                          \
    }
/* LANES_CMP(cmplt, ps, f32x16, 16, a.f[i] < b.f[i]): bit i of the result */
#define LANES_CMP(name, suffix, type, count, condition)                                    \
    static inline uint32_t lanes_##name##_##suffix(lrb_##type a, lrb_##type b)             \
    {                                                                                      \
        uint32_t k = 0;                                                                    \
        for (int i = 0; i < count; i++)                                                    \
            k |= (condition) ? lanes_bit[i] : 0;                                           \
        return k;                                                                          \
    }

/* LANES_ARITH(ps, f32x16, 16, fmaf, lrb_quiet_float): all of it, for floats or for doubles. min and max return the second
 * source if either is a NaN or both are zero (ICC16, non-g variants); gmin and gmax return the one that is no NaN, and of two
 * NaNs the first, made quiet (ICC16). */
#define LANES_ARITH(suffix, type, count, fma, quiet)                                       \
    LANES_F2(add, suffix, type, count, a.f[i] + b.f[i])                                    \
    LANES_F2(addn, suffix, type, count, -a.f[i] - b.f[i])                                  \
    LANES_F2(sub, suffix, type, count, a.f[i] - b.f[i])                                    \
    LANES_F2(mul, suffix, type, count, a.f[i] * b.f[i])                                    \
    LANES_F3(fmadd, suffix, type, count, fma(a.f[i], b.f[i], c.f[i]))                      \
    LANES_F3(fmsub, suffix, type, count, fma(a.f[i], b.f[i], -c.f[i]))                     \
    LANES_F3(fnmadd, suffix, type, count, fma(-a.f[i], b.f[i], c.f[i]))                    \
    LANES_F3(fnmsub, suffix, type, count, fma(-a.f[i], b.f[i], -c.f[i]))                   \
    LANES_CHOICE(min, suffix, type, count, a.f[i] < b.f[i] ? a.f[i] : b.f[i])              \
    LANES_CHOICE(max, suffix, type, count, a.f[i] > b.f[i] ? a.f[i] : b.f[i])              \
    LANES_CHOICE(gmin, suffix, type, count, quiet(a.f[i] < b.f[i] || b.f[i] != b.f[i] ? a.f[i] : b.f[i]))  \
    LANES_CHOICE(gmax, suffix, type, count, quiet(a.f[i] >= b.f[i] || b.f[i] != b.f[i] ? a.f[i] : b.f[i])) \
    LANES_CMP(cmpeq, suffix, type, count, a.f[i] == b.f[i])                                \
    LANES_CMP(cmplt, suffix, type, count, a.f[i] < b.f[i])                                 \
    LANES_CMP(cmple, suffix, type, count, a.f[i] <= b.f[i])                                \
    LANES_CMP(cmpunord, suffix, type, count, a.f[i] != a.f[i] || b.f[i] != b.f[i])         \
    LANES_CMP(cmpneq, suffix, type, count, !(a.f[i] == b.f[i]))                            \
    LANES_CMP(cmpnlt, suffix, type, count, !(a.f[i] < b.f[i]))                             \
    LANES_CMP(cmpnle, suffix, type, count, !(a.f[i] <= b.f[i]))                            \
    LANES_CMP(cmpord, suffix, type, count, a.f[i] == a.f[i] && b.f[i] == b.f[i])
LANES_ARITH(ps, f32x16, 16, fmaf, lrb_quiet_float)
LANES_ARITH(pd, f64x8, 8, fma, lrb_quiet_double)
#undef LANES_F2
#undef LANES_F3
#undef LANES_CHOICE
#undef LANES_CMP
#undef LANES_ARITH

/* Sign bits of the lanes, and lanes without them. */
static inline uint32_t lanes_signs_ps(lrb_f32x16 a)
{
    lrb_i32x16 bits = lanes_bits_ps(a);
    uint32_t k = 0;
    for (int i = 0; i < 16; i++)
        k |= bits.i[i] < 0 ? lanes_bit[i] : 0;
    return k;
}

static inline lrb_f32x16 lanes_abs_ps(lrb_f32x16 a)
{
    lrb_i32x16 bits = lanes_bits_ps(a);
    for (int i = 0; i < 16; i++)
        bits.i[i] &= INT32_MAX;
    return lanes_bits_pi(bits);
}

#include "lrbni/host/common/arith.h"

#endif
