/* lanetrace sensitivity: what each number of a machine is worth to a kernel, in cycles. One recording, timed on the machine and
 * on all that differ from it in one number. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/command.h"
#include "cli/replay_run.h"
#include "cli/stats.h"
#include "lrbni/base/output_file.h"
#include "lrbni/base/parallel.h"
#include "sim/neighbours.h"

enum { KEY_SCENE = 256, KEY_CAMERA, KEY_SIZE, KEY_PARAM, KEY_MODEL, KEY_MACHINE, KEY_SET, KEY_JOBS, KEY_JSON };

static const struct argp_option option_table[] = {
    {"scene", KEY_SCENE, "SCENE", 0, "builtin:NAME (see lanetrace scenes), or a .glb or .gltf file; required for a kernel", 1},
    {"camera", KEY_CAMERA, "N", 0, "index or name of the camera in the file", 1},
    {"size", KEY_SIZE, "WxH", 0, "image size in pixels; default 256x256", 1},
    {"param", KEY_PARAM, "KEY=VALUE", 0, "override a parameter of the kernel; repeatable", 1},
    {"model", KEY_MODEL, "M", 0, "issue or core; default core", 2},
    {"machine", KEY_MACHINE, "M", 0, "a machine (see lanetrace machines), or a description's path; default larrabee", 2},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a field of the machine; repeatable", 2},
    {"jobs", KEY_JOBS, "N", 0, "host threads; results do not depend on it; default: all", 2},
    {"json", KEY_JSON, NULL, 0, "JSON instead of a table", 3},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *subject, *scene, *camera, *size, *model, *machine, *jobs;
    command_list sets, params;
    bool json;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_SCENE: a->scene = text; return 0;
    case KEY_CAMERA: a->camera = text; return 0;
    case KEY_SIZE: a->size = text; return 0;
    case KEY_PARAM: return command_list_add(&a->params, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_MODEL: a->model = text; return 0;
    case KEY_MACHINE: a->machine = text; return 0;
    case KEY_SET: return command_list_add(&a->sets, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_JOBS: a->jobs = text; return 0;
    case KEY_JSON: a->json = true; return 0;
    case ARGP_KEY_ARG:
        return command_only(&a->subject, "kernel or trace", text, a->err) == BASE_OK ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, "KERNEL|TRACE.ltr",
    "What each number of a machine is worth: the kernel is recorded once, or was (run-kernel --trace), and timed on the machine and "
    "on all machines that differ from it in one number, by one step (docs/where-cycles-go.md).",
    NULL, NULL, NULL,
};

/* What the arguments say, and what comes of it. */
typedef struct plan {
    replay_options options;
    trace_reader *trace;
    identity id;
    sim_machine *machine;
    sim_neighbours neighbours;
    run_result base, *results; /* of the machine, and by neighbour */
} plan;

static bool is_trace(const char *subject)
{
    size_t length = strlen(subject);
    return length > 4 && strcmp(subject + length - 4, ".ltr") == 0;
}

static base_status plan_options(const arguments *a, plan *p, base_error *err)
{
    unsigned long jobs = base_parallel_jobs();
    base_status status = BASE_OK;
    if (!a->subject)
        return base_fail(err, BASE_ERR_USAGE, "KERNEL", "which kernel, or which trace? (see lanetrace kernels)");
    if (!is_trace(a->subject) && !a->scene)
        return base_fail(err, BASE_ERR_USAGE, "--scene", "which scene? builtin:NAME or a .glb or .gltf file");
    if (is_trace(a->subject) && (a->scene || a->camera || a->size || a->params.count))
        return base_fail(err, BASE_ERR_USAGE, a->subject, "a trace has its scene, size and parameters already");
    p->options.model = RUN_CORE;
    if (a->model)
        status = run_model_find(a->model, &p->options.model, err);
    if (status == BASE_OK && p->options.model != RUN_ISSUE && p->options.model != RUN_CORE)
        status = base_fail(err, BASE_ERR_USAGE, "--model", "model %s waits for nothing (take issue or core)", run_model_names[p->options.model]);
    if (status == BASE_OK && a->jobs)
        status = command_number("--jobs", a->jobs, 1, 1024, &jobs, err);
    p->options.jobs = (unsigned)jobs;
    return status == BASE_OK ? command_machine(a->machine ? a->machine : "larrabee", &a->sets, &p->machine, err) : status;
}

