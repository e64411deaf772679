/* The transcendentals against MPFR: correctly rounded for every float there is, with argument 'all'; otherwise for a seeded
 * sample of the mantissas with every exponent.
 *
 * MPFR gives what depends on the mantissa alone, to 96 bits after the point and whether anything was cut off: log2(m), 2^f,
 * 1/m, 1/sqrt(m) and 1/sqrt(2m). What the exponent adds is exact in integers: a sum, or a power of two. So each
 * input's exact result is known well enough to be rounded without doubt, and MPFR works once for each mantissa.
 */
#include <mpfr.h>
#include <stdlib.h>

#include "tests/lrbni/case.h"

__extension__ typedef unsigned __int128 wide;
__extension__ typedef __int128 signed_wide;

enum { POINT = 96, PRECISION = 160, MANTISSAS = 1 << 23, FRACTIONS = 1 << 24, SAMPLE = 1 << 16 };

static bool all;         /* every mantissa, not a sample */
static double worst_ulp; /* largest error seen since it was set to 0 */

/* x, in [0, 4), times 2^96; the last bit is set if anything was cut off, now or before. */
static wide fixed(mpfr_t x, int inexact)
{
    mpfr_mul_2ui(x, x, 48, MPFR_RNDZ);
    uint64_t high = mpfr_get_ui(x, MPFR_RNDZ);
    mpfr_sub_ui(x, x, high, MPFR_RNDZ);
    mpfr_mul_2ui(x, x, 48, MPFR_RNDZ);
    uint64_t low = mpfr_get_ui(x, MPFR_RNDZ);
    return (wide)high << 48 | low | (inexact != 0 || mpfr_cmp_ui(x, low) != 0);
}

static int leading_bit(wide m)
{
    return m >> 64 ? 127 - __builtin_clzll((uint64_t)(m >> 64)) : 63 - __builtin_clzll((uint64_t)m);
}

/* Bits of the float nearest to m * 2^unit, m not 0, ties to even; *ulp: how far it is from that, in units of its last
 * place, unless it is infinite. */
static uint32_t nearest(wide m, int unit, double *ulp)
{
    int top = leading_bit(m) + unit;
    *ulp = 0;
    if (top > 127)
        return 0x7f800000;
    int drop = top < -126 ? -149 - unit : top - 23 - unit;
    wide kept = drop > 127 ? 0 : drop > 0 ? m >> drop : m << -drop;
    wide rest = drop > 127 ? 0 : drop > 0 ? m & (((wide)1 << drop) - 1) : 0, half = drop > 0 && drop < 129 ? (wide)1 << (drop - 1) : 1;
    bool up = rest > half || (rest == half && (kept & 1));
    *ulp = drop > 0 ? ldexp((double)(up ? ((wide)1 << drop) - rest : rest), -drop) : 0;
    uint32_t bits = (uint32_t)(kept + up);
    return top < -126 ? bits : bits + ((uint32_t)(top + 126) << 23);
}

static void expect_float(const char *id, uint32_t x, uint32_t got, uint32_t sign, wide m, int unit)
{
    double ulp;
    uint32_t expected = sign | nearest(m, unit, &ulp);
    if (got != expected)
        fail_msg("%s(%08x): got %08x, the exact result rounds to %08x", id, x, got, expected);
    if (ulp > worst_ulp)
        worst_ulp = ulp;
}

/* The floats with that mantissa and exponent fields `first` to `first` + 15, where there are such. A subnormal number is its
 * normalised mantissa times a power below 2^-126, if that mantissa has the zeros at its end for it. */
static void sixteen_exponents(uint32_t mantissa, int first, uint32_t x[16])
{
    for (int i = 0; i < 16; i++) {
        int field = first + i;
        uint32_t whole = mantissa | 0x00800000;
        if (field > 254)
            x[i] = 0x3f800000;
        else if (field > 0)
            x[i] = (uint32_t)field << 23 | mantissa;
        else
            x[i] = whole & ((1u << (1 - field)) - 1) ? 0x3f800000 : whole >> (1 - field);
    }
}

