/* Suite mft-msaa: adaptive anti-aliasing, 6.1 and Figure 7 of Benthin and Wald 2009. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"
#include "exact/pixel_edges.h"
#include "kernels/job_msaa.h"
#include "reports/views/mft_msaa.h"

/* Samples of a pixel are 4x4; what they are judged by are 8x8. */
enum { SAMPLES_EDGE = 4, REFERENCE_EDGE = 8, PICTURES = MFT_MSAA_WAYS + 1 };

static const char *const rests[PICTURES] = {"-1-ray.png", "-adaptive.png", "-16-rays.png", "-marked.png"};
static const char *const captions[PICTURES] = {"1 ray a pixel", "adaptive", "16 rays a pixel", "marked pixels"};

typedef struct measured {
    mft_msaa_row *rows;                        /* by scene, like the others */
    char (*paths)[PICTURES][SUITE_PATH_BYTES];
    report_image (*images)[PICTURES];          /* until they are written */
} measured;

static void take_cycles(mft_msaa_row *row, mft_msaa_way way, const run_result *r)
{
    row->cycles[way] = (double)r->cycles;
    row->rays[way] = (double)r->counts.n[KERNEL_rays];
    row->half_width[way] = r->estimate.half_width_95;
}

/* The mean of each square of pixels. */
static base_status shrink(const report_image *from, int edge, report_image *out, base_error *err)
{
    base_status status = report_image_create(from->width / edge, from->height / edge, 3, out, err);
    for (int y = 0; status == BASE_OK && y < out->height * edge; y++)
        for (int x = 0; x < out->width * edge; x++)
            for (int channel = 0; channel < 3; channel++)
                report_image_pixel(out, x / edge, y / edge)[channel] += report_image_pixel(from, x, y)[channel] / (float)(edge * edge);
    return status;
}

/* A picture of a run with so many rays a pixel in either direction. */
static base_status supersampled(const run_result *r, unsigned edge, report_image *out, base_error *err)
{
    report_image large = {0};
    base_status status = picture_shaded(r, &large, err);
    if (status == BASE_OK)
        status = shrink(&large, (int)edge, out, err);
    report_image_destroy(&large);
    return status;
}

/* Recall and precision of the marked pixels, by the samples of all pixels. */
static base_status judge(const suite *s, const suite_scene *on, const report_image *marks, const run_result *full, mft_msaa_row *row,
                         base_error *err)
{
    pixel_edges *edges = NULL;
    base_status status = pixel_edges_create(on->scene, full->camera, s->width, s->height, true, &edges, err);
    for (unsigned y = 0; status == BASE_OK && y < s->height; y++)
        for (unsigned x = 0; x < s->width; x++) {
            uint32_t id[16];
            float t[16];
            for (unsigned j = 0; j < 16; j++) {
                const job_pixel p = kernel_job_pixel(full->job, SAMPLES_EDGE * x + j % 4, SAMPLES_EDGE * y + j / 4);
                id[j] = full->job->frame_host[p.tile].id[p.block][p.pixel];
                t[j] = full->job->frame_host[p.tile].t[p.block][p.pixel];
            }
            const pixel_kind kind = pixel_edges_judge(edges, x, y, id, t);
            const bool marked = report_image_pixel(marks, (int)x, (int)y)[0] > 0;
            row->edges += kind == PIXEL_EDGE;
            row->edges_marked += kind == PIXEL_EDGE && marked;
            row->intersections += kind == PIXEL_INTERSECTION;
            row->precise += kind != PIXEL_SMOOTH && marked;
        }
    pixel_edges_destroy(&edges);
    return status;
}

static base_status picture_of_marks(const suite *s, const run_result *r, report_image *out, base_error *err)
{
    base_status status = report_image_create((int)s->width, (int)s->height, 3, out, err);
    for (unsigned y = 0; status == BASE_OK && y < s->height; y++)
        for (unsigned x = 0; x < s->width; x++)
            for (int channel = 0; channel < 3; channel++)
                report_image_pixel(out, (int)x, (int)y)[channel] = job_msaa_marked(r->job, x, y) ? 1.0f : 0.0f;
    return status;
}

static base_status take_none(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    (void)s;
    take_cycles(&m->rows[entry->scene], MFT_MSAA_NONE, result);
    return picture_shaded(result, &m->images[entry->scene][MFT_MSAA_NONE], err);
}

static base_status take_adaptive(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    mft_msaa_row *row = &m->rows[entry->scene];
    report_image *images = m->images[entry->scene];
    take_cycles(row, MFT_MSAA_ADAPTIVE, result);
    row->marked = (double)result->counts.n[KERNEL_pixels_marked];
    row->silhouettes = (double)result->counts.n[KERNEL_silhouettes];
    row->edge_tests = (double)result->counts.n[KERNEL_edge_tests];
    base_status status = picture_shaded(result, &images[MFT_MSAA_ADAPTIVE], err);
    return status == BASE_OK ? picture_of_marks(s, result, &images[MFT_MSAA_WAYS], err) : status;
}

static base_status take_marking(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    (void)s;
    (void)err;
    m->rows[entry->scene].marking_cycles = (double)result->cycles;
    return BASE_OK;
}

static base_status take_blocks(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    (void)s;
    (void)err;
    m->rows[entry->scene].marked_by_blocks = (double)result->counts.n[KERNEL_pixels_marked];
    return BASE_OK;
}

static base_status take_full_cycles(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    (void)s;
    (void)err;
    take_cycles(&m->rows[entry->scene], MFT_MSAA_FULL, result);
    return BASE_OK;
}

