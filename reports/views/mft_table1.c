#include "reports/views/mft_table1.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double large = 1.25; /* a reduction that differs by more than this factor is put into words */

const char *const mft_phase_names[MFT_PHASES] = {"set-up", "traversal", "culling", "intersection", "shading", "filter"};

static void begin(report_table *t, const char *scene, const char *algorithm, const char *basis)
{
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, algorithm);
    report_table_add_text(t, basis);
}

static void add_measured(report_table *t, const mft_row *row)
{
    begin(t, row->scene, mft_algorithm_names[row->algorithm], "measured");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, row->value[m]);
    report_table_add_real(t, row->value[MFT_CYCLES] / row->pixels);
    report_table_add_real(t, 100 * row->memory);
    report_table_add_real(t, row->half_width > 0 ? 100 * row->half_width : (double)NAN);
}

static void add_published(report_table *t, size_t scene, mft_algorithm algorithm)
{
    const mft_paper_row row = mft_paper_row_of(scene, algorithm);
    begin(t, mft_scenes[scene].name, mft_algorithm_names[algorithm], "published");
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, row.value[m]);
    report_table_add_real(t, row.value[MFT_CYCLES] / mft_paper_pixels);
    report_table_add_missing(t);
    report_table_add_missing(t);
    report_table_add_text(t, *row.doubt ? row.doubt : NULL);
}

static bool stands_in(const mft_row *rows, size_t count, size_t scene, mft_algorithm algorithm)
{
    for (size_t i = 0; i < count; i++)
        if (rows[i].algorithm == algorithm && mft_scene_of(rows[i].scene) == scene)
            return true;
    return false;
}

/* The published rows that no measured one has beside it. */
static void add_rest(report_table *t, const mft_row *rows, size_t count)
{
    bool first = true;
    for (size_t scene = 0; scene < MFT_SCENES; scene++)
        for (int a = 0; a < MFT_ALGORITHMS; a++) {
            if (stands_in(rows, count, scene, (mft_algorithm)a))
                continue;
            if (first)
                report_table_begin_group(t, "published, not measured here");
            first = false;
            add_published(t, scene, (mft_algorithm)a);
        }
}

report_table *mft_table1_counts(const mft_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("MFT Table 1: measured, and published by Benthin and Wald 2009");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    report_table_add_column(t, &(report_column){.name = "basis"});
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], NULL, 0);
    report_table_add_real_column(t, "cycles per pixel", NULL, 1);
    report_table_add_real_column(t, "memory", "% of cycles", 1);
    report_table_add_real_column(t, "95% interval", "+-%", 2);
    report_table_add_column(t, &(report_column){.name = "doubtful readings"});
    for (size_t i = 0; i < count; i++) {
        const size_t scene = mft_scene_of(rows[i].scene);
        if (!i || strcmp(rows[i - 1].scene, rows[i].scene) != 0)
            report_table_begin_group(t, rows[i].scene);
        add_measured(t, &rows[i]);
        if (scene < MFT_SCENES)
            add_published(t, scene, rows[i].algorithm);
    }
    add_rest(t, rows, count);
    report_table_add_note(t, "Published counts are rounded to thousands, cycles to hundred thousands, and of 1024x1024 pixels. The "
                             "built-in scenes stand in for the paper's: they share the number of triangles and nothing else. "
                             "Doubtful readings: the copy of the paper at hand is damaged there, and the number was inferred or "
                             "does not agree with another (reports/papers/mft_table1.csv says why).");
    report_table_add_note(t, "Memory: cycles in which no thread issued, and the next one to issue waited for a line from beyond "
                             "the first level of cache. Measured cycles are those of the core model, without shading for primary "
                             "rays, with it for soft shadows, and without the filter; the published ones are of the paper's own simulator of a core, of which it tells little. AABB "
                             "and intersection tests are 16-lane operations, one box or triangle each.");
    return t;
}

report_table *mft_table1_phases(const mft_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Cycles by phase");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    for (int phase = 0; phase < MFT_PHASES; phase++)
        report_table_add_real_column(t, mft_phase_names[phase], NULL, 0);
    report_table_add_real_column(t, "shading per pixel", NULL, 1);
    report_table_add_real_column(t, "filter per pixel", NULL, 1);
    for (size_t i = 0; i < count; i++) {
        if (!i || strcmp(rows[i - 1].scene, rows[i].scene) != 0)
            report_table_begin_group(t, rows[i].scene);
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].scene);
        report_table_add_text(t, mft_algorithm_names[rows[i].algorithm]);
        for (int phase = 0; phase < MFT_PHASES; phase++)
            report_table_add_real(t, rows[i].phase[phase]);
        report_table_add_real(t, rows[i].phase[MFT_PHASES - 2] / rows[i].pixels);
        report_table_add_real(t, rows[i].phase[MFT_PHASES - 1] / rows[i].pixels);
    }
    report_table_add_note(t, "Shading: hit points, what light they could see, what of it is seen, and Lambert's law for one sample at the light's "
                             "centre. The filter is a pass of its own over the whole picture; the paper gives less than 20 million cycles "
                             "for it, and its cycles are not in the other tables.");
    return t;
}

static void add_reduction(report_table *t, const double packet[MFT_METRICS], const double frusta[MFT_METRICS])
{
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real(t, packet[m] / frusta[m]);
}

static const char *kind_of(mft_algorithm packet) { return packet == MFT_P_PACKET ? "primary rays" : "soft shadows"; }