/* Run the kernel without a model, for its trace. */
static base_status record_to(const arguments *a, const plan *p, const char *path, base_error *err)
{
    run_options run = {.camera = a->camera, .width = 256, .height = 256, .model = RUN_NATIVE, .jobs = p->options.jobs, .progress = true,
                       .trace = path};
    run_result result = {0};
    scene *s = NULL;
    base_status status = command_kernel(a->subject, &run.kernel, err);
    if (status != BASE_OK)
        return status;
    run.params = run.kernel->defaults;
    for (size_t i = 0; status == BASE_OK && i < a->params.count; i++)
        status = kernel_params_set(&run.params, run.kernel->params, a->params.items[i], err);
    if (status == BASE_OK && a->size)
        status = command_size(a->size, &run.width, &run.height, err);
    if (status == BASE_OK)
        status = scene_open(a->scene, &s, err);
    if (status == BASE_OK)
        status = run_kernel(s, p->machine, &run, &result, err);
    run_result_destroy(&result);
    scene_destroy(&s);
    return status;
}

/* Record to a file that nobody else sees, and that is gone when the program ends, however it does. */
static base_status record(const arguments *a, plan *p, base_error *err)
{
    char path[512];
    const char *folder = getenv("TMPDIR");
    int n = snprintf(path, sizeof path, "%s/lanetrace-XXXXXX.ltr", folder && *folder ? folder : "/tmp");
    int file = n < (int)sizeof path ? mkstemps(path, 4) : -1;
    if (file < 0)
        return base_fail(err, BASE_ERR_INPUT, "TMPDIR", "no file can be made in '%s'", folder && *folder ? folder : "/tmp");
    close(file);
    base_status status = record_to(a, p, path, err);
    if (status == BASE_OK)
        status = trace_reader_open(path, &p->trace, err);
    unlink(path);
    return status == BASE_OK ? identity_read("the recording", p->trace, &p->id, err) : status;
}

static base_status open_trace(const arguments *a, plan *p, base_error *err)
{
    base_status status = trace_reader_open(a->subject, &p->trace, err);
    return status == BASE_OK ? identity_read(a->subject, p->trace, &p->id, err) : status;
}

/* Cost classes that the kernel has ops of. */
static uint32_t classes_of(const run_result *result)
{
    uint32_t classes = 0;
    for (int id = 0; id < LRB_OP_COUNT; id++)
        if (result->ops[id])
            classes |= UINT32_C(1) << lrb_op_table[id].class_id;
    return classes;
}

/* The neighbours, so many at a time: each needs memory of its own, and a thread. */
static base_status time_neighbours(plan *p, base_error *err)
{
    enum { AT_ONCE = 32 };
    sim_machine *machines[AT_ONCE];
    base_status status = BASE_OK;
    p->results = calloc(p->neighbours.count + 1, sizeof *p->results);
    if (!p->results)
        return base_fail(err, BASE_ERR_NOMEM, "--machine", "out of memory");
    for (size_t first = 0; status == BASE_OK && first < p->neighbours.count; first += AT_ONCE) {
        size_t count = p->neighbours.count - first < AT_ONCE ? p->neighbours.count - first : AT_ONCE;
        for (size_t i = 0; i < count; i++)
            machines[i] = p->neighbours.list[first + i].machine;
        status = replay_run(p->trace, &p->id, machines, count, &p->options, p->results + first, err);
    }
    return status;
}

static base_status time_all(plan *p, base_error *err)
{
    base_status status = replay_run(p->trace, &p->id, &p->machine, 1, &p->options, &p->base, err);
    if (status == BASE_OK)
        status = sim_neighbours_create(p->machine, run_model_names[p->options.model], classes_of(&p->base), &p->neighbours, err);
    return status == BASE_OK ? time_neighbours(p, err) : status;
}

static uint64_t distance(uint64_t a, uint64_t b) { return a > b ? a - b : b - a; }

/* Neighbours by how far their cycles are from the machine's, farthest first; those as far as each other in the order of fields.
   For free(); NULL if out of memory. */
static size_t *sort_neighbours(const plan *p)
{
    size_t *order = malloc((p->neighbours.count + 1) * sizeof *order);
    for (size_t i = 0; order && i < p->neighbours.count; i++) {
        size_t at = i;
        while (at > 0 && distance(p->results[order[at - 1]].cycles, p->base.cycles) < distance(p->results[i].cycles, p->base.cycles)) {
            order[at] = order[at - 1];
            at--;
        }
        order[at] = i;
    }
    return order;
}

