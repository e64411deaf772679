#include "reports/views/mft_quality.h"

#include <math.h>
#include <stdio.h>

#include "reports/paper.h"

const unsigned mft_quality_samples[MFT_QUALITY_SAMPLES] = {4, 16, 64, 256};
static const char *const region_names[MFT_REGIONS] = {"inside penumbrae", "outside"};
static const char *const way_names[4] = {"one set", "one set, filtered", "interleaved", "interleaved, filtered"};

void mft_errors_of(const float *seen, const float *reference, const unsigned char *mask, size_t pixels, mft_error out[MFT_REGIONS])
{
    double squares[MFT_REGIONS] = {0}, sums[MFT_REGIONS] = {0};
    for (int region = 0; region < MFT_REGIONS; region++)
        out[region] = (mft_error){0};
    for (size_t i = 0; i < pixels; i++) {
        if (!mask[i])
            continue;
        const mft_region region = reference[i] > 0 && reference[i] < 1 ? MFT_INSIDE : MFT_OUTSIDE;
        const double error = (double)seen[i] - (double)reference[i];
        squares[region] += error * error;
        sums[region] += error;
        out[region].worst = fmax(out[region].worst, fabs(error));
        out[region].pixels++;
    }
    for (int region = 0; region < MFT_REGIONS; region++) {
        const double n = (double)out[region].pixels;
        out[region].rmse = n > 0 ? sqrt(squares[region] / n) : (double)NAN;
        out[region].bias = n > 0 ? sums[region] / n : (double)NAN;
    }
}

static void add_error_columns(report_table *t)
{
    static const char *const measures[] = {"RMSE", "bias", "worst"};
    char name[60];
    for (int region = 0; region < MFT_REGIONS; region++)
        for (int m = 0; m < 3; m++) {
            snprintf(name, sizeof name, "%s, %s", region_names[region], measures[m]);
            report_table_add_real_column(t, name, NULL, 4);
        }
    for (int region = 0; region < MFT_REGIONS; region++)
        report_table_add_column(t, &(report_column){.name = region_names[region], .unit = "pixels", .kind = REPORT_INTEGER});
}

static void add_errors(report_table *t, const mft_error error[MFT_REGIONS])
{
    for (int region = 0; region < MFT_REGIONS; region++) {
        report_table_add_real(t, error[region].rmse);
        report_table_add_real(t, error[region].bias);
        report_table_add_real(t, error[region].pixels ? error[region].worst : (double)NAN);
    }
    for (int region = 0; region < MFT_REGIONS; region++)
        report_table_add_integer(t, (int64_t)error[region].pixels);
}

static void add_way_columns(report_table *t)
{
    report_table_add_column(t, &(report_column){.name = "interleaved"});
    report_table_add_column(t, &(report_column){.name = "filter"});
}

static void add_way(report_table *t, bool interleaved, bool filtered)
{
    report_table_add_text(t, interleaved ? "yes" : "no");
    report_table_add_text(t, filtered ? "yes" : "no");
}

report_table *mft_quality_errors(const mft_quality_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Soft shadows: cycles, and error of the visibility");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "samples", .kind = REPORT_INTEGER});
    add_way_columns(t);
    report_table_add_real_column(t, "shadow rays", NULL, 0);
    report_table_add_real_column(t, "cycles", NULL, 0);
    report_table_add_real_column(t, "cycles per pixel", NULL, 1);
    add_error_columns(t);
    for (size_t i = 0; i < count; i++) {
        if (i % MFT_QUALITY_WAYS == 0)
            report_table_begin_group(t, rows[i].scene);
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].scene);
        report_table_add_integer(t, rows[i].samples);
        add_way(t, rows[i].interleaved, rows[i].filtered);
        report_table_add_real(t, rows[i].rays);
        report_table_add_real(t, rows[i].cycles);
        report_table_add_real(t, rows[i].cycles_per_pixel);
        add_errors(t, rows[i].error);
    }
    report_table_add_note(
        t, "Visibility is the fraction of the light that a pixel's hit sees, 0 to 1. Its errors are against 4096 samples, which "
           "see a part of the light inside penumbrae, and all of it or nothing outside. RMSE: root of the mean square; bias: "
           "mean, above 0 is too bright; worst: the largest size. Pixels that hit nothing do not count. 256 samples are all "
           "sets, which leaves nothing to interleave.");
    report_table_add_note(t, "Cycles are those of the whole frame with multi-frusta tracing, of the filter too where it is used.");
    return t;
}

report_table *mft_quality_figure5(const mft_figure5_row *rows, size_t count, const char *caption)
{
    char words[500], picture[40];
    report_table *t = report_table_create("Figure 5: 16 samples against 256");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "picture", .align = REPORT_ALIGN_RIGHT});
    add_way_columns(t);
    report_table_add_real_column(t, "shadow rays", "% of those of 256", 2);
    add_error_columns(t);
    for (size_t i = 0; i < count; i++) {
        if (!i || rows[i].width != rows[i - 1].width)
            report_table_begin_group(t, NULL);
        snprintf(picture, sizeof picture, "%ux%u", rows[i].width, rows[i].height);
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].scene);
        report_table_add_text(t, picture);
        add_way(t, rows[i].interleaved, rows[i].filtered);
        report_table_add_real(t, 100 * rows[i].rays);
        add_errors(t, rows[i].error);
    }
    snprintf(
        words, sizeof words,
        "Figure 5 of the paper sets pictures side by side: 16 interleaved samples and the filter, with %.2f %% of the rays "
        "(inferred: the copy of the paper at hand is damaged there), look like 256 samples at 1024x1024. Here errors are against "
        "256 samples, not filtered, and the penumbrae are theirs. The filter's window is 4x4 pixels, so it blurs less of the "
        "scene the larger the picture is.",
        report_paper_find("mft_text", "T-Rex", "interleaved 4x4 + filter", "shadow_rays_relative_to_256"));
    report_table_add_note(t, words);
    return t;
}

void mft_quality_points_of(const mft_quality_row *rows, mft_quality_points *out)
{
    static const char *const labels[MFT_QUALITY_SAMPLES] = {"4", "16", "64", "256"};
    for (int way = 0; way < 4; way++) {
        for (int i = 0; i < MFT_QUALITY_SAMPLES; i++) {
            const mft_quality_row *row = &rows[4 * i + (4 * i < MFT_QUALITY_FULL ? way : way % 2)];
            out->x[way][i] = row->cycles_per_pixel;
            out->y[way][i] = row->error[MFT_INSIDE].rmse;
        }
        out->series[way] = (report_series){.name = way_names[way], .x = out->x[way], .y = out->y[way], .labels = labels,
                                           .count = MFT_QUALITY_SAMPLES, .line = REPORT_LINE_POINTS};
    }
    snprintf(out->title, sizeof out->title, "%.100s: error of soft shadows against cycles", rows->scene);
}
