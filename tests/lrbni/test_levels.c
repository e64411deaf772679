/* The levels of accounting: the same state after a program of every op, and the same counts from histograms and from events. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/lrbni/operands.h"
#include "tests/lrbni/program.h"

enum { ROUNDS = 64, STEPS = ROUNDS * LRB_OP_COUNT };

/* What a run leaves behind. */
typedef struct outcome {
    program_state state;
    unsigned char scratch[LRB_SCRATCH_BYTES];
    uint64_t ops[LRB_OP_COUNT], idle_lanes, memory_operands;
    bool lined; /* a line has been named */
    uint64_t without_line; /* ops before that */
} outcome;

/* Count what events say. */
static void count_events(void *user, const lrb_event *events, uint32_t count)
{
    outcome *o = user;
    for (uint32_t i = 0; i < count; i++) {
        lrb_op_id id = (lrb_op_id)(events[i].op & LRB_EVENT_ID);
        assert_true(id < LRB_OP_COUNT);
        o->ops[id]++;
        o->lined |= id == LRB_OP_line;
        o->without_line += !o->lined && lrb_op_kind_of(id) != LRB_KIND_MARKER;
        o->memory_operands += events[i].op & LRB_FORM_MEMORY ? 1 : 0;
        if (lrb_op_kind_of(id) == LRB_KIND_VECTOR)
            o->idle_lanes += 16u - (unsigned)__builtin_popcount(events[i].mask);
    }
}

/* Every op of the table, time and again with other operands. */
static uint8_t *program_of_every_op(base_random *random)
{
    uint8_t *code = malloc((size_t)STEPS * PROGRAM_STEP);
    assert_non_null(code);
    for (int i = 0; i < STEPS; i++) {
        uint8_t *step = code + (size_t)i * PROGRAM_STEP;
        for (int j = 0; j < PROGRAM_STEP; j++)
            step[j] = (uint8_t)base_random_bits(random);
        step[0] = (uint8_t)(i % LRB_OP_COUNT);
        step[7] = (uint8_t)(i % LRB_OP_COUNT >> 8);
    }
    return code;
}

static outcome *run(program_fn *program, bool record)
{
    outcome *o = aligned_alloc(_Alignof(outcome), sizeof *o);
    assert_non_null(o);
    memset(o, 0, sizeof *o);
    base_random random = {.state = 40};
    uint8_t *code = program_of_every_op(&random);
    for (int i = 0; i < PROGRAM_REGISTERS; i++) {
        for (int lane = 0; lane < 16; lane++)
            o->state.v[i][lane] = random_bits(&random);
        o->state.k[i] = (uint32_t)base_random_bits(&random);
        o->state.r[i] = base_random_bits(&random);
    }
    lrb_ctx *c = NULL;
    assert_int_equal(lrb_ctx_create(record ? count_events : NULL, o, &c, NULL), BASE_OK);
    lrb_ctx_begin(c);
    program(c, &o->state, code, (size_t)STEPS * PROGRAM_STEP);
    lrb_ctx_end(c);
    memcpy(o->scratch, c->scratch.host, sizeof o->scratch);
    if (!record) {
        memcpy(o->ops, c->ops, sizeof o->ops);
        o->idle_lanes = c->idle_lanes;
        o->memory_operands = c->memory_operands;
    }
    lrb_ctx_destroy(&c);
    assert_null(c);
    free(code);
    return o;
}

static bool same(const outcome *a, const outcome *b)
{
    return memcmp(a->state.v, b->state.v, sizeof a->state.v) == 0 && memcmp(a->state.k, b->state.k, sizeof a->state.k) == 0 &&
           memcmp(a->state.r, b->state.r, sizeof a->state.r) == 0 && a->state.flags == b->state.flags &&
           a->state.p == b->state.p && memcmp(a->state.memory, b->state.memory, sizeof a->state.memory) == 0 &&
           memcmp(a->scratch, b->scratch, sizeof a->scratch) == 0;
}

