/* The golden cases of isa-facts section 6 that concern memory, by their numbers. */
#include <stdlib.h>

#include "tests/lrbni/child.h"

enum { ADDRESS = 0x5000 };

static lrb_mem at(void *memory, int32_t offset)
{
    lrb_segment segment = {.host = memory, .address = ADDRESS, .size = 256};
    return lrb_at(lrb_segment_at(segment, 0), offset);
}

/* Lane i holds first + i. */
static lrb_v16i counting(uint32_t first)
{
    uint32_t lanes[16];
    for (int i = 0; i < 16; i++)
        lanes[i] = first + (uint32_t)i;
    return case_pi(lanes);
}

/* Elements, converted by a load, give the lanes expected; lanes beyond `count` are not looked at. */
static void expect_up(lrb_ctx *c, lrb_up_ps up, const void *elements, int count, const uint32_t *expected)
{
    alignas(64) unsigned char memory[64] = {0};
    uint32_t lanes[16];
    memcpy(memory, elements, lrb_up_ps_bytes(up) * (unsigned)count);
    lanes_store_ps(lanes, lrb_load_up_ps(c, at(memory, 0), up).lanes);
    for (int i = 0; i < count; i++)
        if (lanes[i] != expected[i])
            fail_msg("conversion %d, element %d: got %08x, expected %08x", (int)up, i, lanes[i], expected[i]);
}

static void case28__half_down__nearest_and_truncating(void **state)
{
    const uint32_t lanes[16] = {0x477fe000, 0x477fefff, 0x477ff000, 0x33000000, 0x33000001, 0x3f801000, 0x3f803000};
    static const uint16_t nearest[7] = {0x7bff, 0x7bff, 0x7c00, 0x0000, 0x0001, 0x3c00, 0x3c02};
    static const uint16_t truncated[7] = {0x7bff, 0x7bff, 0x7bff, 0x0000, 0x0000, 0x3c00, 0x3c01};
    alignas(64) uint16_t memory[16];
    lrb_store_down_ps(*state, at(memory, 0), case_ps(lanes), LRB_DOWN_PS_float16);
    assert_memory_equal(memory, nearest, sizeof nearest);
    lrb_store_down_ps(*state, at(memory, 0), case_ps(lanes), LRB_DOWN_PS_float16_rz);
    assert_memory_equal(memory, truncated, sizeof truncated);
}

static void case29__half_up__exact_and_nan_quiet(void **state)
{
    static const uint16_t halves[5] = {0x0001, 0x0400, 0x7bff, 0xfc00, 0x7c01};
    static const uint32_t expected[5] = {0x33800000, 0x38800000, 0x477fe000, 0xff800000, 0x7fc02000};
    expect_up(*state, LRB_UP_PS_float16, halves, 5, expected);
}

static void case30__norms_up__quotients(void **state)
{
    static const uint8_t unorm8[4] = {0, 1, 128, 255}, snorm8[2] = {0x81, 0x80};
    static const uint16_t unorm16[1] = {1};
    static const uint32_t expected8[4] = {0x00000000, 0x3b808081, 0x3f008081, 0x3f800000};
    static const uint32_t expected16[1] = {0x37800080}, expected_signed[2] = {0xbf800000, 0xbf800000};
    expect_up(*state, LRB_UP_PS_unorm8, unorm8, 4, expected8);
    expect_up(*state, LRB_UP_PS_unorm16, unorm16, 1, expected16);
    expect_up(*state, LRB_UP_PS_snorm8, snorm8, 2, expected_signed);
}

static void case31__bytes_up__unsigned_and_signed(void **state)
{
    alignas(64) uint8_t memory[16] = {0xff};
    static const uint32_t unsigned_float[1] = {0x437f0000}, signed_float[1] = {0xbf800000};
    int32_t lanes[16];
    expect_up(*state, LRB_UP_PS_uint8, memory, 1, unsigned_float);
    expect_up(*state, LRB_UP_PS_sint8, memory, 1, signed_float);
    lanes_store_pi(lanes, lrb_load_up_pi(*state, at(memory, 0), LRB_UP_PI_uint8).lanes);
    assert_int_equal(lanes[0], 255);
    lanes_store_pi(lanes, lrb_load_up_pi(*state, at(memory, 0), LRB_UP_PI_sint8).lanes);
    assert_int_equal(lanes[0], -1);
}

static void case46__pack_of_no_lane__no_access(void **state)
{
    const lrb_mem nowhere = {.host = NULL, .address = ADDRESS + 60};
    lrb_packstorel_pi(*state, nowhere, lrb_mask(0), counting(0));
    lrb_packstoreh_pi(*state, nowhere, lrb_mask(0), counting(0));
    lrb_compress_pi(*state, nowhere, lrb_mask(0), counting(0));
}

