#include "reports/views/mlrta_shadows.h"

#include <math.h>

static const char *const found_names[MLRTA_FOUNDS] = {"no bounds: packets start at the root", "nothing in the way", "an entry point"};

static double tests_of(const mlrta_shadows *row, mlrta_algorithm a)
{
    double sum = 0;
    for (int f = 0; f < MLRTA_FOUNDS; f++)
        sum += row->found[f].tests[a];
    return sum;
}

static void add_row(report_table *t, const mlrta_shadows *row, mlrta_found found)
{
    const mlrta_shadow_tests *n = &row->found[found];
    const double *tests = n->tests;
    report_table_begin_row(t);
    report_table_add_text(t, row->scene);
    report_table_add_text(t, found_names[found]);
    report_table_add_real(t, n->tiles);
    report_table_add_real(t, n->packets);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        report_table_add_real(t, n->packets > 0 ? n->cells[a] / n->packets : (double)NAN);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        report_table_add_real(t, n->packets > 0 ? tests[a] / n->packets : (double)NAN);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        report_table_add_real(t, n->packets > 0 ? n->hits[a] / n->packets : (double)NAN);
    report_table_add_real(t, tests[MLRTA_WITHOUT] > 0 ? 100 * (tests[MLRTA_WITH] / tests[MLRTA_WITHOUT] - 1) : (double)NAN);
    report_table_add_real(t, 100 * (tests[MLRTA_WITH] - tests[MLRTA_WITHOUT]) / tests_of(row, MLRTA_WITHOUT));
    report_table_add_real(t, n->more);
}

report_table *mlrta_shadows_table(const mlrta_shadows *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Tests of shadow rays, by what the search of their tile has found");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "found"});
    report_table_add_real_column(t, "tiles", NULL, 0);
    report_table_add_real_column(t, "packets", NULL, 0);
    report_table_add_real_column(t, "cells, no MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "cells, MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "tests, no MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "tests, MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "that block, no MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "that block, MLRT", "per shadow packet", 2);
    report_table_add_real_column(t, "tests, change", "%", 2);
    report_table_add_real_column(t, "tests, change", "% of the scene's", 2);
    report_table_add_real_column(t, "tiles with more tests", NULL, 0);
    for (size_t i = 0; i < count; i++) {
        report_table_begin_group(t, NULL);
        for (int f = 0; f < MLRTA_FOUNDS; f++)
            add_row(t, &rows[i], (mlrta_found)f);
    }
    report_table_add_note(t, "Both ways blocks the same rays. A packet from the root knows of its rays one interval of distances, which is "
                             "wide if they end at different depths, so it enters leaves that none of its rays does. A search culls by "
                             "where the tile's rays are on every axis. Where it finds nothing in the way, all tests from the root are "
                             "of such leaves; at an entry point a packet starts with those rays only that meet its cell, and with their "
                             "interval in it. A tile without bounds starts at the root either way. More tests "
                             "with MLRT would be by luck: a leaf that only packets from the root enter can list a triangle that "
                             "blocks their rays elsewhere, and they are done.");
    return t;
}
