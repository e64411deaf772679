/* The independent runs of a suite, side by side on its host threads.
 *
 * Runs begin in the order in which they were added: the dearest first, so that no thread is left alone with it. Their results are taken in
 * that order too, one at a time, whatever thread ran them and whichever ended first: so what a suite writes does not depend on --jobs.
 *
 * Each run has a host thread, or several if there are more than runs. So host times in the results say nothing; suites that compare
 * these make their runs one by one.
 */
#ifndef CLI_SUITE_RUNS_H
#define CLI_SUITE_RUNS_H

#include "cli/suite.h"

typedef struct suite_run_entry suite_run_entry;

/** What becomes of a result, which is freed then. May run on any thread, but never beside another one of the list. */
typedef base_status suite_take_fn(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err);

/* A run of the list. */
struct suite_run_entry {
    size_t scene;               /* of suite.scenes, which `take` finds open */
    size_t row;                 /* for `take`: what the result is for */
    const sim_machine *machine; /* NULL: the suite's */
    run_options options;        /* jobs and progress are set by the list */
    suite_take_fn *take;
};

/* A list of runs; begins as zeros. */
typedef struct suite_runs {
    suite_run_entry *entries; /* owned */
    size_t count;
    bool failed; /* out of memory */
} suite_runs;

/** Add a run. If memory is short, suite_runs_take says so. */
void suite_runs_add(suite_runs *runs, suite_run_entry entry);

/**
 * Open the suite's scenes, make all runs and take their results; empties the list.
 *
 * Errors: those of scene_open; BASE_ERR_NOMEM; of the first run in the order of the list that fails, or whose `take` does. No later one is taken.
 */
base_status suite_runs_take(suite *s, suite_runs *runs, void *user, base_error *err);

#endif
