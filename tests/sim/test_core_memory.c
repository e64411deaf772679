/* The core model's memory: closed formulas, one rule a test. Every case runs on the slow simulator too. Numbers are those of
 * the larrabee machine: first level 3 cycles, second 24, memory 300, 14.4 cycles a line from memory, 3 from the second. */
#include "tests/sim/core_timeline.h"

#define LOAD(address) OP_AT(load32, 0, 0xffff, address, 0)
#define VLOAD(address) OP_AT(load_ps, 0, 0xffff, address, 0)
#define HINT(id, address) OP_AT(id, 0, 0xffff, address, 0)

enum { LINE = 64, SCRATCH = (int)0xf0000000u };

static void fill_chase(lrb_event *events, unsigned count, unsigned lines)
{
    for (unsigned i = 0; i < count; i++)
        events[i] = (lrb_event)OP_AT(load32, 0, 0xffff, LINE * (i % lines), i ? 1 : 0);
}

/* A chase takes the latency of the level that has the lines: 300 of memory at first, then 3 of the first level. */
static void chase__first_level_and_memory__their_latency(void **state)
{
    (void)state;
    lrb_event events[100];
    sim_machine *machine = MACHINE("larrabee", "threads=4");
    fill_chase(events, 100, 10);
    for (unsigned n = 1; n <= 100; n++) {
        sim_core_stats s = run_tiles(machine, events, n, 1);
        assert_int_equal(s.cycles, n <= 10 ? 1 + 300 * (n - 1) : 1 + 3000 + 3 * (n - 11));
        assert_int_equal(s.memory.l1_misses, n < 10 ? n : 10);
    }
    sim_machine_destroy(&machine);
}

/* Lines that left the first level are in the second: 24 cycles. */
static void chase__second_level__its_latency(void **state)
{
    (void)state;
    lrb_event events[60];
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    fill_chase(events, 20, 20);
    for (unsigned i = 0; i < 20; i++)
        events[20 + i] = (lrb_event)HINT(evict1, LINE * i);
    fill_chase(events + 40, 20, 20);
    events[40].src[0] = 21; /* after the last line has come */
    const uint64_t first = run_tiles(machine, events, 41, 1).cycles;
    assert_int_equal(first, 1 + 300 * 20);
    for (unsigned n = 1; n < 20; n++)
        assert_int_equal(run_tiles(machine, events, 41 + n, 1).cycles, first + 24 * n);
    sim_machine_destroy(&machine);
}

/* The result of a missing vector load waits for the line, and only who needs it does. */
static void miss__result__late_by_the_rest_of_the_latency(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    const timeline_step steps[] = {
        {1, VLOAD(0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)},
        {1 + 297 + 4, OP(add_ps, 3)}, /* 300 for a scalar load; a vector load has 4 instead of 3 on a hit */
        {302, VLOAD(0)}, {306, OP(add_ps, 1)}, /* the line is there */
    };
    sim_core_stats s = CORE_TIMELINE(machine, steps);
    assert_int_equal(s.core.memory, 298);
    sim_machine_destroy(&machine);
}

/* The same long after: a late result is remembered beyond the window of the others. */
static void miss__consumer_far_behind__still_waits(void **state)
{
    (void)state;
    lrb_event events[600];
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    events[0] = (lrb_event)VLOAD(0);
    for (unsigned fillers = 1; fillers < 590; fillers += 7) {
        for (unsigned i = 1; i <= fillers; i++)
            events[i] = (lrb_event)OP(add_ps, 0);
        events[fillers + 1] = (lrb_event)OP(add_ps, (uint16_t)(fillers + 1));
        uint64_t after = fillers + 2;
        assert_int_equal(run_tiles(machine, events, fillers + 2, 1).cycles, after > 302 ? after : 302);
    }
    sim_machine_destroy(&machine);
}

/* A distance that reaches back beyond the tile's start names nothing, even if a late result of an older tile has that number. */
static void miss__of_an_older_tile__holds_nothing_up(void **state)
{
    (void)state;
    static core_pair p;
    static lrb_event first[1], second[300];
    sim_machine *machine = MACHINE("larrabee", "threads=1", "memory.demand_misses_per_thread=2");
    first[0] = (lrb_event)VLOAD(0);
    second[0] = (lrb_event)VLOAD(LINE);
    for (unsigned i = 1; i < 200; i++)
        second[i] = (lrb_event)OP(add_ps, 0);
    second[200] = (lrb_event)OP(add_ps, 201);
    p.count = 2;
    p.tiles[0] = (slow_core_tile){.events = first, .count = 1};
    p.tiles[1] = (slow_core_tile){.events = second, .count = 201};
    assert_int_equal(run_pair(&p, machine).cycles, 202);
    second[200].src[0] = 200; /* its own load */
    assert_int_equal(run_pair(&p, machine).cycles, 2 + 15 - 1 + 297 + 4); /* its line is sent 14.4 cycles after the first */
    sim_machine_destroy(&machine);
}

