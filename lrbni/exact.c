#include "lrbni/exact.h"

__extension__ typedef unsigned __int128 uint128;

/* A binary format of IEEE 754. */
typedef struct format {
    int precision; /* bits of the significand with the hidden one; sign and exponent are above all but that one */
    int width;     /* bits of all */
} format;

static const format single = {24, 32}, twice = {53, 64};

static uint64_t sign_bit(const format *f) { return UINT64_C(1) << (f->width - 1); }
static uint64_t hidden_bit(const format *f) { return UINT64_C(1) << (f->precision - 1); }
static uint64_t infinity(const format *f) { return sign_bit(f) - hidden_bit(f); }
static uint64_t quiet_bit(const format *f) { return hidden_bit(f) >> 1; }

static bool is_nan(const format *f, uint64_t bits) { return (bits & ~sign_bit(f)) > infinity(f); }
static bool is_infinite(const format *f, uint64_t bits) { return (bits & ~sign_bit(f)) == infinity(f); }
static bool is_subnormal(const format *f, uint64_t bits) { return (bits & infinity(f)) == 0; }

/* Exponent of the last bit of the smallest numbers: -149 or -1074. */
static int lowest_exponent(const format *f)
{
    int bias = (1 << (f->width - f->precision - 1)) - 1;
    return 2 - bias - f->precision;
}

/* A number: significand * 2^exponent, with a sign. */
typedef struct number {
    bool negative;
    int exponent;
    uint128 significand; /* below 2^126 */
} number;

static number number_of(const format *f, uint64_t bits)
{
    uint64_t fraction = bits & (hidden_bit(f) - 1);
    int field = (int)((bits & infinity(f)) >> (f->precision - 1));
    return (number){.negative = (bits & sign_bit(f)) != 0,
                    .exponent = lowest_exponent(f) + (field ? field - 1 : 0),
                    .significand = field ? fraction | hidden_bit(f) : fraction};
}

static int bit_length(uint128 x)
{
    uint64_t high = (uint64_t)(x >> 64), low = (uint64_t)x;
    return high ? 128 - __builtin_clzll(high) : low ? 64 - __builtin_clzll(low) : 0;
}

/* n.significand / 2^shift as a whole number, rounded; shift may be negative. */
static uint64_t shifted(const number *n, int shift, lrb_rounding mode)
{
    if (shift <= 0)
        return (uint64_t)(n->significand << -shift);
    uint128 quotient = shift > 127 ? 0 : n->significand >> shift;
    uint128 rest = shift > 127 ? n->significand : n->significand - (quotient << shift);
    bool more_than_half = false, half = false;
    if (shift <= 127) {
        uint128 middle = (uint128)1 << (shift - 1);
        more_than_half = rest > middle;
        half = rest == middle;
    }
    bool up = mode == LRB_RN   ? more_than_half || (half && (quotient & 1))
              : mode == LRB_RD ? rest && n->negative
              : mode == LRB_RU ? rest && !n->negative
                               : false;
    return (uint64_t)quotient + up;
}

static uint64_t overflowed(const format *f, bool negative, lrb_rounding mode)
{
    bool away = mode == LRB_RN || (mode == LRB_RD && negative) || (mode == LRB_RU && !negative);
    return (negative ? sign_bit(f) : 0) | (infinity(f) - !away);
}

/* A number that is not 0, rounded to the format. */
static uint64_t rounded(const format *f, lrb_control control, const number *n)
{
    lrb_rounding mode = (lrb_rounding)control.rounding;
    uint64_t sign = n->negative ? sign_bit(f) : 0;
    int shift = bit_length(n->significand) - f->precision;
    int below = lowest_exponent(f) - (n->exponent + shift); /* how far the last bit would lie below the format's last */
    if (below > 0) {
        bool tiny = below > 1 || shifted(n, shift, mode) < hidden_bit(f) << 1;
        if (control.flush_to_zero && tiny)
            return sign;
        shift += below;
    }
    uint64_t significand = shifted(n, shift, mode);
    if (significand >= hidden_bit(f) << 1)
        significand >>= 1, shift++;
    int field = n->exponent + shift - lowest_exponent(f) + 1;
    if (significand < hidden_bit(f))
        return sign | significand;
    if ((uint64_t)field >= infinity(f) >> (f->precision - 1))
        return overflowed(f, n->negative, mode);
    return sign | (uint64_t)field << (f->precision - 1) | (significand & (hidden_bit(f) - 1));
}

/* The highest bit of a significand that is not 0 becomes bit 125: sums fit, and bits that are lost on the right are far below
 * any rounding. */
static void normalise(number *n)
{
    int shift = 126 - bit_length(n->significand);
    n->significand <<= shift;
    n->exponent -= shift;
}

/* Shift right; a 1 that falls out leaves its trace in the last bit. */
static void align(number *n, int exponent)
{
    int shift = exponent - n->exponent;
    uint128 rest = shift > 127 ? n->significand : n->significand & (((uint128)1 << shift) - 1);
    n->significand = (shift > 127 ? 0 : n->significand >> shift) | (rest != 0);
    n->exponent = exponent;
}

