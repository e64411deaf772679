/* Every load and store against its reference: all forms and masks, all bytes around what is touched, and blocks so short
 * that touching a lane that is not selected leaves them. */
#include <stdlib.h>

#include "tests/lrbni/case.h"

enum { BLOCK = 256, ADDRESS = 0x7000 };

/* A block of memory of random bytes, what it should become, and one operand. */
typedef struct fixture {
    alignas(64) unsigned char memory[BLOCK];
    unsigned char expected[BLOCK];
    uint32_t lanes[16], old[16];
    base_random random;
} fixture;

static lrb_mem at(unsigned char *memory, int32_t offset)
{
    lrb_segment segment = {.host = memory, .address = ADDRESS, .size = BLOCK};
    return lrb_at(lrb_segment_at(segment, 0), offset);
}

static void fill(fixture *f)
{
    for (int i = 0; i < BLOCK; i++)
        f->expected[i] = f->memory[i] = (unsigned char)base_random_bits(&f->random);
    for (int i = 0; i < 16; i++)
        f->lanes[i] = random_bits(&f->random), f->old[i] = random_bits(&f->random);
}

static uint32_t word_at(const fixture *f, int32_t offset)
{
    uint32_t word;
    memcpy(&word, f->expected + offset, sizeof word);
    return word;
}

static void check_memory(const fixture *f, const char *id)
{
    for (int i = 0; i < BLOCK; i++)
        if (f->memory[i] != f->expected[i])
            fail_msg("%s: byte %d is %02x, expected %02x", id, i, f->memory[i], f->expected[i]);
}

static void check_lanes(const fixture *f, const char *id, int32_t offset, uint32_t mask, ref_load_form form,
                        int (*ref)(int, ref_load_form), const uint32_t out[16])
{
    for (int i = 0; i < 16; i++) {
        uint32_t expected = mask >> i & 1 ? word_at(f, offset + 4 * ref(i, form)) : f->old[i];
        if (out[i] != expected)
            fail_msg("%s lane %d, mask %04x, form %d, offset %d: got %08x, expected %08x", id, i, mask, form, offset, out[i],
                     expected);
    }
    check_memory(f, id);
}

static void check_event(const lrb_ctx *c, unsigned op, uint32_t mask, uint32_t address)
{
    assert_int_equal(c->next_event, LRB_FAR + 1);
    assert_int_equal(c->events[0].op, op);
    assert_int_equal(c->events[0].mask, mask);
    assert_int_equal(c->events[0].aux, address);
}

