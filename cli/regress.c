/* lanetrace regress: counts, ops and cycles against stored baselines, exactly. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/command.h"
#include "cli/progress.h"
#include "cli/run.h"
#include "cli/stats.h"
#include "lrbni/base/parallel.h"
#include "lrbni/base/output_file.h"
#include "scene/builtin.h"

enum { KEY_UPDATE = 256, KEY_BASELINES, KEY_JOBS, PATH_BYTES = 4096, FIELD_BYTES = 160, PARAM_BYTES = 32, KERNELS = 4 };

/* What is measured: kernels on scenes, size x size pixels. */
typedef struct suite {
    const char *name, *kernels[KERNELS]; /* as many as there are */
    unsigned size;
    const char *const *scenes; /* of a long suite, which is measured only if it is named, NULL at the end; NULL: the usual ones */
    const char *core_scene, *core_kernel; /* of a long suite: what the core model runs as well */
} suite;

/* Those of the tables in the papers. */
static const char *const mft_scenes[] = {"builtin:creature-69k", "builtin:fern-212k", "builtin:hall-60k", "builtin:forest-174k", NULL};

static const suite suites[] = {
    {"mft-primary", {"packet16-primary", "mft-primary", "packet256-primary"}, 256, NULL, NULL, NULL},
    {"mft-soft", {"packet16-soft", "mft-soft", "packet256-soft"}, 32, NULL, NULL, NULL},
    {"mlrta-primary", {"kd16-primary", "mlrta-primary"}, 128, NULL, NULL, NULL},
    {"mlrta-shadow", {"kd16-shadow", "mlrta-shadow"}, 64, NULL, NULL, NULL},
    {"mft-table1-long", {"packet16-primary", "mft-primary", "packet16-soft", "mft-soft"}, 1024, mft_scenes, "hall-60k", "mft-primary"},
};
enum { SUITES = sizeof suites / sizeof *suites };

static const struct argp_option option_table[] = {
    {"update", KEY_UPDATE, NULL, 0, "store what is measured as the new baseline", 0},
    {"baselines", KEY_BASELINES, "DIR", 0, "where the baselines lie; default: those of this source tree or installation", 0},
    {"jobs", KEY_JOBS, "N", 0, "host threads; default: all", 0},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *baselines, *jobs;
    bool update;
    command_list suites;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_UPDATE: a->update = true; return 0;
    case KEY_BASELINES: a->baselines = text; return 0;
    case KEY_JOBS: a->jobs = text; return 0;
    case ARGP_KEY_ARG: return command_list_add(&a->suites, text, a->err) == BASE_OK ? 0 : ENOMEM;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, "[SUITE...]",
    "Measure the suites (all but the long ones, if none is named) and compare every count, op and cycle with the stored baseline.\v"
    "Exit code 1 if anything differs. Suites, on the three small indoor scenes, on larrabee and knc: mft-primary and mft-soft, packets, large packets and frusta, "
    "primary rays at 256x256, with and without a shader, soft shadows at 32x32 with every way to shrink frusta; mlrta-primary and mlrta-shadow, packets through the "
    "kd-tree from its root and from entry points, at 128x128 and, with hard shadows, 64x64. Measured only if named: mft-table1-long, the "
    "counts of 'lanetrace report mft-table1' at 1024x1024 on its scenes, and the cycles of one of its rows: minutes.",
    NULL, NULL, NULL,
};

/* One measurement of the suite. */
static base_status measure(json_t *runs, const scene *s, const kernel_info *kernel, const kernel_params *params, unsigned size,
                           const char *machine_name, run_model model, unsigned jobs, base_error *err)
{
    const command_list no_sets = {0};
    sim_machine *machine = NULL;
    run_result result = {0};
    run_options options = {.kernel = kernel, .params = *params, .width = size, .height = size, .model = model, .jobs = jobs, .progress = true};
    base_status status = command_machine(machine_name, &no_sets, &machine, err);
    if (status == BASE_OK)
        status = run_kernel(s, machine, &options, &result, err);
    if (status == BASE_OK && json_array_append_new(runs, stats_json(&result, 0, 0)) != 0)
        status = base_fail(err, BASE_ERR_NOMEM, "regress", "out of memory");
    run_result_destroy(&result);
    sim_machine_destroy(&machine);
    return status;
}

