/* The issue model against the slow one: random streams on random machines, every number of the statistics equal. And
 * what holds for any stream: the buckets sum to the cycles, tiles are independent.
 *
 * test_issue_random [EVENTS]: how many events to compare; a million unless told. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/count.h"
#include "sim/issue.h"
#include "tests/sim/random_machine.h"
#include "tests/sim/random_stream.h"
#include "tests/sim/slow_issue.h"

enum { MAX_EVENTS = 6000, TILES = 6 /* of a machine */, WORDS = sizeof(sim_issue_stats) / sizeof(uint64_t) };

/* Two simulators of a machine, fed the same. */
typedef struct pair {
    sim_machine *machine;
    sim_issue *fast;
    sim_issue_stats slow;
    uint64_t fast_regions[SIM_MAX_REGIONS + 1], slow_regions[SIM_MAX_REGIONS + 1];
} pair;

static pair pair_of(sim_machine *machine)
{
    pair p = {.machine = machine};
    assert_int_equal(sim_issue_create(machine, &p.fast, NULL), BASE_OK);
    return p;
}

static sim_machine *drawn_machine(base_random *random)
{
    sim_machine *machine = NULL;
    base_error err = {0};
    if (random_machine(random, &machine, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return machine;
}

/* Time a tile with the fast simulator, handed over in `cuts` + 1 batches. */
static void time_fast(sim_issue *s, const lrb_event *events, uint32_t count, uint32_t cuts,
                      uint64_t regions[SIM_MAX_REGIONS + 1])
{
    uint32_t done = 0;
    sim_issue_begin(s);
    for (uint32_t i = 1; i <= cuts + 1; i++) {
        uint32_t next = (uint32_t)((uint64_t)count * i / (cuts + 1));
        sim_issue_events(s, events + done, next - done);
        done = next;
    }
    sim_issue_end(s, regions);
}

/* Time a tile with both; true if all numbers of all tiles so far are equal. */
static bool tile_agrees(pair *p, const lrb_event *events, uint32_t count, uint32_t cuts)
{
    time_fast(p->fast, events, count, cuts, p->fast_regions);
    assert_true(slow_issue_tile(p->machine, events, count, &p->slow, p->slow_regions));
    return memcmp(sim_issue_get(p->fast), &p->slow, sizeof p->slow) == 0 &&
           memcmp(p->fast_regions, p->slow_regions, sizeof p->slow_regions) == 0;
}

/* Name a number of the statistics by its place. */
static void print_number(size_t word, uint64_t fast, uint64_t slow)
{
    static const struct {
        const char *name;
        size_t offset;
    } members[] = {
        {"cycles", offsetof(sim_issue_stats, cycles)},
        {"issued_one", offsetof(sim_issue_stats, issued_one)},
        {"issued_pair", offsetof(sim_issue_stats, issued_pair)},
        {"gap", offsetof(sim_issue_stats, gap)},
        {"blocked", offsetof(sim_issue_stats, blocked)},
        {"busy", offsetof(sim_issue_stats, busy)},
        {"operand", offsetof(sim_issue_stats, operand)},
        {"store_forward", offsetof(sim_issue_stats, store_forward)},
        {"issued_by_class", offsetof(sim_issue_stats, issued_by_class)},
        {"phase", offsetof(sim_issue_stats, phase)},
        {"phase_vector_ops", offsetof(sim_issue_stats, phase_vector_ops)},
        {"phase_idle_lanes", offsetof(sim_issue_stats, phase_idle_lanes)},
        {"ops", offsetof(sim_issue_stats, ops)},
        {"op_issues", offsetof(sim_issue_stats, op_issues)},
        {"op_cycles", offsetof(sim_issue_stats, op_cycles)},
        {"memory_operands", offsetof(sim_issue_stats, memory_operands)},
    };
    size_t m = sizeof members / sizeof *members - 1;
    while (members[m].offset > word * sizeof(uint64_t))
        m--;
    printf("# %s[%zu]: fast %llu, slow %llu\n", members[m].name, word - members[m].offset / sizeof(uint64_t),
           (unsigned long long)fast, (unsigned long long)slow);
}

/* Find the shortest beginning of the tile on which the two differ, and print its end and the machine. */
static void explain(sim_machine *machine, const lrb_event *events, uint32_t count)
{
    for (uint32_t n = 1; n <= count; n++) {
        pair p = pair_of(machine);
        if (!tile_agrees(&p, events, n, 0)) {
            const uint64_t *fast = (const uint64_t *)sim_issue_get(p.fast), *slow = (const uint64_t *)&p.slow;
            random_machine_print(machine);
            for (uint32_t i = n > 12 ? n - 12 : 0; i < n; i++)
                printf("# %u: %s form %x mask %04x sources %u %u %u %u aux %u\n", i,
                       lrb_op_table[events[i].op & LRB_EVENT_ID].id, events[i].op & 0xf000u, events[i].mask,
                       events[i].src[0], events[i].src[1], events[i].src[2], events[i].src[3], events[i].aux);
            for (size_t w = 0; w < WORDS; w++)
                if (fast[w] != slow[w])
                    print_number(w, fast[w], slow[w]);
            n = count;
        }
        sim_issue_destroy(&p.fast);
    }
}

static uint64_t sum(const uint64_t *numbers, size_t count)
{
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++)
        total += numbers[i];
    return total;
}

/* Every cycle is in one bucket, in one phase and in one region. */
static void assert_sums(const sim_issue_stats *s, uint64_t events)
{
    uint64_t issues = s->issued_one + s->issued_pair;
    assert_int_equal(s->cycles, issues + s->gap + s->blocked + sum(s->busy, LRB_CLASS_COUNT) + s->store_forward +
                                    sum(s->operand[0], (size_t)LRB_CLASS_COUNT * SIM_CONSUMERS));
    assert_int_equal(s->cycles, sum(s->phase, SIM_MAX_PHASES));
    assert_int_equal(issues, sum(s->issued_by_class, LRB_CLASS_COUNT));
    assert_int_equal(issues, sum(s->op_issues, LRB_OP_COUNT));
    assert_int_equal(s->cycles, sum(s->op_cycles, LRB_OP_COUNT));
    assert_int_equal(events, sum(s->ops, LRB_OP_COUNT));
    assert_int_equal(events, issues + s->issued_pair + s->ops[LRB_OP_phase] + s->ops[LRB_OP_region] + s->ops[LRB_OP_line]);
}

/* What the ops of one class cost in `count` bounds a tile's cycles from below, but for the last op, and two ops a cycle
   do. The price of all classes together is no bound: U and V work side by side. */
static void assert_bounds(const sim_machine *machine, const sim_issue_stats *s)
{
    for (int c = 0; c < LRB_CLASS_COUNT; c++) {
        uint64_t ops[LRB_OP_COUNT] = {0};
        for (int id = 0; id < LRB_OP_COUNT; id++)
            ops[id] = (int)lrb_op_table[id].class_id == c ? s->ops[id] : 0;
        if (sum(ops, LRB_OP_COUNT) && c != LRB_CLASS_marker)
            assert_true(2 * s->cycles + machine->cost[c].throughput > sim_count_half_cycles(machine, ops));
    }
    assert_true(2 * s->cycles >= sum(s->ops, LRB_OP_COUNT) - s->ops[LRB_OP_phase] - s->ops[LRB_OP_region] - s->ops[LRB_OP_line]);
}

/* A few tiles on one machine; returns the number of events. */
static uint64_t compare_machine(base_random *random, sim_machine *machine, lrb_event *events, uint64_t seed)
{
    uint64_t total = 0;
    pair p = pair_of(machine);
    for (int tile = 0; tile < TILES; tile++) {
        uint32_t count = (uint32_t)(base_random_bits(random) % (1 + base_random_bits(random) % MAX_EVENTS));
        random_stream(random, events, count);
        sim_issue_stats before = *sim_issue_get(p.fast), only;
        if (!tile_agrees(&p, events, count, (uint32_t)(base_random_bits(random) % 5))) {
            explain(machine, events, count);
            fail_msg("machine of seed %llu, tile %d, %u events: the two simulators differ", (unsigned long long)seed, tile,
                     count);
        }
        total += count;
        assert_sums(sim_issue_get(p.fast), total);
        for (size_t w = 0; w < WORDS; w++)
            ((uint64_t *)&only)[w] = ((const uint64_t *)sim_issue_get(p.fast))[w] - ((uint64_t *)&before)[w];
        assert_int_equal(only.cycles, sum(p.fast_regions, SIM_MAX_REGIONS + 1));
        assert_bounds(machine, &only);
    }
    sim_issue_destroy(&p.fast);
    return total;
}

static void random__any_machine_any_stream__both_simulators_agree(void **state)
{
    const uint64_t wanted = *(const uint64_t *)*state;
    lrb_event *events = calloc(MAX_EVENTS, sizeof *events);
    assert_non_null(events);
    uint64_t done = 0, machines = 0;
    for (uint64_t seed = 1; done < wanted; seed++, machines++) {
        base_random random = {seed};
        sim_machine *machine = drawn_machine(&random);
        done += compare_machine(&random, machine, events, seed);
        sim_machine_destroy(&machine);
    }
    printf("# %llu events on %llu machines\n", (unsigned long long)done, (unsigned long long)machines);
    free(events);
}

static void random__built_in_machines__both_simulators_agree(void **state)
{
    const uint64_t wanted = *(const uint64_t *)*state / 4;
    lrb_event *events = calloc(MAX_EVENTS, sizeof *events);
    assert_non_null(events);
    size_t names = 0;
    for (size_t i = 0; i < (sim_machine_names(&names), names); i++) {
        uint64_t done = 0;
        for (uint64_t seed = 1; done < wanted; seed++) {
            base_random random = {seed};
            sim_machine *machine = NULL;
            assert_int_equal(sim_machine_load(sim_machine_names(&names)[i], &machine, NULL), BASE_OK);
            done += compare_machine(&random, machine, events, seed);
            sim_machine_destroy(&machine);
        }
    }
    free(events);
}

/* All latencies, throughputs and blocking times at their limit of 1000 cycles: the fast simulator's memory of the youngest
   ops has to reach that far back. Fillers that nothing holds up let the distance between producer and consumer vary. */
static void random__latency_at_the_limit__remembered_that_long(void **state)
{
    (void)state;
    sim_machine *machine = NULL;
    lrb_event *events = calloc(2100, sizeof *events);
    assert_non_null(events);
    assert_int_equal(sim_machine_load("larrabee", &machine, NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_alu.latency=1000", NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, "vector_alu.latency_to_shuffle=1000", NULL), BASE_OK);
    for (uint32_t fillers = 1980; fillers < 2020; fillers++) {
        events[0] = (lrb_event){.op = LRB_OP_add_ps, .mask = 0xffff};
        for (uint32_t i = 1; i <= fillers; i++)
            events[i] = (lrb_event){.op = LRB_OP_add, .mask = 0xffff};
        events[fillers + 1] = (lrb_event){.op = LRB_OP_mul_ps, .mask = 0xffff, .src = {(uint16_t)(fillers + 1)}};
        pair p = pair_of(machine);
        assert_true(tile_agrees(&p, events, fillers + 2, 0));
        /* fillers: one beside the producer, then two a cycle; the consumer follows them, but not before cycle 1001 */
        uint64_t after = 2 + fillers / 2;
        assert_int_equal(p.slow.cycles, after > 1001 ? after : 1001);
        sim_issue_destroy(&p.fast);
    }
    sim_machine_destroy(&machine);
    free(events);
}

/* The same tile gives the same numbers alone, again, and after any other. */
static void tiles__in_any_company__independent(void **state)
{
    (void)state;
    lrb_event *events = calloc(MAX_EVENTS, sizeof *events), *other = calloc(MAX_EVENTS, sizeof *events);
    assert_true(events && other);
    for (uint64_t seed = 1; seed <= 60; seed++) {
        base_random random = {seed * 1000003};
        sim_machine *machine = drawn_machine(&random);
        random_stream(&random, events, 500);
        random_stream(&random, other, 700);
        uint64_t regions[4][SIM_MAX_REGIONS + 1];
        sim_issue_stats expected = {0};
        sim_issue *alone, *shared, *company;
        assert_int_equal(sim_issue_create(machine, &alone, NULL), BASE_OK);
        assert_int_equal(sim_issue_create(machine, &shared, NULL), BASE_OK);
        assert_int_equal(sim_issue_create(machine, &company, NULL), BASE_OK);
        time_fast(alone, events, 500, 0, regions[0]);
        time_fast(company, other, 700, 0, regions[1]);
        time_fast(shared, events, 500, 3, regions[1]);
        time_fast(shared, other, 700, 3, regions[2]);
        time_fast(shared, events, 500, 3, regions[3]);
        assert_memory_equal(regions[0], regions[1], sizeof regions[0]);
        assert_memory_equal(regions[0], regions[3], sizeof regions[0]);
        sim_issue_stats_add(&expected, sim_issue_get(alone));
        sim_issue_stats_add(&expected, sim_issue_get(alone));
        sim_issue_stats_add(&expected, sim_issue_get(company));
        assert_memory_equal(&expected, sim_issue_get(shared), sizeof expected);
        sim_issue_destroy(&alone);
        sim_issue_destroy(&shared);
        sim_issue_destroy(&company);
        sim_machine_destroy(&machine);
    }
    free(events);
    free(other);
}

int main(int argc, char **argv)
{
    uint64_t wanted = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(random__any_machine_any_stream__both_simulators_agree, &wanted),
        cmocka_unit_test_prestate(random__built_in_machines__both_simulators_agree, &wanted),
        cmocka_unit_test(random__latency_at_the_limit__remembered_that_long),
        cmocka_unit_test(tiles__in_any_company__independent),
    };
    return cmocka_run_group_tests_name("issue_random", tests, NULL, NULL);
}
