#include "reports/views/mft_prediction.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double far_off = 30; /* percent: rows that are farther off are listed with what makes them so */

enum { BOX_READINGS = 2, READING_BYTES = 100, ROWS = MFT_SCENES * MFT_ALGORITHMS };

static const char *const event_names[MFT_EVENTS] = {"set-up and shading, a pixel", "AABB test, a box", "triangle access", "intersection test"};

/* A way to read the paper: which machine it simulated, and how many boxes its AABB test has. */
typedef struct reading {
    size_t machine;
    unsigned boxes;
} reading;

/* A row of the paper under a reading. */
typedef struct prediction {
    size_t scene;
    mft_algorithm algorithm;
    double published, predicted, part[MFT_EVENTS]; /* cycles; the parts sum to predicted */
} prediction;

static void say_reading(const mft_measured *m, reading r, char text[READING_BYTES])
{
    snprintf(text, READING_BYTES, "%s; a test is %s", m->machines[r.machine], r.boxes == 1 ? "a box" : "a pair");
}

static double error_of(const prediction *p) { return 100 * (p->predicted / p->published - 1); }

/* Cycles an event, over all scenes: the scenes weigh as many events as they have. NaN if there was none. */
static double cost_of(const mft_measured *m, size_t machine, mft_algorithm algorithm, mft_event event)
{
    double cycles = 0, events = 0;
    for (size_t i = 0; i < m->count; i++)
        if (m->events[i].machine == machine && m->events[i].algorithm == algorithm) {
            cycles += m->events[i].cycles[event];
            events += m->events[i].events[event];
        }
    return cycles / events;
}

static prediction predict(const mft_measured *m, reading r, size_t scene, mft_algorithm algorithm)
{
    const mft_paper_row paper = mft_paper_row_of(scene, algorithm);
    const double events[MFT_EVENTS] = {mft_paper_pixels, r.boxes * paper.value[MFT_AABB], paper.value[MFT_TRIS], paper.value[MFT_ISECT]};
    prediction p = {.scene = scene, .algorithm = algorithm, .published = paper.value[MFT_CYCLES]};
    for (int e = 0; e < MFT_EVENTS; e++) {
        p.part[e] = events[e] * cost_of(m, r.machine, algorithm, (mft_event)e);
        p.predicted += p.part[e];
    }
    return p;
}