/* One kernel of a long suite, as the tables have it: back faces culled; counted, and timed where the suite says so. */
static base_status measure_long(json_t *runs, const suite *of, const scene *s, const kernel_info *kernel, unsigned jobs, base_error *err)
{
    kernel_params params = kernel->defaults;
    params.cull_backface = 1;
    base_status status = measure(runs, s, kernel, &params, of->size, "larrabee", RUN_COUNT, jobs, err);
    if (status == BASE_OK && strcmp(s->name, of->core_scene) == 0 && strcmp(kernel->name, of->core_kernel) == 0)
        status = measure(runs, s, kernel, &params, of->size, "larrabee", RUN_CORE, jobs, err);
    return status;
}

/* One kernel in all models; other ways to shrink, and the shader, are counted only. */
static base_status measure_kernel(json_t *runs, const scene *s, const kernel_info *kernel, unsigned size, unsigned jobs, base_error *err)
{
    static const struct {
        const char *machine;
        run_model model;
    } ways[] = {{"larrabee", RUN_COUNT}, {"larrabee", RUN_ISSUE}, {"knc", RUN_ISSUE}, {"larrabee", RUN_CORE}, {"knc", RUN_CORE}};
    size_t rows;
    const kernel_param_info *shrink = &kernel_param_list(&rows)[KERNEL_PARAM_SHRINK];
    kernel_params params = kernel->defaults;
    base_status status = BASE_OK;
    for (size_t w = 0; status == BASE_OK && w < sizeof ways / sizeof *ways; w++)
        status = measure(runs, s, kernel, &params, size, ways[w].machine, ways[w].model, jobs, err);
    if (status == BASE_OK && (kernel->params >> KERNEL_PARAM_SHADER & 1)) {
        kernel_params shaded = params;
        shaded.shader = KERNEL_SHADER_SIMPLE;
        status = measure(runs, s, kernel, &shaded, size, "larrabee", RUN_COUNT, jobs, err);
    }
    if (!(kernel->params >> KERNEL_PARAM_SHRINK & 1))
        return status;
    for (params.shrink = shrink->min + 1; status == BASE_OK && params.shrink <= shrink->max; params.shrink++)
        status = measure(runs, s, kernel, &params, size, "larrabee", RUN_COUNT, jobs, err);
    return status;
}

static base_status measure_scene(json_t *runs, const suite *of, const scene *s, unsigned jobs, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t k = 0; status == BASE_OK && k < KERNELS && of->kernels[k]; k++) {
        const kernel_info *kernel = kernel_find(of->kernels[k]);
        status = of->scenes ? measure_long(runs, of, s, kernel, jobs, err) : measure_kernel(runs, s, kernel, of->size, jobs, err);
    }
    return status;
}

static base_status measure_suite(json_t *runs, const suite *of, unsigned jobs, base_error *err)
{
    size_t count;
    const char *const *scenes = scene_builtin_usual(&count);
    base_status status = BASE_OK;
    if (of->scenes)
        for (scenes = of->scenes, count = 0; scenes[count];)
            count++;
    for (size_t i = 0; status == BASE_OK && i < count; i++) {
        scene *s = NULL;
        status = scene_open(scenes[i], &s, err);
        if (status == BASE_OK)
            status = measure_scene(runs, of, s, jobs, err);
        scene_destroy(&s);
    }
    return status;
}

/* " PARAM=VALUE" if a run has that parameter, and it is not `none`. */
static void param_name(const json_t *run, const char *param, char text[PARAM_BYTES])
{
    const char *value = json_string_value(json_object_get(json_object_get(run, "params"), param));
    const bool shown = value && strcmp(value, "none") != 0;
    snprintf(text, PARAM_BYTES, "%s%s%s%s", shown ? " " : "", shown ? param : "", shown ? "=" : "", shown ? value : "");
}

/* What names a run: kernel, how it shrinks frusta and shades if at all, scene, model, machine. */
static void run_name(const json_t *run, char *name, size_t size)
{
    char shrink[PARAM_BYTES], shader[PARAM_BYTES];
    param_name(run, "shrink", shrink);
    param_name(run, "shader", shader);
    snprintf(name, size, "%s%s%s %s %s %s", json_string_value(json_object_get(run, "kernel")), shrink, shader,
             json_string_value(json_object_get(json_object_get(run, "scene"), "name")), json_string_value(json_object_get(run, "model")),
             json_string_value(json_object_get(json_object_get(run, "machine"), "name")));
}

