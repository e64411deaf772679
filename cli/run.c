#include "cli/run.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/progress.h"
#include "cli/run_core.h"
#include "cli/run_sample.h"
#include "cli/run_trace.h"
#include "kernels/accel/kdtree_file.h"
#include "lrbni/base/parallel.h"
#include "sim/count.h"

const char *const run_model_names[RUN_MODELS] = {"native", "count", "issue", "core"};

base_status run_model_find(const char *name, run_model *out, base_error *err)
{
    for (int i = 0; i < RUN_MODELS; i++)
        if (strcmp(name, run_model_names[i]) == 0) {
            *out = (run_model)i;
            return BASE_OK;
        }
    return base_fail(err, BASE_ERR_USAGE, "--model", "no model '%s' (there are native, count, issue, core)", name);
}

/* What one host thread works with; its sums are added up at the end, and integers add up in any order. */
typedef struct run_worker {
    lrb_ctx *ctx;
    sim_issue *issue;
    trace_encoder *encoder; /* of the run's trace, or NULL */
    sim_profile *profile;     /* or NULL */
    sim_registers *registers; /* or NULL */
    base_error err;           /* of the first tile that failed */
    sim_op_counts counted;  /* RUN_COUNT while a trace is recorded: what the kernel does not count then */
    kernel_counts counts;
} run_worker;

typedef struct run_state {
    run_result *result;
    run_worker *workers;
    progress *progress;
    run_trace *trace; /* that takes what is recorded; its writer NULL: nothing is */
    size_t pass;      /* first tile of the pass */
} run_state;

/* Events for the trace, and for the model where it takes events. */
static void record_issue(void *worker, const lrb_event *events, uint32_t count)
{
    run_worker *w = worker;
    trace_encoder_events(w->encoder, events, count);
    sim_issue_events(w->issue, events, count);
}

static void analyse_issue(void *worker, const lrb_event *events, uint32_t count)
{
    run_worker *w = worker;
    sim_registers_events(w->registers, events, count);
    sim_issue_events(w->issue, events, count);
}

static void record_count(void *worker, const lrb_event *events, uint32_t count)
{
    run_worker *w = worker;
    trace_encoder_events(w->encoder, events, count);
    sim_count_events(&w->counted, events, count);
}

/* The ops that a worker has counted: the kernel did, or the sink. */
static sim_op_counts counted_ops(const run_worker *w)
{
    sim_op_counts sum = w->counted;
    for (int i = 0; i < LRB_OP_COUNT; i++)
        sum.ops[i] += w->ctx->ops[i];
    sum.memory_operands += w->ctx->memory_operands;
    sum.idle_lanes += w->ctx->idle_lanes;
    return sum;
}

/* Cycles of a tile by the count model: the whole tile's, for the ops since `before`. */
static double count_tile_cycles(const run_state *r, const run_worker *w, const sim_op_counts *before)
{
    sim_op_counts now = counted_ops(w);
    for (int i = 0; i < LRB_OP_COUNT; i++)
        now.ops[i] -= before->ops[i];
    return (double)sim_count_half_cycles(r->result->machine, now.ops) / 2;
}

/* Run the kernel on a tile at the level that the model needs, and that the trace needs. */
static void run_tile(run_state *r, uint32_t tile, unsigned worker, kernel_counts *counts)
{
    static const int levels[RUN_MODELS] = {[RUN_NATIVE] = LRB_NATIVE, [RUN_COUNT] = LRB_COUNT, [RUN_ISSUE] = LRB_RECORD};
    const run_options *o = &r->result->options;
    const bool traced = r->trace->writer != NULL;
    run_worker *w = &r->workers[worker];
    lrb_ctx *ctx = w->ctx;
    if (traced)
        run_trace_begin_tile(r->trace, worker);
    kernel_tile_fn *plain = o->kernel->tile[traced ? LRB_RECORD : levels[o->model]];
    (o->profile || o->registers ? o->kernel->annotated : plain)(ctx, r->result->job, tile, counts);
    lrb_ctx_end(ctx);
    if (w->registers && w->err.status == BASE_OK)
        sim_registers_end(w->registers, &w->err);
    if (traced)
        run_trace_end_tile(r->trace, worker, tile);
}

