/* A replay for other programs to look at: each event with the cycle in which the model issued it. */
#ifndef CLI_REPLAY_EXPORT_H
#define CLI_REPLAY_EXPORT_H

#include "cli/identity.h"
#include "traces/export.h"
#include "traces/reader.h"

typedef struct replay_export_options {
    trace_export_kind kind;
    run_model model;     /* RUN_ISSUE or RUN_CORE */
    uint32_t first, last; /* tiles to export, first <= last, which the trace has */
} replay_export_options;

/**
 * Export some tiles of a trace. Under RUN_ISSUE no others are timed, and the first begins in cycle 1; under RUN_CORE all are,
 * for what a tile takes depends on the others, and cycles are those of the whole run.
 *
 * Errors: those of the trace's tiles; BASE_ERR_NOMEM. Those of `out` are the caller's to find.
 */
base_status replay_export(const trace_reader *trace, const identity *id, const sim_machine *machine, const replay_export_options *options,
                          FILE *out, base_error *err);

#endif
