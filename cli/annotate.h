/* The kernel's source with what it cost in the margin. */
#ifndef CLI_ANNOTATE_H
#define CLI_ANNOTATE_H

#include <stdio.h>

#include "cli/run.h"

/**
 * Write a table of the functions, then every source that ops of the run were written in, most cycles first, with cycles, their
 * share of the run, ops, and the largest wait beside each line.
 *
 * @param result  of a run with options.profile
 *
 * Errors: BASE_ERR_NOMEM. Whether the stream took the bytes is for its owner to check.
 */
base_status annotate_write(const run_result *result, FILE *out, base_error *err);

#endif