/* LOAD(load_ps, ps): in full and broadcast from every aligned place, and under every mask */
#define LOAD(id, suffix)                                                                                         \
    static void id##__every_form_and_mask__as_oracle(void **state)                                               \
    {                                                                                                            \
        lrb_ctx *c = *state;                                                                                     \
        fixture f = {.random = {.state = 6}};                                                                    \
        uint32_t out[16];                                                                                        \
        for (int n = 0; n < 64 * MASKS; n++) {                                                                   \
            int32_t offset = n % 64 * 4;                                                                         \
            uint32_t mask = mask_number(n / 64, &f.random);                                                      \
            fill(&f);                                                                                            \
            lrb_ctx_begin(c);                                                                                    \
            lanes_store_##suffix(out, lrb_load_1to16_##suffix(c, at(f.memory, offset)).lanes);                   \
            check_lanes(&f, #id, offset, 0xffff, REF_LOAD_1TO16, ref_##id, out);                                 \
            check_event(c, LRB_OP_##id | LRB_FORM_4_BYTES, 0xffff, ADDRESS + (uint32_t)offset);                  \
            offset &= -16;                                                                                       \
            lrb_ctx_begin(c);                                                                                    \
            lanes_store_##suffix(out, lrb_load_4to16_##suffix(c, at(f.memory, offset)).lanes);                   \
            check_lanes(&f, #id, offset, 0xffff, REF_LOAD_4TO16, ref_##id, out);                                 \
            check_event(c, LRB_OP_##id | LRB_FORM_16_BYTES, 0xffff, ADDRESS + (uint32_t)offset); \
            offset &= -64;                                                                                       \
            lrb_ctx_begin(c);                                                                                    \
            lanes_store_##suffix(out, lrb_load_##suffix(c, at(f.memory, offset)).lanes);                         \
            check_lanes(&f, #id, offset, 0xffff, REF_LOAD_FULL, ref_##id, out);                                  \
            check_event(c, LRB_OP_##id, 0xffff, ADDRESS + (uint32_t)offset);                                     \
            lrb_ctx_begin(c);                                                                                    \
            lanes_store_##suffix(out, lrb_mask_load_##suffix(c, case_##suffix(f.old), lrb_mask(mask), at(f.memory, offset)).lanes); \
            check_lanes(&f, #id, offset, mask, REF_LOAD_FULL, ref_##id, out);                                    \
            check_event(c, LRB_OP_##id, mask, ADDRESS + (uint32_t)offset);                                       \
        }                                                                                                        \
    }

/* STORE(store_ps, ps): in full and under every mask, to every aligned place; nothing else changes */
#define STORE(id, suffix)                                                                                        \
    static void id##__every_mask__selected_words_only(void **state)                                              \
    {                                                                                                            \
        lrb_ctx *c = *state;                                                                                     \
        fixture f = {.random = {.state = 7}};                                                                    \
        for (int n = 0; n < 64 * (MASKS + 1); n++) {                                                             \
            int32_t offset = n % 4 * 64;                                                                         \
            bool masked = n / 64 < MASKS;                                                                        \
            uint32_t mask = masked ? mask_number(n / 64, &f.random) : 0xffff;                                    \
            fill(&f);                                                                                            \
            for (int word = 0; word < 16; word++)                                                                \
                if (mask >> ref_##id(word) & 1)                                                                  \
                    memcpy(f.expected + offset + 4 * word, &f.lanes[ref_##id(word)], 4);                         \
            lrb_ctx_begin(c);                                                                                    \
            if (masked)                                                                                          \
                lrb_mask_store_##suffix(c, at(f.memory, offset), lrb_mask(mask), case_##suffix(f.lanes));        \
            else                                                                                                 \
                lrb_store_##suffix(c, at(f.memory, offset), case_##suffix(f.lanes));                             \
            check_memory(&f, #id);                                                                               \
            check_event(c, LRB_OP_##id, mask, ADDRESS + (uint32_t)offset);                                       \
        }                                                                                                        \
    }

/* LOAD_SCALAR(load32): from every byte, with an index register and without */
#define LOAD_SCALAR(id)                                                                                          \
    static void id##__any_alignment__as_oracle(void **state)                                                     \
    {                                                                                                            \
        lrb_ctx *c = *state;                                                                                     \
        fixture f = {.random = {.state = 8}};                                                                    \
        for (int32_t offset = 0; offset <= BLOCK - 4; offset++) {                                                \
            fill(&f);                                                                                            \
            lrb_ctx_begin(c);                                                                                    \
            lrb_r64 direct = lrb_##id(c, at(f.memory, offset));                                                  \
            check_event(c, LRB_OP_##id, 0xffff, ADDRESS + (uint32_t)offset);                                     \
            lrb_segment segment = {.host = f.memory, .address = ADDRESS, .size = BLOCK};                         \
            lrb_mem indexed = lrb_at_index(lrb_segment_at(segment, 64), lrb_imm((uint64_t)offset / 4 - 16), 4, offset % 4); \
            assert_int_equal(indexed.address, ADDRESS + (uint32_t)offset);                                       \
            assert_true(direct.value == ref_##id(f.expected + offset));                                          \
            assert_true(lrb_##id(c, indexed).value == ref_##id(f.expected + offset));                            \
            check_memory(&f, #id);                                                                               \
        }                                                                                                        \
    }

/* STORE_SCALAR(store32): to every byte */
#define STORE_SCALAR(id)                                                                                         \
    static void id##__any_alignment__its_bytes_only(void **state)                                                \
    {                                                                                                            \
        lrb_ctx *c = *state;                                                                                     \
        fixture f = {.random = {.state = 9}};                                                                    \
        for (int32_t offset = 0; offset <= BLOCK - 4; offset++) {                                                \
            uint64_t value = base_random_bits(&f.random);                                                        \
            fill(&f);                                                                                            \
            ref_##id(f.expected + offset, value);                                                                \
            lrb_ctx_begin(c);                                                                                    \
            lrb_##id(c, at(f.memory, offset), lrb_imm(value));                                                   \
            check_event(c, LRB_OP_##id, 0xffff, ADDRESS + (uint32_t)offset);                                     \
            check_memory(&f, #id);                                                                               \
        }                                                                                                        \
    }

#define ROW_V_M(id) LOAD(id, ps)
#define ROW_VI_M(id) LOAD(id, pi)
#define ROW_M_V(id) STORE(id, ps)
#define ROW_M_VI(id) STORE(id, pi)
#define ROW_R_M(id) LOAD_SCALAR(id)
#define ROW_M_R(id) STORE_SCALAR(id)
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* load_ps__every_form_... */
#include "lrbni/ops.def"

/* Only the first eight words exist; the sanitizers see any access beyond them. */
static void masked_access__block_ends_after_the_selected_words__stays_inside(void **state)
{
    lrb_ctx *c = *state;
    void *half = NULL;
    assert_int_equal(posix_memalign(&half, 64, 32), 0);
    uint32_t lanes[16], out[16];
    for (int i = 0; i < 16; i++)
        lanes[i] = 0x1000u + (uint32_t)i;
    lrb_mask_store_pi(c, at(half, 0), lrb_mask(0x00ff), case_pi(lanes));
    lrb_mask_store_ps(c, at(half, 0), lrb_mask(0x0081), case_ps(lanes));
    lanes_store_pi(out, lrb_mask_load_pi(c, case_pi(lanes), lrb_mask(0x00ff), at(half, 0)).lanes);
    assert_memory_equal(out, lanes, sizeof out);
    lanes_store_ps(out, lrb_mask_load_ps(c, case_ps(lanes), lrb_mask(0x000f), at(half, 0)).lanes);
    assert_memory_equal(out, lanes, sizeof out);
    free(half);
}

/* No word is selected, and no block is there: nothing may be read or written. */
static void masked_access__no_lane_and_no_memory__no_fault(void **state)
{
    lrb_ctx *c = *state;
    uint32_t lanes[16] = {1, 2, 3}, out[16];
    lrb_mem nowhere = {.host = NULL, .address = ADDRESS};
    lrb_mask_store_pi(c, nowhere, lrb_mask(0), case_pi(lanes));
    lanes_store_pi(out, lrb_mask_load_pi(c, case_pi(lanes), lrb_mask(0), nowhere).lanes);
    assert_memory_equal(out, lanes, sizeof out);
}

#undef ROW_V_M
#undef ROW_VI_M
#undef ROW_M_V
#undef ROW_M_VI
#undef ROW_R_M
#undef ROW_M_R
#define ROW_V_M(id) cmocka_unit_test(id##__every_form_and_mask__as_oracle),
#define ROW_VI_M(id) cmocka_unit_test(id##__every_form_and_mask__as_oracle),
#define ROW_M_V(id) cmocka_unit_test(id##__every_mask__selected_words_only),
#define ROW_M_VI(id) cmocka_unit_test(id##__every_mask__selected_words_only),
#define ROW_R_M(id) cmocka_unit_test(id##__any_alignment__as_oracle),
#define ROW_M_R(id) cmocka_unit_test(id##__any_alignment__its_bytes_only),

int main(void)
{
    const struct CMUnitTest tests[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"load_ps__...", ...}, */
#include "lrbni/ops.def"
        cmocka_unit_test(masked_access__block_ends_after_the_selected_words__stays_inside),
        cmocka_unit_test(masked_access__no_lane_and_no_memory__no_fault),
    };
    return cmocka_run_group_tests_name("load_store " LRB_BACKEND, tests, case_setup, case_teardown);
}
