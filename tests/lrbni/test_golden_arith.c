/* The golden cases of isa-facts section 6 about float arithmetic in other states than the default, doubles, negated sums, the
 * minima of Knights Corner and the ops of graphics, by their numbers. */
#define LRB_CONTROL 1
#include "tests/lrbni/case.h"

static lrb_v16f all(uint32_t bits)
{
    uint32_t lanes[16];
    for (int i = 0; i < 16; i++)
        lanes[i] = bits;
    return case_ps(lanes);
}

static lrb_v8d all_pd(uint64_t bits)
{
    uint32_t lanes[16];
    for (int i = 0; i < 8; i++)
        case_set(lanes, true, i, bits);
    return case_pd(lanes);
}

static void expect(lrb_v16f v, uint32_t bits)
{
    uint32_t lanes[16];
    lanes_store_ps(lanes, v.lanes);
    for (int i = 0; i < 16; i++)
        if (lanes[i] != bits)
            fail_msg("lane %d: got %08x, expected %08x", i, lanes[i], bits);
}

static void expect_pd(lrb_v8d v, uint64_t bits)
{
    uint32_t lanes[16];
    lanes_store_pd(lanes, v.lanes);
    for (int i = 0; i < 8; i++)
        if (case_get(lanes, true, i) != bits)
            fail_msg("lane %d: got %llx, expected %llx", i, (unsigned long long)case_get(lanes, true, i), (unsigned long long)bits);
}

/* The state as ldvxcsr sets it: 0x8000 flush-to-zero, 0x0040 denormals-are-zero, rounding in 0x6000. */
static void set_state(lrb_ctx *c, uint32_t bits)
{
    lrb_ptr p = lrb_segment_at(c->scratch, 0);
    lrb_store32(c, lrb_at(p, 0), lrb_imm(bits));
    lrb_ldvxcsr(c, lrb_at(p, 0));
}

static int reset(void **state)
{
    lrb_ctx_begin(*state);
    return 0;
}

static void case2__fma_of_doubles__rounds_once(void **state)
{
    lrb_v8d a = all_pd(0x3ff0000002000000), d = all_pd(0xbff0000004000000);
    expect_pd(lrb_madd231_pd(*state, d, a, a), 0x3c90000000000000);
    expect_pd(lrb_madd213_pd(*state, a, a, d), 0x3c90000000000000);
    expect_pd(lrb_madd132_pd(*state, a, d, a), 0x3c90000000000000);
}

static void case4__msubr__zero_by_the_rounding_mode(void **state)
{
    lrb_v16f one = all(0x3f800000);
    expect(lrb_msubr231_ps(*state, one, one, one), 0x00000000);
    expect(lrb_msubr231_round_ps(*state, one, one, one, LRB_RD), 0x80000000);
    set_state(*state, 0x2000);
    expect(lrb_msubr231_ps(*state, one, one, one), 0x80000000);
}

static void case5__maddn__sum_of_the_negated(void **state)
{
    lrb_v16f one = all(0x3f800000), minus_one = all(0xbf800000);
    expect(lrb_maddn231_ps(*state, minus_one, one, one), 0x00000000);
    expect_pd(lrb_maddn231_pd(*state, all_pd(0xbff0000000000000), all_pd(0x3ff0000000000000), all_pd(0x3ff0000000000000)), 0);
}

static void case6__sums__four_rounding_modes(void **state)
{
    static const uint32_t up[4] = {0x3f800000, 0x3f800000, 0x3f800001, 0x3f800000};   /* 1 + 2^-24 */
    static const uint32_t down[4] = {0xbf800000, 0xbf800001, 0xbf800000, 0xbf800000}; /* -1 - 2^-24 */
    for (unsigned mode = 0; mode < 4; mode++) {
        lrb_ctx_begin(*state);
        expect(lrb_add_round_ps(*state, all(0x3f800000), all(0x33800000), (lrb_rounding)mode), up[mode]);
        expect(lrb_sub_round_ps(*state, all(0xbf800000), all(0x33800000), (lrb_rounding)mode), down[mode]);
        set_state(*state, mode << 13);
        expect(lrb_add_ps(*state, all(0x3f800000), all(0x33800000)), up[mode]);
        expect(lrb_sub_ps(*state, all(0xbf800000), all(0x33800000)), down[mode]);
    }
}

