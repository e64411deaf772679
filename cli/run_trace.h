/* The trace that a run records, if it was asked to: a file, and an encoder for each host thread. */
#ifndef CLI_RUN_TRACE_H
#define CLI_RUN_TRACE_H

#include "cli/run.h"
#include "traces/encoder.h"
#include "traces/writer.h"

/* What a host thread encodes with. */
typedef struct run_trace_worker {
    trace_encoder *encoder;
    base_error err; /* of the first tile that failed */
} run_trace_worker;

typedef struct run_trace {
    trace_writer *writer; /* NULL: nothing is recorded */
    run_trace_worker *workers;
    unsigned jobs;
} run_trace;

/**
 * Begin the file that result->options.trace names; without a name, no recording.
 *
 * @param result  its job is there
 * @param out     run_trace_destroy it, also after a failure
 *
 * Errors: those of trace_writer_create; BASE_ERR_NOMEM.
 */
base_status run_trace_begin(const run_result *result, run_trace *out, base_error *err);

/** Around the trace_encoder_events of a tile. Errors wait for the commit. Only if there is a writer. */
void run_trace_begin_tile(run_trace *t, unsigned worker);
void run_trace_end_tile(run_trace *t, unsigned worker, uint32_t tile);

/** Finish the file, if there is one. Errors: the first tile's that failed; those of trace_writer_commit. */
base_status run_trace_commit(run_trace *t, const run_result *result, base_error *err);

void run_trace_destroy(run_trace *t);

#endif
