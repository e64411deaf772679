/* Suite models: what a simpler model of the machine saves in host time, and what it costs in accuracy. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/suite.h"
#include "cli/suite_machine.h"
#include "reports/views/model_speeds.h"

enum { MOST_TRIES = 5 };

static const double enough_seconds = 0.2; /* a run is tried again until its tries took so long; the shortest one counts */

/* A row of every kernel and scene. */
typedef struct way {
    const char *name;
    run_model model;
    double error; /* of a sampled run */
    const suite_change *changes; /* of the machine */
} way;

static const way ways[] = {
    {.name = "native", .model = RUN_NATIVE},
    {.name = "count", .model = RUN_COUNT},
    {.name = "issue", .model = RUN_ISSUE},
    {.name = "core, without caches", .model = RUN_CORE, .changes = suite_without_caches},
    {.name = "core, without threads", .model = RUN_CORE, .changes = suite_without_threads},
    {.name = "core, without mispredictions", .model = RUN_CORE, .changes = suite_without_mispredictions},
    {.name = "core, sampled to 5%", .model = RUN_CORE, .error = 0.05},
    {.name = "core, sampled to 2%", .model = RUN_CORE, .error = 0.02},
    {.name = "core, sampled to 1%", .model = RUN_CORE, .error = 0.01},
    {.name = "core", .model = RUN_CORE},
};
enum { WAYS = sizeof ways / sizeof *ways };

typedef struct measured {
    suite_machine machines[WAYS];
    model_speed *rows;
    size_t count;
} measured;

/* The least time of some tries; the results of all are the same. */
static base_status run_way(const suite *s, const suite_scene *on, const kernel_info *kernel, const way *w, const suite_machine *v,
                           model_speed *row, base_error *err)
{
    run_options options = suite_run_options(s, kernel, w->model);
    double spent = 0;
    base_status status = BASE_OK;
    options.error = w->error;
    *row = (model_speed){.scene = on->name, .kernel = kernel->name, .model = w->name, .changed = v->changed, .seconds = HUGE_VAL};
    for (int i = 0; status == BASE_OK && i < MOST_TRIES && spent < enough_seconds; i++) {
        run_result result = {0};
        status = run_kernel(on->scene, v->machine, &options, &result, err);
        spent += result.processor_seconds;
        row->seconds = fmin(row->seconds, result.processor_seconds);
        row->has_cycles = w->model != RUN_NATIVE;
        row->cycles = result.cycles;
        row->tiles_simulated = result.estimate.tiles_simulated;
        row->tiles = result.estimate.tiles;
        run_result_destroy(&result);
    }
    return status;
}

static base_status measure_kernel(const suite *s, const suite_scene *on, const kernel_info *kernel, measured *m, base_error *err)
{
    base_status status = BASE_OK;
    model_speed *rows = m->rows + m->count;
    for (int w = 0; status == BASE_OK && w < WAYS; w++)
        status = run_way(s, on, kernel, &ways[w], &m->machines[w], &rows[w], err);
    for (int w = 0; status == BASE_OK && w < WAYS; w++) {
        rows[w].native_seconds = rows[0].seconds;
        rows[w].core_cycles = rows[WAYS - 1].cycles;
    }
    m->count += status == BASE_OK ? WAYS : 0;
    return status;
}

/* All other kernels are run by name: with shadows the suite would take a quarter of an hour. */
static const char *const usual_kernels[] = {"packet16-primary", "mft-primary"};
enum { USUAL_KERNELS = sizeof usual_kernels / sizeof *usual_kernels };

static size_t kernel_count(const suite *s)
{
    return s->options->kernels.count ? s->options->kernels.count : USUAL_KERNELS;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    const char *const *names = s->options->kernels.count ? (const char *const *)s->options->kernels.items : usual_kernels;
    base_status status = BASE_OK;
    for (size_t k = 0; status == BASE_OK && k < kernel_count(s); k++)
        status = measure_kernel(s, on, kernel_find(names[k]), user, err);
    return status;
}

static base_status add_plot(suite *s, const measured *m, base_error *err)
{
    model_speed_series series;
    base_status status = model_speed_series_create(m->rows, m->count, &series, err);
    const report_plot plot = {"Speed against error of the models", {"host time, multiples of native", true},
                              {"error of the cycles against the full core (%)", true}, series.series, series.count};
    report_page_add_heading(s->page, 1, "Plot");
    if (status == BASE_OK)
        status = suite_add_plot(s, "-speed-error", &plot, "A point for each kernel and scene. The lower left is where one wants to "
                                                          "be. Runs without an error, the full core's among them, have no place on "
                                                          "a logarithmic axis and are left out.", err);
    model_speed_series_destroy(&series);
    return status;
}

static base_status add_results(suite *s, const measured *m, base_error *err)
{
    char caption[200];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, %u host thread%s; host time is processor time, the least of up to "
                                      "%d runs.", s->width, s->height,
             s->options->machine->name, s->jobs, s->jobs == 1 ? "" : "s", MOST_TRIES);
    report_page_add_heading(s->page, 1, "Summary");
    base_status status = suite_add_table(s, "-summary", model_speeds_summary(m->rows, m->count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_plot(s, m, err);
    report_page_add_heading(s->page, 1, "All runs");
    return status == BASE_OK ? suite_add_table(s, "", model_speeds_table(m->rows, m->count, caption), err) : status;
}

static base_status measure(suite *s, base_error *err)
{
    measured m = {.rows = calloc(s->scene_count * kernel_count(s) * WAYS, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_machine_one_core(s, err);
    for (int w = 0; status == BASE_OK && w < WAYS; w++)
        status = suite_machine_create(s, ways[w].changes, &m.machines[w], err);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    if (status == BASE_OK)
        status = add_results(s, &m, err);
    for (int w = 0; w < WAYS; w++)
        sim_machine_destroy(&m.machines[w].machine);
    free(m.rows);
    return status;
}

static const char *const scenes[] = {"builtin:rooms-804", "builtin:hall-60k", NULL};

const suite_info suite_models = {
    .name = "models",
    .summary = "host time and error of the cycles of every model, and of sampled runs, against the full core",
    .title = "speed against error of the models",
    .about = "What a simpler model of the machine saves in host time, and how far its cycles are off. The models are those of "
             "--model; the core is also simulated without one of its parts at a time, by fields of the machine that say exactly "
             "that, and on a sample of the tiles (--error). Without caches every access hits the first level, whose banks remain; "
             "without threads the core has one; without mispredictions a branch costs its slot and no more.",
    .scenes = scenes,
    .size = 512,
    .jobs = 1,
    .takes = SUITE_TAKES_KERNELS,
    .measure = measure,
};
