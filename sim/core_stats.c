#include "sim/core_state.h"

/* Ops of one form in a phase. */
static void add_ops(sim_core_stats *to, unsigned phase, unsigned op, const sim_op_price *p, uint64_t count)
{
    to->ops[op & LRB_EVENT_ID] += count;
    to->phase_vector_ops[phase] += p->lanes ? count : 0;
    to->memory_operands += op & LRB_FORM_MEMORY ? count : 0;
    to->memory.l1_accesses += p->flags & (SIM_PRICE_READS | SIM_PRICE_STORE) ? count : 0;
}

static void collect_ops(const sim_core *s, sim_core_stats *to)
{
    for (unsigned phase = 0; phase < SIM_MAX_PHASES; phase++)
        for (unsigned form = 0; form < CORE_FORMS; form += LRB_EVENT_ID + 1)
            for (unsigned op = form; op < form + LRB_OP_COUNT; op++)
                add_ops(to, phase, op, &s->price[op], s->forms[phase * CORE_FORMS + op]);
    to->memory.l1_accesses -= s->idle_accesses;
}

/* Ops that did not join issued first in their cycle. */
static void collect_issues(const sim_core *s, sim_core_stats *to)
{
    uint64_t issues = 0, joins_sum = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++) {
        uint64_t first = lrb_op_table[id].shape == LRB_SHAPE_MARK ? 0 : to->ops[id] - s->joins[id];
        to->op_cycles[id] = first + s->op_waited[id];
        to->op_issues[id] = first;
        to->issued_by_class[lrb_op_table[id].class_id] += first;
        issues += first;
        joins_sum += s->joins[id];
    }
    to->core.issued_pair = to->threads.issued_pair = joins_sum;
    to->core.issued_one = to->threads.issued_one = issues - joins_sum;
}

/* The gaps of a thread lie between its issues; what of all cycles is in no other bucket was the core's gaps, and the
   turns of other threads. */
uint64_t sim_core_cycle(const sim_core *s)
{
    return s->now;
}

sim_core_stats sim_core_get(const sim_core *s)
{
    sim_core_stats stats = s->stats;
    stats.memory = s->memory->counts;
    collect_ops(s, &stats);
    collect_issues(s, &stats);
    sim_cycles_of_buckets(s->core_waited, &stats.core);
    sim_cycles_of_buckets(s->thread_waited, &stats.threads);
    stats.threads.gap = (stats.core.issued_one + stats.core.issued_pair - s->runs_of_threads) * (s->gap - 1);
    stats.core.gap = stats.cycles - sim_cycles_sum(&stats.core);
    stats.threads.other_thread = stats.cycles * s->threads - sim_cycles_sum(&stats.threads);
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
