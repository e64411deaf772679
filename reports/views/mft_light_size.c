#include "reports/views/mft_light_size.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void begin_scene(report_table *t, const mft_light_row *rows, size_t i)
{
    if (!i || strcmp(rows[i - 1].packet.scene, rows[i].packet.scene) != 0)
        report_table_begin_group(t, rows[i].packet.scene);
}

static void add_run(report_table *t, const mft_light_row *row, const mft_row *run)
{
    report_table_begin_row(t);
    report_table_add_text(t, run->scene);
    report_table_add_real(t, row->scale);
    report_table_add_text(t, mft_algorithm_names[run->algorithm]);
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, run->value[m]);
    report_table_add_real(t, run->value[MFT_CYCLES] / run->pixels);
    report_table_add_real(t, 100 * run->memory);
    report_table_add_real(t, row->rays);
    report_table_add_real(t, 100 * row->penumbra);
    report_table_add_real(t, run->half_width > 0 ? 100 * run->half_width : (double)NAN);
}

report_table *mft_light_size_counts(const mft_light_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Soft shadows by the size of the light");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_real_column(t, "light scale", NULL, 3);
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], NULL, 0);
    report_table_add_real_column(t, "cycles per pixel", NULL, 1);
    report_table_add_real_column(t, "memory", "% of cycles", 1);
    report_table_add_real_column(t, "shadow rays", NULL, 0);
    report_table_add_real_column(t, "penumbra", "% of pixels", 1);
    report_table_add_real_column(t, "95% interval", "+-%", 2);
    for (size_t i = 0; i < count; i++) {
        begin_scene(t, rows, i);
        add_run(t, &rows[i], &rows[i].packet);
        add_run(t, &rows[i], &rows[i].frusta);
    }
    report_table_add_note(
        t,
        "Counts and cycles are of the whole frame, primary rays among them, as in Table 1 of the paper. Light scale: the light's "
        "edges are those of the scene times this, about its centre. Penumbra: pixels for which some of the light's samples are "
        "blocked and some are not.");
    return t;
}

static void add_ratios(report_table *t, const double packet[MFT_METRICS], const double frusta[MFT_METRICS])
{
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, packet[m] / frusta[m]);
}

/* The published rows of soft shadows, whose light is of a size that the paper does not give. */
static void add_published(report_table *t)
{
    report_table_begin_group(t, "published, Table 1");
    for (size_t scene = 0; scene < MFT_SCENES; scene++) {
        const mft_paper_row packet = mft_paper_row_of(scene, MFT_S_PACKET), frusta = mft_paper_row_of(scene, MFT_S_FRUSTA);
        char doubt[2 * MFT_DOUBT_BYTES + 2];
        report_table_begin_row(t);
        report_table_add_text(t, mft_scenes[scene].name);
        report_table_add_missing(t);
        add_ratios(t, packet.value, frusta.value);
        report_table_add_missing(t);
        snprintf(doubt, sizeof doubt, "%s%s%s", packet.doubt, *packet.doubt && *frusta.doubt ? "; " : "", frusta.doubt);
        report_table_add_text(t, *doubt ? doubt : NULL);
    }
}

report_table *mft_light_size_reductions(const mft_light_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Packets / frusta by the size of the light");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_real_column(t, "light scale", NULL, 3);
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], NULL, 2);
    report_table_add_real_column(t, "penumbra", "% of pixels", 1);
    report_table_add_column(t, &(report_column){.name = "doubtful readings"});
    for (size_t i = 0; i < count; i++) {
        begin_scene(t, rows, i);
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].packet.scene);
        report_table_add_real(t, rows[i].scale);
        add_ratios(t, rows[i].packet.value, rows[i].frusta.value);
        report_table_add_real(t, 100 * rows[i].penumbra);
    }
    add_published(t);
    report_table_add_note(
        t, "Figure 6 of the paper is a plot without numbers, so it cannot be set beside ours; the published rows are those of "
           "Table 1, under lights whose size the paper does not give. Doubtful readings: the copy of the paper at hand is "
           "damaged there (reports/papers/mft_table1.csv says why).");
    return t;
}

static void fill(mft_light_series *s, const mft_light_row *rows, size_t scales, mft_metric metric)
{
    double *x = s->numbers + 2 * s->count * scales, *y = x + scales;
    char *name = s->names[s->count];
    snprintf(name, MFT_LIGHT_NAME_BYTES, "%s, %s", rows->packet.scene, mft_metric_names[metric]);
    for (size_t i = 0; i < scales; i++) {
        x[i] = rows[i].scale;
        y[i] = rows[i].packet.value[metric] / rows[i].frusta.value[metric];
    }
    s->series[s->count++] = (report_series){.name = name, .x = x, .y = y, .count = scales, .line = REPORT_LINE_POINTS};
}

base_status mft_light_series_create(const mft_light_row *rows, size_t count, size_t scales, mft_light_series *out, base_error *err)
{
    static const mft_metric shown[] = {MFT_CYCLES, MFT_AABB};
    const size_t metrics = sizeof shown / sizeof *shown, most = metrics * (count / scales) + 1;
    *out = (mft_light_series){.series = calloc(most, sizeof *out->series),
                              .numbers = calloc(2 * scales * most, sizeof *out->numbers),
                              .names = calloc(most, sizeof *out->names)};
    if (!out->series || !out->numbers || !out->names)
        return base_fail(err, BASE_ERR_NOMEM, "plot", "out of memory");
    for (size_t i = 0; i < count; i += scales)
        for (size_t m = 0; m < metrics; m++)
            fill(out, rows + i, scales, shown[m]);
    return BASE_OK;
}

void mft_light_series_destroy(mft_light_series *s)
{
    free(s->series);
    free(s->numbers);
    free(s->names);
    *s = (mft_light_series){0};
}
