/* Suite mft-quality: Figure 5 of Benthin and Wald 2009, interleaved samples and a filter against many samples; speed against error. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"
#include "reports/views/mft_quality.h"

enum { REFERENCE_SAMPLES = 4096, PICTURES = 4 };

/* The pictures of a scene: what they show, and the rest of their files' names. */
static const struct {
    unsigned samples;
    bool interleaved, filtered;
    const char *rest, *caption;
} pictures[PICTURES] = {
    {256, false, false, "-256-samples.png", "256 samples"},
    {16, false, false, "-16-samples.png", "16 samples, the same for all pixels"},
    {16, true, false, "-16-interleaved.png", "16 samples, interleaved"},
    {16, true, true, "-16-interleaved-filtered.png", "16 samples, interleaved and filtered"},
};

typedef struct measured {
    mft_quality_row *rows;
    size_t count;
    char (*paths)[PICTURES][SUITE_PATH_BYTES]; /* by scene */
    size_t scenes;
} measured;

/* What the ways of a scene are judged by. */
typedef struct judge {
    float *reference;              /* visibility by pixel, of very many samples */
    float *seen[MFT_QUALITY_WAYS]; /* of each way */
    unsigned char *mask;           /* pixels with a hit */
} judge;

static base_status measure_reference(const suite *s, const suite_scene *on, judge *j, base_error *err)
{
    run_result result = {0};
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    const size_t pixels = (size_t)s->width * s->height;
    options.model = RUN_NATIVE;
    options.error = 0;
    options.params.samples = REFERENCE_SAMPLES;
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    j->mask = calloc(pixels, 1);
    if (status == BASE_OK && !j->mask)
        status = base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    for (size_t i = 0; status == BASE_OK && i < pixels; i++) {
        const job_pixel p = kernel_job_pixel(result.job, (unsigned)(i % s->width), (unsigned)(i / s->width));
        j->mask[i] = result.job->frame_host[p.tile].id[p.block][p.pixel] != JOB_NO_HIT;
    }
    if (status == BASE_OK)
        status = (j->reference = picture_visibility(&result, false, err)) ? BASE_OK : BASE_ERR_NOMEM;
    run_result_destroy(&result);
    return status;
}

static base_status write_pictures(const suite *s, const suite_scene *on, measured *m, const run_result *r, const mft_quality_row *row,
                                  const float *seen, base_error *err)
{
    base_status status = BASE_OK;
    for (int i = 0; status == BASE_OK && i < PICTURES; i++) {
        report_image image = {0};
        if (pictures[i].samples != row->samples || pictures[i].interleaved != row->interleaved || pictures[i].filtered != row->filtered)
            continue;
        suite_path(s, m->paths[m->scenes][i], on->stem, pictures[i].rest);
        status = suite_write_picture(m->paths[m->scenes][i], picture_lit(r, seen, &image, err), &image, err);
    }
    return status;
}

/* One run makes two rows: as it was traced, and filtered. */
static base_status measure_way(const suite *s, const suite_scene *on, measured *m, unsigned samples, bool interleaved, judge *j, base_error *err)
{
    run_result result = {0};
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    options.params.samples = samples;
    options.params.interleaved = interleaved;
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    for (int filtered = 0; status == BASE_OK && filtered < 2; filtered++) {
        mft_quality_row *row = &m->rows[m->count];
        float *seen = picture_visibility(&result, filtered, err);
        *row = (mft_quality_row){.scene = on->name, .samples = samples, .interleaved = interleaved, .filtered = filtered,
                                 .rays = (double)result.counts.n[KERNEL_rays_shadow], .cycles = (double)result.cycles,
                                 .cycles_per_pixel = (double)result.cycles / ((double)s->width * s->height)};
        j->seen[m->count++ % MFT_QUALITY_WAYS] = seen;
        status = seen ? BASE_OK : BASE_ERR_NOMEM;
        if (status == BASE_OK && !s->options->no_pictures)
            status = write_pictures(s, on, m, &result, row, seen, err);
    }
    run_result_destroy(&result);
    return status;
}

static void judge_rows(const suite *s, mft_quality_row *rows, const judge *j)
{
    const size_t pixels = (size_t)s->width * s->height;
    const float *full = j->seen[MFT_QUALITY_FULL];
    for (size_t i = 0; i < MFT_QUALITY_WAYS; i++) {
        mft_errors_of(j->seen[i], j->reference, j->mask, pixels, rows[i].error);
        mft_errors_of(j->seen[i], full, j->mask, pixels, rows[i].figure5);
    }
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    judge j = {0};
    mft_quality_row *rows = m->rows + m->count;
    base_status status = measure_reference(s, on, &j, err);
    for (int i = 0; status == BASE_OK && i < MFT_QUALITY_SAMPLES; i++)
        for (int interleaved = 0; status == BASE_OK && interleaved < (i < MFT_QUALITY_SAMPLES - 1 ? 2 : 1); interleaved++)
            status = measure_way(s, on, m, mft_quality_samples[i], interleaved, &j, err);
    if (status == BASE_OK)
        judge_rows(s, rows, &j);
    for (size_t i = 0; i < MFT_QUALITY_WAYS; i++)
        free(j.seen[i]);
    free(j.reference);
    free(j.mask);
    m->scenes++;
    return status;
}

static base_status add_plots(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Speed against error");
    for (size_t i = 0; status == BASE_OK && i < m->scenes; i++) {
        mft_quality_points points;
        char suffix[40];
        mft_quality_points_of(m->rows + i * MFT_QUALITY_WAYS, &points);
        snprintf(suffix, sizeof suffix, "-%zu", i + 1);
        const report_plot plot = {points.title, {"cycles per pixel, without the filter", true}, {"RMSE of the visibility inside penumbrae", true},
                                  points.series, 4};
        status = suite_add_plot(s, suffix, &plot, "The numbers are samples. The lower left is where one wants to be.", err);
    }
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    for (size_t i = 0; status == BASE_OK && i < m->scenes; i++) {
        report_figure figures[PICTURES];
        for (int p = 0; p < PICTURES; p++)
            figures[p] = (report_figure){m->paths[i][p], "rendered picture with soft shadows", pictures[p].caption};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, PICTURES, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; kernel %s, back faces culled.", s->width, s->height,
             s->options->machine->name, s->options->machine->threads, mft_kernel(MFT_S_FRUSTA));
    base_status status = suite_add_table(s, "-figure5", mft_quality_figure5(m->rows, m->count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, m, err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_plots(s, m, err);
    report_page_add_heading(s->page, 1, "All ways");
    return status == BASE_OK ? suite_add_table(s, "", mft_quality_errors(m->rows, m->count, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_QUALITY_WAYS, sizeof *m.rows), .paths = calloc(s->scene_count, sizeof *m.paths)};
    base_status status = m.rows && m.paths ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.paths);
    return status;
}

static const char *const scenes[] = {"builtin:creature-69k", "builtin:hall-60k", NULL};

const suite_info suite_mft_quality = {
    .name = "mft-quality",
    .summary = "error of soft shadows against cycles, by samples, interleaving and filter (Benthin and Wald 2009, Figure 5)",
    .title = "MFT: speed against error",
    .about = "Figure 5 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): 16 samples of the light, "
             "interleaved between neighbouring pixels and filtered, against 256; and the error of the visibility against 4096 samples beside "
             "simulated cycles, for 4, 16, 64 and 256 samples, with and without interleaving and filter.",
    .scenes = scenes,
    .size = 128,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