/* The samples of all pixels; the marks are there. */
static base_status take_full(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    report_image *images = m->images[entry->scene];
    base_status status = supersampled(result, SAMPLES_EDGE, &images[MFT_MSAA_FULL], err);
    return status == BASE_OK ? judge(s, &s->scenes[entry->scene], &images[MFT_MSAA_WAYS], result, &m->rows[entry->scene], err) : status;
}

/* Errors of the pictures, which are all there; then they are written. */
static base_status take_reference(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    report_image reference = {0}, *images = m->images[entry->scene];
    base_status status = supersampled(result, REFERENCE_EDGE, &reference, err);
    for (int way = 0; status == BASE_OK && way < MFT_MSAA_WAYS; way++)
        m->rows[entry->scene].rmse[way] = mft_msaa_rmse(images[way].pixels, reference.pixels, 3 * (size_t)s->width * s->height);
    report_image_destroy(&reference);
    for (int i = 0; status == BASE_OK && !s->options->no_pictures && i < PICTURES; i++) {
        char *path = m->paths[entry->scene][i];
        suite_path(s, path, s->scenes[entry->scene].stem, rests[i]);
        status = suite_write_picture(path, BASE_OK, &images[i], err);
    }
    return status;
}

/* The runs of a scene; the dear ones first, but what judges others after them. */
static const struct {
    const char *kernel;
    run_model model;
    unsigned edge; /* rays of a pixel in either direction */
    bool retrace;
    kernel_marking marking;
    suite_take_fn *take;
} ways[] = {
    {"mft-primary", RUN_CORE, SAMPLES_EDGE, false, KERNEL_MARKING_PIXEL, take_full_cycles},
    {"mft-msaa", RUN_CORE, 1, true, KERNEL_MARKING_PIXEL, take_adaptive},
    {"mft-msaa", RUN_CORE, 1, false, KERNEL_MARKING_PIXEL, take_marking},
    {"mft-primary", RUN_CORE, 1, false, KERNEL_MARKING_PIXEL, take_none},
    {"mft-msaa", RUN_NATIVE, 1, false, KERNEL_MARKING_BLOCK, take_blocks},
    {"mft-primary", RUN_NATIVE, SAMPLES_EDGE, false, KERNEL_MARKING_PIXEL, take_full},
    {"mft-primary", RUN_NATIVE, REFERENCE_EDGE, false, KERNEL_MARKING_PIXEL, take_reference},
};
enum { WAYS = sizeof ways / sizeof *ways };

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    suite_runs runs = {0};
    for (size_t i = 0; i < s->scene_count * WAYS; i++) {
        const size_t way = i / s->scene_count;
        run_options options = suite_run_options(s, kernel_find(ways[way].kernel), ways[way].model);
        options.params.cull_backface = 1;
        options.params.retrace = ways[way].retrace;
        options.params.marking = ways[way].marking;
        options.width *= ways[way].edge;
        options.height *= ways[way].edge;
        suite_runs_add(&runs, (suite_run_entry){.scene = i % s->scene_count, .options = options, .take = ways[way].take});
    }
    base_status status = suite_runs_take(s, &runs, m, err);
    for (size_t n = 0; status == BASE_OK && n < s->scene_count; n++) {
        m->rows[n].scene = s->scenes[n].name;
        m->rows[n].pixels = (double)s->width * s->height;
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
            figures[p] = (report_figure){m->paths[i][p], p < MFT_MSAA_WAYS ? "rendered picture" : "mask of pixels", captions[p]};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, PICTURES, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; kernel mft-msaa, back faces culled.", s->width,
             s->height, s->options->machine->name, s->options->machine->threads);
    base_status status = suite_add_table(s, "", mft_msaa_marked(m->rows, s->scene_count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-cycles", mft_msaa_cycles(m->rows, s->scene_count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-errors", mft_msaa_errors(m->rows, s->scene_count, caption), err);
    return status == BASE_OK && !s->options->no_pictures ? add_pictures(s, m, err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    if (s->width > JOB_MAX_SIZE / REFERENCE_EDGE || s->height > JOB_MAX_SIZE / REFERENCE_EDGE)
        return base_fail(err, BASE_ERR_USAGE, "--size", "%ux%u: this suite traces %d times as many pixels in either direction, at most %u",
                         s->width, s->height, REFERENCE_EDGE, JOB_MAX_SIZE);
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows), .paths = calloc(s->scene_count, sizeof *m.paths),
                  .images = calloc(s->scene_count, sizeof *m.images)};
    base_status status = m.rows && m.paths && m.images ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    for (size_t i = 0; m.images && i < s->scene_count * PICTURES; i++)
        report_image_destroy(&m.images[i / PICTURES][i % PICTURES]);
    free(m.rows);
    free(m.paths);
    free(m.images);
    return status;
}

static const char *const scenes[] = {"builtin:hall-60k", "builtin:atrium-76k", "builtin:creature-69k", NULL};

const suite_info suite_mft_msaa = {
    .name = "mft-msaa",
    .summary = "adaptive anti-aliasing: pixels marked by silhouettes, cycles and error, core model (Benthin and Wald 2009, Figure 7)",
    .title = "MFT: adaptive anti-aliasing",
    .about = "Section 6.1 and Figure 7 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): "
             "while primary rays are traced, pixels that a silhouette crosses are marked; these are traced again with 16 samples. "
             "What is marked, judged by 16 samples of every pixel; cycles of marking and of the samples beside 16 rays for every "
             "pixel; and the error of the pictures against 64.",
    .scenes = scenes,
    .size = 256,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
