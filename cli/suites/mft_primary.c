/* Suite mft-primary: packets against multi-frusta tracing for primary rays, issue model (Benthin and Wald 2009, Table 1). */
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suite.h"
#include "reports/heat_map.h"
#include "reports/views/packet_frusta.h"
#include "sim/count.h"

/* The pictures that go with a scene's row. */
typedef struct pictures {
    char shaded[SUITE_PATH_BYTES], packet_heat[SUITE_PATH_BYTES], frusta_heat[SUITE_PATH_BYTES];
} pictures;

typedef struct measured {
    packet_frusta_row *rows;
    pictures *pictures;
    size_t count;
} measured;

static packet_frusta_side side_of(const run_result *r)
{
    const uint64_t *n = r->counts.n;
    return (packet_frusta_side){
        .rays = n[KERNEL_rays],
        .tri_accesses = n[KERNEL_tri_accesses],
        .tri_after_culling = n[KERNEL_tri_after_culling],
        .aabb_tests = n[KERNEL_aabb_tests],
        .isect_tests = n[KERNEL_isect_tests],
        .count_cycles = (sim_count_half_cycles(r->machine, r->ops) + 1) / 2,
        .issue_cycles = r->cycles,
    };
}

static base_status run_side(const suite *s, const scene *input, const char *kernel, run_result *result, base_error *err)
{
    run_options options = suite_run_options(s, kernel_find(kernel), RUN_ISSUE);
    options.params.cull_backface = 1; /* as the paper (MFT 5) */
    return run_kernel(input, s->options->machine, &options, result, err);
}

/* The rendered picture, and both heat maps on one scale: the packets', which are the dearer. */
static base_status write_pictures(const suite *s, const suite_scene *on, pictures *p, const run_result *packet, const run_result *frusta,
                                  base_error *err)
{
    report_image image = {0};
    double top = 0;
    suite_path(s, p->shaded, on->stem, ".png");
    suite_path(s, p->packet_heat, on->stem, "-packet16-primary-cycles.png");
    suite_path(s, p->frusta_heat, on->stem, "-mft-primary-cycles.png");
    base_status status = suite_write_picture(p->shaded, picture_shaded(frusta, &image, err), &image, err);
    if (status == BASE_OK)
        status = picture_heat_top(packet, KERNEL_COUNTER_COUNT, &top, err);
    if (status == BASE_OK)
        status = suite_write_picture(p->packet_heat, picture_heat_map(packet, KERNEL_COUNTER_COUNT, top, &image, err), &image, err);
    if (status == BASE_OK)
        status = suite_write_picture(p->frusta_heat, picture_heat_map(frusta, KERNEL_COUNTER_COUNT, top, &image, err), &image, err);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    run_result packet = {0}, frusta = {0};
    base_status status = run_side(s, on->scene, "packet16-primary", &packet, err);
    if (status == BASE_OK)
        status = run_side(s, on->scene, "mft-primary", &frusta, err);
    if (status == BASE_OK) {
        m->rows[m->count] = (packet_frusta_row){on->name, on->triangles, side_of(&packet), side_of(&frusta)};
        if (!s->options->no_pictures)
            status = write_pictures(s, on, &m->pictures[m->count], &packet, &frusta, err);
        m->count++;
    }
    run_result_destroy(&packet);
    run_result_destroy(&frusta);
    return status;
}

static base_status add_pictures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    report_page_add_paragraph(s->page, "Left: the scene as the rays hit it, lit by a point at its light's centre, without shadows. "
                                       "Then simulated cycles per pixel (issue model) of packets and of frusta, on the scale of "
                                       "the packets.");
    for (size_t i = 0; status == BASE_OK && i < m->count; i++) {
        const pictures *p = &m->pictures[i];
        const report_figure figures[] = {
            {p->shaded, "rendered picture", "rendered picture"},
            {p->packet_heat, "heat map of simulated cycles, packets", "packet16-primary: cycles per pixel"},
            {p->frusta_heat, "heat map of simulated cycles, frusta", "mft-primary: cycles per pixel"},
        };
        char heading[SUITE_NAME_BYTES + 40];
        snprintf(heading, sizeof heading, "%s (%llu triangles)", m->rows[i].scene, (unsigned long long)m->rows[i].triangles);
        report_page_add_heading(s->page, 2, heading);
        status = report_page_add_pictures(s->page, figures, 3, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[400];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, back faces culled as in the paper; packets through a BVH of at "
                                      "most %u triangles a leaf, frusta of at most %u.",
             s->width, s->height, s->options->machine->name, kernel_find("packet16-primary")->defaults.max_leaf, kernel_find("mft-primary")->defaults.max_leaf);
    report_page_add_paragraph(s->page, caption);
    report_page_add_heading(s->page, 1, "Tables");
    base_status status = suite_add_table(s, "", packet_frusta_counts(m->rows, m->count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-reductions", packet_frusta_reductions(m->rows, m->count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_pictures(s, m, err);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count, sizeof *m.rows), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.rows && m.pictures ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    free(m.pictures);
    return status;
}

const suite_info suite_mft_primary = {
    .name = "mft-primary",
    .summary = "packets against multi-frusta tracing for primary rays, issue model (Benthin and Wald 2009, Table 1)",
    .title = "packets against multi-frusta tracing",
    .about = "Primary rays of Benthin and Wald's multi-frusta tracing (2009) against packets of 4x4 rays, on a simulated 16-lane "
             "machine. Counts, ops and cycles are functions of scene, image size, kernel and machine alone: every host gives the "
             "same digits.",
    .size = 1024,
    .measure = measure,
};
