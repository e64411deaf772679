#include "sim/count.h"

uint64_t sim_count_half_cycles(const sim_machine *machine, const uint64_t *ops)
{
    uint64_t halves = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++)
        halves += ops[id] * machine->cost[lrb_op_table[id].class_id].throughput;
    return halves;
}
