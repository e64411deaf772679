/* Tiles recorded for simulated cores: a host thread runs the kernel at LRB_RECORD and keeps the tile's events. */
#ifndef CLI_RECORDER_H
#define CLI_RECORDER_H

#include <stdbool.h>
#include <stddef.h>

#include "kernels/kernel.h"
#include "sim/bounds.h"

/* The events of a tile; the buffer is used again for the next one. */
typedef struct recording {
    lrb_event *events; /* owned */
    size_t count, capacity;
    bool failed; /* out of memory */
} recording;

/** Free what a recording owns. */
void recording_free(recording *r);

/* What one host thread records with. */
typedef struct recorder {
    const kernel_info *kernel;
    const kernel_job *job;
    lrb_ctx *ctx;
    kernel_counts counts; /* of all tiles so far */
    kernel_counts *tile_counts; /* by tile, or NULL; not owned */
    sim_chain_meter *meter;
    sim_chains chains;    /* of all tiles so far */
    recording *into;
} recorder;

/** Errors: BASE_ERR_NOMEM. The recorder must not move until recorder_destroy, which is allowed after a failure. */
base_status recorder_create(const kernel_info *kernel, const kernel_job *job, const sim_machine *machine, kernel_counts *tile_counts,
                            recorder *out, base_error *err);

/** Free what a recorder owns. */
void recorder_destroy(recorder *r);

/** Trace a tile into a recording. Errors: BASE_ERR_NOMEM. */
base_status recorder_tile(recorder *r, size_t tile, recording *into, base_error *err);

#endif
