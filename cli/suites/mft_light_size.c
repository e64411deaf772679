/* Suite mft-light-size: Figure 6 of Benthin and Wald 2009, soft shadows by packets and frusta as the light grows. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mft_runs.h"
#include "reports/views/mft_light_size.h"

static const double scales[] = {0.125, 0.25, 0.5, 1, 2};
enum { SCALES = sizeof scales / sizeof *scales };

typedef struct measured {
    mft_light_row *rows; /* by scene, then by scale */
    size_t count;
} measured;

/* Pixels that see a part of the light, of all. */
static double penumbra_of(const run_result *r)
{
    size_t partly = 0;
    for (unsigned y = 0; y < r->options.height; y++)
        for (unsigned x = 0; x < r->options.width; x++) {
            const job_pixel p = kernel_job_pixel(r->job, x, y);
            const float seen = r->job->shadows_host[p.tile].visibility[p.block][p.pixel];
            partly += r->job->frame_host[p.tile].id[p.block][p.pixel] != JOB_NO_HIT && seen > 0 && seen < 1;
        }
    return (double)partly / ((double)r->options.width * r->options.height);
}

static base_status take_light(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    mft_light_row *row = &m->rows[entry->row];
    const bool packet = entry->options.kernel == kernel_find(mft_kernel(MFT_S_PACKET));
    (void)err;
    *(packet ? &row->packet : &row->frusta) = mft_row_of(result, s->scenes[entry->scene].name, packet ? MFT_S_PACKET : MFT_S_FRUSTA);
    row->scale = entry->options.params.light_scale;
    row->rays = (double)result->counts.n[KERNEL_rays_shadow];
    row->penumbra = penumbra_of(result);
    return BASE_OK;
}

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    static const mft_algorithm dearest_first[] = {MFT_S_PACKET, MFT_S_FRUSTA};
    suite_runs runs = {0};
    for (int a = 0; a < 2; a++)
        for (size_t row = m->count; row-- > 0;) {
            suite_run_entry entry = {.scene = row / SCALES, .row = row, .options = mft_run_options(s, dearest_first[a]), .take = take_light};
            entry.options.params.light_scale = scales[row % SCALES];
            suite_runs_add(&runs, entry);
        }
    return suite_runs_take(s, &runs, m, err);
}

static base_status add_plot(suite *s, const measured *m, base_error *err)
{
    mft_light_series series;
    base_status status = mft_light_series_create(m->rows, m->count, SCALES, &series, err);
    const report_plot plot = {"Packets / frusta by the size of the light", {"light scale", true}, {"packets / frusta", true},
                              series.series, series.count};
    report_page_add_heading(s->page, 1, "Plot");
    if (status == BASE_OK)
        status = suite_add_plot(s, "-reductions", &plot, "Cycles and AABB tests of packets, as multiples of those of frusta.", err);
    mft_light_series_destroy(&series);
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    snprintf(caption, sizeof caption,
             "%ux%u pixels, machine %s, core model, %u threads; %u samples of the light, back faces culled.", s->width, s->height,
             s->options->machine->name, s->options->machine->threads, kernel_find(mft_kernel(MFT_S_FRUSTA))->defaults.samples);
    base_status status = suite_add_table(s, "-reductions", mft_light_size_reductions(m->rows, m->count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_plot(s, m, err);
    report_page_add_heading(s->page, 1, "All runs");
    return status == BASE_OK ? suite_add_table(s, "", mft_light_size_counts(m->rows, m->count, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    const size_t count = s->scene_count * SCALES;
    measured m = {.rows = calloc(count, sizeof *m.rows), .count = count};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    return status;
}

static const char *const scenes[] = {"builtin:creature-69k", "builtin:hall-60k", NULL};

const suite_info suite_mft_light_size = {
    .name = "mft-light-size",
    .summary = "packets against frusta for soft shadows as the light grows, core model (Benthin and Wald 2009, Figure 6)",
    .title = "MFT and the size of the light",
    .about = "Soft shadows by packets of 16 rays and by multi-frusta tracing as the light's edges grow from an eighth of the "
             "scene's to twice, as in Figure 6 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta "
             "Tracing' (2009): the narrower the frusta of a hit point, the fewer boxes and triangles they meet.",
    .scenes = scenes,
    .size = 256,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
