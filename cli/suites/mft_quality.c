/* Suite mft-quality: Figure 5 of Benthin and Wald 2009, interleaved samples and a filter against many; speed against error. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"
#include "reports/views/mft_quality.h"

enum { REFERENCE_SAMPLES = 4096, PICTURES = 4 };

/* Pictures of Figure 5 are as large as the suite's, and this many times doubled. */
enum { DOUBLINGS = 2, FIGURE_ROWS = 4 * (DOUBLINGS + 1) };

/* The rest of the pictures' file names, and what they show. */
static const char *const rests[PICTURES] = {"-256-samples.png", "-16-samples.png", "-16-interleaved.png",
                                            "-16-interleaved-filtered.png"};
static const char *const captions[PICTURES] = {"256 samples", "16 samples, the same for all pixels", "16 samples, interleaved",
                                               "16 samples, interleaved and filtered"};

typedef struct measured {
    mft_quality_row *rows;
    size_t count;
    mft_figure5_row *figure_rows;
    size_t figure_count;
    char (*paths)[PICTURES][SUITE_PATH_BYTES]; /* by scene */
    size_t scenes;
} measured;

/* What the ways of a scene are judged by. */
typedef struct judge {
    float *reference;              /* visibility by pixel, of very many samples */
    float *seen[MFT_QUALITY_WAYS]; /* of each way */
    unsigned char *mask;           /* pixels with a hit */
} judge;

/* 256 samples in a picture, which 16 are compared with. */
typedef struct figure {
    float *seen;
    unsigned char *mask;
    double rays;
    bool pictured; /* pictures are written */
} figure;

/* Pixels with a hit; NULL if out of memory. */
static unsigned char *hits_of(const run_result *r, base_error *err)
{
    const unsigned width = r->options.width;
    const size_t pixels = (size_t)width * r->options.height;
    unsigned char *mask = malloc(pixels);
    if (!mask)
        base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for %zu pixels", pixels);
    for (size_t i = 0; mask && i < pixels; i++) {
        const job_pixel p = kernel_job_pixel(r->job, (unsigned)(i % width), (unsigned)(i / width));
        mask[i] = r->job->frame_host[p.tile].id[p.block][p.pixel] != JOB_NO_HIT;
    }
    return mask;
}

static base_status write_picture(const suite *s, const suite_scene *on, measured *m, const run_result *r, int picture,
                                 const float *seen, base_error *err)
{
    report_image image = {0};
    char *path = m->paths[m->scenes][picture];
    suite_path(s, path, on->stem, rests[picture]);
    return suite_write_picture(path, picture_lit(r, seen, &image, err), &image, err);
}

/* Trace a picture whose edges are doubled `doublings` times; no cycles. */
static base_status run_native(const suite *s, const suite_scene *on, unsigned doublings, unsigned samples, bool interleaved,
                              run_result *result, base_error *err)
{
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    options.model = RUN_NATIVE;
    options.error = 0;
    options.width <<= doublings;
    options.height <<= doublings;
    options.params.samples = samples;
    options.params.filter = 1;
    options.params.interleaved = interleaved;
    return run_kernel(on->scene, s->options->machine, &options, result, err);
}

static base_status measure_reference(const suite *s, const suite_scene *on, judge *j, base_error *err)
{
    run_result result = {0};
    base_status status = run_native(s, on, 0, REFERENCE_SAMPLES, true, &result, err);
    if (status == BASE_OK) {
        j->reference = picture_visibility(&result, false, err);
        j->mask = j->reference ? hits_of(&result, err) : NULL;
        status = j->mask ? BASE_OK : BASE_ERR_NOMEM;
    }
    run_result_destroy(&result);
    return status;
}

/* One run makes two rows: as it was traced, and filtered. */
static base_status measure_sixteen(const suite *s, const suite_scene *on, measured *m, unsigned doublings, bool interleaved,
                                   const figure *full, base_error *err)
{
    run_result result = {0};
    base_status status = run_native(s, on, doublings, 16, interleaved, &result, err);
    for (int filtered = 0; status == BASE_OK && filtered < 2; filtered++) {
        mft_figure5_row *row = &m->figure_rows[m->figure_count++];
        const int picture = 1 + interleaved + filtered;
        float *seen = picture_visibility(&result, filtered, err);
        *row = (mft_figure5_row){.scene = on->name,
                                 .width = s->width << doublings,
                                 .height = s->height << doublings,
                                 .interleaved = interleaved,
                                 .filtered = filtered,
                                 .rays = (double)result.counts.n[KERNEL_rays_shadow] / full->rays};
        status = seen ? BASE_OK : BASE_ERR_NOMEM;
        if (status == BASE_OK)
            mft_errors_of(seen, full->seen, full->mask, (size_t)row->width * row->height, row->error);
        if (status == BASE_OK && full->pictured && (interleaved || !filtered))
            status = write_picture(s, on, m, &result, picture, seen, err);
        free(seen);
    }
    run_result_destroy(&result);
    return status;
}

