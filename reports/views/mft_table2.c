#include "reports/views/mft_table2.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "reports/paper.h"

static const double large = 10; /* a change that differs by more percentage points is put into words */

static void add_texts(report_table *t)
{
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "variant"});
    report_table_add_column(t, &(report_column){.name = "basis"});
}

static void begin(report_table *t, const char *scene, size_t shrink, const char *basis)
{
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, mft_shrink_names[shrink]);
    report_table_add_text(t, basis);
}

static void add_doubt(report_table *t, size_t shrink)
{
    const mft_paper_row row = mft_paper_shrink_row(shrink);
    report_table_add_text(t, *row.doubt ? row.doubt : NULL);
}

static void add_measured(report_table *t, const mft_shrink_row *row)
{
    begin(t, row->scene, row->shrink, "measured");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, row->value[m]);
    report_table_add_real(t, row->additional);
    report_table_add_real(t, row->additional16);
    report_table_add_real(t, row->frame);
    report_table_add_real(t, row->half_width > 0 ? 100 * row->half_width : (double)NAN);
}

static void add_published(report_table *t, size_t shrink)
{
    const mft_paper_row row = mft_paper_shrink_row(shrink);
    begin(t, mft_scenes[0].name, shrink, "published");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, row.value[m]);
    report_table_add_real(t, mft_paper_additional_tests(shrink));
    for (int i = 0; i < 3; i++)
        report_table_add_missing(t);
    add_doubt(t, shrink);
}

static double change(double value, double from) { return 100 * (value / from - 1); }

/* The row of the same scene without shrinking. */
static const mft_shrink_row *unshrunk(const mft_shrink_row *row) { return row - row->shrink; }

static void add_measured_change(report_table *t, const mft_shrink_row *row)
{
    const mft_shrink_row *none = unshrunk(row);
    begin(t, row->scene, row->shrink, "measured");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, change(row->value[m], none->value[m]));
    report_table_add_real(t, change(row->frame, none->frame));
}

static void add_published_change(report_table *t, size_t shrink)
{
    begin(t, mft_scenes[0].name, shrink, "published");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, mft_paper_shrink_change(shrink, (mft_metric)m));
    report_table_add_missing(t);
    add_doubt(t, shrink);
}

typedef void measured_fn(report_table *t, const mft_shrink_row *row);
typedef void published_fn(report_table *t, size_t shrink);

/* Variants from number `first` on, each with the published one below it if the scene stands in for the paper's. */
static void add_rows(report_table *t, const mft_shrink_row *rows, size_t count, size_t first, measured_fn *measured,
                     published_fn *published)
{
    bool beside = false;
    for (size_t i = 0; i < count; i++) {
        const bool stands_in = mft_scene_of(rows[i].scene) == 0;
        if (rows[i].shrink == 0)
            report_table_begin_group(t, rows[i].scene);
        if (rows[i].shrink < first)
            continue;
        measured(t, &rows[i]);
        if (stands_in)
            published(t, rows[i].shrink);
        beside = beside || stands_in;
    }
    if (!beside)
        report_table_begin_group(t, "published, not measured here");
    for (size_t shrink = first; !beside && shrink < MFT_SHRINKS; shrink++)
        published(t, shrink);
}

report_table *mft_table2_counts(const mft_shrink_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("MFT Table 2: shadow rays only, measured, and published by Benthin and Wald 2009");
    report_table_set_caption(t, caption);
    add_texts(t);
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], NULL, 0);
    report_table_add_real_column(t, "additional tests", NULL, 0);
    report_table_add_real_column(t, "16-lane additional tests", NULL, 0);
    report_table_add_real_column(t, "cycles of the frame", NULL, 0);
    report_table_add_real_column(t, "95% interval", "+-%", 2);
    report_table_add_column(t, &(report_column){.name = "doubtful readings"});
    add_rows(t, rows, count, 0, add_measured, add_published);
    report_table_add_note(
        t, "Measured: what the frame with soft shadows has more than the frame with its primary rays alone (mft-primary); so the "
           "cycles hold the shading as well. Additional tests: frusta whose corner rays, or corner rays and intervals, were "
           "formed anew. 16-lane additional tests: computations that served them, one a leaf. AABB tests of Ray-AABB hold its "
           "tests of rays against the boxes of leaves.");
    report_table_add_note(
        t,
        "Published counts are of T-Rex at 1024x1024 pixels and rounded to thousands; Table 2 has no cycles. Doubtful readings: "
        "the count and the change that the copy of the paper at hand prints do not agree (reports/papers/mft_table2.csv says "
        "why).");
    return t;
}

