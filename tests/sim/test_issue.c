/* The issue model, rule by rule: pairing, latencies by kind of consumer, busy and blocking classes, the gap. Every table
 * gives the cycle in which each op issues; ops in the same cycle are a pair, the first in U, the second in V. */
#include "tests/sim/timeline.h"

/* A vector op of latency 4 that needs the one before: cycles 1, 5, 9, ...; n ops take 1 + 4 (n - 1). */
static void chain__dependent_vector_alu__four_cycles_each(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(madd231_ps, 0, 0)},
        {5, OP(madd231_ps, 0, 1)},      /* the second source */
        {9, OP(madd231_ps, 1, 0)},      /* the first */
        {13, OP(madd231_ps, 0, 0, 0, 1)}, /* the old destination */
        {17, OP(add_ps, 0, 0, 1)},      /* the mask */
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 3 * 3);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_MASK], 3);
    assert_int_equal(stats.issued_one, 5);
    lrb_event chain[50];
    for (uint32_t n = 1; n <= 50; n++) {
        chain[n - 1] = (lrb_event)OP(add_ps, 1);
        assert_int_equal(time_tile(machine, chain, n, NULL).cycles, 1 + 4 * (n - 1));
    }
    sim_machine_destroy(&machine);
}

static void chain__independent_vector_alu__one_a_cycle_or_one_a_gap(void **state)
{
    (void)state;
    lrb_event ops[50];
    sim_machine *lrb = machine_with("larrabee", NULL, NULL), *knc = machine_with("knc", NULL, NULL);
    for (uint32_t n = 1; n <= 50; n++) {
        ops[n - 1] = (lrb_event)OP(mul_ps, 0);
        assert_int_equal(time_tile(lrb, ops, n, NULL).cycles, n);
        assert_int_equal(time_tile(knc, ops, n, NULL).cycles, 1 + 2 * (n - 1));
    }
    sim_machine_destroy(&lrb);
    sim_machine_destroy(&knc);
}

/* With three ops between, the result is ready when the consumer's turn comes; with two it is not, one cycle before. */
static void latency__consumer_arrives_early_or_in_time__waits_one_cycle_or_none(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step early[] = {
        {1, OP(add_ps, 0)}, {2, OP(sub_ps, 0)}, {3, OP(sub_ps, 0)}, {5, OP(mul_ps, 3)},
    };
    const timeline_step in_time[] = {
        {1, OP(add_ps, 0)}, {2, OP(sub_ps, 0)}, {3, OP(sub_ps, 0)}, {4, OP(sub_ps, 0)}, {5, OP(mul_ps, 4)},
    };
    sim_issue_stats stats = TIMELINE(machine, early);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 1);
    stats = TIMELINE(machine, in_time);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 0);
    assert_int_equal(stats.issued_one, 5);
    sim_machine_destroy(&machine);
}

static void pairs__simple_ops__two_a_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(add, 0)},    {1, OP(sub, 0)},    /* scalar and scalar */
        {2, OP(add_ps, 0)}, {2, OP(lea, 0)},    /* vector and scalar */
        {3, OP(add_ps, 0)}, {3, OP(load_ps, 0)}, /* vector and vector load */
        {4, OP(add_ps, 0)}, {4, OP_AT(store_ps, 0, 0xffff, 4096, 0)}, /* vector and vector store */
        {5, OP(shl, 0)},    {5, OP(kand, 0)},   /* U only, and a mask op */
        {6, OP(load32, 0)}, {6, OP(load32, 0)}, /* two scalar loads */
        {7, OP(add, 0)},    {7, OP(jmp, 0)},    /* scalar and jump */
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.issued_pair, 7);
    assert_int_equal(stats.issued_one, 0);
    assert_int_equal(stats.issued_by_class[LRB_CLASS_vector_alu], 3);
    assert_int_equal(stats.issued_by_class[LRB_CLASS_vector_load], 0);
    sim_machine_destroy(&machine);
}

