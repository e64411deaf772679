/* A run's cycles by line in the format of valgrind's callgrind, which KCachegrind and callgrind_annotate read.
 *
 * https://valgrind.org/docs/manual/cl-format.html (key VG-CL). There are costs of lines and functions, no calls: the kernel's
 * functions are inlined into one another, and the stream of events does not say through which.
 */
#ifndef CLI_CALLGRIND_H
#define CLI_CALLGRIND_H

#include <stdio.h>

#include "cli/run.h"

/**
 * @param result  of a run with options.profile
 *
 * Errors: BASE_ERR_NOMEM. Whether the stream took the bytes is for its owner to check.
 */
base_status callgrind_write(const run_result *result, FILE *out, base_error *err);

#endif