static base_status measure_figure(const suite *s, const suite_scene *on, measured *m, unsigned doublings, bool largest,
                                  base_error *err)
{
    run_result result = {0};
    figure full = {.pictured = largest && !s->options->no_pictures};
    base_status status = run_native(s, on, doublings, 256, false, &result, err);
    if (status == BASE_OK) {
        full.rays = (double)result.counts.n[KERNEL_rays_shadow];
        full.seen = picture_visibility(&result, false, err);
        full.mask = full.seen ? hits_of(&result, err) : NULL;
        status = full.mask ? BASE_OK : BASE_ERR_NOMEM;
    }
    if (status == BASE_OK && full.pictured)
        status = write_picture(s, on, m, &result, 0, full.seen, err);
    run_result_destroy(&result);
    for (int interleaved = 0; status == BASE_OK && interleaved < 2; interleaved++)
        status = measure_sixteen(s, on, m, doublings, interleaved, &full, err);
    free(full.seen);
    free(full.mask);
    return status;
}

/* Pictures that no kernel could trace, for their size, are left out. */
static base_status measure_figures(const suite *s, const suite_scene *on, measured *m, base_error *err)
{
    const unsigned edge = s->width > s->height ? s->width : s->height;
    unsigned last = 0;
    base_status status = BASE_OK;
    while (last < DOUBLINGS && edge << (last + 1) <= JOB_MAX_SIZE)
        last++;
    for (unsigned doublings = 0; status == BASE_OK && doublings <= last; doublings++)
        status = measure_figure(s, on, m, doublings, doublings == last, err);
    return status;
}

/* One run makes two rows: as it was traced, and filtered. */
static base_status measure_way(const suite *s, const suite_scene *on, measured *m, unsigned samples, bool interleaved, judge *j,
                               base_error *err)
{
    run_result result = {0};
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    options.params.samples = samples;
    options.params.filter = 1;
    options.params.interleaved = interleaved;
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    for (int filtered = 0; status == BASE_OK && filtered < 2; filtered++) {
        mft_quality_row *row = &m->rows[m->count];
        const uint64_t cycles = filtered ? result.cycles : mft_cycles(&result);
        float *seen = picture_visibility(&result, filtered, err);
        *row = (mft_quality_row){.scene = on->name, .samples = samples, .interleaved = interleaved, .filtered = filtered,
                                 .rays = (double)result.counts.n[KERNEL_rays_shadow], .cycles = (double)cycles,
                                 .cycles_per_pixel = (double)cycles / ((double)s->width * s->height)};
        j->seen[m->count++ % MFT_QUALITY_WAYS] = seen;
        status = seen ? BASE_OK : BASE_ERR_NOMEM;
    }
    run_result_destroy(&result);
    return status;
}

static void judge_rows(const suite *s, mft_quality_row *rows, const judge *j)
{
    const size_t pixels = (size_t)s->width * s->height;
    for (size_t i = 0; i < MFT_QUALITY_WAYS; i++)
        mft_errors_of(j->seen[i], j->reference, j->mask, pixels, rows[i].error);
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
    if (status == BASE_OK)
        status = measure_figures(s, on, m, err);
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
        const report_plot plot = {points.title, {"cycles per pixel", true},
                                  {"RMSE of the visibility inside penumbrae", true}, points.series, 4};
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
            figures[p] = (report_figure){m->paths[i][p], "rendered picture with soft shadows", captions[p]};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, PICTURES, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    base_status status = suite_add_table(s, "-figure5", mft_quality_figure5(m->figure_rows, m->figure_count, NULL), err);
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; kernel %s, back faces culled.", s->width,
             s->height, s->options->machine->name, s->options->machine->threads, mft_kernel(MFT_S_FRUSTA));
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, m, err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_plots(s, m, err);
    report_page_add_heading(s->page, 1, "All ways");
    return status == BASE_OK ? suite_add_table(s, "", mft_quality_errors(m->rows, m->count, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_QUALITY_WAYS, sizeof *m.rows),
                  .figure_rows = calloc(s->scene_count * FIGURE_ROWS, sizeof *m.figure_rows),
                  .paths = calloc(s->scene_count, sizeof *m.paths)};
    base_status status = m.rows && m.figure_rows && m.paths ? BASE_OK
                                                            : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.figure_rows);
    free(m.paths);
    return status;
}

static const char *const scenes[] = {"builtin:rooms-804", "builtin:hall-60k", NULL};

const suite_info suite_mft_quality = {
    .name = "mft-quality",
    .summary = "error of soft shadows against cycles, by samples, interleaving and filter (Benthin and Wald 2009, Figure 5)",
    .title = "MFT: speed against error",
    .about = "Figure 5 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): 16 samples "
             "of the light, interleaved between neighbouring pixels and filtered, against 256, in pictures of three sizes; and "
             "the error of the visibility against 4096 samples beside simulated cycles, for 4, 16, 64 and 256 samples, with and "
             "without interleaving and filter.",
    .scenes = scenes,
    .size = 128,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
