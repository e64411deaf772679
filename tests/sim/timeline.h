/* Hand-worked sequences: each op with the cycle in which it must issue, tried on both simulators of the issue model. */
#ifndef TESTS_SIM_TIMELINE_H
#define TESTS_SIM_TIMELINE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/issue.h"
#include "tests/sim/slow_issue.h"

/* Events. Sources follow as distances back, 0 for none; vector ops write all lanes unless a mask is given.
   OP(add_ps, 1): {.op = LRB_OP_add_ps, .mask = 0xffff, .src = {1}} */
#define OP(id, ...) {.op = LRB_OP_##id, .mask = 0xffff, .src = {__VA_ARGS__}}
#define OP_MASKED(id, lanes, ...) {.op = LRB_OP_##id, .mask = (lanes), .src = {__VA_ARGS__}}
#define OP_SWIZZLED(id, ...) {.op = LRB_OP_##id | LRB_FORM_SWIZZLE, .mask = 0xffff, .src = {__VA_ARGS__}}
#define OP_AT(id, form, lanes, address, ...) \
    {.op = LRB_OP_##id | (form), .mask = (lanes), .src = {__VA_ARGS__}, .aux = (address)}
#define MARK(id, number) {.op = LRB_OP_##id, .aux = (number)}
#define BROADCAST_1 LRB_FORM_4_BYTES
#define BROADCAST_4 LRB_FORM_16_BYTES

/* An event and the cycle in which it issues; for a marker, that of the last op before it. */
typedef struct timeline_step {
    unsigned cycle;
    lrb_event event;
} timeline_step;

/* A built-in machine with up to two changes ("issue_gap=2"); NULL for none. The caller destroys it. */
static inline sim_machine *machine_with(const char *name, const char *change, const char *other)
{
    sim_machine *machine = NULL;
    base_error err = {0};
    base_status status = sim_machine_load(name, &machine, &err);
    if (!status && change)
        status = sim_machine_set(machine, change, &err);
    if (!status && other)
        status = sim_machine_set(machine, other, &err);
    if (!status)
        status = sim_machine_check(machine, &err);
    if (status)
        fail_msg("%s: %s", err.what, err.why);
    return machine;
}

/* Statistics of one tile, and its regions, which may be NULL. */
static inline sim_issue_stats time_tile(const sim_machine *machine, const lrb_event *events, uint32_t count, uint64_t *regions)
{
    sim_issue *s = NULL;
    uint64_t unwanted[SIM_MAX_REGIONS + 1];
    assert_int_equal(sim_issue_create(machine, &s, NULL), BASE_OK);
    sim_issue_begin(s);
    sim_issue_events(s, events, count);
    sim_issue_end(s, regions ? regions : unwanted);
    sim_issue_stats stats = *sim_issue_get(s);
    sim_issue_destroy(&s);
    return stats;
}

/* A tile ends when its last op issues: so the cycles of each beginning of the sequence say when each op issued. */
static inline sim_issue_stats check_timeline(const char *file, int line, const sim_machine *machine, const timeline_step *steps,
                                             uint32_t count)
{
    lrb_event events[64];
    sim_issue_stats stats = {0};
    uint64_t regions[SIM_MAX_REGIONS + 1];
    assert_in_range(count, 1, 64);
    for (uint32_t n = 1; n <= count; n++) {
        events[n - 1] = steps[n - 1].event;
        stats = time_tile(machine, events, n, NULL);
        sim_issue_stats slow = {0};
        assert_true(slow_issue_tile(machine, events, n, &slow, regions));
        if (stats.cycles != steps[n - 1].cycle || slow.cycles != steps[n - 1].cycle) {
            printf("# step %u, %s: issues in cycle %llu, in the slow simulator %llu, not %u\n", n - 1,
                   lrb_op_table[steps[n - 1].event.op & LRB_EVENT_ID].id, (unsigned long long)stats.cycles,
                   (unsigned long long)slow.cycles, steps[n - 1].cycle);
            _fail(file, line);
        }
    }
    return stats;
}

/* Check an array of steps; gives the statistics of the whole of it. */
#define TIMELINE(machine, steps) \
    check_timeline(__FILE__, __LINE__, machine, steps, (uint32_t)(sizeof(steps) / sizeof *(steps)))

#endif
