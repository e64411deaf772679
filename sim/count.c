#include "sim/count.h"

uint64_t sim_count_half_cycles(const sim_machine *machine, const uint64_t *ops)
{
    uint64_t halves = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++)
        halves += ops[id] * machine->cost[lrb_op_table[id].class_id].throughput;
    return halves;
}

void sim_count_events(void *counts, const lrb_event *events, uint32_t count)
{
    sim_op_counts *c = counts;
    for (const lrb_event *e = events; e < events + count; e++) {
        lrb_op_id id = (lrb_op_id)(e->op & LRB_EVENT_ID);
        c->ops[id]++;
        c->memory_operands += e->op & LRB_FORM_MEMORY ? 1 : 0;
        if (e->mask != 0xffff && lrb_op_kind_of(id) == LRB_KIND_VECTOR)
            c->idle_lanes += 16u - (unsigned)__builtin_popcount(e->mask);
    }
}
