#include "cli/replay_export.h"

#include <stdlib.h>

#include "cli/progress.h"
#include "cli/run_core.h"
#include "sim/issue.h"

/* Where what a model tells goes. */
typedef struct tap {
    trace_export *x;
    const replay_export_options *options;
    uint64_t before; /* issue: cycles of the tiles before this one; core: cycle of the last event */
    bool *wanted;    /* core: whether the thread is in a tile that is exported */
} tap;

static void take_issued(void *user, const sim_issued *i)
{
    const tap *t = user;
    trace_export_event(t->x, i->thread, i->event, t->before + i->cycle, t->before + i->ready, i->in_v);
}

/* One thread, tile after tile. */
static base_status export_tile(tap *t, sim_issue *issue, trace_source *source, uint32_t tile, base_error *err)
{
    uint64_t regions[SIM_MAX_REGIONS + 1];
    const lrb_event *events;
    uint32_t count = 1;
    base_status status = trace_source_seek(source, tile, err);
    trace_export_begin_tile(t->x, 0, tile, t->before);
    sim_issue_begin(issue);
    while (status == BASE_OK && count) {
        status = trace_source_next(source, &events, &count, err);
        if (status == BASE_OK)
            sim_issue_events(issue, events, count);
    }
    sim_issue_end(issue, regions);
    trace_export_end_tile(t->x, 0);
    t->before = sim_issue_get(issue)->cycles;
    return status;
}

static base_status export_issue(const trace_reader *trace, const sim_machine *machine, const replay_export_options *o, trace_export *x,
                                base_error *err)
{
    tap t = {.x = x, .options = o};
    trace_source *source = NULL;
    sim_issue *issue = NULL;
    base_status status = trace_source_create(trace, &source, err);
    if (status == BASE_OK)
        status = sim_issue_create(machine, &issue, err);
    if (status == BASE_OK)
        sim_issue_observe(issue, take_issued, &t);
    for (uint32_t tile = o->first; status == BASE_OK && tile <= o->last; tile++)
        status = export_tile(&t, issue, source, tile, err);
    sim_issue_destroy(&issue);
    trace_source_destroy(&source);
    return status;
}

static void begin_core_tile(void *user, unsigned thread, size_t tile)
{
    tap *t = user;
    t->wanted[thread] = tile >= t->options->first && tile <= t->options->last;
    if (t->wanted[thread])
        trace_export_begin_tile(t->x, thread, (uint32_t)tile, t->before);
}

static void end_core_tile(void *user, unsigned thread)
{
    tap *t = user;
    if (t->wanted[thread])
        trace_export_end_tile(t->x, thread);
}

static void take_core_issued(void *user, const sim_issued *i)
{
    tap *t = user;
    t->before = i->cycle;
    if (t->wanted[i->thread])
        trace_export_event(t->x, i->thread, i->event, i->cycle, i->ready, i->in_v);
}

/* All threads of a core, all tiles; those that are wanted are written. */
static base_status export_core(const trace_reader *trace, const identity *id, const sim_machine *machine, const replay_export_options *o,
                               trace_export *x, base_error *err)
{
    tap t = {.x = x, .options = o, .wanted = calloc(machine->threads, sizeof *t.wanted)};
    const core_watch watch = {.begin_tile = begin_core_tile, .end_tile = end_core_tile, .observer = take_core_issued, .user = &t};
    const recorder_input input = {.first_pass = id->first_pass, .tiles = trace_reader_tiles(trace), .replayed = trace, .watch = &watch};
    run_result result = {.options = {.kernel = &id->kernel, .model = RUN_CORE, .jobs = 1}, .counts = id->counts, .machine = machine};
    progress bar = progress_begin("export", input.tiles, true);
    base_status status = t.wanted ? run_core(&result, &input, &bar, err) : base_fail(err, BASE_ERR_NOMEM, "--export", "out of memory");
    progress_end(&bar);
    run_result_destroy(&result);
    free(t.wanted);
    return status;
}

base_status replay_export(const trace_reader *trace, const identity *id, const sim_machine *machine, const replay_export_options *options,
                          FILE *out, base_error *err)
{
    const bool core = options->model == RUN_CORE;
    char title[384];
    trace_export *x = NULL;
    if (core && machine->cores > 1)
        return base_fail(err, BASE_ERR_USAGE, "--export", "of one core: machine %s has cores=%u", machine->name, machine->cores);
    snprintf(title, sizeof title, "%s on %s, model %s, machine %s", id->kernel.name, id->scene_name, run_model_names[options->model],
             machine->name);
    base_status status = trace_export_create(options->kind, out, core ? machine->threads : 1, title, kernel_phase_names,
                                             KERNEL_PHASE_COUNT, &x, err);
    if (status == BASE_OK)
        status = core ? export_core(trace, id, machine, options, x, err) : export_issue(trace, machine, options, x, err);
    if (status == BASE_OK)
        status = trace_export_finish(x, err);
    trace_export_destroy(&x);
    return status;
}
