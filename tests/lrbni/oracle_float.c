/* References of the float ops. Products and sums of floats are computed in double, where products are exact and sums are
 * exact or rounded to odd, and rounded to float once; comparisons and NaN rules work on the bits. */
#include <math.h>
#include <string.h>

#include "tests/lrbni/oracle.h"

static const uint32_t QUIET = 0x00400000, DEFAULT_NAN = 0xffc00000, SIGN = 0x80000000;

bool ref_is_nan(uint32_t bits)
{
    return (bits & 0x7f800000) == 0x7f800000 && (bits & 0x007fffff) != 0;
}

static double value(uint32_t bits)
{
    float f;
    memcpy(&f, &bits, sizeof f);
    return (double)f;
}

/* Round a double to float, ties to even. A NaN here is an invalid operation's: NaN operands were sorted out before. */
static uint32_t rounded(double d)
{
    if (d != d)
        return DEFAULT_NAN;
    float f = (float)d;
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

/* The first NaN of the operands, made quiet, into *result. */
static bool nan_operand(const uint32_t *operands, int count, uint32_t *result)
{
    for (int i = 0; i < count; i++)
        if (ref_is_nan(operands[i])) {
            *result = operands[i] | QUIET;
            return true;
        }
    return false;
}

/* A sum of floats may need more than a double's 53 bits, but rounding it to double first does no harm: 53 is at least
   2 * 24 + 2 (Figueroa 1995), and sums below 2^-126 are exact. */
static uint32_t add(uint32_t a, uint32_t b)
{
    uint32_t nan;
    if (nan_operand((uint32_t[]){a, b}, 2, &nan))
        return nan;
    return rounded(value(a) + value(b));
}

uint32_t ref_add_ps(uint32_t a, uint32_t b) { return add(a, b); }

static uint32_t subtract(uint32_t a, uint32_t b)
{
    return ref_is_nan(b) ? add(a, b) : add(a, b ^ SIGN);
}

uint32_t ref_sub_ps(uint32_t a, uint32_t b) { return subtract(a, b); }
uint32_t ref_subr_ps(uint32_t a, uint32_t b) { return subtract(b, a); }

uint32_t ref_addn_ps(uint32_t a, uint32_t b)
{
    return ref_is_nan(a) || ref_is_nan(b) ? add(a, b) : add(a ^ SIGN, b ^ SIGN);
}

uint32_t ref_addsets_ps(uint32_t a, uint32_t b, bool *k)
{
    uint32_t sum = add(a, b);
    *k = sum >= SIGN;
    return sum;
}

/* 24 times 24 bits are 48, and exponents go down to 2^-298 only: the product is exact. */
uint32_t ref_mul_ps(uint32_t a, uint32_t b)
{
    uint32_t nan;
    if (nan_operand((uint32_t[]){a, b}, 2, &nan))
        return nan;
    return rounded(value(a) * value(b));
}

/* p + c rounded to odd: to the neighbour with an odd last bit unless it is exact (Boldo and Melquiond 2008), so that a
   second rounding to 24 bits sees on which side of every tie the sum lies. */
static double add_to_odd(double p, double c)
{
    double sum = p + c;
    if (!isfinite(sum))
        return sum;
    double c_part = sum - p, p_part = sum - c_part; /* Knuth's two-sum: the error of a sum is a double */
    double error = (p - p_part) + (c - c_part);
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    if (error != 0 && !(bits & 1))
        sum = nextafter(sum, error > 0 ? HUGE_VAL : -HUGE_VAL);
    return sum;
}

/* a * b + c with one rounding; negations (of operands that are no NaN) are exact. */
static uint32_t fused(uint32_t a, uint32_t b, uint32_t c, uint32_t negate_product, uint32_t negate_addend)
{
    uint32_t nan;
    if (nan_operand((uint32_t[]){a, b, c}, 3, &nan))
        return nan;
    return rounded(add_to_odd(value(a ^ negate_product) * value(b), value(c ^ negate_addend)));
}

uint32_t ref_madd132_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(d, b, a, 0, 0); }
uint32_t ref_madd213_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, d, b, 0, 0); }
uint32_t ref_madd231_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, b, d, 0, 0); }
uint32_t ref_msub132_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(d, b, a, 0, SIGN); }
uint32_t ref_msub213_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, d, b, 0, SIGN); }
uint32_t ref_msub231_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, b, d, 0, SIGN); }
uint32_t ref_msubr132_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(d, b, a, SIGN, 0); }
uint32_t ref_msubr213_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, d, b, SIGN, 0); }
uint32_t ref_msubr231_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, b, d, SIGN, 0); }

uint32_t ref_maddn132_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(d, b, a, SIGN, SIGN); }
uint32_t ref_maddn213_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, d, b, SIGN, SIGN); }
uint32_t ref_maddn231_ps(uint32_t d, uint32_t a, uint32_t b) { return fused(a, b, d, SIGN, SIGN); }
uint32_t ref_msubr23c1_ps(uint32_t a, uint32_t b) { return fused(a, b, 0x3f800000, SIGN, 0); }
uint32_t ref_madd233_ps(uint32_t a, const uint32_t group[4]) { return fused(a, group[1], group[0], 0, 0); }

/* Place of a float that is no NaN on the number line; both zeros are at 0. */
static int64_t place(uint32_t bits)
{
    int64_t magnitude = bits & ~SIGN;
    return bits & SIGN ? -magnitude : magnitude;
}