static void run_one_tile(void *user, size_t piece, unsigned worker_index)
{
    run_state *r = user;
    run_result *result = r->result;
    const size_t tile = r->pass + piece;
    run_worker *w = &r->workers[worker_index];
    double *cycles = result->region_cycles ? result->region_cycles + tile * (SIM_MAX_REGIONS + 1) : NULL;
    kernel_counts counts = {{0}};
    uint64_t regions[SIM_MAX_REGIONS + 1];
    sim_op_counts before;
    switch (result->options.model) {
    case RUN_NATIVE:
        run_tile(r, (uint32_t)tile, worker_index, &counts);
        break;
    case RUN_COUNT:
        before = counted_ops(w);
        run_tile(r, (uint32_t)tile, worker_index, &counts);
        cycles[SIM_MAX_REGIONS] = count_tile_cycles(r, w, &before);
        break;
    case RUN_ISSUE:
    case RUN_CORE: /* run_core does that */
    case RUN_MODELS:
        sim_issue_begin(w->issue);
        run_tile(r, (uint32_t)tile, worker_index, &counts);
        sim_issue_end(w->issue, regions);
        for (int i = 0; i <= SIM_MAX_REGIONS; i++)
            cycles[i] = (double)regions[i];
        break;
    }
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        w->counts.n[i] += counts.n[i];
    if (result->tile_counts)
        result->tile_counts[tile] = counts;
    progress_step(r->progress, worker_index);
}

static void collect_worker(run_result *result, const run_worker *w)
{
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        result->counts.n[i] += w->counts.n[i];
    if (result->options.model == RUN_COUNT) {
        sim_op_counts counted = counted_ops(w);
        for (int i = 0; i < LRB_OP_COUNT; i++)
            result->ops[i] += counted.ops[i];
        result->memory_operands += counted.memory_operands;
        result->idle_lanes += counted.idle_lanes;
    } else if (result->options.model == RUN_ISSUE) {
        sim_issue_stats_add(&result->issue, sim_issue_get(w->issue));
    }
}

static base_status collect_analyses(run_result *result, const run_worker *w, base_error *err)
{
    if (w->err.status != BASE_OK)
        return base_fail(err, w->err.status, w->err.what, "%s", w->err.why);
    if (w->registers)
        sim_registers_stats_add(&result->registers, sim_registers_get(w->registers));
    return w->profile ? sim_profile_add(result->profile, w->profile, err) : BASE_OK;
}

void run_finish_cycles(run_result *result)
{
    if (result->options.model == RUN_COUNT) {
        result->cycles = (sim_count_half_cycles(result->machine, result->ops) + 1) / 2;
    } else if (result->options.model == RUN_ISSUE) {
        memcpy(result->ops, result->issue.ops, sizeof result->ops);
        result->memory_operands = result->issue.memory_operands;
        for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
            result->idle_lanes += result->issue.phase_idle_lanes[phase];
        result->cycles = result->issue.cycles;
    }
}

/* A context whose events go where the model and the trace want them. */
static base_status create_ctx(const run_state *r, run_worker *w, base_error *err)
{
    if (w->registers)
        return lrb_ctx_create(analyse_issue, w, &w->ctx, err);
    if (!w->encoder)
        return lrb_ctx_create(sim_issue_events, w->issue, &w->ctx, err);
    switch (r->result->options.model) {
    case RUN_NATIVE:
        return lrb_ctx_create(trace_encoder_events, w->encoder, &w->ctx, err);
    case RUN_COUNT:
        return lrb_ctx_create(record_count, w, &w->ctx, err);
    default:
        return lrb_ctx_create(record_issue, w, &w->ctx, err);
    }
}

static base_status create_analyses(const run_options *o, run_worker *w, base_error *err)
{
    base_status status = o->profile ? sim_profile_create(&w->profile, err) : BASE_OK;
    if (status == BASE_OK && o->profile)
        sim_issue_set_profile(w->issue, w->profile);
    if (status == BASE_OK && o->registers)
        status = sim_registers_create(sim_file_registers, &w->registers, err);
    return status;
}

static base_status create_workers(run_state *r, unsigned jobs, base_error *err)
{
    r->workers = calloc(jobs, sizeof *r->workers);
    if (!r->workers)
        return base_fail(err, BASE_ERR_NOMEM, "--jobs", "out of memory for %u threads", jobs);
    for (unsigned i = 0; i < jobs; i++) {
        base_status status = sim_issue_create(r->result->machine, &r->workers[i].issue, err);
        if (r->trace->writer)
            r->workers[i].encoder = r->trace->workers[i].encoder;
        if (status == BASE_OK)
            status = create_analyses(&r->result->options, &r->workers[i], err);
        if (status == BASE_OK)
            status = create_ctx(r, &r->workers[i], err);
        if (status != BASE_OK)
            return status;
    }
    return BASE_OK;
}

