/* The core model's threads, pipes and branches: closed formulas, one rule a test. Every case runs on the slow simulator too. */
#include "sim/bounds.h"
#include "tests/sim/core_timeline.h"

/* Every level answers as fast as the first: nothing waits for memory. */
#define NO_MEMORY "l2.latency=3", "l2.remote_latency=3", "memory.latency=3", "l2.cycles_per_line=0", "memory.cycles_per_line=0"

enum { MANY = 300 };

/* `count` of an op, each after the one `distance` before it; 0: of nothing. */
static const lrb_event *repeated(lrb_event event, unsigned distance)
{
    static lrb_event events[MANY];
    for (unsigned i = 0; i < MANY; i++) {
        events[i] = event;
        events[i].src[0] = (uint16_t)(i >= distance ? distance : 0);
    }
    return events;
}

/* A chain of multiply-adds takes its latency an op; other threads fill the cycles between, each a cycle behind the one before. */
static void threads__chains_of_fma__fill_the_latency(void **state)
{
    (void)state;
    static const char *const machines[] = {"larrabee", "knc"};
    for (int m = 0; m < 2; m++)
        for (unsigned threads = 1; threads <= 4; threads++) {
            sim_machine *machine = MACHINE(machines[m], NO_MEMORY);
            sim_core_stats s = run_tiles(machine, repeated((lrb_event)OP(madd231_ps, 0), 1), MANY, threads);
            assert_int_equal(s.cycles, 4 * (MANY - 1) + threads);
            sim_machine_destroy(&machine);
        }
}

/* Ops that need nothing of each other: one a cycle, but a thread issues only every issue_gap cycles. */
static void threads__independent_fma__one_a_cycle_or_a_gap(void **state)
{
    (void)state;
    const lrb_event *events = repeated((lrb_event)OP(madd231_ps, 0), 0);
    sim_machine *larrabee = MACHINE("larrabee", NO_MEMORY), *knc = MACHINE("knc", NO_MEMORY);
    for (unsigned threads = 1; threads <= 4; threads++) {
        assert_int_equal(run_tiles(larrabee, events, MANY, threads).cycles, threads * MANY);
        assert_int_equal(run_tiles(knc, events, MANY, threads).cycles, threads == 1 ? 2 * MANY - 1 : threads * MANY);
    }
    sim_machine_destroy(&larrabee);
    sim_machine_destroy(&knc);
}

/* Two chains in a thread of Knights Corner issue every other cycle, as published: so do four and eight. */
static void threads__several_chains__gap_is_the_limit(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("knc", NO_MEMORY);
    for (unsigned chains = 2; chains <= 8; chains *= 2)
        assert_int_equal(run_tiles(machine, repeated((lrb_event)OP(madd231_ps, 0), chains), MANY, 1).cycles, 2 * MANY - 1);
    sim_machine_destroy(&machine);
}

/* Without memory and branches one thread of the core is the issue model: every number that both have is the same. */
static void one_thread__no_memory__as_issue(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=1", "l1.banks=0", "l1.load_bytes_per_cycle=128",
                                   "l1.store_bytes_per_cycle=128", "branch.mispredict_penalty=0", "branch.btb_miss_penalty=0");
    const lrb_event events[] = {
        OP_AT(load_ps, 0, 0xffff, 4096, 0), OP(madd231_ps, 1, 0, 0, 1), OP_SWIZZLED(add_ps, 0, 1), OP(imul, 0, 0), OP(add, 1),
        OP_AT(store_ps, 0, 0xffff, 4096, 0, 0, 0, 4), OP_AT(load_ps, 0, 0xffff, 4096, 0), OP(cmplt_ps, 1, 1), OP(kortest, 1, 1),
        OP_AT(jcc, 0, 1, 77, 1), OP(add, 0), OP(add, 0), OP(rcpres_ps, 0, 8),
    };
    const uint32_t count = sizeof events / sizeof *events;
    for (uint32_t n = 1; n <= count; n++) {
        sim_core_stats core = run_tiles(machine, events, n, 1);
        sim_issue_stats issue = time_tile(machine, events, n, NULL);
        assert_int_equal(core.cycles, issue.cycles);
        assert_int_equal(core.core.issued_pair, issue.issued_pair);
        assert_int_equal(core.core.issued_one, issue.issued_one);
        assert_int_equal(core.core.store_forward, issue.store_forward);
        assert_int_equal(core.core.blocked, issue.blocked);
        assert_memory_equal(core.core.operand, issue.operand, sizeof issue.operand);
        assert_memory_equal(core.issued_by_class, issue.issued_by_class, sizeof issue.issued_by_class);
    }
    sim_machine_destroy(&machine);
}

