/* The 23-bit functions and the seeds from tables, one lane of each, from integers and from operations that IEEE 754 rounds
 * correctly: the results are the same on every host.
 *
 * exp223, log2, rcp23 and rsqrt23 give the float nearest to the exact result, ties to even, subnormals included. The chip's
 * results are published as error bounds only (0.99 ulp, 2^-23, 0.912 ulp, 0.775 ulp, ISAM), which correct rounding keeps.
 * That the intermediate results below are precise enough to round correctly is a matter of how close exact results come to
 * the middle between two floats; tests/lrbni/test_every_float.c looks at every float there is.
 *
 * - exp223: 2^x of fixed point with 24 fraction bits, as the product of a table entry for each six-bit digit of the
 *   fraction; each entry is off by 2^-64, each of three products by 2^-62: 2^-60 in all.
 * - log2: m in [1, 2) is multiplied by a factor close to 1/m out of 64, and the product by one of 64 closer to 1, both
 *   exactly; the logarithms of the factors are in tables, five terms give that of the rest, below 1.05 * 2^-12. The sixth
 *   term is below 2^-74, the entries, coefficients and products are off by less than 2^-61 together.
 * - rsqrt23: quotient and square root as doubles, each off by half its last place: 2^-52 together, relatively.
 *
 * The seeds are assumed: which bits index each table is reported (MIC.H), the entries are not published.
 */
#ifndef LRBNI_TRANSCENDENTAL_H
#define LRBNI_TRANSCENDENTAL_H

#include "lrbni/rounding.h"
#include "lrbni/transcendental_tables.h"

/** The upper 64 bits of a product. */
static inline uint64_t lrb_product_high(uint64_t a, uint64_t b)
{
    __extension__ typedef unsigned __int128 wide;
    return (uint64_t)((wide)a * b >> 64);
}

/** The float nearest to m * 2^(e - 62), m in [2^62, 2^63) and odd unless exact, e in -128..127. */
static inline float lrb_float_of_fixed(uint64_t m, int e)
{
    int drop = 39 + (e < -126 ? -126 - e : 0); /* 24 bits are kept, or as many as a subnormal has */
    uint64_t kept = m >> drop, rest = m << (64 - drop), half = UINT64_C(1) << 63;
    kept += rest > half || (rest == half && kept & 1);
    return lrb_bits_float((uint32_t)kept + (e < -126 ? 0 : (uint32_t)(e + 126) << 23)); /* the leading bit adds 1 to e + 126 */
}

/** 2^(x / 2^24); the ends of the range stand for all beyond them: infinity and 0 (golden case 57). */
static inline float lrb_f32_exp223(int32_t x)
{
    if (x == INT32_MAX || x == INT32_MIN)
        return x > 0 ? HUGE_VALF : 0.0f;
    uint32_t fraction = (uint32_t)x & 0x00ffffff;
    uint64_t m = lrb_exp2_digits[0][fraction >> 18];
    for (int k = 1; k < 4; k++)
        m = lrb_product_high(m, lrb_exp2_digits[k][fraction >> (18 - 6 * k) & 63]) << 1;
    return lrb_float_of_fixed(m >> 1 | (fraction != 0), (x - (int32_t)fraction) / (1 << 24));
}

/** 2^16 * 64 / (64 + i), rounded up. */
static inline uint32_t lrb_log2_reciprocal(uint32_t i)
{
    return ((1u << 22) + 63 + i) / (64 + i);
}

/** 2^63 * log2(m / 2^23), m in [2^23, 2^24). */
static inline uint64_t lrb_log2_fixed(uint32_t m)
{
    uint32_t i = m >> 17 & 63;
    uint64_t product = (uint64_t)m * lrb_log2_reciprocal(i), z = product - (UINT64_C(1) << 39); /* of 2^39 */
    uint64_t about = (z >> 8) + 1; /* of 2^31, rounded up, so that the second product is not below 1 */
    uint32_t j = (uint32_t)((z - (about * about >> 23)) >> 27);
    z = (product * (4096 - j) - (UINT64_C(1) << 51)) << 12; /* of 2^63 */
    uint64_t p = lrb_log2_series[4];
    for (int k = 3; k >= 0; k--)
        p = lrb_log2_series[k] - 2 * lrb_product_high(z, p);
    return lrb_log2_first[i] + lrb_log2_second[j] + 4 * lrb_product_high(z, p);
}

static inline float lrb_f32_log2(float x)
{
    uint32_t bits = lrb_float_bits(x);
    if (!(x > 0) || bits == 0x7f800000)
        return x != x ? lrb_quiet_float(x) : x < 0 ? lrb_bits_float(LRB_NAN_DEFAULT) : x == 0 ? -HUGE_VALF : x;
    uint64_t wide = lrb_double_bits((double)x); /* no double is subnormal here */
    int64_t exponent = (int64_t)(wide >> 52) - 1023;
    uint64_t fraction = lrb_log2_fixed((uint32_t)(wide >> 29 & 0x007fffff) | 0x00800000);
    /* a multiple of 2^-55, odd unless exact: the one rounding is that to float */
    int64_t fixed = exponent * (INT64_C(1) << 55) + (int64_t)(fraction >> 8 | ((fraction & 0xff) != 0));
    return (float)fixed * 0x1p-55f;
}

static inline float lrb_f32_rcp23(float x)
{
    return lrb_nan_rule2(1.0f / x, x, x);
}

static inline float lrb_f32_rsqrt23(float x)
{
    if (x != x || x < 0)
        return x != x ? lrb_quiet_float(x) : lrb_bits_float(LRB_NAN_DEFAULT);
    return (float)(1.0 / sqrt((double)x));
}

/** Seed of 2^x: 2^(n/32) for the low five bits n of the word. With x + 1.5 * 2^18 in the word, n/32 is the fraction of x
 *  to within 1/64, and 2^x is within 1.1 % of the seed times the power of two. */
static inline float lrb_f32_exp2lut(float x)
{
    return lrb_f32_exp223((int32_t)(lrb_float_bits(x) & 31) << 19);
}

/** Seed of log2(x): log2(1 + n/64) for the upper six bits n of the mantissa, whatever sign and exponent; below the
 *  logarithm of the mantissa by less than 0.0224. */
static inline float lrb_f32_log2lut(float x)
{
    return lrb_f32_log2(lrb_bits_float(0x3f800000 | (lrb_float_bits(x) & 0x007e0000)));
}

/** Seed of 1/sqrt(x): that of the middle of the 128th of two octaves in which x lies; relative error below 2^-8. */
static inline float lrb_f32_rsqrtlut(float x)
{
    if (!(x > 0) || lrb_float_bits(x) == 0x7f800000)
        return lrb_f32_rsqrt23(x);
    uint64_t wide = lrb_double_bits((double)x);
    int exponent = (int)(wide >> 52) - 1023, odd = exponent & 1;
    uint32_t middle = (uint32_t)(127 + odd) << 23 | (uint32_t)(wide >> 46 & 63) << 17 | 1u << 16;
    return lrb_f32_rsqrt23(lrb_bits_float(middle)) * (float)lrb_power_of_two(-(exponent - odd) / 2);
}

#endif
