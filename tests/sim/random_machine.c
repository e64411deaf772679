#include "tests/sim/random_machine.h"

#include <stdio.h>

static unsigned below(base_random *random, unsigned n)
{
    return (unsigned)(base_random_bits(random) % n);
}

/* 1 .. limit, with small numbers more often. */
static unsigned small_number(base_random *random, unsigned limit)
{
    unsigned reach = 1 + below(random, limit);
    return 1 + below(random, reach);
}

static base_status set(sim_machine *machine, lrb_cost_class c, sim_class_key key, const char *value, base_error *err)
{
    char assignment[100];
    sim_field_view view;
    if (!sim_machine_field(machine, sim_class_field(c, key), &view))
        return BASE_OK; /* this class has no such field */
    snprintf(assignment, sizeof assignment, "%s.%s=%s", view.section, view.key, value);
    return sim_machine_set(machine, assignment, err);
}

static base_status set_cycles(sim_machine *machine, lrb_cost_class c, sim_class_key key, unsigned cycles, base_error *err)
{
    char value[20];
    snprintf(value, sizeof value, "%u", cycles);
    return set(machine, c, key, value, err);
}

/* Fields of one class; latencies up to `reach`, at most 996: those to a shuffle and an address add up to 3, one to a branch or mask 1. */
static base_status set_class(base_random *random, sim_machine *machine, lrb_cost_class c, unsigned reach, base_error *err)
{
    static const char *const pipes[] = {"U", "V", "UV", "UV"};
    char throughput[20];
    unsigned pipe = below(random, 4);
    unsigned latency = small_number(random, reach), more = small_number(random, 4) - 1;
    unsigned shuffle = latency + more, address = latency + below(random, 3);
    unsigned halves = below(random, 4) ? 1 + below(random, 3) : small_number(random, below(random, 8) ? 20 : 2 * reach);
    unsigned blocking = below(random, 6) ? 0 : small_number(random, below(random, 8) ? 10 : reach);
    if (halves < 2 && pipe < 2)
        halves = 2; /* two a cycle needs both pipes */
    snprintf(throughput, sizeof throughput, "%u.%u", halves / 2, halves % 2 * 5);
    base_status status = set(machine, c, SIM_KEY_pipes, pipes[pipe], err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_latency, latency, err);
    if (!status)
        status = set(machine, c, SIM_KEY_throughput, throughput, err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_latency_to_shuffle, shuffle, err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_latency_to_branch, below(random, 2) ? 0 : below(random, latency + 2), err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_latency_to_address, address, err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_latency_to_mask, below(random, 3) ? below(random, latency + 2) : 0, err);
    if (!status)
        status = set_cycles(machine, c, SIM_KEY_blocking, blocking, err);
    return status;
}

base_status random_machine(base_random *random, sim_machine **out, base_error *err)
{
    static const unsigned reaches[] = {2, 6, 6, 12, 12, 40};
    char gap[40];
    sim_machine *machine = NULL;
    base_status status = sim_machine_load(below(random, 2) ? "larrabee" : "knc", &machine, err);
    if (status)
        return status;
    unsigned reach = reaches[below(random, sizeof reaches / sizeof *reaches)];
    for (int c = 0; c < LRB_CLASS_COUNT && !status; c++)
        status = set_class(random, machine, (lrb_cost_class)c, below(random, 100) ? reach : 996, err);
    snprintf(gap, sizeof gap, "issue_gap=%u", below(random, 2) ? 1 : small_number(random, 16));
    if (!status)
        status = sim_machine_set(machine, gap, err);
    if (!status)
        status = sim_machine_check(machine, err);
    if (status)
        sim_machine_destroy(&machine);
    *out = machine;
    return status;
}

/* One plain field. */
static base_status set_field(sim_machine *machine, const char *name, unsigned value, base_error *err)
{
    char assignment[100];
    snprintf(assignment, sizeof assignment, "%s=%u", name, value);
    return sim_machine_set(machine, assignment, err);
}

