/* The core model against the slow one: random tiles on random machines, every number of the statistics equal. And what holds
 * for any stream: the buckets sum to the cycles of the core and of its threads.
 *
 * test_core_random [EVENTS]: how many events to compare; a million unless told. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/bounds.h"
#include "sim/core.h"
#include "tests/sim/core_pair.h"
#include "tests/sim/random_machine.h"
#include "tests/sim/random_stream.h"

enum { MAX_TILES = 12, MAX_EVENTS = 1500 };

static uint64_t events_wanted = 1000000;

/* Tiles for both simulators. */
typedef struct work {
    lrb_event events[MAX_TILES][MAX_EVENTS];
    core_pair pair;
} work;

static void print_tile(const slow_core_tile *tile)
{
    for (size_t i = tile->count > 12 ? tile->count - 12 : 0; i < tile->count; i++) {
        const lrb_event *e = &tile->events[i];
        printf("# %zu: %s form %x mask %04x sources %u %u %u %u aux %u\n", i, lrb_op_table[e->op & LRB_EVENT_ID].id, e->op & 0xf000u,
               e->mask, e->src[0], e->src[1], e->src[2], e->src[3], e->aux);
    }
}

/* Make the tiles as short as can be with the two still differing; print what is left. */
static void explain(const sim_machine *machine, core_pair *p)
{
    for (size_t i = 0; i < p->count; i++)
        for (size_t cut = p->tiles[i].count; cut > 0; cut = cut == 1 ? 0 : (cut + 1) / 2)
            while (p->tiles[i].count >= cut) {
                p->tiles[i].count -= cut;
                if (!core_pair_run(p, machine))
                    continue;
                p->tiles[i].count += cut;
                break;
            }
    core_pair_run(p, machine);
    random_core_machine_print(machine);
    for (size_t i = 0; i < p->count; i++) {
        printf("# tile %zu, %zu events\n", i, p->tiles[i].count);
        print_tile(&p->tiles[i]);
    }
    core_pair_print_differences(p);
}

static uint64_t sum(const uint64_t *numbers, size_t count)
{
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++)
        total += numbers[i];
    return total;
}

/* Every cycle of the core and of its threads is in one bucket; those of the core in one phase, region and op as well. */
static void assert_sums(const sim_machine *machine, const core_pair *w, const sim_core_stats *s)
{
    const size_t buckets = sizeof(sim_cycles) / sizeof(uint64_t);
    uint64_t regions = 0;
    for (size_t i = 0; i < w->count; i++)
        regions += sum(w->regions[i], SIM_MAX_REGIONS + 1);
    assert_int_equal(sum((const uint64_t *)&s->core, buckets), s->cycles);
    assert_int_equal(sum((const uint64_t *)&s->threads, buckets), s->cycles * machine->threads);
    for (size_t i = 0; i < buckets; i++) /* none is negative */
        assert_true(((const uint64_t *)&s->core)[i] <= s->cycles && ((const uint64_t *)&s->threads)[i] <= s->cycles * machine->threads);
    assert_int_equal(sum(s->phase, SIM_MAX_PHASES), s->cycles);
    assert_int_equal(sum(s->op_cycles, LRB_OP_COUNT), s->cycles);
    assert_int_equal(sum(s->op_issues, LRB_OP_COUNT), s->core.issued_one + s->core.issued_pair);
    assert_int_equal(sum(s->issued_by_class, LRB_CLASS_COUNT), s->core.issued_one + s->core.issued_pair);
    assert_int_equal(regions, s->cycles);
}

/* No bound is above the cycles of one core. */
static void assert_bounds(sim_machine *machine, const core_pair *w, const sim_core_stats *s)
{
    sim_chain_meter *meter = NULL;
    sim_chains chains = {0};
    char restore[40];
    const unsigned cores = machine->cores;
    const uint64_t memory = sim_bound_memory(machine, &s->memory); /* with the share of one core of `cores` */
    snprintf(restore, sizeof restore, "cores=%u", cores);
    assert_int_equal(sim_chain_meter_create(machine, &meter, NULL), BASE_OK);
    for (size_t i = 0; i < w->count; i++)
        sim_chain_meter_tile(meter, w->tiles[i].events, w->tiles[i].count, &chains);
    assert_int_equal(sim_machine_set(machine, "cores=1", NULL), BASE_OK);
    assert_true(sim_bound_dependence(machine, &chains) <= s->cycles);
    assert_true(sim_bound_ports(machine, s->ops) <= s->cycles);
    assert_true(memory <= s->cycles);
    assert_int_equal(sim_machine_set(machine, restore, NULL), BASE_OK);
    sim_chain_meter_destroy(&meter);
}

static uint64_t draw_work(base_random *random, work *w)
{
    uint64_t events = 0;
    core_pair *p = &w->pair;
    p->count = 1 + base_random_bits(random) % MAX_TILES;
    for (size_t i = 0; i < p->count; i++) {
        uint32_t count = base_random_bits(random) % 8 ? (uint32_t)(base_random_bits(random) % MAX_EVENTS) : (uint32_t)(base_random_bits(random) % 4);
        random_stream(random, w->events[i], count);
        p->tiles[i] = (slow_core_tile){.events = w->events[i], .count = count};
        events += count;
    }
    return events;
}

static void random__any_machine__fast_equals_slow(void **state)
{
    (void)state;
    base_random random = {20};
    work *w = malloc(sizeof *w);
    assert_non_null(w);
    for (uint64_t done = 0; done < events_wanted;) {
        sim_machine *machine = NULL;
        base_error err = {0};
        if (random_core_machine(&random, &machine, &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        for (int round = 0; round < 3; round++) {
            done += draw_work(&random, w);
            if (!core_pair_run(&w->pair, machine)) {
                explain(machine, &w->pair);
                fail();
            }
            assert_sums(machine, &w->pair, &w->pair.fast);
            assert_bounds(machine, &w->pair, &w->pair.fast);
        }
        sim_machine_destroy(&machine);
    }
    free(w);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random__any_machine__fast_equals_slow),
    };
    if (argc > 1)
        events_wanted = strtoull(argv[1], NULL, 10);
    return cmocka_run_group_tests_name("sim/core_random", tests, NULL, NULL);
}
