#include "cli/run_sample.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "cli/recorder.h"
#include "lrbni/base/parallel.h"
#include "sim/core.h"
#include "sim/sample.h"
#include "sim/warm.h"

/*
 * A run's cycles are the sum of what its tiles are charged with: a cycle of the core belongs to the thread that issues in it, or
 * that it waits for. So a unit of tiles has cycles of its own although others are worked on at the same time, and the units'
 * cycles sum to those of the run. To be charged with what it would be in the run, a unit needs the caches as they would
 * be, threads that are out of step, and neighbours before and behind it that keep the other threads busy to its end.
 */

/* What a unit that may be simulated is simulated from. */
typedef struct start {
    size_t unit;
    sim_contents contents; /* of the caches before the first tile of its warm-up */
} start;

/* Units that are simulated side by side may have tiles in common. A tile's results are not whole while it is traced, so it is traced by
   one of them at a time; to the rows that the filter reads it writes what is there. */
enum { TILE_LOCKS = 64 };

/* The first unit and the last are like no other: threads that begin together from empty caches, threads that run out of work. They are
   always simulated, each on a core of its own, and the sample is of those between. */
enum { ENDS = 2, SAMPLERS = SIM_SAMPLE_STRATA + ENDS };

/* One simulated core for each stratum and end: what its branch predictor has learnt depends on the draws alone. */
typedef struct sampler {
    const run_result *result;
    recorder_input input;
    sim_core *core;
    recorder recorder;
    pthread_mutex_t *locks; /* TILE_LOCKS, of tiles by their number modulo that */
    recording *own;      /* by hardware thread: its tile, */
    size_t *tile, *used; /* the tile's number, and how many of its events it has been given: of neighbours behind the unit, not all */
    size_t begin;        /* first tile that is simulated */
    size_t next;         /* the next one to be taken */
    size_t first, end;   /* tiles of the unit */
    size_t left;         /* of these, not done yet */
    size_t simulated;    /* tiles so far */
    uint64_t cycles;     /* of the unit's tiles that are done */
    base_error error;
    base_status status;
} sampler;

/* All of a sampled run. */
typedef struct sampled_run {
    run_result *result;
    size_t tiles, units, rounds; /* rounds: as many as may be needed */
    double *tile_size;  /* cycles of a tile in `count` */
    double *unit_size, *unit_lines;
    sim_sample *sample; /* of the units but the ends: its unit 0 is unit 1 */
    start *starts;      /* SIM_SAMPLE_STRATA for each round, then the ends */
    size_t *by_tile;    /* of the starts, by the tile where they are taken; starts_count of them */
    size_t starts_count;
    sampler samplers[SAMPLERS];
    pthread_mutex_t locks[TILE_LOCKS];
    size_t measured;    /* of the starts but the ends */
    size_t round;       /* that is being measured: its first start */
    double ends_cycles;
} sampled_run;

/* First tile of the warm-up of a unit. */
static size_t begin_of(const run_result *result, size_t unit)
{
    const size_t first = unit * RUN_SAMPLE_UNIT, before = RUN_SAMPLE_WARMUP * (size_t)result->machine->threads;
    return first > before ? first - before : 0;
}

static base_status record_tile(sampler *s, unsigned thread, base_error *err)
{
    pthread_mutex_t *lock = &s->locks[s->tile[thread] % TILE_LOCKS];
    pthread_mutex_lock(lock);
    base_status status = recorder_tile(&s->recorder, s->tile[thread], &s->own[thread], err);
    pthread_mutex_unlock(lock);
    return status;
}