static void pairs__not_allowed__one_a_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(add, 0)},    {2, OP(add_ps, 0)}, /* scalar, then vector: V takes no vector arithmetic */
        {3, OP(add_ps, 0)},                     /* two vector ops */
        {4, OP(shl, 0)},    {5, OP(shl, 0)},    /* two shifts */
        {5, OP(add, 0)},    {6, OP(add, 1)},    /* the second needs the first, which joined a shift */
        {6, OP(jmp, 0)},    {7, OP(jmp, 0)},    /* a jump alone is in V: ... */
        {8, OP(add, 0)},                        /* ... nothing joins it */
        {9, OP(add, 1)},                        /* needs the one before */
        {9, OP(add, 0)},    {10, OP(add, 0)},   /* a third op finds the cycle full */
    };
    TIMELINE(machine, steps);
    sim_machine_destroy(&machine);
}

/* On Knights Corner vector loads are in U only, and pairs come every other cycle. */
static void pairs__vector_load_on_knc__not_beside_a_vector_op(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("knc", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(add_ps, 0)},  {3, OP(load_ps, 0)}, {3, OP(add, 0)},
        {5, OP(add_ps, 0)},  {5, OP(load32, 0)},
        {7, OP(add_ps, 0)},  {7, OP_AT(store_ps, 0, 0xffff, 4096, 0)},
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.gap, 3);
    assert_int_equal(stats.issued_pair, 3);
    assert_int_equal(stats.issued_one, 1);
    sim_machine_destroy(&machine);
}

/* A jump shares the cycle of what sets its flags if that is in U; with a latency of 1 it never does. */
static void jump__after_compare__same_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step paired[] = {
        {1, OP(cmp, 0)},     {1, OP(jcc, 1)},
        {2, OP(test, 0)},    {2, OP(jcc, 1)},
        {3, OP(kortest, 0)}, {3, OP(jcc, 1)},
        {4, OP(add, 0)},     {4, OP(cmp, 0)}, {5, OP(jcc, 1)}, /* the compare is in V: no room */
        {6, OP(cmp, 0)},     {6, OP(add, 0)}, {7, OP(jcc, 2)}, /* something else is in V */
    };
    sim_issue_stats stats = TIMELINE(machine, paired);
    assert_int_equal(stats.cycles, stats.issued_one + stats.issued_pair);
    sim_machine_destroy(&machine);

    machine = machine_with("larrabee", "scalar_compare.latency_to_branch=1", "mask_test.latency_to_branch=3");
    const timeline_step apart[] = {
        {1, OP(cmp, 0)}, {2, OP(jcc, 1)}, {3, OP(kortest, 0)}, {6, OP(jcc, 1)},
    };
    stats = TIMELINE(machine, apart);
    assert_int_equal(stats.operand[LRB_CLASS_mask_test][SIM_CONSUMER_BRANCH], 2);
    sim_machine_destroy(&machine);
}

