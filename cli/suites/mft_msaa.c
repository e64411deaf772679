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
    mft_msaa_row *rows;
    char (*paths)[PICTURES][SUITE_PATH_BYTES]; /* by scene */
    size_t count;
} measured;

static base_status run_way(const suite *s, const scene *input, const char *kernel, run_model model, unsigned edge, bool retrace,
                           kernel_marking marking, run_result *result, base_error *err)
{
    run_options options = suite_run_options(s, kernel_find(kernel), model);
    options.params.cull_backface = 1;
    options.params.retrace = retrace;
    options.params.marking = marking;
    options.width *= edge;
    options.height *= edge;
    if (model == RUN_NATIVE)
        options.error = 0;
    return run_kernel(input, s->options->machine, &options, result, err);
}

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

/* A picture of so many rays a pixel in either direction; the run is handed on if `keep` is not NULL. */
static base_status supersample(const suite *s, const suite_scene *on, unsigned edge, run_result *keep, report_image *out, base_error *err)
{
    run_result result = {0};
    report_image large = {0};
    base_status status = run_way(s, on->scene, "mft-primary", RUN_NATIVE, edge, false, KERNEL_MARKING_PIXEL, &result, err);
    if (status == BASE_OK)
        status = picture_shaded(&result, &large, err);
    if (status == BASE_OK)
        status = shrink(&large, (int)edge, out, err);
    report_image_destroy(&large);
    if (keep && status == BASE_OK)
        *keep = result;
    else
        run_result_destroy(&result);
    return status;
}

/* Recall and precision of the marked pixels, by the samples of all pixels. */
static base_status judge(const suite *s, const suite_scene *on, const run_result *adaptive, const run_result *full, mft_msaa_row *row,
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
            const bool marked = job_msaa_marked(adaptive->job, x, y);
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

/* Errors of the pictures; then they are written. */
static base_status compare(const suite *s, const suite_scene *on, measured *m, report_image images[PICTURES], base_error *err)
{
    report_image reference = {0};
    base_status status = supersample(s, on, REFERENCE_EDGE, NULL, &reference, err);
    for (int way = 0; status == BASE_OK && way < MFT_MSAA_WAYS; way++)
        m->rows[m->count].rmse[way] = mft_msaa_rmse(images[way].pixels, reference.pixels, 3 * (size_t)s->width * s->height);
    report_image_destroy(&reference);
    for (int i = 0; status == BASE_OK && !s->options->no_pictures && i < PICTURES; i++) {
        suite_path(s, m->paths[m->count][i], on->stem, rests[i]);
        status = suite_write_picture(m->paths[m->count][i], BASE_OK, &images[i], err);
    }
    return status;
}

static base_status measure_none(const suite *s, const suite_scene *on, mft_msaa_row *row, report_image *image, base_error *err)
{
    run_result result = {0};
    base_status status = run_way(s, on->scene, "mft-primary", RUN_CORE, 1, false, KERNEL_MARKING_PIXEL, &result, err);
    if (status == BASE_OK) {
        take_cycles(row, MFT_MSAA_NONE, &result);
        status = picture_shaded(&result, image, err);
    }
    run_result_destroy(&result);
    return status;
}

/* Cycles of marking alone, and of 16 rays for all pixels; pixels marked by blocks. */
static base_status measure_costs(const suite *s, const suite_scene *on, mft_msaa_row *row, base_error *err)
{
    run_result marking = {0}, full = {0}, blocks = {0};
    base_status status = run_way(s, on->scene, "mft-msaa", RUN_CORE, 1, false, KERNEL_MARKING_PIXEL, &marking, err);
    if (status == BASE_OK) {
        row->marking_cycles = (double)marking.cycles;
        status = run_way(s, on->scene, "mft-msaa", RUN_NATIVE, 1, false, KERNEL_MARKING_BLOCK, &blocks, err);
    }
    if (status == BASE_OK) {
        row->marked_by_blocks = (double)blocks.counts.n[KERNEL_pixels_marked];
        status = run_way(s, on->scene, "mft-primary", RUN_CORE, SAMPLES_EDGE, false, KERNEL_MARKING_PIXEL, &full, err);
    }
    if (status == BASE_OK)
        take_cycles(row, MFT_MSAA_FULL, &full);
    run_result_destroy(&marking);
    run_result_destroy(&blocks);
    run_result_destroy(&full);
    return status;
}

static base_status measure_adaptive(const suite *s, const suite_scene *on, mft_msaa_row *row, report_image images[PICTURES], base_error *err)
{
    run_result adaptive = {0}, full = {0};
    base_status status = run_way(s, on->scene, "mft-msaa", RUN_CORE, 1, true, KERNEL_MARKING_PIXEL, &adaptive, err);
    if (status == BASE_OK) {
        take_cycles(row, MFT_MSAA_ADAPTIVE, &adaptive);
        row->marked = (double)adaptive.counts.n[KERNEL_pixels_marked];
        row->silhouettes = (double)adaptive.counts.n[KERNEL_silhouettes];
        row->edge_tests = (double)adaptive.counts.n[KERNEL_edge_tests];
        status = picture_shaded(&adaptive, &images[MFT_MSAA_ADAPTIVE], err);
    }
    if (status == BASE_OK)
        status = picture_of_marks(s, &adaptive, &images[MFT_MSAA_WAYS], err);
    if (status == BASE_OK)
        status = supersample(s, on, SAMPLES_EDGE, &full, &images[MFT_MSAA_FULL], err);
    if (status == BASE_OK)
        status = judge(s, on, &adaptive, &full, row, err);
    run_result_destroy(&adaptive);
    run_result_destroy(&full);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    report_image images[PICTURES] = {{0}};
    mft_msaa_row *row = &m->rows[m->count];
    *row = (mft_msaa_row){.scene = on->name, .pixels = (double)s->width * s->height};
    base_status status = measure_none(s, on, row, &images[MFT_MSAA_NONE], err);
    if (status == BASE_OK)
        status = measure_adaptive(s, on, row, images, err);
    if (status == BASE_OK)
        status = measure_costs(s, on, row, err);
    if (status == BASE_OK)
        status = compare(s, on, m, images, err);
    for (int i = 0; i < PICTURES; i++)
        report_image_destroy(&images[i]);
    m->count++;
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    for (size_t i = 0; status == BASE_OK && i < m->count; i++) {
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
    base_status status = suite_add_table(s, "", mft_msaa_marked(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-cycles", mft_msaa_cycles(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-errors", mft_msaa_errors(m->rows, m->count, caption), err);
    return status == BASE_OK && !s->options->no_pictures ? add_pictures(s, m, err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    if (s->width > JOB_MAX_SIZE / REFERENCE_EDGE || s->height > JOB_MAX_SIZE / REFERENCE_EDGE)
        return base_fail(err, BASE_ERR_USAGE, "--size", "%ux%u: this suite traces %d times as many pixels in either direction, at most %u",
                         s->width, s->height, REFERENCE_EDGE, JOB_MAX_SIZE);
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows), .paths = calloc(s->scene_count, sizeof *m.paths)};
    base_status status = m.rows && m.paths ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.paths);
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
