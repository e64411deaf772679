/* Gathers and scatters of 1, 2, 4, 8 and 16 lines, as the loops over their mask that compilers write: closed formulas, on the slow
 * simulator too. An execution takes a line; it waits for the mask and the destination that the one before left. */
#include "tests/sim/core_timeline.h"

enum { LINE = 64, MOST = 16, THREADS = 4 };

/* Where the lines are before the loop. */
typedef enum place { FIRST_LEVEL, SECOND_LEVEL, MEMORY } place;

/* The events of one thread. */
typedef struct loop {
    lrb_event events[MOST * 4 + 4];
    size_t count, first; /* `first`: the loop begins */
} loop;

static void put(loop *l, lrb_event e) { l->events[l->count++] = e; }

/* Bring the lines to a level, and wait until they are there. */
static void warm(loop *l, place where, uint32_t address, unsigned lines)
{
    for (unsigned i = 0; i < lines && where != MEMORY; i++)
        put(l, (lrb_event){.op = where == FIRST_LEVEL ? LRB_OP_prefetch1 : LRB_OP_prefetch2, .mask = 0xffff, .aux = address + LINE * i});
    put(l, (lrb_event)OP_AT(delay, 0, 0xffff, 2000, 0));
    l->first = l->count;
}

/* One execution a line and a jump back while lanes are left: kortest and jcc, or jknzd. Then an op that needs the data. */
static void fill(loop *l, unsigned op, bool jknzd, place where, uint32_t address, unsigned lines)
{
    const uint16_t turn = jknzd ? 2 : 3, lanes = (uint16_t)((1u << MOST / lines) - 1);
    l->count = 0;
    warm(l, where, address, lines);
    for (unsigned i = 0; i < lines; i++) {
        const uint16_t last = i ? turn : 0, taken = i + 1 < lines;
        put(l, (lrb_event)OP_AT(gatherd_ps, LRB_FORM_LINE, (uint16_t)(lanes << i * (MOST / lines)), address + LINE * i, 0, 0, last,
                                op == LRB_OP_gatherd_ps ? last : 0));
        l->events[l->count - 1].op = (uint16_t)(op | LRB_FORM_LINE);
        if (!jknzd)
            put(l, (lrb_event)OP(kortest, 1, 1));
        put(l, (lrb_event){.op = jknzd ? LRB_OP_jknzd : LRB_OP_jcc, .mask = taken, .src = {1}, .aux = 1});
    }
    if (op == LRB_OP_gatherd_ps)
        put(l, (lrb_event)OP(add_ps, turn));
    else
        put(l, (lrb_event)OP_AT(load_ps, 0, lanes, address + LINE * (lines - 1), 0));
}

/* The machine without penalties of branches, which the formulas have not, and with room for all prefetches, so that threads stay in
 * step. */
static sim_machine *machine_for(const char *name, unsigned threads)
{
    char assignment[20];
    snprintf(assignment, sizeof assignment, "threads=%u", threads);
    return MACHINE(name, assignment, "branch.mispredict_penalty=0", "branch.btb_miss_penalty=0", "memory.prefetches_per_core=64");
}

/* Cycles from the first execution of any thread to the op behind the loop of the last one. The threads' executions begin one behind
 * the other, as far apart as their class allows. */
static uint64_t cycles_of(const sim_machine *machine, unsigned op, bool jknzd, place where, unsigned lines)
{
    static loop loops[THREADS];
    core_pair p = {.count = machine->threads};
    for (unsigned t = 0; t < machine->threads; t++)
        fill(&loops[t], op, jknzd, where, t * MOST * LINE, lines);
    for (unsigned t = 0; t < machine->threads; t++)
        p.tiles[t] = (slow_core_tile){.events = loops[t].events, .count = loops[t].first + 1};
    const uint64_t began = run_pair(&p, machine).cycles - 2 * (machine->threads - 1);
    for (unsigned t = 0; t < machine->threads; t++)
        p.tiles[t].count = loops[t].count;
    return run_pair(&p, machine).cycles - began;
}

/* 5 + 2 n cycles: an execution every 2, the loop's control between or beside them, the data 7 after the last one. Four threads share
 * the unit: 4 n executions. */
static void gather__first_level__5_plus_2n(void **state)
{
    (void)state;
    for (unsigned threads = 1; threads <= THREADS; threads += THREADS - 1) {
        sim_machine *larrabee = machine_for("larrabee", threads), *knc = machine_for("knc", threads);
        for (unsigned n = 1; n <= MOST; n *= 2) {
            assert_int_equal(cycles_of(larrabee, LRB_OP_gatherd_ps, false, FIRST_LEVEL, n), 5 + 2 * n * threads);
            assert_int_equal(cycles_of(larrabee, LRB_OP_gatherd_ps, true, FIRST_LEVEL, n), 5 + 2 * n * threads);
            assert_int_equal(cycles_of(knc, LRB_OP_gatherd_ps, true, FIRST_LEVEL, n), 5 + 2 * n * threads);
        }
        sim_machine_destroy(&larrabee);
        sim_machine_destroy(&knc);
    }
}

