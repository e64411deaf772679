/* The golden cases of isa-facts section 6 that concern integers, masks, permutes and bits, by their numbers. */
#include "tests/lrbni/case.h"

static lrb_v16i all(uint32_t word)
{
    return (lrb_v16i){.lanes = lanes_all_pi(word)};
}

/* The same word in every lane is expected. */
static void expect_all(lrb_v16i v, uint32_t word)
{
    uint32_t lanes[16];
    lanes_store_pi(lanes, v.lanes);
    for (int i = 0; i < 16; i++)
        if (lanes[i] != word)
            fail_msg("lane %d: got %08x, expected %08x", i, lanes[i], word);
}

/* start, start + 1, ... */
static lrb_v16i count_from(uint32_t start)
{
    uint32_t lanes[16];
    for (uint32_t i = 0; i < 16; i++)
        lanes[i] = start + i;
    return case_pi(lanes);
}

static lrb_v16i groups(uint32_t l0, uint32_t l1, uint32_t l2, uint32_t l3)
{
    const uint32_t lanes[16] = {l0, l1, l2, l3, l0, l1, l2, l3, l0, l1, l2, l3, l0, l1, l2, l3};
    return case_pi(lanes);
}

static void expect_lanes(lrb_v16i got, lrb_v16i expected)
{
    uint32_t a[16], b[16];
    lanes_store_pi(a, got.lanes);
    lanes_store_pi(b, expected.lanes);
    for (int i = 0; i < 16; i++)
        if (a[i] != b[i])
            fail_msg("lane %d: got %08x, expected %08x", i, a[i], b[i]);
}

static void case20__shift_counts_beyond_31__by_chip(void **state)
{
    lrb_v16i one = all(1), top = all(0x80000000), n32 = all(32), n33 = all(33), n63 = all(63), huge = all(0x80000001);
    expect_all(lrb_sll_pi(*state, one, n32), 0x00000001);
    expect_all(lrb_sll_pi(*state, one, n33), 0x00000002);
    expect_all(lrb_srl_pi(*state, top, n33), 0x40000000);
    expect_all(lrb_sra_pi(*state, top, n63), 0xffffffff);
    expect_all(lrb_slli_pi(*state, one, 32), 0);
    expect_all(lrb_srli_pi(*state, top, 32), 0);
    expect_all(lrb_srai_pi(*state, top, 32), 0xffffffff);
    expect_all(lrb_srai_pi(*state, one, 255), 0);
    /* assumed: variable counts as immediate ones */
    expect_all(lrb_sllv_pi(*state, one, n32), 0);
    expect_all(lrb_srlv_pi(*state, top, huge), 0);
    expect_all(lrb_srav_pi(*state, top, huge), 0xffffffff);
    expect_all(lrb_srav_pi(*state, one, n32), 0);
}

static void case32__products__halves(void **state)
{
    lrb_v16i a = all(0x80000000), b = all(0xffffffff);
    expect_all(lrb_mulh_pi(*state, a, b), 0x00000000);
    expect_all(lrb_mulh_pu(*state, a, b), 0x7fffffff);
    expect_all(lrb_mull_pi(*state, a, b), 0x80000000);
}

static void case33__carry_and_borrow__in_and_out(void **state)
{
    lrb_k16 k = lrb_mask(0);
    expect_all(lrb_adc_pi(*state, all(0xffffffff), lrb_mask(0xffff), all(0), &k), 0);
    assert_int_equal(k.bits, 0xffff);
    expect_all(lrb_adc_pi(*state, all(0xffffffff), lrb_mask(0), all(0), &k), 0xffffffff);
    assert_int_equal(k.bits, 0);
    expect_all(lrb_adc_pi(*state, all(0xffffffff), lrb_mask(0xffff), all(0xffffffff), &k), 0xffffffff);
    assert_int_equal(k.bits, 0xffff);
    expect_all(lrb_sbb_pi(*state, all(0), lrb_mask(0xffff), all(0), &k), 0xffffffff);
    assert_int_equal(k.bits, 0xffff);
    expect_all(lrb_sbbr_pi(*state, all(5), lrb_mask(0), all(7), &k), 2);
    assert_int_equal(k.bits, 0);
}