/* One miss under way: the next access that misses waits for its line, one that hits or uses the same line does not. */
static void misses__one_a_thread__next_miss_waits(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    const timeline_step steps[] = {
        {1, VLOAD(0)}, {2, VLOAD(0)}, {298, VLOAD(LINE)}, {299, VLOAD(0)}, {595, OP_AT(store_ps, 0, 0xffff, 2 * LINE, 0)},
    };
    sim_core_stats s = CORE_TIMELINE(machine, steps);
    assert_int_equal(s.memory.l1_waits, 1);
    assert_int_equal(s.memory.l1_misses, 3);
    assert_int_equal(s.core.misses, 295 + 295);
    sim_machine_destroy(&machine);
}

/* Four may be under way: they come as far apart as memory sends them. */
static void misses__four_a_thread__bandwidth_apart(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1", "memory.demand_misses_per_thread=4");
    const timeline_step steps[] = {
        {1, LOAD(0)}, {1, LOAD(LINE)}, {2, LOAD(2 * LINE)}, {2, LOAD(3 * LINE)},
        {301, OP(add, 4)},          /* sent in 1 */
        {16 + 300, OP(add, 4)},     /* in 15.4 */
        {30 + 300, OP(add, 4)},     /* in 29.8 */
        {45 + 300, OP(add, 4)},     /* in 44.2 */
    };
    CORE_TIMELINE(machine, steps);
    sim_machine_destroy(&machine);
}

/* Two threads that want one line: one asks, both wait for it. Scratch is a place of each thread's own. */
static void threads__one_line_or_scratch__shared_or_not(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=2");
    const lrb_event shared[] = {LOAD(4096), OP(add, 1)}, own[] = {LOAD(SCRATCH), OP(add, 1)};
    sim_core_stats s = run_tiles(machine, shared, 2, 2);
    assert_int_equal(s.memory.memory_lines, 1);
    assert_int_equal(s.cycles, 302); /* both are ready in 301: one after the other */
    s = run_tiles(machine, own, 2, 2);
    assert_int_equal(s.memory.memory_lines, 2);
    assert_int_equal(s.cycles, 16 + 300);
    sim_machine_destroy(&machine);
}

/* A prefetched line is there after the latency; an access before that waits for the rest. */
static void prefetch__in_time_or_late__access_waits_for_the_rest(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    lrb_event events[] = {HINT(prefetch1, 0), OP_AT(delay, 0, 0xffff, 0, 0), LOAD(0), OP(add, 1)};
    for (unsigned delay = 1; delay < 400; delay += 37) {
        const uint64_t load = 1 + delay; /* the delay issues beside the prefetch */
        events[1].aux = delay;
        sim_core_stats s = run_tiles(machine, events, 4, 1);
        assert_int_equal(s.cycles, load + 3 > 301 ? load + 3 : 301);
        assert_int_equal(s.memory.l1_misses, 0);
        assert_int_equal(s.memory.prefetches, 1);
        assert_int_equal(s.memory.l1_waits, load < 298);
    }
    sim_machine_destroy(&machine);
}

/* Prefetches of lines that are there or on their way are dropped; the limit holds the thread up; 0 drops all. */
static void prefetch__limit_and_drops__as_the_machine_says(void **state)
{
    (void)state;
    sim_machine *two = MACHINE("larrabee", "threads=1", "memory.prefetches_per_core=2");
    sim_machine *none = MACHINE("larrabee", "threads=1", "memory.prefetches_per_core=0");
    const timeline_step steps[] = {
        {1, HINT(prefetch1, 0)}, {2, HINT(prefetch1, 0)}, {3, HINT(prefetch1, LINE)}, {4, HINT(prefetch1, LINE)},
        {298, HINT(prefetch1, 2 * LINE)}, {313, HINT(prefetch2, 3 * LINE)}, {314, HINT(prefetch1, 0)},
    };
    sim_core_stats s = CORE_TIMELINE(two, steps);
    assert_int_equal(s.memory.prefetches, 4);
    assert_int_equal(s.memory.dropped_prefetches, 3);
    assert_int_equal(s.core.prefetches, 293 + 14);
    const lrb_event dropped[] = {HINT(prefetch1, 0), HINT(prefetch2, LINE), LOAD(0)};
    s = run_tiles(none, dropped, 3, 1);
    assert_int_equal(s.memory.dropped_prefetches, 2);
    assert_int_equal(s.memory.l1_misses, 1);
    sim_machine_destroy(&two);
    sim_machine_destroy(&none);
}

