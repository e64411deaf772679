/* References of the conversions on the way to and from memory: the numbers that elements stand for, in exact integers, rounded by long
 * division. */
#include <math.h>
#include <string.h>

#include "lrbni/conversions.h"
#include "tests/lrbni/oracle.h"

/* The float nearest to n / d * 2^scale, ties to even, as bits; n < 2^31, 0 < d < 2^31. Its result is a normal float. */
static uint32_t nearest_quotient(uint64_t n, uint64_t d, int scale)
{
    if (n == 0)
        return 0;
    for (; n >= 2 * d; scale++)
        d *= 2;
    for (; n < d; scale--)
        n *= 2;
    uint32_t significand = 0; /* of 24 bits, the first 1 */
    for (int bit = 0; bit < 24; bit++, n *= 2) {
        significand = 2 * significand + (n >= d);
        n -= n >= d ? d : 0;
    }
    if (n > d || (n == d && significand % 2))
        significand++;
    return ((uint32_t)(scale + 127) << 23) + (significand - 0x800000u);
}

static uint32_t with_sign(uint32_t bits, int negative) { return negative ? bits + 0x80000000u : bits; }

/* A float of 5 bits of exponent and `digits` of mantissa. */
static uint32_t small_float(uint32_t bits, int digits)
{
    const uint32_t unit = 1u << digits, exponent = bits / unit % 32, mantissa = bits % unit;
    if (exponent == 31)
        return mantissa == 0 ? 0x7f800000u : 0x7fc00000u | mantissa * (0x800000u / unit);
    return exponent == 0 ? nearest_quotient(mantissa, unit, -14) : nearest_quotient(unit + mantissa, unit, (int)exponent - 15);
}

static uint32_t integer(int64_t value) { return with_sign(nearest_quotient((uint64_t)(value < 0 ? -value : value), 1, 0), value < 0); }

static uint32_t norm(int64_t value, int64_t one)
{
    if (value < -one)
        value = -one;
    return with_sign(nearest_quotient((uint64_t)(value < 0 ? -value : value), (uint64_t)one, 0), value < 0);
}

static uint32_t srgb(uint32_t m)
{
    long double x = (long double)m / 255;
    float light = (float)(x <= 0.04045L ? x / 12.92L : powl((x + 0.055L) / 1.055L, 2.4L));
    uint32_t bits;
    memcpy(&bits, &light, sizeof bits);
    return bits;
}

static uint32_t element_bits(const unsigned char *element, int bytes)
{
    uint32_t bits = 0;
    while (bytes > 0)
        bits = 256 * bits + element[--bytes];
    return bits;
}

static int64_t as_signed(uint32_t bits, int width) { return (int64_t)bits - (bits >> (width - 1) ? INT64_C(1) << width : 0); }

uint32_t ref_load_up_ps(int up, const unsigned char *element)
{
    const uint32_t byte = element_bits(element, 1);
    const int bytes = (int)lrb_ups[up].bytes;
    const uint32_t m = element_bits(element, bytes);
    switch ((lrb_up_ps)up) {
    case LRB_UP_PS_none: return m;
    case LRB_UP_PS_float16: return with_sign(small_float(m % 0x8000, 10), m >= 0x8000);
    case LRB_UP_PS_srgb8: return srgb(byte);
    case LRB_UP_PS_uint8: return integer(byte);
    case LRB_UP_PS_sint8: return integer(as_signed(byte, 8));
    case LRB_UP_PS_unorm8: return norm(byte, 255);
    case LRB_UP_PS_snorm8: return norm(as_signed(byte, 8), 127);
    case LRB_UP_PS_uint16: return integer(m);
    case LRB_UP_PS_sint16: return integer(as_signed(m, 16));
    case LRB_UP_PS_unorm16: return norm(m, 65535);
    case LRB_UP_PS_snorm16: return norm(as_signed(m, 16), 32767);
    case LRB_UP_PS_unorm10a: return norm(m % 1024, 1023);
    case LRB_UP_PS_unorm10b: return norm(m / 1024 % 1024, 1023);
    case LRB_UP_PS_unorm10c: return norm(m / 1048576 % 1024, 1023);
    case LRB_UP_PS_unorm2d: return norm(m / 1073741824, 3);
    case LRB_UP_PS_float11a: return small_float(m % 2048, 6);
    case LRB_UP_PS_float11b: return small_float(m / 2048 % 2048, 6);
    case LRB_UP_PS_float10c: return small_float(m / 4194304, 5);
    default: return 0;
    }
}

uint32_t ref_load_up_pi(int up, const unsigned char *element)
{
    switch ((lrb_up_pi)up) {
    case LRB_UP_PI_none: return element_bits(element, 4);
    case LRB_UP_PI_uint8: return element_bits(element, 1);
    case LRB_UP_PI_sint8: return (uint32_t)as_signed(element_bits(element, 1), 8);
    case LRB_UP_PI_uint16: return element_bits(element, 2);
    case LRB_UP_PI_sint16: return (uint32_t)as_signed(element_bits(element, 2), 16);
    default: return 0;
    }
}

/* |value| in units of 2^-45, of which anything below one is left out and `inexact`; value below 2^17. */
typedef struct fixed {
    uint64_t units;
    bool inexact, negative, nan;
} fixed;

