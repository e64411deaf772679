/* Every vector load and store of consecutive elements against its references: all masks, forms and conversions, the event, and guarded
 * pages before and behind what may be touched. */
#include "tests/lrbni/memory_case.h"

#define ROUNDS 400

/* Register of the case as the suffix has it. */
#define RUN(form) static __attribute__((noinline)) void run_##form(memory_case *t)

/* LOAD(load_1to16_ps, load_ps, ps, 1): lrb_load_1to16_ps and lrb_mask_load_1to16_ps, forms of load_ps that read one element */
#define LOAD(form, id, suffix, is_wide, elements)                                                                \
    RUN(form)                                                                                                    \
    {                                                                                                            \
        lanes_store_##suffix(t->out, (t->masked ? lrb_mask_##form(t->c, case_##suffix(t->old), lrb_mask(t->k), t->m) \
                                                : lrb_##form(t->c, t->m)).lanes);                                \
    }                                                                                                            \
    static const memory_row row_##form = {.name = #form, .op = LRB_OP_##id, .wide = is_wide, .period = elements, \
                                          .conversions = 1, .integer = LRB_INTEGER_##suffix, .run = run_##form, .plain = ref_##id};
#define STORE(form, id, suffix, is_wide, elements)                                                               \
    RUN(form)                                                                                                    \
    {                                                                                                            \
        if (t->masked)                                                                                           \
            lrb_mask_##form(t->c, t->m, lrb_mask(t->k), case_##suffix(t->lanes));                                \
        else                                                                                                     \
            lrb_##form(t->c, t->m, case_##suffix(t->lanes));                                                     \
    }                                                                                                            \
    static const memory_row row_##form = {.name = #form, .op = LRB_OP_##id, .store = true, .wide = is_wide, .period = elements, \
                                          .conversions = 1, .integer = LRB_INTEGER_##suffix, .run = run_##form, .written = ref_##id};