/* The mask of a vector compare is ready 6 cycles later, for mask ops, moves, tests and write-masks alike. */
static void compare__mask_needed__six_cycles(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step test[] = {{1, OP(cmplt_ps, 0)}, {7, OP(kortest, 1, 1)}, {7, OP(jcc, 1)}};
    const timeline_step logic[] = {{1, OP(cmplt_ps, 0)}, {7, OP(kand, 0, 1)}, {8, OP(kor, 1, 2)}};
    const timeline_step move[] = {{1, OP(cmplt_ps, 0)}, {7, OP(kmov_rk, 1)}, {9, OP(add, 1)}};
    const timeline_step write[] = {{1, OP(cmplt_ps, 0)}, {7, OP_MASKED(add_ps, 0x00ff, 0, 0, 1)}};
    const timeline_step early[] = {
        {1, OP(cmplt_ps, 0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {5, OP(add_ps, 0)},
        {7, OP(kortest, 5)},
    };
    const timeline_step in_time[] = {
        {1, OP(cmplt_ps, 0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {5, OP(add_ps, 0)},
        {6, OP(add_ps, 0)},   {7, OP(kortest, 6)},
    };
    assert_int_equal(TIMELINE(machine, test).operand[LRB_CLASS_vector_compare][SIM_CONSUMER_MASK], 5);
    TIMELINE(machine, logic);
    TIMELINE(machine, move);
    assert_int_equal(TIMELINE(machine, write).phase_idle_lanes[0], 8);
    assert_int_equal(TIMELINE(machine, early).operand[LRB_CLASS_vector_compare][SIM_CONSUMER_MASK], 1);
    assert_int_equal(TIMELINE(machine, in_time).operand[LRB_CLASS_vector_compare][SIM_CONSUMER_MASK], 0);
    sim_machine_destroy(&machine);
}

/* Swizzled sources, permutes and stores read early: 6 cycles where an ordinary op waits 4. */
static void shuffle__operand_read_early__six_cycles(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step swizzled[] = {
        {1, OP(add_ps, 0)}, {7, OP_SWIZZLED(add_ps, 0, 1)}, {11, OP_SWIZZLED(add_ps, 1, 0)}, /* its first source is not */
    };
    const timeline_step permuted[] = {{1, OP(add_ps, 0)}, {7, OP(shuf128x32_ps, 1)}, {11, OP(add_ps, 1)}};
    const timeline_step stored[] = {
        {1, OP(add_ps, 0)}, {7, OP_AT(store_ps, 0, 0xffff, 64, 0, 0, 0, 1)},
    };
    const timeline_step loaded[] = {{1, OP(load_ps, 0)}, {5, OP(add_ps, 1)}, {7, OP_SWIZZLED(add_ps, 0, 2)}};
    const timeline_step early[] = {
        {1, OP(add_ps, 0)}, {2, OP(mul_ps, 0)}, {3, OP(mul_ps, 0)}, {4, OP(mul_ps, 0)}, {5, OP(mul_ps, 0)},
        {7, OP_AT(store_ps, 0, 0xffff, 64, 0, 0, 0, 5)},
    };
    const timeline_step in_time[] = {
        {1, OP(add_ps, 0)}, {2, OP(mul_ps, 0)}, {3, OP(mul_ps, 0)}, {4, OP(mul_ps, 0)}, {5, OP(mul_ps, 0)},
        {6, OP(mul_ps, 0)}, {7, OP(mul_ps, 0)}, {7, OP_AT(store_ps, 0, 0xffff, 64, 0, 0, 0, 7)},
    };
    assert_int_equal(TIMELINE(machine, swizzled).operand[LRB_CLASS_vector_alu][SIM_CONSUMER_SHUFFLE], 5);
    TIMELINE(machine, permuted);
    TIMELINE(machine, stored);
    TIMELINE(machine, loaded);
    assert_int_equal(TIMELINE(machine, early).operand[LRB_CLASS_vector_alu][SIM_CONSUMER_SHUFFLE], 1);
    assert_int_equal(TIMELINE(machine, in_time).operand[LRB_CLASS_vector_alu][SIM_CONSUMER_SHUFFLE], 0);
    sim_machine_destroy(&machine);
}

/* An address written in the cycle before costs one cycle more (P5's address-generation interlock): +1 on latency 1. */
static void address__after_scalar_op__one_cycle_more(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step base[] = {{1, OP(add, 0)}, {3, OP(load32, 1)}};
    const timeline_step index[] = {{1, OP(lea, 0)}, {3, OP(load_ps, 0, 1)}};
    const timeline_step store[] = {{1, OP(add, 0)}, {3, OP_AT(store32, 0, 0xffff, 64, 1)}};
    const timeline_step data[] = {{1, OP(add, 0)}, {2, OP_AT(store32, 0, 0xffff, 64, 0, 0, 0, 1)}}; /* no address */
    const timeline_step plain[] = {{1, OP(add, 0)}, {2, OP(lea, 1)}, {4, OP_AT(add_ps, LRB_FORM_MEMORY, 0xffff, 64, 0, 1)}};
    const timeline_step in_time[] = {{1, OP(add, 0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {3, OP(load32, 3)}};
    const timeline_step mask[] = {{1, OP(kmov_rk, 0)}, {4, OP(load32, 1)}};
    assert_int_equal(TIMELINE(machine, base).operand[LRB_CLASS_scalar_alu][SIM_CONSUMER_ADDRESS], 1);
    TIMELINE(machine, index);
    TIMELINE(machine, store);
    TIMELINE(machine, data);
    TIMELINE(machine, plain);
    assert_int_equal(TIMELINE(machine, in_time).operand[LRB_CLASS_scalar_alu][SIM_CONSUMER_ADDRESS], 0);
    TIMELINE(machine, mask);
    sim_machine_destroy(&machine);
}

/* A pointer chase: 3 cycles a load, measured on Knights Corner (MM latency). */
static void address__from_a_load__three_cycles(void **state)
{
    (void)state;
    static const char *const names[] = {"larrabee", "knc"};
    for (int i = 0; i < 2; i++) {
        sim_machine *machine = machine_with(names[i], NULL, NULL);
        const timeline_step chase[] = {{1, OP(load32, 0)}, {4, OP(load32, 1)}, {7, OP(load32, 1)}, {10, OP(add, 1)}};
        TIMELINE(machine, chase);
        sim_machine_destroy(&machine);
    }
}

/* Nothing else issues for 10 cycles from a multiply on, and nothing beside it. */
static void multiply__blocks_the_thread__ten_cycles(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(add, 0)}, {2, OP(imul, 0)}, {12, OP(add, 0)}, {12, OP(add, 0)}, {13, OP(imul, 0)}, {23, OP(imul, 1)},
        {34, OP(load32, 1)}, /* 11 to an address */
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.blocked, 9 + 9);
    assert_int_equal(stats.operand[LRB_CLASS_scalar_multiply][SIM_CONSUMER_ADDRESS], 10);
    assert_int_equal(stats.busy[LRB_CLASS_scalar_multiply], 0); /* of reasons that end together the block is named */
    sim_machine_destroy(&machine);

    machine = machine_with("larrabee", "vector_alu.blocking=1", NULL); /* issues alone, and that is all */
    const timeline_step alone[] = {{1, OP(add, 0)}, {2, OP(add_ps, 0)}, {3, OP(add, 0)}, {3, OP(jmp, 0)}};
    assert_int_equal(TIMELINE(machine, alone).blocked, 0);
    sim_machine_destroy(&machine);

    machine = machine_with("larrabee", "scalar_load.blocking=2", NULL); /* joins nothing either */
    const timeline_step apart[] = {{1, OP(add, 0)}, {2, OP(load32, 0)}, {4, OP(add, 0)}, {5, OP(load32, 0)}};
    assert_int_equal(TIMELINE(machine, apart).blocked, 1);
    sim_machine_destroy(&machine);
}

static void bit_ops__in_u_alone__one_a_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(kmov_rk, 0)}, {3, OP(bsfi, 0, 1)}, {4, OP(bsfi, 1)}, {4, OP(add, 0)}, {5, OP(bsfi, 2)},
        {7, OP(load32, 1)}, /* as an address, one more */
        {8, OP(popcnt, 0)}, {9, OP(bts, 0)},
    };
    TIMELINE(machine, steps);
    sim_machine_destroy(&machine);
}

/* Two of a class with a throughput of a cycle never share one, though the pipes would let them. */
static void throughput__mask_ops_loads_stores__one_a_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, OP(kand, 0)},    {2, OP(kor, 0)}, {2, OP(kmov_kr, 0)}, /* another class may join */
        {3, OP(kmov_kr, 0)}, {3, OP(knot, 0)},
        {4, OP(load_ps, 0)}, {5, OP(load_ps, 0)}, {5, OP(load32, 0)},
        {6, OP(load32, 0)},  {6, OP(load32, 0)}, {7, OP(load32, 0)}, /* 0.5: two a cycle */
        {7, OP_AT(store32, 0, 0xffff, 640, 0)}, {8, OP_AT(store32, 0, 0xffff, 640, 0)},
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.cycles, stats.issued_one + stats.issued_pair);
    sim_machine_destroy(&machine);
}

