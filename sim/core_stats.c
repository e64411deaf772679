#include "sim/core_state.h"

/* Ops that did not join issued first in their cycle. */
static void collect_issues(const sim_core *s, sim_core_stats *to)
{
    uint64_t issues = 0, joins_sum = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        uint64_t issued = lrb_op_table[id].shape == LRB_SHAPE_MARK ? 0 : s->ops[id];
        to->ops[id] = s->ops[id];
        to->op_cycles[id] = s->op_cycles[id];
        to->issued_by_class[lrb_op_table[id].class_id] += issued;
        issues += issued;
    }
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        to->issued_by_class[k] -= s->joins[k];
        joins_sum += s->joins[k];
    }
    issues -= joins_sum;
    to->core.issued_pair = to->threads.issued_pair = joins_sum;
    to->core.issued_one = to->threads.issued_one = issues - joins_sum;
}

static void collect_waits(const uint64_t waited[SIM_BUCKETS], sim_cycles *to)
{
    for (int k = 0; k < LRB_CLASS_COUNT; k++) {
        for (int kind = 0; kind < SIM_CONSUMERS; kind++)
            to->operand[k][kind] = waited[SIM_BUCKET_OPERAND + k * SIM_CONSUMERS + kind];
        to->busy[k] = waited[SIM_BUCKET_BUSY + k];
    }
    to->l2 = waited[SIM_BUCKET_L2];
    to->memory = waited[SIM_BUCKET_MEMORY];
    to->store_forward = waited[SIM_BUCKET_STORE];
    to->blocked = waited[SIM_BUCKET_BLOCKED];
    to->delay = waited[SIM_BUCKET_DELAY];
    to->mispredict = waited[SIM_BUCKET_MISPREDICT];
    to->btb_miss = waited[SIM_BUCKET_BTB_MISS];
    to->misses = waited[SIM_BUCKET_MISSES];
    to->prefetches = waited[SIM_BUCKET_PREFETCHES];
}

sim_core_stats sim_core_get(const sim_core *s)
{
    sim_core_stats stats = s->stats;
    collect_issues(s, &stats);
    collect_waits(s->core_waited, &stats.core);
    collect_waits(s->thread_waited, &stats.threads);
    stats.core.gap = s->core_gap;
    stats.threads.gap = s->thread_gap;
    stats.threads.other_thread = s->other_thread;
    stats.memory = s->memory->counts;
    return stats;
}

void sim_core_stats_idle(sim_core_stats *stats, const sim_machine *machine, uint64_t cycles)
{
    stats->cycles += cycles;
    stats->core.no_work += cycles;
    stats->threads.no_work += cycles * machine->threads;
}

void sim_core_stats_add(sim_core_stats *to, const sim_core_stats *from)
{
    /* All members are uint64_t counts. */
    uint64_t *t = (uint64_t *)to;
    const uint64_t *f = (const uint64_t *)from;
    for (size_t i = 0; i < sizeof *to / sizeof *t; i++)
        t[i] += f[i];
}