/* The next piece of a tile behind the unit, a new one if the thread is through with the last. */
static base_status next_behind(sampler *s, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    recording *tile = &s->own[thread];
    base_status status = BASE_OK;
    if (s->tile[thread] < s->end || s->used[thread] == tile->count) {
        if (s->next == s->input.tiles)
            return BASE_OK;
        s->tile[thread] = s->next++;
        s->used[thread] = 0;
        s->simulated++;
        status = record_tile(s, thread, err);
    }
    const size_t left = tile->count - s->used[thread];
    *events = tile->events + s->used[thread];
    *count = left < RUN_SAMPLE_PIECE ? left : RUN_SAMPLE_PIECE;
    s->used[thread] += *count;
    return status;
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    sampler *s = user;
    const unsigned threads = s->result->machine->threads;
    *events = NULL;
    if (s->left == 0)
        return BASE_OK;
    if (s->next >= s->end)
        return next_behind(s, thread, events, count, err);
    s->tile[thread] = s->next++;
    s->simulated++;
    base_status status = record_tile(s, thread, err);
    *events = s->own[thread].events;
    *count = s->own[thread].count;
    if (s->begin > 0 && s->tile[thread] < s->begin + threads)
        *count = *count * (thread + 1) / threads; /* threads that begin together do not run dry together */
    return status;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    sampler *s = user;
    if (s->tile[thread] < s->first || s->tile[thread] >= s->end)
        return;
    for (int i = 0; i <= SIM_MAX_REGIONS; i++)
        s->cycles += regions[i];
    s->left--;
}

static base_status create_sampler(sampler *s, run_result *result, base_error *err)
{
    const unsigned threads = result->machine->threads;
    s->result = result;
    s->input = (recorder_input){.first_pass = kernel_job_first_pass(result->job), .tiles = kernel_job_tiles(result->job), .kernel = result->options.kernel, .job = result->job, .sampled = true};
    s->own = calloc(threads, sizeof *s->own);
    s->tile = calloc(threads, sizeof *s->tile);
    s->used = calloc(threads, sizeof *s->used);
    if (!s->own || !s->tile || !s->used)
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
    free(s->tile);
    free(s->used);
    recorder_destroy(&s->recorder);
    sim_core_destroy(&s->core);
}

/* Simulate a unit with the tiles before it. */
static void measure_unit(void *user, size_t which, unsigned worker)
{
    sampled_run *r = user;
    sampler *s = &r->samplers[which];
    const start *from = which < SIM_SAMPLE_STRATA ? &r->starts[r->round + which] : &r->starts[r->starts_count - SAMPLERS + which];
    const sim_core_feed feed = {.next = next_tile, .done = tile_done, .user = s};
    (void)worker;
    s->first = from->unit * RUN_SAMPLE_UNIT;
    s->end = s->first + RUN_SAMPLE_UNIT < r->tiles ? s->first + RUN_SAMPLE_UNIT : r->tiles;
    s->left = s->end - s->first;
    s->next = s->begin = begin_of(r->result, from->unit);
    s->cycles = 0;
    sim_core_fill(s->core, &from->contents);
    s->status = sim_core_run(s->core, &feed, &s->error);
}

/* Simulate the units of a round side by side, with the first round the ends. */
static base_status measure_round(sampled_run *r, base_error *err)
{
    const size_t count = r->measured == 0 ? SAMPLERS : SIM_SAMPLE_STRATA;
    r->round = r->measured;
    base_parallel_for(r->result->options.jobs, count, measure_unit, r);
    for (size_t i = 0; i < count; i++) {
        const sampler *s = &r->samplers[i];
        if (s->status != BASE_OK)
            return base_fail(err, s->status, s->error.what, "%s", s->error.why);
        if (i < SIM_SAMPLE_STRATA)
            sim_sample_add(r->sample, r->starts[r->round + i].unit - 1, (double)s->cycles);
        else
            r->ends_cycles += (double)s->cycles;
    }
    r->measured += SIM_SAMPLE_STRATA;
    return BASE_OK;
}

/* The warmer is a pass over all tiles, whose accesses to memory go to it as they are traced. */
typedef struct warm_pass {
    sim_warmer *warmer;
    unsigned thread;
    uint64_t lines;
} warm_pass;

static void warm(void *user, const lrb_event *events, uint32_t count)
{
    warm_pass *pass = user;
    pass->lines += sim_warmer_events(pass->warmer, pass->thread, events, count);
}

