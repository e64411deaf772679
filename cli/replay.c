/* lanetrace replay: a recorded trace, timed on any machines. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/command.h"
#include "cli/replay_export.h"
#include "cli/replay_run.h"
#include "cli/stats.h"
#include "lrbni/base/output_file.h"
#include "lrbni/base/parallel.h"

enum { KEY_MACHINE = 256, KEY_SET, KEY_MODEL, KEY_JOBS, KEY_STATS, KEY_EXPORT, KEY_OUT, KEY_TILES };

static const struct argp_option option_table[] = {
    {"machine", KEY_MACHINE, "M", 0, "a machine (see lanetrace machines), or a description's path; repeatable: several are timed in one pass; default larrabee", 1},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a field of every machine; repeatable", 1},
    {"model", KEY_MODEL, "M", 0, "count, issue or core: how much of the machine is modelled; default core", 1},
    {"jobs", KEY_JOBS, "N", 0, "host threads; results do not depend on it; default: all", 1},
    {"stats", KEY_STATS, "FILE", 0, "JSON statistics, - for stdout; default: a table on stdout", 2},
    {"export", KEY_EXPORT, "FORM", 0, "instead of statistics, the events and their cycles: konata (a log for the pipeline viewer), chrome (JSON of Chrome's trace viewer and Perfetto) or csv; needs --out", 3},
    {"out", KEY_OUT, "FILE", 0, "where --export goes, - for stdout", 3},
    {"tiles", KEY_TILES, "A..B", 0, "tiles to export, the first and the last, or one; default: all", 3},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *trace, *model, *jobs, *stats, *form, *out, *tiles;
    command_list machines, sets;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_MACHINE: return command_list_add(&a->machines, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_SET: return command_list_add(&a->sets, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_MODEL: a->model = text; return 0;
    case KEY_JOBS: a->jobs = text; return 0;
    case KEY_STATS: a->stats = text; return 0;
    case KEY_EXPORT: a->form = text; return 0;
    case KEY_OUT: a->out = text; return 0;
    case KEY_TILES: a->tiles = text; return 0;
    case ARGP_KEY_ARG:
        return command_only(&a->trace, "trace", text, a->err) == BASE_OK ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, "TRACE",
    "Time a trace, recorded with run-kernel --trace, on one or several machines, or export it for other programs.\v"
    "Counts, ops and cycles are, digit for digit, those of run-kernel on that machine.",
    NULL, NULL, NULL,
};

/* What the arguments say, checked, and what comes of it. */
typedef struct plan {
    replay_options options;
    replay_export_options export; /* if arguments.form is there */
    trace_reader *trace;
    identity id;
    sim_machine **machines;
    run_result *results; /* by machine */
    size_t count;
    double load_seconds;
} plan;

static base_status plan_machines(const arguments *a, plan *p, base_error *err)
{
    static const char *const fallback[] = {"larrabee"};
    const char *const *names = a->machines.count ? a->machines.items : fallback;
    base_status status = BASE_OK;
    p->count = a->machines.count ? a->machines.count : 1;
    p->machines = calloc(p->count, sizeof *p->machines);
    p->results = calloc(p->count, sizeof *p->results);
    if (!p->machines || !p->results)
        return base_fail(err, BASE_ERR_NOMEM, "--machine", "out of memory");
    for (size_t i = 0; status == BASE_OK && i < p->count; i++)
        status = command_machine(names[i], &a->sets, &p->machines[i], err);
    return status;
}

static base_status plan_options(const arguments *a, plan *p, base_error *err)
{
    unsigned long jobs = base_parallel_jobs();
    base_status status = BASE_OK;
    p->options = (replay_options){.model = RUN_CORE, .progress = true};
    if (a->model)
        status = run_model_find(a->model, &p->options.model, err);
    if (status == BASE_OK && p->options.model == RUN_NATIVE)
        status = base_fail(err, BASE_ERR_USAGE, "--model", "native times nothing: a replay has nothing to run");
    if (status == BASE_OK && a->jobs)
        status = command_number("--jobs", a->jobs, 1, 1024, &jobs, err);
    p->options.jobs = (unsigned)jobs;
    return status;
}

/* A file that cannot be written is found before the work, not after it. */
static base_status check_output(const char *path, base_error *err)
{
    base_output out;
    if (!path || strcmp(path, "-") == 0)
        return BASE_OK;
    base_status status = base_output_begin(path, false, &out, err);
    if (status == BASE_OK)
        base_output_abort(&out);
    return status;
}

static base_status open_trace(const arguments *a, plan *p, base_error *err)
{
    double start = clock_seconds();
    base_status status = trace_reader_open(a->trace, &p->trace, err);
    if (status == BASE_OK)
        status = identity_read(a->trace, p->trace, &p->id, err);
    p->load_seconds = clock_seconds() - start;
    return status;
}

static base_status find_form(const char *name, trace_export_kind *out, base_error *err)
{
    for (int i = 0; i < TRACE_EXPORT_KINDS; i++)
        if (strcmp(name, trace_export_names[i]) == 0) {
            *out = (trace_export_kind)i;
            return BASE_OK;
        }
    return base_fail(err, BASE_ERR_USAGE, "--export", "no form '%s' (there are konata, chrome, csv)", name);
}

