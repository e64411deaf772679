/* Sums, products and multiply-adds in any state of the machine, in numbers of 4416 bits with a fixed point: every product of
 * doubles is exact there, and every sum of such a product and a double. */
#include <math.h>
#include <string.h>

#include "tests/lrbni/oracle.h"

__extension__ typedef unsigned __int128 uint128;

enum { LIMBS = 69, POINT = 2304 }; /* bit POINT of a number is worth 1 */

typedef struct fixed {
    uint64_t limb[LIMBS];
} fixed;

/* Precision, and exponents of the smallest and largest normal numbers. */
typedef struct format {
    int precision, least, most;
} format;

static const format formats[] = {{24, -126, 127}, {53, -1022, 1023}};

double ref_value(bool wide, uint64_t bits)
{
    double d;
    float f;
    uint32_t narrow = (uint32_t)bits;
    memcpy(&d, &bits, sizeof d);
    memcpy(&f, &narrow, sizeof f);
    return wide ? d : (double)f;
}

uint64_t ref_bits(bool wide, double d)
{
    uint64_t bits;
    uint32_t narrow;
    float f = (float)d;
    memcpy(&bits, &d, sizeof bits);
    memcpy(&narrow, &f, sizeof narrow);
    return wide ? bits : narrow;
}

/* whole * 2^exponent */
static fixed fixed_of(uint128 whole, int exponent)
{
    fixed r = {{0}};
    int at = exponent + POINT;
    for (int i = 0; i < 128; i++)
        if (whole >> i & 1)
            r.limb[(at + i) / 64] |= UINT64_C(1) << (at + i) % 64;
    return r;
}

static int compare(const fixed *a, const fixed *b)
{
    for (int i = LIMBS - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] > b->limb[i] ? 1 : -1;
    return 0;
}

/* a + b, or a - b of a that is not less. */
static fixed combine(const fixed *a, const fixed *b, bool subtract)
{
    fixed r;
    uint128 carry = subtract;
    for (int i = 0; i < LIMBS; i++) {
        carry += (uint128)a->limb[i] + (subtract ? ~b->limb[i] : b->limb[i]);
        r.limb[i] = (uint64_t)carry;
        carry >>= 64;
    }
    return r;
}

static unsigned bit(const fixed *a, int at)
{
    return at < 0 ? 0 : (unsigned)(a->limb[at / 64] >> at % 64 & 1);
}

static int highest_bit(const fixed *a)
{
    int at = LIMBS * 64 - 1;
    while (at >= 0 && !a->limb[at / 64])
        at -= 64;
    while (at >= 0 && !bit(a, at))
        at--;
    return at;
}

static bool any_bit_below(const fixed *a, int at)
{
    for (int i = 0; i < at; i += i % 64 == 0 && !a->limb[i / 64] ? 64 : 1)
        if (bit(a, i))
            return true;
    return false;
}

/* The bits from `last` upwards as a whole number, rounded by those below. */
static uint64_t whole_above(const fixed *a, int top, int last, bool negative, int rounding)
{
    uint64_t whole = 0;
    for (int at = top; at >= last; at--)
        whole = whole * 2 + bit(a, at);
    bool half = bit(a, last - 1), rest = any_bit_below(a, last - 1);
    switch (rounding) {
    case REF_DOWN:
        return whole + (negative && (half || rest));
    case REF_UP:
        return whole + (!negative && (half || rest));
    case REF_TOWARDS_ZERO:
        return whole;
    default:
        return whole + (half && (rest || (whole & 1)));
    }
}

static uint64_t rounded(bool wide, ref_control control, const fixed *a, bool negative)
{
    const format *f = &formats[wide];
    int top = highest_bit(a), exponent = top - POINT, last = exponent - f->precision + 1;
    double sign = negative ? -1 : 1;
    if (exponent < f->least) {
        /* tiny, unless rounding to full precision makes it 2^least */
        double full = ldexp((double)whole_above(a, top, last + POINT, negative, control.rounding), last - f->least);
        if (control.flush_to_zero && full < 1)
            return ref_bits(wide, sign * 0.0);
        last = f->least - f->precision + 1;
    }
    double size = ldexp((double)whole_above(a, top, last + POINT, negative, control.rounding), last);
    double largest = ldexp(2 - ldexp(1, 1 - f->precision), f->most);
    if (size > largest) {
        bool away = control.rounding == REF_NEAREST || control.rounding == (negative ? REF_DOWN : REF_UP);
        size = away ? HUGE_VAL : largest;
    }
    return ref_bits(wide, sign * size);
}