static void levels__same_source__same_state(void **state)
{
    (void)state;
    outcome *native = run(program_run_native, false), *count = run(program_run_count, false);
    outcome *record = run(program_run_record, true), *unheard = run(program_run_record, false);
    static const unsigned char zeros[PROGRAM_MEMORY];
    assert_memory_not_equal(native->state.memory, zeros, sizeof zeros);
    assert_true(same(native, count));
    assert_true(same(native, record));
    assert_true(same(native, unheard));
    free(native), free(count), free(record), free(unheard);
}

static void native__nothing_counted__zeros(void **state)
{
    (void)state;
    outcome *native = run(program_run_native, false);
    for (int i = 0; i < LRB_OP_COUNT; i++)
        assert_true(native->ops[i] == 0);
    assert_true(native->idle_lanes == 0 && native->memory_operands == 0);
    free(native);
}

static void count__histogram__as_the_events_of_record(void **state)
{
    (void)state;
    outcome *count = run(program_run_count, false), *record = run(program_run_record, true);
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        bool marker = lrb_op_kind_of((lrb_op_id)i) == LRB_KIND_MARKER;
        if (record->ops[i] == 0 && i != LRB_OP_line && i != LRB_OP_far)
            fail_msg("the program does not reach %s", lrb_op_table[i].id);
        if (count->ops[i] != (marker ? 0 : record->ops[i]))
            fail_msg("%s: counted %llu, recorded %llu", lrb_op_table[i].id, (unsigned long long)count->ops[i],
                     (unsigned long long)record->ops[i]);
    }
    assert_true(count->idle_lanes == record->idle_lanes && count->idle_lanes > 0);
    assert_true(count->memory_operands == record->memory_operands && count->memory_operands > 0);
    free(count), free(record);
}

/* Ops are counted as at count. Events are those of record that access memory, less some, by their shape or by an operand there, and all hints;
 * which are left out is the matter of kernels/levels. */
static void touch__every_op__counted_and_accesses_of_record(void **state)
{
    (void)state;
    outcome *record = run(program_run_record, true), *touch = run(program_run_touch, true);
    outcome *count = run(program_run_count, false), *counted = run(program_run_touch, false);
    assert_true(same(record, touch));
    assert_memory_equal(counted->ops, count->ops, sizeof count->ops);
    assert_true(counted->idle_lanes == count->idle_lanes && counted->memory_operands == count->memory_operands);
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        const lrb_access access = lrb_op_access_of((lrb_op_id)i);
        const uint64_t seen = touch->ops[i], made = record->ops[i];
        if (seen > made || (access == LRB_ACCESS_HINT && seen != made) || (access != LRB_ACCESS_NONE && (seen == 0) != (made == 0)))
            fail_msg("%s: touched %llu, recorded %llu", lrb_op_table[i].id, (unsigned long long)seen, (unsigned long long)made);
    }
    assert_true(touch->memory_operands > 0 && touch->memory_operands <= record->memory_operands);
    free(record), free(touch), free(count), free(counted);
}

/* The operands of some calls are ops themselves, whose order is the compiler's: the streams hold the same ops. */
static void lines__every_op__the_ops_of_record_and_markers(void **state)
{
    (void)state;
    outcome *record = run(program_run_record, true), *lines = run(program_run_annotated, true);
    assert_true(same(record, lines));
    assert_true(lines->ops[LRB_OP_line] > record->ops[LRB_OP_line] + STEPS / 2); /* the program has markers of its own */
    lines->ops[LRB_OP_line] = record->ops[LRB_OP_line];
    assert_memory_equal(record->ops, lines->ops, sizeof record->ops);
    assert_true(lines->lined && lines->without_line == 0);
    free(record), free(lines);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels__same_source__same_state),
        cmocka_unit_test(native__nothing_counted__zeros),
        cmocka_unit_test(count__histogram__as_the_events_of_record),
        cmocka_unit_test(touch__every_op__counted_and_accesses_of_record),
        cmocka_unit_test(lines__every_op__the_ops_of_record_and_markers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