#define LINE_STORE(form, suffix, is_wide)                                                                        \
    RUN(form) { lrb_##form(t->c, t->m, case_##suffix(t->lanes)); }                                               \
    static const memory_row row_##form = {.name = #form, .op = LRB_OP_##form, .store = true, .wide = is_wide, .never_masked = true, \
                                          .period = is_wide ? 8 : 16, .conversions = 1, .run = run_##form, .written = ref_##form};
#define LOAD_UP(form, id, suffix, TYPE, elements)                                                                \
    RUN(form)                                                                                                    \
    {                                                                                                            \
        const lrb_up_##suffix up = (lrb_up_##suffix)t->conversion;                                               \
        lanes_store_##suffix(t->out, (t->masked ? lrb_mask_##form(t->c, case_##suffix(t->old), lrb_mask(t->k), t->m, up) \
                                                : lrb_##form(t->c, t->m, up)).lanes);                            \
    }                                                                                                            \
    static const memory_row row_##form = {.name = #form, .op = LRB_OP_##id, .period = elements, .conversions = LRB_UP_##TYPE##_COUNT, \
                                          .integer = LRB_INTEGER_##suffix, .run = run_##form};
#define STORE_DOWN(form, id, suffix, TYPE, elements)                                                             \
    RUN(form)                                                                                                    \
    {                                                                                                            \
        const lrb_down_##suffix down = (lrb_down_##suffix)t->conversion;                                         \
        if (t->masked)                                                                                           \
            lrb_mask_##form(t->c, t->m, lrb_mask(t->k), case_##suffix(t->lanes), down);                          \
        else                                                                                                     \
            lrb_##form(t->c, t->m, case_##suffix(t->lanes), down);                                               \
    }                                                                                                            \
    static const memory_row row_##form = {.name = #form, .op = LRB_OP_##id, .store = true, .period = elements,   \
                                          .conversions = LRB_DOWN_##TYPE##_COUNT, .integer = LRB_INTEGER_##suffix, .run = run_##form};
#define LRB_INTEGER_ps false
#define LRB_INTEGER_pi true
#define LRB_INTEGER_pd false
#define LRB_INTEGER_pq false

#define ROW_V_M(id) LOAD(id, id, ps, false, 16)
#define ROW_VI_M(id) LOAD(id, id, pi, false, 16)
#define ROW_VD_M(id) LOAD(id, id, pd, true, 8)
#define ROW_VQ_M(id) LOAD(id, id, pq, true, 8)
#define ROW_M_V(id) STORE(id, id, ps, false, 16)
#define ROW_M_VI(id) STORE(id, id, pi, false, 16)
#define ROW_M_VD(id) STORE(id, id, pd, true, 8)
#define ROW_M_VQ(id) STORE(id, id, pq, true, 8)
#define ROW_ML_V(id) LINE_STORE(id, ps, false)
#define ROW_ML_VD(id) LINE_STORE(id, pd, true)
#define ROW_V_MC(id) LOAD_UP(id, id, ps, PS, 16)
#define ROW_VI_MC(id) LOAD_UP(id, id, pi, PI, 16)
#define ROW_MC_V(id) STORE_DOWN(id, id, ps, PS, 16)
#define ROW_MC_VI(id) STORE_DOWN(id, id, pi, PI, 16)
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_load_ps, row_load_ps */
#include "lrbni/ops.def"
LOAD(load_1to16_ps, load_ps, ps, false, 1)
LOAD(load_1to16_pi, load_pi, pi, false, 1)
LOAD(load_1to8_pd, load_pd, pd, true, 1)
LOAD(load_1to8_pq, load_pq, pq, true, 1)
LOAD(load_4to16_ps, load_ps, ps, false, 4)
LOAD(load_4to16_pi, load_pi, pi, false, 4)
LOAD(load_4to8_pd, load_pd, pd, true, 4)
LOAD(load_4to8_pq, load_pq, pq, true, 4)
STORE(store_1_ps, store_ps, ps, false, 1)
STORE(store_1_pi, store_pi, pi, false, 1)
STORE(store_1_pd, store_pd, pd, true, 1)
STORE(store_1_pq, store_pq, pq, true, 1)
STORE(store_4_ps, store_ps, ps, false, 4)
STORE(store_4_pi, store_pi, pi, false, 4)
STORE(store_4_pd, store_pd, pd, true, 4)
STORE(store_4_pq, store_pq, pq, true, 4)
LOAD_UP(load_up_1to16_ps, load_up_ps, ps, PS, 1)
LOAD_UP(load_up_1to16_pi, load_up_pi, pi, PI, 1)
LOAD_UP(load_up_4to16_ps, load_up_ps, ps, PS, 4)
LOAD_UP(load_up_4to16_pi, load_up_pi, pi, PI, 4)
STORE_DOWN(store_down_1_ps, store_down_ps, ps, PS, 1)
STORE_DOWN(store_down_1_pi, store_down_pi, pi, PI, 1)
STORE_DOWN(store_down_4_ps, store_down_ps, ps, PS, 4)
STORE_DOWN(store_down_4_pi, store_down_pi, pi, PI, 4)

static void rows__every_form_mask_and_conversion__as_references(void **state)
{
#undef LOAD
#undef STORE
#undef LINE_STORE
#undef LOAD_UP
#undef STORE_DOWN
#define LOAD(form, ...) &row_##form,
#define STORE LOAD
#define LINE_STORE LOAD
#define LOAD_UP LOAD
#define STORE_DOWN LOAD
    static const memory_row *const rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* &row_load_ps, */
#include "lrbni/ops.def"
        &row_load_1to16_ps, &row_load_1to16_pi, &row_load_1to8_pd, &row_load_1to8_pq, &row_load_4to16_ps, &row_load_4to16_pi,
        &row_load_4to8_pd, &row_load_4to8_pq, &row_store_1_ps, &row_store_1_pi, &row_store_1_pd, &row_store_1_pq, &row_store_4_ps,
        &row_store_4_pi, &row_store_4_pd, &row_store_4_pq, &row_load_up_1to16_ps, &row_load_up_1to16_pi, &row_load_up_4to16_ps,
        &row_load_up_4to16_pi, &row_store_down_1_ps, &row_store_down_1_pi, &row_store_down_4_ps, &row_store_down_4_pi,
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        memory_drive(*state, rows[i], ROUNDS);
}

/* S3_UP(ps, PS, mov_ps): the formats that S3 has, as last source of a move, at the end of a block of their size */
#define S3_UP(suffix, TYPE, move)                                                                                \
    static void s3_##suffix##__every_format__as_references(void **state)                                         \
    {                                                                                                            \
        memory_block *b = memory_block_create(67);                                                               \
        for (int up = 0; up < LRB_UP_##TYPE##_COUNT; up++) {                                                     \
            if (!lrb_up_##suffix##_in_s3((lrb_up_##suffix)up))                                                   \
                continue;                                                                                        \
            const unsigned bytes = lrb_up_##suffix##_bytes((lrb_up_##suffix)up);                                 \
            const lrb_mem m = {.host = b->page + MEMORY_PAGE - 16 * bytes, .address = MEMORY_ADDRESS};           \
            uint32_t lanes[16];                                                                                  \
            lrb_ctx_begin(*state);                                                                               \
            lanes_store_##suffix(lanes, lrb_##move##_s3(*state, lrb_from_##suffix(m, (lrb_up_##suffix)up)).lanes); \
            for (unsigned i = 0; i < 16; i++)                                                                    \
                assert_int_equal(lanes[i], ref_load_up_##suffix(up, m.host + bytes * i));                        \
            const lrb_event *e = &((const lrb_ctx *)*state)->events[0];                                          \
            assert_int_equal(e->op, LRB_OP_##move | LRB_FORM_MEMORY | (bytes == 1   ? LRB_FORM_16_BYTES            \
                                                                     : bytes == 2 ? LRB_FORM_32_BYTES : 0));     \
            assert_int_equal(e->aux, MEMORY_ADDRESS);                                                            \
        }                                                                                                        \
        memory_block_free(b);                                                                                    \
    }
S3_UP(ps, PS, mov_ps)
S3_UP(pi, PI, mov_pi)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows__every_form_mask_and_conversion__as_references),
        cmocka_unit_test(s3_ps__every_format__as_references),
        cmocka_unit_test(s3_pi__every_format__as_references),
    };
    return cmocka_run_group_tests_name("load_store " LRB_BACKEND, tests, case_setup, case_teardown);
}