static fixed fixed_of(uint32_t bits, uint32_t most)
{
    const uint32_t exponent = bits >> 23 & 0xff;
    fixed f = {.negative = bits >> 31, .nan = ref_is_nan(bits)};
    uint64_t significand = bits % 0x800000 + (exponent ? 0x800000 : 0);
    int shift = (exponent ? (int)exponent : 1) - 127 - 23 + 45;
    if (shift > 63 - 24 || significand << (shift < 0 ? 0 : shift) > (uint64_t)most << 45)
        return (fixed){.units = (uint64_t)most << 45, .negative = f.negative, .nan = f.nan};
    for (; shift < 0 && significand; shift++, significand /= 2)
        f.inexact |= significand % 2;
    f.units = shift < 0 ? 0 : significand << shift;
    return f;
}

enum { EVEN, DOWN, UP, CHOP, AWAY }; /* the modes of the machine by their numbers; halves away from zero, as Direct3D has it */

/* To an integer in [least, most]. */
static int64_t rounded(uint32_t bits, uint32_t scale, int64_t least, int64_t most, int mode)
{
    fixed f = fixed_of(bits, scale == 1 ? 65536 : 1); /* a norm is in [-1, 1] */
    if (f.nan)
        return 0;
    const uint64_t one = UINT64_C(1) << 45;
    const uint64_t product = f.units * scale, whole = product / one, rest = product % one;
    uint64_t result = whole;
    if (mode == EVEN || mode == AWAY)
        result += rest > one / 2 || (rest == one / 2 && (f.inexact || mode == AWAY || whole % 2));
    else if (rest || f.inexact)
        result += mode == (f.negative ? DOWN : UP);
    int64_t value = f.negative ? -(int64_t)result : (int64_t)result;
    return value < least ? least : value > most ? most : value;
}

/* The half below or at |a|, and whether a next one is nearer. */
static uint32_t half(uint32_t bits, int mode)
{
    const uint32_t sign = bits >> 31 << 15;
    bits %= 0x80000000u;
    if (ref_is_nan(bits))
        return sign | 0x7e00 | (bits / 8192 % 512);
    uint32_t low = 0, high = 0x7c00; /* as floats, halves ascend like their bits */
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        if (small_float(middle, 10) <= bits)
            low = middle;
        else
            high = middle;
    }
    if (bits == 0x7f800000u)
        return sign | 0x7c00;
    if (mode != EVEN)
        return sign | (mode == (sign ? DOWN : UP) && small_float(low, 10) != bits ? high : low);
    float value, below, above;
    uint32_t below_bits = small_float(low, 10), above_bits = high == 0x7c00 ? 0x47800000u : small_float(high, 10); /* 2^16 */
    memcpy(&value, &bits, sizeof value);
    memcpy(&below, &below_bits, sizeof below);
    memcpy(&above, &above_bits, sizeof above);
    double to_below = (double)value - (double)below, to_above = (double)above - (double)value; /* exact */
    return sign | (to_above < to_below || (to_above == to_below && low % 2) ? high : low);
}

static void put(unsigned char *element, unsigned bytes, uint32_t value)
{
    for (unsigned i = 0; i < bytes; i++, value /= 256)
        element[i] = (unsigned char)(value % 256);
}

static uint32_t down_ps(lrb_down_ps down, uint32_t a, int mode)
{
    switch (down) {
    case LRB_DOWN_PS_float16: return half(a, mode);
    case LRB_DOWN_PS_float16_rz: return half(a, CHOP);
    case LRB_DOWN_PS_uint8: return (uint32_t)rounded(a, 1, 0, 255, mode);
    case LRB_DOWN_PS_sint8: return (uint32_t)rounded(a, 1, -128, 127, mode);
    case LRB_DOWN_PS_unorm8: return (uint32_t)rounded(a, 255, 0, 255, AWAY);
    case LRB_DOWN_PS_snorm8: return (uint32_t)rounded(a, 127, -127, 127, AWAY);
    case LRB_DOWN_PS_uint16: return (uint32_t)rounded(a, 1, 0, 65535, mode);
    case LRB_DOWN_PS_sint16: return (uint32_t)rounded(a, 1, -32768, 32767, mode);
    case LRB_DOWN_PS_unorm16: return (uint32_t)rounded(a, 65535, 0, 65535, AWAY);
    case LRB_DOWN_PS_snorm16: return (uint32_t)rounded(a, 32767, -32767, 32767, AWAY);
    default: return a;
    }
}

void ref_down_in_state(ref_control control, int down, uint32_t lane, unsigned char *element)
{
    if (control.denormals_are_zero && down != LRB_DOWN_PS_none && lane / 0x800000 % 256 == 0)
        lane -= lane % 0x800000;
    put(element, lrb_downs[down].bytes, down_ps((lrb_down_ps)down, lane, control.rounding));
}

void ref_store_down_ps(int down, uint32_t lane, unsigned char *element)
{
    ref_down_in_state((ref_control){0}, down, lane, element);
}

void ref_store_down_pi(int down, uint32_t lane, unsigned char *element)
{
    const unsigned bytes = lrb_downs[LRB_DOWN_PS_COUNT + down].bytes;
    int64_t value = as_signed(lane, 32), limit = INT64_C(1) << (8 * bytes - 1);
    if (down == LRB_DOWN_PI_sint8 || down == LRB_DOWN_PI_sint16)
        value = value < -limit ? -limit : value >= limit ? limit - 1 : value;
    put(element, bytes, (uint32_t)value);
}
