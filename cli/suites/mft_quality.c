/* Suite mft-quality: Figure 5 of Benthin and Wald 2009, interleaved samples and a filter against many; speed against error. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"
#include "reports/views/mft_quality.h"

enum { REFERENCE_SAMPLES = 4096, PICTURES = 4 };

/* Pictures of Figure 5 are as large as the suite's, and this many times doubled. */
enum { DOUBLINGS = 2, FIGURE_ROWS = 4 };

/* The rest of the pictures' file names, and what they show. */
static const char *const rests[PICTURES] = {"-256-samples.png", "-16-samples.png", "-16-interleaved.png",
                                            "-16-interleaved-filtered.png"};
static const char *const captions[PICTURES] = {"256 samples", "16 samples, the same for all pixels", "16 samples, interleaved",
                                               "16 samples, interleaved and filtered"};

/* Very many samples of a picture, which others are compared with. */
typedef struct judge {
    float *seen;         /* visibility by pixel */
    unsigned char *mask; /* pixels with a hit */
    double rays;
} judge;

typedef struct measured {
    mft_quality_row *rows; /* by scene */
    judge *references;     /* by scene: what the rows are judged by */
    unsigned sizes;        /* of the pictures of Figure 5 */
    mft_figure5_row *figure_rows; /* FIGURE_ROWS by scene, then by size */
    judge *figures;               /* by scene, then by size: 256 samples */
    char (*paths)[PICTURES][SUITE_PATH_BYTES]; /* by scene */
} measured;

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

static base_status write_picture(const suite *s, const suite_run_entry *entry, const measured *m, const run_result *r, int picture,
                                 const float *seen, base_error *err)
{
    report_image image = {0};
    char *path = m->paths[entry->scene][picture];
    suite_path(s, path, s->scenes[entry->scene].stem, rests[picture]);
    return suite_write_picture(path, picture_lit(r, seen, &image, err), &image, err);
}

static base_status judge_create(const run_result *r, judge *out, base_error *err)
{
    out->rays = (double)r->counts.n[KERNEL_rays_shadow];
    out->seen = picture_visibility(r, false, err);
    out->mask = out->seen ? hits_of(r, err) : NULL;
    return out->mask ? BASE_OK : BASE_ERR_NOMEM;
}

static void destroy_judges(judge *judges, size_t count)
{
    for (size_t i = 0; judges && i < count; i++) {
        free(judges[i].seen);
        free(judges[i].mask);
    }
    free(judges);
}

static base_status take_reference(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    (void)s;
    return judge_create(result, &m->references[entry->scene], err);
}

/* One run makes two rows: as it was traced, and filtered. */
static base_status take_way(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    const judge *reference = &m->references[entry->scene];
    const size_t pixels = (size_t)s->width * s->height;
    base_status status = BASE_OK;
    for (int filtered = 0; status == BASE_OK && filtered < 2; filtered++) {
        mft_quality_row *row = &m->rows[entry->row + (size_t)filtered];
        const uint64_t cycles = filtered ? result->cycles : mft_cycles(result);
        float *seen = picture_visibility(result, filtered, err);
        *row = (mft_quality_row){.scene = s->scenes[entry->scene].name, .samples = result->options.params.samples,
                                 .interleaved = result->options.params.interleaved, .filtered = filtered,
                                 .rays = (double)result->counts.n[KERNEL_rays_shadow], .cycles = (double)cycles,
                                 .cycles_per_pixel = (double)cycles / (double)pixels};
        status = seen ? BASE_OK : BASE_ERR_NOMEM;
        if (status == BASE_OK)
            mft_errors_of(seen, reference->seen, reference->mask, pixels, row->error);
        free(seen);
    }
    return status;
}

/* Only the largest pictures of Figure 5 are written. */
static bool is_pictured(const suite *s, const measured *m, const suite_run_entry *entry)
{
    return entry->row % m->sizes == m->sizes - 1 && !s->options->no_pictures;
}

static base_status take_figure(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    judge *figure = &m->figures[entry->row];
    base_status status = judge_create(result, figure, err);
    return status == BASE_OK && is_pictured(s, m, entry) ? write_picture(s, entry, m, result, 0, figure->seen, err) : status;
}

/* One run makes two rows: as it was traced, and filtered. */
static base_status take_sixteen(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    const run_options *o = &result->options;
    const judge *figure = &m->figures[entry->row];
    const bool interleaved = o->params.interleaved;
    base_status status = BASE_OK;
    for (int filtered = 0; status == BASE_OK && filtered < 2; filtered++) {
        mft_figure5_row *row = &m->figure_rows[entry->row * FIGURE_ROWS + (size_t)(2 * interleaved + filtered)];
        float *seen = picture_visibility(result, filtered, err);
        *row = (mft_figure5_row){.scene = s->scenes[entry->scene].name, .width = o->width, .height = o->height, .interleaved = interleaved,
                                 .filtered = filtered, .rays = (double)result->counts.n[KERNEL_rays_shadow] / figure->rays};
        status = seen ? BASE_OK : BASE_ERR_NOMEM;
        if (status == BASE_OK)
            mft_errors_of(seen, figure->seen, figure->mask, (size_t)o->width * o->height, row->error);
        if (status == BASE_OK && is_pictured(s, m, entry) && (interleaved || !filtered))
            status = write_picture(s, entry, m, result, 1 + interleaved + filtered, seen, err);
        free(seen);
    }
    return status;
}

