/* What kernels did under trial: counts and worst errors, of any number of rays. */
#ifndef CLI_SUITES_STABILITY_TALLY_H
#define CLI_SUITES_STABILITY_TALLY_H

#include <stdint.h>

#include "cli/run.h"
#include "exact/trial.h"
#include "reports/table.h"

typedef struct stability_tally {
    uint64_t tries, hits; /* rays, and those that hit something, exactly */
    uint64_t at_edge;     /* rays within rounding of a border */
    uint64_t verdicts[TRIAL_VERDICTS];
    uint64_t leaks;
    double t_ulp, plane_ulp, point_ulp; /* worst */
    uint64_t first_bad; /* number of the first scene with a hit lost or wrong; UINT64_MAX: none */
} stability_tally;

/** Nothing tried. */
stability_tally stability_tally_none(void);

/** Count one ray of scene `number`. */
void stability_tally_ray(stability_tally *tally, const trial_ray *ray, const trial_finding *finding, uint64_t number);

/** The same of a shadow ray: hits are rays that a triangle blocks within the span. */
void stability_tally_shadow(stability_tally *tally, const trial_ray *ray, trial_span span, const trial_finding *finding, uint64_t number);

/** Add what another has counted; the order does not matter. */
void stability_tally_add(stability_tally *tally, const stability_tally *other);

/** What a kernel's run says of pixel (x, y). */
trial_answer stability_answer(const run_result *run, unsigned x, unsigned y);

/** Add the `count` columns of a table, then those of a tally. */
void stability_add_columns(report_table *t, const report_column *first, size_t count);

/** Add a tally's cells to the last row. */
void stability_add_tally(report_table *t, const stability_tally *tally);

/** The same two for shadow rays. */
void stability_add_shadow_columns(report_table *t, const report_column *first, size_t count);
void stability_add_shadow_tally(report_table *t, const stability_tally *tally);

#endif
