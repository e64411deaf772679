/* Suite mft-table1: Table 1 of Benthin and Wald 2009 with the cycles of the core model, beside the published rows. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mft_runs.h"

/* Pictures of a scene: rendered, then a heat map by algorithm. */
typedef struct pictures {
    char paths[1 + MFT_ALGORITHMS][SUITE_PATH_BYTES];
    double top; /* of the scale of the heat maps: that of the packets whose frusta are next */
} pictures;

typedef struct measured {
    mft_row *rows; /* by scene, then by algorithm */
    pictures *pictures; /* by scene */
} measured;

/* The rendered picture with the last algorithm, which has shadows. Heat maps share the scale of the packets before them, which are the
   dearer; cycles of pixels are known only if all tiles were simulated. */
static base_status write_pictures(const suite *s, const suite_scene *on, pictures *p, const run_result *r, mft_algorithm a, base_error *err)
{
    char rest[60];
    report_image image = {0};
    base_status status = BASE_OK;
    if (a == MFT_S_FRUSTA) {
        suite_path(s, p->paths[0], on->stem, ".png");
        status = suite_write_picture(p->paths[0], picture_shaded(r, &image, err), &image, err);
    }
    if (status != BASE_OK || s->options->error > 0)
        return status;
    snprintf(rest, sizeof rest, "-%s-core-cycles.png", mft_kernel(a));
    suite_path(s, p->paths[1 + a], on->stem, rest);
    if (a % 2 == 0)
        status = picture_heat_top(r, KERNEL_COUNTER_COUNT, &p->top, err);
    if (status == BASE_OK)
        status = suite_write_picture(p->paths[1 + a], picture_heat_map(r, KERNEL_COUNTER_COUNT, p->top, &image, err), &image, err);
    return status;
}

static base_status take_row(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    measured *m = user;
    const suite_scene *on = &s->scenes[entry->scene];
    const mft_algorithm a = (mft_algorithm)(entry->row % (size_t)mft_algorithms_measured());
    m->rows[entry->row] = mft_row_of(result, on->name, a);
    return s->options->no_pictures ? BASE_OK : write_pictures(s, on, &m->pictures[entry->scene], result, a, err);
}

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    static const mft_algorithm dearest_first[MFT_ALGORITHMS] = {MFT_S_PACKET, MFT_S_FRUSTA, MFT_P_PACKET, MFT_P_FRUSTA};
    const int algorithms = mft_algorithms_measured();
    suite_runs runs = {0};
    for (int i = 0; i < MFT_ALGORITHMS; i++)
        for (size_t n = 0; (int)dearest_first[i] < algorithms && n < s->scene_count; n++)
            suite_runs_add(&runs, (suite_run_entry){.scene = n, .row = n * (size_t)algorithms + dearest_first[i],
                                                    .options = mft_run_options(s, dearest_first[i]), .take = take_row});
    return suite_runs_take(s, &runs, m, err);
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    report_page_add_paragraph(s->page, "The scene as its rays hit it, lit by a point at its light's centre, and simulated cycles "
                                       "per pixel of each algorithm, frusta on the scale of their packets.");
    for (size_t i = 0; status == BASE_OK && i < s->scene_count; i++) {
        report_figure figures[1 + MFT_ALGORITHMS] = {{m->pictures[i].paths[0], "rendered picture", "rendered picture"}};
        const size_t count = s->options->error > 0 ? 1 : 1 + (size_t)mft_algorithms_measured();
        for (int a = 0; a < mft_algorithms_measured(); a++)
            figures[1 + a] = (report_figure){m->pictures[i].paths[1 + a], "heat map of simulated cycles", mft_algorithm_names[a]};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, count, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    const size_t count = s->scene_count * (size_t)mft_algorithms_measured();
    char caption[300];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; back faces culled, packets through a BVH "
                                      "of at most %u triangles a leaf, frusta of at most %u.",
             s->width, s->height, s->options->machine->name, s->options->machine->threads,
             kernel_find(mft_kernel(MFT_P_PACKET))->defaults.max_leaf, kernel_find(mft_kernel(MFT_P_FRUSTA))->defaults.max_leaf);
    report_page_add_heading(s->page, 1, "Tables");
    base_status status = suite_add_table(s, "", mft_table1_counts(m->rows, count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-phases", mft_table1_phases(m->rows, count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-reductions", mft_table1_reductions(m->rows, count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-differences", mft_table1_differences(m->rows, count), err);
    return status == BASE_OK && !s->options->no_pictures ? add_pictures(s, m, err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * MFT_ALGORITHMS, sizeof *m.rows), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.rows && m.pictures ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
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
