/* Conversions and scaling against MPFR in every rounding mode, with the largest error; the tables and seeds of the
 * transcendentals and of sRGB8, computed again. Two million lanes for each conversion and mode. */
#include <mpfr.h>

#include "tests/lrbni/case.h"
#include "lrbni/transcendental_tables.h"

enum { VECTORS = 1 << 17 };

static const mpfr_rnd_t directions[4] = {MPFR_RNDN, MPFR_RNDD, MPFR_RNDU, MPFR_RNDZ};
static const char *const mode_names[4] = {"nearest", "down", "up", "to zero"};
static const lrb_adjust adjusts[] = {LRB_ADJUST_NONE, LRB_ADJUST_4,  LRB_ADJUST_5,  LRB_ADJUST_8,
                                     LRB_ADJUST_16,   LRB_ADJUST_24, LRB_ADJUST_31, LRB_ADJUST_32};

/* An exact source, the result rounded to a float, and the distance between them. */
typedef struct numbers {
    mpfr_t exact, single, error;
    double worst_ulp;
} numbers;

static void numbers_init(numbers *n)
{
    mpfr_init2(n->exact, 64);
    mpfr_init2(n->single, 24);
    mpfr_init2(n->error, 64);
    n->worst_ulp = 0;
}

static void numbers_clear(numbers *n)
{
    mpfr_clears(n->exact, n->single, n->error, (mpfr_ptr)0);
    mpfr_free_cache();
}

/* Bits of the float that MPFR makes of n->exact in that direction; the error is noted unless the exact
 * result is beyond all floats. */
static uint32_t rounded(numbers *n, mpfr_rnd_t direction)
{
    mpfr_exp_t emin = mpfr_get_emin(), emax = mpfr_get_emax();
    mpfr_set_emin(-148);
    mpfr_set_emax(128);
    int ternary = mpfr_set(n->single, n->exact, direction);
    ternary = mpfr_check_range(n->single, ternary, direction);
    mpfr_subnormalize(n->single, ternary, direction);
    mpfr_set_emin(emin);
    mpfr_set_emax(emax);
    float f = mpfr_get_flt(n->single, MPFR_RNDN);
    if (isfinite(f) && mpfr_cmpabs(n->exact, n->single) != 0 && mpfr_get_exp(n->exact) <= 128) {
        int last = lrb_float_bits(f) >> 23 & 0xff ? (int)(lrb_float_bits(f) >> 23 & 0xff) - 150 : -149;
        mpfr_sub(n->error, n->exact, n->single, MPFR_RNDA);
        mpfr_abs(n->error, n->error, MPFR_RNDA);
        mpfr_mul_2si(n->error, n->error, -last, MPFR_RNDA);
        double ulp = mpfr_get_d(n->error, MPFR_RNDA);
        n->worst_ulp = ulp > n->worst_ulp ? ulp : n->worst_ulp;
    }
    return lrb_float_bits(f);
}

static void expect(const char *id, int mode, int adjust, uint64_t b, uint32_t got, uint32_t mpfr)
{
    if (got != mpfr && !(ref_is_nan(got) && ref_is_nan(mpfr)))
        fail_msg("%s(%llx), %s, adjust %d: got %08x, MPFR gives %08x", id, (unsigned long long)b, mode_names[mode], adjust, got, mpfr);
}

static void tell(const char *id, int mode, const numbers *n)
{
    printf("# %s, %s: largest error %.7f ulp\n", id, mode_names[mode], n->worst_ulp);
    assert_true(mode == LRB_RN ? n->worst_ulp <= 0.5 : n->worst_ulp <= 1);
}

static void integers_to_floats(lrb_ctx *c, bool is_signed)
{
    const char *id = is_signed ? "cvtpi2ps" : "cvtpu2ps";
    for (int mode = 0; mode < 4; mode++) {
        base_random random = {.state = 64};
        numbers n;
        numbers_init(&n);
        for (int i = 0; i < VECTORS; i++) {
            uint32_t b[16], out[16];
            lrb_adjust adjust = adjusts[i % 8];
            for (int lane = 0; lane < 16; lane++)
                b[lane] = (uint32_t)base_random_bits(&random) >> (base_random_bits(&random) % 9);
            lanes_store_ps(out, (is_signed ? lrb_cvtpi2ps(c, case_pi(b), (lrb_rounding)mode, adjust)
                                           : lrb_cvtpu2ps(c, case_pi(b), (lrb_rounding)mode, adjust)).lanes);
            for (int lane = 0; lane < 16; lane++) {
                mpfr_set_si(n.exact, is_signed ? (long)(int32_t)b[lane] : (long)b[lane], MPFR_RNDN);
                mpfr_div_2ui(n.exact, n.exact, (unsigned)adjust, MPFR_RNDN);
                expect(id, mode, (int)adjust, b[lane], out[lane], rounded(&n, directions[mode]));
            }
        }
        tell(id, mode, &n);
        numbers_clear(&n);
    }
}