static void case7__x_minus_x__negative_when_rounding_down(void **state)
{
    for (unsigned mode = 0; mode < 4; mode++) {
        set_state(*state, mode << 13);
        expect(lrb_sub_ps(*state, all(0x3f800001), all(0x3f800001)), mode == LRB_RD ? 0x80000000 : 0);
        expect_pd(lrb_sub_pd(*state, all_pd(1), all_pd(1)), mode == LRB_RD ? UINT64_C(0x8000000000000000) : 0);
    }
}

static void case8_9__subnormals__kept_or_zero(void **state)
{
    lrb_v16f half = all(0x3f000000), least = all(0x00800000), minus_least = all(0x80800000), one_bit = all(0x00000001);
    expect(lrb_mul_ps(*state, least, half), 0x00400000);
    expect(lrb_add_ps(*state, one_bit, one_bit), 0x00000002);
    set_state(*state, 0x8000);
    expect(lrb_mul_ps(*state, least, half), 0x00000000);
    expect(lrb_mul_ps(*state, minus_least, half), 0x80000000);
    set_state(*state, 0x0040);
    expect(lrb_add_ps(*state, one_bit, one_bit), 0x00000000);
    expect(lrb_mul_ps(*state, least, half), 0x00400000);
    set_state(*state, 0x8040); /* what the compiler's start-up code for Knights Corner sets */
    expect(lrb_add_ps(*state, one_bit, one_bit), 0x00000000);
    expect(lrb_mul_ps(*state, minus_least, half), 0x80000000);
}

static void case10__tiny__judged_after_rounding(void **state)
{
    lrb_v16f least = all(0x00800000), below_one = all(0x3f7fffff);
    expect(lrb_mul_ps(*state, least, below_one), 0x00800000);
    set_state(*state, 0x8000);
    expect(lrb_mul_ps(*state, least, below_one), 0x00000000);
    /* 2^-126 - 2^-151, a tie between the largest number of 24 bits below 2^-126 and 2^-126: up, to the even one; not tiny */
    expect(lrb_madd231_ps(*state, least, all(0x80000001), all(0x3e800000)), 0x00800000);
}

static void case11__addn__sum_of_the_negated(void **state)
{
    lrb_v16f one = all(0x3f800000), minus_one = all(0xbf800000);
    expect(lrb_addn_ps(*state, one, minus_one), 0x00000000);
    expect(lrb_addn_ps(*state, minus_one, one), 0x00000000);
    expect(lrb_addn_ps(*state, one, one), 0xc0000000);
    expect(lrb_addn_ps(*state, all(0), all(0)), 0x80000000);
    expect(lrb_addn_ps(*state, all(0x7fc00011), one), 0x7fc00011); /* the sign of a NaN is not changed */
    expect_pd(lrb_addn_pd(*state, all_pd(0x3ff0000000000000), all_pd(0xbff0000000000000)), 0);
    set_state(*state, 0x2000);
    expect(lrb_addn_ps(*state, one, minus_one), 0x80000000);
}

static void case12_13__doubles__as_floats(void **state)
{
    lrb_v8d infinity = all_pd(0x7ff0000000000000), minus_infinity = all_pd(0xfff0000000000000), one = all_pd(0x3ff0000000000000);
    expect_pd(lrb_sub_pd(*state, infinity, infinity), 0xfff8000000000000);
    expect_pd(lrb_add_pd(*state, infinity, minus_infinity), 0xfff8000000000000);
    expect_pd(lrb_mul_pd(*state, all_pd(0), infinity), 0xfff8000000000000);
    expect_pd(lrb_add_pd(*state, all_pd(0x7ff0000000000001), one), 0x7ff8000000000001);
    expect_pd(lrb_add_pd(*state, all_pd(0x7ff8000000000011), all_pd(0xfff8000000000022)), 0x7ff8000000000011);
    set_state(*state, 0x6000); /* the same in every state */
    expect_pd(lrb_sub_pd(*state, infinity, infinity), 0xfff8000000000000);
    expect_pd(lrb_add_pd(*state, all_pd(0x7ff0000000000001), one), 0x7ff8000000000001);
    expect(lrb_add_ps(*state, all(0x7fc00011), all(0xffc00022)), 0x7fc00011);
    expect(lrb_mul_ps(*state, all(0), all(0xff800000)), 0xffc00000);
}