report_table *mft_table2_changes(const mft_shrink_row *rows, size_t count, const char *caption)
{
    char words[300];
    report_table *t = report_table_create("Changes against no shrinking");
    report_table_set_caption(t, caption);
    add_texts(t);
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], "%", 1);
    report_table_add_real_column(t, "cycles of the frame", "%", 1);
    report_table_add_column(t, &(report_column){.name = "doubtful readings"});
    add_rows(t, rows, count, 1, add_measured_change, add_published_change);
    snprintf(
        words, sizeof words,
        "Published changes are as printed. Of cycles the paper says only that CR makes T-Rex at most %.0f %% faster as a whole "
        "(5.3).",
        report_paper_find("mft_text", "T-Rex", "CR", "overall_speedup_at_most"));
    report_table_add_note(t, words);
    return t;
}

/* Intersection tests that are saved by an additional AABB test. */
static double saved_by_test(const double value[MFT_METRICS], const double none[MFT_METRICS])
{
    return (none[MFT_ISECT] - value[MFT_ISECT]) / (value[MFT_AABB] - none[MFT_AABB]);
}

static void add_difference(report_table *t, const mft_shrink_row *row, mft_metric metric)
{
    char words[400];
    const double mine = change(row->value[metric], unshrunk(row)->value[metric]),
                 theirs = mft_paper_shrink_change(row->shrink, metric);
    const mft_paper_row paper = mft_paper_shrink_row(0);
    const double mine_shrunk = row->additional / unshrunk(row)->value[MFT_ISECT];
    const double their_shrunk = mft_paper_additional_tests(row->shrink) / paper.value[MFT_ISECT];
    if (!(fabs(mine - theirs) > large))
        return;
    report_table_begin_row(t);
    report_table_add_text(t, row->scene);
    report_table_add_text(t, mft_shrink_names[row->shrink]);
    report_table_add_text(t, mft_metric_names[metric]);
    report_table_add_real(t, mine);
    report_table_add_real(t, theirs);
    if (isfinite(their_shrunk))
        snprintf(words, sizeof words,
                 "a frustum shrinks %.3f times for each intersection test without shrinking, in the paper %.3f; a triangle after "
                 "culling meets %.1f frusta, in the paper %.1f",
                 mine_shrunk, their_shrunk, unshrunk(row)->value[MFT_ISECT] / unshrunk(row)->value[MFT_CULLED],
                 paper.value[MFT_ISECT] / paper.value[MFT_CULLED]);
    else
        snprintf(words, sizeof words, "a test of rays against the box of a leaf saves %.2f intersection tests, in the paper %.2f",
                 saved_by_test(row->value, unshrunk(row)->value),
                 saved_by_test(mft_paper_shrink_row(row->shrink).value, paper.value));
    report_table_add_text(t, words);
}

report_table *mft_table2_differences(const mft_shrink_row *rows, size_t count)
{
    report_table *t = report_table_create("Where changes differ");
    report_table_set_caption(t, "Changes that are more than 10 percentage points from the published ones.");
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "variant"});
    report_table_add_column(t, &(report_column){.name = "event"});
    report_table_add_real_column(t, "measured", "%", 1);
    report_table_add_real_column(t, "published", "%", 1);
    report_table_add_column(t, &(report_column){.name = "in words"});
    for (size_t i = 0; i < count; i++)
        for (int m = 0; m < MFT_CYCLES && rows[i].shrink > 0 && mft_scene_of(rows[i].scene) == 0; m++)
            add_difference(t, &rows[i], (mft_metric)m);
    return t;
}
