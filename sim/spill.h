/* The events of a tile with its spills among them, as if the kernel had been built for the registers that the machine has.
 *
 * A vector is stored to scratch memory by store_ps and comes back by load_ps; a mask takes a move to a general register or from
 * one as well. Each is as any other op: it takes its slot, its line comes through the caches, and who reads a value that came back
 * waits for the load.
 */
#ifndef SIM_SPILL_H
#define SIM_SPILL_H

#include <stddef.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "sim/registers.h"

/* Values that can be in memory at once, of each file. They lie at the end of the thread's scratch memory. */
enum { SIM_SPILL_SLOTS = 256 };

/**
 * Put spills among the events of a tile.
 *
 * @param spills     of this tile (sim_registers_spills); at least one
 * @param out        receives the events, to be freed by the caller; NULL on failure. Distances are those of the new stream; markers
 *                   that tell distances beyond an event's (LRB_OP_far) are left out
 *
 * Errors: BASE_ERR_USAGE if more than SIM_SPILL_SLOTS values of a file are in memory at once; BASE_ERR_NOMEM.
 */
base_status sim_spill_events(const lrb_event *events, size_t count, const sim_spill *spills, size_t spill_count, lrb_event **out,
                             size_t *out_count, base_error *err);

#endif
