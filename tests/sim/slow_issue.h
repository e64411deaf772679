/* A second, slow simulator of the issue model, to check the fast one: written from sim/issue.h's comment and
 * docs/machine-model.md alone, one cycle after another, with the whole tile in arrays. Nothing in it is clever. */
#ifndef TESTS_SIM_SLOW_ISSUE_H
#define TESTS_SIM_SLOW_ISSUE_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/event.h"
#include "sim/issue.h"
#include "sim/machine.h"

/**
 * Time one tile from an empty pipeline.
 *
 * @param events   the whole tile; op ids below LRB_OP_COUNT
 * @param stats    in and out: the tile's numbers are added
 * @param regions  out, as of sim_issue_end
 *
 * Returns false if the host is out of memory; then nothing is written.
 */
bool slow_issue_tile(const sim_machine *machine, const lrb_event *events, uint32_t count, sim_issue_stats *stats,
                     uint64_t regions[SIM_MAX_REGIONS + 1]);

#endif
