/* The golden cases of isa-facts section 6 that concern conversions, exponents and transcendentals, by their numbers. */
#include "tests/lrbni/case.h"

static lrb_v16f all_ps(uint32_t bits)
{
    uint32_t lanes[16];
    for (int i = 0; i < 16; i++)
        lanes[i] = bits;
    return case_ps(lanes);
}

static lrb_v16i all_pi(uint32_t bits)
{
    return lrb_castps_pi(all_ps(bits));
}

static lrb_v8d all_pd(uint64_t bits)
{
    uint32_t lanes[16];
    for (int i = 0; i < 8; i++)
        case_set(lanes, true, i, bits);
    return case_pd(lanes);
}

/* The lanes are all the same; their bits. */
static uint32_t lane_of(lrb_i32x16 v)
{
    uint32_t lanes[16];
    lanes_store_pi(lanes, v);
    for (int i = 1; i < 16; i++)
        assert_int_equal(lanes[i], lanes[0]);
    return lanes[0];
}

static uint32_t ps(lrb_v16f v) { return lane_of(lanes_bits_ps(v.lanes)); }
static uint32_t pi(lrb_v16i v) { return lane_of(v.lanes); }

static uint64_t pd(lrb_v8d v)
{
    uint32_t lanes[16];
    lanes_store_pd(lanes, v.lanes);
    for (int i = 1; i < 8; i++)
        assert_true(case_get(lanes, true, i) == case_get(lanes, true, 0));
    return case_get(lanes, true, 0);
}

static uint32_t ps2pi(lrb_ctx *c, float x, lrb_adjust n)
{
    return pi(lrb_cvtps2pi(c, all_ps(lrb_float_bits(x)), LRB_RN, n));
}

static void case23__ps2pi__saturates_and_nan_gives_0(void **state)
{
    assert_int_equal(ps2pi(*state, 0.5f, LRB_ADJUST_NONE), 0);
    assert_int_equal(ps2pi(*state, 1.5f, LRB_ADJUST_NONE), 2);
    assert_int_equal(ps2pi(*state, 2.5f, LRB_ADJUST_NONE), 2);
    assert_int_equal(ps2pi(*state, -0.5f, LRB_ADJUST_NONE), 0);
    assert_int_equal(ps2pi(*state, 0x1p31f, LRB_ADJUST_NONE), 0x7fffffff);
    assert_int_equal(ps2pi(*state, -0x1p31f, LRB_ADJUST_NONE), 0x80000000);
    assert_int_equal(ps2pi(*state, 3e9f, LRB_ADJUST_NONE), 0x7fffffff);
    assert_int_equal(ps2pi(*state, HUGE_VALF, LRB_ADJUST_NONE), 0x7fffffff);
    assert_int_equal(ps2pi(*state, -HUGE_VALF, LRB_ADJUST_NONE), 0x80000000);
    assert_int_equal(pi(lrb_cvtps2pi(*state, all_ps(0x7fc00000), LRB_RN, LRB_ADJUST_NONE)), 0);
    assert_int_equal(pi(lrb_cvtps2pi(*state, all_ps(0xff800001), LRB_RN, LRB_ADJUST_NONE)), 0);
}

static void case24__ps2pi_adjusted__scaled_first_then_rounded(void **state)
{
    assert_int_equal(ps2pi(*state, 1.00390625f, LRB_ADJUST_8), 257);
    assert_int_equal(ps2pi(*state, 127.5f, LRB_ADJUST_24), 2139095040);
    assert_int_equal(ps2pi(*state, 0.5f, LRB_ADJUST_31), 1073741824);
    assert_int_equal(ps2pi(*state, 1.0f, LRB_ADJUST_31), 0x7fffffff);
    /* from fixed point: divided, so that there and back is where it began */
    assert_int_equal(ps(lrb_cvtpi2ps(*state, all_pi(257), LRB_RN, LRB_ADJUST_8)), lrb_float_bits(1.00390625f));
    assert_int_equal(ps(lrb_cvtpu2ps(*state, all_pi(0x80000000), LRB_RN, LRB_ADJUST_32)), lrb_float_bits(0.5f));
}

