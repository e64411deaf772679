#include "reports/views/mft_msaa.h"

#include <math.h>

#include "reports/paper.h"

const char *const mft_msaa_way_names[MFT_MSAA_WAYS] = {"1 ray a pixel", "adaptive", "16 rays a pixel"};

double mft_msaa_rmse(const float *values, const float *reference, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double difference = (double)values[i] - (double)reference[i];
        sum += difference * difference;
    }
    return count ? sqrt(sum / (double)count) : (double)NAN;
}

static double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : (double)NAN; }

report_table *mft_msaa_marked(const mft_msaa_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Adaptive anti-aliasing: marked pixels");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_real_column(t, "marked", "% of pixels", 2);
    report_table_add_real_column(t, "recall", "%", 3);
    report_table_add_real_column(t, "edge pixels missed", NULL, 0);
    report_table_add_real_column(t, "precision", "%", 1);
    report_table_add_real_column(t, "edge pixels", "% of pixels", 2);
    report_table_add_real_column(t, "intersections", "% of pixels", 2);
    report_table_add_real_column(t, "silhouettes", NULL, 0);
    report_table_add_real_column(t, "edge tests", NULL, 0);
    report_table_add_real_column(t, "marked by blocks", "% of pixels", 2);
    for (size_t i = 0; i < count; i++) {
        const mft_msaa_row *r = &rows[i];
        report_table_begin_row(t);
        report_table_add_text(t, r->scene);
        report_table_add_real(t, percent(r->marked, r->pixels));
        report_table_add_real(t, percent(r->edges_marked, r->edges));
        report_table_add_real(t, r->edges - r->edges_marked);
        report_table_add_real(t, percent(r->precise, r->marked));
        report_table_add_real(t, percent(r->edges, r->pixels));
        report_table_add_real(t, percent(r->intersections, r->pixels));
        report_table_add_real(t, r->silhouettes);
        report_table_add_real(t, r->edge_tests);
        report_table_add_real(t, percent(r->marked_by_blocks, r->pixels));
    }
    report_table_begin_group(t, "published, Figure 7, 1024x1024");
    report_table_begin_row(t);
    report_table_add_text(t, "Saloon");
    report_table_add_real(t, report_paper_find("mft_text", "Saloon", "adaptive MSAA", "pixels_marked"));
    for (int i = 0; i < 8; i++)
        report_table_add_missing(t);
    report_table_add_note(
        t, "An edge pixel is one whose 16 samples a silhouette of a surface that they hit separates (exact/pixel_edges.h); recall is the "
           "part of them that is marked. Intersections: the samples are of several surfaces, but these run through each other and have "
           "no silhouette there; such pixels are not looked for. Precision: the part of the marked pixels whose samples are not of one "
           "smooth surface. The share of marked pixels falls with the size of the picture, about as one over its edge.");
    return t;
}

report_table *mft_msaa_cycles(const mft_msaa_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Adaptive anti-aliasing: cycles");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_real_column(t, "primary rays", "million cycles", 3);
    report_table_add_real_column(t, "marking", "million cycles", 3);
    report_table_add_real_column(t, "marking / primary", "%", 1);
    report_table_add_real_column(t, "samples", "million cycles", 3);
    report_table_add_real_column(t, "adaptive", "million cycles", 3);
    report_table_add_real_column(t, "16 rays a pixel", "million cycles", 3);
    report_table_add_real_column(t, "16 rays / adaptive", NULL, 2);
    report_table_add_real_column(t, "cycles per sample, adaptive", NULL, 2);
    report_table_add_real_column(t, "16 rays a pixel: cycles per sample", NULL, 2);
    for (size_t i = 0; i < count; i++) {
        const mft_msaa_row *r = &rows[i];
        const double primary = r->cycles[MFT_MSAA_NONE], adaptive = r->cycles[MFT_MSAA_ADAPTIVE], full = r->cycles[MFT_MSAA_FULL];
        const double samples = adaptive - r->marking_cycles;
        report_table_begin_row(t);
        report_table_add_text(t, r->scene);
        report_table_add_real(t, primary / 1e6);
        report_table_add_real(t, (r->marking_cycles - primary) / 1e6);
        report_table_add_real(t, percent(r->marking_cycles - primary, primary));
        report_table_add_real(t, samples / 1e6);
        report_table_add_real(t, adaptive / 1e6);
        report_table_add_real(t, full / 1e6);
        report_table_add_real(t, full / adaptive);
        report_table_add_real(t, r->marked > 0 ? samples / (16 * r->marked) : (double)NAN);
        report_table_add_real(t, full / r->rays[MFT_MSAA_FULL]);
    }
    report_table_add_note(t, "Primary rays: mft-primary. Marking: what mft-msaa takes more if it only marks pixels (retrace=0), the wider frusta "
                             "of its primary rays among it. Samples: what tracing marked pixels again adds to that. 16 rays a pixel: "
                             "mft-primary with four times as many pixels in either direction.");
    return t;
}

report_table *mft_msaa_errors(const mft_msaa_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Adaptive anti-aliasing: error of the picture");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "rays"});
    report_table_add_real_column(t, "rays per pixel", NULL, 2);
    report_table_add_real_column(t, "cycles per pixel", NULL, 1);
    report_table_add_real_column(t, "RMSE", NULL, 5);
    report_table_add_real_column(t, "RMSE / 1 ray's", NULL, 3);
    report_table_add_real_column(t, "95% interval of the cycles", "+-%", 2);
    for (size_t i = 0; i < count; i++) {
        report_table_begin_group(t, rows[i].scene);
        for (int way = 0; way < MFT_MSAA_WAYS; way++) {
            const mft_msaa_row *r = &rows[i];
            report_table_begin_row(t);
            report_table_add_text(t, r->scene);
            report_table_add_text(t, mft_msaa_way_names[way]);
            report_table_add_real(t, r->rays[way] / r->pixels);
            report_table_add_real(t, r->cycles[way] / r->pixels);
            report_table_add_real(t, r->rmse[way]);
            report_table_add_real(t, r->rmse[MFT_MSAA_NONE] > 0 ? r->rmse[way] / r->rmse[MFT_MSAA_NONE] : (double)NAN);
            report_table_add_real(t, r->half_width[way] > 0 ? 100 * r->half_width[way] : (double)NAN);
        }
    }
    report_table_add_note(t, "RMSE of the linear colours of all pixels against 64 samples a pixel, shaded alike. The adaptive picture keeps one "
                             "ray where no silhouette is: there creases between two faces that are both seen, intersections and missed "
                             "pixels keep their error.");
    return t;
}
