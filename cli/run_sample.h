/* Sampled simulation: the `count` model on all tiles, the full core on a few, until the cycles are known well enough. */
#ifndef CLI_RUN_SAMPLE_H
#define CLI_RUN_SAMPLE_H

#include "cli/run.h"

/* How the tiles are cut; docs/machine-model.md says what for. */
enum {
    RUN_SAMPLE_UNIT = 8,    /* tiles of a unit, one after the other */
    RUN_SAMPLE_WARMUP = 16, /* tiles before it that fill the caches and the threads */
    RUN_SAMPLE_FIRST = 3   /* rounds before the interval is looked at */
};

/**
 * Estimate the cycles of the run, for run_kernel: result->options.error is above 0. Counters, ops and tile_counts are
 * those of all tiles, exact; cycles and the stats of the core are estimates, result->estimate says how good.
 *
 * The `count` model has run over all tiles: its cycles are in region_cycles.
 *
 * @param enough  out: false if half the units were drawn and the interval is still too wide: all tiles are cheaper then, and
 *                the result is as it was
 *
 * Errors: BASE_ERR_NOMEM, BASE_ERR_USAGE if the machine has several cores.
 */
base_status run_sample(run_result *result, bool *enough, base_error *err);

#endif
