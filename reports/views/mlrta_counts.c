#include "reports/views/mlrta_counts.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* One reading of a row of the paper. */
typedef struct reading {
    const char *count, *name;
    size_t field;       /* of mlrta_counts */
    size_t and_field;   /* added to it if `sum` */
    bool sum, searches; /* searches: only MLRT has them */
    const char *metric; /* in the paper's table */
} reading;

#define FIELD(name) offsetof(mlrta_counts, name)

static const reading readings[] = {
    {"traversed cells", "inner nodes", FIELD(inner), 0, false, false, "traversed_cells"},
    {"traversed cells", "inner nodes and leaves", FIELD(cells), 0, false, false, "traversed_cells"},
    {"cells, EP only", "inner nodes", FIELD(ep_inner), 0, false, true, "traversed_cells_ep_only"},
    {"cells, EP only", "inner nodes and leaves", FIELD(ep_cells), 0, false, true, "traversed_cells_ep_only"},
    {"intersections", "tests that give a nearer hit", FIELD(nearer), 0, false, false, "non_masked_intersections"},
    {"intersections", "tests", FIELD(tests), 0, false, false, "non_masked_intersections"},
    {"intersections", "tests without a mailbox", FIELD(tests), FIELD(mailbox), true, false, "non_masked_intersections"},
};
enum { READINGS = sizeof readings / sizeof *readings };

static double field_of(const mlrta_counts *c, size_t offset) { return *(const double *)((const char *)c + offset); }

static double measured(const mlrta_row *row, const reading *r, mlrta_algorithm a)
{
    const mlrta_counts *c = &row->counts[a];
    if (r->searches && a == MLRTA_WITHOUT)
        return (double)NAN;
    return (field_of(c, r->field) + (r->sum ? field_of(c, r->and_field) : 0)) / row->packets;
}

static void begin(report_table *t, const char *scene, const reading *r, const char *name)
{
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, r->count);
    report_table_add_text(t, name);
}

/* A row, NaN for what is not there. */
static void add_values(report_table *t, const double ours[MLRTA_ALGORITHMS], const double theirs[MLRTA_ALGORITHMS])
{
    for (int a = 0; a < MLRTA_ALGORITHMS; a++) {
        report_table_add_real(t, ours[a]);
        report_table_add_real(t, theirs[a]);
    }
    report_table_add_real(t, ours[MLRTA_WITHOUT] / ours[MLRTA_WITH]);
    report_table_add_real(t, theirs[MLRTA_WITHOUT] / theirs[MLRTA_WITH]);
}

static void find_published(unsigned number, size_t scene, const reading *r, double theirs[MLRTA_ALGORITHMS])
{
    for (int a = 0; a < MLRTA_ALGORITHMS; a++)
        theirs[a] = scene < MLRTA_SCENES ? mlrta_paper_count(number, scene, (mlrta_algorithm)a, r->metric) : (double)NAN;
}

static void add_scene(report_table *t, unsigned number, const mlrta_row *row)
{
    report_table_begin_group(t, NULL);
    for (int i = 0; i < READINGS; i++) {
        double ours[MLRTA_ALGORITHMS], theirs[MLRTA_ALGORITHMS];
        for (int a = 0; a < MLRTA_ALGORITHMS; a++)
            ours[a] = measured(row, &readings[i], (mlrta_algorithm)a);
        find_published(number, mlrta_scene_of(row->scene), &readings[i], theirs);
        begin(t, row->scene, &readings[i], readings[i].name);
        add_values(t, ours, theirs);
    }
}

/* What the paper has of a scene that was not measured: a row for each of its counts. */
static void add_published(report_table *t, unsigned number, size_t scene)
{
    const double none[MLRTA_ALGORITHMS] = {(double)NAN, (double)NAN};
    report_table_begin_group(t, NULL);
    for (int i = 0; i < READINGS; i++) {
        double theirs[MLRTA_ALGORITHMS];
        find_published(number, scene, &readings[i], theirs);
        if (isnan(theirs[MLRTA_WITH]) || (i && strcmp(readings[i].metric, readings[i - 1].metric) == 0))
            continue;
        begin(t, mlrta_scenes[scene].name, &readings[i], "published, not measured here");
        add_values(t, none, theirs);
    }
}

