/* Suite mft-packet256: packets of 256 rays between packets of 16 and frusta (Benthin and Wald 2009, 5.2), core model. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mft_runs.h"
#include "reports/views/mft_packet256.h"

enum { KINDS = 2 }; /* primary rays, soft shadows */

typedef struct measured {
    mft_packet256_row *rows;
    size_t count;
} measured;

/* A kernel's run as a row; `boxes` if it tests them for groups of packets. */
static base_status measure_kernel(const suite *s, const suite_scene *on, const char *kernel, mft_algorithm algorithm, mft_row *row,
                                  double *boxes, base_error *err)
{
    run_result result = {0};
    const run_options options = mft_kernel_options(s, kernel);
    base_status status = run_kernel(on->scene, s->options->machine, &options, &result, err);
    if (status == BASE_OK)
        *row = mft_row_of(&result, on->name, algorithm);
    if (status == BASE_OK && boxes)
        *boxes = (double)result.counts.n[KERNEL_aabb_group_tests];
    run_result_destroy(&result);
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    static const char *const large[KINDS] = {"packet256-primary", "packet256-soft"};
    static const mft_algorithm packets[KINDS] = {MFT_P_PACKET, MFT_S_PACKET}, frusta[KINDS] = {MFT_P_FRUSTA, MFT_S_FRUSTA};
    measured *m = user;
    base_status status = BASE_OK;
    for (int kind = 0; status == BASE_OK && kind < KINDS; kind++) {
        mft_packet256_row *row = &m->rows[m->count++];
        status = measure_kernel(s, on, mft_kernel(packets[kind]), packets[kind], &row->packet16, NULL, err);
        if (status == BASE_OK)
            status = measure_kernel(s, on, large[kind], packets[kind], &row->packet256, &row->boxes, err);
        if (status == BASE_OK)
            status = measure_kernel(s, on, mft_kernel(frusta[kind]), frusta[kind], &row->frusta, NULL, err);
    }
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[300];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, core model, %u threads; back faces culled; packets of 16 through a BVH of "
                                      "at most %u triangles a leaf, packets of 256 and frusta through one of at most %u.",
             s->width, s->height, s->options->machine->name, s->options->machine->threads,
             kernel_find(mft_kernel(MFT_P_PACKET))->defaults.max_leaf, kernel_find(mft_kernel(MFT_P_FRUSTA))->defaults.max_leaf);
    base_status status = suite_add_table(s, "-ratios", mft_packet256_ratios(m->rows, m->count, caption), err);
    return status == BASE_OK ? suite_add_table(s, "", mft_packet256_counts(m->rows, m->count, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * KINDS, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    free(m.rows);
    return status;
}

static const char *const scenes[] = {"builtin:creature-69k", "builtin:hall-60k", NULL};

const suite_info suite_mft_packet256 = {
    .name = "mft-packet256",
    .summary = "packets of 256 rays against frusta and packets of 16, core model (Benthin and Wald 2009, 5.2)",
    .title = "MFT and packets of 256 rays",
    .about = "Section 5.2 of Benthin and Wald's 'Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing' (2009): the same tree, the "
             "same culling and the same leaves as multi-frusta tracing, but boxes are tested against 256 rays, packet by packet of 16, "
             "instead of against 16 frusta.",
    .scenes = scenes,
    .size = 256,
    .takes = SUITE_TAKES_ERROR,
    .measure = measure,
};
