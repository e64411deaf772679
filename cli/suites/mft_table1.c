/* Suite mft-table1: Table 1 of Benthin and Wald 2009 with the cycles of the core model, beside the published rows. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"

typedef struct measured {
    mft_row *rows;
    size_t count;
    char (*pictures)[1 + MFT_ALGORITHMS][SUITE_PATH_BYTES]; /* by scene: the scene, then a heat map by algorithm */
    size_t scenes;
} measured;

/* The rendered picture with the last algorithm, which has shadows. Heat maps share the scale of the packets before them, which are the
   dearer; cycles of pixels are known only if all tiles were simulated. */
static base_status write_pictures(const suite *s, const suite_scene *on, measured *m, const run_result *r, mft_algorithm a,
                                  double *top, base_error *err)
{
    char rest[60];
    char(*paths)[SUITE_PATH_BYTES] = m->pictures[m->scenes];
    report_image image = {0};
    base_status status = BASE_OK;
    if (a == MFT_S_FRUSTA) {
        suite_path(s, paths[0], on->stem, ".png");
        status = suite_write_picture(paths[0], picture_shaded(r, &image, err), &image, err);
    }
    if (status != BASE_OK || s->options->error > 0)
        return status;
    snprintf(rest, sizeof rest, "-%s-core-cycles.png", mft_kernel(a));
    suite_path(s, paths[1 + a], on->stem, rest);
    if (a % 2 == 0)
        status = picture_heat_top(r, KERNEL_COUNTER_COUNT, top, err);
    if (status == BASE_OK)
        status = suite_write_picture(paths[1 + a], picture_heat_map(r, KERNEL_COUNTER_COUNT, *top, &image, err), &image, err);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    double top = 0;
    base_status status = BASE_OK;
    for (int a = 0; status == BASE_OK && a < mft_algorithms_measured(); a++) {
        run_result result = {0};
        status = mft_run(s, on->scene, (mft_algorithm)a, s->options->machine, &result, err);
        if (status == BASE_OK)
            m->rows[m->count++] = mft_row_of(&result, on->name, (mft_algorithm)a);
        if (status == BASE_OK && !s->options->no_pictures)
            status = write_pictures(s, on, m, &result, (mft_algorithm)a, &top, err);
        run_result_destroy(&result);
    }
    m->scenes++;
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    report_page_add_paragraph(s->page, "The scene as its rays hit it, lit by a point at its light's centre, and simulated cycles "
                                       "per pixel of each algorithm, frusta on the scale of their packets.");
    for (size_t i = 0; status == BASE_OK && i < m->scenes; i++) {
        report_figure figures[1 + MFT_ALGORITHMS] = {{m->pictures[i][0], "rendered picture", "rendered picture"}};
        const size_t count = s->options->error > 0 ? 1 : 1 + (size_t)mft_algorithms_measured();
        for (int a = 0; a < mft_algorithms_measured(); a++)
            figures[1 + a] = (report_figure){m->pictures[i][1 + a], "heat map of simulated cycles", mft_algorithm_names[a]};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, count, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[300];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; back faces culled, packets through a BVH "
                                      "of at most %u triangles a leaf, frusta of at most %u.",
             s->width, s->height, s->options->machine->name, s->options->machine->threads,
             kernel_find(mft_kernel(MFT_P_PACKET))->defaults.max_leaf, kernel_find(mft_kernel(MFT_P_FRUSTA))->defaults.max_leaf);
    report_page_add_heading(s->page, 1, "Tables");
    base_status status = suite_add_table(s, "", mft_table1_counts(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-phases", mft_table1_phases(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-reductions", mft_table1_reductions(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-differences", mft_table1_differences(m->rows, m->count), err);
    return status == BASE_OK && !s->options->no_pictures ? add_pictures(s, m, err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_ALGORITHMS, sizeof *m.rows), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.rows && m.pictures ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.pictures);
    return status;
}

const suite_info suite_mft_table1 = {
    .name = "mft-table1",
    .summary = "packets against multi-frusta tracing, core model (Benthin and Wald 2009, Table 1)",
    .title = "MFT Table 1",
    .about = "Table 1 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): packets of 4x4 "
             "rays (P-Packet, S-Packet) against multi-frusta tracing (P-Frusta, S-Frusta), for primary rays (P) and for soft "
             "shadows (S), measured here and as published.",
    .scenes = mft_suite_scenes,
    .size = 1024,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