static void case47__pack_across_a_line__each_part_its_line(void **state)
{
    alignas(64) uint32_t memory[32] = {0}, expected[32] = {0};
    lrb_packstorel_pi(*state, at(memory, 56), lrb_mask(0x8421), counting(100));
    expected[14] = 100, expected[15] = 105;
    assert_memory_equal(memory, expected, sizeof memory);
    lrb_packstoreh_pi(*state, at(memory, 56 + 64), lrb_mask(0x8421), counting(100));
    expected[16] = 110, expected[17] = 115;
    assert_memory_equal(memory, expected, sizeof memory);
}

static void case48__unpack_across_a_line__each_part_its_lanes(void **state)
{
    alignas(64) uint32_t memory[32];
    uint32_t lanes[16];
    lanes_store_pi(memory, counting(500).lanes);
    lanes_store_pi(memory + 16, counting(516).lanes);
    lrb_v16i d = lrb_loadunpackl_pi(*state, counting(0), lrb_mask(0x00f0), at(memory, 60));
    lanes_store_pi(lanes, d.lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i == 4 ? 515 : i);
    lanes_store_pi(lanes, lrb_loadunpackh_pi(*state, d, lrb_mask(0x00f0), at(memory, 60 + 64)).lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], i >= 4 && i < 8 ? 511 + i : i);
}

static void case49__start_of_a_line__high_part_does_nothing(void **state)
{
    alignas(64) uint32_t memory[32] = {0}, zeros[32] = {0};
    uint32_t lanes[16], old[16];
    lanes_store_pi(old, counting(7).lanes);
    lanes_store_pi(lanes, lrb_loadunpackh_pi(*state, counting(7), lrb_mask(0xffff), at(memory, 64)).lanes);
    assert_memory_equal(lanes, old, sizeof lanes);
    lrb_packstoreh_pi(*state, at(memory, 64), lrb_mask(0xffff), counting(7));
    assert_memory_equal(memory, zeros, sizeof memory);
}

static void case50__gather_of_equal_indices__all_lanes(void **state)
{
    alignas(64) uint32_t memory[32];
    const uint32_t index[16] = {3, 3, 20, 3, 20, 20, 3, 3, 3, 3, 3, 3, 20, 3, 3, 3};
    uint32_t lanes[16];
    for (uint32_t i = 0; i < 32; i++)
        memory[i] = 1000 + i;
    lrb_k16 k = lrb_mask(0xffff);
    lrb_v16i d = counting(0);
    for (int n = 0; n < 2; n++)
        d = lrb_gatherd_pi(*state, d, &k, at(memory, 0), case_pi(index), 4);
    lanes_store_pi(lanes, d.lanes);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], 1000 + index[i]);
    assert_int_equal(k.bits, 0);
}

static void case51__gather_interrupted__done_lanes_and_the_rest(void **state)
{
    alignas(64) uint32_t memory[64];
    uint32_t index[16], lanes[16];
    for (uint32_t i = 0; i < 64; i++)
        memory[i] = 1000 + i;
    for (uint32_t i = 0; i < 16; i++)
        index[i] = i % 4 * 16 + i;
    lrb_k16 k = lrb_mask(0x7ffe);
    lrb_v16i d = counting(0);
    uint32_t done = 0;
    for (int n = 0; n < 5; n++) {
        d = lrb_gatherd_pi(*state, d, &k, at(memory, 0), case_pi(index), 4);
        assert_true((k.bits & done) == 0 && (done == 0x7ffe || (0x7ffe & ~k.bits) != done)); /* at least one more */
        done = 0x7ffe & ~k.bits;
        lanes_store_pi(lanes, d.lanes);
        for (uint32_t i = 0; i < 16; i++)
            assert_int_equal(lanes[i], done >> i & 1 ? 1000 + index[i] : i);
    }
    assert_int_equal(k.bits, 0);
}

static void case52__scatter_to_one_place__highest_lane(void **state)
{
    alignas(64) uint32_t memory[32] = {0};
    uint32_t index[16];
    for (uint32_t i = 0; i < 16; i++)
        index[i] = i == 3 || i == 9 ? 31 : i;
    lrb_scatter_all_pi(*state, at(memory, 0), lrb_mask(0xffff), case_pi(index), 4, counting(100));
    assert_int_equal(memory[31], 109);
    assert_int_equal(memory[3], 0);
    assert_int_equal(memory[10], 110);
}