static void case14_15__gmin_gmax__the_number_or_the_first_nan(void **state)
{
    lrb_v16f one = all(0x3f800000), nan = all(0x7fc00000);
    expect(lrb_gmin_ps(*state, one, nan), 0x3f800000);
    expect(lrb_gmin_ps(*state, nan, one), 0x3f800000);
    expect(lrb_gmax_ps(*state, nan, one), 0x3f800000);
    expect(lrb_gmin_ps(*state, all(0x7f800001), all(0x7fc00022)), 0x7fc00001);
    expect_pd(lrb_gmax_pd(*state, all_pd(0x7ff0000000000001), all_pd(0x7ff8000000000022)), 0x7ff8000000000001);
}

static void case16__gmin_gmax__zeros_by_their_place(void **state)
{
    lrb_v16f plus = all(0), minus = all(0x80000000);
    expect(lrb_gmin_ps(*state, plus, minus), 0x80000000);
    expect(lrb_gmin_ps(*state, minus, plus), 0x00000000);
    expect(lrb_gmax_ps(*state, plus, minus), 0x00000000);
    expect(lrb_gmax_ps(*state, minus, plus), 0x80000000);
}

static void case17__min_max_of_doubles__second_source(void **state)
{
    lrb_v8d one = all_pd(0x3ff0000000000000), nan = all_pd(0x7ff8000000000055);
    expect_pd(lrb_min_pd(*state, one, nan), 0x7ff8000000000055);
    expect_pd(lrb_max_pd(*state, nan, one), 0x3ff0000000000000);
    expect_pd(lrb_min_pd(*state, all_pd(0), all_pd(0x8000000000000000)), 0x8000000000000000);
}

static void case18__gmaxabs__larger_size(void **state)
{
    expect(lrb_gmaxabs_ps(*state, all(0xc0400000), all(0x40000000)), 0x40400000);
    expect(lrb_maxabs_ps(*state, all(0xc0400000), all(0x40000000)), 0x40400000);
}

static void case19__compares_of_doubles__eight_predicates(void **state)
{
    lrb_v8d nan = all_pd(0x7ff8000000000000), one = all_pd(0x3ff0000000000000);
    lrb_k16 k = lrb_cmpunord_pd(*state, nan, one);
    assert_int_equal(k.bits, 0x00ff);
    assert_int_equal(lrb_cmpeq_pd(*state, nan, one).bits, 0);
    assert_int_equal(lrb_cmpneq_pd(*state, nan, one).bits, 0x00ff);
    assert_int_equal(lrb_cmpnlt_pd(*state, nan, one).bits, 0x00ff);
    assert_int_equal(lrb_cmpord_pd(*state, one, one).bits, 0x00ff);
    assert_int_equal(lrb_cmpeq_pd(*state, all_pd(0), all_pd(0x8000000000000000)).bits, 0x00ff);
    assert_int_equal(lrb_mask_cmpeq_pd(*state, lrb_mask(0xff0f), one, one).bits, 0x000f);
}

