/* The golden cases of isa-facts section 6 that concern the ops there are, by their numbers. */
#include <stdlib.h>

#include "tests/lrbni/child.h"

static lrb_v16f all_lanes(uint32_t bits)
{
    uint32_t lanes[16];
    for (int i = 0; i < 16; i++)
        lanes[i] = bits;
    return case_ps(lanes);
}

/* The same bits in every lane are expected. */
static void expect_all(lrb_v16f v, uint32_t bits)
{
    uint32_t lanes[16];
    lanes_store_ps(lanes, v.lanes);
    for (int i = 0; i < 16; i++)
        if (lanes[i] != bits)
            fail_msg("lane %d: got %08x, expected %08x", i, lanes[i], bits);
}

static uint32_t binary(lrb_ctx *c, char op, uint32_t a, uint32_t b)
{
    lrb_v16f x = all_lanes(a), y = all_lanes(b);
    lrb_v16f r = op == '+' ? lrb_add_ps(c, x, y) : op == '-' ? lrb_sub_ps(c, x, y) : op == '*' ? lrb_mul_ps(c, x, y)
               : op == '<' ? lrb_min_ps(c, x, y) : lrb_max_ps(c, x, y);
    uint32_t lanes[16];
    lanes_store_ps(lanes, r.lanes);
    expect_all(r, lanes[0]);
    return lanes[0];
}

static void expect_group(lrb_v16f v, float l0, float l1, float l2, float l3)
{
    const float expected[4] = {l0, l1, l2, l3};
    float lanes[16];
    lanes_store_ps(lanes, v.lanes);
    for (int i = 0; i < 16; i++)
        assert_true(lanes[i] == expected[i % 4]);
}

static lrb_v16f groups(float l0, float l1, float l2, float l3)
{
    const float lanes[16] = {l0, l1, l2, l3, l0, l1, l2, l3, l0, l1, l2, l3, l0, l1, l2, l3};
    lrb_v16f v = {.lanes = lanes_load_ps(lanes)};
    return v;
}

static void case1__fma__rounds_once(void **state)
{
    lrb_v16f a = all_lanes(0x3f800800), d = all_lanes(0xbf801000);
    expect_all(lrb_madd231_ps(*state, d, a, a), 0x33800000);
    expect_all(lrb_madd213_ps(*state, a, a, d), 0x33800000);
    expect_all(lrb_madd132_ps(*state, a, d, a), 0x33800000);
}

static void case3__fma__no_intermediate_overflow(void **state)
{
    expect_all(lrb_madd231_ps(*state, all_lanes(0xff400000), all_lanes(0x7f400000), all_lanes(0x40000000)), 0x7f400000);
}

static void case4__msubr__zero_is_positive(void **state)
{
    lrb_v16f one = all_lanes(0x3f800000);
    expect_all(lrb_msubr231_ps(*state, one, one, one), 0x00000000);
}

static void case6_7__sums__nearest_even(void **state)
{
    assert_int_equal(binary(*state, '+', 0x3f800000, 0x33800000), 0x3f800000);
    assert_int_equal(binary(*state, '-', 0xbf800000, 0x33800000), 0xbf800000);
    assert_int_equal(binary(*state, '+', 0x3f800001, 0x33800000), 0x3f800002);
    assert_int_equal(binary(*state, '-', 0x3f800001, 0x3f800001), 0x00000000);
}

static void case8__denormals__kept(void **state)
{
    assert_int_equal(binary(*state, '*', 0x00800000, 0x3f000000), 0x00400000);
    assert_int_equal(binary(*state, '+', 0x00000001, 0x00000001), 0x00000002);
}

static void case12__invalid_operations__default_nan(void **state)
{
    assert_int_equal(binary(*state, '-', 0x7f800000, 0x7f800000), 0xffc00000);
    assert_int_equal(binary(*state, '+', 0x7f800000, 0xff800000), 0xffc00000);
    assert_int_equal(binary(*state, '*', 0x00000000, 0x7f800000), 0xffc00000);
    assert_int_equal(binary(*state, '*', 0xff800000, 0x80000000), 0xffc00000);
    expect_all(lrb_madd231_ps(*state, all_lanes(0x3f800000), all_lanes(0x7f800000), all_lanes(0)), 0xffc00000);
}