static run_options options_of(const suite *s, unsigned samples, bool interleaved)
{
    run_options options = mft_run_options(s, MFT_S_FRUSTA);
    options.params.samples = samples;
    options.params.filter = 1;
    options.params.interleaved = interleaved;
    return options;
}

/* Traced in a picture whose edges are doubled `doublings` times; no cycles. */
static run_options native_options(const suite *s, unsigned doublings, unsigned samples, bool interleaved)
{
    run_options options = options_of(s, samples, interleaved);
    options.model = RUN_NATIVE;
    options.error = 0;
    options.width <<= doublings;
    options.height <<= doublings;
    return options;
}

/* A scene's speed against error: the reference, then the ways, the dearest first. */
static void add_ways(const suite *s, suite_runs *runs, size_t scene_number)
{
    suite_runs_add(runs, (suite_run_entry){.scene = scene_number, .options = native_options(s, 0, REFERENCE_SAMPLES, true), .take = take_reference});
    for (size_t i = MFT_QUALITY_SAMPLES; i-- > 0;)
        for (size_t interleaved = 0; interleaved < (i < MFT_QUALITY_SAMPLES - 1 ? 2 : 1); interleaved++)
            suite_runs_add(runs, (suite_run_entry){.scene = scene_number, .row = scene_number * MFT_QUALITY_WAYS + 4 * i + 2 * interleaved,
                                                   .options = options_of(s, mft_quality_samples[i], interleaved), .take = take_way});
}

/* A scene's pictures of Figure 5, the largest first. */
static void add_figures(const suite *s, const measured *m, suite_runs *runs, size_t scene_number)
{
    for (unsigned doublings = m->sizes; doublings-- > 0;) {
        suite_run_entry entry = {.scene = scene_number, .row = scene_number * m->sizes + doublings};
        entry.options = native_options(s, doublings, 256, false);
        entry.take = take_figure;
        suite_runs_add(runs, entry);
        entry.take = take_sixteen;
        for (int interleaved = 0; interleaved < 2; interleaved++) {
            entry.options = native_options(s, doublings, 16, interleaved);
            suite_runs_add(runs, entry);
        }
    }
}

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    suite_runs runs = {0};
    for (size_t n = 0; n < s->scene_count; n++)
        add_ways(s, &runs, n);
    for (size_t n = 0; n < s->scene_count; n++)
        add_figures(s, m, &runs, n);
    return suite_runs_take(s, &runs, m, err);
}

/* Pictures that no kernel could trace, for their size, are left out. */
static unsigned figure_sizes(const suite *s)
{
    const unsigned edge = s->width > s->height ? s->width : s->height;
    unsigned last = 0;
    while (last < DOUBLINGS && edge << (last + 1) <= JOB_MAX_SIZE)
        last++;
    return last + 1;
}

static base_status add_plots(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Speed against error");
    for (size_t i = 0; status == BASE_OK && i < s->scene_count; i++) {
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
    for (size_t i = 0; status == BASE_OK && i < s->scene_count; i++) {
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
    base_status status = suite_add_table(s, "-figure5", mft_quality_figure5(m->figure_rows, s->scene_count * m->sizes * FIGURE_ROWS, NULL), err);
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; kernel %s, back faces culled.", s->width,
             s->height, s->options->machine->name, s->options->machine->threads, mft_kernel(MFT_S_FRUSTA));
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, m, err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_plots(s, m, err);
    report_page_add_heading(s->page, 1, "All ways");
    return status == BASE_OK ? suite_add_table(s, "", mft_quality_errors(m->rows, s->scene_count * MFT_QUALITY_WAYS, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    const unsigned sizes = figure_sizes(s);
    const size_t figures = s->scene_count * sizes;
    measured m = {.rows = calloc(s->scene_count * MFT_QUALITY_WAYS, sizeof *m.rows),
                  .references = calloc(s->scene_count, sizeof *m.references),
                  .sizes = sizes,
                  .figure_rows = calloc(figures * FIGURE_ROWS, sizeof *m.figure_rows),
                  .figures = calloc(figures, sizeof *m.figures),
                  .paths = calloc(s->scene_count, sizeof *m.paths)};
    const bool all = m.rows && m.references && m.figure_rows && m.figures && m.paths;
    base_status status = all ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    destroy_judges(m.references, s->scene_count);
    destroy_judges(m.figures, figures);
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