static void case35__clampz__range_from_zero(void **state)
{
    lrb_v16f ten = all(0x41200000), nan = all(0x7fc00000), minus_nan = all(0xffc00000);
    expect(lrb_clampz_ps(*state, all(0xc0a00000), ten), 0x00000000);         /* -5 */
    expect(lrb_clampz_ps(*state, all(0x41700000), ten), 0x41200000);         /* 15 */
    expect(lrb_clampz_ps(*state, all(0x40e00000), ten), 0x40e00000);         /* 7 */
    expect(lrb_clampz_ps(*state, all(0x40a00000), all(0xbf800000)), 0x80000000); /* 5 in -1..0 */
    expect(lrb_clampz_ps(*state, all(0xc0a00000), all(0xbf800000)), 0xbf800000); /* -5 in -1..0 */
    expect(lrb_clampz_ps(*state, all(0xbf800000), nan), 0x80000000);
    expect(lrb_clampz_ps(*state, all(0x3f800000), minus_nan), 0x00000000);
    expect(lrb_clampz_ps(*state, minus_nan, nan), 0x00000000);
}

static void case36__addsets__sign_of_the_sum(void **state)
{
    lrb_v16f one = all(0x3f800000);
    lrb_k16 signs;
    lrb_addsets_ps(*state, all(0xbf800000), one, &signs);
    assert_int_equal(signs.bits, 0);
    lrb_addsets_ps(*state, all(0xc0000000), one, &signs);
    assert_int_equal(signs.bits, 0xffff);
    lrb_addsets_ps(*state, all(0x80000000), all(0x80000000), &signs);
    assert_int_equal(signs.bits, 0xffff);
}

static void case37__madd233__scale_and_bias_of_the_group(void **state)
{
    float lanes[16], pairs[16], out[16];
    for (int i = 0; i < 16; i++) {
        lanes[i] = (float)(i + 1);
        pairs[i] = i % 4 == 0 ? 10.0f : i % 4 == 1 ? 3.0f : -1000.0f;
    }
    lrb_v16f a = {.lanes = lanes_load_ps(lanes)}, b = {.lanes = lanes_load_ps(pairs)};
    lanes_store_ps(out, lrb_madd233_ps(*state, a, b).lanes);
    for (int i = 0; i < 16; i++)
        assert_true(out[i] == 3.0f * (float)(i + 1) + 10.0f); /* 13, 16, 19, 22, ... */
}

static void case42__blend__bit_1_takes_the_second(void **state)
{
    uint32_t lanes[16];
    lanes_store_ps(lanes, lrb_blendm_ps(*state, lrb_mask(0xaaaa), all(1), all(2)).lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i % 2 ? 2 : 1);
}

static void case53__mask_of_doubles__low_eight_bits(void **state)
{
    uint32_t lanes[16];
    lrb_v8d one = all_pd(0x3ff0000000000000);
    lanes_store_pd(lanes, lrb_mask_add_pd(*state, all_pd(7), lrb_mask(0xff0f), one, one).lanes);
    for (int i = 0; i < 8; i++)
        assert_true(case_get(lanes, true, i) == (i < 4 ? UINT64_C(0x4000000000000000) : 7));
}

#define CASE(name) cmocka_unit_test_setup(name, reset)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(case2__fma_of_doubles__rounds_once),
        CASE(case4__msubr__zero_by_the_rounding_mode),
        CASE(case5__maddn__sum_of_the_negated),
        CASE(case6__sums__four_rounding_modes),
        CASE(case7__x_minus_x__negative_when_rounding_down),
        CASE(case8_9__subnormals__kept_or_zero),
        CASE(case10__tiny__judged_after_rounding),
        CASE(case11__addn__sum_of_the_negated),
        CASE(case12_13__doubles__as_floats),
        CASE(case14_15__gmin_gmax__the_number_or_the_first_nan),
        CASE(case16__gmin_gmax__zeros_by_their_place),
        CASE(case17__min_max_of_doubles__second_source),
        CASE(case18__gmaxabs__larger_size),
        CASE(case19__compares_of_doubles__eight_predicates),
        CASE(case35__clampz__range_from_zero),
        CASE(case36__addsets__sign_of_the_sum),
        CASE(case37__madd233__scale_and_bias_of_the_group),
        CASE(case42__blend__bit_1_takes_the_second),
        CASE(case53__mask_of_doubles__low_eight_bits),
    };
    return cmocka_run_group_tests_name("golden arithmetic " LRB_BACKEND, tests, case_setup, case_teardown);
}
