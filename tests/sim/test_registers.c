/* Register pressure against a count that goes over the stream again for every op, and spills against the fewest there can be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/registers.h"
#include "tests/sim/random_stream.h"

static const unsigned no_limits[SIM_FILES] = {0, 0, 0};

static sim_registers_stats analyse(const unsigned registers[SIM_FILES], const lrb_event *events, uint32_t count)
{
    sim_registers *r = NULL;
    assert_int_equal(sim_registers_create(registers, &r, NULL), BASE_OK);
    sim_registers_events(r, events, count / 2); /* batches are no boundaries */
    sim_registers_events(r, events + count / 2, count - count / 2);
    assert_int_equal(sim_registers_end(r, NULL), BASE_OK);
    sim_registers_stats stats = *sim_registers_get(r);
    sim_registers_destroy(&r);
    assert_null(r);
    return stats;
}

static lrb_event op(lrb_op_id id, unsigned s0, unsigned s1, unsigned s2, unsigned s3)
{
    return (lrb_event){.op = (uint16_t)id, .mask = 0xffff, .src = {(uint16_t)s0, (uint16_t)s1, (uint16_t)s2, (uint16_t)s3}};
}

static void files__by_shape__the_register_of_the_result(void **state)
{
    (void)state;
    assert_int_equal(sim_file_of(LRB_OP_madd231_ps), SIM_FILE_VECTOR);
    assert_int_equal(sim_file_of(LRB_OP_load_pi), SIM_FILE_VECTOR);
    assert_int_equal(sim_file_of(LRB_OP_cmplt_ps), SIM_FILE_MASK);
    assert_int_equal(sim_file_of(LRB_OP_kmov_kr), SIM_FILE_MASK);
    assert_int_equal(sim_file_of(LRB_OP_kmov_rk), SIM_FILE_GENERAL);
    assert_int_equal(sim_file_of(LRB_OP_lea), SIM_FILE_GENERAL);
    assert_int_equal(sim_file_of(LRB_OP_kortest), SIM_FILES);
    assert_int_equal(sim_file_of(LRB_OP_store_ps), SIM_FILES);
    assert_int_equal(sim_file_of(LRB_OP_jcc), SIM_FILES);
    assert_int_equal(sim_file_of(LRB_OP_phase), SIM_FILES);
}

static void pressure__small_stream__counted_by_hand(void **state)
{
    const lrb_event events[] = {
        op(LRB_OP_load_ps, 0, 0, 0, 0),       /* 0: 1 vector live after it */
        op(LRB_OP_load_ps, 0, 0, 0, 0),       /* 1: 2 */
        {.op = LRB_OP_phase, .aux = 3},
        op(LRB_OP_add_ps, 2, 1, 0, 0),        /* 2: reads 0 last and 1: 2 before it, 1 and 2 after it */
        op(LRB_OP_cmplt_ps, 1, 2, 0, 0),      /* 3: reads 2 and 1 last: 2 vectors before it; its mask */
        op(LRB_OP_kortest, 1, 1, 0, 0),       /* 4: the mask, before it */
        op(LRB_OP_mul_ps, 0, 0, 0, 0),        /* 5: a result that nobody reads: 1 */
    };
    (void)state;
    sim_registers_stats s = analyse(sim_file_registers, events, sizeof events / sizeof *events);
    assert_int_equal(s.ops[0], 2);
    assert_int_equal(s.ops[3], 4);
    assert_int_equal(s.tiles, 1);
    assert_int_equal(s.pressure[0][SIM_FILE_VECTOR].live, 3);
    assert_int_equal(s.pressure[0][SIM_FILE_VECTOR].max, 2);
    assert_int_equal(s.pressure[3][SIM_FILE_VECTOR].live, 5);
    assert_int_equal(s.pressure[3][SIM_FILE_VECTOR].max, 2);
    assert_int_equal(s.pressure[3][SIM_FILE_MASK].live, 2);
    assert_int_equal(s.pressure[3][SIM_FILE_MASK].max, 1);
    assert_int_equal(s.pressure[3][SIM_FILE_GENERAL].max, 0);
}

/* So many vectors are loaded, then all are added up twice in the order of their making. */
static sim_registers_stats sum_twice(unsigned vectors)
{
    lrb_event events[256];
    unsigned n = 0;
    for (unsigned i = 0; i < vectors; i++)
        events[n++] = op(LRB_OP_load_ps, 0, 0, 0, 0);
    for (unsigned i = 0; i < 2 * vectors; i++, n++)
        events[n] = op(LRB_OP_cmplt_ps, n - i % vectors, 0, 0, 0);
    return analyse(sim_file_registers, events, n);
}

