/* The hard cases, tried: tables by case and by place. */
#ifndef CLI_SUITES_STABILITY_HARD_H
#define CLI_SUITES_STABILITY_HARD_H

#include "cli/suite.h"
#include "cli/suites/stability_trial.h"

/**
 * Try all cases at all places and add both tables to the report.
 *
 * @param frames  of the STABILITY_FRAMES, how many: a divisor of them
 *
 * Errors: those of stability_try and suite_add_table.
 */
base_status stability_add_hard_cases(suite *s, const stability_kernels *kernels, unsigned frames, base_error *err);

#endif
