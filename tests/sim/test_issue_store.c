/* The issue model's memory: a load waits for the stores to the words that it reads, and for no others. A vector store's
 * data is there 4 cycles later, a scalar store's 1 (larrabee). Addresses 64 and 4160 are 64 lines apart. */
#include "tests/sim/timeline.h"

#define STORE(lanes, address) OP_AT(store_ps, 0, lanes, address, 0)
#define LOAD(form, lanes, address) OP_AT(load_ps, form, lanes, address, 0)

static void forward__same_words__four_cycles(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step load[] = {{1, STORE(0xffff, 64)}, {5, LOAD(0, 0xffff, 64)}, {9, OP(add_ps, 1)}};
    const timeline_step operand[] = {{1, STORE(0xffff, 64)}, {5, OP_AT(add_ps, LRB_FORM_MEMORY, 0xffff, 64, 0)}};
    const timeline_step scalar[] = {{1, STORE(0x0002, 64)}, {5, OP_AT(load32, 0, 0xffff, 68, 0)}};
    const timeline_step early[] = {
        {1, STORE(0xffff, 64)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {5, LOAD(0, 0xffff, 64)},
    };
    const timeline_step in_time[] = {
        {1, STORE(0xffff, 64)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {5, OP(add_ps, 0)},
        {5, LOAD(0, 0xffff, 64)},
    };
    assert_int_equal(TIMELINE(machine, load).store_forward, 3);
    assert_int_equal(TIMELINE(machine, operand).store_forward, 3);
    assert_int_equal(TIMELINE(machine, scalar).store_forward, 3);
    assert_int_equal(TIMELINE(machine, early).store_forward, 0); /* its turn came in cycle 5 as well */
    assert_int_equal(TIMELINE(machine, in_time).store_forward, 0);
    sim_machine_destroy(&machine);
}

/* A scalar store and a load may share a cycle, but not of the same word. */
static void forward__scalar_store__one_cycle(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step same[] = {{1, OP_AT(store32, 0, 0xffff, 64, 0)}, {2, OP_AT(load32, 0, 0xffff, 64, 0)}};
    const timeline_step half[] = {{1, OP_AT(store32, 0, 0xffff, 64, 0)}, {2, OP_AT(load16, 0, 0xffff, 66, 0)}};
    const timeline_step next[] = {{1, OP_AT(store32, 0, 0xffff, 64, 0)}, {1, OP_AT(load32, 0, 0xffff, 68, 0)}};
    const timeline_step vector[] = {{1, OP_AT(store32, 0, 0xffff, 64, 0)}, {2, LOAD(0, 0xffff, 64)}};
    const timeline_step lanes[] = {{1, OP_AT(store32, 0, 0xffff, 64, 0)}, {1, LOAD(0, 0xfffe, 64)}};
    TIMELINE(machine, same);
    TIMELINE(machine, half);
    TIMELINE(machine, next);
    TIMELINE(machine, vector);
    TIMELINE(machine, lanes);
    sim_machine_destroy(&machine);
}

/* Masks select the words of a store and of a load; a broadcast reads one word or four, whatever its mask. */
static void forward__other_words__no_wait(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const struct {
        lrb_event load;
        unsigned cycle;
    } loads[] = { /* after a store of words 4 to 7 of line 1 */
        {LOAD(0, 0xff0f, 64), 1},
        {LOAD(0, 0x0080, 64), 5},
        {LOAD(0, 0xffff, 128), 1},
        {LOAD(0, 0xffff, 0), 1},
        {LOAD(BROADCAST_1, 0xffff, 64 + 12), 1},
        {LOAD(BROADCAST_1, 0xffff, 64 + 16), 5},
        {LOAD(BROADCAST_1, 0xffff, 64 + 28), 5},
        {LOAD(BROADCAST_1, 0xffff, 64 + 32), 1},
        {LOAD(BROADCAST_4, 0xffff, 64), 1},
        {LOAD(BROADCAST_4, 0xffff, 64 + 16), 5},
        {LOAD(BROADCAST_4, 0xffff, 64 + 32), 1},
        {OP_AT(load32, 0, 0xffff, 64 + 28, 0), 5},
        {OP_AT(load32, 0, 0xffff, 64 + 32, 0), 1},
    };
    for (size_t i = 0; i < sizeof loads / sizeof *loads; i++) {
        const timeline_step steps[] = {{1, STORE(0x00f0, 64)}, {loads[i].cycle, loads[i].load}};
        TIMELINE(machine, steps);
    }
    const timeline_step operand_1[] = {
        {1, STORE(0x00f0, 64)}, {2, OP_AT(add_ps, LRB_FORM_MEMORY | BROADCAST_1, 0xffff, 64, 0)},
    };
    const timeline_step operand_4[] = {
        {1, STORE(0x0080, 64)}, {5, OP_AT(add_ps, LRB_FORM_MEMORY | BROADCAST_4, 0xffff, 80, 0)},
    };
    TIMELINE(machine, operand_1);
    TIMELINE(machine, operand_4);
    sim_machine_destroy(&machine);
}

/* Stores wait neither for stores nor for loads, loads not for loads. */
static void order__store_after_store_or_load__no_wait(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step steps[] = {
        {1, LOAD(0, 0xffff, 64)},  {1, STORE(0xffff, 64)}, {2, STORE(0xffff, 64)},
        {6, LOAD(0, 0xffff, 64)},  {7, LOAD(0, 0xffff, 64)}, /* four cycles after the younger store */
    };
    TIMELINE(machine, steps);
    sim_machine_destroy(&machine);
}

/* Stores to a line, each while the one before is under way, count as one, ready when the last of them is. Once ready,
   words are forgotten. */
static void burst__stores_to_one_line__ready_together(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step burst[] = { /* words 0 to 7 alone would be there in cycle 5 */
        {1, STORE(0x00ff, 64)}, {2, STORE(0xff00, 64)}, {6, LOAD(0, 0x0001, 64)},
    };
    const timeline_step mixed[] = { /* the scalar store is ready in cycle 2, the vector store's words not before 5 */
        {1, STORE(0xff00, 64)}, {1, OP_AT(store32, 0, 0xffff, 64, 0)}, {5, LOAD(0, 0x8000, 64)},
    };
    const timeline_step apart[] = { /* the second store issues in cycle 5, when the first is ready */
        {1, STORE(0x00ff, 64)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {5, OP(add_ps, 0)},
        {5, STORE(0xff00, 64)}, {6, LOAD(0, 0x00ff, 64)}, {9, LOAD(0, 0xff00, 64)},
    };
    const timeline_step closer[] = { /* in cycle 4: a burst */
        {1, STORE(0x00ff, 64)}, {2, OP(add_ps, 0)}, {3, OP(add_ps, 0)}, {4, OP(add_ps, 0)}, {4, STORE(0xff00, 64)},
        {8, LOAD(0, 0x00ff, 64)},
    };
    TIMELINE(machine, burst);
    TIMELINE(machine, mixed);
    TIMELINE(machine, apart);
    TIMELINE(machine, closer);
    sim_machine_destroy(&machine);
}

/* The table holds one line for each remainder of the line's number by 64: a younger store there makes it forget. */
static void table__line_64_lines_further__forgets(void **state)
{
    (void)state;
    sim_machine *machine = machine_with("larrabee", NULL, NULL);
    const timeline_step other[] = {
        {1, STORE(0xffff, 64)}, {2, STORE(0xffff, 64 + 63 * 64)}, {5, LOAD(0, 0xffff, 64)},
    };
    const timeline_step same_place[] = {
        {1, STORE(0xffff, 64)}, {2, STORE(0xffff, 64 + 64 * 64)}, {2, LOAD(0, 0xffff, 64)},
        {6, LOAD(0, 0xffff, 64 + 64 * 64)},
    };
    TIMELINE(machine, other);
    TIMELINE(machine, same_place);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forward__same_words__four_cycles),
        cmocka_unit_test(forward__scalar_store__one_cycle),
        cmocka_unit_test(forward__other_words__no_wait),
        cmocka_unit_test(order__store_after_store_or_load__no_wait),
        cmocka_unit_test(burst__stores_to_one_line__ready_together),
        cmocka_unit_test(table__line_64_lines_further__forgets),
    };
    return cmocka_run_group_tests_name("issue_store", tests, NULL, NULL);
}
