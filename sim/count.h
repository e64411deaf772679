/* The count model: every op costs its class's throughput, and nothing ever waits. */
#ifndef SIM_COUNT_H
#define SIM_COUNT_H

#include <stdint.h>

#include "lrbni/op_table.h"
#include "sim/machine.h"

/** Cycles of a histogram of ops (LRB_OP_COUNT entries), in half cycles: the sum of count times throughput. */
uint64_t sim_count_half_cycles(const sim_machine *machine, const uint64_t *ops);

#endif
