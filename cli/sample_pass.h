/* The pass over all tiles that a sampled run begins with: `count`, and what the caches hold, of every tile. */
#ifndef CLI_SAMPLE_PASS_H
#define CLI_SAMPLE_PASS_H

#include "cli/progress.h"
#include "cli/run.h"
#include "sim/sample.h"
#include "sim/warm.h"

/* How tiles are cut into units; docs/machine-model.md says what for. */
enum {
    SAMPLE_PASS_UNIT = 8,     /* tiles of a unit, one after the other; more where there would be more units than: */
    SAMPLE_PASS_UNITS = 1024, /* of each the caches are kept, in at most so many bytes: */
    SAMPLE_PASS_BYTES = 128 << 20
};

typedef struct sample_pass {
    size_t tiles, unit_tiles, units;
    unsigned warmup;        /* tiles before a unit of which the ends are simulated: one a hardware thread */
    sim_variates *of;       /* of each unit: cycles in `count`, tiles, lines that came to the first level, lines from memory */
    sim_contents *contents; /* of the caches before the first tile of a unit's warm-up */
} sample_pass;

/** How the tiles of a job are cut; the rest of *out is empty. */
sample_pass sample_pass_plan(const run_result *result);

/**
 * Trace all tiles, in their order, on one host thread: results go from each to the next one's caches. Counters, ops and region_cycles of
 * the result are those of `count` then, tile_counts too if they are there.
 *
 * @param pass  planned; destroy with sample_pass_destroy, also after a failure
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sample_pass_run(sample_pass *pass, run_result *result, progress *bar, base_error *err);

/** Free what a pass owns. */
void sample_pass_destroy(sample_pass *pass);

/** Cycles in `count` of a tile that was traced. */
static inline double sample_pass_tile_cycles(const run_result *result, size_t tile)
{
    return result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS];
}

/** First tile of a unit. */
static inline size_t sample_pass_first(const sample_pass *pass, size_t unit) { return unit * pass->unit_tiles; }

/** First tile of a unit's warm-up. */
static inline size_t sample_pass_begin(const sample_pass *pass, size_t unit)
{
    const size_t first = sample_pass_first(pass, unit);
    return first > pass->warmup ? first - pass->warmup : 0;
}

#endif
