/* What the suites of the MFT paper share: its algorithms as kernels, run as the paper ran them, and their rows. */
#ifndef CLI_SUITES_MFT_RUNS_H
#define CLI_SUITES_MFT_RUNS_H

#include "cli/suite_runs.h"
#include "reports/views/mft_table1.h"

/** How many algorithms have a kernel in this program: the first so many of mft_algorithm, packets and frusta in pairs. */
int mft_algorithms_measured(void);

/** Name of an algorithm's kernel. */
const char *mft_kernel(mft_algorithm algorithm);

/** The built-in scenes that stand in for the paper's, for suite_info.scenes. */
extern const char *const mft_suite_scenes[];

/** Options of a kernel's run: the core model, back faces culled, as the paper did (MFT 5). Of a sampled run no filter: a sample
 * knows the cycles of phases too badly to take one off. */
run_options mft_kernel_options(const suite *s, const char *kernel);

/** The same of an algorithm's kernel. */
run_options mft_run_options(const suite *s, mft_algorithm algorithm);

/** Cycles of a run without those of the filter, which the paper reports apart. */
uint64_t mft_cycles(const run_result *result);

/** What a run has found, as a row of the table; `scene_name` must live as long as the row. */
mft_row mft_row_of(const run_result *result, const char *scene_name, mft_algorithm algorithm);

#endif
