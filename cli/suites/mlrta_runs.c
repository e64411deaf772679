#include "cli/suites/mlrta_runs.h"

#include <stdio.h>

const char *const mlrta_suite_scenes[] = {"builtin:rooms-804", "builtin:conference-282k", "builtin:tower-2195k", "builtin:dragon-7m", NULL};
const char *const mlrta_small_scenes[] = {"builtin:rooms-804", "builtin:conference-282k", NULL};
const char *const mlrta_primary_kernels[MLRTA_ALGORITHMS] = {"kd16-primary", "mlrta-primary"};
const char *const mlrta_shadow_kernels[MLRTA_ALGORITHMS] = {"kd16-shadow", "mlrta-shadow"};

double mlrta_packets(const suite *s) { return (double)((s->width + 3) / 4) * ((s->height + 3) / 4); }

mlrta_counts mlrta_counts_of(const run_result *result)
{
    const uint64_t *n = result->counts.n;
    return (mlrta_counts){
        .cells = (double)n[KERNEL_traversed_cells],
        .inner = (double)n[KERNEL_traversed_inner],
        .ep_cells = (double)n[KERNEL_ep_cells],
        .ep_inner = (double)n[KERNEL_ep_inner],
        .tests = (double)n[KERNEL_isect_tests],
        .nearer = (double)n[KERNEL_isect_hits],
        .mailbox = (double)n[KERNEL_mailbox_hits],
        .tiles = (double)n[KERNEL_units_tiles],
        .empty_tiles = (double)n[KERNEL_units_empty_tiles],
        .divergent_tiles = (double)n[KERNEL_units_divergent_tiles],
        .divergent_packets = (double)n[KERNEL_units_divergent],
        .end_tests = (double)n[KERNEL_end_tests],
        .ends = (double)n[KERNEL_end_hits],
    };
}

base_status mlrta_count_kernel(const suite *s, const scene *input, const char *kernel, mlrta_counts *out, base_error *err)
{
    const run_options options = suite_run_options(s, kernel_find(kernel), RUN_NATIVE);
    run_result result = {0};
    base_status status = run_kernel(input, s->options->machine, &options, &result, err);
    if (status == BASE_OK)
        *out = mlrta_counts_of(&result);
    run_result_destroy(&result);
    return status;
}

base_status mlrta_add_tables(suite *s, unsigned number, const char *const kernels[MLRTA_ALGORITHMS], const mlrta_row *rows, base_error *err)
{
    char caption[200];
    snprintf(caption, sizeof caption, "%ux%u pixels; no MLRT is kernel %s, MLRT is %s, both with their default parameters.", s->width,
             s->height, kernels[MLRTA_WITHOUT], kernels[MLRTA_WITH]);
    report_page_add_heading(s->page, 1, "Tables");
    base_status status = suite_add_table(s, "", mlrta_counts_table(number, rows, s->scene_count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-units", mlrta_counts_units(rows, s->scene_count, caption), err);
    return status;
}
