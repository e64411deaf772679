#include "cli/run_sample.h"

#include <stdlib.h>
#include <string.h>

#include "cli/recorder.h"
#include "lrbni/base/parallel.h"
#include "sim/core.h"
#include "sim/count.h"
#include "sim/sample.h"

/*
 * Time is cut where tiles are taken: tile k is taken in cycle T(k), when a thread runs dry, and unit [a, b) has the cycles
 * T(b) - T(a), the last one those up to the end. So the units' cycles sum to those of the whole run. In T(a) the other threads
 * are still busy with tiles before a, and in T(b) with tiles of the unit, so a unit is measured by the work that was done in
 * it: the price in `count` of the ops that issued between T(a) and T(b).
 */

/* One simulated core for each stratum: what it simulates, and so what is in its caches, depends on the draws alone. */
typedef struct sampler {
    const run_result *result;
    recorder_input input;
    sim_core *core;
    recorder recorder;
    recording *own; /* by hardware thread */

    size_t start; /* first tile that is simulated */
    size_t next, first, end; /* tiles of the unit on hand: the next one to be taken, the first that counts, the one behind the last */
    bool ends_run;           /* the unit is the last one */
    uint64_t cycles, half_cycles; /* of the unit; until its end, what there was before it: in `core`, and in `count` */
    base_error error;
    base_status status;
} sampler;

/* All of a sampled run. */
typedef struct sampled_run {
    run_result *result;
    size_t tiles, units;
    double *tile_size; /* cycles of a tile in `count` */
    double *unit_size;
    sim_sample *sample;
    sampler samplers[SIM_SAMPLE_STRATA];
    size_t drawn[SIM_SAMPLE_STRATA]; /* units of this round */
} sampled_run;

/* The unit begins, or ends. */
static void mark(sampler *s)
{
    const sim_core_stats stats = sim_core_get(s->core);
    s->half_cycles = sim_count_half_cycles(s->result->machine, stats.ops) - s->half_cycles;
    s->cycles = sim_core_cycle(s->core) - s->cycles;
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    sampler *s = user;
    recording *tile = &s->own[thread];
    const unsigned threads = s->result->machine->threads;
    *events = NULL;
    if (s->next == s->first)
        mark(s);
    if (s->next == s->end && !s->ends_run)
        mark(s);
    if (s->next >= s->end) {
        s->next++; /* only the first thread that runs dry marks the end */
        return BASE_OK;
    }
    base_status status = recorder_tile(&s->recorder, s->next, tile, err);
    *events = tile->events;
    *count = tile->count;
    if (s->next++ < s->start + threads)
        *count = *count * (thread + 1) / threads; /* threads that begin together do not run dry together */
    return status;
}

static base_status create_sampler(sampler *s, run_result *result, base_error *err)
{
    s->result = result;
    s->input = (recorder_input){.tiles = kernel_job_tiles(result->job), .kernel = result->options.kernel, .job = result->job};
    s->own = calloc(result->machine->threads, sizeof *s->own);
    if (!s->own)
        return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    base_status status = recorder_create(&s->input, result->machine, 0, &s->recorder, err);
    if (status == BASE_OK)
        status = sim_core_create(result->machine, &s->core, err);
    return status;
}

static void destroy_sampler(sampler *s)
{
    for (unsigned t = 0; s->own && t < s->result->machine->threads; t++)
        recording_free(&s->own[t]);
    free(s->own);
    recorder_destroy(&s->recorder);
    sim_core_destroy(&s->core);
}

/* Simulate a unit with the tiles before it. */
static void measure_unit(void *user, size_t which, unsigned worker)
{
    sampled_run *r = user;
    sampler *s = &r->samplers[which];
    const sim_core_feed feed = {.next = next_tile, .user = s};
    const size_t unit = r->drawn[which];
    (void)worker;
    s->first = unit * RUN_SAMPLE_UNIT;
    s->end = s->first + RUN_SAMPLE_UNIT < r->tiles ? s->first + RUN_SAMPLE_UNIT : r->tiles;
    s->next = s->start = s->first > RUN_SAMPLE_WARMUP ? s->first - RUN_SAMPLE_WARMUP : 0;
    s->ends_run = s->end == r->tiles;
    s->cycles = s->half_cycles = 0;
    s->status = sim_core_run(s->core, &feed, &s->error);
    if (s->ends_run)
        mark(s);
}

/* Cycles in `count` of the unit's tiles. */
static double size_of_unit(const sampled_run *r, size_t unit)
{
    double size = 0;
    for (size_t tile = unit * RUN_SAMPLE_UNIT; tile < r->tiles && tile < (unit + 1) * RUN_SAMPLE_UNIT; tile++)
        size += r->tile_size[tile];
    return size;
}

