/* The count model: every op costs its class's throughput, and nothing ever waits. */
#ifndef SIM_COUNT_H
#define SIM_COUNT_H

#include <stdint.h>

#include "lrbni/event.h"
#include "lrbni/op_table.h"
#include "sim/machine.h"

/* What an event stream holds, as lrb_ctx counts it at LRB_COUNT. Plain sums. */
typedef struct sim_op_counts {
    uint64_t ops[LRB_OP_COUNT]; /* markers too */
    uint64_t memory_operands;   /* ops whose last source was in memory; loads and stores apart */
    uint64_t idle_lanes;        /* lanes switched off by masks, summed over vector ops */
} sim_op_counts;

/** Count the next events. Has the signature of lrb_event_sink; `counts` is a sim_op_counts. Ids must be those of ops. */
void sim_count_events(void *counts, const lrb_event *events, uint32_t count);

/** Cycles of a histogram of ops (LRB_OP_COUNT entries), in half cycles: the sum of count times throughput. */
uint64_t sim_count_half_cycles(const sim_machine *machine, const uint64_t *ops);

#endif
