#include "reports/views/mlrta_params.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_row(report_table *t, const mlrta_params_row *row, const mlrta_params_row *defaults)
{
    const mlrta_counts *without = &row->counted.counts[MLRTA_WITHOUT], *with = &row->counted.counts[MLRTA_WITH];
    const mlrta_counts *base = defaults->counted.counts;
    const double packets = row->counted.packets;
    report_table_begin_row(t);
    report_table_add_text(t, row->counted.scene);
    report_table_add_text(t, row->kind);
    report_table_add_text(t, row->setting);
    report_table_add_real(t, row->nodes);
    for (int a = 0; a < MLRTA_ALGORITHMS; a++) {
        report_table_add_real(t, row->cycles[a] / 1e6);
        report_table_add_real(t, 100 * (row->cycles[a] / defaults->cycles[a] - 1));
    }
    report_table_add_real(t, without->cells / packets);
    report_table_add_real(t, 100 * (without->cells / base[MLRTA_WITHOUT].cells - 1));
    report_table_add_real(t, with->cells / packets);
    report_table_add_real(t, 100 * (with->cells / base[MLRTA_WITH].cells - 1));
    report_table_add_real(t, without->cells / with->cells);
    report_table_add_real(t, 100 * with->ep_cells / with->cells);
    report_table_add_real(t, with->tests / packets);
    report_table_add_real(t, 100 * (with->tests / base[MLRTA_WITH].tests - 1));
}

report_table *mlrta_params_table(const mlrta_params_row *rows, size_t count, const char *caption)
{
    char note[600];
    report_table *t = report_table_create("Parameters of multi-level ray tracing and of its tree");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "varied"});
    report_table_add_column(t, &(report_column){.name = "setting"});
    report_table_add_real_column(t, "tree nodes", NULL, 0);
    report_table_add_real_column(t, "cycles, no MLRT", "million", 1);
    report_table_add_real_column(t, "no MLRT, cycles against defaults", "%", 1);
    report_table_add_real_column(t, "cycles, MLRT", "million", 1);
    report_table_add_real_column(t, "MLRT, cycles against defaults", "%", 1);
    report_table_add_real_column(t, "cells, no MLRT", "per packet", 2);
    report_table_add_real_column(t, "no MLRT, against defaults", "%", 1);
    report_table_add_real_column(t, "cells, MLRT", "per packet", 2);
    report_table_add_real_column(t, "MLRT, against defaults", "%", 1);
    report_table_add_real_column(t, "reduction", NULL, 2);
    report_table_add_real_column(t, "EP share", "%", 1);
    report_table_add_real_column(t, "tests, MLRT", "per packet", 2);
    report_table_add_real_column(t, "tests, against defaults", "%", 1);
    const mlrta_params_row *defaults = rows;
    for (size_t i = 0; i < count; i++) {
        if (i && strcmp(rows[i].kind, rows[i - 1].kind) != 0)
            report_table_begin_group(t, NULL);
        if (rows[i].counted.scene != defaults->counted.scene)
            defaults = &rows[i];
        add_row(t, &rows[i], defaults);
    }
    snprintf(note, sizeof note, "Published: initial tiles of %.0f pixels an edge, split into %.0f, were the best of 2,500 models, and all "
                                "were within %.0f%% in speed; rules 1 to 3 of the tree are worth %.0f%% in traversal against a purely "
                                "area-based build.",
             mlrta_paper_text("all", "tile splitting", "best_initial_tile_size"), mlrta_paper_text("all", "tile splitting", "best_split_factor"),
             mlrta_paper_text("all", "tile splitting", "performance_variation"),
             mlrta_paper_text("all", "kd-tree rules 1-3", "traversal_performance_gain"));
    report_table_add_note(t, note);
    report_table_add_note(t, "Cells are inner nodes and leaves. A setting that packets from the root do not have leaves their columns "
                             "as they are. All settings hit the same; only the work differs.");
    return t;
}

