/* Loads and stores of general registers against their references, at every address, with an index register and without. */
#include <stdlib.h>

#include "tests/lrbni/case.h"

enum { BLOCK = 256, ADDRESS = 0x7000 };

/* A block of random bytes, and what it should become. */
typedef struct fixture {
    unsigned char memory[BLOCK], expected[BLOCK];
    base_random random;
} fixture;

static lrb_mem at(fixture *f, int32_t offset)
{
    lrb_segment segment = {.host = f->memory, .address = ADDRESS, .size = BLOCK};
    return lrb_at(lrb_segment_at(segment, 0), offset);
}

/* The same place as base + index * scale + displacement. */
static lrb_mem at_index(fixture *f, int32_t offset)
{
    lrb_segment segment = {.host = f->memory, .address = ADDRESS, .size = BLOCK};
    return lrb_at_index(lrb_segment_at(segment, 64), lrb_imm((uint64_t)offset / 4 - 16), 4, offset % 4);
}

static void fill(fixture *f)
{
    for (int i = 0; i < BLOCK; i++)
        f->expected[i] = f->memory[i] = (unsigned char)base_random_bits(&f->random);
}

typedef struct load_row {
    const char *name;
    unsigned op;
    lrb_r64 (*load)(lrb_ctx *c, lrb_mem m);
    uint64_t (*ref)(const unsigned char *bytes);
} load_row;

typedef struct store_row {
    const char *name;
    unsigned op;
    void (*store)(lrb_ctx *c, lrb_mem m, lrb_r64 a);
    void (*ref)(unsigned char *bytes, uint64_t a);
} store_row;

/* "load16s": 2 */
static int bytes_of(const char *name) { return atoi(name + strcspn(name, "0123456789")) / 8; }

static void check_event(const lrb_ctx *c, unsigned op, int bytes, uint32_t address)
{
    const lrb_event *e = &c->events[0];
    if (c->next_event != LRB_FAR + 1 || e->op != (op | (bytes == 8 ? LRB_FORM_8_BYTES : 0)) || e->mask != 0xffff || e->aux != address)
        fail_msg("%s: op %04x mask %04x aux %x, expected %x", lrb_op_table[op].id, e->op, e->mask, e->aux, address);
}

static void loads__any_alignment__as_references(void **state)
{
#define ROW_R_M(id) {#id, LRB_OP_##id, lrb_##id, ref_##id},
#include "tests/lrbni/rows.h"
    static const load_row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"load32", ...}, */
#include "lrbni/ops.def"
    };
    fixture f = {.random = {.state = 8}};
    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        const int bytes = bytes_of(rows[n].name);
        for (int32_t offset = 0; offset <= BLOCK - bytes; offset++) {
            fill(&f);
            const uint64_t expected = rows[n].ref(f.expected + offset);
            lrb_ctx_begin(*state);
            const uint64_t direct = rows[n].load(*state, at(&f, offset)).value;
            check_event(*state, rows[n].op, bytes, ADDRESS + (uint32_t)offset);
            if (direct != expected || rows[n].load(*state, at_index(&f, offset)).value != expected)
                fail_msg("%s: got %llx, expected %llx", rows[n].name, (unsigned long long)direct, (unsigned long long)expected);
            assert_memory_equal(f.memory, f.expected, BLOCK);
        }
    }
}

#undef ROW_R_M
#define ROW_R_M(id)
#undef ROW_M_R
static void stores__any_alignment__their_bytes_only(void **state)
{
#define ROW_M_R(id) {#id, LRB_OP_##id, lrb_##id, ref_##id},
    static const store_row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"store32", ...}, */
#include "lrbni/ops.def"
    };
    fixture f = {.random = {.state = 9}};
    for (size_t n = 0; n < sizeof rows / sizeof rows[0]; n++) {
        const int bytes = bytes_of(rows[n].name);
        for (int32_t offset = 0; offset <= BLOCK - bytes; offset++) {
            const uint64_t value = base_random_bits(&f.random);
            fill(&f);
            rows[n].ref(f.expected + offset, value);
            lrb_ctx_begin(*state);
            rows[n].store(*state, offset % 2 ? at(&f, offset) : at_index(&f, offset), lrb_imm(value));
            check_event(*state, rows[n].op, bytes, ADDRESS + (uint32_t)offset);
            assert_memory_equal(f.memory, f.expected, BLOCK);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads__any_alignment__as_references),
        cmocka_unit_test(stores__any_alignment__their_bytes_only),
    };
    return cmocka_run_group_tests_name("scalar_memory " LRB_BACKEND, tests, case_setup, case_teardown);
}
