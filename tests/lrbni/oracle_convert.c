/* References of conversions, exponents and fix-up: on the bits, with a number taken apart into an integer and a power of two. */
#include <math.h>

#include "tests/lrbni/oracle.h"

__extension__ typedef unsigned __int128 wide;

enum { NEAREST, DOWN, UP, TO_ZERO };

/* A number: (-1)^negative * m * 2^e; or infinite, or NaN. */
typedef struct parts {
    bool negative, infinite, nan;
    uint64_t m;
    int e;
} parts;

/* Mantissa bits and exponent bias of the two formats. */
static parts take_apart(uint64_t bits, int mantissa_bits, int exponent_bits)
{
    uint64_t m = bits & ((UINT64_C(1) << mantissa_bits) - 1);
    int all_ones = (1 << exponent_bits) - 1, field = (int)(bits >> mantissa_bits) & all_ones;
    parts p = {.negative = bits >> (mantissa_bits + exponent_bits) & 1, .infinite = field == all_ones && !m,
               .nan = field == all_ones && m};
    p.m = field ? m | UINT64_C(1) << mantissa_bits : m;
    p.e = (field ? field : 1) - all_ones / 2 - mantissa_bits;
    return p;
}

static parts of_float(uint32_t bits) { return take_apart(bits, 23, 8); }
static parts of_double(uint64_t bits) { return take_apart(bits, 52, 11); }

/* m * 2^e rounded to an integer; cut off at 2^100, which is beyond everything that is asked for. */
static wide whole(bool negative, uint64_t m, int e, int mode)
{
    if (m == 0)
        return 0;
    if (e >= 0)
        return e > 64 ? (wide)1 << 100 : (wide)m << e;
    bool half = e == -1 ? m & 1 : e >= -64 && (m >> (-e - 1) & 1);
    uint64_t q = e > -64 ? m >> -e : 0;
    bool inexact = e > -64 ? (q << -e) != m : true;
    bool more = e >= -64 ? (m & ((UINT64_C(1) << (-e - 1)) - 1)) != 0 : true; /* than the half, or than nothing */
    if (mode == NEAREST)
        return q + (half && (more || (q & 1)));
    return q + (inexact && ((mode == UP && !negative) || (mode == DOWN && negative)));
}

static uint32_t to_integer(parts p, int mode, int adjust, bool is_signed)
{
    if (p.nan || (p.negative && !is_signed))
        return 0;
    wide magnitude = p.infinite ? (wide)1 << 100 : whole(p.negative, p.m, p.e + adjust, mode);
    wide limit = !is_signed ? UINT32_MAX : p.negative ? 0x80000000u : 0x7fffffffu;
    uint32_t size = (uint32_t)(magnitude > limit ? limit : magnitude);
    return p.negative ? 0 - size : size;
}

uint32_t ref_cvtps2pi(uint32_t b, int mode, int adjust) { return to_integer(of_float(b), mode, adjust, true); }
uint32_t ref_cvtps2pu(uint32_t b, int mode, int adjust) { return to_integer(of_float(b), mode, adjust, false); }
uint32_t ref_cvtpd2pi(uint64_t b, int mode) { return to_integer(of_double(b), mode, 0, true); }
uint32_t ref_cvtpd2pu(uint64_t b, int mode) { return to_integer(of_double(b), mode, 0, false); }
uint32_t ref_cvtlo_pd2pi(uint64_t b, int mode) { return ref_cvtpd2pi(b, mode); }
uint32_t ref_cvthi_pd2pi(uint64_t b, int mode) { return ref_cvtpd2pi(b, mode); }
uint32_t ref_cvtlo_pd2pu(uint64_t b, int mode) { return ref_cvtpd2pu(b, mode); }
uint32_t ref_cvthi_pd2pu(uint64_t b, int mode) { return ref_cvtpd2pu(b, mode); }

/* (-1)^negative * m * 2^e as a float. */
static uint32_t float_of(bool negative, uint64_t m, int e, int mode)
{
    uint32_t sign = negative ? 0x80000000u : 0;
    if (m == 0)
        return sign;
    int top = 63 - __builtin_clzll(m) + e; /* exponent of the leading bit */
    int last = top - 23 > -149 ? top - 23 : -149; /* of the last bit that a float has there */
    uint64_t n = (uint64_t)whole(negative, m, e - last, mode);
    if (n >> 24)
        n >>= 1, last++;
    if (last > 104) {
        bool finite = mode == TO_ZERO || (mode == DOWN && !negative) || (mode == UP && negative);
        return sign | (finite ? 0x7f7fffff : 0x7f800000);
    }
    return sign | (n >> 23 ? (uint32_t)(last + 150) << 23 | ((uint32_t)n & 0x007fffff) : (uint32_t)n);
}