/* Threads take turns: with three ops each, in the order 0 1 2 0 1 2 ...; a thread that waits is passed over. */
static void turns__some_wait__the_ready_ones_go_round(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=3");
    const lrb_event chain[] = {OP(add_ps, 0), OP(add_ps, 1)}, free_ops[] = {OP(add_ps, 0), OP(add_ps, 0), OP(add_ps, 0)};
    static core_pair p;
    p.count = 3;
    p.tiles[0] = (slow_core_tile){.events = chain, .count = 2}; /* issues in 1 and, not before 5, in 6: after thread 2 in 5 */
    p.tiles[1] = (slow_core_tile){.events = free_ops, .count = 3}; /* 2, 4, 7: in 6 it is thread 0's turn */
    p.tiles[2] = (slow_core_tile){.events = free_ops, .count = 3}; /* 3, 5, 8 */
    sim_core_stats s = run_pair(&p, machine);
    assert_int_equal(s.cycles, 8);
    assert_int_equal(s.core.issued_one, 8);
    assert_int_equal(s.threads.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 3); /* thread 0 in 2, 3, 4 */
    assert_int_equal(s.threads.other_thread, 1 + 4 + 5);
    assert_int_equal(s.threads.no_work, 2 + 1);
    sim_machine_destroy(&machine);
}

/* More tiles than threads: a thread takes the next one when it has issued the last op of its own. */
static void tiles__thread_runs_dry__takes_the_next(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=2");
    sim_core_stats s = run_tiles(machine, repeated((lrb_event)OP(madd231_ps, 0), 1), 10, 4);
    assert_int_equal(s.cycles, 2 + 36 + 2 + 36); /* thread 1 in 2 to 38 and, after thread 0's turn in 39, in 40 to 76 */
    assert_int_equal(s.threads.no_work, 1);
    sim_machine_destroy(&machine);
}

/* A tile's pipeline is empty: results and stores of the one before hold nothing up; what blocks the thread does. */
static void tiles__next_one__begins_with_an_empty_pipeline(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=1");
    static core_pair p;
    const lrb_event makes[] = {OP_AT(store_ps, 0, 0xffff, 4096, 0), OP(add_ps, 0)}, needs[] = {OP(add_ps, 1)};
    const lrb_event reads[] = {OP_AT(load_ps, 0, 0xffff, 4096, 0)}, blocks[] = {OP(imul, 0)};
    p.count = 2;
    p.tiles[0] = (slow_core_tile){.events = makes, .count = 2};
    p.tiles[1] = (slow_core_tile){.events = needs, .count = 1};
    assert_int_equal(run_pair(&p, machine).cycles, 3);
    p.tiles[1].events = reads;
    assert_int_equal(run_pair(&p, machine).cycles, 3);
    p.tiles[0] = (slow_core_tile){.events = blocks, .count = 1};
    sim_core_stats s = run_pair(&p, machine);
    assert_int_equal(s.cycles, 11);
    assert_int_equal(s.core.blocked, 9);
    sim_machine_destroy(&machine);
}

