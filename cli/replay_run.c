#include "cli/replay_run.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/progress.h"
#include "cli/run_core.h"
#include "lrbni/base/parallel.h"
#include "sim/count.h"

/* What one host thread works with. */
typedef struct replay_worker {
    trace_source *source;
    sim_issue **issue;     /* by machine */
    sim_op_counts counted; /* the same for all machines */
    base_error err;        /* of the tile that failed */
    size_t failed;
} replay_worker;

typedef struct replay_state {
    run_model model;
    sim_machine *const *machines;
    size_t count;
    replay_worker *workers;
    unsigned jobs;
    progress progress;
    atomic_bool failed; /* some tile has: begin no other */
} replay_state;

static void take_events(const replay_state *r, replay_worker *w, const lrb_event *events, uint32_t count)
{
    if (r->model == RUN_COUNT)
        sim_count_events(&w->counted, events, count);
    else
        for (size_t m = 0; m < r->count; m++)
            sim_issue_events(w->issue[m], events, count);
}

static base_status time_tile(const replay_state *r, replay_worker *w, uint32_t tile)
{
    uint64_t regions[SIM_MAX_REGIONS + 1];
    const lrb_event *events;
    uint32_t count = 1;
    base_status status = trace_source_seek(w->source, tile, &w->err);
    for (size_t m = 0; r->model == RUN_ISSUE && m < r->count; m++)
        sim_issue_begin(w->issue[m]);
    while (status == BASE_OK && count) {
        status = trace_source_next(w->source, &events, &count, &w->err);
        if (status == BASE_OK)
            take_events(r, w, events, count);
    }
    for (size_t m = 0; r->model == RUN_ISSUE && m < r->count; m++)
        sim_issue_end(w->issue[m], regions);
    return status;
}

static void replay_tile(void *user, size_t tile, unsigned worker)
{
    replay_state *r = user;
    replay_worker *w = &r->workers[worker];
    if (atomic_load(&r->failed))
        return;
    if (time_tile(r, w, (uint32_t)tile) != BASE_OK) {
        w->failed = tile;
        atomic_store(&r->failed, true);
    }
    progress_step(&r->progress, worker);
}

static base_status create_workers(replay_state *r, const trace_reader *trace, base_error *err)
{
    base_status status = BASE_OK;
    r->workers = calloc(r->jobs, sizeof *r->workers);
    if (!r->workers)
        return base_fail(err, BASE_ERR_NOMEM, "--jobs", "out of memory for %u threads", r->jobs);
    for (unsigned i = 0; status == BASE_OK && i < r->jobs; i++) {
        replay_worker *w = &r->workers[i];
        w->issue = calloc(r->count, sizeof *w->issue);
        status = w->issue ? trace_source_create(trace, &w->source, err) : base_fail(err, BASE_ERR_NOMEM, "replay", "out of memory");
        for (size_t m = 0; status == BASE_OK && m < r->count; m++)
            status = sim_issue_create(r->machines[m], &w->issue[m], err);
    }
    return status;
}

static void destroy_workers(replay_state *r)
{
    for (unsigned i = 0; r->workers && i < r->jobs; i++) {
        replay_worker *w = &r->workers[i];
        for (size_t m = 0; w->issue && m < r->count; m++)
            sim_issue_destroy(&w->issue[m]);
        free(w->issue);
        trace_source_destroy(&w->source);
    }
    free(r->workers);
}

/* Tiles are handed out in order, so the first that is damaged is always among those that were begun. */
static base_status first_failure(const replay_state *r, base_error *err)
{
    const replay_worker *first = NULL;
    for (unsigned i = 0; i < r->jobs; i++)
        if (r->workers[i].err.status != BASE_OK && (!first || r->workers[i].failed < first->failed))
            first = &r->workers[i];
    return first ? base_fail(err, first->err.status, first->err.what, "%s", first->err.why) : BASE_OK;
}

static void collect_counts(const replay_state *r, run_result *result)
{
    for (unsigned i = 0; i < r->jobs; i++) {
        const sim_op_counts *counted = &r->workers[i].counted;
        for (int op = 0; op < LRB_OP_COUNT; op++)
            result->ops[op] += counted->ops[op];
        result->memory_operands += counted->memory_operands;
        result->idle_lanes += counted->idle_lanes;
    }
    run_finish_cycles(result);
}

static void collect(const replay_state *r, const identity *id, double seconds, run_result *results)
{
    for (size_t m = 0; m < r->count; m++) {
        run_result *result = &results[m];
        result->kernel_seconds = seconds;
        result->counts = id->counts;
        for (unsigned i = 0; r->model == RUN_ISSUE && i < r->jobs; i++)
            sim_issue_stats_add(&result->issue, sim_issue_get(r->workers[i].issue[m]));
        collect_counts(r, result);
    }
}