/* One access, `off` bytes beside the alignment that it needs. */
static void access_at(lrb_ctx *c, int number, int32_t off)
{
    static const uint32_t twos[16] = {2, 2};
    lrb_ptr base = lrb_segment_at(c->scratch, 128);
    lrb_k16 k = lrb_mask(3);
    const lrb_v16i one = counting(1);
    const lrb_v8d pd = lrb_castps_pd(lrb_castpi_ps(one));
    const lrb_mem m = lrb_at(base, off);
    switch (number) {
    case 0: lrb_load_pd(c, m); break;
    case 1: lrb_store_nt_pi(c, m, one); break;
    case 2: lrb_mask_load_4to16_pi(c, one, k, m); break;
    case 3: lrb_load_4to8_pd(c, m); break;
    case 4: lrb_store_4_pi(c, m, one); break;
    case 5: lrb_load_up_pi(c, m, LRB_UP_PI_uint16); break;
    case 6: lrb_mask_store_down_pi(c, m, k, one, LRB_DOWN_PI_sint8); break;
    case 7: lrb_storenr_pd(c, m, pd); break;
    case 8: lrb_add_ps_s3(c, lrb_castpi_ps(one), lrb_from_ps(m, LRB_UP_PS_float16)); break;
    case 9: lrb_loadunpackl_pi(c, one, k, m); break;
    case 10: lrb_packstoreh_pq(c, lrb_at(base, off + 64), k, lrb_castpd_pq(pd)); break;
    case 11: lrb_gatherd_pd(c, pd, &k, m, case_pi(twos), 8); break;
    case 12: lrb_scatterd_pi(c, m, &k, case_pi(twos), 4, one); break;
    case 13: lrb_loadunpackl_up_ps(c, lrb_castpi_ps(one), k, m, LRB_UP_PS_sint16); break;
    default: lrb_load_1to8_pd(c, m); break;
    }
}
enum { ACCESSES = 15 };

static void case66__misaligned__stops(void **state)
{
#ifdef NDEBUG
    (void)state, (void)access_at;
    printf("# skipped: built without assertions, which are what stops a misaligned access\n");
#else
    static const int aligned_to[ACCESSES] = {64, 64, 16, 32, 16, 32, 16, 64, 32, 4, 8, 8, 4, 2, 8};
    for (int i = 0; i < ACCESSES; i++) {
        assert_int_equal(end_of_access(access_at, *state, i, 0), 0);
        assert_int_equal(end_of_access(access_at, *state, i, aligned_to[i]), 0);
        assert_int_equal(end_of_access(access_at, *state, i, aligned_to[i] / 2), SIGABRT);
        assert_int_equal(end_of_access(access_at, *state, i, 1), SIGABRT);
    }
#endif
}

static void case67__one_to_sixteen__any_element(void **state)
{
    alignas(64) unsigned char memory[64];
    for (int i = 0; i < 64; i++)
        memory[i] = (unsigned char)(3 * i);
    for (int i = 0; i < 64; i++) {
        int32_t lanes[16];
        lanes_store_pi(lanes, lrb_load_up_1to16_pi(*state, at(memory, i), LRB_UP_PI_uint8).lanes);
        assert_int_equal(lanes[15], 3 * i % 256);
    }
    double doubles[8], all[8];
    memcpy(doubles, memory, sizeof doubles);
    for (int i = 0; i < 8; i++) {
        lanes_store_pd(all, lrb_load_1to8_pd(*state, at(memory, 8 * i)).lanes);
        assert_memory_equal(&all[7], &doubles[i], sizeof(double));
    }
}

/* Neither registers nor memory could change: there is nothing behind the addresses. */
static void case68__hints_to_invalid_addresses__nothing(void **state)
{
    const lrb_mem nowhere = {.host = NULL, .address = 3};
    lrb_k16 k = lrb_mask(0xffff);
    lrb_prefetch1_miss(*state, nowhere);
    lrb_prefetch2_ex_nt(*state, nowhere);
    lrb_evict2(*state, nowhere);
    lrb_gatherpfd(*state, &k, nowhere, counting(0), 8);
    lrb_gatherpf0hintd_ps(*state, k, nowhere, counting(0), 8);
    lrb_delay(*state, lrb_imm(UINT64_MAX));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case28__half_down__nearest_and_truncating),
        cmocka_unit_test(case29__half_up__exact_and_nan_quiet),
        cmocka_unit_test(case30__norms_up__quotients),
        cmocka_unit_test(case31__bytes_up__unsigned_and_signed),
        cmocka_unit_test(case46__pack_of_no_lane__no_access),
        cmocka_unit_test(case47__pack_across_a_line__each_part_its_line),
        cmocka_unit_test(case48__unpack_across_a_line__each_part_its_lanes),
        cmocka_unit_test(case49__start_of_a_line__high_part_does_nothing),
        cmocka_unit_test(case50__gather_of_equal_indices__all_lanes),
        cmocka_unit_test(case51__gather_interrupted__done_lanes_and_the_rest),
        cmocka_unit_test(case52__scatter_to_one_place__highest_lane),
        cmocka_unit_test(case66__misaligned__stops),
        cmocka_unit_test(case67__one_to_sixteen__any_element),
        cmocka_unit_test(case68__hints_to_invalid_addresses__nothing),
    };
    return cmocka_run_group_tests_name("golden_memory " LRB_BACKEND, tests, case_setup, case_teardown);
}