/* Lines from memory of all units, and the caches where units may be simulated. */
static void warm_all(sampled_run *r, warm_pass *pass, lrb_ctx *ctx)
{
    const run_result *result = r->result;
    size_t taken = 0;
    for (size_t tile = 0; tile < r->tiles; tile++) {
        while (taken < r->starts_count && begin_of(result, r->starts[r->by_tile[taken]].unit) == tile)
            sim_contents_assign(&r->starts[r->by_tile[taken++]].contents, sim_warmer_contents(pass->warmer));
        kernel_counts counts = {{0}};
        const uint64_t before = pass->lines;
        pass->thread = (unsigned)(tile % result->machine->threads);
        lrb_ctx_begin(ctx);
        result->options.kernel->tile[LRB_TOUCH](ctx, result->job, (uint32_t)tile, &counts);
        lrb_ctx_end(ctx);
        r->unit_lines[tile / RUN_SAMPLE_UNIT] += (double)(pass->lines - before);
    }
    sim_sample_set_second(r->sample, r->unit_lines + 1);
}

static base_status warm_caches(sampled_run *r, base_error *err)
{
    warm_pass pass = {0};
    lrb_ctx *ctx = NULL;
    base_status status = sim_warmer_create(r->result->machine, &pass.warmer, err);
    if (status == BASE_OK)
        status = lrb_ctx_create(warm, &pass, &ctx, err);
    if (status == BASE_OK)
        warm_all(r, &pass, ctx);
    lrb_ctx_destroy(&ctx);
    sim_warmer_destroy(&pass.warmer);
    return status;
}

/* Put the starts into the order of their units. */
static void order_starts(sampled_run *r)
{
    for (size_t i = 0; i < r->starts_count; i++) {
        size_t at = i;
        for (; at > 0 && r->starts[r->by_tile[at - 1]].unit > r->starts[i].unit; at--)
            r->by_tile[at] = r->by_tile[at - 1];
        r->by_tile[at] = i;
    }
}

/* Rounds that cost less than all tiles, warm-ups and the tiles that are begun behind the units included. */
static size_t rounds_worthwhile(const sampled_run *r)
{
    const size_t threads = r->result->machine->threads, unit = RUN_SAMPLE_UNIT + (RUN_SAMPLE_WARMUP + 1) * threads;
    const size_t rounds = r->tiles / (unit * SIM_SAMPLE_STRATA);
    return rounds < RUN_SAMPLE_ROUNDS ? rounds : RUN_SAMPLE_ROUNDS;
}

static base_status add_start(sampled_run *r, size_t unit, base_error *err)
{
    start *from = &r->starts[r->starts_count++];
    from->unit = unit;
    return sim_contents_create(r->result->machine, &from->contents, err);
}

/* Draw the units that may be simulated. */
static base_status draw_units(sampled_run *r, base_error *err)
{
    const size_t most = rounds_worthwhile(r);
    base_status status = BASE_OK;
    r->starts = calloc(most * SIM_SAMPLE_STRATA + ENDS, sizeof *r->starts);
    r->by_tile = calloc(most * SIM_SAMPLE_STRATA + ENDS, sizeof *r->by_tile);
    if (!r->starts || !r->by_tile)
        return base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu units", r->units);
    for (; status == BASE_OK && r->rounds < most; r->rounds++) {
        size_t units[SIM_SAMPLE_STRATA];
        if (sim_sample_draw(r->sample, units) < SIM_SAMPLE_STRATA)
            break; /* a stratum of few units is drawn whole */
        for (size_t i = 0; status == BASE_OK && i < SIM_SAMPLE_STRATA; i++)
            status = add_start(r, units[i] + 1, err);
    }
    const size_t ends[ENDS] = {0, r->units - 1};
    for (size_t i = 0; status == BASE_OK && i < ENDS; i++)
        status = add_start(r, ends[i], err);
    if (status == BASE_OK)
        order_starts(r);
    return status;
}

static base_status lay_out(sampled_run *r, base_error *err)
{
    r->tiles = kernel_job_tiles(r->result->job);
    r->units = (r->tiles + RUN_SAMPLE_UNIT - 1) / RUN_SAMPLE_UNIT;
    r->tile_size = calloc(r->tiles, sizeof *r->tile_size);
    r->unit_size = calloc(r->units, sizeof *r->unit_size);
    r->unit_lines = calloc(r->units, sizeof *r->unit_lines);
    if (!r->tile_size || !r->unit_size || !r->unit_lines)
        return base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu tiles", r->tiles);
    for (size_t tile = 0; tile < r->tiles; tile++) {
        r->tile_size[tile] = r->result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS];
        r->unit_size[tile / RUN_SAMPLE_UNIT] += r->tile_size[tile];
    }
    if (r->units <= ENDS)
        return BASE_OK;
    base_status status = sim_sample_create(r->unit_size + 1, r->units - ENDS, r->result->options.seed, &r->sample, err);
    if (status == BASE_OK)
        status = draw_units(r, err);
    for (int i = 0; status == BASE_OK && i < SAMPLERS; i++) {
        r->samplers[i].locks = r->locks;
        status = create_sampler(&r->samplers[i], r->result, err);
    }
    return status;
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