static void case13__nans__first_source_quieted(void **state)
{
    lrb_v16f q11 = all_lanes(0x7fc00011), q22 = all_lanes(0x7fc00022), s33 = all_lanes(0xff800033), one = all_lanes(0x3f800000);
    assert_int_equal(binary(*state, '+', 0x7f800001, 0x3f800000), 0x7fc00001);
    assert_int_equal(binary(*state, '+', 0x3f800000, 0x7f800001), 0x7fc00001);
    assert_int_equal(binary(*state, '+', 0x7fc00011, 0x7fc00022), 0x7fc00011);
    assert_int_equal(binary(*state, '-', 0x7fc00011, 0xff800001), 0x7fc00011);
    assert_int_equal(binary(*state, '*', 0xff800001, 0x7fc00011), 0xffc00001);
    expect_all(lrb_subr_ps(*state, q11, q22), 0x7fc00022); /* b - a: b is first */
    expect_all(lrb_madd231_ps(*state, q11, one, s33), 0xffc00033); /* a * b + d */
    expect_all(lrb_madd231_ps(*state, q11, one, one), 0x7fc00011);
    expect_all(lrb_madd132_ps(*state, q11, q22, s33), 0x7fc00011); /* d * b + a */
    expect_all(lrb_madd213_ps(*state, q11, q22, s33), 0x7fc00022); /* a * d + b */
    expect_all(lrb_msub231_ps(*state, q11, one, one), 0x7fc00011); /* the sign of a NaN is not changed */
    expect_all(lrb_msubr231_ps(*state, one, q22, one), 0x7fc00022);
    /* 0 * infinity is invalid, but the addend is a NaN already */
    expect_all(lrb_madd231_ps(*state, q11, all_lanes(0), all_lanes(0x7f800000)), 0x7fc00011);
}

static void case17__min_max__second_source(void **state)
{
    for (int i = 0; i < 2; i++) {
        char op = "<>"[i];
        assert_int_equal(binary(*state, op, 0x3f800000, 0x7fc00055), 0x7fc00055);
        assert_int_equal(binary(*state, op, 0x7fc00055, 0x3f800000), 0x3f800000);
        assert_int_equal(binary(*state, op, 0x00000000, 0x80000000), 0x80000000);
        assert_int_equal(binary(*state, op, 0x80000000, 0x00000000), 0x00000000);
        assert_int_equal(binary(*state, op, 0x3f800000, 0x7f800055), 0x7f800055); /* not even made quiet */
    }
}

static void expect_compares(lrb_ctx *c, lrb_v16f a, lrb_v16f b, const char *bits)
{
    const lrb_k16 k[8] = {lrb_cmpeq_ps(c, a, b),  lrb_cmplt_ps(c, a, b),  lrb_cmple_ps(c, a, b),  lrb_cmpunord_ps(c, a, b),
                          lrb_cmpneq_ps(c, a, b), lrb_cmpnlt_ps(c, a, b), lrb_cmpnle_ps(c, a, b), lrb_cmpord_ps(c, a, b)};
    for (int i = 0; i < 8; i++)
        assert_int_equal(k[i].bits, bits[i] == '1' ? 0xffff : 0);
}

static void case19__compares__eight_predicates(void **state)
{
    lrb_v16f nan = all_lanes(0x7fc00000), one = all_lanes(0x3f800000), zero = all_lanes(0), minus_zero = all_lanes(0x80000000);
    expect_compares(*state, nan, one, "00011110");
    expect_compares(*state, one, nan, "00011110");
    expect_compares(*state, one, one, "10100101");
    expect_compares(*state, zero, minus_zero, "10100101");
    expect_compares(*state, zero, one, "01101001");
}

static void case21__merging__other_lanes_untouched(void **state)
{
    const uint32_t presets[2] = {0x40e00000, 0x7f8abcde};
    for (int i = 0; i < 2; i++) {
        uint32_t lanes[16];
        lrb_v16f one = all_lanes(0x3f800000);
        lanes_store_ps(lanes, lrb_mask_add_ps(*state, all_lanes(presets[i]), lrb_mask(0x0005), one, one).lanes);
        for (int lane = 0; lane < 16; lane++)
            assert_int_equal(lanes[lane], lane == 0 || lane == 2 ? 0x40000000 : presets[i]);
    }
}