/* Significand as a whole number, and its exponent. */
static uint64_t split(double d, int *exponent)
{
    double whole = ldexp(frexp(fabs(d), exponent), 53);
    *exponent -= 53;
    return (uint64_t)whole;
}

static double read(bool wide, ref_control control, uint64_t bits)
{
    double d = ref_value(wide, bits);
    return control.denormals_are_zero && fabs(d) < ldexp(1, formats[wide].least) ? copysign(0, d) : d;
}

static uint64_t zero(bool wide, ref_control control, double p, double z)
{
    bool negative = signbit(p) && signbit(z);
    if (!signbit(p) != !signbit(z) || p != 0)
        negative = control.rounding == REF_DOWN;
    return ref_bits(wide, negative ? -0.0 : 0.0);
}

static fixed product_of(double x, double y)
{
    int ex, ey;
    uint64_t mx = split(x, &ex), my = split(y, &ey);
    return fixed_of((uint128)mx * my, ex + ey);
}

uint64_t ref_fused(bool wide, ref_control control, ref_sources s)
{
    uint64_t nan = 0;
    const uint64_t sources[] = {s.x, s.y, s.z};
    for (int i = 0; i < 3 && !nan; i++)
        if (ref_is_nan_lane(wide, sources[i]))
            nan = sources[i] | (wide ? UINT64_C(0x0008000000000000) : UINT64_C(0x00400000));
    if (nan)
        return nan;
    double x = read(wide, control, s.x), y = read(wide, control, s.y), z = read(wide, control, s.z);
    x = s.negate_product ? -x : x;
    z = s.negate_addend ? -z : z;
    if (isinf(x) || isinf(y) || isinf(z)) {
        double r = isinf(x) || isinf(y) ? x * y + z : z;
        return r != r ? (wide ? UINT64_C(0xfff8000000000000) : UINT64_C(0xffc00000)) : ref_bits(wide, r);
    }
    fixed p = product_of(x, y), q = product_of(z, 1);
    bool p_negative = !signbit(x) != !signbit(y), q_negative = signbit(z);
    int order = compare(&p, &q);
    if (p_negative == q_negative) {
        fixed sum = combine(&p, &q, false);
        return highest_bit(&sum) < 0 ? zero(wide, control, copysign(0, x) * copysign(1, y), z)
                                     : rounded(wide, control, &sum, p_negative);
    }
    if (order == 0)
        return zero(wide, control, copysign(1, x) * copysign(1, y), z);
    fixed difference = order > 0 ? combine(&p, &q, true) : combine(&q, &p, true);
    return rounded(wide, control, &difference, order > 0 ? p_negative : q_negative);
}

uint64_t ref_product(bool wide, ref_control control, uint64_t x, uint64_t y)
{
    /* with a zero of the product's sign, which changes nothing */
    uint64_t sign = wide ? UINT64_C(1) << 63 : UINT64_C(1) << 31;
    return ref_fused(wide, control, (ref_sources){.x = x, .y = y, .z = (x ^ y) & sign});
}

uint64_t ref_sum(bool wide, ref_control control, uint64_t x, uint64_t z, bool negate_x, bool negate_z)
{
    return ref_fused(wide, control, (ref_sources){.x = x, .y = ref_bits(wide, 1), .z = z, .negate_product = negate_x,
                                                  .negate_addend = negate_z});
}

ref_control ref_ldvxcsr(const unsigned char *bytes)
{
    return (ref_control){.rounding = bytes[1] / 32 % 4, .flush_to_zero = bytes[1] >= 128, .denormals_are_zero = bytes[0] / 64 % 2};
}

void ref_stvxcsr(unsigned char *bytes, ref_control control)
{
    bytes[0] = (unsigned char)(128 + 64 * control.denormals_are_zero);
    bytes[1] = (unsigned char)(31 + 32 * control.rounding + 128 * control.flush_to_zero);
    bytes[2] = bytes[3] = 0;
}