static void spills__up_to_32_vectors__none(void **state)
{
    (void)state;
    for (unsigned vectors = 1; vectors <= 40; vectors++) {
        sim_pressure p = sum_twice(vectors).pressure[0][SIM_FILE_VECTOR];
        assert_int_equal(p.max, vectors);
        assert_int_equal(p.stores > 0, vectors > 32);
        assert_int_equal(p.reloads > 0, vectors > 32);
        assert_true(p.stores <= vectors && p.stores <= p.reloads);
    }
}

static void spills__one_too_many__one_store_and_a_reload_for_each_round(void **state)
{
    (void)state;
    /* The last one is read furthest ahead, and goes; where it comes back, another goes that this round has read. */
    sim_pressure p = sum_twice(33).pressure[0][SIM_FILE_VECTOR];
    assert_true(p.reloads >= 1 && p.reloads <= 2);
}

/* The same stream over and over, as a count of all that lives at each op. */
static void naive_pressure(const lrb_event *events, uint32_t count, sim_registers_stats *s)
{
    uint32_t *last = calloc(count, sizeof *last), ops = 0, phase = 0;
    lrb_event *only = calloc(count, sizeof *only);
    uint8_t *phases = calloc(count, sizeof *phases);
    assert_true(last && only && phases);
    for (uint32_t i = 0; i < count; i++) {
        if ((events[i].op & LRB_EVENT_ID) == LRB_OP_phase)
            phase = events[i].aux < SIM_MAX_PHASES ? events[i].aux : SIM_MAX_PHASES - 1;
        if (lrb_op_kind_of((lrb_op_id)(events[i].op & LRB_EVENT_ID)) == LRB_KIND_MARKER)
            continue;
        for (int k = 0; k < 4; k++)
            if (events[i].src[k] && events[i].src[k] <= ops)
                last[ops - events[i].src[k]] = ops;
        phases[ops] = (uint8_t)phase;
        only[ops++] = events[i];
    }
    for (uint32_t at = 0; at < ops; at++) {
        uint64_t before[SIM_FILES + 1] = {0}, after[SIM_FILES + 1] = {0};
        for (uint32_t i = 0; i <= at; i++) {
            sim_register_file file = sim_file_of((lrb_op_id)(only[i].op & LRB_EVENT_ID));
            before[file] += i < at && last[i] >= at;
            after[file] += i == at || last[i] > at;
        }
        s->ops[phases[at]]++;
        for (int f = 0; f < SIM_FILES; f++) {
            sim_pressure *p = &s->pressure[phases[at]][f];
            uint64_t live = before[f] > after[f] ? before[f] : after[f];
            p->live += live;
            p->max = live > p->max ? live : p->max;
        }
    }
    free(last), free(only), free(phases);
}

static void pressure__random_streams__as_counted_anew_for_every_op(void **state)
{
    enum { EVENTS = 600, STREAMS = 60 };
    static lrb_event events[EVENTS];
    base_random random = {.state = 71};
    (void)state;
    for (int i = 0; i < STREAMS; i++) {
        sim_registers_stats expected = {.tiles = 1};
        random_stream(&random, events, EVENTS);
        naive_pressure(events, EVENTS, &expected);
        sim_registers_stats s = analyse(no_limits, events, EVENTS);
        assert_memory_equal(&s, &expected, sizeof s);
    }
}

static void pressure__far_source__lives_until_then(void **state)
{
    enum { OPS = LRB_FAR + 10 };
    lrb_event *events = calloc(OPS + 2, sizeof *events);
    (void)state;
    assert_non_null(events);
    for (uint32_t i = 0; i < OPS; i++)
        events[i] = op(LRB_OP_load_ps, 0, 0, 0, 0);
    events[OPS] = (lrb_event){.op = LRB_OP_far, .aux = OPS << 2 | 1};
    events[OPS + 1] = op(LRB_OP_mov_ps, 0, 0, 0, 0);
    assert_int_equal(analyse(no_limits, events, OPS + 2).pressure[0][SIM_FILE_VECTOR].live, 2 * OPS);
    events[OPS].op = LRB_OP_line; /* nothing is said */
    assert_int_equal(analyse(no_limits, events, OPS + 2).pressure[0][SIM_FILE_VECTOR].live, OPS + 1);
    free(events);
}

