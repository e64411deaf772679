/* What the machine's float arithmetic gives, in one place: rounding, NaN, denormals, estimates.
 *
 * - Every operation rounds once, to nearest even; multiply-add is fused (ISAM C.3).
 * - NaN: the first source that is a NaN, in the order of the formula, made quiet; an invalid operation gives 0xffc00000.
 *   Not published for Larrabee: the x86 rule is assumed (golden cases 12, 13).
 * - Denormals are kept: the machine runs with flush-to-zero and denormals-are-zero off.
 *
 * The portable back end calls these functions; the others use instructions that do the same and are tested against it.
 */
#ifndef LRBNI_NUMERIC_H
#define LRBNI_NUMERIC_H

#include <stdint.h>
#include <string.h>

/** Bits of a float, and back. */
static inline uint32_t lrb_float_bits(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float lrb_bits_float(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

#define LRB_NAN_DEFAULT UINT32_C(0xffc00000)
#define LRB_NAN_QUIET UINT32_C(0x00400000)

/** The result `r` of an operation on a, b: r itself unless it is a NaN, whose bits the rule above decides. */
static inline float lrb_nan_rule2(float r, float a, float b)
{
    if (r == r)
        return r;
    if (a != a)
        return lrb_bits_float(lrb_float_bits(a) | LRB_NAN_QUIET);
    if (b != b)
        return lrb_bits_float(lrb_float_bits(b) | LRB_NAN_QUIET);
    return lrb_bits_float(LRB_NAN_DEFAULT);
}

/** The same for an operation on a, b, c. */
static inline float lrb_nan_rule3(float r, float a, float b, float c)
{
    if (r == r)
        return r;
    if (a == a && b == b && c != c)
        return lrb_bits_float(lrb_float_bits(c) | LRB_NAN_QUIET);
    return lrb_nan_rule2(r, a, b);
}

/* Bits that an estimate keeps: sign, exponent and 11 bits of mantissa, 12 significant bits with the hidden one. */
#define LRB_ESTIMATE_BITS UINT32_C(0xfffff000)

/** Estimate of 1/x, as vrcpresps: relative error below 2^-11 where the result is normal. The hardware's table is not published. */
static inline float lrb_f32_rcpres(float x)
{
    return lrb_bits_float(lrb_float_bits(lrb_nan_rule2(1.0f / x, x, x)) & LRB_ESTIMATE_BITS);
}

#endif