static void pi2ps__every_mode__as_mpfr(void **state) { integers_to_floats(*state, true); }
static void pu2ps__every_mode__as_mpfr(void **state) { integers_to_floats(*state, false); }

/* x in the place of n->exact rounded to an integer between the two ends. */
static uint32_t integer_of(numbers *n, mpfr_rnd_t direction, bool is_signed)
{
    if (mpfr_nan_p(n->exact))
        return 0;
    mpfr_rint(n->exact, n->exact, direction);
    if (mpfr_cmp_d(n->exact, is_signed ? 0x1p31 : 0x1p32) >= 0)
        return is_signed ? INT32_MAX : UINT32_MAX;
    if (mpfr_cmp_d(n->exact, is_signed ? -0x1p31 : 0) <= 0)
        return is_signed ? 0x80000000 : 0;
    return (uint32_t)mpfr_get_si(n->exact, MPFR_RNDN);
}

/* Floats of all exponents between those of 2^-34 and 2^34 over the adjust, and of all others sometimes. */
static void floats_to_integers(lrb_ctx *c, bool is_signed)
{
    const char *id = is_signed ? "cvtps2pi" : "cvtps2pu";
    numbers n;
    numbers_init(&n);
    for (int mode = 0; mode < 4; mode++) {
        base_random random = {.state = 65};
        for (int i = 0; i < VECTORS; i++) {
            uint32_t b[16], out[16];
            lrb_adjust adjust = adjusts[i % 8];
            for (int lane = 0; lane < 16; lane++) {
                uint64_t bits = base_random_bits(&random);
                uint32_t exponent = (uint32_t)(127 - 34 + (int)(bits >> 33) % 68 - (int)adjust);
                b[lane] = lane % 8 ? (exponent & 0xff) << 23 | ((uint32_t)bits & 0x807fffff) : (uint32_t)bits;
            }
            lanes_store_pi(out, (is_signed ? lrb_cvtps2pi(c, case_ps(b), (lrb_rounding)mode, adjust)
                                           : lrb_cvtps2pu(c, case_ps(b), (lrb_rounding)mode, adjust)).lanes);
            for (int lane = 0; lane < 16; lane++) {
                mpfr_set_flt(n.exact, lrb_bits_float(b[lane]), MPFR_RNDN);
                mpfr_mul_2ui(n.exact, n.exact, (unsigned)adjust, MPFR_RNDN);
                expect(id, mode, (int)adjust, b[lane], out[lane], integer_of(&n, directions[mode], is_signed));
            }
        }
    }
    numbers_clear(&n);
}

static void ps2pi__every_mode__as_mpfr(void **state) { floats_to_integers(*state, true); }
static void ps2pu__every_mode__as_mpfr(void **state) { floats_to_integers(*state, false); }

/* Doubles whose exponents are those of floats, subnormal floats and a few beyond. */
static void pd2ps__every_mode__as_mpfr(void **state)
{
    for (int mode = 0; mode < 4; mode++) {
        base_random random = {.state = 66};
        numbers n;
        numbers_init(&n);
        for (int i = 0; i < 2 * VECTORS; i++) {
            uint32_t b[16], out[16];
            for (int lane = 0; lane < 8; lane++) {
                uint64_t bits = base_random_bits(&random), field = 1023 - 155 + base_random_bits(&random) % 288;
                case_set(b, true, lane, lane % 8 ? (bits & 0x800fffffffffffff) | field << 52 : bits);
            }
            lanes_store_ps(out, lrb_cvtpd2ps(*state, case_pd(b), (lrb_rounding)mode).lanes);
            for (int lane = 0; lane < 8; lane++) {
                mpfr_set_d(n.exact, lrb_bits_double(case_get(b, true, lane)), MPFR_RNDN);
                expect("cvtpd2ps", mode, 0, case_get(b, true, lane), out[lane], rounded(&n, directions[mode]));
            }
        }
        tell("cvtpd2ps", mode, &n);
        numbers_clear(&n);
    }
}