typedef struct comparison {
    report_table *differences;
    size_t values; /* compared */
} comparison;

static void add_difference(comparison *c, const char *run, const char *field, const json_t *stored, const json_t *measured)
{
    char *old = stored ? json_dumps(stored, JSON_ENCODE_ANY) : NULL, *new_text = measured ? json_dumps(measured, JSON_ENCODE_ANY) : NULL;
    report_table_begin_row(c->differences);
    report_table_add_text(c->differences, run);
    report_table_add_text(c->differences, field);
    report_table_add_text(c->differences, old ? old : "absent");
    report_table_add_text(c->differences, new_text ? new_text : "absent");
    if (json_is_number(stored) && json_is_number(measured) && json_number_value(stored) != 0)
        report_table_add_real(c->differences, 100 * (json_number_value(measured) / json_number_value(stored) - 1));
    else
        report_table_add_missing(c->differences);
    free(old);
    free(new_text);
}

/* Compare two JSON values field by field; either may be absent. Objects nest a few levels deep in what stats_json makes;
   a stored file that is deeper or otherwise shaped differs at its top. */
static void compare(comparison *c, const char *run, const char *field, const json_t *stored, const json_t *measured)
{
    const char *key;
    json_t *value;
    if (!json_is_object(stored) || !json_is_object(measured)) {
        c->values++;
        if (!stored || !measured || !json_equal(stored, measured))
            add_difference(c, run, field, stored, measured);
        return;
    }
    json_object_foreach((json_t *)(uintptr_t)measured, key, value)
    {
        char inner[FIELD_BYTES];
        snprintf(inner, sizeof inner, "%s%s%s", field, *field ? "." : "", key);
        compare(c, run, inner, json_object_get(stored, key), value);
    }
    json_object_foreach((json_t *)(uintptr_t)stored, key, value)
    {
        char inner[FIELD_BYTES];
        snprintf(inner, sizeof inner, "%s%s%s", field, *field ? "." : "", key);
        if (!json_object_get(measured, key))
            compare(c, run, inner, value, NULL);
    }
}

static json_t *run_of_name(const json_t *runs, const char *name)
{
    size_t i;
    json_t *run;
    json_array_foreach((json_t *)(uintptr_t)runs, i, run)
    {
        char other[FIELD_BYTES];
        run_name(run, other, sizeof other);
        if (strcmp(name, other) == 0)
            return run;
    }
    return NULL;
}

static comparison compare_runs(const json_t *stored, const json_t *measured)
{
    size_t i;
    json_t *run;
    comparison c = {.differences = report_table_create("Differences from the stored baseline")};
    report_table_add_column(c.differences, &(report_column){.name = "run"});
    report_table_add_column(c.differences, &(report_column){.name = "field"});
    report_table_add_column(c.differences, &(report_column){.name = "stored", .align = REPORT_ALIGN_RIGHT});
    report_table_add_column(c.differences, &(report_column){.name = "measured", .align = REPORT_ALIGN_RIGHT});
    report_table_add_column(c.differences, &(report_column){.name = "change", .unit = "%", .kind = REPORT_REAL, .decimals = 3});
    json_array_foreach((json_t *)(uintptr_t)measured, i, run)
    {
        char name[FIELD_BYTES];
        run_name(run, name, sizeof name);
        compare(&c, name, "", run_of_name(stored, name), run);
    }
    json_array_foreach((json_t *)(uintptr_t)stored, i, run)
    {
        char name[FIELD_BYTES];
        run_name(run, name, sizeof name);
        if (!run_of_name(measured, name))
            compare(&c, name, "run", run, NULL);
    }
    return c;
}

static base_status store(const suite *of, const char *path, json_t *runs, base_error *err)
{
    base_output out;
    base_status status = base_output_begin(path, false, &out, err);
    if (status != BASE_OK)
        return status;
    json_t *baseline = json_pack("{s:s, s:s, s:O}", "schema", "lanetrace-baseline-1", "suite", of->name, "runs", runs);
    status = report_json_write(baseline, out.stream, err);
    json_decref(baseline);
    if (status != BASE_OK) {
        base_output_abort(&out);
        return status;
    }
    return base_output_commit(&out, err);
}