enum { FIRST_FIELD = -22 }; /* of the smallest subnormal, normalised */

/* A float with the wanted exponent field is in that place; those that there are none for were replaced by 1. */
static bool is_there(uint32_t x, uint32_t mantissa) { return x != 0x3f800000 || mantissa == 0; }

/* The exponent of the leading bit of a positive float. */
static int exponent_of(uint32_t x) { return x >> 23 ? (int)(x >> 23) - 127 : leading_bit(x) - 149; }

static void log2_of_mantissa(lrb_ctx *c, uint32_t mantissa, mpfr_t t)
{
    mpfr_set_ui_2exp(t, mantissa | 0x00800000, -23, MPFR_RNDZ);
    int inexact = mpfr_log2(t, t, MPFR_RNDZ);
    signed_wide fraction = (signed_wide)fixed(t, inexact);
    for (int first = FIRST_FIELD; first < 255; first += 16) {
        uint32_t x[16], out[16];
        sixteen_exponents(mantissa, first, x);
        lanes_store_ps(out, lrb_log2_ps(c, case_ps(x)).lanes);
        for (int i = 0; i < 16; i++) {
            if (!is_there(x[i], mantissa))
                continue;
            signed_wide sum = ((signed_wide)exponent_of(x[i]) * ((signed_wide)1 << POINT)) + fraction;
            if (sum == 0)
                assert_int_equal(out[i], 0);
            else
                expect_float("log2_ps", x[i], out[i], sum < 0 ? 0x80000000 : 0, (wide)(sum < 0 ? -sum : sum), -POINT);
        }
    }
}

static void reciprocal_of_mantissa(lrb_ctx *c, uint32_t mantissa, mpfr_t t)
{
    mpfr_set_ui_2exp(t, mantissa | 0x00800000, -23, MPFR_RNDZ);
    int inexact = mpfr_ui_div(t, 1, t, MPFR_RNDZ);
    wide m = fixed(t, inexact);
    for (int first = FIRST_FIELD; first < 255; first += 16) {
        uint32_t x[16], out[16];
        sixteen_exponents(mantissa, first, x);
        lanes_store_ps(out, lrb_rcp23_ps(c, case_ps(x)).lanes);
        for (int i = 0; i < 16; i++)
            if (is_there(x[i], mantissa))
                expect_float("rcp23_ps", x[i], out[i], 0, m, -POINT - exponent_of(x[i]));
    }
}

static void root_of_mantissa(lrb_ctx *c, uint32_t mantissa, mpfr_t t)
{
    wide m[2];
    for (int odd = 0; odd < 2; odd++) {
        mpfr_set_ui_2exp(t, mantissa | 0x00800000, -23 + odd, MPFR_RNDZ);
        int inexact = mpfr_rec_sqrt(t, t, MPFR_RNDZ);
        m[odd] = fixed(t, inexact);
    }
    for (int first = FIRST_FIELD; first < 255; first += 16) {
        uint32_t x[16], out[16];
        sixteen_exponents(mantissa, first, x);
        lanes_store_ps(out, lrb_rsqrt23_ps(c, case_ps(x)).lanes);
        for (int i = 0; i < 16; i++) {
            int e = exponent_of(x[i]), odd = e & 1;
            if (is_there(x[i], mantissa))
                expect_float("rsqrt23_ps", x[i], out[i], 0, m[odd], -POINT - (e - odd) / 2);
        }
    }
}

static void power_of_fraction(lrb_ctx *c, uint32_t fraction, mpfr_t t)
{
    mpfr_set_ui_2exp(t, fraction, -24, MPFR_RNDZ);
    int inexact = mpfr_exp2(t, t, MPFR_RNDZ);
    wide m = fixed(t, inexact);
    for (int first = -128; first < 128; first += 16) {
        uint32_t x[16], out[16];
        for (int i = 0; i < 16; i++)
            x[i] = (uint32_t)(first + i) << 24 | fraction;
        lanes_store_ps(out, lrb_exp223_ps(c, case_pi(x)).lanes);
        for (int i = 0; i < 16; i++)
            if (x[i] != 0x7fffffff && x[i] != 0x80000000)
                expect_float("exp223_ps", x[i], out[i], 0, m, first + i - POINT);
    }
}