static bool unordered(uint32_t a, uint32_t b) { return ref_is_nan(a) || ref_is_nan(b); }
static bool less(uint32_t a, uint32_t b) { return !unordered(a, b) && place(a) < place(b); }
static bool equal(uint32_t a, uint32_t b) { return !unordered(a, b) && place(a) == place(b); }

/* The second source, as it is, if the first is not strictly beyond it (isa-facts 1.5, non-g). */
uint32_t ref_min_ps(uint32_t a, uint32_t b) { return less(a, b) ? a : b; }
uint32_t ref_max_ps(uint32_t a, uint32_t b) { return less(b, a) ? a : b; }

uint32_t ref_maxabs_ps(uint32_t a, uint32_t b) { return ref_max_ps(a % SIGN, b % SIGN); }

/* The number, if only one is; the first NaN, if none is (isa-facts 1.5). */
uint32_t ref_gmin_ps(uint32_t a, uint32_t b)
{
    if (unordered(a, b))
        return !ref_is_nan(a) ? a : !ref_is_nan(b) ? b : a | QUIET;
    return less(a, b) ? a : b;
}

uint32_t ref_gmax_ps(uint32_t a, uint32_t b)
{
    if (unordered(a, b))
        return ref_gmin_ps(a, b);
    return less(a, b) ? b : a;
}

uint32_t ref_gmaxabs_ps(uint32_t a, uint32_t b) { return ref_gmax_ps(a % SIGN, b % SIGN); }

/* A negative limit is the mirror image of a positive one. */
uint32_t ref_clampz_ps(uint32_t a, uint32_t b)
{
    if (ref_is_nan(b))
        return ref_is_nan(a) ? 0 : a & SIGN;
    if (b & SIGN)
        return ref_clampz_ps(a ^ SIGN, b ^ SIGN) ^ SIGN;
    if (ref_is_nan(a) || place(a) <= 0)
        return 0;
    return less(b, a) ? b : a;
}

uint32_t ref_blendm_ps(bool k, uint32_t a, uint32_t b) { return k ? b : a; }

bool ref_cmpeq_ps(uint32_t a, uint32_t b) { return equal(a, b); }
bool ref_cmplt_ps(uint32_t a, uint32_t b) { return less(a, b); }
bool ref_cmple_ps(uint32_t a, uint32_t b) { return less(a, b) || equal(a, b); }
bool ref_cmpunord_ps(uint32_t a, uint32_t b) { return unordered(a, b); }
bool ref_cmpneq_ps(uint32_t a, uint32_t b) { return !equal(a, b); }
bool ref_cmpnlt_ps(uint32_t a, uint32_t b) { return !less(a, b); }
bool ref_cmpnle_ps(uint32_t a, uint32_t b) { return !less(a, b) && !equal(a, b); }
bool ref_cmpord_ps(uint32_t a, uint32_t b) { return !unordered(a, b); }

/* Mantissa (24 bits, or fewer if subnormal) and exponent of a finite float: mantissa * 2^exponent. */
static uint64_t mantissa(uint32_t bits, int *exponent)
{
    int field = (int)(bits >> 23 & 0xff);
    *exponent = (field ? field : 1) - 150;
    return (bits & 0x007fffff) | (field ? 0x00800000u : 0);
}

/* 1/x rounded to nearest even: a quotient of integers with 24 bits or, below 2^-126, as many as the format has there. */
static uint32_t reciprocal(uint32_t x)
{
    uint32_t sign = x & SIGN, magnitude = x & ~SIGN;
    if (magnitude == 0)
        return sign | 0x7f800000;
    if (magnitude == 0x7f800000)
        return sign;
    int e;
    uint64_t m = mantissa(x, &e);
    while (m < 1u << 23) /* subnormal */
        m *= 2, e--;
    /* 1/x = 2^shift / m * 2^(-e - shift), and the first factor has 24 bits before the point */
    int shift = m == 1u << 23 ? 46 : 47;
    int exponent = -e - shift;
    while (exponent < -149) /* below the format's last bit */
        exponent++, shift--;
    uint64_t n = UINT64_C(1) << shift, q = n / m, rest = n % m;
    if (2 * rest > m || (2 * rest == m && (q & 1)))
        q++;
    if (q >= 1u << 24)
        q /= 2, exponent++;
    if (exponent > 104)
        return sign | 0x7f800000;
    return sign | (q < 1u << 23 ? (uint32_t)q : (uint32_t)(exponent + 150) << 23 | ((uint32_t)q & 0x007fffff));
}

uint32_t ref_rcp23_ps(uint32_t b) { return ref_is_nan(b) ? b | QUIET : reciprocal(b); }

/* Sign, exponent and 11 bits of mantissa are kept of the rounded quotient, and as many of a NaN. */
uint32_t ref_rcpres_ps(uint32_t b)
{
    uint32_t exact = ref_is_nan(b) ? b | QUIET : reciprocal(b);
    return exact / 4096 * 4096;
}

uint32_t ref_rcprefine_ps(uint32_t a, uint32_t b)
{
    uint32_t nan;
    if (nan_operand((uint32_t[]){a, b}, 2, &nan))
        return nan;
    uint32_t factor = fused(a, b, 0x40000000, SIGN, 0);
    return ref_mul_ps(a, factor);
}
