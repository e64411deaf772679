#include "cli/replay_export.h"

#include "sim/issue.h"

/* Where what a model tells goes. */
typedef struct tap {
    trace_export *x;
    uint64_t before; /* cycles of the tiles before this one */
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
    tap t = {.x = x};
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

base_status replay_export(const trace_reader *trace, const identity *id, const sim_machine *machine, const replay_export_options *options,
                          FILE *out, base_error *err)
{
    char title[384];
    trace_export *x = NULL;
    snprintf(title, sizeof title, "%s on %s, model %s, machine %s", id->kernel.name, id->scene_name, run_model_names[options->model],
             machine->name);
    base_status status = trace_export_create(options->kind, out, 1, title, kernel_phase_names, KERNEL_PHASE_COUNT, &x, err);
    if (status == BASE_OK)
        status = export_issue(trace, machine, options, x, err);
    if (status == BASE_OK)
        status = trace_export_finish(x, err);
    trace_export_destroy(&x);
    return status;
}