/* Count and issue: tile by tile, each for all machines. */
static base_status replay_tiles(const trace_reader *trace, const identity *id, replay_state *r, run_result *results, base_error *err)
{
    base_status status = create_workers(r, trace, err);
    if (status == BASE_OK) {
        double start = clock_seconds();
        base_parallel_for(r->jobs, trace_reader_tiles(trace), replay_tile, r);
        status = first_failure(r, err);
        if (status == BASE_OK)
            collect(r, id, clock_seconds() - start, results);
    }
    destroy_workers(r);
    return status;
}

/* One machine of several that read the trace together. */
typedef struct core_member {
    run_result *result;
    recorder_input input;
    progress *bar;
    base_error err;
    pthread_t thread;
} core_member;

static void *run_member(void *user)
{
    core_member *m = user;
    tile_exchange_enter(m->input.exchange);
    run_core(m->result, &m->input, m->bar, &m->err);
    tile_exchange_leave(m->input.exchange, m->input.member);
    return NULL;
}

/* Run all members, each in a thread; for one that the host has no thread for, none is left. */
static base_status run_members(core_member *members, size_t count, base_error *err)
{
    size_t started = 0;
    while (started < count && pthread_create(&members[started].thread, NULL, run_member, &members[started]) == 0)
        started++;
    for (size_t m = started; m < count; m++) {
        base_fail(&members[m].err, BASE_ERR_NOMEM, "--machine", "no thread for machine %s", members[m].result->machine->name);
        tile_exchange_enter(members[m].input.exchange);
        tile_exchange_leave(members[m].input.exchange, members[m].input.member);
    }
    for (size_t m = 0; m < started; m++)
        pthread_join(members[m].thread, NULL);
    for (size_t m = 0; m < count; m++)
        if (members[m].err.status != BASE_OK)
            return base_fail(err, members[m].err.status, members[m].err.what, "%s", members[m].err.why);
    return BASE_OK;
}

/* Core, several machines of a core each: side by side, each tile decoded once. */
static base_status replay_together(const trace_reader *trace, const identity *id, replay_state *r, run_result *results, base_error *err)
{
    core_member *members = calloc(r->count, sizeof *members);
    tile_exchange *exchange = NULL;
    base_status status = BASE_OK;
    if (!members)
        status = base_fail(err, BASE_ERR_NOMEM, "--machine", "out of memory");
    if (status == BASE_OK)
        status = tile_exchange_create(trace, (unsigned)r->count, r->jobs, &exchange, err);
    for (size_t m = 0; status == BASE_OK && m < r->count; m++) {
        members[m] = (core_member){.result = &results[m], .bar = &r->progress};
        members[m].input = (recorder_input){.first_pass = id->first_pass, .tiles = trace_reader_tiles(trace), .replayed = trace, .exchange = exchange,
                                            .member = (unsigned)m};
        results[m].options.jobs = 1; /* of the machine's own; the others run meanwhile */
    }
    if (status == BASE_OK)
        status = run_members(members, r->count, err);
    for (size_t m = 0; m < r->count; m++)
        results[m].options.jobs = r->jobs;
    tile_exchange_destroy(&exchange);
    free(members);
    return status;
}

static base_status replay_one_by_one(const trace_reader *trace, const identity *id, replay_state *r, run_result *results, base_error *err)
{
    const recorder_input input = {.first_pass = id->first_pass, .tiles = trace_reader_tiles(trace), .replayed = trace};
    base_status status = BASE_OK;
    for (size_t m = 0; status == BASE_OK && m < r->count; m++)
        status = run_core(&results[m], &input, &r->progress, err);
    return status;
}

/* Core: its threads take tiles when they run dry, each machine's at other times; several cores share them out in their own way. */
static base_status replay_cores(const trace_reader *trace, const identity *id, replay_state *r, run_result *results, base_error *err)
{
    const double start = clock_seconds();
    bool together = r->count > 1;
    for (size_t m = 0; m < r->count; m++) {
        results[m].counts = id->counts;
        together &= r->machines[m]->cores == 1;
    }
    base_status status = together ? replay_together(trace, id, r, results, err) : replay_one_by_one(trace, id, r, results, err);
    for (size_t m = 0; m < r->count; m++)
        results[m].kernel_seconds = clock_seconds() - start;
    return status;
}

base_status replay_run(const trace_reader *trace, const identity *id, sim_machine *const *machines, size_t count,
                       const replay_options *options, run_result *results, base_error *err)
{
    const size_t tiles = trace_reader_tiles(trace);
    replay_state r = {.model = options->model, .machines = machines, .count = count, .jobs = options->jobs};
    for (size_t m = 0; m < count; m++)
        results[m] = (run_result){
            .options = {.kernel = &id->kernel, .width = id->width, .height = id->height, .model = options->model, .jobs = options->jobs},
            .scene_name = id->scene_name,
            .triangle_count = id->triangles,
            .traced = id->json,
            .machine = machines[m],
        };
    r.progress = progress_begin("replay", options->model == RUN_CORE ? tiles * count : tiles, options->progress);
    base_status status = options->model == RUN_CORE ? replay_cores(trace, id, &r, results, err)
                                                    : replay_tiles(trace, id, &r, results, err);
    progress_end(&r.progress);
    return status;
}