/* A busy class is busy for all threads, a blocked thread is blocked alone. */
static void busy__other_thread__waits_for_the_class(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=2");
    static core_pair p;
    const lrb_event multiply[] = {OP(imul, 0)}, adds[] = {OP(add_ps, 0), OP(add_ps, 0)};
    p.count = 2;
    p.tiles[0] = p.tiles[1] = (slow_core_tile){.events = multiply, .count = 1};
    sim_core_stats s = run_pair(&p, machine);
    assert_int_equal(s.cycles, 11);
    assert_int_equal(s.threads.busy[LRB_CLASS_scalar_multiply], 9);
    p.tiles[1] = (slow_core_tile){.events = adds, .count = 2};
    assert_int_equal(run_pair(&p, machine).cycles, 3);
    sim_machine_destroy(&machine);
}

#define JCC(taken, site) OP_AT(jcc, 0, taken, site, 0)

/* First taken: the buffer has no entry. Then it is predicted, until it is not taken: twice to change the mind. */
static void branch__counter_and_buffer__penalties(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "branch.mispredict_penalty=7", "branch.btb_miss_penalty=3", "threads=1");
    const timeline_step steps[] = {
        {1, JCC(0, 5)},           /* unknown, not taken: right, and not remembered */
        {2, JCC(1, 5)},           /* unknown, taken: 3 cycles lost */
        {6, JCC(1, 5)}, {7, JCC(1, 5)},
        {8, JCC(0, 5)},           /* counter 3: wrong, 7 lost */
        {16, JCC(0, 5)},          /* counter 2: wrong */
        {24, JCC(0, 5)},          /* counter 1: right */
        {25, JCC(1, 5)},          /* counter 0: wrong */
        {33, JCC(1, 5)},          /* counter 1: wrong */
        {41, JCC(1, 5)}, {42, OP(add_ps, 0)},
    };
    sim_core_stats s = CORE_TIMELINE(machine, steps);
    assert_int_equal(s.branches, 10);
    assert_int_equal(s.mispredicted, 4);
    assert_int_equal(s.btb_misses, 1);
    assert_int_equal(s.core.mispredict, 28);
    assert_int_equal(s.core.btb_miss, 3);
    sim_machine_destroy(&machine);
}

/* A set of two entries: the site that was not used for longest goes. */
static void branch__full_set__oldest_goes(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", "branch.btb_ways=2", "branch.btb_entries=4", "threads=1");
    const lrb_event events[] = {JCC(1, 0), JCC(1, 2), JCC(1, 0), JCC(1, 4), JCC(1, 0), JCC(1, 1), JCC(1, 2)};
    assert_int_equal(run_tiles(machine, events, 3, 1).btb_misses, 2);
    assert_int_equal(run_tiles(machine, events, 4, 1).btb_misses, 3); /* 2 goes */
    assert_int_equal(run_tiles(machine, events, 6, 1).btb_misses, 4); /* 0 is still there; 1 has another set */
    assert_int_equal(run_tiles(machine, events, 7, 1).btb_misses, 5);
    sim_machine_destroy(&machine);
}

/* What follows a delay of n comes n cycles after it; other threads go on. */
static void delay__of_n__thread_stands_aside(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=2");
    static core_pair p;
    const lrb_event waits[] = {OP_AT(delay, 0, 0xffff, 20, 0), OP(add_ps, 0)}, none[] = {OP_AT(delay, 0, 0xffff, 0, 0), OP(add_ps, 0)};
    const lrb_event adds[] = {OP(add_ps, 0), OP(add_ps, 0), OP(add_ps, 0)};
    assert_int_equal(run_tiles(machine, waits, 2, 1).cycles, 21);
    assert_int_equal(run_tiles(machine, none, 2, 1).cycles, 2);
    p.count = 2;
    p.tiles[0] = (slow_core_tile){.events = waits, .count = 2};
    p.tiles[1] = (slow_core_tile){.events = adds, .count = 3};
    sim_core_stats s = run_pair(&p, machine);
    assert_int_equal(s.cycles, 21);
    assert_int_equal(s.threads.delay, 19);
    assert_int_equal(s.core.issued_one, 5);
    sim_machine_destroy(&machine);
}