static void case25__ps2pu__saturates(void **state)
{
    static const struct {
        float x;
        uint32_t expected;
    } cases[] = {{-1.0f, 0}, {-0.5f, 0}, {4294967296.0f, UINT32_MAX}, {3e9f, 3000000000u}};
    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int mode = LRB_RN; mode <= LRB_RZ; mode++)
            assert_int_equal(pi(lrb_cvtps2pu(*state, all_ps(lrb_float_bits(cases[i].x)), (lrb_rounding)mode, LRB_ADJUST_NONE)),
                             cases[i].expected);
    assert_int_equal(pi(lrb_cvtps2pu(*state, all_ps(0x7fc00000), LRB_RN, LRB_ADJUST_NONE)), 0);
}

static void case26__pi2ps__rounds_as_asked(void **state)
{
    static const uint32_t expected[4] = {0x4b800000, 0x4b800000, 0x4b800001, 0x4b800000};
    for (int mode = LRB_RN; mode <= LRB_RZ; mode++)
        assert_int_equal(ps(lrb_cvtpi2ps(*state, all_pi(16777217), (lrb_rounding)mode, LRB_ADJUST_NONE)), expected[mode]);
    assert_int_equal(ps(lrb_cvtpi2ps(*state, all_pi(0x7fffffff), LRB_RN, LRB_ADJUST_NONE)), 0x4f000000);
    assert_int_equal(ps(lrb_cvtpi2ps(*state, all_pi(0x7fffffff), LRB_RZ, LRB_ADJUST_NONE)), 0x4effffff);
    assert_int_equal(ps(lrb_cvtpu2ps(*state, all_pi(0xffffffff), LRB_RN, LRB_ADJUST_NONE)), 0x4f800000);
    assert_int_equal(ps(lrb_cvtpu2ps(*state, all_pi(0xffffffff), LRB_RZ, LRB_ADJUST_NONE)), 0x4f7fffff);
}

static void case27__round__sign_of_zero_kept(void **state)
{
    static const float x[3] = {2.5f, -2.5f, -0.5f};
    static const float expected[3][3] = {{2, -2, -0.0f}, {2, -3, -1}, {3, -2, -0.0f}};
    for (int mode = LRB_RN; mode <= LRB_RU; mode++)
        for (int i = 0; i < 3; i++) {
            assert_int_equal(ps(lrb_round_ps(*state, all_ps(lrb_float_bits(x[i])), (lrb_rounding)mode, LRB_ADJUST_NONE)),
                             lrb_float_bits(expected[mode][i]));
            assert_true(pd(lrb_round_pd(*state, all_pd(lrb_double_bits((double)x[i])), (lrb_rounding)mode, LRB_ADJUST_NONE)) ==
                        lrb_double_bits((double)expected[mode][i]));
        }
    assert_int_equal(ps(lrb_round_ps(*state, all_ps(lrb_float_bits(0.3f)), LRB_RN, LRB_ADJUST_4)), lrb_float_bits(0.3125f));
}

static void case54__pd2ps__low_half_and_zeros(void **state)
{
    uint32_t lanes[16];
    uint64_t tie = lrb_double_bits(1 + 0x1p-24), huge = lrb_double_bits(1e39);
    lrb_v16f old = all_ps(0x7fa5c3c3);
    lanes_store_ps(lanes, lrb_cvtpd2ps(*state, all_pd(tie), LRB_RN).lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i < 8 ? 0x3f800000 : 0);
    lanes_store_ps(lanes, lrb_mask_cvtpd2ps(*state, old, lrb_mask(0xff05), all_pd(huge), LRB_RN).lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i >= 8 ? 0 : 0x05 >> i & 1 ? 0x7f800000 : 0x7fa5c3c3);
    /* the original's forms keep the other half */
    lanes_store_ps(lanes, lrb_cvthi_pd2ps(*state, old, all_pd(tie), LRB_RU).lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i < 8 ? 0x7fa5c3c3 : 0x3f800001);
}

static void case55__scale__rounds_once(void **state)
{
    assert_int_equal(ps(lrb_scale_ps(*state, all_ps(0x3fc00000), all_pi(127))), 0x7f400000);
    assert_int_equal(ps(lrb_scale_ps(*state, all_ps(0x3f800000), all_pi(128))), 0x7f800000);
    assert_int_equal(ps(lrb_scale_ps(*state, all_ps(0x3f800000), all_pi((uint32_t)-150))), 0x00000000);
    assert_int_equal(ps(lrb_scale_ps(*state, all_ps(0x3fc00000), all_pi((uint32_t)-150))), 0x00000001);
    assert_int_equal(ps(lrb_scale_ps(*state, all_ps(0x3f800000), all_pi(0x80000000))), 0x00000000);
}