/* In percent, less 100: the geometric mean over the scenes of a setting's count or cycles over those of the defaults. */
static double mean_change(const mlrta_params_row *rows, size_t scenes, size_t settings, size_t setting, mlrta_algorithm a, bool cycles)
{
    double sum = 0;
    for (size_t i = 0; i < scenes; i++) {
        const mlrta_params_row *defaults = &rows[i * settings], *row = &defaults[setting];
        sum += cycles ? log(row->cycles[a] / defaults->cycles[a]) : log(row->counted.counts[a].cells / defaults->counted.counts[a].cells);
    }
    return 100 * (exp(sum / (double)scenes) - 1);
}

report_table *mlrta_params_means(const mlrta_params_row *rows, size_t scenes, size_t settings, const char *caption)
{
    report_table *t = report_table_create("What settings change against the defaults, means over the scenes");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "varied"});
    report_table_add_column(t, &(report_column){.name = "setting"});
    report_table_add_real_column(t, "cycles, MLRT", "%", 1);
    report_table_add_real_column(t, "cycles, no MLRT", "%", 1);
    report_table_add_real_column(t, "cells, MLRT", "%", 1);
    report_table_add_real_column(t, "cells, no MLRT", "%", 1);
    for (size_t i = 1; i < settings; i++) {
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].kind);
        report_table_add_text(t, rows[i].setting);
        for (int cells = 0; cells < 2; cells++) {
            report_table_add_real(t, mean_change(rows, scenes, settings, i, MLRTA_WITH, !cells));
            report_table_add_real(t, mean_change(rows, scenes, settings, i, MLRTA_WITHOUT, !cells));
        }
    }
    report_table_add_note(t, "Geometric means of the quotients, less 1. What is below 0 takes less than the defaults do.");
    return t;
}

/* The curve of a row, a new one if it is the first of its scene and split factor. */
static mlrta_params_curve *curve_of(mlrta_params_plot *plot, const mlrta_params_row *row)
{
    for (size_t i = 0; i < plot->count; i++)
        if (plot->curves[i].scene == row->counted.scene && plot->curves[i].parts == row->parts)
            return &plot->curves[i];
    mlrta_params_curve *curve = &plot->curves[plot->count++];
    curve->scene = row->counted.scene;
    curve->parts = row->parts;
    snprintf(curve->name, sizeof curve->name, "%s, split into %u", row->counted.scene, row->parts);
    return curve;
}

/* Keep the points of a curve in order of their edges. */
static void add_point(mlrta_params_curve *curve, const mlrta_params_row *row)
{
    const mlrta_counts *n = row->counted.counts;
    size_t at = curve->count++;
    for (; at && curve->least[at - 1] > row->least; at--) {
        curve->least[at] = curve->least[at - 1];
        curve->reduction[at] = curve->reduction[at - 1];
    }
    curve->least[at] = row->least;
    curve->reduction[at] = n[MLRTA_WITHOUT].cells / n[MLRTA_WITH].cells;
}

base_status mlrta_params_plot_create(const mlrta_params_row *rows, size_t count, mlrta_params_plot *out, base_error *err)
{
    size_t places = 0;
    for (size_t i = 0; i < count; i++)
        places += rows[i].parts > 0;
    *out = (mlrta_params_plot){.curves = calloc(places + 1, sizeof *out->curves), .series = calloc(places + 1, sizeof *out->series)};
    if (!out->curves || !out->series)
        return base_fail(err, BASE_ERR_NOMEM, "plot", "out of memory for %zu points", places);
    for (size_t i = 0; i < count; i++)
        if (rows[i].parts)
            add_point(curve_of(out, &rows[i]), &rows[i]);
    for (size_t i = 0; i < out->count; i++) {
        const mlrta_params_curve *curve = &out->curves[i];
        out->series[i] = (report_series){.name = curve->name, .x = curve->least, .y = curve->reduction, .count = curve->count, .line = REPORT_LINE_POINTS};
    }
    return BASE_OK;
}

void mlrta_params_plot_destroy(mlrta_params_plot *plot)
{
    free(plot->curves);
    free(plot->series);
    *plot = (mlrta_params_plot){0};
}