/* Read a baseline; *runs is a new reference. */
static base_status load(const char *path, json_t **runs, base_error *err)
{
    json_error_t fault;
    if (access(path, R_OK) != 0)
        return base_fail(err, BASE_ERR_INPUT, path, "there is no baseline here; lanetrace regress --update makes it");
    json_t *baseline = json_load_file(path, JSON_REJECT_DUPLICATES, &fault);
    if (!baseline)
        return base_fail(err, BASE_ERR_INPUT, path, "line %d: %s", fault.line, fault.text);
    json_t *found = json_object_get(baseline, "runs");
    const char *schema = json_string_value(json_object_get(baseline, "schema"));
    if (!json_is_array(found) || !schema || strcmp(schema, "lanetrace-baseline-1") != 0) {
        json_decref(baseline);
        return base_fail(err, BASE_ERR_INPUT, path, "no baseline of schema lanetrace-baseline-1");
    }
    *runs = json_incref(found);
    json_decref(baseline);
    return BASE_OK;
}

/* Compare and print; *differ is set if anything does. */
static base_status check(const suite *of, const char *path, const json_t *measured, bool *differ, base_error *err)
{
    json_t *stored = NULL;
    base_status status = load(path, &stored, err);
    if (status != BASE_OK)
        return status;
    comparison c = compare_runs(stored, measured);
    size_t count = report_table_rows(c.differences);
    if (count)
        status = report_table_write_text(c.differences, stdout, err);
    printf("%s: %zu values in %zu runs compared, %zu differ\n", of->name, c.values, json_array_size(measured), count);
    *differ |= count > 0;
    report_table_destroy(&c.differences);
    json_decref(stored);
    return status;
}

static base_status regress_suite(const arguments *a, const suite *of, unsigned jobs, bool *differ, base_error *err)
{
    char path[PATH_BYTES];
    const char *installed = access(LANETRACE_SOURCE_BASELINES, R_OK) == 0 ? LANETRACE_SOURCE_BASELINES : LANETRACE_INSTALLED_BASELINES;
    snprintf(path, sizeof path, "%.3900s/%s.json", a->baselines ? a->baselines : installed, of->name);
    json_t *runs = json_array();
    base_status status = measure_suite(runs, of, jobs, err);
    if (status == BASE_OK && a->update) {
        status = store(of, path, runs, err);
        if (status == BASE_OK)
            printf("%s: %zu runs stored in %s\n", of->name, json_array_size(runs), path);
    } else if (status == BASE_OK) {
        status = check(of, path, runs, differ, err);
    }
    json_decref(runs);
    return status;
}

static const suite *find_suite(const char *name)
{
    for (size_t i = 0; i < SUITES; i++)
        if (strcmp(suites[i].name, name) == 0)
            return &suites[i];
    return NULL;
}

static base_status no_suite(const char *name, base_error *err)
{
    char names[400] = "";
    for (size_t i = 0; i < SUITES; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", suites[i].name);
    return base_fail(err, BASE_ERR_USAGE, name, "no such suite (there are %s)", names);
}

static base_status regress(const arguments *a, bool *differ, base_error *err)
{
    unsigned long jobs = base_parallel_jobs();
    base_status status = BASE_OK;
    for (size_t i = 0; i < a->suites.count; i++)
        if (!find_suite(a->suites.items[i]))
            return no_suite(a->suites.items[i], err);
    if (a->jobs && command_number("--jobs", a->jobs, 1, 1024, &jobs, err) != BASE_OK)
        return err->status;
    for (size_t i = 0; status == BASE_OK && i < a->suites.count; i++)
        status = regress_suite(a, find_suite(a->suites.items[i]), (unsigned)jobs, differ, err);
    for (size_t i = 0; status == BASE_OK && !a->suites.count && i < SUITES; i++)
        if (!suites[i].scenes)
            status = regress_suite(a, &suites[i], (unsigned)jobs, differ, err);
    return status;
}

int command_regress(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    bool differ = false;
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK)
        status = regress(&a, &differ, &err);
    command_list_free(&a.suites);
    return status != BASE_OK ? command_fail(&err) : differ ? 1 : 0;
}