static base_status lay_out(sampled_run *r, base_error *err)
{
    r->tiles = kernel_job_tiles(r->result->job);
    r->units = (r->tiles + RUN_SAMPLE_UNIT - 1) / RUN_SAMPLE_UNIT;
    r->tile_size = calloc(r->tiles, sizeof *r->tile_size);
    r->unit_size = calloc(r->units, sizeof *r->unit_size);
    if (!r->tile_size || !r->unit_size)
        return base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu tiles", r->tiles);
    for (size_t tile = 0; tile < r->tiles; tile++)
        r->tile_size[tile] = r->result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS];
    for (size_t unit = 0; unit < r->units; unit++)
        r->unit_size[unit] = size_of_unit(r, unit);
    base_status status = sim_sample_create(r->unit_size, r->units, r->result->options.seed, &r->sample, err);
    for (int i = 0; status == BASE_OK && i < SIM_SAMPLE_STRATA; i++)
        status = create_sampler(&r->samplers[i], r->result, err);
    return status;
}

/* Draw a round and simulate its units side by side. */
static base_status measure_round(sampled_run *r, base_error *err)
{
    const size_t count = sim_sample_draw(r->sample, r->drawn);
    base_parallel_for(r->result->options.jobs, count, measure_unit, r);
    for (size_t i = 0; i < count; i++) {
        const sampler *s = &r->samplers[i];
        if (s->status != BASE_OK)
            return base_fail(err, s->status, s->error.what, "%s", s->error.why);
        sim_sample_add(r->sample, r->drawn[i], (double)s->half_cycles / 2, (double)s->cycles);
    }
    return BASE_OK;
}

/* Scale counts to the sum `total`: rounded, what rounding leaves or takes too much is the largest one's. */
static void scale_to(uint64_t *counts, size_t many, uint64_t total)
{
    uint64_t sum = 0, scaled = 0;
    size_t largest = 0;
    for (size_t i = 0; i < many; i++)
        sum += counts[i];
    for (size_t i = 0; sum && i < many; i++) {
        counts[i] = (uint64_t)((double)counts[i] * ((double)total / (double)sum) + 0.5);
        largest = counts[i] > counts[largest] ? i : largest;
        scaled += counts[i];
    }
    if (sum)
        counts[largest] += total - scaled;
}

/* Where the simulated cores' cycles went, warming up included, stands for where the run's went. */
static void estimate_stats(run_result *result, const sampled_run *r)
{
    sim_core_stats *to = &result->core;
    const unsigned threads = result->machine->threads;
    for (int i = 0; i < SIM_SAMPLE_STRATA; i++) {
        sim_core_stats stats = sim_core_get(r->samplers[i].core);
        sim_core_stats_add(to, &stats);
    }
    const double ratio = to->cycles ? (double)result->cycles / (double)to->cycles : 0;
    uint64_t *all = (uint64_t *)to; /* all members are uint64_t counts */
    for (size_t i = 0; i < sizeof *to / sizeof *all; i++)
        all[i] = (uint64_t)((double)all[i] * ratio + 0.5);
    to->cycles = result->cycles;
    scale_to((uint64_t *)&to->core, sizeof to->core / sizeof *all, result->cycles);
    scale_to((uint64_t *)&to->threads, sizeof to->threads / sizeof *all, result->cycles * threads);
    scale_to(to->phase, SIM_MAX_PHASES, result->cycles);
    scale_to(to->op_cycles, LRB_OP_COUNT, result->cycles);
    memcpy(to->ops, result->ops, sizeof to->ops);
    to->memory_operands = result->memory_operands;
}

/* Cycles of a tile, for heat maps: its share by `count`. */
static void spread_cycles(run_result *result, const sampled_run *r)
{
    double sum = 0;
    for (size_t tile = 0; tile < r->tiles; tile++)
        sum += r->tile_size[tile];
    for (size_t i = 0; sum > 0 && i < r->tiles * (SIM_MAX_REGIONS + 1); i++)
        result->region_cycles[i] *= (double)result->cycles / sum;
}

static void collect(run_result *result, const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    result->cycles = (uint64_t)(e.total + 0.5);
    result->estimate = (run_estimate){
        .half_width_95 = e.total > 0 ? e.half_width_95 / e.total : 0,
        .tiles_simulated = e.drawn * RUN_SAMPLE_UNIT < r->tiles ? e.drawn * RUN_SAMPLE_UNIT : r->tiles,
        .tiles = r->tiles,
    };
    estimate_stats(result, r);
    spread_cycles(result, r);
}

/* Is the interval narrow enough? */
static bool is_known(const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    return e.half_width_95 <= r->result->options.error * e.total;
}

base_status run_sample(run_result *result, bool *enough, base_error *err)
{
    sampled_run r = {.result = result};
    if (result->machine->cores != 1)
        return base_fail(err, BASE_ERR_USAGE, "--error", "samples one core, not the %u of --set cores", result->machine->cores);
    base_status status = lay_out(&r, err);
    *enough = false;
    for (size_t rounds = 1; status == BASE_OK && !*enough && 2 * rounds * SIM_SAMPLE_STRATA <= r.units; rounds++) {
        status = measure_round(&r, err);
        *enough = status == BASE_OK && rounds >= RUN_SAMPLE_FIRST && is_known(&r);
    }
    if (*enough)
        collect(result, &r);
    for (int i = 0; i < SIM_SAMPLE_STRATA; i++)
        if (r.samplers[i].own)
            destroy_sampler(&r.samplers[i]);
    sim_sample_destroy(&r.sample);
    free(r.tile_size);
    free(r.unit_size);
    return status;
}
