/* What the suites of the MLRTA paper share: its two algorithms as kernels, and their counts. */
#ifndef CLI_SUITES_MLRTA_RUNS_H
#define CLI_SUITES_MLRTA_RUNS_H

#include "cli/suite.h"
#include "reports/views/mlrta_counts.h"

/** The built-in scenes that stand in for the paper's, for suite_info.scenes: all, and those whose trees are built in seconds. */
extern const char *const mlrta_suite_scenes[], *const mlrta_small_scenes[];

/** Kernels for primary rays, and for shadow rays besides: by algorithm. */
extern const char *const mlrta_primary_kernels[MLRTA_ALGORITHMS], *const mlrta_shadow_kernels[MLRTA_ALGORITHMS];

/** Packets of 4x4 pixels that cover the picture. */
double mlrta_packets(const suite *s);

/** What a run has counted. */
mlrta_counts mlrta_counts_of(const run_result *result);

/** Run a kernel with its default parameters, and take its counts. */
base_status mlrta_count_kernel(const suite *s, const scene *input, const char *kernel, mlrta_counts *out, base_error *err);

/** Add the tables of a suite that reproduces Table 2 or 3 with these kernels, a row a scene. */
base_status mlrta_add_tables(suite *s, unsigned number, const char *const kernels[MLRTA_ALGORITHMS], const mlrta_row *rows, base_error *err);

#endif