/* Sum of two numbers, neither of which is 0. */
static number sum(number p, number q)
{
    normalise(&p);
    normalise(&q);
    if (p.exponent < q.exponent) {
        number swap = p;
        p = q, q = swap;
    }
    align(&q, p.exponent);
    number r = p;
    if (p.negative == q.negative) {
        r.significand = p.significand + q.significand;
    } else {
        bool reversed = q.significand > p.significand;
        r.significand = reversed ? q.significand - p.significand : p.significand - q.significand;
        r.negative = reversed ? q.negative : p.negative;
    }
    return r;
}

/* Signs that an op gives to the product and to the addend. */
enum { NEGATE_PRODUCT = 1, NEGATE_ADDEND = 2 };

/* x * y + z of finite numbers; without an addend, x * y. */
static uint64_t multiply_add(const format *f, lrb_control control, number x, number y, const number *z)
{
    number p = {x.negative != y.negative, x.exponent + y.exponent, x.significand * y.significand};
    number r = p;
    if (z && z->significand)
        r = p.significand ? sum(p, *z) : *z;
    if (r.significand)
        return rounded(f, control, &r);
    bool negative = p.negative;
    if (z && (p.significand || p.negative != z->negative)) /* opposite numbers, or zeros of both signs */
        negative = control.rounding == LRB_RD;
    return negative ? sign_bit(f) : 0;
}

/* x * y + z with the signs given; z is NULL if there is none. No source is a NaN. */
static uint64_t fused(const format *f, lrb_control control, uint64_t x, uint64_t y, const uint64_t *z, unsigned signs)
{
    const uint64_t sign = sign_bit(f), default_nan = sign | infinity(f) | quiet_bit(f);
    uint64_t product_sign = (x ^ y ^ (signs & NEGATE_PRODUCT ? sign : 0)) & sign;
    uint64_t addend = z ? *z ^ (signs & NEGATE_ADDEND ? sign : 0) : 0;
    if (is_infinite(f, x) || is_infinite(f, y)) {
        bool zero_factor = !(x & ~sign) || !(y & ~sign);
        bool opposite = z && is_infinite(f, addend) && (addend & sign) != product_sign;
        return zero_factor || opposite ? default_nan : infinity(f) | product_sign;
    }
    if (z && is_infinite(f, addend))
        return addend;
    number a = number_of(f, x ^ (signs & NEGATE_PRODUCT ? sign : 0)), b = number_of(f, y), c = number_of(f, addend);
    return multiply_add(f, control, a, b, z ? &c : NULL);
}

static uint64_t read(const format *f, lrb_control control, uint64_t bits)
{
    return control.denormals_are_zero && is_subnormal(f, bits) ? bits & sign_bit(f) : bits;
}

static uint64_t one(const format *f)
{
    return infinity(f) >> 1 & ~(hidden_bit(f) - 1);
}

/* One lane. */
static uint64_t exact(const format *f, lrb_control control, lrb_exact_op op, uint64_t x, uint64_t y, uint64_t z)
{
    const uint64_t sources[] = {x, y, z};
    for (int i = 0; i < (op >= LRB_EXACT_fmadd ? 3 : 2); i++)
        if (is_nan(f, sources[i]))
            return sources[i] | quiet_bit(f);
    x = read(f, control, x), y = read(f, control, y), z = read(f, control, z);
    switch (op) {
    case LRB_EXACT_add:
        return fused(f, control, x, one(f), &y, 0);
    case LRB_EXACT_sub:
        return fused(f, control, x, one(f), &y, NEGATE_ADDEND);
    case LRB_EXACT_addn:
        return fused(f, control, x, one(f), &y, NEGATE_PRODUCT | NEGATE_ADDEND);
    case LRB_EXACT_mul:
        return fused(f, control, x, y, NULL, 0);
    case LRB_EXACT_fmadd:
        return fused(f, control, x, y, &z, 0);
    case LRB_EXACT_fmsub:
        return fused(f, control, x, y, &z, NEGATE_ADDEND);
    case LRB_EXACT_fnmadd:
        return fused(f, control, x, y, &z, NEGATE_PRODUCT);
    default:
        return fused(f, control, x, y, &z, NEGATE_PRODUCT | NEGATE_ADDEND);
    }
}

void lrb_exact_ps(lrb_control control, lrb_exact_op op, uint32_t r[16], const uint32_t x[16], const uint32_t y[16],
                  const uint32_t z[16])
{
    for (int i = 0; i < 16; i++)
        r[i] = (uint32_t)exact(&single, control, op, x[i], y[i], z[i]);
}

void lrb_exact_pd(lrb_control control, lrb_exact_op op, uint64_t r[8], const uint64_t x[8], const uint64_t y[8],
                  const uint64_t z[8])
{
    for (int i = 0; i < 8; i++)
        r[i] = exact(&twice, control, op, x[i], y[i], z[i]);
}