/* All rows under a reading, algorithms of a scene together. */
static size_t predict_all(const mft_measured *m, reading r, prediction rows[ROWS])
{
    size_t count = 0;
    for (size_t scene = 0; scene < MFT_SCENES; scene++)
        for (size_t a = 0; a < m->algorithms; a++)
            rows[count++] = predict(m, r, scene, (mft_algorithm)a);
    return count;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Size of the errors over the rows of an algorithm, or of all (MFT_ALGORITHMS), of those that could be predicted; NaN if none could. */
typedef struct error_sizes {
    double median, worst;
    prediction farthest;
} error_sizes;

static error_sizes sizes_of(const prediction *rows, size_t count, mft_algorithm algorithm)
{
    double sizes[ROWS];
    size_t n = 0;
    error_sizes e = {.median = (double)NAN, .worst = (double)NAN};
    for (size_t i = 0; i < count; i++) {
        if ((algorithm != MFT_ALGORITHMS && rows[i].algorithm != algorithm) || isnan(rows[i].predicted))
            continue;
        sizes[n] = fabs(error_of(&rows[i]));
        if (!(sizes[n] <= e.worst)) {
            e.worst = sizes[n];
            e.farthest = rows[i];
        }
        n++;
    }
    qsort(sizes, n, sizeof *sizes, ascending);
    if (n)
        e.median = (sizes[(n - 1) / 2] + sizes[n / 2]) / 2;
    return e;
}

static reading reading_at(size_t i) { return (reading){i / BOX_READINGS, 1 + (unsigned)(i % BOX_READINGS)}; }

/* The reading with the least median error. */
static reading best_of(const mft_measured *m)
{
    reading best = reading_at(0);
    double least = HUGE_VAL;
    for (size_t i = 0; i < m->machine_count * BOX_READINGS; i++) {
        prediction rows[ROWS];
        const error_sizes e = sizes_of(rows, predict_all(m, reading_at(i), rows), MFT_ALGORITHMS);
        if (e.median < least) {
            least = e.median;
            best = reading_at(i);
        }
    }
    return best;
}

static void add_text_column(report_table *t, const char *name) { report_table_add_column(t, &(report_column){.name = name}); }

static void add_size_columns(report_table *t, const char *rows)
{
    char name[60];
    snprintf(name, sizeof name, "%s, median", rows);
    report_table_add_real_column(t, name, "%", 1);
    snprintf(name, sizeof name, "%s, worst", rows);
    report_table_add_real_column(t, name, "%", 1);
}

static void add_sizes(report_table *t, error_sizes e)
{
    report_table_add_real(t, e.median);
    report_table_add_real(t, e.worst);
}

/* The event that most of the predicted cycles are for. */
static mft_event main_event_of(const prediction *p)
{
    int main_event = 0;
    for (int e = 1; e < MFT_EVENTS; e++)
        main_event = p->part[e] > p->part[main_event] ? e : main_event;
    return (mft_event)main_event;
}

/* Which event makes the farthest row what it is, and what the machines say of its cost. */
static void say_farthest(report_table *t, const mft_measured *m, reading r, const prediction *p)
{
    char words[900], name[READING_BYTES];
    const mft_event main_event = main_event_of(p);
    const double cost = cost_of(m, r.machine, p->algorithm, main_event), events = p->part[main_event] / cost;
    say_reading(m, r, name);
    int length = snprintf(words, sizeof words, "Least median error: %s. Farthest off under it: %s, %s, %+.1f%%. Of its predicted "
                                               "cycles %.0f%% are for '%s', at %.1f cycles; all else being right, %.1f would be. "
                                               "On the machines here the same costs", name,
                          mft_scenes[p->scene].name, mft_algorithm_names[p->algorithm], error_of(p), 100 * p->part[main_event] / p->predicted,
                          event_names[main_event], cost, cost + (p->published - p->predicted) / events);
    for (size_t i = 0; i < m->machine_count && length < (int)sizeof words; i++)
        length += snprintf(words + length, sizeof words - (size_t)length, "%s %.1f (%s)", i ? "," : "",
                           cost_of(m, i, p->algorithm, main_event), m->machines[i]);
    report_table_add_note(t, words);
}

report_table *mft_prediction_summary(const mft_measured *m, const char *caption)
{
    report_table *t = report_table_create("Predicted cycles of the paper's own counts: errors by reading");
    prediction rows[ROWS];
    report_table_set_caption(t, caption);
    add_text_column(t, "machine");
    add_text_column(t, "an AABB test is");
    for (size_t a = 0; a < m->algorithms; a++)
        add_size_columns(t, mft_algorithm_names[a]);
    add_size_columns(t, "all");
    for (size_t i = 0; i < m->machine_count * BOX_READINGS; i++) {
        const reading r = reading_at(i);
        const size_t count = predict_all(m, r, rows);
        report_table_begin_row(t);
        report_table_add_text(t, m->machines[r.machine]);
        report_table_add_text(t, r.boxes == 1 ? "a box" : "a pair of boxes");
        for (size_t a = 0; a < m->algorithms; a++)
            add_sizes(t, sizes_of(rows, count, (mft_algorithm)a));
        add_sizes(t, sizes_of(rows, count, MFT_ALGORITHMS));
    }
    const reading best = best_of(m);
    const size_t count = predict_all(m, best, rows);
    const error_sizes e = sizes_of(rows, count, MFT_ALGORITHMS);
    bool whole = true;
    for (size_t i = 0; i < count; i++)
        whole = whole && !isnan(rows[i].predicted);
    if (!isnan(e.worst))
        say_farthest(t, m, best, &e.farthest);
    if (!whole)
        report_table_add_note(t, "Rows of an algorithm are not predicted if an event did not happen in it on any of the scenes.");
    report_table_add_note(t, "Errors by their size, without their sign. Predicted: the paper's counts of a row times what such "
                             "events cost here, on other scenes and with no constant fitted to the paper. What the paper leaves "
                             "open is read both ways: whether its AABB test is one box or the pair of a node, whether one hardware "
                             "thread ran or all, and whether its simulator knew cache misses.");
    return t;
}

static void add_far(report_table *t, const mft_measured *m, reading r, const prediction *p)
{
    const mft_event event = main_event_of(p);
    const double cost = cost_of(m, r.machine, p->algorithm, event), events = p->part[event] / cost;
    const mft_paper_row paper = mft_paper_row_of(p->scene, p->algorithm);
    report_table_begin_row(t);
    report_table_add_text(t, mft_scenes[p->scene].name);
    report_table_add_text(t, mft_algorithm_names[p->algorithm]);
    report_table_add_real(t, error_of(p));
    report_table_add_text(t, event_names[event]);
    report_table_add_real(t, 100 * p->part[event] / p->predicted);
    report_table_add_real(t, cost + (p->published - p->predicted) / events);
    for (size_t i = 0; i < m->machine_count; i++)
        report_table_add_real(t, cost_of(m, i, p->algorithm, event));
    report_table_add_text(t, *paper.doubt ? paper.doubt : NULL);
}

report_table *mft_prediction_far(const mft_measured *m)
{
    char title[READING_BYTES + 60], name[READING_BYTES];
    prediction rows[ROWS];
    const reading best = best_of(m);
    const size_t count = predict_all(m, best, rows);
    say_reading(m, best, name);
    snprintf(title, sizeof title, "Rows off by more than %.0f%%: %s", far_off, name);
    report_table *t = report_table_create("Rows that are far off");
    report_table_set_caption(t, title);
    add_text_column(t, "scene");
    add_text_column(t, "algorithm");
    report_table_add_real_column(t, "error", "%", 1);
    add_text_column(t, "most cycles are for");
    report_table_add_real_column(t, "share", "% of predicted", 1);
    report_table_add_real_column(t, "cost that would be right", "cycles", 1);
    for (size_t i = 0; i < m->machine_count; i++)
        report_table_add_real_column(t, m->machines[i], "cycles", 1);
    add_text_column(t, "doubtful readings");
    for (size_t i = 0; i < count; i++)
        if (fabs(error_of(&rows[i])) > far_off)
            add_far(t, m, best, &rows[i]);
    report_table_add_note(t, report_table_rows(t) ? "The event that most of a row's predicted cycles are for: what it would have to cost for the row to be right, "
                                                    "all else being right, and what it costs on the machines here."
                                                  : "None is.");
    return t;
}

report_table *mft_prediction_left(const mft_measured *m, const char *caption)
{
    report_table *t = report_table_create("What the published cycles leave for an AABB test");
    report_table_set_caption(t, caption);
    add_text_column(t, "machine");
    add_text_column(t, "algorithm");
    for (size_t scene = 0; scene < MFT_SCENES; scene++)
        report_table_add_real_column(t, mft_scenes[scene].name, "cycles", 1);
    report_table_add_real_column(t, "a box costs here", "cycles", 1);
    for (size_t machine = 0; machine < m->machine_count; machine++)
        for (size_t a = 0; a < m->algorithms; a++) {
            if (a == 0)
                report_table_begin_group(t, NULL);
            report_table_begin_row(t);
            report_table_add_text(t, m->machines[machine]);
            report_table_add_text(t, mft_algorithm_names[a]);
            for (size_t scene = 0; scene < MFT_SCENES; scene++) {
                const prediction p = predict(m, (reading){machine, 1}, scene, (mft_algorithm)a);
                const double others = p.predicted - p.part[MFT_EVENT_AABB];
                report_table_add_real(t, (p.published - others) / mft_paper_row_of(scene, p.algorithm).value[MFT_AABB]);
            }
            report_table_add_real(t, cost_of(m, machine, (mft_algorithm)a, MFT_EVENT_AABB));
        }
    report_table_add_note(t, "Published cycles less those of the other events at their costs here, over the published number of AABB tests. If "
                             "tests had one cost, an algorithm's scenes would agree; below 0: the others alone cost more than was published.");
    return t;
}

static void add_cost(report_table *t, const mft_measured *m, size_t machine, mft_algorithm algorithm, mft_event event)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t i = 0; i < m->count; i++) {
        const mft_events *s = &m->events[i];
        if (s->machine != machine || s->algorithm != algorithm || !(s->events[event] > 0))
            continue;
        least = fmin(least, s->cycles[event] / s->events[event]);
        most = fmax(most, s->cycles[event] / s->events[event]);
    }
    report_table_begin_row(t);
    report_table_add_text(t, m->machines[machine]);
    report_table_add_text(t, mft_algorithm_names[algorithm]);
    report_table_add_text(t, event_names[event]);
    report_table_add_real(t, cost_of(m, machine, algorithm, event));
    report_table_add_real(t, least);
    report_table_add_real(t, most);
}

