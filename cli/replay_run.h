/* Times a trace on several machines in one pass: each tile is decoded once, for all of them. */
#ifndef CLI_REPLAY_RUN_H
#define CLI_REPLAY_RUN_H

#include "cli/identity.h"
#include "cli/run.h"
#include "traces/reader.h"

typedef struct replay_options {
    run_model model; /* not RUN_NATIVE */
    unsigned jobs;
    bool progress; /* a bar on stderr */
} replay_options;

/**
 * Time all tiles on all machines.
 *
 * @param id        what the trace says was run; must outlive the results
 * @param machines  `count` of them, owned by the caller; must outlive the results
 * @param results   out, by machine: what a run there gives, but for what only a run has; run_result_destroy them, also after
 *                  a failure
 *
 * Errors: those of the trace's tiles, the first tile's first; BASE_ERR_NOMEM.
 */
base_status replay_run(const trace_reader *trace, const identity *id, sim_machine *const *machines, size_t count,
                       const replay_options *options, run_result *results, base_error *err);

#endif
