/* The count model: the sum of the ops' throughputs, whatever their order. */
#include "sim/count.h"
#include "tests/sim/timeline.h"

static void count__hand_made_histogram__sum_of_prices(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    uint64_t ops[LRB_OP_COUNT] = {0};
    assert_int_equal(sim_count_half_cycles(machine, ops), 0);
    ops[LRB_OP_madd231_ps] = 100; /* 1 each */
    ops[LRB_OP_load_ps] = 30;     /* 1 */
    ops[LRB_OP_add] = 7;          /* 0.5 */
    ops[LRB_OP_load32] = 4;       /* 0.5 */
    ops[LRB_OP_imul] = 2;         /* 10 */
    ops[LRB_OP_cmp] = 5;          /* 0.5 */
    ops[LRB_OP_jcc] = 5;          /* 1 */
    ops[LRB_OP_phase] = 1000;     /* nothing */
    ops[LRB_OP_region] = 1000;
    assert_int_equal(sim_count_half_cycles(machine, ops), 200 + 60 + 7 + 4 + 40 + 5 + 10);
    ops[LRB_OP_rcpres_ps] = 3; /* 1, and 2 on Knights Corner */
    assert_int_equal(sim_count_half_cycles(machine, ops), 326 + 6);
    sim_machine_destroy(&machine);
    machine = machine_with("knc", NULL, NULL);
    assert_int_equal(sim_count_half_cycles(machine, ops), 326 + 12);
    sim_machine_destroy(&machine);
    machine = machine_with("larrabee", "vector_alu.throughput=1.5", "scalar_alu.throughput=2");
    assert_int_equal(sim_count_half_cycles(machine, ops), 326 + 6 + 100 + 7 * 3);
    sim_machine_destroy(&machine);
}

static void count__one_of_each_op__its_class_alone(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("knc", NULL, NULL);
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        uint64_t ops[LRB_OP_COUNT] = {0};
        ops[id] = UINT64_C(1) << 40;
        assert_int_equal(sim_count_half_cycles(machine, ops),
                         (uint64_t)machine->cost[lrb_op_table[id].class_id].throughput << 40);
    }
    sim_machine_destroy(&machine);
}

static uint64_t half_cycles(const sim_machine *machine, const timeline_step *steps, size_t count)
{
    uint64_t ops[LRB_OP_COUNT] = {0};
    for (size_t i = 0; i < count; i++)
        ops[steps[i].event.op & LRB_EVENT_ID]++;
    return sim_count_half_cycles(machine, ops);
}

/* The count is no bound of the issue model's cycles: a pair of vector and scalar op takes one cycle, not 1.5; a dependent
   op takes its producer's latency, not 1. (What one class's ops cost is a lower bound: test_issue_random.) */
static void count__against_issue__neither_bound(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step pair[] = {{1, OP(add_ps, 0)}, {1, OP(add, 0)}};
    const timeline_step chain[] = {{1, OP(add_ps, 0)}, {5, OP(add_ps, 1)}};
    const timeline_step saturated[] = {{1, OP(add_ps, 0)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}};
    TIMELINE(machine, pair);
    assert_int_equal(half_cycles(machine, pair, 2), 3);
    TIMELINE(machine, chain);
    assert_int_equal(half_cycles(machine, chain, 2), 4);
    TIMELINE(machine, saturated);
    assert_int_equal(half_cycles(machine, saturated, 3), 6);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(count__hand_made_histogram__sum_of_prices),
        cmocka_unit_test(count__one_of_each_op__its_class_alone),
        cmocka_unit_test(count__against_issue__neither_bound),
    };
    return cmocka_run_group_tests_name("count", tests, NULL, NULL);
}
