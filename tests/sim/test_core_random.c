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
#include "tests/sim/random_machine.h"
#include "tests/sim/random_stream.h"
#include "tests/sim/slow_core.h"

enum { MAX_TILES = 12, MAX_EVENTS = 1500, WORDS = sizeof(sim_core_stats) / sizeof(uint64_t) };

static uint64_t events_wanted = 1000000;

/* Tiles for both simulators. */
typedef struct work {
    lrb_event events[MAX_TILES][MAX_EVENTS];
    slow_core_tile tiles[MAX_TILES]; /* with the slow simulator's regions */
    uint64_t regions[MAX_TILES][SIM_MAX_REGIONS + 1]; /* the fast one's */
    size_t count, next;
    size_t of_thread[64];
} work;

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    work *w = user;
    (void)err;
    *events = NULL;
    if (w->next == w->count)
        return BASE_OK;
    w->of_thread[thread] = w->next;
    *events = w->tiles[w->next].events;
    *count = w->tiles[w->next++].count;
    return BASE_OK;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    work *w = user;
    memcpy(w->regions[w->of_thread[thread]], regions, sizeof w->regions[0]);
}

static sim_core_stats run_fast(const sim_machine *machine, work *w)
{
    const sim_core_feed feed = {next_tile, tile_done, w};
    sim_core *core = NULL;
    w->next = 0;
    assert_int_equal(sim_core_create(machine, &core, NULL), BASE_OK);
    assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
    sim_core_stats stats = sim_core_get(core);
    sim_core_destroy(&core);
    return stats;
}

static bool regions_agree(const work *w)
{
    for (size_t i = 0; i < w->count; i++)
        if (memcmp(w->regions[i], w->tiles[i].regions, sizeof w->regions[i]) != 0)
            return false;
    return true;
}

/* Name a number of the statistics by its place. */
static void print_number(size_t word, uint64_t fast, uint64_t slow)
{
#define MEMBER(name) {#name, offsetof(sim_core_stats, name)}
    static const struct {
        const char *name;
        size_t offset;
    } members[] = {
        MEMBER(cycles), MEMBER(core.issued_one), MEMBER(core.issued_pair), MEMBER(core.gap), MEMBER(core.operand), MEMBER(core.l2),
        MEMBER(core.memory), MEMBER(core.store_forward), MEMBER(core.busy), MEMBER(core.blocked), MEMBER(core.delay),
        MEMBER(core.mispredict), MEMBER(core.btb_miss), MEMBER(core.misses), MEMBER(core.prefetches), MEMBER(core.other_thread),
        MEMBER(core.no_work), MEMBER(threads.issued_one), MEMBER(threads.issued_pair), MEMBER(threads.gap), MEMBER(threads.operand),
        MEMBER(threads.l2), MEMBER(threads.memory), MEMBER(threads.store_forward), MEMBER(threads.busy), MEMBER(threads.blocked),
        MEMBER(threads.delay), MEMBER(threads.mispredict), MEMBER(threads.btb_miss), MEMBER(threads.misses),
        MEMBER(threads.prefetches), MEMBER(threads.other_thread), MEMBER(threads.no_work), MEMBER(issued_by_class), MEMBER(phase),
        MEMBER(phase_vector_ops), MEMBER(phase_idle_lanes), MEMBER(ops), MEMBER(op_issues), MEMBER(op_cycles), MEMBER(memory_operands),
        MEMBER(branches), MEMBER(mispredicted), MEMBER(btb_misses), MEMBER(bank_conflicts), MEMBER(memory),
    };
#undef MEMBER
    size_t m = sizeof members / sizeof *members - 1;
    while (members[m].offset > word * sizeof(uint64_t))
        m--;
    printf("# %s[%zu]: fast %llu, slow %llu\n", members[m].name, word - members[m].offset / sizeof(uint64_t),
           (unsigned long long)fast, (unsigned long long)slow);
}

static bool agrees(const sim_machine *machine, work *w, sim_core_stats *fast, sim_core_stats *slow)
{
    *fast = run_fast(machine, w);
    assert_true(slow_core_run(machine, w->tiles, w->count, slow));
    return memcmp(fast, slow, sizeof *fast) == 0 && regions_agree(w);
}

static void print_tile(const slow_core_tile *tile)
{
    for (size_t i = tile->count > 12 ? tile->count - 12 : 0; i < tile->count; i++) {
        const lrb_event *e = &tile->events[i];
        printf("# %zu: %s form %x mask %04x sources %u %u %u %u aux %u\n", i, lrb_op_table[e->op & LRB_EVENT_ID].id, e->op & 0xf000u,
               e->mask, e->src[0], e->src[1], e->src[2], e->src[3], e->aux);
    }
}

/* Make the tiles as short as can be with the two still differing; print what is left. */
static void explain(const sim_machine *machine, work *w)
{
    sim_core_stats fast, slow;
    for (size_t i = 0; i < w->count; i++)
        for (size_t cut = w->tiles[i].count; cut > 0; cut = cut == 1 ? 0 : (cut + 1) / 2)
            while (w->tiles[i].count >= cut) {
                w->tiles[i].count -= cut;
                if (!agrees(machine, w, &fast, &slow))
                    continue;
                w->tiles[i].count += cut;
                break;
            }
    agrees(machine, w, &fast, &slow);
    random_core_machine_print(machine);
    for (size_t i = 0; i < w->count; i++) {
        printf("# tile %zu, %zu events\n", i, w->tiles[i].count);
        print_tile(&w->tiles[i]);
    }
    for (size_t word = 0; word < WORDS; word++)
        if (((const uint64_t *)&fast)[word] != ((const uint64_t *)&slow)[word])
            print_number(word, ((const uint64_t *)&fast)[word], ((const uint64_t *)&slow)[word]);
}

static uint64_t sum(const uint64_t *numbers, size_t count)
{
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++)
        total += numbers[i];
    return total;
}

/* Every cycle of the core and of its threads is in one bucket; those of the core in one phase, region and op as well. */
static void assert_sums(const sim_machine *machine, const work *w, const sim_core_stats *s)
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
static void assert_bounds(sim_machine *machine, const work *w, const sim_core_stats *s)
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
    w->count = 1 + base_random_bits(random) % MAX_TILES;
    for (size_t i = 0; i < w->count; i++) {
        uint32_t count = base_random_bits(random) % 8 ? (uint32_t)(base_random_bits(random) % MAX_EVENTS) : (uint32_t)(base_random_bits(random) % 4);
        random_stream(random, w->events[i], count);
        w->tiles[i] = (slow_core_tile){.events = w->events[i], .count = count};
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
        sim_core_stats fast, slow;
        base_error err = {0};
        if (random_core_machine(&random, &machine, &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        for (int round = 0; round < 3; round++) {
            done += draw_work(&random, w);
            if (!agrees(machine, w, &fast, &slow)) {
                explain(machine, w);
                fail();
            }
            assert_sums(machine, w, &fast);
            assert_bounds(machine, w, &fast);
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
