/* Conversions between number formats, one lane of each.
 *
 * - To integers: scale, round, saturate; a NaN gives 0 (golden cases 23 to 25; card tests quoted in public tool-chain notes).
 * - The exponent adjust n of the fixed-point forms: to integers b * 2^n is rounded, so that b becomes fixed point with n
 *   fraction bits; from integers the rounded value is divided by 2^n. The published formulas multiply both ways, which would
 *   not undo itself; division is assumed.
 * - Rounding is that of the immediate that every one of them has. Flush-to-zero and denormals-are-zero do nothing here: what
 *   they do to conversions is not published.
 * - Graphics formats: the rules of Direct3D are assumed, whose rounding is to nearest even where it leaves a choice.
 */
#ifndef LRBNI_CONVERT_H
#define LRBNI_CONVERT_H

#include <assert.h>

#include "lrbni/rounding.h"
#include "lrbni/srgb8.h"

/** x, a whole number or infinite, as a signed integer: saturating; a NaN gives 0. */
static inline int32_t lrb_saturate_i32(double x)
{
    if (x != x)
        return 0;
    return x >= 0x1p31 ? INT32_MAX : x <= -0x1p31 ? INT32_MIN : (int32_t)x;
}

/** The same as an unsigned integer. */
static inline uint32_t lrb_saturate_u32(double x)
{
    return x >= 0x1p32 ? UINT32_MAX : x > 0 ? (uint32_t)x : 0;
}

static inline int32_t lrb_cvt_f32_i32(float x, lrb_rounding mode, lrb_adjust adjust)
{
    return lrb_saturate_i32(lrb_whole((double)x * lrb_power_of_two((int)adjust), mode));
}

static inline uint32_t lrb_cvt_f32_u32(float x, lrb_rounding mode, lrb_adjust adjust)
{
    return lrb_saturate_u32(lrb_whole((double)x * lrb_power_of_two((int)adjust), mode));
}

static inline float lrb_cvt_i32_f32(int32_t x, lrb_rounding mode, lrb_adjust adjust)
{
    return lrb_float_of_double((double)x, mode) * (float)lrb_power_of_two(-(int)adjust);
}

static inline float lrb_cvt_u32_f32(uint32_t x, lrb_rounding mode, lrb_adjust adjust)
{
    return lrb_float_of_double((double)x, mode) * (float)lrb_power_of_two(-(int)adjust);
}

static inline int32_t lrb_cvt_f64_i32(double x, lrb_rounding mode) { return lrb_saturate_i32(lrb_whole(x, mode)); }
static inline uint32_t lrb_cvt_f64_u32(double x, lrb_rounding mode) { return lrb_saturate_u32(lrb_whole(x, mode)); }

/** sRGB8 of a linear value: 0 to 255; below 0 and NaN give 0, above 1 gives 255. */
static inline int32_t lrb_cvt_f32_srgb8(float x)
{
    int32_t code = 0; /* the largest whose threshold is not above x, bit by bit */
    for (int32_t bit = 128; bit; bit /= 2)
        code += x >= lrb_srgb8_thresholds[code + bit - 1] ? bit : 0;
    return code;
}

/** Unsigned normalised value of that many bits: nearest to x * (2^bits - 1); below 0 and NaN give 0, above 1 all ones. */
static inline uint32_t lrb_cvt_f32_unorm(float x, int bits)
{
    double largest = (double)((1u << bits) - 1);
    return x >= 1 ? (uint32_t)largest : x > 0 ? (uint32_t)rint((double)x * largest) : 0;
}

/** Float without a sign, of five exponent bits and that many mantissa bits: negative values and -0 give 0, NaN all ones. */
static inline uint32_t lrb_cvt_f32_small(float x, int mantissa_bits)
{
    uint32_t bits = lrb_float_bits(x), infinity = 31u << mantissa_bits;
    if (x != x)
        return infinity | ((1u << mantissa_bits) - 1);
    if (bits >> 31)
        return 0;
    if (x < 0x1p-14f) /* subnormal there: a multiple of 2^(-14 - mantissa_bits) */
        return (uint32_t)rint((double)x * lrb_power_of_two(14 + mantissa_bits));
    int drop = 23 - mantissa_bits;
    uint32_t kept = (bits - (112u << 23)) >> drop, rest = bits << (32 - drop);
    kept += rest > 0x80000000u || (rest == 0x80000000u && kept & 1);
    return kept < infinity ? kept : infinity;
}

/** Fields of the packed formats, lowest first: 10:10:10:2 normalised, and 11:11:10 floats (fields 0 to 2). */
static inline uint32_t lrb_insert_u10(uint32_t old, float x, unsigned field)
{
    assert(field < 4);
    uint32_t mask = field < 3 ? 0x3ffu : 3u;
    return (old & ~(mask << 10 * field)) | lrb_cvt_f32_unorm(x, field < 3 ? 10 : 2) << 10 * field;
}

static inline uint32_t lrb_insert_f11(uint32_t old, float x, unsigned field)
{
    assert(field < 3);
    uint32_t mask = field < 2 ? 0x7ffu : 0x3ffu;
    return (old & ~(mask << 11 * field)) | lrb_cvt_f32_small(x, field < 2 ? 6 : 5) << 11 * field;
}

#endif
