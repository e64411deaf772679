/* A second, slow simulator of the core model, to check the fast one: written from docs/machine-model.md alone, one cycle after
 * another, every thread looked at in each. Nothing in it is clever, and it shares no code with the fast one. */
#ifndef TESTS_SIM_SLOW_CORE_H
#define TESTS_SIM_SLOW_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lrbni/event.h"
#include "sim/core.h"
#include "sim/machine.h"

/* A tile, and what came of it. */
typedef struct slow_core_tile {
    const lrb_event *events;
    size_t count;
    uint64_t regions[SIM_MAX_REGIONS + 1]; /* out, as of sim_core_feed's done */
} slow_core_tile;

/**
 * Simulate one core from cold caches on these tiles.
 *
 * @param stats  out
 *
 * Returns false if the host is out of memory.
 */
bool slow_core_run(const sim_machine *machine, slow_core_tile *tiles, size_t tile_count, sim_core_stats *stats);

#endif
