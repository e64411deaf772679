#include "reports/views/mft_packet256.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *rays_of(const mft_packet256_row *row)
{
    return row->packet16.algorithm == MFT_P_PACKET ? "primary" : "primary and shadow";
}

static void begin_scene(report_table *t, const mft_packet256_row *rows, size_t i)
{
    if (!i || strcmp(rows[i - 1].frusta.scene, rows[i].frusta.scene) != 0)
        report_table_begin_group(t, rows[i].frusta.scene);
}

static void add_run(report_table *t, const mft_row *run, const char *algorithm, double boxes)
{
    report_table_begin_row(t);
    report_table_add_text(t, run->scene);
    report_table_add_text(t, algorithm);
    for (int m = 0; m < MFT_METRICS; m++) {
        if (m == MFT_AABB)
            report_table_add_real(t, boxes);
        report_table_add_real(t, run->value[m]);
    }
    report_table_add_real(t, run->value[MFT_CYCLES] / run->pixels);
    report_table_add_real(t, 100 * run->memory);
    report_table_add_real(t, run->half_width > 0 ? 100 * run->half_width : (double)NAN);
}

report_table *mft_packet256_counts(const mft_packet256_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Packets of 16 rays, packets of 256, frusta");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    for (int m = 0; m < MFT_METRICS; m++) {
        if (m == MFT_AABB)
            report_table_add_real_column(t, "boxes", NULL, 0);
        report_table_add_real_column(t, mft_metric_names[m], NULL, 0);
    }
    report_table_add_real_column(t, "cycles per pixel", NULL, 1);
    report_table_add_real_column(t, "memory", "% of cycles", 1);
    report_table_add_real_column(t, "95% interval", "+-%", 2);
    for (size_t i = 0; i < count; i++) {
        const char *kind = rows[i].packet16.algorithm == MFT_P_PACKET ? "P" : "S";
        char large[40];
        begin_scene(t, rows, i);
        snprintf(large, sizeof large, "%s-Packet, 256 rays", kind);
        add_run(t, &rows[i].packet16, mft_algorithm_names[rows[i].packet16.algorithm], rows[i].packet16.value[MFT_AABB]);
        add_run(t, &rows[i].packet256, large, rows[i].boxes);
        add_run(t, &rows[i].frusta, mft_algorithm_names[rows[i].frusta.algorithm], rows[i].frusta.value[MFT_AABB]);
    }
    report_table_add_note(t, "Boxes: tested for a packet of 16 rays, a packet of 256 or a group of 16 frusta. AABB tests: of 16 lanes; a "
                             "box takes one for a packet of 16 or a group of frusta, and one for each of its up to 16 packets of 16 in "
                             "a packet of 256. Rows S hold the primary rays as well, as in Table 1 of the paper.");
    return t;
}

/* What the paper says of all its scenes. */
static void add_published(report_table *t)
{
    const char *scenes = "all 4 scenes", *algorithm = "256-ray packet";
    char below[80], speed[60];
    snprintf(below, sizeof below, "%g%% to %g%% fewer", report_paper_find("mft_text", scenes, algorithm, "aabb_tests_below_mft_min"),
             report_paper_find("mft_text", scenes, algorithm, "aabb_tests_below_mft_max"));
    snprintf(speed, sizeof speed, "at most %g%%",
             report_paper_find("mft_text", scenes, algorithm, "performance_relative_to_mft_at_most"));
    report_table_begin_group(t, "published, in words (5.2)");
    report_table_begin_row(t);
    report_table_add_text(t, scenes);
    report_table_add_missing(t);
    report_table_add_text(t, below);
    report_table_add_missing(t);
    report_table_add_text(t, speed);
    report_table_add_text(t, "sometimes slower");
}

/* "3.4% fewer". */
static void add_fewer(report_table *t, double ours, double theirs)
{
    char text[60];
    const double percent = 100 * (ours / theirs - 1);
    snprintf(text, sizeof text, "%.1f%% %s", fabs(percent), percent <= 0 ? "fewer" : "more");
    report_table_add_text(t, text);
}

/* Speed is the inverse of cycles. */
static void add_speed(report_table *t, const mft_row *ours, const mft_row *theirs)
{
    char text[60];
    snprintf(text, sizeof text, "%.0f%%", 100 * theirs->value[MFT_CYCLES] / ours->value[MFT_CYCLES]);
    report_table_add_text(t, text);
}

report_table *mft_packet256_ratios(const mft_packet256_row *rows, size_t count, const char *caption)
{
    static const char *const columns[] = {"boxes against frusta", "AABB tests against frusta", "speed against frusta",
                                          "speed against packets of 16"};
    report_table *t = report_table_create("Packets of 256 rays, measured and as the paper has them");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "rays"});
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        report_table_add_column(t, &(report_column){.name = columns[i], .align = REPORT_ALIGN_RIGHT});
    for (size_t i = 0; i < count; i++) {
        const mft_packet256_row *row = &rows[i];
        char tests[60];
        begin_scene(t, rows, i);
        report_table_begin_row(t);
        report_table_add_text(t, row->frusta.scene);
        report_table_add_text(t, rays_of(row));
        add_fewer(t, row->boxes, row->frusta.value[MFT_AABB]);
        snprintf(tests, sizeof tests, "%.2f times", row->packet256.value[MFT_AABB] / row->frusta.value[MFT_AABB]);
        report_table_add_text(t, tests);
        add_speed(t, &row->packet256, &row->frusta);
        add_speed(t, &row->packet256, &row->packet16);
    }
    add_published(t);
    report_table_add_note(t, "The paper's 'fewer AABB tests' can only mean boxes, each of which frusta test once: by tests of 16 lanes a "
                             "packet of 256 rays needs several times as many. The paper gives no table of these packets, only its words.");
    return t;
}
