/* A kernel on the core model: tiles are recorded, and simulated cores take them. */
#ifndef CLI_RUN_CORE_H
#define CLI_RUN_CORE_H

#include "cli/progress.h"
#include "cli/run.h"

/**
 * Simulate all tiles of result->job on result->machine->cores cores; tile i belongs to core i mod cores.
 *
 * Several cores run side by side on options.jobs host threads; of a single one the other threads record the tiles ahead.
 *
 * @param result  its job and options are set, region_cycles and tile_counts made; receives counts, ops, core and cycles
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status run_core(run_result *result, progress *bar, base_error *err);

#endif