/* More than a cycle: the class is busy, other classes go on. One and a half are rounded up to two. */
static void throughput__longer_than_a_cycle__class_is_busy(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("knc", "issue_gap=1", NULL);
    const timeline_step lookup[] = {{1, OP(rcpres_ps, 0)}, {3, OP(rcpres_ps, 0)}, {4, OP(add_ps, 0)}, {5, OP(rcpres_ps, 0)}};
    assert_int_equal(TIMELINE(machine, lookup).busy[LRB_CLASS_vector_lookup], 1);
    sim_machine_destroy(&machine);

    machine = machine_with("larrabee", "vector_alu.throughput=1.5", NULL);
    const timeline_step half[] = {{1, OP(add_ps, 0)}, {1, OP(add, 0)}, {3, OP(add_ps, 0)}, {5, OP(add_ps, 0)}};
    assert_int_equal(TIMELINE(machine, half).busy[LRB_CLASS_vector_alu], 2);
    sim_machine_destroy(&machine);

    machine = machine_with("larrabee", "scalar_load.throughput=3", NULL);
    const timeline_step in_v[] = {
        {1, OP(load32, 0)}, {4, OP(load32, 0)}, {5, OP(add_ps, 0)}, {6, OP(add_ps, 0)}, {7, OP(load32, 0)},
    };
    assert_int_equal(TIMELINE(machine, in_v).busy[LRB_CLASS_scalar_load], 2);
    const timeline_step joined[] = {
        {1, OP(load32, 0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {4, OP(load32, 0)},
    };
    assert_int_equal(TIMELINE(machine, joined).busy[LRB_CLASS_scalar_load], 0);
    sim_machine_destroy(&machine);
}

/* The gap lies between issue cycles; a pair is in one of them. Waiting starts when the gap is over. */
static void gap__of_three__between_issue_cycles(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", "issue_gap=3", NULL);
    const timeline_step steps[] = {
        {1, OP(add_ps, 0)}, {1, OP(add, 0)}, {4, OP(add, 0)}, {4, OP(add, 0)}, {7, OP(add_ps, 0)}, {11, OP(add_ps, 1)},
    };
    sim_issue_stats stats = TIMELINE(machine, steps);
    assert_int_equal(stats.gap, 3 * 2);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 1);
    sim_machine_destroy(&machine);
}

/* Cycles of waiting go to the reason that ends last; of several that end together, to the last of: operands by the
   producer's class and then the kind of consumer, stored data, a busy class, a blocked thread. */
static void blame__several_reasons__the_last_to_end(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", "scalar_load.latency=5", "scalar_load.latency_to_address=5");
    const timeline_step last[] = {{1, OP(load32, 0)}, {1, OP(add, 0)}, {6, OP(add, 2, 1)}};
    assert_int_equal(TIMELINE(machine, last).operand[LRB_CLASS_scalar_load][SIM_CONSUMER_PLAIN], 4);
    const timeline_step tie[] = { /* both in cycle 6: the load and the vector op, whose class comes later */
        {1, OP(load32, 0)}, {2, OP(add_ps, 0)}, {6, OP(add_ps, 1, 2)},
    };
    sim_issue_stats stats = TIMELINE(machine, tie);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 3);
    assert_int_equal(stats.operand[LRB_CLASS_scalar_load][SIM_CONSUMER_PLAIN], 0);
    const timeline_step forward[] = { /* an operand and stored data, both in cycle 5 */
        {1, OP(add_ps, 0)}, {1, OP_AT(store_ps, 0, 0xffff, 64, 0)}, {5, OP_AT(add_ps, LRB_FORM_MEMORY, 0xffff, 64, 2)},
    };
    stats = TIMELINE(machine, forward);
    assert_int_equal(stats.store_forward, 3);
    assert_int_equal(stats.operand[LRB_CLASS_vector_alu][SIM_CONSUMER_PLAIN], 0);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chain__dependent_vector_alu__four_cycles_each),
        cmocka_unit_test(chain__independent_vector_alu__one_a_cycle_or_one_a_gap),
        cmocka_unit_test(latency__consumer_arrives_early_or_in_time__waits_one_cycle_or_none),
        cmocka_unit_test(pairs__simple_ops__two_a_cycle),
        cmocka_unit_test(pairs__not_allowed__one_a_cycle),
        cmocka_unit_test(pairs__vector_load_on_knc__not_beside_a_vector_op),
        cmocka_unit_test(jump__after_compare__same_cycle),
        cmocka_unit_test(compare__mask_needed__six_cycles),
        cmocka_unit_test(shuffle__operand_read_early__six_cycles),
        cmocka_unit_test(address__after_scalar_op__one_cycle_more),
        cmocka_unit_test(address__from_a_load__three_cycles),
        cmocka_unit_test(multiply__blocks_the_thread__ten_cycles),
        cmocka_unit_test(bit_ops__in_u_alone__one_a_cycle),
        cmocka_unit_test(throughput__mask_ops_loads_stores__one_a_cycle),
        cmocka_unit_test(throughput__longer_than_a_cycle__class_is_busy),
        cmocka_unit_test(gap__of_three__between_issue_cycles),
        cmocka_unit_test(blame__several_reasons__the_last_to_end),
    };
    return cmocka_run_group_tests_name("issue", tests, NULL, NULL);
}