static void case22__compare_under_mask__zero_elsewhere(void **state)
{
    lrb_v16f one = all_lanes(0x3f800000);
    assert_int_equal(lrb_mask_cmpeq_ps(*state, lrb_mask(0x00ff), one, one).bits, 0x00ff);
    assert_int_equal(lrb_mask_cmpneq_ps(*state, lrb_mask(0x00ff), one, all_lanes(0)).bits, 0x00ff);
}

static void case38__swizzles__lanes_as_named(void **state)
{
    lrb_v16f v = groups(0, 1, 2, 3);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_DCBA)), 0, 1, 2, 3);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_CDAB)), 1, 0, 3, 2);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_BADC)), 2, 3, 0, 1);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_DACB)), 1, 2, 0, 3);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_AAAA)), 0, 0, 0, 0);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_BBBB)), 1, 1, 1, 1);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_CCCC)), 2, 2, 2, 2);
    expect_group(lrb_mov_ps_s3(*state, lrb_swizzle_ps(v, LRB_DDDD)), 3, 3, 3, 3);
}

static void case39__masked_swizzle__mask_of_destination_lanes(void **state)
{
    lrb_v16f old = groups(9, 9, 9, 9), v = groups(0, 1, 2, 3);
    expect_group(lrb_mask_mov_ps_s3(*state, old, lrb_mask(0x1111), lrb_swizzle_ps(v, LRB_CDAB)), 1, 9, 9, 9);
}

static void case42__masked_move__blends(void **state)
{
    expect_group(lrb_mask_mov_ps(*state, groups(0, 1, 2, 3), lrb_mask(0xaaaa), groups(4, 5, 6, 7)), 0, 5, 2, 7);
}

static void case43__kandn__complements_the_first(void **state)
{
    assert_int_equal(lrb_kandn(*state, lrb_mask(0x00ff), lrb_mask(0x0f0f)).bits, 0x0f00);
}

static void case44__kortest__flags(void **state)
{
    lrb_flags none = lrb_kortest(*state, lrb_mask(0), lrb_mask(0));
    lrb_flags all = lrb_kortest(*state, lrb_mask(0xff00), lrb_mask(0x00ff));
    lrb_flags some = lrb_kortest(*state, lrb_mask(1), lrb_mask(0));
    assert_true(none.zero && !none.carry);
    assert_true(!all.zero && all.carry);
    assert_true(!some.zero && !some.carry);
}

/* A kernel says k0 as lrb_mask(0xffff). */
static void case45__k0__all_lanes_written(void **state)
{
    lrb_v16f one = all_lanes(0x3f800000);
    expect_all(lrb_mask_add_ps(*state, all_lanes(0), lrb_mask(0xffff), one, one), 0x40000000);
    assert_int_equal(lrb_mask(0xffffffff).bits, 0xffff);
}

static void case58__rcp_of_zero_and_infinity__as_assumed(void **state)
{
    expect_all(lrb_rcpres_ps(*state, all_lanes(0x00000000)), 0x7f800000);
    expect_all(lrb_rcpres_ps(*state, all_lanes(0x80000000)), 0xff800000);
    expect_all(lrb_rcpres_ps(*state, all_lanes(0x7f800000)), 0x00000000);
    expect_all(lrb_rcpres_ps(*state, all_lanes(0xff800000)), 0x80000000);
    expect_all(lrb_rcpres_ps(*state, all_lanes(0x40000000)), 0x3f000000);
    expect_all(lrb_rcpres_ps(*state, all_lanes(0x40400000)), 0x3eaaa000); /* 12 significant bits of 3eaaaaab */
}

static void case60__bsfi__next_bit_above(void **state)
{
    lrb_r64 bits = lrb_imm(0x90);
    assert_true(lrb_bsfi(*state, lrb_imm(UINT64_MAX), bits).value == 4);
    assert_true(lrb_bsfi(*state, lrb_imm(4), bits).value == 7);
    assert_true(lrb_bsfi(*state, lrb_imm(7), bits).value == UINT64_MAX);
    assert_true(lrb_bsfi(*state, lrb_imm(63), lrb_imm(UINT64_MAX)).value == UINT64_MAX);
    assert_true(lrb_bsfi(*state, lrb_imm(62), lrb_imm(UINT64_MAX)).value == 63);
    assert_true(lrb_bsfi(*state, lrb_imm(UINT64_MAX), lrb_imm(0)).value == UINT64_MAX);
    assert_true(lrb_bsfi(*state, lrb_imm((uint64_t)-5), lrb_imm(1)).value == 0);
}

