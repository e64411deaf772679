/* Suite mlrta-tiles: how multi-level ray tracing splits the picture (Reshetov, Soupikov and Hurley 2005, 4.2, Figure 7).
 *
 * Kernels keep counters of each initial tile, not where its parts lie. That is found here from the rays: a divergent tile is split
 * down to 4x4, and where no part of an initial tile is larger than mts, the others are split no further.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mlrta_runs.h"
#include "reports/views/mlrta_tiles.h"

enum { ITS = 3, SF = 1, MTS = 3, INITIAL_EDGE = 16 << ITS, PARTS = 4 }; /* the paper's best: 128, 16; and 32, the size of its parts */

static const report_color line_color = {1, 0.9f, 0.2f}, divergent_color = {1, 0, 0};

typedef struct measured {
    mlrta_tiles_row *rows;
    size_t count;
    char (*pictures)[SUITE_PATH_BYTES]; /* by scene */
} measured;

/* A picture in the making. */
typedef struct tiling {
    const run_result *run;
    mlrta_tiles_row *row;
    report_image *image; /* NULL: only counted */
} tiling;

/* A square of pixels. */
typedef struct square {
    unsigned x, y, edge;
} square;

/* Whether the corner rays have the same strict sign on every axis, as kernels/mlrta/tile_bounds.h asks. */
static bool is_coherent(const kernel_job *job, square at)
{
    const job_constants *k = job->constants_host;
    const unsigned right = at.x + at.edge < job->width ? at.x + at.edge : job->width;
    const unsigned down = at.y + at.edge < job->height ? at.y + at.edge : job->height;
    float corners[4][3];
    for (unsigned i = 0; i < 4; i++)
        kernel_job_direction(job, i & 1 ? right - 1 : at.x, i & 2 ? down - 1 : at.y, corners[i]);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 4; i++)
            if (fabsf(corners[i][axis]) - k->slack <= k->tiny || (corners[i][axis] < 0) != (corners[0][axis] < 0))
                return false;
    return true;
}

static bool splits(const tiling *t, square at, bool coherent)
{
    const uint64_t *n = t->run->tile_counts[kernel_job_pixel(t->run->job, at.x, at.y).unit].n;
    if (!coherent)
        return at.edge > 4;
    return at.edge == INITIAL_EDGE && n[KERNEL_units_tiles] + n[KERNEL_units_divergent_tiles] > 1;
}

/* Half of the colour, half of what is there. */
static void tint(float *pixel, report_color color)
{
    pixel[0] = (pixel[0] + color.r) / 2;
    pixel[1] = (pixel[1] + color.g) / 2;
    pixel[2] = (pixel[2] + color.b) / 2;
}

/* Divergent packets red; the upper and left edges of the others' tiles, if they are larger than a packet, as lines. */
static void paint(const tiling *t, square at, bool coherent)
{
    for (unsigned y = at.y; y < at.y + at.edge && y < t->run->options.height; y++)
        for (unsigned x = at.x; x < at.x + at.edge && x < t->run->options.width; x++) {
            float *pixel = report_image_pixel(t->image, (int)x, (int)y);
            if (!coherent)
                tint(pixel, divergent_color);
            else if (at.edge > 4 && (x == at.x || y == at.y))
                tint(pixel, line_color);
        }
}

static void add_tile(const tiling *t, square at)
{
    int index = 0;
    const bool coherent = is_coherent(t->run->job, at);
    while (4u << index < at.edge)
        index++;
    mlrta_tile_counts *n = &t->row->by_edge[index];
    n->searched += coherent;
    n->divergent += !coherent;
    if (!splits(t, at, coherent)) {
        n->traced++;
        if (t->image)
            paint(t, at, coherent);
        return;
    }
    const unsigned parts = at.edge >= 16 ? PARTS : 2, edge = at.edge / parts;
    for (unsigned i = 0; i < parts * parts; i++) {
        const square part = {at.x + i % parts * edge, at.y + i / parts * edge, edge};
        if (part.x < t->run->options.width && part.y < t->run->options.height)
            add_tile(t, part);
    }
}

static void add_tiles(const tiling *t)
{
    for (unsigned y = 0; y < t->run->options.height; y += INITIAL_EDGE)
        for (unsigned x = 0; x < t->run->options.width; x += INITIAL_EDGE)
            add_tile(t, (square){x, y, INITIAL_EDGE});
    t->row->counted.searched = t->run->counts.n[KERNEL_units_tiles];
    t->row->counted.divergent = t->run->counts.n[KERNEL_units_divergent_tiles];
}

static base_status write_tiles(const suite *s, const suite_scene *on, const run_result *run, measured *m, base_error *err)
{
    report_image image = {0};
    mlrta_tiles_row *row = &m->rows[m->count];
    char *path = m->pictures[m->count++];
    const tiling t = {run, row, s->options->no_pictures ? NULL : &image};
    base_status status = t.image ? picture_shaded(run, &image, err) : BASE_OK;
    row->scene = on->name;
    if (status == BASE_OK)
        add_tiles(&t);
    if (!t.image)
        return status;
    suite_path(s, path, on->stem, "-mlrta-tiles.png");
    return suite_write_picture(path, status, &image, err);
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    run_options options = suite_run_options(s, kernel_find("mlrta-primary"), RUN_NATIVE);
    run_result run = {0};
    options.keep_tile_counts = true;
    options.params.its = ITS;
    options.params.sf = SF;
    options.params.mts = MTS;
    base_status status = run_kernel(on->scene, s->options->machine, &options, &run, err);
    if (status == BASE_OK)
        status = write_tiles(s, on, &run, user, err);
    run_result_destroy(&run);
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    report_page_add_paragraph(s->page, "Yellow lines are the edges of the tiles whose packets start at the tile's entry point. Packets whose "
                                       "rays differ in sign are red; around them tiles are split to 4x4, and have no lines there.");
    for (size_t i = 0; status == BASE_OK && i < m->count; i++)
        status = report_page_add_pictures(s->page, &(report_figure){m->pictures[i], "picture with its tiles", s->scenes[i].name}, 1, err);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    char caption[200];
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.rows && m.pictures ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    snprintf(caption, sizeof caption, "%ux%u pixels, kernel mlrta-primary with its=%d, sf=%d, mts=%d.", s->width, s->height, INITIAL_EDGE,
             PARTS * PARTS, 4 << MTS);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, &m, err);
    report_page_add_heading(s->page, 1, "Table");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_tiles_table(m.rows, m.count, caption), err);
    free(m.rows);
    free(m.pictures);
    return status;
}

const suite_info suite_mlrta_tiles = {
    .name = "mlrta-tiles",
    .summary = "pictures of how multi-level ray tracing splits tiles, divergent packets red (Reshetov and others 2005, Figure 7)",
    .title = "MLRTA: tiles",
    .about = "Figure 7 of Reshetov, Soupikov and Hurley's 'Multi-Level Ray Tracing Algorithm' (2005) for scenes of ours: the tiles into "
             "which adaptive splitting parts the picture, and those whose rays differ in sign.",
    .scenes = mlrta_suite_scenes,
    .size = 1024,
    .measure = measure,
};