static void add_neighbour(report_table *t, const plan *p, size_t i, const uint64_t charged[SIM_FIELDS])
{
    const sim_neighbour *n = &p->neighbours.list[i];
    const int64_t change = (int64_t)(p->results[i].cycles - p->base.cycles);
    sim_field_view view;
    char name[80];
    sim_machine_field(p->machine, n->field, &view);
    snprintf(name, sizeof name, "%s.%s", view.section, view.key);
    report_table_begin_row(t);
    report_table_add_text(t, name);
    report_table_add_text(t, view.value);
    report_table_add_text(t, n->value);
    report_table_add_integer(t, (int64_t)p->results[i].cycles);
    report_table_add_integer(t, change);
    report_table_add_real(t, 100 * (double)change / (double)p->base.cycles);
    report_table_add_integer(t, (int64_t)charged[n->field]);
}

static void add_notes(report_table *t, const plan *p)
{
    char text[1024] = "Cannot change alone:";
    size_t length = strlen(text);
    sim_field_view view;
    for (size_t i = 0; i < p->neighbours.stuck_count && length < sizeof text; i++) {
        sim_machine_field(p->machine, p->neighbours.stuck[i], &view);
        length += (size_t)snprintf(text + length, sizeof text - length, "%s %s.%s", i ? "," : "", view.section, view.key);
    }
    if (p->neighbours.stuck_count)
        report_table_add_note(t, text);
    report_table_add_note(t, "Charged: cycles of the machine's own run that went to this number, issues of a class to its throughput.");
    report_table_add_note(t, "Numbers that the model does not read, and those of classes that the kernel has no op of, are worth nothing.");
}

static report_table *make_table(const plan *p, const size_t *order)
{
    static const report_column columns[] = {
        {.name = "field"}, {.name = "value", .align = REPORT_ALIGN_RIGHT}, {.name = "changed to", .align = REPORT_ALIGN_RIGHT},
        {.name = "cycles", .kind = REPORT_INTEGER}, {.name = "change", .kind = REPORT_INTEGER},
        {.name = "change of all", .unit = "%", .kind = REPORT_REAL, .decimals = 3}, {.name = "charged", .kind = REPORT_INTEGER},
    };
    uint64_t charged[SIM_FIELDS];
    char title[STATS_TITLE_SIZE], caption[64];
    stats_title(&p->base, title, sizeof title);
    snprintf(caption, sizeof caption, "The machine itself: %llu cycles.", (unsigned long long)p->base.cycles);
    report_table *t = report_table_create(title);
    report_table_set_caption(t, caption);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        report_table_add_column(t, &columns[i]);
    stats_cycles_by_field(&p->base, charged);
    for (size_t i = 0; i < p->neighbours.count; i++)
        add_neighbour(t, p, order[i], charged);
    add_notes(t, p);
    return t;
}

static base_status write_table(const arguments *a, const plan *p, base_error *err)
{
    base_output out;
    size_t *order = sort_neighbours(p);
    if (!order)
        return base_fail(err, BASE_ERR_NOMEM, "--machine", "out of memory");
    report_table *t = make_table(p, order);
    free(order);
    base_status status = base_output_begin("-", true, &out, err);
    if (status == BASE_OK) {
        status = a->json ? report_table_write_json(t, out.stream, err) : report_table_write_text(t, out.stream, err);
        if (status == BASE_OK)
            status = base_output_commit(&out, err);
        else
            base_output_abort(&out);
    }
    report_table_destroy(&t);
    return status;
}

static void destroy_plan(plan *p)
{
    for (size_t i = 0; p->results && i < p->neighbours.count; i++)
        run_result_destroy(&p->results[i]);
    free(p->results);
    run_result_destroy(&p->base);
    sim_neighbours_destroy(&p->neighbours);
    sim_machine_destroy(&p->machine);
    identity_destroy(&p->id);
    trace_reader_close(&p->trace);
}

int command_sensitivity(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    plan p = {.options = {.progress = true}};
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK)
        status = plan_options(&a, &p, &err);
    if (status == BASE_OK)
        status = is_trace(a.subject) ? open_trace(&a, &p, &err) : record(&a, &p, &err);
    if (status == BASE_OK)
        status = time_all(&p, &err);
    if (status == BASE_OK)
        status = write_table(&a, &p, &err);
    destroy_plan(&p);
    command_list_free(&a.sets);
    command_list_free(&a.params);
    return status == BASE_OK ? 0 : command_fail(&err);
}