enum { ACCESSES = 7 };

/* One vector access, `off` bytes beside the alignment that it needs. */
static void access_at(lrb_ctx *c, int number, int32_t off)
{
    lrb_ptr base = lrb_segment_at(c->scratch, 0);
    lrb_v16f one = all_lanes(0x3f800000);
    switch (number) {
    case 0: lrb_load_ps(c, lrb_at(base, 64 + off)); break;
    case 1: lrb_store_ps(c, lrb_at(base, 64 + off), one); break;
    case 2: lrb_mask_load_ps(c, one, lrb_mask(1), lrb_at(base, 64 + off)); break;
    case 3: lrb_mask_store_ps(c, lrb_at(base, 64 + off), lrb_mask(1), one); break;
    case 4: lrb_add_ps_s3(c, one, lrb_full_ps(lrb_at(base, 64 + off))); break;
    case 5: lrb_add_ps_s3(c, one, lrb_4to16_ps(lrb_at(base, 16 + off))); break;
    default: lrb_add_ps_s3(c, one, lrb_1to16_ps(lrb_at(base, 4 + off))); break;
    }
}

static void case66__misaligned__stops(void **state)
{
#ifdef NDEBUG
    (void)state, (void)access_at;
    printf("# skipped: built without assertions, which are what stops a misaligned access\n");
#else
    for (int i = 0; i < ACCESSES; i++) {
        assert_int_equal(end_of_access(access_at, *state, i, 0), 0);
        assert_int_equal(end_of_access(access_at, *state, i, i == ACCESSES - 1 ? 2 : 4), SIGABRT);
        assert_int_equal(end_of_access(access_at, *state, i, 1), SIGABRT);
    }
#endif
}

static void case67__one_to_sixteen__any_word(void **state)
{
    alignas(64) uint32_t memory[32];
    for (int i = 0; i < 32; i++)
        memory[i] = 0x40000000u + (uint32_t)i;
    lrb_segment segment = {.host = (unsigned char *)memory, .address = 0x5000, .size = sizeof memory};
    for (int i = 0; i < 32; i++)
        expect_all(lrb_load_1to16_ps(*state, lrb_at(lrb_segment_at(segment, 0), 4 * i)), memory[i]);
}

static void case70__destination_is_swizzled_source__read_before_written(void **state)
{
    lrb_v16f v = groups(0, 1, 2, 3);
    v = lrb_add_ps_s3(*state, v, lrb_swizzle_ps(v, LRB_BADC));
    expect_group(v, 2, 4, 2, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case1__fma__rounds_once),
        cmocka_unit_test(case3__fma__no_intermediate_overflow),
        cmocka_unit_test(case4__msubr__zero_is_positive),
        cmocka_unit_test(case6_7__sums__nearest_even),
        cmocka_unit_test(case8__denormals__kept),
        cmocka_unit_test(case12__invalid_operations__default_nan),
        cmocka_unit_test(case13__nans__first_source_quieted),
        cmocka_unit_test(case17__min_max__second_source),
        cmocka_unit_test(case19__compares__eight_predicates),
        cmocka_unit_test(case21__merging__other_lanes_untouched),
        cmocka_unit_test(case22__compare_under_mask__zero_elsewhere),
        cmocka_unit_test(case38__swizzles__lanes_as_named),
        cmocka_unit_test(case39__masked_swizzle__mask_of_destination_lanes),
        cmocka_unit_test(case42__masked_move__blends),
        cmocka_unit_test(case43__kandn__complements_the_first),
        cmocka_unit_test(case44__kortest__flags),
        cmocka_unit_test(case45__k0__all_lanes_written),
        cmocka_unit_test(case58__rcp_of_zero_and_infinity__as_assumed),
        cmocka_unit_test(case60__bsfi__next_bit_above),
        cmocka_unit_test(case66__misaligned__stops),
        cmocka_unit_test(case67__one_to_sixteen__any_word),
        cmocka_unit_test(case70__destination_is_swizzled_source__read_before_written),
    };
    return cmocka_run_group_tests_name("golden " LRB_BACKEND, tests, case_setup, case_teardown);
}