static void scale__random_counts__as_mpfr(void **state)
{
    base_random random = {.state = 67};
    numbers n;
    numbers_init(&n);
    for (int i = 0; i < VECTORS; i++) {
        uint32_t a[16], b[16], out[16];
        for (int lane = 0; lane < 16; lane++) {
            a[lane] = random_bits(&random);
            b[lane] = lane % 8 ? (uint32_t)((int)(base_random_bits(&random) % 600) - 300) : (uint32_t)base_random_bits(&random);
        }
        lanes_store_ps(out, lrb_scale_ps(*state, case_ps(a), case_pi(b)).lanes);
        for (int lane = 0; lane < 16; lane++) {
            mpfr_set_flt(n.exact, lrb_bits_float(a[lane]), MPFR_RNDN);
            mpfr_mul_2si(n.exact, n.exact, (int32_t)b[lane] > 999 ? 999 : (int32_t)b[lane] < -999 ? -999 : (int32_t)b[lane], MPFR_RNDN);
            expect("scale_ps", LRB_RN, 0, a[lane], out[lane], rounded(&n, MPFR_RNDN));
        }
    }
    tell("scale_ps", LRB_RN, &n);
    numbers_clear(&n);
}

/* round(2^power * x) is the entry of a table. */
static void expect_entry(const char *table, int i, uint64_t entry, mpfr_t x, int power)
{
    mpfr_mul_2si(x, x, power, MPFR_RNDN);
    uint64_t expected = mpfr_get_ui(x, MPFR_RNDN);
    if (entry != expected)
        fail_msg("%s[%d]: %016llx, MPFR gives %016llx", table, i, (unsigned long long)entry, (unsigned long long)expected);
}

static void transcendental_tables__every_entry__as_mpfr(void **state)
{
    (void)state;
    mpfr_t x, y;
    mpfr_inits2(200, x, y, (mpfr_ptr)0);
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 64; i++) {
            mpfr_set_ui_2exp(x, (unsigned)i, -6 * (k + 1), MPFR_RNDN);
            mpfr_exp2(x, x, MPFR_RNDN);
            expect_entry("lrb_exp2_digits", 64 * k + i, lrb_exp2_digits[k][i], x, 63);
        }
    for (int i = 0; i < 64; i++) {
        mpfr_set_ui_2exp(x, lrb_log2_reciprocal((uint32_t)i), -16, MPFR_RNDN);
        mpfr_log2(x, x, MPFR_RNDN);
        mpfr_neg(x, x, MPFR_RNDN);
        expect_entry("lrb_log2_first", i, lrb_log2_first[i], x, 63);
        mpfr_set_ui_2exp(x, 4096 - (unsigned)i, -12, MPFR_RNDN);
        mpfr_log2(x, x, MPFR_RNDN);
        mpfr_neg(x, x, MPFR_RNDN);
        expect_entry("lrb_log2_second", i, lrb_log2_second[i], x, 63);
    }
    for (int k = 1; k <= 5; k++) {
        mpfr_const_log2(x, MPFR_RNDN);
        mpfr_mul_ui(x, x, (unsigned)k, MPFR_RNDN);
        mpfr_ui_div(x, 1, x, MPFR_RNDN);
        expect_entry("lrb_log2_series", k - 1, lrb_log2_series[k - 1], x, 62);
    }
    mpfr_clears(x, y, (mpfr_ptr)0);
    mpfr_free_cache();
}

/* Entry k - 1 is the smallest float that is not below the linear value of c = (k - 0.5) / 255. */
static void srgb8_thresholds__every_entry__as_mpfr(void **state)
{
    (void)state;
    mpfr_t x, gamma;
    mpfr_inits2(200, x, gamma, (mpfr_ptr)0);
    mpfr_set_str(gamma, "2.4", 10, MPFR_RNDN);
    for (unsigned k = 1; k < 256; k++) {
        mpfr_set_ui(x, 2 * k - 1, MPFR_RNDN);
        mpfr_div_ui(x, x, 510, MPFR_RNDN);
        mpfr_mul_ui(x, x, 1000, MPFR_RNDN); /* decimals are thousandths, exactly */
        if (mpfr_cmp_d(x, 40.45) <= 0) {
            mpfr_div_ui(x, x, 12920, MPFR_RNDN);
        } else {
            mpfr_add_ui(x, x, 55, MPFR_RNDN);
            mpfr_div_ui(x, x, 1055, MPFR_RNDN);
            mpfr_pow(x, x, gamma, MPFR_RNDN);
        }
        if (lrb_srgb8_thresholds[k - 1] != mpfr_get_flt(x, MPFR_RNDU))
            fail_msg("code %u begins at %a, MPFR gives %a", k, (double)lrb_srgb8_thresholds[k - 1], (double)mpfr_get_flt(x, MPFR_RNDU));
    }
    mpfr_clears(x, gamma, (mpfr_ptr)0);
    mpfr_free_cache();
}

