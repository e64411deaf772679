/* Lower bounds of the cycles of the core model, from the same events: what no number of threads and no schedule can beat.
 *
 * - dependences: the longest chain of results in a tile, every access a hit, any number of ops a cycle;
 * - ports: ops through the pipes, classes through their throughput, threads through their issue gap;
 * - memory: lines through the bandwidth of memory and of the second level.
 * The cycles of a run are never fewer than any of them.
 */
#ifndef SIM_BOUNDS_H
#define SIM_BOUNDS_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "lrbni/op_table.h"
#include "sim/hierarchy.h"
#include "sim/machine.h"

/* Chains of all tiles so far; plain, so that several can be put together. */
typedef struct sim_chains {
    uint64_t sum, longest; /* cycles */
} sim_chains;

typedef struct sim_chain_meter sim_chain_meter;

/** Measures chains on a machine. Errors: BASE_ERR_NOMEM. */
base_status sim_chain_meter_create(const sim_machine *machine, sim_chain_meter **out, base_error *err);

/** Free a meter, which may be NULL, and set the pointer to NULL. */
void sim_chain_meter_destroy(sim_chain_meter **m);

/** Cycles of the longest chain of a tile, which is added to *chains. */
uint64_t sim_chain_meter_tile(sim_chain_meter *m, const lrb_event *events, size_t count, sim_chains *chains);

/** Put the chains of other tiles to these. */
void sim_chains_add(sim_chains *to, const sim_chains *from);

/** Cycles that the tiles of these chains take at least. */
uint64_t sim_bound_dependence(const sim_machine *machine, const sim_chains *chains);

/** Cycles that these ops take at least, LRB_OP_COUNT of them. */
uint64_t sim_bound_ports(const sim_machine *machine, const uint64_t *ops);

/** Cycles that these lines take at least. */
uint64_t sim_bound_memory(const sim_machine *machine, const sim_hierarchy_counts *counts);

#endif
