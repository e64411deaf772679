/* References of rounding to fixed point, exponents, mantissas, scaling, fix-up and transcendentals. The last go through long
 * double, whose 64 bits or more settle the rounding of all but one float in many billions; tests/lrbni/test_every_float.c has
 * the proof. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "tests/lrbni/oracle.h"

_Static_assert(LDBL_MANT_DIG >= 64, "the references need more than a double");

static float value(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double value64(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint64_t bits_of64(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint32_t quiet(uint32_t bits) { return bits | 0x00400000; }
static uint64_t quiet64(uint64_t bits) { return bits | UINT64_C(0x0008000000000000); }
static bool is_nan64(uint64_t bits) { return (bits << 1) > UINT64_C(0xffe0000000000000); }

/* |x| * 2^n, below 2^96, rounded to an integer; what is cut off decides. */
static long double whole(long double x, bool negative, int mode)
{
    long double cut = floorl(x), rest = x - cut;
    bool up = mode == 0 ? rest > 0.5L || (rest == 0.5L && fmodl(cut, 2) != 0) : rest > 0 && mode == (negative ? 1 : 2);
    return up ? cut + 1 : cut;
}

uint64_t ref_round_pd(uint64_t b, int mode, int adjust)
{
    if (is_nan64(b))
        return quiet64(b);
    double size = fabs(value64(b));
    bool negative = b >> 63;
    if (size < 0x1p53)
        size = (double)ldexpl(whole(ldexpl((long double)size, adjust), negative, mode), -adjust);
    return bits_of64(negative ? -size : size);
}

uint32_t ref_round_ps(uint32_t b, int mode, int adjust)
{
    if (ref_is_nan(b))
        return quiet(b);
    return bits_of((float)value64(ref_round_pd(bits_of64((double)value(b)), mode, adjust)));
}

/* Counted, not read from the bits. */
static int exponent(double x)
{
    int e = 0;
    for (; x >= 2; e++)
        x /= 2;
    for (; x < 1; e--)
        x *= 2;
    return e;
}

uint64_t ref_getexp_pd(uint64_t b)
{
    double size = fabs(value64(b));
    if (is_nan64(b))
        return quiet64(b);
    return bits_of64(size == 0 ? -HUGE_VAL : isinf(size) ? size : exponent(size));
}

uint32_t ref_getexp_ps(uint32_t b)
{
    return ref_is_nan(b) ? quiet(b) : bits_of((float)value64(ref_getexp_pd(bits_of64((double)value(b)))));
}

/* Divided or multiplied by two until it lies in the interval; of the two octaves of [1/2, 2) the one in which the power of two
   that was taken out is even. */
uint64_t ref_getmant_pd(uint64_t b, int interval, int sign)
{
    static const double from[4] = {1, 1, 0.5, 0.75};
    double x = value64(b), m = fabs(x);
    if (is_nan64(b))
        return quiet64(b);
    if (sign == 2 && x < 0)
        return UINT64_C(0xfff8000000000000);
    int taken = 0;
    if (m == 0 || isinf(m))
        m = 1;
    else {
        for (; m >= 2 * from[interval]; taken++)
            m /= 2;
        for (; m < from[interval]; taken--)
            m *= 2;
    }
    if (interval == 1 && taken % 2 != 0)
        m /= 2;
    return bits_of64(sign != 1 && b >> 63 ? -m : m);
}

uint32_t ref_getmant_ps(uint32_t b, int interval, int sign)
{
    if (ref_is_nan(b))
        return quiet(b);
    return bits_of((float)value64(ref_getmant_pd(bits_of64((double)value(b)), interval, sign)));
}

