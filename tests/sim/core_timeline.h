/* Hand-worked sequences for the core model: each op of a thread with the cycle in which it must issue, on both simulators. */
#ifndef TESTS_SIM_CORE_TIMELINE_H
#define TESTS_SIM_CORE_TIMELINE_H

#include "tests/sim/core_pair.h"
#include "tests/sim/timeline.h"

/* Both simulators on a pair's tiles; they must agree. */
static inline sim_core_stats run_pair(core_pair *p, const sim_machine *machine)
{
    if (!core_pair_run(p, machine)) {
        core_pair_print_differences(p);
        fail_msg("the two simulators differ");
    }
    return p->fast;
}

/* The same stream as a tile of its own for each of `tiles` threads or turns. */
static inline sim_core_stats run_tiles(const sim_machine *machine, const lrb_event *events, size_t count, size_t tiles)
{
    static core_pair p;
    p.count = tiles;
    for (size_t i = 0; i < tiles; i++)
        p.tiles[i] = (slow_core_tile){.events = events, .count = count};
    return run_pair(&p, machine);
}

/* One thread alone: the cycles of each beginning of the sequence say when each op issued. */
static inline sim_core_stats check_core_timeline(const char *file, int line, const sim_machine *machine, const timeline_step *steps,
                                                 size_t count)
{
    lrb_event events[400];
    sim_core_stats stats = {0};
    assert_in_range(count, 1, 400);
    for (size_t n = 1; n <= count; n++) {
        events[n - 1] = steps[n - 1].event;
        stats = run_tiles(machine, events, n, 1);
        if (stats.cycles != steps[n - 1].cycle) {
            printf("# step %zu, %s: issues in cycle %llu, not %u\n", n - 1, lrb_op_table[steps[n - 1].event.op & LRB_EVENT_ID].id,
                   (unsigned long long)stats.cycles, steps[n - 1].cycle);
            _fail(file, line);
        }
    }
    return stats;
}

#define CORE_TIMELINE(machine, steps) check_core_timeline(__FILE__, __LINE__, machine, steps, sizeof(steps) / sizeof *(steps))

/* A built-in machine with changes, the last one NULL. The caller destroys it. */
static inline sim_machine *machine_of(const char *name, const char *const *changes)
{
    sim_machine *machine = NULL;
    base_error err = {0};
    base_status status = sim_machine_load(name, &machine, &err);
    for (; status == BASE_OK && *changes; changes++)
        status = sim_machine_set(machine, *changes, &err);
    if (status == BASE_OK)
        status = sim_machine_check(machine, &err);
    if (status != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return machine;
}

#define MACHINE(name, ...) machine_of(name, (const char *const[]){__VA_ARGS__, NULL})

#endif