static void destroy_workers(run_state *r, unsigned jobs)
{
    for (unsigned i = 0; r->workers && i < jobs; i++) {
        lrb_ctx_destroy(&r->workers[i].ctx);
        sim_issue_destroy(&r->workers[i].issue);
        sim_profile_destroy(&r->workers[i].profile);
        sim_registers_destroy(&r->workers[i].registers);
    }
    free(r->workers);
}

/* Run the tiles of each pass. */
static void run_passes(run_state *r)
{
    const kernel_job *job = r->result->job;
    const size_t first = kernel_job_first_pass(job);
    base_parallel_for(r->result->options.jobs, first, run_one_tile, r);
    r->pass = first;
    base_parallel_for(r->result->options.jobs, kernel_job_tiles(job) - first, run_one_tile, r);
}

/* Trace the tiles one by one: all models but core. */
static base_status trace_tiles(run_result *result, run_trace *recorded, progress *bar, base_error *err)
{
    const unsigned jobs = result->options.jobs;
    run_state r = {.result = result, .progress = bar, .trace = recorded};
    base_status status = create_workers(&r, jobs, err);
    if (status == BASE_OK) {
        run_passes(&r);
        for (unsigned i = 0; i < jobs; i++)
            collect_worker(result, &r.workers[i]);
        for (unsigned i = 0; status == BASE_OK && i < jobs; i++)
            status = collect_analyses(result, &r.workers[i], err);
        run_finish_cycles(result);
    }
    destroy_workers(&r, jobs);
    return status;
}

/* Every tile in `count`, then some in `core`, or all of them if some are not enough. */
static base_status trace_sampled(run_result *result, const recorder_input *input, progress *bar, base_error *err)
{
    bool enough = false;
    base_status status = run_sample(result, bar, &enough, err);
    if (status != BASE_OK || enough)
        return status;
    result->counts = (kernel_counts){{0}};
    result->memory_operands = result->idle_lanes = result->cycles = 0;
    result->estimate = (run_estimate){.tiles_simulated = input->tiles, .tiles = input->tiles};
    return run_core(result, input, bar, err);
}

static base_status trace(run_result *result, base_error *err)
{
    const run_options *o = &result->options;
    size_t tiles = kernel_job_tiles(result->job);
    if (o->model != RUN_NATIVE)
        result->region_cycles = calloc(tiles * (SIM_MAX_REGIONS + 1), sizeof *result->region_cycles);
    if (o->keep_tile_counts)
        result->tile_counts = calloc(tiles, sizeof *result->tile_counts);
    if ((o->model != RUN_NATIVE && !result->region_cycles) || (o->keep_tile_counts && !result->tile_counts))
        return base_fail(err, BASE_ERR_NOMEM, "--size", "out of memory for %ux%u pixels", o->width, o->height);
    run_trace recorded = {0};
    base_status status = o->profile ? sim_profile_create(&result->profile, err) : BASE_OK;
    if (status == BASE_OK)
        status = run_trace_begin(result, &recorded, err);
    if (status == BASE_OK) {
        progress bar = progress_begin(o->kernel->name, tiles, o->progress);
        double start = clock_seconds(), processor_start = clock_processor_seconds();
        recorder_input input = {.first_pass = kernel_job_first_pass(result->job), .tiles = tiles, .kernel = o->kernel, .job = result->job, .tile_counts = result->tile_counts,
                                .trace = &recorded, .annotated = o->profile || o->registers, .registers = o->registers};
        status = o->model != RUN_CORE ? trace_tiles(result, &recorded, &bar, err)
                 : o->error > 0       ? trace_sampled(result, &input, &bar, err)
                                      : run_core(result, &input, &bar, err);
        result->kernel_seconds = clock_seconds() - start;
        result->processor_seconds = clock_processor_seconds() - processor_start;
        progress_end(&bar);
    }
    if (status == BASE_OK)
        status = run_trace_commit(&recorded, result, err);
    run_trace_destroy(&recorded);
    return status;
}

static base_status build_bvh(run_result *r, base_error *err)
{
    const kernel_params *params = &r->options.params;
    bvh_options options = bvh_options_default();
    options.max_leaf = params->max_leaf;
    options.bins = params->bins;
    options.jobs = r->options.jobs;
    return bvh_build(r->scene, &options, &r->tree, err);
}