report_table *mft_prediction_costs(const mft_measured *m, const char *caption)
{
    report_table *t = report_table_create("What events cost");
    report_table_set_caption(t, caption);
    add_text_column(t, "machine");
    add_text_column(t, "algorithm");
    add_text_column(t, "event");
    report_table_add_real_column(t, "cycles", NULL, 2);
    report_table_add_real_column(t, "least scene", NULL, 2);
    report_table_add_real_column(t, "dearest scene", NULL, 2);
    for (size_t machine = 0; machine < m->machine_count; machine++)
        for (size_t a = 0; a < m->algorithms; a++) {
            report_table_begin_group(t, NULL);
            for (int e = 0; e < MFT_EVENTS; e++)
                add_cost(t, m, machine, (mft_algorithm)a, (mft_event)e);
        }
    report_table_add_note(t, "Cycles of a phase of the kernel over the number of its events, both summed over the scenes: "
                             "traversal (box tests, children, stack, leaves entered) by boxes; culling by triangles accessed; "
                             "intersection by tests; set-up and shading by pixels. Phases sum to the run's cycles. A packet has 16 "
                             "pixels, a group of frusta 256.");
    return t;
}

report_table *mft_prediction_rows(const mft_measured *m, const char *caption)
{
    static const char *const parts[MFT_EVENTS] = {"set-up", "AABB tests", "triangle accesses", "intersection tests"};
    report_table *t = report_table_create("Predicted and published cycles");
    report_table_set_caption(t, caption);
    add_text_column(t, "scene");
    add_text_column(t, "algorithm");
    report_table_add_real_column(t, "published", NULL, 0);
    report_table_add_real_column(t, "predicted", NULL, 0);
    report_table_add_real_column(t, "error", "%", 1);
    for (int e = 0; e < MFT_EVENTS; e++)
        report_table_add_real_column(t, parts[e], "% of predicted", 1);
    add_text_column(t, "doubtful readings");
    for (size_t i = 0; i < m->machine_count * BOX_READINGS; i++) {
        prediction rows[ROWS];
        char name[READING_BYTES];
        const size_t count = predict_all(m, reading_at(i), rows);
        say_reading(m, reading_at(i), name);
        report_table_begin_group(t, name);
        for (size_t k = 0; k < count; k++) {
            const mft_paper_row paper = mft_paper_row_of(rows[k].scene, rows[k].algorithm);
            report_table_begin_row(t);
            report_table_add_text(t, mft_scenes[rows[k].scene].name);
            report_table_add_text(t, mft_algorithm_names[rows[k].algorithm]);
            report_table_add_real(t, rows[k].published);
            report_table_add_real(t, rows[k].predicted);
            report_table_add_real(t, error_of(&rows[k]));
            for (int e = 0; e < MFT_EVENTS; e++)
                report_table_add_real(t, 100 * rows[k].part[e] / rows[k].predicted);
            report_table_add_text(t, *paper.doubt ? paper.doubt : NULL);
        }
    }
    return t;
}