typedef void mantissa_fn(lrb_ctx *c, uint32_t mantissa, mpfr_t t);

/* All `count` mantissas or fractions, or a sample and the first and last of them. */
static void every(const char *id, mantissa_fn *fn, uint32_t count, lrb_ctx *c)
{
    base_random random = {.state = 62};
    uint32_t tried = all ? count : SAMPLE;
    mpfr_t t;
    mpfr_init2(t, PRECISION);
    worst_ulp = 0;
    for (uint32_t n = 0; n < tried; n++) {
        uint32_t edge = n < 64 ? n : n < 128 ? count - 1 - (n - 64) : (uint32_t)base_random_bits(&random) % count;
        lrb_ctx_begin(c);
        fn(c, all ? n : edge, t);
    }
    mpfr_clear(t);
    mpfr_free_cache();
    printf("# %s: %u of %u mantissas with every exponent, largest error %.7f ulp\n", id, tried, count, worst_ulp);
    assert_true(worst_ulp <= 0.5);
}

static void log2__every_exponent__correctly_rounded(void **state) { every("log2_ps", log2_of_mantissa, MANTISSAS, *state); }
static void rcp23__every_exponent__correctly_rounded(void **state) { every("rcp23_ps", reciprocal_of_mantissa, MANTISSAS, *state); }
static void rsqrt23__every_exponent__correctly_rounded(void **state) { every("rsqrt23_ps", root_of_mantissa, MANTISSAS, *state); }
static void exp223__every_exponent__correctly_rounded(void **state) { every("exp223_ps", power_of_fraction, FRACTIONS, *state); }

/* 1/x and log2 of the other sign: the reciprocal's mirror image, and not a number. */
static void negative__every_exponent__mirrored_or_nan(void **state)
{
    base_random random = {.state = 63};
    for (uint32_t n = 0; n < (all ? 1u << 27 : 1u << 16); n++) {
        uint32_t x[16], minus[16], out[16], mirrored[16];
        for (uint32_t i = 0; i < 16; i++) {
            uint32_t bits = all ? 16 * n + i : (uint32_t)base_random_bits(&random) & 0x7fffffff;
            x[i] = bits == 0 || bits > 0x7f800000 ? 0x3f800000 : bits;
            minus[i] = x[i] | 0x80000000;
        }
        lrb_ctx_begin(*state);
        lanes_store_ps(out, lrb_rcp23_ps(*state, case_ps(x)).lanes);
        lanes_store_ps(mirrored, lrb_rcp23_ps(*state, case_ps(minus)).lanes);
        for (int i = 0; i < 16; i++)
            assert_int_equal(mirrored[i], out[i] ^ 0x80000000);
        lanes_store_ps(out, lrb_log2_ps(*state, case_ps(minus)).lanes);
        lanes_store_ps(mirrored, lrb_rsqrt23_ps(*state, case_ps(minus)).lanes);
        for (int i = 0; i < 16; i++)
            assert_true(out[i] == 0xffc00000 && mirrored[i] == 0xffc00000);
    }
}

int main(int argc, char **argv)
{
    all = argc > 1 && strcmp(argv[1], "all") == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(log2__every_exponent__correctly_rounded),
        cmocka_unit_test(rcp23__every_exponent__correctly_rounded),
        cmocka_unit_test(rsqrt23__every_exponent__correctly_rounded),
        cmocka_unit_test(exp223__every_exponent__correctly_rounded),
        cmocka_unit_test(negative__every_exponent__mirrored_or_nan),
    };
    return cmocka_run_group_tests_name("every_float " LRB_BACKEND, tests, case_setup, case_teardown);
}