static void add_published_reduction(report_table *t, size_t scene, mft_algorithm algorithm)
{
    const mft_paper_row packet = mft_paper_row_of(scene, algorithm), frusta = mft_paper_row_of(scene, algorithm + 1);
    begin(t, mft_scenes[scene].name, kind_of(algorithm), "published");
    add_reduction(t, packet.value, frusta.value);
    if (*packet.doubt || *frusta.doubt) {
        char doubt[2 * MFT_DOUBT_BYTES + 2];
        snprintf(doubt, sizeof doubt, "%s%s%s", packet.doubt, *packet.doubt && *frusta.doubt ? "; " : "", frusta.doubt);
        report_table_add_text(t, doubt);
    }
}

report_table *mft_table1_reductions(const mft_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Reductions: packets / frusta");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "rays"});
    report_table_add_column(t, &(report_column){.name = "basis"});
    for (int m = 0; m < MFT_METRICS; m++)
        report_table_add_real_column(t, mft_metric_names[m], NULL, 2);
    report_table_add_column(t, &(report_column){.name = "doubtful readings"});
    for (size_t i = 0; i + 1 < count; i += 2) {
        const size_t scene = mft_scene_of(rows[i].scene);
        report_table_begin_group(t, NULL);
        begin(t, rows[i].scene, kind_of(rows[i].algorithm), "measured");
        add_reduction(t, rows[i].value, rows[i + 1].value);
        if (scene < MFT_SCENES)
            add_published_reduction(t, scene, rows[i].algorithm);
    }
    for (size_t scene = 0; scene < MFT_SCENES; scene++)
        for (int a = 0; a < MFT_ALGORITHMS; a += 2)
            if (!stands_in(rows, count, scene, (mft_algorithm)a)) {
                report_table_begin_group(t, NULL);
                add_published_reduction(t, scene, (mft_algorithm)a);
            }
    report_table_add_note(t, "Published reductions are formed from the published counts, as the measured ones are; the paper "
                             "prints some of them truncated, and two of them do not agree with its own counts.");
    return t;
}

/* "P-Packet has 1.20 x the AABB tests of the paper's a pixel, ...": measured over published. */
static void say_row(char *text, size_t size, const mft_row *row, size_t scene)
{
    const mft_paper_row paper = mft_paper_row_of(scene, row->algorithm);
    double of[MFT_METRICS];
    for (int m = 0; m < MFT_METRICS; m++)
        of[m] = row->value[m] / row->pixels / (paper.value[m] / mft_paper_pixels);
    snprintf(text, size, "%s has %.2f times the published triangle accesses a pixel, %.2f times the AABB tests, %.2f times the "
                         "intersection tests and %.2f times the cycles, %.0f%% of them waiting for memory",
             mft_algorithm_names[row->algorithm], of[MFT_TRIS], of[MFT_AABB],
             of[MFT_ISECT], of[MFT_CYCLES], 100 * row->memory);
}

static bool differs(double ours, double theirs) { return ours > theirs * large || theirs > ours * large; }

static void say_pair(report_table *t, const mft_row *packet, size_t scene)
{
    const mft_row *frusta = packet + 1;
    const mft_paper_row p = mft_paper_row_of(scene, packet->algorithm), f = mft_paper_row_of(scene, frusta->algorithm);
    double ours[MFT_METRICS], theirs[MFT_METRICS];
    char first[300], second[300], words[640];
    for (int m = 0; m < MFT_METRICS; m++) {
        ours[m] = packet->value[m] / frusta->value[m];
        theirs[m] = p.value[m] / f.value[m];
    }
    if (!differs(ours[MFT_AABB], theirs[MFT_AABB]) && !differs(ours[MFT_CYCLES], theirs[MFT_CYCLES]))
        return;
    say_row(first, sizeof first, packet, scene);
    say_row(second, sizeof second, frusta, scene);
    snprintf(words, sizeof words, "%s; %s.", first, second);
    report_table_begin_row(t);
    report_table_add_text(t, packet->scene);
    report_table_add_text(t, kind_of(packet->algorithm));
    for (const mft_metric *m = (const mft_metric[]){MFT_AABB, MFT_CYCLES, MFT_METRICS}; *m != MFT_METRICS; m++) {
        report_table_add_real(t, ours[*m]);
        report_table_add_real(t, theirs[*m]);
    }
    report_table_add_text(t, words);
}

report_table *mft_table1_differences(const mft_row *rows, size_t count)
{
    char caption[160];
    report_table *t = report_table_create("Where reductions differ");
    snprintf(caption, sizeof caption, "Reductions of AABB tests and cycles that differ from the published one by more than a "
                                      "factor of %.2f, and where from.", large);
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "rays"});
    report_table_add_real_column(t, "AABB tests, measured", NULL, 2);
    report_table_add_real_column(t, "AABB tests, published", NULL, 2);
    report_table_add_real_column(t, "cycles, measured", NULL, 2);
    report_table_add_real_column(t, "cycles, published", NULL, 2);
    report_table_add_column(t, &(report_column){.name = "in words"});
    for (size_t i = 0; i + 1 < count; i += 2)
        if (mft_scene_of(rows[i].scene) < MFT_SCENES)
            say_pair(t, &rows[i], mft_scene_of(rows[i].scene));
    if (!report_table_rows(t))
        report_table_add_note(t, "None does.");
    return t;
}
