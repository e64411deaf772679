/* Suite mft-packet256: packets of 256 rays between packets of 16 and frusta (Benthin and Wald 2009, 5.2), core model. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/suites/mft_runs.h"
#include "reports/views/mft_packet256.h"

enum { KINDS = 2 }; /* primary rays, soft shadows */

/* What a row compares. */
typedef enum tracer { PACKET16, PACKET256, FRUSTA } tracer;

typedef struct way {
    const char *kernel;
    mft_algorithm algorithm; /* as the row's */
    size_t kind;
    tracer tracer;
} way;

static const way dearest_first[] = {
    {"packet16-soft", MFT_S_PACKET, 1, PACKET16},    {"packet256-soft", MFT_S_PACKET, 1, PACKET256},    {"mft-soft", MFT_S_FRUSTA, 1, FRUSTA},
    {"packet16-primary", MFT_P_PACKET, 0, PACKET16}, {"packet256-primary", MFT_P_PACKET, 0, PACKET256}, {"mft-primary", MFT_P_FRUSTA, 0, FRUSTA},
};
enum { WAYS = sizeof dearest_first / sizeof *dearest_first };

typedef struct measured {
    mft_packet256_row *rows; /* by scene, then by kind */
    size_t count;
} measured;

/* Packets of 256 test boxes for groups of packets. */
static base_status take_way(const suite *s, const suite_run_entry *entry, const run_result *result, void *user, base_error *err)
{
    const measured *m = user;
    const way *w = &dearest_first[entry->row];
    mft_packet256_row *row = &m->rows[entry->scene * KINDS + w->kind];
    mft_row *const of_row[] = {[PACKET16] = &row->packet16, [PACKET256] = &row->packet256, [FRUSTA] = &row->frusta};
    (void)err;
    *of_row[w->tracer] = mft_row_of(result, s->scenes[entry->scene].name, w->algorithm);
    if (w->tracer == PACKET256)
        row->boxes = (double)result->counts.n[KERNEL_aabb_group_tests];
    return BASE_OK;
}

static base_status measure_rows(suite *s, measured *m, base_error *err)
{
    suite_runs runs = {0};
    for (size_t i = 0; i < WAYS; i++)
        for (size_t n = 0; n < s->scene_count; n++)
            suite_runs_add(&runs, (suite_run_entry){.scene = n, .row = i, .options = mft_kernel_options(s, dearest_first[i].kernel), .take = take_way});
    return suite_runs_take(s, &runs, m, err);
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
    const size_t count = s->scene_count * KINDS;
    measured m = {.rows = calloc(count, sizeof *m.rows), .count = count};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = measure_rows(s, &m, err);
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
