#include "reports/views/mft_paper.h"

#include <stdio.h>
#include <string.h>

static const char table[] = "mft_table1", table2[] = "mft_table2";

const char *const mft_metric_names[MFT_METRICS] = {"triangle accesses", "after culling", "AABB tests", "intersection tests", "cycles"};
const char *const mft_algorithm_names[MFT_ALGORITHMS] = {"P-Packet", "P-Frusta", "S-Packet", "S-Frusta"};
const report_paper_scene mft_scenes[MFT_SCENES] = {
    {"T-Rex (69K tri)", "creature-69k"},
    {"Fern (212K tri)", "fern-212k"},
    {"Call of Juarez Saloon (60K tri)", "hall-60k"},
    {"Fairy Forest (174K tri)", "forest-174k"},
};
const char *const mft_shrink_names[MFT_SHRINKS] = {"No Shrink", "CR", "FS", "Ray-AABB"};
const double mft_paper_pixels = 1024.0 * 1024.0;

/* The metrics' names in the file. */
static const char *const keys[MFT_METRICS] = {"tris_accessed", "tris_after_culling", "aabb_tests", "isec_tests_16wide", "cycles"};

size_t mft_scene_of(const char *builtin) { return report_paper_scene_of(mft_scenes, MFT_SCENES, builtin); }

static void add_doubt(mft_paper_row *row, const char *status, mft_metric metric, const char **last)
{
    const size_t length = strlen(row->doubt);
    const char *joint = !length ? "" : strcmp(*last, status) == 0 ? ", " : "; ";
    if (*last && strcmp(*last, status) == 0)
        snprintf(row->doubt + length, sizeof row->doubt - length, "%s%s", joint, mft_metric_names[metric]);
    else
        snprintf(row->doubt + length, sizeof row->doubt - length, "%s%s: %s", joint, status, mft_metric_names[metric]);
    *last = status;
}

static mft_paper_row row_of(const char *in, size_t scene, const char *algorithm)
{
    mft_paper_row row = {0};
    const char *last = NULL;
    for (int m = 0; m < MFT_METRICS; m++) {
        const report_paper_value *v = report_paper_entry(in, mft_scenes[scene].name, algorithm, keys[m]);
        row.value[m] = report_paper_find(in, mft_scenes[scene].name, algorithm, keys[m]);
        if (v && (strcmp(v->status, "inferred") == 0 || strcmp(v->status, "uncertain") == 0))
            add_doubt(&row, v->status, (mft_metric)m, &last);
    }
    return row;
}

mft_paper_row mft_paper_row_of(size_t scene, mft_algorithm algorithm) { return row_of(table, scene, mft_algorithm_names[algorithm]); }

mft_paper_row mft_paper_shrink_row(size_t shrink) { return row_of(table2, 0, mft_shrink_names[shrink]); }

double mft_paper_additional_tests(size_t shrink)
{
    return report_paper_find(table2, mft_scenes[0].name, mft_shrink_names[shrink], "additional_tests");
}

double mft_paper_shrink_change(size_t shrink, mft_metric metric)
{
    char key[60];
    snprintf(key, sizeof key, "change_%s", keys[metric]);
    return report_paper_find(table2, mft_scenes[0].name, mft_shrink_names[shrink], key);
}

double mft_paper_value(size_t scene, mft_algorithm algorithm, const char *metric)
{
    return report_paper_find(table, mft_scenes[scene].name, mft_algorithm_names[algorithm], metric);
}
