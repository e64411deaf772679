/* Sampled simulation: the `count` model and the caches on all tiles, the full core on a few, until the cycles are known well enough. */
#ifndef CLI_RUN_SAMPLE_H
#define CLI_RUN_SAMPLE_H

#include "cli/run.h"

/* How the tiles are cut; docs/machine-model.md says what for. */
enum {
    RUN_SAMPLE_UNIT = 8,    /* tiles of a unit, one after the other */
    RUN_SAMPLE_WARMUP = 4,  /* tiles a hardware thread before it, which bring the threads out of step */
    RUN_SAMPLE_PIECE = 1024, /* events of a tile behind it that a thread is given at once */
    RUN_SAMPLE_FIRST = 3,   /* rounds before the interval is looked at */
    RUN_SAMPLE_ROUNDS = 64 /* at most: the caches are kept for each unit of these */
};

/**
 * Estimate the cycles of the run, for run_kernel: result->options.error is above 0. Counters, ops and tile_counts are
 * those of all tiles, exact; cycles and the stats of the core are estimates, result->estimate says how good.
 *
 * The `count` model has run over all tiles: its cycles are in region_cycles.
 *
 * @param enough  out: false if as many units as cost less than all tiles, or RUN_SAMPLE_ROUNDS of them, are not enough: all tiles are cheaper then, and
 *                the result is as it was
 *
 * Errors: BASE_ERR_NOMEM, BASE_ERR_USAGE if the machine has several cores.
 */
base_status run_sample(run_result *result, bool *enough, base_error *err);

#endif