/* Where the cycles of the strata's cores went, warming up included, stands for where the run's went. */
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

/* What a unit's cycles by themselves may be off, as a part of them, whatever the unit: its threads meet in other places than in the run. It does not
   average out, so the interval has it beside what the sample says; docs/machine-model.md has how large it was found to be. */
static const double bias = 0.002;

/* The relative half-width of the interval of all cycles. */
static double half_width_of(const sampled_run *r, const sim_estimate *e)
{
    const double total = e->total + r->ends_cycles;
    return total > 0 ? e->half_width_95 / total + bias : 0;
}

static void collect(run_result *result, const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    result->cycles = (uint64_t)(e.total + r->ends_cycles + 0.5);
    result->estimate = (run_estimate){.half_width_95 = half_width_of(r, &e), .tiles = r->tiles};
    for (int i = 0; i < SAMPLERS; i++)
        result->estimate.tiles_simulated += r->samplers[i].simulated;
    estimate_stats(result, r);
    spread_cycles(result, r);
}

/* How many rounds are to be measured in all: as many as make the interval narrow enough, to judge by those that there are, but not more
 * than twice these, which may have been bad luck. 0: it is narrow enough now. */
static size_t rounds_needed(const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    const size_t rounds = r->measured / SIM_SAMPLE_STRATA, most = r->rounds < 2 * rounds ? r->rounds : 2 * rounds;
    const double times = half_width_of(r, &e) / r->result->options.error;
    if (times <= 1)
        return 0;
    if (rounds == r->rounds)
        return rounds + 1; /* there are not so many */
    return (double)rounds * times * times < (double)most ? (size_t)((double)rounds * times * times) + 1 : most;
}

/* Rounds until the interval is narrow enough. It is looked at as few times as can be: to stop when it happens to be narrow
 * favours samples that scatter less than the units do. */
static base_status measure(sampled_run *r, bool *enough, base_error *err)
{
    size_t rounds = RUN_SAMPLE_FIRST;
    base_status status = BASE_OK;
    while (status == BASE_OK && rounds <= r->rounds && !*enough) {
        while (status == BASE_OK && r->measured < rounds * SIM_SAMPLE_STRATA)
            status = measure_round(r, err);
        if (status == BASE_OK)
            rounds = rounds_needed(r);
        *enough = rounds == 0;
    }
    return status;
}

static void destroy(sampled_run *r)
{
    for (int i = 0; i < SAMPLERS; i++)
        if (r->samplers[i].result)
            destroy_sampler(&r->samplers[i]);
    for (size_t i = 0; i < r->starts_count; i++)
        sim_contents_destroy(&r->starts[i].contents);
    for (int i = 0; i < TILE_LOCKS; i++)
        pthread_mutex_destroy(&r->locks[i]);
    sim_sample_destroy(&r->sample);
    free(r->starts);
    free(r->by_tile);
    free(r->tile_size);
    free(r->unit_size);
    free(r->unit_lines);
}

base_status run_sample(run_result *result, bool *enough, base_error *err)
{
    sampled_run r = {.result = result};
    if (result->machine->cores != 1)
        return base_fail(err, BASE_ERR_USAGE, "--error", "samples one core, not the %u of --set cores", result->machine->cores);
    for (int i = 0; i < TILE_LOCKS; i++)
        pthread_mutex_init(&r.locks[i], NULL);
    base_status status = lay_out(&r, err);
    *enough = false;
    if (status == BASE_OK && r.rounds >= RUN_SAMPLE_FIRST)
        status = warm_caches(&r, err);
    if (status == BASE_OK)
        status = measure(&r, enough, err);
    if (status == BASE_OK && *enough)
        collect(result, &r);
    destroy(&r);
    return status;
}
