#include "reports/views/mlrta_culling.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static void add_row(report_table *t, const mlrta_culling_row *row, const mlrta_culling_row *inverse)
{
    const mlrta_counts *c = &row->counts, *base = &inverse->counts;
    report_table_begin_row(t);
    report_table_add_text(t, row->scene);
    report_table_add_text(t, row->tiles);
    report_table_add_text(t, row->culling);
    report_table_add_real(t, c->ep_cells / row->packets);
    report_table_add_real(t, 100 * (c->ep_cells / base->ep_cells - 1));
    report_table_add_real(t, c->cells / row->packets);
    report_table_add_real(t, 100 * (c->cells / base->cells - 1));
    report_table_add_real(t, c->tests / row->packets);
    report_table_add_integer(t, (int64_t)row->hits);
    report_table_add_integer(t, (int64_t)row->lost);
}

static bool same_group(const mlrta_culling_row *a, const mlrta_culling_row *b)
{
    return strcmp(a->scene, b->scene) == 0 && strcmp(a->tiles, b->tiles) == 0;
}

report_table *mlrta_culling_table(const mlrta_culling_row *rows, size_t count, const char *caption)
{
    char note[400];
    report_table *t = report_table_create("Ways to cull in entry-point searches");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "tiles"});
    report_table_add_column(t, &(report_column){.name = "culling"});
    report_table_add_real_column(t, "EP steps", "per packet", 3);
    report_table_add_real_column(t, "EP steps, against inverse", "%", 1);
    report_table_add_real_column(t, "traversed cells", "per packet", 2);
    report_table_add_real_column(t, "cells, against inverse", "%", 1);
    report_table_add_real_column(t, "intersection tests", "per packet", 2);
    report_table_add_column(t, &(report_column){.name = "hits", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "lost hits", .kind = REPORT_INTEGER});
    const mlrta_culling_row *inverse = rows;
    for (size_t i = 0; i < count; i++) {
        if (i && !same_group(&rows[i], inverse)) {
            report_table_begin_group(t, NULL);
            inverse = &rows[i];
        }
        add_row(t, &rows[i], inverse);
    }
    snprintf(note, sizeof note, "Published: direct culling takes about %.0f%% more EP steps than the inverse method.",
             mlrta_paper_text("all", "direct frustum culling", "ep_steps_increase"));
    report_table_add_note(t, note);
    report_table_add_note(t, "A hit is lost if a pixel's nearest triangle or its distance is not that of packets from the root. "
                             "Corner rays visit a cell if one of the tile's four does: a cell between them is passed over, and what "
                             "it holds is lost (Figure 2 of the paper). Fewer steps are no merit there. EP steps are nodes, leaves too.");
    return t;
}