void mft_prediction_points_of(const mft_measured *m, mft_prediction_points *out)
{
    static const char *const labels[MFT_SCENES] = {"T-Rex", "Fern", "Saloon", "Fairy Forest"};
    const reading best = best_of(m);
    char name[READING_BYTES];
    *out = (mft_prediction_points){.ends = {HUGE_VAL, 0}, .count = m->algorithms + 1};
    for (size_t a = 0; a < m->algorithms; a++) {
        for (size_t scene = 0; scene < MFT_SCENES; scene++) {
            const prediction p = predict(m, best, scene, (mft_algorithm)a);
            out->published[a][scene] = p.published / 1e6;
            out->predicted[a][scene] = p.predicted / 1e6;
            out->ends[0] = fmin(out->ends[0], fmin(p.published, p.predicted) / 1e6);
            out->ends[1] = fmax(out->ends[1], fmax(p.published, p.predicted) / 1e6);
        }
        out->series[a] = (report_series){mft_algorithm_names[a], out->published[a], out->predicted[a], labels, MFT_SCENES, REPORT_LINE_NONE};
    }
    out->series[m->algorithms] = (report_series){"equal", out->ends, out->ends, NULL, 2, REPORT_LINE_ALONE};
    say_reading(m, best, name);
    snprintf(out->title, sizeof out->title, "Predicted against published cycles: %s", name);
}
