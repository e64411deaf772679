/* Suite mft-table2: Table 2 of Benthin and Wald 2009, ways to shrink the frusta of shadow rays, beside the published rows. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mft_runs.h"
#include "reports/views/mft_table2.h"

typedef struct measured {
    mft_shrink_row *rows;
    size_t count;
} measured;

static base_status measure_shrink(const suite *s, const suite_scene *on, size_t shrink, const mft_row *primary,
                                  mft_shrink_row *row, base_error *err)
{
    run_result result = {0};
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    options.params.shrink = (unsigned)shrink;
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    if (status == BASE_OK) {
        const mft_row whole = mft_row_of(&result, on->name, MFT_S_FRUSTA);
        *row = (mft_shrink_row){.scene = on->name,
                                .shrink = shrink,
                                .frame = whole.value[MFT_CYCLES],
                                .half_width = whole.half_width,
                                .additional = (double)result.counts.n[KERNEL_additional_tests],
                                .additional16 = (double)result.counts.n[KERNEL_additional_tests16]};
        for (int m = 0; m < MFT_METRICS; m++)
            row->value[m] = whole.value[m] - primary->value[m];
    }
    run_result_destroy(&result);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    run_result result = {0};
    base_status status = mft_run(s, on->scene, MFT_P_FRUSTA, s->options->machine, &result, err);
    const mft_row primary = status == BASE_OK ? mft_row_of(&result, on->name, MFT_P_FRUSTA) : (mft_row){0};
    run_result_destroy(&result);
    for (size_t shrink = 0; status == BASE_OK && shrink < MFT_SHRINKS; shrink++)
        status = measure_shrink(s, on, shrink, &primary, &m->rows[m->count++], err);
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    const kernel_params *params = &kernel_find(mft_kernel(MFT_S_FRUSTA))->defaults;
    snprintf(caption, sizeof caption,
             "%ux%u pixels, machine %s, core model, %u threads; %u samples of the light, back faces culled, at most %u triangles "
             "a leaf.",
             s->width, s->height, s->options->machine->name, s->options->machine->threads, params->samples, params->max_leaf);
    base_status status = suite_add_table(s, "", mft_table2_counts(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-changes", mft_table2_changes(m->rows, m->count, caption), err);
    return status == BASE_OK ? suite_add_table(s, "-differences", mft_table2_differences(m->rows, m->count), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_SHRINKS, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    return status;
}

static const char *const scenes[] = {"builtin:creature-69k", "builtin:hall-60k", NULL};

const suite_info suite_mft_table2 = {
    .name = "mft-table2",
    .summary = "ways to shrink the frusta of shadow rays, core model (Benthin and Wald 2009, Table 2)",
    .title = "MFT Table 2",
    .about = "Table 2 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): when some "
             "rays of a frustum are blocked, its corner rays shrink to the rays left (CR), or its intervals of directions as "
             "well (FS), or the rays left are tested against the boxes of leaves (Ray-AABB); measured here and as published for "
             "T-Rex.",
    .scenes = scenes,
    .size = 256,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
