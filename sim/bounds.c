#include "sim/bounds.h"

#include <stdlib.h>

#include "sim/op_price.h"

struct sim_chain_meter {
    sim_op_price *price;
    uint32_t *ready; /* LRB_FAR of them: cycle of the op's issue, by its number */
    uint8_t *class_id; /* by its number */
    uint32_t latency[LRB_CLASS_COUNT][SIM_CONSUMERS];
};

void sim_chain_meter_destroy(sim_chain_meter **m)
{
    if (*m) {
        free((*m)->price);
        free((*m)->ready);
        free((*m)->class_id);
    }
    free(*m);
    *m = NULL;
}

base_status sim_chain_meter_create(const sim_machine *machine, sim_chain_meter **out, base_error *err)
{
    sim_chain_meter *m = calloc(1, sizeof *m);
    *out = m;
    if (m) {
        m->price = sim_op_prices(machine);
        m->ready = calloc(LRB_FAR, sizeof *m->ready);
        m->class_id = calloc(LRB_FAR, sizeof *m->class_id);
    }
    if (!m || !m->price || !m->ready || !m->class_id) {
        sim_chain_meter_destroy(out);
        return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    }
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        m->latency[k][SIM_CONSUMER_PLAIN] = machine->cost[k].latency;
        m->latency[k][SIM_CONSUMER_SHUFFLE] = machine->cost[k].latency_to_shuffle;
        m->latency[k][SIM_CONSUMER_BRANCH] = machine->cost[k].latency_to_branch;
        m->latency[k][SIM_CONSUMER_ADDRESS] = machine->cost[k].latency_to_address;
        m->latency[k][SIM_CONSUMER_MASK] = machine->cost[k].latency_to_mask;
    }
    return BASE_OK;
}

/* The earliest cycle, from 0, in which an op can issue whose sources issue as early as they can. */
static uint32_t earliest(const sim_chain_meter *m, const lrb_event *e, uint32_t number)
{
    const sim_op_price *p = &m->price[e->op];
    uint32_t at = 0;
    for (int i = 0; i < SIM_MAX_SOURCES; i++) {
        uint32_t distance = e->src[i], source = (number - distance) % LRB_FAR;
        if (distance == 0 || distance > number)
            continue;
        uint32_t ready = m->ready[source] + m->latency[m->class_id[source]][p->consumer[i]];
        at = ready > at ? ready : at;
    }
    return at;
}

uint64_t sim_chain_meter_tile(sim_chain_meter *m, const lrb_event *events, size_t count, sim_chains *chains)
{
    uint32_t number = 0, longest = 0;
    for (const lrb_event *e = events; e < events + count; e++) {
        const sim_op_price *p = &m->price[e->op];
        if (p->flags & SIM_PRICE_MARKER)
            continue;
        uint32_t at = earliest(m, e, number);
        m->ready[number % LRB_FAR] = at;
        m->class_id[number++ % LRB_FAR] = p->class_id;
        longest = at + 1 > longest ? at + 1 : longest;
    }
    chains->sum += longest;
    chains->longest = longest > chains->longest ? longest : chains->longest;
    return longest;
}

void sim_chains_add(sim_chains *to, const sim_chains *from)
{
    to->sum += from->sum;
    to->longest = from->longest > to->longest ? from->longest : to->longest;
}

static uint64_t divide_up(uint64_t a, uint64_t b) { return a / b + (a % b != 0); }

/* Cycles for n issues that are `distance` apart. */
static uint64_t apart(uint64_t n, uint64_t distance) { return n ? (n - 1) * distance + 1 : 0; }

static uint64_t larger(uint64_t a, uint64_t b) { return a > b ? a : b; }

/* A thread has its tiles one after the other. */
uint64_t sim_bound_dependence(const sim_machine *machine, const sim_chains *chains)
{
    return larger(chains->longest, divide_up(chains->sum, (uint64_t)machine->threads * machine->cores));
}

/* Some core has at least its share of any ops, some thread of it at least its own. */
uint64_t sim_bound_ports(const sim_machine *machine, const uint64_t *ops)
{
    uint64_t by_class[LRB_CLASS_COUNT] = {0}, by_pipes[4] = {0}, bound = 0, all = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++)
        by_class[lrb_op_table[id].class_id] += ops[id];
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        const sim_class_cost *cost = &machine->cost[k];
        if (!cost->pipes)
            continue; /* markers */
        all += by_class[k];
        by_pipes[cost->pipes] += by_class[k];
        if (cost->throughput > 1)
            bound = larger(bound, apart(divide_up(by_class[k], machine->cores), (cost->throughput + 1) / 2));
    }
    const uint64_t issues = divide_up(all, 2);
    bound = larger(bound, divide_up(larger(by_pipes[SIM_PIPE_U], by_pipes[SIM_PIPE_V]), machine->cores));
    bound = larger(bound, divide_up(issues, machine->cores));
    return larger(bound, apart(divide_up(issues, (uint64_t)machine->cores * machine->threads), machine->issue_gap));
}

/* Cycles in which a level sends the lines of a core, but for the last ones that may still be waiting. */
static uint64_t lines_bound(const sim_machine *machine, uint64_t lines, uint64_t tenths)
{
    const uint64_t waiting =
        (uint64_t)machine->threads * machine->memory.demand_misses_per_thread + machine->memory.prefetches_per_core;
    lines = divide_up(lines, machine->cores);
    return lines > waiting + 1 ? (lines - waiting - 1) * tenths / 10 : 0;
}

uint64_t sim_bound_memory(const sim_machine *machine, const sim_hierarchy_counts *counts)
{
    return larger(lines_bound(machine, counts->memory_lines, sim_machine_memory_tenths(machine)),
                  lines_bound(machine, counts->l2_accesses - counts->l2_misses, machine->l2.cycles_per_line_tenths));
}