/* An integer times 2^-adjust: adjust at most 32, so rounding the integer or the product is the same. */
uint32_t ref_cvtpi2ps(uint32_t b, int mode, int adjust)
{
    bool negative = b >> 31;
    return b ? float_of(negative, negative ? 0 - b : b, -adjust, mode) : 0;
}

uint32_t ref_cvtpu2ps(uint32_t b, int mode, int adjust) { return float_of(false, b, -adjust, mode); }

uint32_t ref_cvtpd2ps(uint64_t b, int mode)
{
    parts p = of_double(b);
    uint32_t sign = p.negative ? 0x80000000u : 0;
    if (p.nan)
        return sign | 0x7fc00000 | (uint32_t)((b & 0x000fffffffffffff) / (1 << 29));
    return p.infinite ? sign | 0x7f800000 : float_of(p.negative, p.m, p.e, mode);
}

uint32_t ref_cvtlo_pd2ps(uint64_t b, int mode) { return ref_cvtpd2ps(b, mode); }
uint32_t ref_cvthi_pd2ps(uint64_t b, int mode) { return ref_cvtpd2ps(b, mode); }

/* m * 2^e, exactly, as a double; m has at most 53 bits and the exponent is a normal double's. */
static uint64_t double_of(bool negative, uint64_t m, int e)
{
    uint64_t sign = negative ? UINT64_C(1) << 63 : 0;
    if (m == 0)
        return sign;
    while (!(m >> 52))
        m *= 2, e--;
    return sign | (uint64_t)(e + 1075) << 52 | (m & 0x000fffffffffffff);
}

uint64_t ref_cvtps2pd(uint32_t b)
{
    parts p = of_float(b);
    uint64_t sign = p.negative ? UINT64_C(1) << 63 : 0;
    if (p.nan)
        return sign | UINT64_C(0x7ff8000000000000) | (uint64_t)(b & 0x007fffff) * (1 << 29);
    return p.infinite ? sign | UINT64_C(0x7ff0000000000000) : double_of(p.negative, p.m, p.e);
}

uint64_t ref_cvtpi2pd(uint32_t b) { return b >> 31 ? double_of(true, 0 - b, 0) : double_of(false, b, 0); }
uint64_t ref_cvtpu2pd(uint32_t b) { return double_of(false, b, 0); }
uint64_t ref_cvthi_ps2pd(uint32_t b) { return ref_cvtps2pd(b); }
uint64_t ref_cvthi_pi2pd(uint32_t b) { return ref_cvtpi2pd(b); }
uint64_t ref_cvthi_pu2pd(uint32_t b) { return ref_cvtpu2pd(b); }

/* The encoding curve of IEC 61966-2-1; long double is precise enough to tell every float's code. */
uint32_t ref_cvtps2srgb8(uint32_t b)
{
    parts p = of_float(b);
    if (p.nan || p.negative || p.m == 0)
        return 0;
    if (p.infinite || b >= 0x3f800000)
        return 255;
    long double x = ldexpl((long double)p.m, p.e);
    long double curve = x <= 0.04045L / 12.92L ? 12.92L * x : 1.055L * powl(x, 1 / 2.4L) - 0.055L;
    return (uint32_t)floorl(255 * curve + 0.5L);
}

/* x * (2^bits - 1) is an integer of at most 34 bits over a power of two. */
uint32_t ref_cvtinsps2u10(uint32_t d, uint32_t b, int field)
{
    parts p = of_float(b);
    uint32_t largest = field == 3 ? 3 : 1023;
    wide n = p.nan || p.negative ? 0 : p.infinite ? largest : whole(false, p.m * largest, p.e, NEAREST);
    uint32_t value = n > largest ? largest : (uint32_t)n;
    for (int bit = 0; bit < (field == 3 ? 2 : 10); bit++)
        d = (d & ~(1u << (10 * field + bit))) | (value >> bit & 1) << (10 * field + bit);
    return d;
}

/* Exponent 5 bits of bias 15, the largest for infinity and NaN; mantissa 6 bits, in the last field 5. */
uint32_t ref_cvtinsps2f11(uint32_t d, uint32_t b, int field)
{
    parts p = of_float(b);
    int bits = field == 2 ? 5 : 6;
    uint32_t value = 0, infinity = 31u << bits;
    if (p.nan) {
        value = infinity + (1u << bits) - 1;
    } else if (p.infinite && !p.negative) {
        value = infinity;
    } else if (!p.negative && p.m) {
        int top = 63 - __builtin_clzll(p.m) + p.e, last = (top > -14 ? top : -14) - bits;
        wide n = whole(false, p.m, p.e - last, NEAREST); /* n * 2^last; the leading bit counts one exponent */
        wide encoded = n + (wide)(last + 14 + bits) * (1u << bits);
        value = top > 16 || encoded > infinity ? infinity : (uint32_t)encoded;
    }
    for (int bit = 0; bit < bits + 5; bit++)
        d = (d & ~(1u << (11 * field + bit))) | (value >> bit & 1) << (11 * field + bit);
    return d;
}
