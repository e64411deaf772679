#include "cli/suites/mlrta_runs.h"

#include <stdio.h>
#include <stdlib.h>

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

static base_status count_kernel(const suite *s, const scene *input, const char *kernel, mlrta_counts *out, base_error *err)
{
    const run_options options = suite_run_options(s, kernel_find(kernel), RUN_NATIVE);
    run_result result = {0};
    base_status status = run_kernel(input, s->options->machine, &options, &result, err);
    if (status == BASE_OK)
        *out = mlrta_counts_of(&result);
    run_result_destroy(&result);
    return status;
}

typedef struct measured {
    const char *const *kernels;
    mlrta_row *rows;
    size_t count;
} measured;

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    mlrta_row *row = &m->rows[m->count++];
    base_status status = BASE_OK;
    *row = (mlrta_row){.scene = on->name, .packets = mlrta_packets(s)};
    for (int a = 0; status == BASE_OK && a < MLRTA_ALGORITHMS; a++)
        status = count_kernel(s, on->scene, m->kernels[a], &row->counts[a], err);
    return status;
}

base_status mlrta_measure_table(suite *s, unsigned number, const char *const kernels[MLRTA_ALGORITHMS], base_error *err)
{
    char caption[200];
    measured m = {.kernels = kernels, .rows = calloc(s->scene_count, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    snprintf(caption, sizeof caption, "%ux%u pixels; no MLRT is kernel %s, MLRT is %s, both with their default parameters.", s->width,
             s->height, kernels[MLRTA_WITHOUT], kernels[MLRTA_WITH]);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    report_page_add_heading(s->page, 1, "Tables");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_counts_table(number, m.rows, m.count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-units", mlrta_counts_units(m.rows, m.count, caption), err);
    free(m.rows);
    return status;
}