/* Phases and regions get the cycles of the core that their ops began, or were waited for in. */
static void phases__two_threads__share_the_cycles(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("larrabee", NO_MEMORY, "threads=2");
    const lrb_event events[] = {MARK(phase, 1), MARK(region, 3), OP(add_ps, 0), MARK(phase, 2), OP_MASKED(add_ps, 0x00ff, 1)};
    sim_core_stats s = run_tiles(machine, events, sizeof events / sizeof *events, 2);
    assert_int_equal(s.cycles, 6);
    assert_int_equal(s.phase[1], 2);
    assert_int_equal(s.phase[2], 4);
    assert_int_equal(s.phase_vector_ops[2], 2);
    assert_int_equal(s.phase_idle_lanes[2], 16);
    assert_int_equal(s.op_cycles[LRB_OP_add_ps], 6);
    sim_machine_destroy(&machine);
}

/* What the bounds are of ops that can be counted by hand. */
static void bounds__by_hand__chains_ports_lines(void **state)
{
    (void)state;
    sim_machine *machine = MACHINE("knc", "threads=2");
    sim_chain_meter *meter = NULL;
    sim_chains chains = {0};
    uint64_t ops[LRB_OP_COUNT] = {0};
    assert_int_equal(sim_chain_meter_create(machine, &meter, NULL), BASE_OK);
    assert_int_equal(sim_chain_meter_tile(meter, repeated((lrb_event)OP(madd231_ps, 0), 1), 10, &chains), 37);
    assert_int_equal(sim_bound_dependence(machine, &chains), 37); /* one tile: one thread */
    assert_int_equal(sim_chain_meter_tile(meter, repeated((lrb_event)OP(madd231_ps, 0), 2), 10, &chains), 17);
    assert_int_equal(sim_chain_meter_tile(meter, repeated((lrb_event)OP(madd231_ps, 0), 0), 300, &chains), 1);
    for (int i = 0; i < 3; i++)
        sim_chain_meter_tile(meter, repeated((lrb_event)OP(madd231_ps, 0), 1), 10, &chains);
    assert_int_equal(sim_bound_dependence(machine, &chains), (37 + 17 + 1 + 3 * 37) / 2);
    sim_chain_meter_destroy(&meter);
    ops[LRB_OP_madd231_ps] = 100;
    assert_int_equal(sim_bound_ports(machine, ops), 100); /* U takes one a cycle */
    ops[LRB_OP_add] = 300;
    assert_int_equal(sim_bound_ports(machine, ops), 200); /* two ops a cycle */
    ops[LRB_OP_imul] = 30;
    assert_int_equal(sim_bound_ports(machine, ops), 29 * 10 + 1);
    ops[LRB_OP_imul] = 0;
    assert_int_equal(sim_machine_set(machine, "threads=1", NULL), BASE_OK);
    assert_int_equal(sim_bound_ports(machine, ops), 199 * 2 + 1); /* a pair every other cycle */
    sim_hierarchy_counts lines = {.memory_lines = 122, .l2_accesses = 122, .l2_misses = 122};
    assert_int_equal(sim_bound_memory(machine, &lines), 1440); /* 21 may be on their way at the end */
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads__chains_of_fma__fill_the_latency),
        cmocka_unit_test(threads__independent_fma__one_a_cycle_or_a_gap),
        cmocka_unit_test(threads__several_chains__gap_is_the_limit),
        cmocka_unit_test(one_thread__no_memory__as_issue),
        cmocka_unit_test(turns__some_wait__the_ready_ones_go_round),
        cmocka_unit_test(tiles__thread_runs_dry__takes_the_next),
        cmocka_unit_test(tiles__next_one__begins_with_an_empty_pipeline),
        cmocka_unit_test(busy__other_thread__waits_for_the_class),
        cmocka_unit_test(branch__counter_and_buffer__penalties),
        cmocka_unit_test(branch__full_set__oldest_goes),
        cmocka_unit_test(delay__of_n__thread_stands_aside),
        cmocka_unit_test(phases__two_threads__share_the_cycles),
        cmocka_unit_test(bounds__by_hand__chains_ports_lines),
    };
    return cmocka_run_group_tests_name("sim/core", tests, NULL, NULL);
}
