/* Rounding modes, and the two roundings that conversions are made of: a double to a whole number, a double to a float.
 *
 * Both are exact functions of their arguments: they do not read the host's rounding mode, except that it is to nearest even,
 * as C programs start with.
 */
#ifndef LRBNI_ROUNDING_H
#define LRBNI_ROUNDING_H

#include <math.h>

#include "lrbni/numeric.h"

/* Numbered as in bits 14:13 of MXCSR (ISAM 2.3). */
typedef enum lrb_rounding {
    LRB_RN, /* to nearest, ties to even */
    LRB_RD, /* down */
    LRB_RU, /* up */
    LRB_RZ  /* towards zero */
} lrb_rounding;

/* The exponent adjusts that fixed-point forms can encode (KNCNI). */
typedef enum lrb_adjust {
    LRB_ADJUST_NONE = 0,
    LRB_ADJUST_4 = 4,
    LRB_ADJUST_5 = 5,
    LRB_ADJUST_8 = 8,
    LRB_ADJUST_16 = 16,
    LRB_ADJUST_24 = 24,
    LRB_ADJUST_31 = 31,
    LRB_ADJUST_32 = 32
} lrb_adjust;

/** Bits of a double, and back. */
static inline uint64_t lrb_double_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double lrb_bits_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

#define LRB_NAN_QUIET64 UINT64_C(0x0008000000000000)
#define LRB_NAN_DEFAULT64 UINT64_C(0xfff8000000000000)

/** 2^n as a double, n in -1022..1023. */
static inline double lrb_power_of_two(int n)
{
    return lrb_bits_double((uint64_t)(n + 1023) << 52);
}

/** The whole number next to x in that direction; infinities, NaN and the sign of zero stay. */
static inline double lrb_whole(double x, lrb_rounding mode)
{
    switch (mode) {
    case LRB_RD:
        return floor(x);
    case LRB_RU:
        return ceil(x);
    case LRB_RZ:
        return trunc(x);
    default:
        return rint(x);
    }
}

/** The float next to x in that direction; a NaN keeps its sign and its upper 22 payload bits and becomes quiet. */
static inline float lrb_float_of_double(double x, lrb_rounding mode)
{
    if (x != x) {
        uint64_t bits = lrb_double_bits(x);
        return lrb_bits_float((uint32_t)(bits >> 63) << 31 | 0x7fc00000u | (uint32_t)(bits >> 29 & 0x003fffffu));
    }
    float nearest = (float)x;
    uint32_t bits = lrb_float_bits(nearest);
    if (mode == LRB_RN || (double)nearest == x)
        return nearest;
    int beyond = fabs((double)nearest) > fabs(x); /* further from zero than x; the next float towards zero is one bit less */
    int outward = mode == LRB_RU ? x > 0 : mode == LRB_RD ? x < 0 : 0;
    return lrb_bits_float(bits - (beyond && !outward) + (!beyond && outward));
}

/** The double equal to x; a NaN keeps its sign and payload and becomes quiet. */
static inline double lrb_double_of_float(float x)
{
    uint32_t bits = lrb_float_bits(x);
    if (x != x)
        return lrb_bits_double((uint64_t)(bits >> 31) << 63 | 0x7ff8000000000000u | (uint64_t)(bits & 0x003fffffu) << 29);
    return (double)x;
}

#endif