static void case34__addsetc_under_mask__keeps_lane_and_carry(void **state)
{
    for (uint32_t old = 0; old <= 0xffff; old += 0xffff) {
        lrb_k16 k;
        uint32_t lanes[16];
        lrb_v16i d = lrb_mask_addsetc_pi(*state, all(0xfffffff0), lrb_mask(0x00fe), lrb_mask(old), all(0x10), &k);
        lanes_store_pi(lanes, d.lanes);
        for (int i = 0; i < 16; i++)
            assert_int_equal(lanes[i], 0x00fe >> i & 1 ? 0 : 0xfffffff0);
        assert_int_equal(k.bits, old | 0x00fe);
        lrb_mask_addsetc_pi(*state, all(1), lrb_mask(0x00fe), lrb_mask(old), all(1), &k);
        assert_int_equal(k.bits, old & ~0x00fe);
    }
}

static void case35__clampz__zero_to_limit(void **state)
{
    expect_all(lrb_clampz_pi(*state, all((uint32_t)-5), all(10)), 0);
    expect_all(lrb_clampz_pi(*state, all(5), all((uint32_t)-1)), 0);
    expect_all(lrb_clampz_pi(*state, all(15), all(10)), 10);
    expect_all(lrb_clampz_pi(*state, all(7), all(10)), 7);
}

static void case36__addsets__sign_of_the_sum(void **state)
{
    lrb_k16 k;
    expect_all(lrb_addsets_pi(*state, all((uint32_t)-1), all(1), &k), 0);
    assert_int_equal(k.bits, 0);
    expect_all(lrb_addsets_pi(*state, all((uint32_t)-2), all(1), &k), (uint32_t)-1);
    assert_int_equal(k.bits, 0xffff);
    expect_all(lrb_addsets_pi(*state, all(0x7fffffff), all(1), &k), 0x80000000); /* of the sum as it is stored */
    assert_int_equal(k.bits, 0xffff);
    lrb_mask_addsets_pi(*state, all(0), lrb_mask(0x0f0f), all(0x7fffffff), all(1), &k);
    assert_int_equal(k.bits, 0x0f0f);
}

static void case37__madd233__factor_and_addend_of_the_group(void **state)
{
    lrb_v16i v = groups(1, 2, 3, 4);
    expect_lanes(lrb_madd233_pi(*state, v, groups(10, 3, 77, 99)), groups(13, 16, 19, 22));
}

static void case38__swizzles__of_integers(void **state)
{
    static const uint32_t expected[8][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {0, 0, 0, 0},
                                            {1, 1, 1, 1}, {2, 2, 2, 2}, {3, 3, 3, 3}, {1, 2, 0, 3}};
    static const lrb_swizzle swizzles[8] = {LRB_DCBA, LRB_CDAB, LRB_BADC, LRB_AAAA, LRB_BBBB, LRB_CCCC, LRB_DDDD, LRB_DACB};
    for (int i = 0; i < 8; i++) {
        const uint32_t *e = expected[i];
        expect_lanes(lrb_mov_pi_s3(*state, lrb_swizzle_pi(groups(0, 1, 2, 3), swizzles[i])), groups(e[0], e[1], e[2], e[3]));
        uint64_t lanes[8] = {0, 1, 2, 3, 4, 5, 6, 7}, moved[8];
        lrb_v8q q = {.lanes = lanes_load_pq(lanes)};
        lanes_store_pq(moved, lrb_mov_pq_s3(*state, lrb_swizzle_pq(q, swizzles[i])).lanes); /* letters of 64 bits */
        for (unsigned lane = 0; lane < 8; lane++)
            assert_true(moved[lane] == (lane & 4) + e[lane & 3]);
    }
}

