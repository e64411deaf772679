/* Tiles for simulated cores: a host thread runs the kernel at LRB_RECORD and keeps the tile's events, or reads them from a trace. */
#ifndef CLI_RECORDER_H
#define CLI_RECORDER_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/run_trace.h"
#include "cli/tile_exchange.h"
#include "kernels/kernel.h"
#include "sim/bounds.h"
#include "sim/registers.h"
#include "sim/observer.h"
#include "traces/reader.h"

/* The events of a tile; the buffer is used again for the next one. */
typedef struct recording {
    lrb_event *events; /* owned */
    size_t count, capacity;
    bool failed; /* out of memory */
} recording;

/** Free what a recording owns. */
void recording_free(recording *r);

/* Someone who looks on while a core simulates tiles. */
typedef struct core_watch {
    void (*begin_tile)(void *user, unsigned thread, size_t tile);
    void (*end_tile)(void *user, unsigned thread);
    sim_observer *observer;
    void *user; /* of all three */
} core_watch;

/* Where tiles come from, and what becomes of them besides. */
typedef struct recorder_input {
    size_t first_pass, tiles;  /* tiles beyond the first pass begin when all of that are done */
    const kernel_info *kernel; /* of a run, which also has a job */
    const kernel_job *job;
    kernel_counts *tile_counts; /* out: by tile, or NULL */
    run_trace *trace;           /* takes what the kernel records; it, or its writer, may be NULL */
    const trace_reader *replayed; /* of a replay: the trace; none of the above then */
    tile_exchange *exchange;      /* of a replay on several machines: the others that read the trace, or NULL */
    unsigned member;              /* number among them */
    const core_watch *watch;      /* or NULL; of a single core */
    bool sampled; /* of some tiles only: chains are not measured */
    bool annotated, registers;    /* of a run: take the annotated kernel; analyse what registers its tiles need */
} recorder_input;

/* What one host thread records with. */
typedef struct recorder {
    const recorder_input *input;
    unsigned worker; /* number of the host thread */
    lrb_ctx *ctx;    /* of a run */
    trace_source *source; /* of a replay */
    kernel_counts counts; /* of all tiles so far */
    sim_chain_meter *meter; /* or NULL */
    sim_chains chains;    /* of all tiles so far */
    sim_registers *registers; /* or NULL */
    recording *into;
} recorder;

/**
 * @param input, machine  not owned; must outlive the recorder
 *
 * Errors: BASE_ERR_NOMEM. The recorder must not move until recorder_destroy, which is allowed after a failure.
 */
base_status recorder_create(const recorder_input *input, const sim_machine *machine, unsigned worker, recorder *out, base_error *err);

/** Free what a recorder owns. */
void recorder_destroy(recorder *r);

/** Trace a tile into a recording, or read it. Errors: BASE_ERR_NOMEM; those of trace_source_seek and trace_source_read. */
base_status recorder_tile(recorder *r, size_t tile, recording *into, base_error *err);

#endif
