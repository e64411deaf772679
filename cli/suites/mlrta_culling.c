/* Suite mlrta-culling: inverse against direct frustum culling, and the unsound corner rays (Reshetov and others 2005, 3.3, Figure 2). */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mlrta_runs.h"
#include "reports/views/mlrta_culling.h"

enum { CULLINGS = 3, SIZES = 2 };

static const char *const culling_names[CULLINGS] = {"inverse", "direct", "corner rays"};
static const char *const size_names[SIZES] = {"as by default", "256x256, unsplit"};

typedef struct measured {
    mlrta_culling_row *rows;
    size_t count;
    char (*pictures)[SUITE_PATH_BYTES]; /* by scene */
    size_t scenes;
} measured;

static bool same_hit(const run_result *a, const run_result *b, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(a->job, x, y);
    const job_frame_tile *of_a = &a->job->frame_host[p.tile], *of_b = &b->job->frame_host[p.tile];
    return of_a->id[p.block][p.pixel] == of_b->id[p.block][p.pixel] && !(of_a->t[p.block][p.pixel] < of_b->t[p.block][p.pixel]) &&
           !(of_a->t[p.block][p.pixel] > of_b->t[p.block][p.pixel]);
}

static bool is_hit(const run_result *r, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(r->job, x, y);
    return r->job->frame_host[p.tile].id[p.block][p.pixel] != JOB_NO_HIT;
}

static void compare(const run_result *r, const run_result *reference, mlrta_culling_row *row)
{
    for (unsigned y = 0; y < r->options.height; y++)
        for (unsigned x = 0; x < r->options.width; x++) {
            row->hits += is_hit(reference, x, y);
            row->lost += !same_hit(r, reference, x, y);
        }
}

/* The picture with what was lost in red. */
static base_status write_lost(const suite *s, const suite_scene *on, measured *m, const run_result *r, const run_result *reference,
                              base_error *err)
{
    report_image image = {0};
    char *path = m->pictures[m->scenes];
    suite_path(s, path, on->stem, "-mlrta-corner-rays-lost.png");
    base_status status = picture_shaded(r, &image, err);
    for (unsigned y = 0; status == BASE_OK && y < s->height; y++)
        for (unsigned x = 0; x < s->width; x++)
            if (!same_hit(r, reference, x, y)) {
                float *pixel = report_image_pixel(&image, (int)x, (int)y);
                pixel[0] = 1;
                pixel[1] = pixel[2] = 0;
            }
    return suite_write_picture(path, status, &image, err);
}

static base_status measure_one(const suite *s, const suite_scene *on, measured *m, const run_result *reference, int size, unsigned culling,
                               base_error *err)
{
    run_options options = suite_run_options(s, kernel_find("mlrta-primary"), RUN_NATIVE);
    run_result result = {0};
    options.params.culling = culling;
    if (size) { /* no tile is split */
        options.params.its = 4;
        options.params.mts = 6;
    }
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    if (status == BASE_OK) {
        mlrta_culling_row *row = &m->rows[m->count++];
        *row = (mlrta_culling_row){.scene = on->name, .tiles = size_names[size], .culling = culling_names[culling],
                                   .packets = mlrta_packets(s), .counts = mlrta_counts_of(&result)};
        compare(&result, reference, row);
    }
    if (status == BASE_OK && !size && culling == KERNEL_CULL_CORNER_RAYS && !s->options->no_pictures)
        status = write_lost(s, on, m, &result, reference, err);
    run_result_destroy(&result);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    run_result reference = {0};
    const run_options options = suite_run_options(s, kernel_find("kd16-primary"), RUN_NATIVE);
    base_status status = run_kernel(on->scene, s->options->machine, &options, &reference, err);
    for (int size = 0; size < SIZES; size++)
        for (unsigned culling = 0; status == BASE_OK && culling < CULLINGS; culling++)
            status = measure_one(s, on, m, &reference, size, culling, err);
    run_result_destroy(&reference);
    m->scenes++;
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "What corner rays lose");
    report_page_add_paragraph(s->page, "Pixels whose nearest hit is lost are red: corner rays of tiles of the default sizes.");
    for (size_t i = 0; status == BASE_OK && i < m->scenes; i++)
        status = report_page_add_pictures(s->page, &(report_figure){m->pictures[i], "picture with lost hits in red", s->scenes[i].name}, 1, err);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    char caption[200];
    measured m = {.rows = calloc(s->scene_count * CULLINGS * SIZES, sizeof *m.rows), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.rows && m.pictures ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    snprintf(caption, sizeof caption, "%ux%u pixels, kernel mlrta-primary; hits are compared with those of kd16-primary.", s->width, s->height);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    report_page_add_heading(s->page, 1, "Table");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_culling_table(m.rows, m.count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, &m, err);
    free(m.rows);
    free(m.pictures);
    return status;
}

const suite_info suite_mlrta_culling = {
    .name = "mlrta-culling",
    .summary = "inverse against direct frustum culling in entry-point searches, and corner rays, which lose hits",
    .title = "MLRTA: ways to cull",
    .about = "How entry-point searches of multi-level ray tracing may cull cells: by the inverse method of Reshetov, Soupikov and Hurley "
             "(2005), by the planes of the tile's frustum, and by its corner rays alone, which the paper's Figure 2 shows to be unsound.",
    .scenes = mlrta_small_scenes,
    .size = 1024,
    .measure = measure,
};