/* kortest needs a cycle in U of its own, and a thread of Knights Corner has every other one: 4 cycles a line. */
static void gather__kortest_at_gap_two__3_plus_4n(void **state)
{
    (void)state;
    sim_machine *knc = machine_for("knc", 1);
    for (unsigned n = 1; n <= MOST; n *= 2)
        assert_int_equal(cycles_of(knc, LRB_OP_gatherd_ps, false, FIRST_LEVEL, n), 3 + 4 * n);
    sim_machine_destroy(&knc);
}

/* The mask of an execution whose line comes 21 or 297 cycles later is as late as its data; only then comes the jump, a cycle before
 * the next execution. The lines of four threads come 3 cycles apart, or 15 from a memory of whole cycles, which rounds nothing. */
static void gather__further_levels__a_latency_a_line(void **state)
{
    (void)state;
    sim_machine *one = machine_for("larrabee", 1), *four = machine_for("larrabee", THREADS);
    assert_int_equal(sim_machine_set(four, "memory.cycles_per_line=15", NULL), BASE_OK);
    for (unsigned n = 1; n <= MOST; n *= 2) {
        assert_int_equal(cycles_of(one, LRB_OP_gatherd_ps, false, SECOND_LEVEL, n), 22 * (n - 1) + 21 + 7);
        assert_int_equal(cycles_of(one, LRB_OP_gatherd_ps, false, MEMORY, n), 298 * (n - 1) + 297 + 7);
        assert_int_equal(cycles_of(four, LRB_OP_gatherd_ps, false, SECOND_LEVEL, n), 22 * (n - 1) + 3 * 3 + 21 + 7);
        assert_int_equal(cycles_of(four, LRB_OP_gatherd_ps, false, MEMORY, n), 298 * (n - 1) + 3 * 15 + 297 + 7);
    }
    sim_machine_destroy(&one);
    sim_machine_destroy(&four);
}

/* A scatter leaves its mask at once, wherever its line is. One miss may be under way, so the next execution waits for the line of the
 * one before; what was stored is loaded 5 cycles after the last one. */
static void scatter__any_level__3_plus_2n_or_a_latency_a_line(void **state)
{
    (void)state;
    sim_machine *one = machine_for("larrabee", 1), *four = machine_for("larrabee", THREADS);
    for (unsigned n = 1; n <= MOST; n *= 2) {
        assert_int_equal(cycles_of(one, LRB_OP_scatterd_ps, false, FIRST_LEVEL, n), 3 + 2 * n);
        assert_int_equal(cycles_of(one, LRB_OP_scatterd_ps, true, FIRST_LEVEL, n), 3 + 2 * n);
        assert_int_equal(cycles_of(four, LRB_OP_scatterd_ps, true, FIRST_LEVEL, n), 3 + 2 * n * THREADS);
        assert_int_equal(cycles_of(one, LRB_OP_scatterd_ps, false, SECOND_LEVEL, n), 21 * (n - 1) + 5);
        assert_int_equal(cycles_of(one, LRB_OP_scatterd_ps, false, MEMORY, n), 297 * (n - 1) + 5);
    }
    sim_machine_destroy(&one);
    sim_machine_destroy(&four);
}

/* A mask that comes a cycle later costs a line a cycle where the jump follows at once, and none where kortest did so anyway. */
static void gather__later_mask__jump_has_a_cycle_of_its_own(void **state)
{
    (void)state;
    sim_machine *knc = machine_for("knc", 1), *larrabee = machine_for("larrabee", 1);
    assert_int_equal(sim_machine_set(knc, "vector_gather.latency_to_mask=1", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(larrabee, "vector_gather.latency_to_mask=1", NULL), BASE_OK);
    for (unsigned n = 1; n <= MOST; n *= 2) {
        assert_int_equal(cycles_of(knc, LRB_OP_gatherd_ps, true, FIRST_LEVEL, n), 3 + 4 * n);
        assert_int_equal(cycles_of(larrabee, LRB_OP_gatherd_ps, false, FIRST_LEVEL, n), 5 + 2 * n);
    }
    assert_int_equal(sim_machine_set(larrabee, "vector_gather.latency_to_mask=2", NULL), BASE_OK);
    for (unsigned n = 1; n <= MOST; n *= 2)
        assert_int_equal(cycles_of(larrabee, LRB_OP_gatherd_ps, false, FIRST_LEVEL, n), 4 + 3 * n);
    sim_machine_destroy(&knc);
    sim_machine_destroy(&larrabee);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gather__first_level__5_plus_2n),
        cmocka_unit_test(gather__kortest_at_gap_two__3_plus_4n),
        cmocka_unit_test(gather__later_mask__jump_has_a_cycle_of_its_own),
        cmocka_unit_test(gather__further_levels__a_latency_a_line),
        cmocka_unit_test(scatter__any_level__3_plus_2n_or_a_latency_a_line),
    };
    return cmocka_run_group_tests_name("sim/core_gather", tests, NULL, NULL);
}