/* Fewest reloads with 4 registers, over all choices of what to keep. best[set]: with these values in registers. */
enum { SMALL_OPS = 11, SMALL_REGISTERS = 4, SETS = 1 << SMALL_OPS, IMPOSSIBLE = 1000 };

static void keep(unsigned *best, unsigned from, unsigned needed, unsigned cost)
{
    for (unsigned set = from;; set = (set - 1) & from) {
        if ((set & needed) == needed && __builtin_popcount(set) <= SMALL_REGISTERS && cost < best[set])
            best[set] = cost;
        if (set == 0)
            break;
    }
}

static unsigned fewest_reloads(const lrb_event *events)
{
    static unsigned best[SETS], read[SETS], made[SETS];
    for (unsigned set = 0; set < SETS; set++)
        best[set] = set ? IMPOSSIBLE : 0;
    for (unsigned i = 0; i < SMALL_OPS; i++) {
        unsigned sources = 0;
        for (int k = 0; k < 4; k++)
            if (events[i].src[k])
                sources |= 1u << (i - events[i].src[k]);
        for (unsigned set = 0; set < SETS; set++)
            read[set] = made[set] = IMPOSSIBLE;
        for (unsigned set = 0; set < SETS; set++)
            if (best[set] < IMPOSSIBLE)
                keep(read, set | sources, sources, best[set] + (unsigned)__builtin_popcount(sources & ~set));
        for (unsigned set = 0; set < SETS; set++)
            if (read[set] < IMPOSSIBLE)
                keep(made, set | 1u << i, 1u << i, read[set]);
        memcpy(best, made, sizeof best);
    }
    unsigned least = IMPOSSIBLE;
    for (unsigned set = 0; set < SETS; set++)
        least = best[set] < least ? best[set] : least;
    return least;
}

static void spills__random_small_streams__fewest_reloads(void **state)
{
    const unsigned registers[SIM_FILES] = {SMALL_REGISTERS, 0, 0};
    base_random random = {.state = 72};
    unsigned with_spills = 0;
    (void)state;
    for (int stream = 0; stream < 400; stream++) {
        lrb_event events[SMALL_OPS];
        for (unsigned i = 0; i < SMALL_OPS; i++) {
            events[i] = op(LRB_OP_madd231_ps, 0, 0, 0, 0);
            for (int k = 0; k < 3 && i; k++)
                if (base_random_bits(&random) % 4)
                    events[i].src[k == 2 ? 3 : k] = (uint16_t)(1 + base_random_bits(&random) % i);
        }
        sim_pressure p = analyse(registers, events, SMALL_OPS).pressure[0][SIM_FILE_VECTOR];
        assert_int_equal(p.reloads, fewest_reloads(events));
        assert_true(p.stores <= p.reloads);
        with_spills += p.reloads > 0;
    }
    assert_true(with_spills > 20);
}

static void stats__added__sums_and_maxima(void **state)
{
    sim_registers_stats a = sum_twice(10), b = sum_twice(35), sum = {.tiles = 0};
    (void)state;
    sim_registers_stats_add(&sum, &a);
    sim_registers_stats_add(&sum, &b);
    assert_int_equal(sum.tiles, 2);
    assert_int_equal(sum.ops[0], a.ops[0] + b.ops[0]);
    assert_int_equal(sum.pressure[0][0].live, a.pressure[0][0].live + b.pressure[0][0].live);
    assert_int_equal(sum.pressure[0][0].max, 35);
    assert_int_equal(sum.pressure[0][0].stores, b.pressure[0][0].stores);
    assert_int_equal(sum.pressure[0][0].reloads, b.pressure[0][0].reloads);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files__by_shape__the_register_of_the_result),
        cmocka_unit_test(pressure__small_stream__counted_by_hand),
        cmocka_unit_test(pressure__random_streams__as_counted_anew_for_every_op),
        cmocka_unit_test(pressure__far_source__lives_until_then),
        cmocka_unit_test(spills__up_to_32_vectors__none),
        cmocka_unit_test(spills__one_too_many__one_store_and_a_reload_for_each_round),
        cmocka_unit_test(spills__random_small_streams__fewest_reloads),
        cmocka_unit_test(stats__added__sums_and_maxima),
    };
    return cmocka_run_group_tests_name("registers", tests, NULL, NULL);
}
