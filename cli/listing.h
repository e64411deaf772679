/* A run's numbers in the manner of `perf stat`: a count a line, and what it means. */
#ifndef CLI_LISTING_H
#define CLI_LISTING_H

#include <stdio.h>

#include "cli/run.h"

/**
 * @param result  of RUN_ISSUE or RUN_CORE
 *
 * Never fails; has the signature of its like. Whether the stream took the bytes is for its owner to check.
 */
base_status listing_write(const run_result *result, FILE *out, base_error *err);

#endif