/* The tree, its occluders marked for rays from the camera and, of hard shadows, from the light. */
static base_status build_kdtree(run_result *r, base_error *err)
{
    const kernel_params *params = &r->options.params;
    const scene_primary_rays rays = scene_camera_rays(r->camera, r->options.width, r->options.height);
    float origins[2][3];
    kdtree_options options = kdtree_options_default();
    options.empty_percent = params->empty_percent;
    options.covered_planes = params->covered_planes;
    options.min_area = params->min_area;
    options.perfect_splits = params->perfect_splits;
    options.empty_occluders = params->empty_occluders;
    options.jobs = r->options.jobs;
    for (int axis = 0; axis < 3; axis++) {
        origins[0][axis] = rays.origin[axis];
        origins[1][axis] = (float)r->scene->light.point[axis];
    }
    base_error note;
    base_status status = kdtree_open(r->scene, &options, r->options.cache, &r->kdtree, &note, err);
    if (status == BASE_OK && note.status != BASE_OK)
        fprintf(stderr, "lanetrace: note: %s: %s; the kd-tree was built anew\n", note.what, note.why);
    if (status == BASE_OK && params->empty_occluders)
        status = kdtree_mark_occluders(r->kdtree, (const float(*)[3])origins, params->hard_shadows ? 2 : 1,
                                       params->cull_backface, err);
    return status;
}

/* The tree that the kernel traverses, and the job on it. */
static base_status prepare(run_result *r, base_error *err)
{
    const run_options *o = &r->options;
    const bool kd = o->kernel->accel == KERNEL_ACCEL_KDTREE;
    double start = clock_seconds();
    base_status status = kd ? build_kdtree(r, err) : build_bvh(r, err);
    r->build_seconds = clock_seconds() - start;
    if (status != BASE_OK)
        return status;
    return kd ? kernel_job_create_kdtree(r->kdtree, r->camera, &r->scene->light, o->width, o->height, &o->params, &r->job, err)
              : kernel_job_create(r->tree, r->camera, &r->scene->light, o->width, o->height, &o->params, &r->job, err);
}

base_status run_kernel(const scene *s, const sim_machine *machine, const run_options *options, run_result *out, base_error *err)
{
    *out = (run_result){.options = *options, .scene = s, .scene_name = s->name, .triangle_count = s->triangle_count, .machine = machine};
    base_status status = scene_find_camera(s, options->camera, &out->camera, err);
    if (status == BASE_OK)
        status = prepare(out, err);
    return status == BASE_OK ? trace(out, err) : status;
}

void run_result_destroy(run_result *result)
{
    kernel_job_destroy(&result->job);
    bvh_destroy(&result->tree);
    kdtree_destroy(&result->kdtree);
    sim_profile_destroy(&result->profile);
    free(result->region_cycles);
    free(result->tile_counts);
    *result = (run_result){0};
}

/* Pixels of the image among `edge` x `edge`, the first of which is (x, y). */
static unsigned pixels_from(const kernel_job *job, unsigned x, unsigned y, unsigned edge)
{
    const unsigned right = job->width - x < edge ? job->width - x : edge, down = job->height - y < edge ? job->height - y : edge;
    return right * down;
}

/* Pixels of the image in the unit of work that makes pixel (x, y). */
static unsigned unit_pixels(const kernel_job *job, unsigned x, unsigned y)
{
    const unsigned edge = JOB_TILE_PIXELS << job->unit_log2;
    return pixels_from(job, x / edge * edge, y / edge * edge, edge);
}

/* Of the second pass: the tile's, spread over its pixels. */
static double second_pass_cycles(const run_result *result, unsigned x, unsigned y)
{
    const kernel_job *job = result->job;
    const size_t unit = kernel_job_first_pass(job) + kernel_job_pixel(job, x, y).tile;
    const unsigned edge = JOB_TILE_PIXELS;
    if (!job->filtered)
        return 0;
    return result->region_cycles[unit * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS] / pixels_from(job, x / edge * edge, y / edge * edge, edge);
}

double run_pixel_cycles(const run_result *result, unsigned x, unsigned y)
{
    const kernel_job *job = result->job;
    const unsigned edge = (JOB_TILE_PIXELS << job->unit_log2) / 4;
    job_pixel p = kernel_job_pixel(job, x, y);
    const double *cycles = result->region_cycles + (size_t)p.unit * (SIM_MAX_REGIONS + 1);
    double block = cycles[p.region] / pixels_from(job, x / edge * edge, y / edge * edge, edge);
    return block + cycles[SIM_MAX_REGIONS] / unit_pixels(job, x, y) + second_pass_cycles(result, x, y);
}

double run_pixel_count(const run_result *result, kernel_counter counter, unsigned x, unsigned y)
{
    job_pixel p = kernel_job_pixel(result->job, x, y);
    return (double)result->tile_counts[p.unit].n[counter] / unit_pixels(result->job, x, y);
}

report_op_totals run_totals(const run_result *result)
{
    const report_accounts a = {.machine = result->machine, .ops = result->ops, .memory_operands = result->memory_operands,
                               .idle_lanes = result->idle_lanes};
    return report_accounts_totals(&a);
}
