/* The units of a sampled run, and the trace of all tiles that it begins with: `count`, and what the caches hold. */
#ifndef CLI_SAMPLE_PASS_H
#define CLI_SAMPLE_PASS_H

#include "cli/progress.h"
#include "cli/run.h"
#include "sim/sample.h"
#include "sim/warm.h"

/* How tiles are cut into units; docs/machine-model.md says what for. */
enum {
    SAMPLE_PASS_UNIT = 8,     /* tiles of a unit, one after the other; more where there would be more units than: */
    SAMPLE_PASS_UNITS = 1024, /* of each the caches are kept, in about so many bytes at most: */
    SAMPLE_PASS_BYTES = 128 << 20
};

/* A tile that a hardware thread is in when a unit begins. */
typedef struct sample_begun {
    size_t tile; /* SIZE_MAX: none, it takes the next one */
    double done; /* which part of it */
} sample_begun;

/* Tiles of one pass of the kernel, one after the other. */
typedef struct sample_unit {
    size_t first, end; /* its tiles */
    size_t begin;      /* the caches are those before this tile, at or before the first */
    size_t limit;      /* end of the pass of the kernel that it is in */
    bool edge;         /* it is the first or the last of that pass */
    sim_variates of;   /* cycles in `count`, tiles, those of a second pass among them, lines that came to the first level, lines from memory */
    sim_contents contents; /* of the caches */
    sample_begun *begun;   /* by hardware thread; part of sample_pass.begun */
} sample_unit;

typedef struct sample_pass {
    size_t tiles, unit_count;
    sample_unit *units; /* in the order of their tiles */
    sample_begun *begun;
} sample_pass;

/** Tiles of a unit of this run. */
size_t sample_pass_unit_tiles(const run_result *result);

/**
 * Trace all tiles, in their order, on one host thread: what each accesses is in the next one's caches. Counters, ops and region_cycles of
 * the result are those of `count` then, tile_counts too if they are there.
 *
 * @param pass  destroy with sample_pass_destroy, also after a failure
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sample_pass_run(run_result *result, progress *bar, sample_pass *pass, base_error *err);

/** Free what a pass owns. */
void sample_pass_destroy(sample_pass *pass);

/** Cycles in `count` of a tile that was traced. */
static inline double sample_pass_tile_cycles(const run_result *result, size_t tile)
{
    return result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS];
}

#endif
