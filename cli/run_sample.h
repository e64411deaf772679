/* Sampled simulation: the `count` model and the caches on all tiles (cli/sample_pass.h), the full core on a few, until the cycles are known well enough. */
#ifndef CLI_RUN_SAMPLE_H
#define CLI_RUN_SAMPLE_H

#include "cli/progress.h"
#include "cli/run.h"

/* How units are taken; docs/machine-model.md says what for. */
enum {
    RUN_SAMPLE_PIECE = 1024, /* events of a tile behind a unit that a thread is given at once */
    RUN_SAMPLE_FIRST = 4,    /* rounds before the interval is looked at, */
    RUN_SAMPLE_SHARE = 64,   /* or more: a unit of so many of the largest stratum */
    RUN_SAMPLE_ROUNDS = 64   /* at most */
};

/**
 * Estimate the cycles of the run, for run_kernel: result->options.error is above 0. Counters, ops and tile_counts are
 * those of all tiles, exact; cycles and the stats of the core are estimates, result->estimate says how good.
 *
 * @param enough  out: false if as many units as cost less than all tiles, or RUN_SAMPLE_ROUNDS of them, are not enough: all tiles are cheaper then, and
 *                counters and ops are to be found anew
 *
 * Errors: BASE_ERR_NOMEM, BASE_ERR_USAGE if the machine has several cores.
 */
base_status run_sample(run_result *result, progress *bar, bool *enough, base_error *err);

#endif