/* Halved or doubled bit by bit on an integer mantissa, rounded to nearest even where bits fall off. */
uint32_t ref_scale_ps(uint32_t a, uint32_t b)
{
    int64_t count = (int32_t)b;
    uint32_t sign = a & 0x80000000;
    if (ref_is_nan(a))
        return quiet(a);
    if (a == sign || (a & 0x7fffffff) == 0x7f800000)
        return a;
    int64_t field = a >> 23 & 0xff, m = (a & 0x007fffff) | (field ? 0x00800000 : 0);
    int64_t last = (field ? field : 1) - 150 + count; /* exponent of the last bit */
    for (; m < 0x00800000; last--)
        m *= 2;
    if (last > 104)
        return sign | 0x7f800000;
    bool half = false, more = false;
    for (; last < -149 && m; last++) {
        more = more || half;
        half = m & 1;
        m /= 2;
    }
    m = last < -149 ? 0 : m + (half && (more || m % 2));
    return sign | (m >= 0x00800000 ? (uint32_t)(last + 149) * 0x00800000u + (uint32_t)m : (uint32_t)m);
}

/* Three bits of the table for the seven kinds of number, and the eight things that they may ask for. */
static unsigned action(uint64_t table, double x)
{
    int kind = isnan(x) ? 6 : x == -HUGE_VAL ? 0 : x < 0 ? 1 : x == HUGE_VAL ? 5 : x > 0 ? 4 : signbit(x) ? 2 : 3;
    return (unsigned)(table / (1u << 3 * kind) % 8);
}

uint32_t ref_fixup_ps(uint32_t d, uint32_t b, uint32_t table)
{
    const float asked[8] = {0, -HUGE_VALF, -0.0f, 0.0f, HUGE_VALF, 0, FLT_MAX, -FLT_MAX};
    unsigned n = action(table, (double)value(b));
    return n == 0 ? d : n == 5 ? 0xffc00000 : bits_of(asked[n]);
}

uint32_t ref_fixupnan_ps(uint32_t d, uint32_t a, uint32_t b)
{
    return ref_is_nan(a) ? quiet(a) : ref_fixup_ps(d, a, b);
}

uint64_t ref_fixupnan_pd(uint64_t d, uint64_t a, uint64_t b)
{
    const double asked[8] = {0, -HUGE_VAL, -0.0, 0.0, HUGE_VAL, 0, DBL_MAX, -DBL_MAX};
    unsigned n = action(b, value64(a));
    if (is_nan64(a))
        return quiet64(a);
    return n == 0 ? d : n == 5 ? UINT64_C(0xfff8000000000000) : bits_of64(asked[n]);
}

uint32_t ref_exp223_ps(uint32_t b)
{
    if (b == 0x7fffffff || b == 0x80000000)
        return b == 0x7fffffff ? 0x7f800000 : 0;
    return bits_of((float)exp2l(ldexpl((long double)(int32_t)b, -24)));
}

uint32_t ref_log2_ps(uint32_t b)
{
    float x = value(b);
    if (x != x)
        return quiet(b);
    return x == 0 ? 0xff800000 : x < 0 ? 0xffc00000 : bits_of((float)log2l((long double)x));
}

uint32_t ref_rsqrt23_ps(uint32_t b)
{
    float x = value(b);
    if (x != x)
        return quiet(b);
    return x == 0 ? (b & 0x80000000) | 0x7f800000 : x < 0 ? 0xffc00000 : bits_of((float)(1 / sqrtl((long double)x)));
}

uint32_t ref_exp2lut_ps(uint32_t b) { return bits_of((float)exp2l((long double)(b % 32) / 32)); }
uint32_t ref_log2lut_ps(uint32_t b) { return bits_of((float)log2l(1 + (long double)(b / 0x20000 % 64) / 64)); }

/* 1/sqrt of x taken to [1, 4) by powers of four and there moved to the middle of its 64th or 32nd. */
uint32_t ref_rsqrtlut_ps(uint32_t b)
{
    float x = value(b);
    if (!(x > 0) || isinf(x))
        return ref_rsqrt23_ps(b);
    long double m = (long double)x, factor = 1;
    for (; m >= 4; factor /= 2)
        m /= 4;
    for (; m < 1; factor *= 2)
        m *= 4;
    long double step = m < 2 ? 1 / 64.0L : 1 / 32.0L;
    return bits_of((float)(1 / sqrtl((floorl(m / step) + 0.5L) * step)) * (float)factor);
}