static bool stands_in(const mlrta_row *rows, size_t count, size_t scene)
{
    for (size_t i = 0; i < count; i++)
        if (mlrta_scene_of(rows[i].scene) == scene)
            return true;
    return false;
}

report_table *mlrta_counts_table(unsigned number, const mlrta_row *rows, size_t count, const char *caption)
{
    char title[120];
    snprintf(title, sizeof title, "MLRTA Table %u: measured, and published by Reshetov, Soupikov and Hurley 2005", number);
    report_table *t = report_table_create(title);
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "count"});
    report_table_add_column(t, &(report_column){.name = "reading"});
    report_table_add_real_column(t, "no MLRT", "per packet", 2);
    report_table_add_real_column(t, "no MLRT, published", "per packet", 2);
    report_table_add_real_column(t, "MLRT", "per packet", 2);
    report_table_add_real_column(t, "MLRT, published", "per packet", 2);
    report_table_add_real_column(t, "reduction", NULL, 2);
    report_table_add_real_column(t, "reduction, published", NULL, 2);
    for (size_t i = 0; i < count; i++)
        add_scene(t, number, &rows[i]);
    for (size_t scene = 0; scene < MLRTA_SCENES; scene++)
        if (!stands_in(rows, count, scene))
            add_published(t, number, scene);
    report_table_add_note(t, "Counts are divided by the 4x4 packets of primary rays that cover the picture, 65,536 of the paper's "
                             "1024x1024, shadow rays too. The paper does not say whether a leaf is a traversed cell, nor which "
                             "tests are non-masked: each reading has its row, and the published value stands beside all. The "
                             "built-in scenes stand in for the paper's: they share the number of triangles and nothing else.");
    return t;
}

static void add_units(report_table *t, const mlrta_row *row, mlrta_algorithm a)
{
    const mlrta_counts *c = &row->counts[a];
    const bool searches = a == MLRTA_WITH;
    report_table_begin_row(t);
    report_table_add_text(t, row->scene);
    report_table_add_text(t, searches ? "MLRT" : "no MLRT");
    report_table_add_real(t, row->packets);
    report_table_add_real(t, 100 * c->divergent_packets / row->packets);
    const double of_searches[] = {c->tiles, c->empty_tiles, c->divergent_tiles, c->end_tests, c->ends, 100 * c->ep_inner / c->inner,
                                  100 * c->ep_cells / c->cells};
    for (size_t i = 0; i < sizeof of_searches / sizeof *of_searches; i++)
        report_table_add_real(t, searches ? of_searches[i] : (double)NAN);
}

report_table *mlrta_counts_units(const mlrta_row *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Packets, tiles and searches");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    report_table_add_real_column(t, "packets of the picture", NULL, 0);
    report_table_add_real_column(t, "divergent packets", "%", 2);
    report_table_add_real_column(t, "tiles searched", NULL, 0);
    report_table_add_real_column(t, "tiles that hit nothing", NULL, 0);
    report_table_add_real_column(t, "divergent tiles", NULL, 0);
    report_table_add_real_column(t, "triangles tried as ends", NULL, 0);
    report_table_add_real_column(t, "searches ended", NULL, 0);
    report_table_add_real_column(t, "EP share, inner", "%", 1);
    report_table_add_real_column(t, "EP share, with leaves", "%", 1);
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < MLRTA_ALGORITHMS; a++)
            add_units(t, &rows[i], (mlrta_algorithm)a);
    report_table_add_note(t, "Divergent packets are in percent of the packets of the picture, those of shadow rays among them; they "
                             "are traced in parts, a part an octant of signs. EP share: the searches' part of the traversed cells; "
                             "Table 2 of the paper has 8 to 14%, and the text speaks of 10%.");
    return t;
}