static void case39__masked_swizzle__mask_of_destination_lanes(void **state)
{
    lrb_v16i v = groups(0, 1, 2, 3), old = groups(9, 9, 9, 9);
    expect_lanes(lrb_mask_mov_pi_s3(*state, old, lrb_mask(0x1111), lrb_swizzle_pi(v, LRB_CDAB)), groups(1, 9, 9, 9));
}

static void case40__permd__index_modulo_16(void **state)
{
    lrb_v16i v = count_from(100);
    expect_all(lrb_permd_pi(*state, all(16 + 3), v), 103);
    expect_all(lrb_permd_pi(*state, all(0xfffffff8), v), 108);
    expect_lanes(lrb_permd_pi(*state, count_from(32), v), v);
}

static void case41__alignd__across_both(void **state)
{
    lrb_v16i a = count_from(116), b = count_from(100);
    for (unsigned n = 0; n < 16; n++)
        expect_lanes(lrb_alignd_pi(*state, a, b, n), count_from(100 + n));
}

static void case42__blend__one_selects_the_second(void **state)
{
    expect_lanes(lrb_blendm_pi(*state, lrb_mask(0xaaaa), groups(0, 1, 2, 3), groups(4, 5, 6, 7)), groups(0, 5, 2, 7));
    lrb_v8q q = lrb_blendm_pq(*state, lrb_mask(0xffaa), lrb_castpi_pq(groups(0, 1, 2, 3)), lrb_castpi_pq(groups(4, 5, 6, 7)));
    expect_lanes(lrb_castpq_pi(q), groups(0, 1, 6, 7));
}

static void case43__kandnr__complements_the_second(void **state)
{
    assert_int_equal(lrb_kandnr(*state, lrb_mask(0x00ff), lrb_mask(0x0f0f)).bits, 0x00f0);
}

static void case45__k0__all_lanes_written(void **state)
{
    expect_all(lrb_mask_add_pi(*state, all(7), lrb_mask(0xffff), all(1), all(1)), 2);
}

/* Registers have 64 bits here; a 32-bit value in one gives what the 32-bit instruction does. */
static void case60_61__bit_scans__from_a_position(void **state)
{
    lrb_r64 x = lrb_imm(0x90), ones = lrb_imm(0xffffffff);
    assert_true(lrb_bsfi(*state, lrb_imm(31), ones).value == UINT64_MAX);
    assert_true(lrb_bsri(*state, lrb_imm(32), x).value == 7);
    assert_true(lrb_bsri(*state, lrb_imm(7), x).value == 4);
    assert_true(lrb_bsri(*state, lrb_imm(4), x).value == UINT64_MAX);
    assert_true(lrb_bsri(*state, lrb_imm(0), ones).value == UINT64_MAX);
    assert_true(lrb_bsri(*state, lrb_imm(64), lrb_imm(UINT64_MAX)).value == 63);
    assert_true(lrb_bsff(*state, x).value == 4 && lrb_bsrf(*state, x).value == 7);
    assert_true(lrb_bsff(*state, lrb_imm(0)).value == UINT64_MAX && lrb_bsrf(*state, lrb_imm(0)).value == UINT64_MAX);
    assert_true(lrb_tzcnti(*state, lrb_imm(5), x).value == 2 && lrb_tzcnti(*state, lrb_imm(8), x).value == 56);
}

static void case62__quadmask16__of_the_low_half(void **state)
{
    assert_true(lrb_quadmask16(*state, lrb_imm(0x8010)).value == 0xa);
    assert_true(lrb_quadmask16(*state, lrb_imm(0xf00f)).value == 0x9);
    assert_true(lrb_quadmask16(*state, lrb_imm(0x12340000)).value == 0);
}