static base_status set_tenths(sim_machine *machine, const char *name, unsigned tenths, base_error *err)
{
    char assignment[100];
    snprintf(assignment, sizeof assignment, "%s=%u.%u", name, tenths / 10, tenths % 10);
    return sim_machine_set(machine, assignment, err);
}

/* Small caches, so that lines leave them. */
static base_status set_caches(base_random *random, sim_machine *machine, base_error *err)
{
    const unsigned line = 64u << below(random, 2), ways1 = 1u << below(random, 4), ways2 = 1u << below(random, 4);
    const unsigned size1 = line * ways1 << (4 + below(random, 2)), size2 = line * ways2 << (4 + below(random, 5));
    const unsigned latency1 = 1 + below(random, 5), latency2 = latency1 + below(random, 30);
    const struct {
        const char *name;
        unsigned value;
    } fields[] = {
        {"l1.line_bytes", line}, {"l2.line_bytes", line}, {"l1.ways", ways1}, {"l2.ways", ways2},
        {"l1.size_bytes", size1}, {"l2.size_bytes", size2}, {"l1.latency", latency1}, {"l2.latency", latency2},
        {"l2.remote_latency", latency2}, {"memory.latency", latency2 + below(random, below(random, 3) ? 60 : 400)},
        {"l1.banks", below(random, 5)}, {"l1.load_bytes_per_cycle", 64 + 64 * below(random, 2)},
        {"l1.store_bytes_per_cycle", 64 + 64 * below(random, 2)},
        {"memory.demand_misses_per_thread", small_number(random, 5)}, {"memory.prefetches_per_core", below(random, 6)},
        {"memory.chip_bytes_per_cycle", below(random, 3) * below(random, 200)}, {"cores", small_number(random, 4)},
    };
    base_status status = BASE_OK;
    for (size_t i = 0; i < sizeof fields / sizeof *fields && !status; i++)
        status = set_field(machine, fields[i].name, fields[i].value, err);
    if (!status)
        status = set_tenths(machine, "l2.cycles_per_line", below(random, 60), err);
    return status ? status : set_tenths(machine, "memory.cycles_per_line", below(random, 2) ? below(random, 300) : 0, err);
}

base_status random_core_machine(base_random *random, sim_machine **out, base_error *err)
{
    const unsigned ways = small_number(random, 3);
    base_status status = random_machine(random, out, err);
    if (status)
        return status;
    const struct {
        const char *name;
        unsigned value;
    } fields[] = {
        {"threads", below(random, 3) ? small_number(random, 6) : 4},
        {"branch.mispredict_penalty", below(random, 12)}, {"branch.btb_miss_penalty", below(random, 12)},
        {"branch.btb_ways", ways}, {"branch.btb_entries", ways << below(random, 6)},
    };
    for (size_t i = 0; i < sizeof fields / sizeof *fields && !status; i++)
        status = set_field(*out, fields[i].name, fields[i].value, err);
    if (!status)
        status = set_caches(random, *out, err);
    if (!status)
        status = sim_machine_check(*out, err);
    if (status)
        sim_machine_destroy(out);
    return status;
}

void random_core_machine_print(const sim_machine *machine)
{
    random_machine_print(machine);
    for (size_t number = 0; number < SIM_PLAIN_FIELDS; number++) {
        sim_field_view view;
        if (sim_machine_field(machine, number, &view))
            printf("# %s.%s = %s\n", view.section, view.key, view.value);
    }
}

void random_machine_print(const sim_machine *machine)
{
    static const char *const pipes[] = {"-", "U", "V", "UV"};
    printf("# issue_gap %u\n", machine->issue_gap);
    for (int c = 0; c < LRB_CLASS_COUNT; c++) {
        const sim_class_cost *k = &machine->cost[c];
        printf("# %-16s pipes %-2s latency %u (shuffle %u, branch %u, address %u, mask %u) throughput %u/2 blocking %u\n",
               lrb_cost_classes[c].name, pipes[k->pipes], k->latency, k->latency_to_shuffle, k->latency_to_branch,
               k->latency_to_address, k->latency_to_mask, k->throughput, k->blocking);
    }
}