/* Every entry of the seeds' tables, by MPFR; and how far the seeds are from what they estimate, over every mantissa. */
static void seeds__every_entry__rounded_by_mpfr(void **state)
{
    numbers n;
    numbers_init(&n);
    for (uint32_t i = 0; i < 128; i += 16) {
        uint32_t b[16], out[3][16];
        for (uint32_t lane = 0; lane < 16; lane++)
            b[lane] = (0x3f800000 + ((i + lane) << 17)) | (i + lane); /* exponent 0, then 1 */
        lanes_store_ps(out[0], lrb_exp2lut_ps(*state, case_ps(b)).lanes);
        lanes_store_ps(out[1], lrb_log2lut_ps(*state, case_ps(b)).lanes);
        lanes_store_ps(out[2], lrb_rsqrtlut_ps(*state, case_ps(b)).lanes);
        for (uint32_t lane = 0; lane < 16; lane++) {
            uint32_t mantissa = (i + lane) % 64, octave = (i + lane) / 64;
            mpfr_set_ui_2exp(n.exact, (i + lane) % 32, -5, MPFR_RNDN);
            mpfr_exp2(n.exact, n.exact, MPFR_RNDN);
            expect("exp2lut_ps", 0, 0, b[lane], out[0][lane], rounded(&n, MPFR_RNDN));
            mpfr_set_ui_2exp(n.exact, 64 + mantissa, -6, MPFR_RNDN);
            mpfr_log2(n.exact, n.exact, MPFR_RNDN);
            expect("log2lut_ps", 0, 0, b[lane], out[1][lane], rounded(&n, MPFR_RNDN));
            mpfr_set_ui_2exp(n.exact, 129 + 2 * mantissa, -7 + (int)octave, MPFR_RNDN);
            mpfr_rec_sqrt(n.exact, n.exact, MPFR_RNDN);
            expect("rsqrtlut_ps", 0, 0, b[lane], out[2][lane], rounded(&n, MPFR_RNDN));
        }
    }
    numbers_clear(&n);
}

static void seeds__every_mantissa__within_their_bounds(void **state)
{
    double worst_root = 0, worst_log = 0;
    for (uint32_t first = 0x3f800000; first < 0x40800000; first += 16) {
        uint32_t b[16];
        float root[16], logarithm[16];
        for (uint32_t i = 0; i < 16; i++)
            b[i] = first + i;
        lanes_store_ps(root, lrb_rsqrtlut_ps(*state, case_ps(b)).lanes);
        lanes_store_ps(logarithm, lrb_log2lut_ps(*state, case_ps(b)).lanes);
        for (int i = 0; i < 16; i++) {
            double x = (double)lrb_bits_float(b[i]), m = x >= 2 ? x / 2 : x;
            double relative = fabs((double)root[i] * sqrt(x) - 1), below = log2(m) - (double)logarithm[i];
            worst_root = relative > worst_root ? relative : worst_root;
            worst_log = below > worst_log ? below : worst_log;
            assert_true(below > -0x1p-24);
        }
    }
    printf("# rsqrtlut: largest relative error 2^%.4f; log2lut: %.6f below the logarithm at most\n", log2(worst_root), worst_log);
    assert_true(worst_root < 0x1p-8 && worst_log < 0.0224);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pi2ps__every_mode__as_mpfr),
        cmocka_unit_test(pu2ps__every_mode__as_mpfr),
        cmocka_unit_test(ps2pi__every_mode__as_mpfr),
        cmocka_unit_test(ps2pu__every_mode__as_mpfr),
        cmocka_unit_test(pd2ps__every_mode__as_mpfr),
        cmocka_unit_test(scale__random_counts__as_mpfr),
        cmocka_unit_test(transcendental_tables__every_entry__as_mpfr),
        cmocka_unit_test(srgb8_thresholds__every_entry__as_mpfr),
        cmocka_unit_test(seeds__every_entry__rounded_by_mpfr),
        cmocka_unit_test(seeds__every_mantissa__within_their_bounds),
    };
    return cmocka_run_group_tests_name("mpfr_convert " LRB_BACKEND, tests, case_setup, case_teardown);
}