/* A line prefetched to the second level: a load finds it there, or waits until it has come there. */
static void prefetch2__then_load__from_the_second_level(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    lrb_event events[] = {HINT(prefetch2, 0), OP_AT(delay, 0, 0xffff, 400, 0), LOAD(0), OP(add, 1)};
    uint64_t load = run_tiles(machine, events, 3, 1).cycles;
    sim_core_stats s = run_tiles(machine, events, 4, 1);
    assert_int_equal(s.cycles, load + 24);
    assert_int_equal(s.core.l2, 23);
    assert_int_equal(s.memory.l2_misses, 0);
    events[1].aux = 100;
    s = run_tiles(machine, events, 4, 1);
    assert_int_equal(s.cycles, 301);
    assert_int_equal(s.core.memory, 301 - run_tiles(machine, events, 3, 1).cycles - 1);
    sim_machine_destroy(&machine);
}

/* Lines from the second level come three cycles apart. */
static void second_level__several_lines__its_bandwidth_apart(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1", "memory.demand_misses_per_thread=8");
    lrb_event events[40] = {0};
    unsigned n = 0;
    for (unsigned i = 0; i < 8; i++)
        events[n++] = (lrb_event)HINT(prefetch2, LINE * i);
    events[n++] = (lrb_event)OP_AT(delay, 0, 0xffff, 1000, 0);
    const unsigned first = n;
    for (unsigned i = 0; i < 8; i++)
        events[n++] = (lrb_event)VLOAD(LINE * i);
    const uint64_t began = run_tiles(machine, events, first + 1, 1).cycles;
    for (unsigned i = 0; i < 8; i++) {
        events[n] = (lrb_event)OP(add_ps, (uint16_t)(n - first - i));
        assert_int_equal(run_tiles(machine, events, n + 1, 1).cycles, began + 3 * i + 21 + 4);
        n++;
    }
    sim_machine_destroy(&machine);
}

/* A line that was evicted comes from the level below; one that is on its way still arrives. */
static void evict__either_level__line_is_gone(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    const lrb_event from_l2[] = {LOAD(0), OP(add, 1), HINT(evict1, 0), LOAD(0)};
    const lrb_event from_memory[] = {LOAD(0), OP(add, 1), HINT(evict1, 0), HINT(evict2, 0), LOAD(0)};
    const lrb_event on_its_way[] = {LOAD(0), HINT(evict1, 0), HINT(evict2, 0), LOAD(0)};
    assert_int_equal(run_tiles(machine, from_l2, 4, 1).memory.l2_accesses, 2);
    assert_int_equal(run_tiles(machine, from_l2, 4, 1).memory.memory_lines, 1);
    assert_int_equal(run_tiles(machine, from_memory, 5, 1).memory.memory_lines, 2);
    sim_core_stats s = run_tiles(machine, on_its_way, 4, 1);
    assert_int_equal(s.memory.memory_lines, 1);
    assert_int_equal(s.memory.l1_waits, 1);
    sim_machine_destroy(&machine);
}