/* Vector and scalar; the scalar op has 64 bits, and its low half is that of 32. */
static void case63_64__bitinterleave__last_source_first(void **state)
{
    static const uint32_t cases11[3][3] = {{0xffff, 0, 0xaaaaaaaa}, {0, 0xffff, 0x55555555}, {0xab, 0xcd, 0x0000d8db}};
    static const uint32_t cases21[3][3] = {{0xffffffff, 0, 0xb6db6db6}, {0, 0xffffffff, 0x49249249}, {0x35, 0x5, 0x000001d3}};
    for (int i = 0; i < 3; i++) {
        expect_all(lrb_bitinterleave11_pi(*state, all(cases11[i][0]), all(cases11[i][1])), cases11[i][2]);
        expect_all(lrb_bitinterleave21_pi(*state, all(cases21[i][0]), all(cases21[i][1])), cases21[i][2]);
        lrb_r64 r = lrb_bitinterleave11(*state, lrb_imm(cases11[i][0]), lrb_imm(cases11[i][1]));
        assert_int_equal((uint32_t)r.value, cases11[i][2]);
        r = lrb_bitinterleave21(*state, lrb_imm(cases21[i][0]), lrb_imm(cases21[i][1]));
        assert_int_equal((uint32_t)r.value, cases21[i][2]);
    }
}

static void case65__test__any_common_bit(void **state)
{
    assert_int_equal(lrb_test_pi(*state, all(0x0f), all(0xf0)).bits, 0);
    assert_int_equal(lrb_test_pi(*state, all(0x0f), all(0x08)).bits, 0xffff);
}

/* The article's sequence: offsets of four-float texels in a 256x256 texture whose address interleaves y and x (ABR, figure 16). */
static void bit_fields__published_example__swizzled_texture_offsets(void **state)
{
    lrb_v16i x = all(0xdeadbea5), y = all(0x1234563c);
    lrb_v16i offset = lrb_xor_pi(*state, x, x);
    lrb_v16i xy = lrb_bitinterleave11_pi(*state, y, x);
    offset = lrb_insertfield_pi(*state, offset, xy, 4, 4, 19);
    uint32_t expected = 0;
    for (unsigned i = 0; i < 8; i++)
        expected |= (0xa5u >> i & 1) << (4 + 2 * i) | (0x3cu >> i & 1) << (5 + 2 * i);
    expect_all(offset, expected);
    /* and figure 15: rotated by 8, bits 4 to 23 replaced */
    expect_all(lrb_insertfield_pi(*state, all(0xffffffff), all(0x12345678), 8, 4, 23), 0xff56781f);
    expect_all(lrb_rotatefield_pi(*state, all(0x12345678), 8, 4, 23), 0x00567810);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case20__shift_counts_beyond_31__by_chip),
        cmocka_unit_test(case32__products__halves),
        cmocka_unit_test(case33__carry_and_borrow__in_and_out),
        cmocka_unit_test(case34__addsetc_under_mask__keeps_lane_and_carry),
        cmocka_unit_test(case35__clampz__zero_to_limit),
        cmocka_unit_test(case36__addsets__sign_of_the_sum),
        cmocka_unit_test(case37__madd233__factor_and_addend_of_the_group),
        cmocka_unit_test(case38__swizzles__of_integers),
        cmocka_unit_test(case39__masked_swizzle__mask_of_destination_lanes),
        cmocka_unit_test(case40__permd__index_modulo_16),
        cmocka_unit_test(case41__alignd__across_both),
        cmocka_unit_test(case42__blend__one_selects_the_second),
        cmocka_unit_test(case43__kandnr__complements_the_second),
        cmocka_unit_test(case45__k0__all_lanes_written),
        cmocka_unit_test(case60_61__bit_scans__from_a_position),
        cmocka_unit_test(case62__quadmask16__of_the_low_half),
        cmocka_unit_test(case63_64__bitinterleave__last_source_first),
        cmocka_unit_test(case65__test__any_common_bit),
        cmocka_unit_test(bit_fields__published_example__swizzled_texture_offsets),
    };
    return cmocka_run_group_tests_name("golden integer " LRB_BACKEND, tests, case_setup, case_teardown);
}
