/* The three levels of accounting: the same lanes at each, and the same counts from histograms and from events. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "tests/lrbni/level_kernel.h"

/* What a run leaves behind. */
typedef struct outcome {
    unsigned char *data; /* LEVEL_BYTES */
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

static outcome *run(level_kernel_fn *kernel, bool record)
{
    outcome *o = calloc(1, sizeof *o);
    assert_non_null(o);
    o->data = aligned_alloc(64, LEVEL_BYTES);
    assert_non_null(o->data);
    base_random random = {.state = 40};
    for (int i = 0; i < LEVEL_BYTES; i++)
        o->data[i] = (unsigned char)base_random_bits(&random);
    lrb_memory memory = lrb_memory_empty();
    lrb_segment segment;
    lrb_ctx *c = NULL;
    assert_int_equal(lrb_memory_map(&memory, "data", o->data, LEVEL_BYTES, &segment, NULL), BASE_OK);
    assert_int_equal(lrb_ctx_create(record ? count_events : NULL, o, &c, NULL), BASE_OK);
    lrb_ctx_begin(c);
    kernel(c, segment);
    lrb_ctx_end(c);
    memcpy(o->scratch, c->scratch.host, sizeof o->scratch);
    if (!record) {
        memcpy(o->ops, c->ops, sizeof o->ops);
        o->idle_lanes = c->idle_lanes;
        o->memory_operands = c->memory_operands;
    }
    lrb_ctx_destroy(&c);
    assert_null(c);
    return o;
}

static void discard(outcome *o)
{
    free(o->data);
    free(o);
}

static void levels__same_source__same_lanes(void **state)
{
    (void)state;
    outcome *native = run(level_kernel_0, false), *count = run(level_kernel_1, false);
    outcome *record = run(level_kernel_2, true), *unheard = run(level_kernel_2, false);
    static const unsigned char zeros[640];
    assert_memory_not_equal(native->scratch, zeros, 128);
    assert_memory_equal(native->scratch, count->scratch, sizeof native->scratch);
    assert_memory_equal(native->scratch, record->scratch, sizeof native->scratch);
    assert_memory_equal(native->scratch, unheard->scratch, sizeof native->scratch);
    assert_memory_equal(native->data, record->data, LEVEL_BYTES);
    discard(native), discard(count), discard(record), discard(unheard);
}

static void native__nothing_counted__zeros(void **state)
{
    (void)state;
    outcome *native = run(level_kernel_0, false);
    for (int i = 0; i < LRB_OP_COUNT; i++)
        assert_true(native->ops[i] == 0);
    assert_true(native->idle_lanes == 0 && native->memory_operands == 0);
    discard(native);
}

static void count__histogram__as_the_events_of_record(void **state)
{
    (void)state;
    outcome *count = run(level_kernel_1, false), *record = run(level_kernel_2, true);
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        bool marker = lrb_op_kind_of((lrb_op_id)i) == LRB_KIND_MARKER;
        if (record->ops[i] == 0 && i != LRB_OP_line && i != LRB_OP_far)
            fail_msg("the kernel does not use %s", lrb_op_table[i].id);
        if (count->ops[i] != (marker ? 0 : record->ops[i]))
            fail_msg("%s: counted %llu, recorded %llu", lrb_op_table[i].id, (unsigned long long)count->ops[i],
                     (unsigned long long)record->ops[i]);
    }
    assert_true(count->idle_lanes == record->idle_lanes && count->idle_lanes > 0);
    assert_true(count->memory_operands == record->memory_operands);
    assert_true(count->memory_operands == UINT64_C(3) * LEVEL_VECTORS);
    discard(count), discard(record);
}

/* The operands of some calls are ops themselves, whose order is the compiler's: the streams hold the same ops. */
static void lines__every_op__the_ops_of_record_and_markers(void **state)
{
    (void)state;
    outcome *record = run(level_kernel_2, true), *lines = run(level_kernel_annotated, true);
    assert_memory_equal(record->scratch, lines->scratch, sizeof record->scratch);
    assert_true(record->ops[LRB_OP_line] == 0 && lines->ops[LRB_OP_line] > 20 * LEVEL_VECTORS);
    lines->ops[LRB_OP_line] = 0;
    assert_memory_equal(record->ops, lines->ops, sizeof record->ops);
    assert_true(lines->lined && lines->without_line == 0);
    discard(record), discard(lines);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels__same_source__same_lanes),
        cmocka_unit_test(native__nothing_counted__zeros),
        cmocka_unit_test(count__histogram__as_the_events_of_record),
        cmocka_unit_test(lines__every_op__the_ops_of_record_and_markers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
