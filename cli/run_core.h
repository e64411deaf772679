/* The core model: tiles are recorded by the kernel or read from a trace, and simulated cores take them. */
#ifndef CLI_RUN_CORE_H
#define CLI_RUN_CORE_H

#include "cli/progress.h"
#include "cli/recorder.h"
#include "cli/run.h"

/**
 * Simulate all tiles of the input on result->machine->cores cores, a pass after the other; tile i of a pass belongs to core i mod cores.
 *
 * Several cores run side by side on options.jobs host threads; of a single one the other threads record the tiles ahead.
 *
 * @param result  its machine and options are set, and region_cycles made or NULL; receives counts, ops, core and cycles
 *
 * Errors: BASE_ERR_NOMEM; those of trace_source_seek and trace_source_read if the input is a trace.
 */
base_status run_core(run_result *result, const recorder_input *input, progress *bar, base_error *err);

#endif