/* "3..17" or "5", of a trace with so many tiles. */
static base_status read_tiles(const char *text, uint32_t tiles, replay_export_options *out, base_error *err)
{
    char *end = NULL;
    unsigned long first = strtoul(text, &end, 10), last = first;
    bool good = *text >= '0' && *text <= '9';
    if (good && strncmp(end, "..", 2) == 0) {
        good = end[2] >= '0' && end[2] <= '9';
        last = strtoul(end + 2, &end, 10);
    }
    if (!good || *end || first > last || last >= tiles)
        return base_fail(err, BASE_ERR_USAGE, "--tiles", "'%s' is no tile, and no first and last of tiles, in 0..%u", text, tiles - 1);
    out->first = (uint32_t)first;
    out->last = (uint32_t)last;
    return BASE_OK;
}

static base_status plan_export(const arguments *a, plan *p, base_error *err)
{
    if (!a->form && (a->out || a->tiles))
        return base_fail(err, BASE_ERR_USAGE, a->out ? "--out" : "--tiles", "needs --export FORM");
    if (!a->form)
        return BASE_OK;
    if (!a->out)
        return base_fail(err, BASE_ERR_USAGE, "--export", "needs --out FILE");
    if (a->stats || p->count > 1)
        return base_fail(err, BASE_ERR_USAGE, "--export", a->stats ? "no --stats beside it" : "one machine at a time");
    if (p->options.model == RUN_COUNT)
        return base_fail(err, BASE_ERR_USAGE, "--export", "model count issues nothing in any cycle (take issue or core)");
    p->export.model = p->options.model;
    return find_form(a->form, &p->export.kind, err);
}

static base_status make_plan(const arguments *a, plan *p, base_error *err)
{
    if (!a->trace)
        return base_fail(err, BASE_ERR_USAGE, "TRACE", "which trace? (a file that run-kernel --trace has written)");
    base_status status = plan_options(a, p, err);
    if (status == BASE_OK)
        status = plan_machines(a, p, err);
    if (status == BASE_OK)
        status = plan_export(a, p, err);
    if (status == BASE_OK)
        status = check_output(a->form ? a->out : a->stats, err);
    if (status == BASE_OK)
        status = open_trace(a, p, err);
    if (status != BASE_OK || !a->form)
        return status;
    p->export.last = trace_reader_tiles(p->trace) - 1;
    return a->tiles ? read_tiles(a->tiles, trace_reader_tiles(p->trace), &p->export, err) : BASE_OK;
}

/* One machine: its statistics, as run-kernel writes them; several: all of them in a list. */
static base_status write_json(const plan *p, FILE *out, base_error *err)
{
    json_t *runs = json_array();
    for (size_t i = 0; i < p->count; i++)
        json_array_append_new(runs, stats_json(&p->results[i], p->load_seconds, 1));
    json_t *value = p->count == 1 ? json_incref(json_array_get(runs, 0))
                                  : json_pack("{s:s, s:O}", "schema", "lanetrace-stats-list-1", "runs", runs);
    base_status status = report_json_write(value, out, err);
    json_decref(value);
    json_decref(runs);
    return status;
}

static base_status write_tables(const plan *p, FILE *out, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < p->count; i++) {
        report_table *table = stats_table(&p->results[i], p->load_seconds);
        if (i)
            fputc('\n', out);
        status = report_table_write_text(table, out, err);
        report_table_destroy(&table);
    }
    return status;
}

static base_status write_results(const arguments *a, const plan *p, base_error *err)
{
    base_output out;
    base_status status = base_output_begin(a->stats ? a->stats : "-", true, &out, err);
    if (status != BASE_OK)
        return status;
    status = a->stats ? write_json(p, out.stream, err) : write_tables(p, out.stream, err);
    if (status == BASE_OK)
        return base_output_commit(&out, err);
    base_output_abort(&out);
    return status;
}

static base_status write_export(const arguments *a, const plan *p, base_error *err)
{
    base_output out;
    base_status status = base_output_begin(a->out, true, &out, err);
    if (status != BASE_OK)
        return status;
    status = replay_export(p->trace, &p->id, p->machines[0], &p->export, out.stream, err);
    if (status == BASE_OK)
        return base_output_commit(&out, err);
    base_output_abort(&out);
    return status;
}

static base_status run_plan(const arguments *a, plan *p, base_error *err)
{
    if (a->form)
        return write_export(a, p, err);
    base_status status = replay_run(p->trace, &p->id, p->machines, p->count, &p->options, p->results, err);
    return status == BASE_OK ? write_results(a, p, err) : status;
}

static void destroy_plan(plan *p)
{
    for (size_t i = 0; p->results && i < p->count; i++)
        run_result_destroy(&p->results[i]);
    for (size_t i = 0; p->machines && i < p->count; i++)
        sim_machine_destroy(&p->machines[i]);
    free(p->results);
    free(p->machines);
    identity_destroy(&p->id);
    trace_reader_close(&p->trace);
}

int command_replay(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    plan p = {0};
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK)
        status = make_plan(&a, &p, &err);
    if (status == BASE_OK)
        status = run_plan(&a, &p, &err);
    destroy_plan(&p);
    command_list_free(&a.machines);
    command_list_free(&a.sets);
    return status == BASE_OK ? 0 : command_fail(&err);
}
