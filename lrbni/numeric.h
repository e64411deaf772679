/* What the machine's float arithmetic gives, in one place: rounding, NaN, denormals, minima, estimates.
 *
 * - Every operation rounds once, to nearest even; multiply-add is fused (ISAM C.3).
 * - NaN: the first source that is a NaN, in the order of the formula, made quiet; an invalid operation gives 0xffc00000
 *   (0xfff8000000000000 of doubles). Not published for Larrabee: the x86 rule is assumed (golden cases 12, 13).
 * - Denormals are kept: the machine starts with flush-to-zero and denormals-are-zero off.
 *
 * Other states of the machine, lrbni/control.h, are the matter of lrbni/exact.h. The portable back end calls these functions;
 * the others use instructions that do the same and are tested against it.
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

/** The same float, made quiet if it is a NaN. */
static inline float lrb_quiet_float(float x)
{
    return x == x ? x : lrb_bits_float(lrb_float_bits(x) | LRB_NAN_QUIET);
}

static inline double lrb_quiet_double(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits |= x == x ? 0 : UINT64_C(0x0008000000000000);
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline double lrb_default_nan_double(void)
{
    const uint64_t bits = UINT64_C(0xfff8000000000000);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/** The result `r` of an operation on a, b: r itself unless it is a NaN, whose bits the rule above decides. */
static inline float lrb_nan_rule2(float r, float a, float b)
{
    if (r == r)
        return r;
    return a != a ? lrb_quiet_float(a) : b != b ? lrb_quiet_float(b) : lrb_bits_float(LRB_NAN_DEFAULT);
}

static inline double lrb_nan_rule2_double(double r, double a, double b)
{
    if (r == r)
        return r;
    return a != a ? lrb_quiet_double(a) : b != b ? lrb_quiet_double(b) : lrb_default_nan_double();
}

/** The same for an operation on a, b, c. */
static inline float lrb_nan_rule3(float r, float a, float b, float c)
{
    return r != r && a == a && b == b && c != c ? lrb_quiet_float(c) : lrb_nan_rule2(r, a, b);
}

static inline double lrb_nan_rule3_double(double r, double a, double b, double c)
{
    return r != r && a == a && b == b && c != c ? lrb_quiet_double(c) : lrb_nan_rule2_double(r, a, b);
}

/** a clamped to the numbers between 0 and b, on whichever side of 0 that is; beyond 0 lies a zero of b's sign. So clampz(a, b) is
 * -clampz(-a, -b) (MIC.H). A NaN in b gives a zero of a's sign, in both +0 (MIC.H), in a alone a zero of b's sign (assumed). */
static inline uint32_t lrb_clampz(uint32_t a, uint32_t b)
{
    const uint32_t sign = UINT32_C(0x80000000), infinity = UINT32_C(0x7f800000);
    uint32_t size_a = a & ~sign, size_b = b & ~sign;
    if (size_b > infinity)
        return size_a > infinity ? 0 : a & sign;
    if (size_a > infinity || ((a ^ b) & sign))
        return b & sign;
    return size_a < size_b ? a : b;
}

/* Bits that an estimate keeps: sign, exponent and 11 bits of mantissa, 12 significant bits with the hidden one. */
#define LRB_ESTIMATE_BITS UINT32_C(0xfffff000)

/** Estimate of 1/x, as vrcpresps: relative error below 2^-11 where the result is normal. The hardware's table is not published. */
static inline float lrb_f32_rcpres(float x)
{
    return lrb_bits_float(lrb_float_bits(lrb_nan_rule2(1.0f / x, x, x)) & LRB_ESTIMATE_BITS);
}

#endif