/* Loads in one cycle: not from the same bank, and not more bytes than the machine loads. */
static void banks__two_accesses__pair_if_they_can(void **state)
{
    (void)state;
    sim_machine *narrow = MACHINE("larrabee", "threads=1", "vector_load.throughput=0.5");
    sim_machine *wide = MACHINE("larrabee", "threads=1", "vector_load.throughput=0.5", "l1.load_bytes_per_cycle=128");
    const lrb_event warm[] = {HINT(prefetch1, 0), HINT(prefetch1, LINE), HINT(prefetch1, 2 * LINE), OP_AT(delay, 0, 0xffff, 1000, 0)};
    const struct {
        lrb_event first, second;
        unsigned narrow_pair, wide_pair;
    } cases[] = {
        {VLOAD(0), VLOAD(LINE), 0, 1},                      /* other bank, 128 bytes */
        {VLOAD(0), VLOAD(2 * LINE), 0, 0},                  /* same bank */
        {VLOAD(0), LOAD(LINE), 0, 1},                       /* 68 bytes */
        {LOAD(0), LOAD(LINE), 1, 1},
        {LOAD(0), LOAD(4), 0, 0},                           /* same line */
        {VLOAD(0), OP_AT(store_ps, 0, 0xffff, LINE, 0), 1, 1}, /* loads and stores have bytes of their own */
        {OP(add_ps, 0), VLOAD(0), 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lrb_event events[6];
        memcpy(events, warm, sizeof warm);
        events[4] = cases[i].first;
        events[5] = cases[i].second;
        const unsigned before = (unsigned)run_tiles(narrow, events, 4, 1).core.issued_pair;
        assert_int_equal(run_tiles(narrow, events, 6, 1).core.issued_pair - before, cases[i].narrow_pair);
        assert_int_equal(run_tiles(wide, events, 6, 1).core.issued_pair - before, cases[i].wide_pair);
    }
    sim_machine_destroy(&narrow);
    sim_machine_destroy(&wide);
}

/* Streaming: without prefetch a line a latency and thread, with prefetch a line a 14.4 cycles. */
static void streaming__with_and_without_prefetch__latency_or_bandwidth(void **state)
{
    (void)state;
    enum { LINES = 200, AHEAD = 22 };
    static lrb_event events[2 * LINES];
    sim_machine *machine = MACHINE("larrabee", "threads=1");
    for (unsigned i = 0; i < LINES; i++)
        events[i] = (lrb_event)OP_AT(add_ps, LRB_FORM_MEMORY, 0xffff, LINE * i, 0);
    assert_int_equal(run_tiles(machine, events, LINES, 1).cycles, 1 + 297 * (LINES - 1)); /* a line arrives 297 after it is asked for */
    for (unsigned i = 0; i < LINES; i++) {
        events[2 * i] = (lrb_event)HINT(prefetch1, LINE * (i + AHEAD));
        events[2 * i + 1] = (lrb_event)OP_AT(add_ps, LRB_FORM_MEMORY, 0xffff, LINE * i, 0);
    }
    const uint64_t half = run_tiles(machine, events, LINES, 1).cycles, all = run_tiles(machine, events, 2 * LINES, 1).cycles;
    assert_in_range(all - half, 144 * (LINES / 2) / 10, 156 * (LINES / 2) / 10); /* 20 under way: 297 / 20 = 14.85 a line */
    sim_machine_destroy(&machine);
}

/* N cores at once: each has an N-th of the chip's bytes, if that is less than it could take. */
static void cores__share_of_the_chip__lines_further_apart(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "threads=1", "memory.demand_misses_per_thread=2", "cores=60");
    const timeline_step steps[] = {
        {1, LOAD(0)}, {1, LOAD(LINE)}, {301, OP(add, 2)}, {28 + 300, OP(add, 2)}, /* 60 x 64 / 145 is 26.5, with tenths rounded up */
    };
    assert_int_equal(sim_machine_memory_tenths(machine), 265);
    CORE_TIMELINE(machine, steps);
    sim_machine_destroy(&machine);
}

/* One tile for the first thread. */
typedef struct single_tile {
    const lrb_event *events; /* NULL: taken */
    size_t count;
} single_tile;

static base_status take_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    single_tile *tile = user;
    (void)thread, (void)err;
    *events = tile->events;
    *count = tile->count;
    tile->events = NULL;
    return BASE_OK;
}

/* A core keeps its caches from run to run, and its statistics are the sums. */
static void runs__one_after_another__caches_stay_warm(void **state)
{
    (void)state;
    lrb_event events[40];
    sim_machine *machine = MACHINE("larrabee", "threads=2");
    sim_core *core = NULL;
    fill_chase(events, 40, 10);
    assert_int_equal(sim_core_create(machine, &core, NULL), BASE_OK);
    for (unsigned run = 1; run <= 3; run++) {
        single_tile tile = {events, 10};
        const sim_core_feed feed = {.next = take_tile, .user = &tile};
        assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
        sim_core_stats s = sim_core_get(core);
        assert_int_equal(s.cycles, 1 + 2700 + (run - 1) * (1 + 27));
        assert_int_equal(s.memory.l1_misses, 10);
        assert_int_equal(s.threads.no_work, s.cycles);
        assert_int_equal(s.core.issued_one, 10 * run);
    }
    sim_core_destroy(&core);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chase__first_level_and_memory__their_latency),
        cmocka_unit_test(chase__second_level__its_latency),
        cmocka_unit_test(miss__result__late_by_the_rest_of_the_latency),
        cmocka_unit_test(miss__consumer_far_behind__still_waits),
        cmocka_unit_test(miss__of_an_older_tile__holds_nothing_up),
        cmocka_unit_test(misses__one_a_thread__next_miss_waits),
        cmocka_unit_test(misses__four_a_thread__bandwidth_apart),
        cmocka_unit_test(threads__one_line_or_scratch__shared_or_not),
        cmocka_unit_test(prefetch__in_time_or_late__access_waits_for_the_rest),
        cmocka_unit_test(prefetch__limit_and_drops__as_the_machine_says),
        cmocka_unit_test(prefetch2__then_load__from_the_second_level),
        cmocka_unit_test(second_level__several_lines__its_bandwidth_apart),
        cmocka_unit_test(evict__either_level__line_is_gone),
        cmocka_unit_test(banks__two_accesses__pair_if_they_can),
        cmocka_unit_test(streaming__with_and_without_prefetch__latency_or_bandwidth),
        cmocka_unit_test(cores__share_of_the_chip__lines_further_apart),
        cmocka_unit_test(runs__one_after_another__caches_stay_warm),
    };
    return cmocka_run_group_tests_name("sim/core_memory", tests, NULL, NULL);
}
