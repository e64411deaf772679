/* Accuracy against distance from the origin, against size, and against the shape of triangles: tables and plots. */
#ifndef CLI_SUITES_STABILITY_CURVES_H
#define CLI_SUITES_STABILITY_CURVES_H

#include "cli/suite.h"
#include "cli/suites/stability_trial.h"

/** Measure all curves and add them to the report. Errors: those of stability_try, suite_add_table and suite_add_plot. */
base_status stability_add_curves(suite *s, const stability_kernels *kernels, base_error *err);

#endif
