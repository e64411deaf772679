/* Streams, gathers and scatters against their references: every start in a line, all masks and conversions, one execution at a time and to
 * the end, the event, and guarded pages before and behind what may be touched. */
#include "tests/lrbni/memory_case.h"

#define ROUNDS 200

#define RUN(name) static __attribute__((noinline)) void run_##name(memory_case *t)
#define STREAM_ROW(id, ...) \
    static const memory_row row_##id = {.name = #id, .op = LRB_OP_##id, .kind = MEMORY_STREAM, .always_masked = true, .run = run_##id, \
                                        .stream = ref_##id, __VA_ARGS__};
#define GATHER_ROW(id, ...) \
    static const memory_row row_##id = {.name = #id, .op = LRB_OP_##id, .kind = MEMORY_GATHER, .always_masked = true, .run = run_##id, \
                                        .execution = ref_##id, __VA_ARGS__};

/* UNPACK(loadunpackl_ps, ps, ...) */
#define UNPACK(id, suffix, ...)                                                                                    \
    RUN(id) { lanes_store_##suffix(t->out, lrb_##id(t->c, case_##suffix(t->old), lrb_mask(t->k), t->m).lanes); }   \
    STREAM_ROW(id, .conversions = 1, __VA_ARGS__)
#define PACK(id, suffix, ...)                                                                                      \
    RUN(id) { lrb_##id(t->c, t->m, lrb_mask(t->k), case_##suffix(t->lanes)); }                                     \
    STREAM_ROW(id, .conversions = 1, .store = true, __VA_ARGS__)
#define UNPACK_UP(id, suffix, TYPE, ...)                                                                           \
    RUN(id)                                                                                                        \
    {                                                                                                              \
        lanes_store_##suffix(t->out, lrb_##id(t->c, case_##suffix(t->old), lrb_mask(t->k), t->m,                   \
                                              (lrb_up_##suffix)t->conversion).lanes);                              \
    }                                                                                                              \
    STREAM_ROW(id, .conversions = LRB_UP_##TYPE##_COUNT, __VA_ARGS__)
#define PACK_DOWN(id, suffix, TYPE, ...)                                                                           \
    RUN(id) { lrb_##id(t->c, t->m, lrb_mask(t->k), case_##suffix(t->lanes), (lrb_down_##suffix)t->conversion); }   \
    STREAM_ROW(id, .conversions = LRB_DOWN_##TYPE##_COUNT, .store = true, __VA_ARGS__)

/* GATHER(gatherd_ps, gatherd_up_ps, ps, PS, ...): the converting form; with the first conversion it is the plain one */
#define GATHER(id, form, suffix, TYPE, ...)                                                                        \
    RUN(id)                                                                                                        \
    {                                                                                                              \
        lrb_k16 k = lrb_mask(t->k);                                                                                \
        const lrb_v16i index = case_pi(t->index);                                                                  \
        lanes_store_##suffix(t->out, (t->conversion == 0 ? lrb_##id(t->c, case_##suffix(t->old), &k, t->m, index, t->scale) \
                                                         : lrb_##form(t->c, case_##suffix(t->old), &k, t->m, index, t->scale, \
                                                                      (lrb_up_##suffix)t->conversion)).lanes);     \
        t->k = k.bits;                                                                                             \
    }                                                                                                              \
    GATHER_ROW(id, .conversions = LRB_UP_##TYPE##_COUNT, __VA_ARGS__)
#define SCATTER(id, form, suffix, TYPE, ...)                                                                       \
    RUN(id)                                                                                                        \
    {                                                                                                              \
        lrb_k16 k = lrb_mask(t->k);                                                                                \
        const lrb_v16i index = case_pi(t->index);                                                                  \
        if (t->conversion == 0)                                                                                    \
            lrb_##id(t->c, t->m, &k, index, t->scale, case_##suffix(t->lanes));                                    \
        else                                                                                                       \
            lrb_##form(t->c, t->m, &k, index, t->scale, case_##suffix(t->lanes), (lrb_down_##suffix)t->conversion); \
        t->k = k.bits;                                                                                             \
    }                                                                                                              \
    GATHER_ROW(id, .conversions = LRB_DOWN_##TYPE##_COUNT, .store = true, __VA_ARGS__)
#define WIDE .wide = true
#define INTEGER .integer = true

#define ROW_V_MS(id) UNPACK(id, ps, )
#define ROW_VI_MS(id) UNPACK(id, pi, INTEGER)
#define ROW_VD_MS(id) UNPACK(id, pd, WIDE)
#define ROW_VQ_MS(id) UNPACK(id, pq, WIDE)
#define ROW_MS_V(id) PACK(id, ps, )
#define ROW_MS_VI(id) PACK(id, pi, INTEGER)
#define ROW_MS_VD(id) PACK(id, pd, WIDE)
#define ROW_MS_VQ(id) PACK(id, pq, WIDE)
#define ROW_V_MSC(id) UNPACK_UP(id, ps, PS, )
#define ROW_VI_MSC(id) UNPACK_UP(id, pi, PI, INTEGER)
#define ROW_MSC_V(id) PACK_DOWN(id, ps, PS, )
#define ROW_MSC_VI(id) PACK_DOWN(id, pi, PI, INTEGER)
#define ROW_V_MVI(id) GATHER(id, gatherd_up_ps, ps, PS, )
#define ROW_VI_MVI(id) GATHER(id, gatherd_up_pi, pi, PI, INTEGER)
#define ROW_VD_MVI(id) GATHER(id, gatherd_up_pd, pd, PD, WIDE)
#define ROW_VQ_MVI(id) GATHER(id, gatherd_up_pq, pq, PQ, WIDE)
#define ROW_MVI_V(id) SCATTER(id, scatterd_down_ps, ps, PS, )
#define ROW_MVI_VI(id) SCATTER(id, scatterd_down_pi, pi, PI, INTEGER)
#define ROW_MVI_VD(id) SCATTER(id, scatterd_down_pd, pd, PD, WIDE)
#define ROW_MVI_VQ(id) SCATTER(id, scatterd_down_pq, pq, PQ, WIDE)
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_loadunpackl_ps, row_loadunpackl_ps */
#include "lrbni/ops.def"

#undef UNPACK
#undef PACK
#undef UNPACK_UP
#undef PACK_DOWN
#undef GATHER
#undef SCATTER
#define UNPACK(id, ...) &row_##id,
#define PACK UNPACK
#define UNPACK_UP UNPACK
#define PACK_DOWN UNPACK
#define GATHER UNPACK
#define SCATTER UNPACK
static const memory_row *const rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* &row_loadunpackl_ps, */
#include "lrbni/ops.def"
};

static void rows__every_start_mask_and_conversion__as_references(void **state)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        memory_drive(*state, rows[i], ROUNDS);
}

/* Both parts together are the whole stream, wherever it starts, and move each lane once. */
static void parts__low_and_high__the_whole_stream(void **state)
{
    lrb_ctx *c = *state;
    base_random random = {.state = 61};
    alignas(64) unsigned char memory[256], packed[256], compressed[256];
    uint32_t lanes[16], out[16], whole[16];
    for (int n = 0; n < 16 * 400; n++) {
        const uint32_t k = mask_number(n / 16 % MASKS, &random);
        for (int i = 0; i < 64; i++)
            ((uint32_t *)memory)[i] = random_bits(&random);
        for (int i = 0; i < 16; i++)
            lanes[i] = random_bits(&random);
        memcpy(packed, memory, sizeof packed);
        memcpy(compressed, memory, sizeof compressed);
        lrb_segment segments[3] = {{memory, 0x5000, 256}, {packed, 0x5000, 256}, {compressed, 0x5000, 256}};
        lrb_ptr start[3];
        for (int i = 0; i < 3; i++)
            start[i] = lrb_segment_at(segments[i], (uint32_t)(64 + 4 * (n % 16)));
        lrb_v16i d = lrb_loadunpackl_pi(c, case_pi(lanes), lrb_mask(k), lrb_at(start[0], 0));
        lanes_store_pi(out, lrb_loadunpackh_pi(c, d, lrb_mask(k), lrb_at(start[0], 64)).lanes);
        lanes_store_pi(whole, lrb_expand_pi(c, case_pi(lanes), lrb_mask(k), lrb_at(start[0], 0)).lanes);
        assert_memory_equal(out, whole, sizeof out);
        lrb_packstorel_pi(c, lrb_at(start[1], 0), lrb_mask(k), case_pi(lanes));
        lrb_packstoreh_pi(c, lrb_at(start[1], 64), lrb_mask(k), case_pi(lanes));
        lrb_compress_pi(c, lrb_at(start[2], 0), lrb_mask(k), case_pi(lanes));
        assert_memory_equal(packed, compressed, sizeof packed);
    }
}

/* A gather with 16 indices in as many lines takes 16 executions, one with all in a line takes one; the loop counts them. */
static void gather_all__by_lines__as_many_executions(void **state)
{
    lrb_ctx *c = *state;
    alignas(64) static unsigned char memory[16 * 64];
    uint32_t index[16], out[16], old[16] = {0};
    for (int lines = 1; lines <= 16; lines *= 2) {
        for (int i = 0; i < 16; i++) {
            index[i] = (uint32_t)(16 * (i % lines) + i);
            memcpy(memory + 4 * index[i], &index[i], 4);
        }
        lrb_segment segment = {memory, 0x5000, sizeof memory};
        lrb_ctx_begin(c);
        lrb_v16i d = lrb_gather_all_pi(c, case_pi(old), lrb_mask(0xffff), lrb_at(lrb_segment_at(segment, 0), 0), case_pi(index), 4);
        assert_int_equal(c->next_event - LRB_FAR, 3 * lines);
        for (int i = 0; i < lines; i++) {
            const lrb_event *e = &c->events[3 * i];
            assert_int_equal(e[0].op, LRB_OP_gatherd_pi | LRB_FORM_LINE);
            assert_int_equal(e[0].src[2], i ? 3 : 0); /* the mask of the execution before */
            assert_int_equal(e[0].src[3], i ? 3 : 0);
            assert_int_equal(e[0].aux, 0x5000 + 4 * index[i]);
            assert_int_equal(e[1].op, LRB_OP_kortest);
            assert_int_equal(e[1].src[0], 1);
            assert_int_equal(e[2].op, LRB_OP_jcc);
            assert_int_equal(e[2].mask, i < lines - 1);
        }
        lanes_store_pi(out, d.lanes);
        assert_memory_equal(out, index, sizeof out);
    }
}

/* Of all executions of a scatter together, the highest lane of those with equal indices stays. */
static void scatter_all__equal_indices__highest_lane(void **state)
{
    lrb_ctx *c = *state;
    base_random random = {.state = 62};
    alignas(64) uint32_t memory[64], expected[64], lanes[16], index[16];
    for (int n = 0; n < 20000; n++) {
        const uint32_t k = mask_number(n % MASKS, &random);
        for (int i = 0; i < 64; i++)
            memory[i] = expected[i] = random_bits(&random);
        for (int i = 0; i < 16; i++) {
            index[i] = memory_below(&random, n % 2 ? 64 : 6);
            lanes[i] = random_bits(&random);
            if (k >> i & 1)
                expected[index[i]] = lanes[i];
        }
        lrb_segment segment = {(unsigned char *)memory, 0x5000, sizeof memory};
        lrb_scatter_all_ps(c, lrb_at(lrb_segment_at(segment, 0), 0), lrb_mask(k), case_pi(index), 4, case_ps(lanes));
        assert_memory_equal(memory, expected, sizeof memory);
    }
}

/* Bits of lanes that an 8-wide op does not have are gone afterwards, so that loops end. */
static void gather_pd__upper_mask_bits__cleared(void **state)
{
    alignas(64) double memory[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    uint32_t index[16] = {7, 6, 5, 4, 3, 2, 1, 0, 99, 99}, old[16] = {0};
    double out[8];
    lrb_segment segment = {(unsigned char *)memory, 0x5000, sizeof memory};
    lrb_v8d d = lrb_gather_all_pd(*state, case_pd(old), lrb_mask(0xff0f), lrb_at(lrb_segment_at(segment, 0), 0), case_pi(index), 8);
    lanes_store_pd(out, d.lanes);
    for (int i = 0; i < 8; i++)
        assert_true(out[i] == (i < 4 ? 7 - i : 0));
}

/* PREFETCH(gatherpfd): nothing is read, whatever the address, and the mask goes as for a gather */
#define ROW_ID(id) \
    {#id, LRB_OP_##id, lrb_##id, ref_##id},
#define PREFETCHES ROW_ID(gatherpfd) ROW_ID(gatherpf2d) ROW_ID(scatterpfd) ROW_ID(scatterpf2d)

static void check_prefetch_event(const lrb_ctx *c, unsigned op, uint32_t lanes, bool line, uint32_t address)
{
    const lrb_event *e = &c->events[0];
    if (c->next_event != LRB_FAR + 1 || e->op != (op | (line && lanes ? LRB_FORM_LINE : 0)) || e->mask != lanes || e->aux != address)
        fail_msg("%s: op %04x mask %04x aux %x, expected mask %04x aux %x", lrb_op_table[op].id, e->op, e->mask, e->aux, lanes, address);
}

static void random_lines(uint32_t index[16], uint32_t addresses[16], base_random *random)
{
    for (int i = 0; i < 16; i++) {
        index[i] = memory_below(random, 3) ? memory_below(random, 40) - 20 : random_bits(random);
        addresses[i] = (uint32_t)(0x80000000u + 4 * (int64_t)(int32_t)index[i]);
    }
}

static void prefetches__no_memory__lines_by_executions(void **state)
{
    static const struct {
        const char *name;
        unsigned op;
        void (*run)(lrb_ctx *, lrb_k16 *, lrb_mem, lrb_v16i, unsigned);
        uint32_t (*ref)(uint32_t, const uint32_t[16]);
    } ops[] = {PREFETCHES};
    base_random random = {.state = 63};
    uint32_t index[16], addresses[16];
    const lrb_mem base = {.host = NULL, .address = 0x80000000u};
    for (int n = 0; n < 4 * 100 * MASKS; n++) {
        random_lines(index, addresses, &random);
        lrb_k16 k = lrb_mask(mask_number(n % MASKS, &random));
        const uint32_t before = k.bits, lanes = ops[n % 4].ref(before, addresses);
        lrb_ctx_begin(*state);
        ops[n % 4].run(*state, &k, base, case_pi(index), 4);
        assert_int_equal(k.bits, before & ~lanes);
        check_prefetch_event(*state, ops[n % 4].op, lanes, true, lanes ? addresses[__builtin_ctz(lanes)] : base.address);
    }
}

static void hints__no_memory__all_lanes_told(void **state)
{
    static const struct {
        const char *name;
        unsigned op;
        void (*run)(lrb_ctx *, lrb_k16, lrb_mem, lrb_v16i, unsigned);
        uint32_t (*ref)(uint32_t, const uint32_t[16]);
    } ops[] = {ROW_ID(gatherpf0hintd_ps) ROW_ID(gatherpf0hintd_pd) ROW_ID(scatterpf0hintd_ps) ROW_ID(scatterpf0hintd_pd)};
    base_random random = {.state = 64};
    uint32_t index[16], addresses[16];
    const lrb_mem base = {.host = NULL, .address = 0x80000000u};
    for (int n = 0; n < 4 * 100 * MASKS; n++) {
        random_lines(index, addresses, &random);
        const uint32_t k = mask_number(n % MASKS, &random), lanes = ops[n % 4].ref(k, addresses);
        lrb_ctx_begin(*state);
        ops[n % 4].run(*state, lrb_mask(k), base, case_pi(index), 4);
        check_prefetch_event(*state, ops[n % 4].op, memory_words(n % 2, lanes), false,
                             lanes ? addresses[__builtin_ctz(lanes)] : base.address);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows__every_start_mask_and_conversion__as_references),
        cmocka_unit_test(parts__low_and_high__the_whole_stream),
        cmocka_unit_test(gather_all__by_lines__as_many_executions),
        cmocka_unit_test(scatter_all__equal_indices__highest_lane),
        cmocka_unit_test(gather_pd__upper_mask_bits__cleared),
        cmocka_unit_test(prefetches__no_memory__lines_by_executions),
        cmocka_unit_test(hints__no_memory__all_lanes_told),
    };
    return cmocka_run_group_tests_name("streams " LRB_BACKEND, tests, case_setup, case_teardown);
}
