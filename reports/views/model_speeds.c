#include "reports/views/model_speeds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double model_speed_error(const model_speed *row)
{
    return row->has_cycles ? 100 * ((double)row->cycles / (double)row->core_cycles - 1) : (double)NAN;
}

static double slowdown(const model_speed *row) { return row->seconds / row->native_seconds; }

static void add_tiles(report_table *t, const model_speed *row)
{
    if (row->tiles) {
        report_table_add_integer(t, (int64_t)row->tiles_simulated);
        report_table_add_integer(t, (int64_t)row->tiles);
        return;
    }
    report_table_add_missing(t);
    report_table_add_missing(t);
}

static void add_row(report_table *t, const model_speed *row)
{
    report_table_begin_row(t);
    report_table_add_text(t, row->scene);
    report_table_add_text(t, row->kernel);
    report_table_add_text(t, row->model);
    report_table_add_real(t, row->seconds);
    report_table_add_real(t, slowdown(row));
    if (row->has_cycles)
        report_table_add_integer(t, (int64_t)row->cycles);
    else
        report_table_add_missing(t);
    report_table_add_real(t, model_speed_error(row));
    add_tiles(t, row);
    report_table_add_text(t, row->changed);
}

static bool same_run(const model_speed *a, const model_speed *b) { return strcmp(a->scene, b->scene) == 0 && strcmp(a->kernel, b->kernel) == 0; }

report_table *model_speeds_table(const model_speed *rows, size_t count, const char *caption)
{
    report_table *t = report_table_create("Models: host time, and error of the cycles");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "kernel"});
    report_table_add_column(t, &(report_column){.name = "model"});
    report_table_add_real_column(t, "host time", "s", 4);
    report_table_add_real_column(t, "x native", NULL, 1);
    report_table_add_column(t, &(report_column){.name = "cycles", .kind = REPORT_INTEGER});
    report_table_add_real_column(t, "error", "%", 2);
    report_table_add_column(t, &(report_column){.name = "tiles simulated", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "of tiles", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "changed"});
    for (size_t i = 0; i < count; i++) {
        if (i && !same_run(&rows[i - 1], &rows[i]))
            report_table_begin_group(t, NULL);
        add_row(t, &rows[i]);
    }
    report_table_add_note(t, "Host times, seconds of processor time of all host threads, depend on the host, its load and the "
                             "compiler, and so do the multiples; they are no part of any baseline. All other columns are the same "
                             "on every host.");
    report_table_add_note(t, "Error: cycles against those of `core`, the full model. `count` waits for nothing, `issue` times one "
                             "thread that has the core to itself. Where half of a run's units of tiles do not bound the error as "
                             "asked for, all tiles are simulated, after the sampling: slower than `core`, no error.");
    return t;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median and largest of the numbers, which are sorted. */
static void add_median_and_worst(report_table *t, double *numbers, size_t count)
{
    qsort(numbers, count, sizeof *numbers, ascending);
    report_table_add_real(t, count ? (numbers[(count - 1) / 2] + numbers[count / 2]) / 2 : (double)NAN);
    report_table_add_real(t, count ? numbers[count - 1] : (double)NAN);
}

/* Rows of one model follow each other at the distance of the first run's length. */
static size_t models_of(const model_speed *rows, size_t count)
{
    size_t models = 0;
    while (models < count && same_run(&rows[0], &rows[models]))
        models++;
    return models;
}

report_table *model_speeds_summary(const model_speed *rows, size_t count, const char *caption)
{
    const size_t models = models_of(rows, count);
    double *numbers = calloc(count + 1, sizeof *numbers);
    report_table *t = numbers ? report_table_create("Models: summary") : NULL;
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "model"});
    report_table_add_real_column(t, "x native, median", NULL, 1);
    report_table_add_real_column(t, "x native, worst", NULL, 1);
    report_table_add_real_column(t, "error, median", "%", 2);
    report_table_add_real_column(t, "error, worst", "%", 2);
    for (size_t m = 0; numbers && m < models; m++) {
        size_t n = 0;
        report_table_begin_row(t);
        report_table_add_text(t, rows[m].model);
        for (size_t i = m; i < count; i += models)
            numbers[n++] = slowdown(&rows[i]);
        add_median_and_worst(t, numbers, n);
        n = 0;
        for (size_t i = m; i < count; i += models)
            if (rows[i].has_cycles)
                numbers[n++] = fabs(model_speed_error(&rows[i]));
        add_median_and_worst(t, numbers, n);
    }
    report_table_add_note(t, "Over all kernels and scenes; errors by their size, without their sign.");
    free(numbers);
    return t;
}

base_status model_speed_series_create(const model_speed *rows, size_t count, model_speed_series *out, base_error *err)
{
    const size_t models = models_of(rows, count), runs = models ? count / models : 0;
    *out = (model_speed_series){.series = calloc(models + 1, sizeof *out->series), .numbers = calloc(2 * count + 1, sizeof *out->numbers)};
    if (!out->series || !out->numbers)
        return base_fail(err, BASE_ERR_NOMEM, "plot", "out of memory");
    for (size_t m = 0; m < models; m++) {
        double *x = out->numbers + 2 * m * runs, *y = x + runs;
        bool visible = false;
        for (size_t i = 0; i < runs; i++) {
            x[i] = slowdown(&rows[i * models + m]);
            y[i] = fabs(model_speed_error(&rows[i * models + m]));
            visible = visible || y[i] > 0;
        }
        if (visible)
            out->series[out->count++] = (report_series){.name = rows[m].model, .x = x, .y = y, .count = runs};
    }
    return BASE_OK;
}

void model_speed_series_destroy(model_speed_series *s)
{
    free(s->series);
    free(s->numbers);
    *s = (model_speed_series){0};
}
