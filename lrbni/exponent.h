/* Rounding to fixed point, exponents, mantissas, scaling and fix-up, one lane of each.
 *
 * A float is worked on as the double that it is equal to: every result of these is a float again, but for scale, which
 * rounds once. Zero, infinity and negative sources of getexp and getmant are not published: the rules of AVX-512 are assumed.
 */
#ifndef LRBNI_EXPONENT_H
#define LRBNI_EXPONENT_H

#include "lrbni/rounding.h"

/** Interval of getmant's magnitude; where it has two octaves or none whole, the exponent's parity or the mantissa decides. */
typedef enum lrb_mantissa {
    LRB_MANTISSA_1_2,  /* [1, 2) */
    LRB_MANTISSA_P5_2, /* [1/2, 2): below 1 if the exponent is odd */
    LRB_MANTISSA_P5_1, /* [1/2, 1) */
    LRB_MANTISSA_P75_1P5 /* [3/4, 3/2) */
} lrb_mantissa;

/** Sign of getmant's result. */
typedef enum lrb_mantissa_sign {
    LRB_SIGN_SOURCE,
    LRB_SIGN_PLUS,
    LRB_SIGN_NAN /* the source's, and NaN for what is below 0 */
} lrb_mantissa_sign;

/** floor(log2(abs x)) of a finite double that is not 0. */
static inline int lrb_exponent_of(double x)
{
    int tiny = fabs(x) < 0x1p-1022;
    uint64_t bits = lrb_double_bits(tiny ? x * 0x1p54 : x);
    return (int)(bits >> 52 & 0x7ff) - 1023 - (tiny ? 54 : 0);
}

/** b rounded to a multiple of 2^-n. */
static inline double lrb_f64_round(double x, lrb_rounding mode, lrb_adjust n)
{
    if (x != x)
        return lrb_quiet_double(x);
    return fabs(x) >= 0x1p52 ? x : lrb_whole(x * lrb_power_of_two((int)n), mode) * lrb_power_of_two(-(int)n);
}

static inline float lrb_f32_round(float x, lrb_rounding mode, lrb_adjust n)
{
    return lrb_float_of_double(lrb_f64_round(lrb_double_of_float(x), mode, n), LRB_RN);
}

static inline double lrb_f64_getexp(double x)
{
    if (x != x)
        return lrb_quiet_double(x);
    return x == 0 ? -HUGE_VAL : isinf(x) ? HUGE_VAL : (double)lrb_exponent_of(x);
}

static inline float lrb_f32_getexp(float x)
{
    return lrb_float_of_double(lrb_f64_getexp(lrb_double_of_float(x)), LRB_RN);
}

static inline double lrb_f64_getmant(double x, lrb_mantissa interval, lrb_mantissa_sign sign)
{
    if (x != x)
        return lrb_quiet_double(x);
    if (sign == LRB_SIGN_NAN && x < 0)
        return lrb_bits_double(LRB_NAN_DEFAULT64);
    double m = 1.0;
    if (x != 0 && !isinf(x)) {
        int e = lrb_exponent_of(x);
        double tiny = fabs(x) < 0x1p-1022 ? 0x1p54 : 1.0;
        m = lrb_bits_double((lrb_double_bits(x * tiny) & UINT64_C(0x000fffffffffffff)) | UINT64_C(0x3ff0000000000000));
        if (interval == LRB_MANTISSA_P5_1 || (interval == LRB_MANTISSA_P5_2 && e & 1) ||
            (interval == LRB_MANTISSA_P75_1P5 && m >= 1.5))
            m *= 0.5;
    }
    return sign == LRB_SIGN_PLUS ? m : copysign(m, x);
}

static inline float lrb_f32_getmant(float x, lrb_mantissa interval, lrb_mantissa_sign sign)
{
    return lrb_float_of_double(lrb_f64_getmant(lrb_double_of_float(x), interval, sign), LRB_RN);
}

/** a * 2^b, rounded once; the product is exact as a double with b within +-400, beyond which the result is 0 or infinite. */
static inline float lrb_f32_scale(float a, int32_t b)
{
    int n = b > 400 ? 400 : b < -400 ? -400 : b;
    return lrb_float_of_double(lrb_double_of_float(a) * lrb_power_of_two(n), LRB_RN);
}

/** Place of x in a fix-up table: three bits for each of -inf, negative, -0, +0, positive, +inf, NaN, lowest first. */
static inline unsigned lrb_fixup_place(double x)
{
    unsigned kind = x != x ? 6 : x == 0 ? 2 : isinf(x) ? 0 : 1;
    return 3 * (kind == 6 || signbit(x) ? kind : 5 - kind);
}

/* What the three bits ask for: 0 keeps the old destination, the others stand here. */
static const uint32_t lrb_fixup_f32[8] = {0,          0xff800000, 0x80000000, 0x00000000,
                                          0x7f800000, 0xffc00000, 0x7f7fffff, 0xff7fffff};
static const uint64_t lrb_fixup_f64[8] = {0,
                                          UINT64_C(0xfff0000000000000),
                                          UINT64_C(0x8000000000000000),
                                          0,
                                          UINT64_C(0x7ff0000000000000),
                                          UINT64_C(0xfff8000000000000),
                                          UINT64_C(0x7fefffffffffffff),
                                          UINT64_C(0xffefffffffffffff)};

/** The old destination `d` fixed up by the table for what `x` is. */
static inline float lrb_f32_fixup(float d, float x, uint32_t table)
{
    unsigned action = table >> lrb_fixup_place((double)x) & 7;
    return action ? lrb_bits_float(lrb_fixup_f32[action]) : d;
}

/** The same, but a NaN in x is the result, made quiet. */
static inline float lrb_f32_fixupnan(float d, float x, uint32_t table)
{
    return x != x ? lrb_quiet_float(x) : lrb_f32_fixup(d, x, table);
}

static inline double lrb_f64_fixupnan(double d, double x, uint64_t table)
{
    if (x != x)
        return lrb_quiet_double(x);
    unsigned action = (unsigned)table >> lrb_fixup_place(x) & 7;
    return action ? lrb_bits_double(lrb_fixup_f64[action]) : d;
}

#endif
