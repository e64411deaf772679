/* Functional warming: caches as the core model has them on a machine where no line is ever on its way, and a core that goes on from
 * them as from its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdbool.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/core.h"
#include "sim/warm.h"

enum { EVENTS = 20000 };

static lrb_event first_events[EVENTS], second_events[EVENTS];

/* One thread, small caches, every latency a cycle: accesses happen in the order of the stream. */
static sim_machine *small_machine(void)
{
    static const char *const settings[] = {"threads=1", "l1.size_bytes=2048", "l1.ways=2", "l2.size_bytes=8192", "l2.ways=4"};
    sim_machine *machine = NULL;
    assert_int_equal(sim_machine_load("ideal", &machine, NULL), BASE_OK);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        assert_int_equal(sim_machine_set(machine, settings[i], NULL), BASE_OK);
    assert_int_equal(sim_machine_check(machine, NULL), BASE_OK);
    return machine;
}

/* Loads, stores, prefetches and evictions of lines by a walk over `lines` of them; every other op in between is another one. */
static void fill_walk(lrb_event *events, uint64_t seed, unsigned lines)
{
    static const lrb_op_id ops[] = {LRB_OP_load32, LRB_OP_load_ps,   LRB_OP_store_ps, LRB_OP_add_ps,   LRB_OP_prefetch1,
                                    LRB_OP_store32, LRB_OP_prefetch2, LRB_OP_evict1,   LRB_OP_evict2, LRB_OP_add};
    base_random random = {.state = seed};
    for (int i = 0; i < EVENTS; i++) {
        const lrb_op_id id = ops[(size_t)(base_random_unit(&random) * 10)];
        const uint32_t line = (uint32_t)(base_random_unit(&random) * base_random_unit(&random) * lines);
        const bool scratch = base_random_unit(&random) < 0.1, masked = base_random_unit(&random) < 0.1;
        events[i] = (lrb_event){.op = (uint16_t)id, .mask = masked ? 0 : 0xffff, .aux = line * 64 + (scratch ? 0xf0000000u : 0)};
        if (id == LRB_OP_add_ps)
            events[i].op |= masked ? LRB_FORM_MEMORY : 0; /* read whatever the mask */
    }
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    (void)thread, (void)err;
    const lrb_event **left = user;
    *events = *left;
    *count = EVENTS;
    *left = NULL;
    return BASE_OK;
}

static void run(sim_core *core, const lrb_event *events)
{
    const sim_core_feed feed = {.next = next_tile, .user = &events};
    assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
}

static void assert_same_counts(const sim_hierarchy_counts *a, const sim_hierarchy_counts *b)
{
    assert_int_equal(a->l1_accesses, b->l1_accesses);
    assert_int_equal(a->l1_misses, b->l1_misses);
    assert_int_equal(a->l2_misses, b->l2_misses);
    assert_int_equal(a->prefetches, b->prefetches);
    assert_int_equal(a->memory_lines, b->memory_lines);
}

static void compare(uint64_t seed, unsigned lines)
{
    sim_machine *machine = small_machine();
    sim_core *whole = NULL, *late = NULL;
    sim_warmer *warmer = NULL;
    fill_walk(first_events, seed, lines);
    fill_walk(second_events, seed + 1, lines);
    assert_int_equal(sim_core_create(machine, &whole, NULL), BASE_OK);
    assert_int_equal(sim_core_create(machine, &late, NULL), BASE_OK);
    assert_int_equal(sim_warmer_create(machine, &warmer, NULL), BASE_OK);

    run(whole, first_events);
    const sim_hierarchy_counts before = sim_core_get(whole).memory;
    const sim_lines some = sim_warmer_events(warmer, 0, first_events, 777), more = sim_warmer_events(warmer, 0, first_events + 777, EVENTS - 777);
    assert_true(some.l2 + more.l2 > 30);
    assert_int_equal(some.l1 + more.l1, before.l2_accesses);
    assert_int_equal(some.l2 + more.l2, before.memory_lines);

    sim_core_fill(late, sim_warmer_contents(warmer));
    run(late, second_events);
    run(whole, second_events);
    sim_hierarchy_counts after = sim_core_get(whole).memory, counted = sim_core_get(late).memory;
    const uint64_t *b = (const uint64_t *)&before;
    uint64_t *a = (uint64_t *)&after;
    for (size_t i = 0; i < sizeof after / sizeof *a; i++)
        a[i] -= b[i]; /* of the second stream alone */
    assert_same_counts(&counted, &after);
    assert_int_equal(sim_warmer_events(warmer, 0, second_events, EVENTS).l2, after.memory_lines);

    sim_warmer_destroy(&warmer);
    assert_null(warmer);
    sim_core_destroy(&whole), sim_core_destroy(&late);
    sim_machine_destroy(&machine);
}

static void walk__caches_overflow_or_not__as_the_core_has_them(void **state)
{
    (void)state;
    static const unsigned lines[] = {40, 130, 300, 3000};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        for (uint64_t seed = 1; seed < 4; seed++)
            compare(seed * 1000, lines[i]);
}

/* Scratch memory is each thread's own: what one brought is not there for another. */
static void scratch__two_threads__lines_of_their_own(void **state)
{
    (void)state;
    sim_machine *machine = NULL;
    sim_warmer *warmer = NULL;
    const lrb_event own = {.op = LRB_OP_load32, .mask = 0xffff, .aux = 0xf0000040u}, shared = {.op = LRB_OP_load32, .mask = 0xffff, .aux = 64};
    assert_int_equal(sim_machine_load("larrabee", &machine, NULL), BASE_OK);
    assert_int_equal(sim_warmer_create(machine, &warmer, NULL), BASE_OK);
    assert_int_equal(sim_warmer_events(warmer, 0, &own, 1).l2, 1);
    assert_int_equal(sim_warmer_events(warmer, 0, &own, 1).l2, 0);
    assert_int_equal(sim_warmer_events(warmer, 3, &own, 1).l2, 1);
    assert_int_equal(sim_warmer_events(warmer, 0, &shared, 1).l2, 1);
    assert_int_equal(sim_warmer_events(warmer, 3, &shared, 1).l2, 0);
    sim_warmer_destroy(&warmer);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walk__caches_overflow_or_not__as_the_core_has_them),
        cmocka_unit_test(scratch__two_threads__lines_of_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
