/* Suite mft-table2: Table 2 of Benthin and Wald 2009, ways to shrink the frusta of shadow rays, beside the published rows. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mft_runs.h"
#include "reports/views/mft_table2.h"

typedef struct measured {
    mft_shrink_row *rows; /* by scene, then by way to shrink */
    mft_row *primary;     /* by scene: primary rays alone */
} measured;

static base_status take_primary(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    measured *m = user;
    (void)err;
    m->primary[entry->row] = mft_row_of(result, s->scenes[entry->scene].name, MFT_P_FRUSTA);
    return BASE_OK;
}

/* A frame, less its primary rays. */
static base_status take_frame(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    const mft_row whole = mft_row_of(result, s->scenes[entry->scene].name, MFT_S_FRUSTA);
    mft_shrink_row *row = &m->rows[entry->row];
    (void)err;
    *row = (mft_shrink_row){.scene = whole.scene,
                            .shrink = entry->options.params.shrink,
                            .frame = whole.value[MFT_CYCLES],
                            .half_width = whole.half_width,
                            .additional = (double)result->counts.n[KERNEL_additional_tests],
                            .additional16 = (double)result->counts.n[KERNEL_additional_tests16]};
    for (int metric = 0; metric < MFT_METRICS; metric++)
        row->value[metric] = whole.value[metric] - m->primary[entry->scene].value[metric];
    return BASE_OK;
}

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    suite_runs runs = {0};
    for (size_t n = 0; n < s->scene_count; n++) {
        suite_run_entry entry = {.scene = n, .row = n, .options = mft_run_options(s, MFT_P_FRUSTA), .take = take_primary};
        suite_runs_add(&runs, entry);
        entry.options = mft_run_options(s, MFT_S_FRUSTA);
        entry.take = take_frame;
        for (unsigned shrink = 0; shrink < MFT_SHRINKS; shrink++) {
            entry.row = n * MFT_SHRINKS + shrink;
            entry.options.params.shrink = shrink;
            suite_runs_add(&runs, entry);
        }
    }
    return suite_runs_take(s, &runs, m, err);
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    const size_t count = s->scene_count * MFT_SHRINKS;
    char caption[200];
    const kernel_params *params = &kernel_find(mft_kernel(MFT_S_FRUSTA))->defaults;
    snprintf(caption, sizeof caption,
             "%ux%u pixels, machine %s, core model, %u threads; %u samples of the light, back faces culled, at most %u triangles "
             "a leaf.",
             s->width, s->height, s->options->machine->name, s->options->machine->threads, params->samples, params->max_leaf);
    base_status status = suite_add_table(s, "", mft_table2_counts(m->rows, count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-changes", mft_table2_changes(m->rows, count, caption), err);
    return status == BASE_OK ? suite_add_table(s, "-differences", mft_table2_differences(m->rows, count), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_SHRINKS, sizeof *m.rows), .primary = calloc(s->scene_count, sizeof *m.primary)};
    base_status status = m.rows && m.primary ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.primary);
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
