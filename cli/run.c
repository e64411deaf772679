#include "cli/run.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clock.h"
#include "cli/progress.h"
#include "cli/run_core.h"
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
    kernel_counts counts;
} run_worker;

typedef struct run_state {
    run_result *result;
    run_worker *workers;
    progress *progress;
} run_state;

/* Cycles of a tile by the count model: the whole tile's, for the ops since `before`. */
static double count_tile_cycles(const run_state *r, const lrb_ctx *ctx, const uint64_t *before)
{
    uint64_t ops[LRB_OP_COUNT];
    for (int i = 0; i < LRB_OP_COUNT; i++)
        ops[i] = ctx->ops[i] - before[i];
    return (double)sim_count_half_cycles(r->result->machine, ops) / 2;
}

static void trace_tile(void *user, size_t tile, unsigned worker_index)
{
    run_state *r = user;
    run_result *result = r->result;
    run_worker *w = &r->workers[worker_index];
    double *cycles = result->region_cycles ? result->region_cycles + tile * (SIM_MAX_REGIONS + 1) : NULL;
    kernel_counts counts = {{0}};
    kernel_tile_fn *const *levels = result->options.kernel->tile;
    uint64_t regions[SIM_MAX_REGIONS + 1], ops_before[LRB_OP_COUNT];
    switch (result->options.model) {
    case RUN_NATIVE:
        levels[LRB_NATIVE](w->ctx, result->job, (uint32_t)tile, &counts);
        break;
    case RUN_COUNT:
        memcpy(ops_before, w->ctx->ops, sizeof ops_before);
        levels[LRB_COUNT](w->ctx, result->job, (uint32_t)tile, &counts);
        cycles[SIM_MAX_REGIONS] = count_tile_cycles(r, w->ctx, ops_before);
        break;
    case RUN_ISSUE:
    case RUN_CORE: /* run_core does that */
    case RUN_MODELS:
        sim_issue_begin(w->issue);
        levels[LRB_RECORD](w->ctx, result->job, (uint32_t)tile, &counts);
        lrb_ctx_end(w->ctx);
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
        for (int i = 0; i < LRB_OP_COUNT; i++)
            result->ops[i] += w->ctx->ops[i];
        result->memory_operands += w->ctx->memory_operands;
        result->idle_lanes += w->ctx->idle_lanes;
    } else if (result->options.model == RUN_ISSUE) {
        sim_issue_stats_add(&result->issue, sim_issue_get(w->issue));
    }
}

static void finish_cycles(run_result *result)
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

static base_status create_workers(run_state *r, unsigned jobs, base_error *err)
{
    r->workers = calloc(jobs, sizeof *r->workers);
    if (!r->workers)
        return base_fail(err, BASE_ERR_NOMEM, "--jobs", "out of memory for %u threads", jobs);
    for (unsigned i = 0; i < jobs; i++) {
        base_status status = sim_issue_create(r->result->machine, &r->workers[i].issue, err);
        if (status == BASE_OK)
            status = lrb_ctx_create(sim_issue_events, r->workers[i].issue, &r->workers[i].ctx, err);
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
    }
    free(r->workers);
}

/* Trace the tiles one by one: all models but core. */
static base_status trace_tiles(run_result *result, progress *bar, base_error *err)
{
    const unsigned jobs = result->options.jobs;
    run_state r = {.result = result, .progress = bar};
    base_status status = create_workers(&r, jobs, err);
    if (status == BASE_OK) {
        base_parallel_for(jobs, kernel_job_tiles(result->job), trace_tile, &r);
        for (unsigned i = 0; i < jobs; i++)
            collect_worker(result, &r.workers[i]);
        finish_cycles(result);
    }
    destroy_workers(&r, jobs);
    return status;
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
    progress bar = progress_begin(o->kernel->name, tiles, o->progress);
    double start = clock_seconds();
    base_status status = o->model == RUN_CORE ? run_core(result, &bar, err) : trace_tiles(result, &bar, err);
    result->kernel_seconds = clock_seconds() - start;
    progress_end(&bar);
    return status;
}

base_status run_kernel(const scene *s, const sim_machine *machine, const run_options *options, run_result *out, base_error *err)
{
    *out = (run_result){.options = *options, .scene = s, .machine = machine};
    bvh_options tree_options = bvh_options_default();
    tree_options.max_leaf = options->params.max_leaf;
    tree_options.bins = options->params.bins;
    tree_options.jobs = options->jobs;
    base_status status = scene_find_camera(s, options->camera, &out->camera, err);
    if (status != BASE_OK)
        return status;
    double start = clock_seconds();
    status = bvh_build(s, &tree_options, &out->tree, err);
    out->build_seconds = clock_seconds() - start;
    if (status == BASE_OK)
        status = kernel_job_create(out->tree, out->camera, options->width, options->height, &options->params, &out->job, err);
    if (status == BASE_OK)
        status = trace(out, err);
    return status;
}

void run_result_destroy(run_result *result)
{
    kernel_job_destroy(&result->job);
    bvh_destroy(&result->tree);
    free(result->region_cycles);
    free(result->tile_counts);
    *result = (run_result){0};
}

/* Pixels of the image in a tile, and in a block of it. */
static unsigned tile_pixels(const kernel_job *job, uint32_t tile)
{
    unsigned pixels = 0;
    for (int block = 0; block < 16; block++)
        pixels += (unsigned)__builtin_popcount(job->tiles_host[tile].pixels[block]);
    return pixels;
}

double run_pixel_cycles(const run_result *result, unsigned x, unsigned y)
{
    job_pixel p = kernel_job_pixel(result->job, x, y);
    const double *cycles = result->region_cycles + (size_t)p.tile * (SIM_MAX_REGIONS + 1);
    double block = cycles[p.block] / __builtin_popcount(result->job->tiles_host[p.tile].pixels[p.block]);
    return block + cycles[SIM_MAX_REGIONS] / tile_pixels(result->job, p.tile);
}

double run_pixel_count(const run_result *result, kernel_counter counter, unsigned x, unsigned y)
{
    job_pixel p = kernel_job_pixel(result->job, x, y);
    return (double)result->tile_counts[p.tile].n[counter] / tile_pixels(result->job, p.tile);
}

run_op_totals run_totals(const run_result *result)
{
    run_op_totals t = {.memory = result->memory_operands};
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        lrb_op_kind kind = lrb_op_kind_of((lrb_op_id)i);
        if (kind == LRB_KIND_MARKER)
            continue;
        t.total += result->ops[i];
        *(kind == LRB_KIND_VECTOR ? &t.vector : &t.scalar) += result->ops[i];
        t.memory += lrb_op_is_memory((lrb_op_id)i) ? result->ops[i] : 0;
    }
    if (t.vector)
        t.lane_utilisation = 1.0 - (double)result->idle_lanes / (16.0 * (double)t.vector);
    return t;
}
