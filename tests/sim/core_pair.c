#include "tests/sim/core_pair.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    core_pair *p = user;
    (void)err;
    *events = NULL;
    if (p->next == p->count)
        return BASE_OK;
    p->of_thread[thread] = p->next;
    *events = p->tiles[p->next].events;
    *count = p->tiles[p->next++].count;
    return BASE_OK;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    core_pair *p = user;
    memcpy(p->regions[p->of_thread[thread]], regions, sizeof p->regions[0]);
}

bool core_pair_run(core_pair *p, const sim_machine *machine)
{
    const sim_core_feed feed = {next_tile, tile_done, p};
    sim_core *core = NULL;
    p->next = 0;
    assert_int_equal(sim_core_create(machine, &core, NULL), BASE_OK);
    assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
    p->fast = sim_core_get(core);
    sim_core_destroy(&core);
    assert_true(slow_core_run(machine, p->tiles, p->count, &p->slow));
    bool equal = memcmp(&p->fast, &p->slow, sizeof p->fast) == 0;
    for (size_t i = 0; i < p->count; i++)
        equal = equal && memcmp(p->regions[i], p->tiles[i].regions, sizeof p->regions[i]) == 0;
    return equal;
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

void core_pair_print_differences(const core_pair *p)
{
    const uint64_t *fast = (const uint64_t *)&p->fast, *slow = (const uint64_t *)&p->slow;
    for (size_t word = 0; word < sizeof p->fast / sizeof *fast; word++)
        if (fast[word] != slow[word])
            print_number(word, fast[word], slow[word]);
}
