/* lanetrace run-kernel: one kernel, one scene. */
#include <stdio.h>
#include <string.h>

#include "cli/annotate.h"
#include "cli/callgrind.h"
#include "cli/clock.h"
#include "cli/command.h"
#include "cli/listing.h"
#include "cli/picture.h"
#include "cli/registers_report.h"
#include "cli/run.h"
#include "cli/stats.h"
#include "lrbni/base/parallel.h"
#include "reports/image_writer.h"
#include "lrbni/base/output_file.h"

enum {
    KEY_SCENE = 256, KEY_CAMERA, KEY_SIZE, KEY_SAMPLES, KEY_LIGHT_SCALE, KEY_MODEL, KEY_MACHINE, KEY_SET, KEY_PARAM,
    KEY_ERROR, KEY_JOBS, KEY_STATS, KEY_IMAGE, KEY_AOV, KEY_HEATMAP, KEY_HEATMAP_OF, KEY_TRACE, KEY_STAT, KEY_ANNOTATE,
    KEY_CALLGRIND, KEY_REGISTERS, KEY_CACHE
};

static const struct argp_option option_table[] = {
    {"scene", KEY_SCENE, "SCENE", 0, "builtin:NAME (see lanetrace scenes), or a .glb or .gltf file; required", 1},
    {"camera", KEY_CAMERA, "N", 0, "index or name of the camera in the file; default: the first, or one framing the bounds", 1},
    {"size", KEY_SIZE, "WxH", 0, "image size in pixels; default 1024x1024", 1},
    {"light-scale", KEY_LIGHT_SCALE, "F", 0, "scale the light's edges about its centre; default 1", 1},
    {"samples", KEY_SAMPLES, "N", 0, "shadow rays per pixel of the soft-shadow kernels: 4, 16, 64, 256, 1024 or 4096; default 16", 1},
    {"model", KEY_MODEL, "M", 0, "native, count, issue or core: how much of the machine is modelled; default core", 2},
    {"machine", KEY_MACHINE, "M", 0, "a machine (see lanetrace machines), or a description's path; default larrabee", 2},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a field of the machine; repeatable", 2},
    {"param", KEY_PARAM, "KEY=VALUE", 0, "override a parameter of the kernel; repeatable", 2},
    {"error", KEY_ERROR, "E", 0, "simulate in core only as many tiles as bound the relative error of the cycles by E (95%); default 0: all", 2},
    {"jobs", KEY_JOBS, "N", 0, "host threads; results do not depend on it; default: all", 2},
    {"cache", KEY_CACHE, "DIR", 0, "keep kd-trees in DIR: what was built once is read the next time", 2},
    {"stats", KEY_STATS, "FILE", 0, "JSON statistics, - for stdout; default: a table on stdout", 3},
    {"stat", KEY_STAT, "FILE", OPTION_ARG_OPTIONAL, "a listing in the manner of perf stat; default: on stdout", 3},
    {"annotate", KEY_ANNOTATE, "FILE", OPTION_ARG_OPTIONAL, "the kernel's source with cycles in the margin; default: on stdout", 3},
    {"callgrind", KEY_CALLGRIND, "FILE", 0, "cycles by line for KCachegrind and callgrind_annotate", 3},
    {"registers", KEY_REGISTERS, NULL, 0, "the registers that the kernel needs, among the statistics; in core spills are timed", 3},
    {"image", KEY_IMAGE, "FILE", 0, "the rendered picture, in any format that OpenImageIO writes", 3},
    {"aov", KEY_AOV, "FILE.exr", 0, "per-pixel results: Z, prim, U, V, with shadows also visibility, with entry points complexity, with anti-aliasing marked", 3},
    {"heatmap", KEY_HEATMAP, "FILE", 0, "simulated cycles per pixel, as a picture", 3},
    {"heatmap-of", KEY_HEATMAP_OF, "COUNTER", 0, "make --heatmap of a counter instead, as aabb_tests", 3},
    {"trace", KEY_TRACE, "FILE.ltr", 0, "record the event stream, for lanetrace replay", 3},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *kernel, *scene, *camera, *size, *model, *machine, *jobs, *stats, *image, *aov, *heatmap, *heatmap_of, *trace;
    const char *light_scale, *samples, *error, *stat, *annotate, *callgrind, *cache;
    bool registers;
    command_list sets, params;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_SCENE: a->scene = text; return 0;
    case KEY_CAMERA: a->camera = text; return 0;
    case KEY_SIZE: a->size = text; return 0;
    case KEY_SAMPLES: a->samples = text; return 0;
    case KEY_LIGHT_SCALE: a->light_scale = text; return 0;
    case KEY_MODEL: a->model = text; return 0;
    case KEY_MACHINE: a->machine = text; return 0;
    case KEY_ERROR: a->error = text; return 0;
    case KEY_JOBS: a->jobs = text; return 0;
    case KEY_CACHE: a->cache = text; return 0;
    case KEY_STATS: a->stats = text; return 0;
    case KEY_STAT: a->stat = text ? text : "-"; return 0;
    case KEY_ANNOTATE: a->annotate = text ? text : "-"; return 0;
    case KEY_CALLGRIND: a->callgrind = text; return 0;
    case KEY_REGISTERS: a->registers = true; return 0;
    case KEY_IMAGE: a->image = text; return 0;
    case KEY_AOV: a->aov = text; return 0;
    case KEY_HEATMAP: a->heatmap = text; return 0;
    case KEY_HEATMAP_OF: a->heatmap_of = text; return 0;
    case KEY_SET: return command_list_add(&a->sets, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_PARAM: return command_list_add(&a->params, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_TRACE: a->trace = text; return 0;
    case ARGP_KEY_ARG:
        return command_only(&a->kernel, "kernel", text, a->err) == BASE_OK ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, "KERNEL",
    "Run one kernel (see lanetrace kernels) over one scene: operation counts, simulated cycles, pictures.\v"
    "Counts, ops and cycles are equal on every host, compiler, back end and number of jobs.",
    NULL, NULL, NULL,
};

/* What the arguments say, checked. */
typedef struct plan {
    run_options run;
    sim_machine *machine;
    scene *scene;
    double load_seconds;
    kernel_counter heat_counter; /* KERNEL_COUNTER_COUNT: cycles */
} plan;

static base_status find_counter(const kernel_info *kernel, const char *name, kernel_counter *out, base_error *err)
{
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        if (strcmp(kernel_counter_table[i].name, name) == 0 && kernel->counters >> i & 1) {
            *out = (kernel_counter)i;
            return BASE_OK;
        }
    return base_fail(err, BASE_ERR_USAGE, "--heatmap-of", "kernel %s has no counter '%s'", kernel->name, name);
}

/* Only kernels that trace shadow rays have a number of them. */
static base_status plan_samples(const char *text, plan *p, base_error *err)
{
    unsigned long samples;
    base_status status = command_number("--samples", text, 1, 4096, &samples, err);
    if (status == BASE_OK)
        status = kernel_params_check_samples(samples, err);
    if (status == BASE_OK && p->run.params.samples == 0)
        return base_fail(err, BASE_ERR_USAGE, "--samples", "kernel %s traces no shadow rays", p->run.kernel->name);
    p->run.params.samples = (unsigned)samples;
    return status;
}

static base_status plan_numbers(const arguments *a, plan *p, base_error *err)
{
    unsigned long number;
    base_status status = BASE_OK;
    p->run.width = p->run.height = 1024;
    p->run.jobs = base_parallel_jobs();
    if (a->size)
        status = command_size(a->size, &p->run.width, &p->run.height, err);
    if (status == BASE_OK && a->samples)
        status = plan_samples(a->samples, p, err);
    if (status == BASE_OK && a->light_scale)
        status = command_real("--light-scale", a->light_scale, 0, 1e6, &p->run.params.light_scale, err);
    if (status == BASE_OK && a->error)
        status = command_real("--error", a->error, 0, 1, &p->run.error, err);
    if (status == BASE_OK && a->jobs) {
        status = command_number("--jobs", a->jobs, 1, 1024, &number, err);
        p->run.jobs = (unsigned)number;
    }
    return status;
}

static base_status plan_heat_map(const arguments *a, plan *p, base_error *err)
{
    p->heat_counter = KERNEL_COUNTER_COUNT;
    if (a->heatmap_of && !a->heatmap)
        return base_fail(err, BASE_ERR_USAGE, "--heatmap-of", "needs --heatmap FILE");
    if (a->heatmap && !a->heatmap_of && p->run.model == RUN_NATIVE)
        return base_fail(err, BASE_ERR_USAGE, "--heatmap", "model native simulates no cycles (take count, issue or core, or --heatmap-of COUNTER)");
    p->run.keep_tile_counts = a->heatmap_of != NULL;
    return a->heatmap_of ? find_counter(p->run.kernel, a->heatmap_of, &p->heat_counter, err) : BASE_OK;
}

/* What looks at a kernel more closely runs its annotated form, in a model that has something to say about it. */
static base_status plan_analyses(const arguments *a, plan *p, base_error *err)
{
    const char *option = a->annotate ? "--annotate" : a->callgrind ? "--callgrind" : a->registers ? "--registers" : NULL;
    const bool timed = p->run.model == RUN_ISSUE || p->run.model == RUN_CORE;
    if ((option || a->stat) && !timed)
        return base_fail(err, BASE_ERR_USAGE, option ? option : "--stat", "model %s says no more than its total (take issue or core)",
                         run_model_names[p->run.model]);
    if (option && a->trace)
        return base_fail(err, BASE_ERR_USAGE, option, "not together with --trace, which records the plain kernel");
    if (p->run.error > 0 && p->run.model != RUN_CORE)
        return base_fail(err, BASE_ERR_USAGE, "--error", "samples tiles of model core, not of %s", run_model_names[p->run.model]);
    if (p->run.error > 0 && (option || a->trace))
        return base_fail(err, BASE_ERR_USAGE, option ? option : "--trace", "not together with --error, which simulates a few tiles only");
    if (option && !p->run.kernel->annotated)
        return base_fail(err, BASE_ERR_UNSUPPORTED, option, "kernel %s was not built with annotations", p->run.kernel->name);
    p->run.profile = a->annotate || a->callgrind;
    p->run.registers = a->registers;
    return BASE_OK;
}

static bool is_stdout(const char *path) { return path && strcmp(path, "-") == 0; }

/* A file that cannot be written is found before the work, not after it. */
static base_status check_outputs(const arguments *a, base_error *err)
{
    enum { TEXTS = 4 }; /* that may go to stdout, one of them */
    const char *paths[] = {a->stats, a->stat, a->annotate, a->callgrind, a->image, a->aov, a->heatmap, a->trace};
    if (is_stdout(a->stats) + is_stdout(a->stat) + is_stdout(a->annotate) + is_stdout(a->callgrind) > 1)
        return base_fail(err, BASE_ERR_USAGE, "-", "only one of --stats, --stat, --annotate and --callgrind can go to stdout");
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        base_output out;
        if (!paths[i] || (i < TEXTS && is_stdout(paths[i])))
            continue;
        base_status status = base_output_begin(paths[i], false, &out, err);
        if (status != BASE_OK)
            return status;
        base_output_abort(&out);
    }
    return BASE_OK;
}

static base_status make_plan(const arguments *a, plan *p, base_error *err)
{
    base_status status;
    if (!a->kernel)
        return base_fail(err, BASE_ERR_USAGE, "KERNEL", "which kernel? (see lanetrace kernels)");
    if (!a->scene)
        return base_fail(err, BASE_ERR_USAGE, "--scene", "which scene? builtin:NAME or a .glb or .gltf file");
    status = command_kernel(a->kernel, &p->run.kernel, err);
    if (status != BASE_OK)
        return status;
    p->run.params = p->run.kernel->defaults;
    for (size_t i = 0; status == BASE_OK && i < a->params.count; i++)
        status = kernel_params_set(&p->run.params, p->run.kernel->params, a->params.items[i], err);
    if (status == BASE_OK)
        status = plan_numbers(a, p, err);
    p->run.model = RUN_CORE;
    if (status == BASE_OK && a->model)
        status = run_model_find(a->model, &p->run.model, err);
    if (status == BASE_OK)
        status = plan_heat_map(a, p, err);
    if (status == BASE_OK)
        status = plan_analyses(a, p, err);
    if (status == BASE_OK)
        status = command_machine(a->machine ? a->machine : "larrabee", &a->sets, &p->machine, err);
    if (status == BASE_OK && a->cache && p->run.kernel->accel != KERNEL_ACCEL_KDTREE)
        status = base_fail(err, BASE_ERR_USAGE, "--cache", "keeps kd-trees; kernel %s has none", p->run.kernel->name);
    if (status == BASE_OK)
        status = check_outputs(a, err);
    p->run.camera = a->camera;
    p->run.trace = a->trace;
    p->run.cache = a->cache;
    p->run.progress = true;
    return status;
}

static base_status end_output(base_output *out, base_status written, base_error *err)
{
    if (written == BASE_OK)
        return base_output_commit(out, err);
    base_output_abort(out);
    return written;
}

static base_status write_tables(const plan *p, const run_result *result, FILE *out, base_error *err)
{
    report_table *table = stats_table(result, p->load_seconds);
    base_status status = report_table_write_text(table, out, err);
    report_table_destroy(&table);
    if (status == BASE_OK && result->options.registers) {
        table = registers_table(result);
        fputc('\n', out);
        status = report_table_write_text(table, out, err);
        report_table_destroy(&table);
    }
    return status;
}

/* JSON where it is wanted; otherwise tables on stdout, unless that is another text's. */
static base_status write_stats(const arguments *a, const plan *p, const run_result *result, base_error *err)
{
    base_output out;
    if (!a->stats && (is_stdout(a->stat) || is_stdout(a->annotate) || is_stdout(a->callgrind)))
        return BASE_OK;
    base_status status = base_output_begin(a->stats ? a->stats : "-", true, &out, err);
    if (status != BASE_OK)
        return status;
    if (a->stats) {
        json_t *stats = stats_json(result, p->load_seconds, 1);
        status = report_json_write(stats, out.stream, err);
        json_decref(stats);
    } else {
        status = write_tables(p, result, out.stream, err);
    }
    return end_output(&out, status, err);
}

/* Write a text to a file or to stdout; path NULL: nowhere. */
static base_status write_text(const char *path, base_status (*write)(const run_result *, FILE *, base_error *),
                              const run_result *result, base_error *err)
{
    base_output out;
    if (!path)
        return BASE_OK;
    base_status status = base_output_begin(path, true, &out, err);
    return status == BASE_OK ? end_output(&out, write(result, out.stream, err), err) : status;
}

static base_status write_picture(const char *path, report_image *image, base_status made, base_error *err)
{
    base_status status = made == BASE_OK ? report_image_write(path, image, err) : made;
    report_image_destroy(image);
    return status;
}

static base_status write_results(const arguments *a, const plan *p, const run_result *result, base_error *err)
{
    report_image image = {0};
    base_status status = BASE_OK;
    if (a->image)
        status = write_picture(a->image, &image, picture_shaded(result, &image, err), err);
    if (status == BASE_OK && a->heatmap)
        status = write_picture(a->heatmap, &image, picture_heat_map(result, p->heat_counter, 0, &image, err), err);
    if (status == BASE_OK && a->aov)
        status = picture_write_aov(result, a->aov, err);
    if (status == BASE_OK)
        status = write_text(a->stat, listing_write, result, err);
    if (status == BASE_OK)
        status = write_text(a->annotate, annotate_write, result, err);
    if (status == BASE_OK)
        status = write_text(a->callgrind, callgrind_write, result, err);
    return status == BASE_OK ? write_stats(a, p, result, err) : status;
}

static base_status run_plan(const arguments *a, plan *p, base_error *err)
{
    run_result result = {0};
    double start = clock_seconds();
    base_status status = scene_open(a->scene, &p->scene, err);
    p->load_seconds = clock_seconds() - start;
    if (status != BASE_OK)
        return status;
    status = run_kernel(p->scene, p->machine, &p->run, &result, err);
    if (status == BASE_OK)
        status = write_results(a, p, &result, err);
    run_result_destroy(&result);
    return status;
}

int command_run_kernel(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    plan p = {0};
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK)
        status = make_plan(&a, &p, &err);
    if (status == BASE_OK)
        status = run_plan(&a, &p, &err);
    scene_destroy(&p.scene);
    sim_machine_destroy(&p.machine);
    command_list_free(&a.sets);
    command_list_free(&a.params);
    return status == BASE_OK ? 0 : command_fail(&err);
}