static void case56__getexp__floor_of_log2(void **state)
{
    assert_int_equal(ps(lrb_getexp_ps(*state, all_ps(lrb_float_bits(0.75f)))), 0xbf800000);
    assert_int_equal(ps(lrb_getexp_ps(*state, all_ps(lrb_float_bits(1.0f)))), 0x00000000);
    assert_int_equal(ps(lrb_getexp_ps(*state, all_ps(0))), 0xff800000);
    assert_int_equal(ps(lrb_getexp_ps(*state, all_ps(lrb_float_bits(-8.0f)))), 0x40400000);
    assert_int_equal(ps(lrb_getexp_ps(*state, all_ps(1))), 0xc3150000);
    assert_true(pd(lrb_getexp_pd(*state, all_pd(1))) == lrb_double_bits(-1074));
}

static void case57__exp223__ends_of_the_range(void **state)
{
    assert_int_equal(ps(lrb_exp223_ps(*state, all_pi(0))), 0x3f800000);
    assert_int_equal(ps(lrb_exp223_ps(*state, all_pi(1 << 24))), 0x40000000);
    assert_int_equal(ps(lrb_exp223_ps(*state, all_pi(0x7fffffff))), 0x7f800000);
    assert_int_equal(ps(lrb_exp223_ps(*state, all_pi(0x80000000))), 0x00000000);
}

static void case58__specials__as_avx512(void **state)
{
    assert_int_equal(ps(lrb_rcp23_ps(*state, all_ps(0x00000000))), 0x7f800000);
    assert_int_equal(ps(lrb_rcp23_ps(*state, all_ps(0x80000000))), 0xff800000);
    assert_int_equal(ps(lrb_rcp23_ps(*state, all_ps(0x7f800000))), 0x00000000);
    assert_int_equal(ps(lrb_rcp23_ps(*state, all_ps(0xff800000))), 0x80000000);
    assert_true(ref_is_nan(ps(lrb_rsqrt23_ps(*state, all_ps(0xbf800000)))));
    assert_int_equal(ps(lrb_log2_ps(*state, all_ps(0x00000000))), 0xff800000);
    assert_int_equal(ps(lrb_log2_ps(*state, all_ps(0x80000000))), 0xff800000);
    assert_true(ref_is_nan(ps(lrb_log2_ps(*state, all_ps(0xbf800000)))));
}

static void case59__reference_values__correctly_rounded(void **state)
{
    assert_int_equal(ps(lrb_rcp23_ps(*state, all_ps(lrb_float_bits(3.0f)))), 0x3eaaaaab);
    assert_int_equal(ps(lrb_rsqrt23_ps(*state, all_ps(lrb_float_bits(2.0f)))), 0x3f3504f3);
    assert_int_equal(ps(lrb_log2_ps(*state, all_ps(lrb_float_bits(3.0f)))), 0x3fcae00d);
    assert_int_equal(ps(lrb_exp223_ps(*state, all_pi(1 << 23))), 0x3fb504f3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case23__ps2pi__saturates_and_nan_gives_0),
        cmocka_unit_test(case24__ps2pi_adjusted__scaled_first_then_rounded),
        cmocka_unit_test(case25__ps2pu__saturates),
        cmocka_unit_test(case26__pi2ps__rounds_as_asked),
        cmocka_unit_test(case27__round__sign_of_zero_kept),
        cmocka_unit_test(case54__pd2ps__low_half_and_zeros),
        cmocka_unit_test(case55__scale__rounds_once),
        cmocka_unit_test(case56__getexp__floor_of_log2),
        cmocka_unit_test(case57__exp223__ends_of_the_range),
        cmocka_unit_test(case58__specials__as_avx512),
        cmocka_unit_test(case59__reference_values__correctly_rounded),
    };
    return cmocka_run_group_tests_name("golden_convert " LRB_BACKEND, tests, case_setup, case_teardown);
}
