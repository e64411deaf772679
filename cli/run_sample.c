#include "cli/run_sample.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "cli/recorder.h"
#include "cli/sample_pass.h"
#include "lrbni/base/parallel.h"
#include "sim/core.h"

/*
 * A run's cycles are the sum of what its tiles are charged with: a cycle of the core belongs to the thread that issues in it, or
 * that it waits for. So a unit of tiles has cycles of its own although others are worked on at the same time, and the units'
 * cycles sum to those of the run. To be charged with what it would be in the run, a unit needs the caches as they would
 * be, threads that are out of step, and neighbours before and behind it that keep the other threads busy to its end.
 */

/* Units that are simulated side by side may have tiles in common. A tile's results are not whole while it is traced, so it is traced by
   one of them at a time; to the rows that the filter reads it writes what is there. */
enum { TILE_LOCKS = 64 };

/* The first unit and the last are like no other: threads that begin together from empty caches, threads that run out of work. They are
   always simulated, each on a core of its own, and the sample is of those between. */
enum { ENDS = 2, SAMPLERS = SIM_SAMPLE_STRATA + ENDS };

/* What a host thread records tiles with. */
typedef struct bench {
    recorder_input input;
    recorder recorder;
    recording *own;      /* by hardware thread: its tile, */
    size_t *tile, *used; /* the tile's number, and how many of its events are done with: of tiles before and behind the unit, not all */
    sim_warmer *warmer;
} bench;

/* One simulated core for each unit of a round and end: what its branch predictor has learnt depends on the draws alone. */
typedef struct sampler {
    sim_core *core;
    bench *at; /* of the host thread that simulates the unit */
    pthread_mutex_t *locks; /* TILE_LOCKS, of tiles by their number modulo that */
    const run_result *result;
    size_t tiles;        /* of the run */
    unsigned threads;    /* of the core */
    size_t next;         /* the tile to be taken next */
    uint64_t begun;      /* hardware threads that are to go on with a tile of the warm-up */
    size_t first, end;   /* tiles of the unit */
    size_t left;         /* of these, not done yet */
    size_t simulated;    /* tiles so far */
    double spent;        /* their cycles in `count` */
    uint64_t cycles;     /* of the unit's tiles that are done */
    base_error error;
    base_status status;
} sampler;

/* All of a sampled run. */
typedef struct sampled_run {
    run_result *result;
    sample_pass pass;
    sim_sample *sample; /* of the units but the ends: its unit 0 is unit 1 */
    size_t most, rounds; /* as many as may be needed; that have been measured */
    size_t drawn[SAMPLERS]; /* the ends, then units of the round */
    sampler samplers[SAMPLERS];
    bench benches[SAMPLERS];
    unsigned jobs; /* host threads that are of use */
    pthread_mutex_t locks[TILE_LOCKS];
    double ends_cycles;
} sampled_run;

static base_status record_tile(sampler *s, unsigned thread, base_error *err)
{
    bench *at = s->at;
    pthread_mutex_t *lock = &s->locks[at->tile[thread] % TILE_LOCKS];
    pthread_mutex_lock(lock);
    base_status status = recorder_tile(&at->recorder, at->tile[thread], &at->own[thread], err);
    pthread_mutex_unlock(lock);
    return status;
}

/* The thread takes the next tile. */
static base_status take_tile(sampler *s, unsigned thread, base_error *err)
{
    s->at->tile[thread] = s->next++;
    s->at->used[thread] = 0;
    s->simulated++;
    s->spent += sample_pass_tile_cycles(s->result, s->at->tile[thread]);
    return record_tile(s, thread, err);
}

/* The next piece of a tile behind the unit, a new one if the thread is through with the last. */
static base_status next_behind(sampler *s, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    const bench *at = s->at;
    const recording *tile = &at->own[thread];
    base_status status = BASE_OK;
    if (at->tile[thread] < s->end || at->used[thread] == tile->count) {
        if (s->next == s->tiles)
            return BASE_OK;
        status = take_tile(s, thread, err);
    }
    const size_t left = tile->count - at->used[thread];
    *events = tile->events + at->used[thread];
    *count = left < RUN_SAMPLE_PIECE ? left : RUN_SAMPLE_PIECE;
    at->used[thread] += *count;
    return status;
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    sampler *s = user;
    const bench *at = s->at;
    base_status status = BASE_OK;
    *events = NULL;
    if (s->left == 0)
        return BASE_OK;
    if (s->next >= s->end)
        return next_behind(s, thread, events, count, err);
    const bool begun = s->begun >> thread & 1;
    if (!begun)
        status = take_tile(s, thread, err);
    *events = at->own[thread].events + (begun ? at->used[thread] : 0);
    *count = at->own[thread].count - (begun ? at->used[thread] : 0);
    s->begun &= ~(UINT64_C(1) << thread);
    return status;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    sampler *s = user;
    if (s->at->tile[thread] < s->first || s->at->tile[thread] >= s->end)
        return;
    for (int i = 0; i <= SIM_MAX_REGIONS; i++)
        s->cycles += regions[i];
    s->left--;
}

static base_status create_sampler(sampler *s, sampled_run *r, base_error *err)
{
    s->result = r->result;
    s->locks = r->locks;
    s->tiles = r->pass.tiles;
    s->threads = r->result->machine->threads;
    return sim_core_create(r->result->machine, &s->core, err);
}

static base_status create_bench(bench *b, const run_result *result, base_error *err)
{
    const unsigned threads = result->machine->threads;
    b->input = (recorder_input){.first_pass = kernel_job_first_pass(result->job), .tiles = kernel_job_tiles(result->job), .kernel = result->options.kernel, .job = result->job, .sampled = true};
    b->own = calloc(threads, sizeof *b->own);
    b->tile = calloc(threads, sizeof *b->tile);
    b->used = calloc(threads, sizeof *b->used);
    if (!b->own || !b->tile || !b->used)
        return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    base_status status = recorder_create(&b->input, result->machine, 0, &b->recorder, err);
    return status == BASE_OK ? sim_warmer_create(result->machine, &b->warmer, err) : status;
}

static void destroy_bench(bench *b, unsigned threads)
{
    for (unsigned t = 0; b->own && t < threads; t++)
        recording_free(&b->own[t]);
    free(b->own);
    free(b->tile);
    free(b->used);
    recorder_destroy(&b->recorder);
    sim_warmer_destroy(&b->warmer);
}

/* Where the last ones of `parts` parts of a tile begin: at the phase that is under way there. */
static size_t late_begin(const recording *tile, unsigned last, unsigned parts)
{
    size_t at = tile->count * (parts - last) / parts;
    while (at > 0 && (tile->events[at].op & LRB_EVENT_ID) != LRB_OP_phase)
        at--;
    return at;
}

/* Begin in the midst of the tiles before the unit, each thread at another place of its own, as they are in the run. What of these tiles is not
 * simulated changes the caches alone. */
static base_status warm_up(sampler *s, const sample_pass *pass, size_t unit)
{
    bench *at = s->at;
    base_status status = BASE_OK;
    sim_warmer_fill(at->warmer, &pass->contents[unit]);
    s->next = sample_pass_begin(pass, unit);
    s->begun = 0;
    for (unsigned thread = 0; status == BASE_OK && s->next < s->first; thread++) {
        status = take_tile(s, thread, &s->error);
        if (status != BASE_OK)
            break;
        at->used[thread] = late_begin(&at->own[thread], thread + 1, s->threads);
        sim_warmer_events(at->warmer, thread, at->own[thread].events, at->used[thread]);
        s->begun |= UINT64_C(1) << thread;
    }
    sim_core_fill(s->core, sim_warmer_contents(at->warmer));
    return status;
}

/* Simulate a unit with the tiles before it. */
static void measure_unit(void *user, size_t which, unsigned worker)
{
    sampled_run *r = user;
    which += r->rounds == 0 ? 0 : ENDS;
    sampler *s = &r->samplers[which];
    const size_t unit = r->drawn[which], end = sample_pass_first(&r->pass, unit + 1);
    const sim_core_feed feed = {.next = next_tile, .done = tile_done, .user = s};
    s->at = &r->benches[worker];
    s->first = sample_pass_first(&r->pass, unit);
    s->end = end < r->pass.tiles ? end : r->pass.tiles;
    s->left = s->end - s->first;
    s->cycles = 0;
    s->status = warm_up(s, &r->pass, unit);
    if (s->status == BASE_OK)
        s->status = sim_core_run(s->core, &feed, &s->error);
}

/* Draw a round of units and simulate them side by side, with the first round the ends. */
static base_status measure_round(sampled_run *r, base_error *err)
{
    size_t units[SIM_SAMPLE_STRATA];
    const size_t ends = r->rounds == 0 ? ENDS : 0, count = sim_sample_draw(r->sample, units);
    for (size_t i = 0; i < count; i++)
        r->drawn[ENDS + i] = units[i] + 1;
    base_parallel_for(r->jobs, ends + count, measure_unit, r);
    for (size_t i = ENDS - ends; i < ENDS + count; i++) {
        const sampler *s = &r->samplers[i];
        if (s->status != BASE_OK)
            return base_fail(err, s->status, s->error.what, "%s", s->error.why);
        if (i < ENDS)
            r->ends_cycles += (double)s->cycles;
        else
            sim_sample_add(r->sample, units[i - ENDS], (double)s->cycles);
    }
    r->rounds++;
    return BASE_OK;
}

/* Rounds that cost less than all tiles, warm-ups and the tiles that are begun behind the units included. */
static size_t rounds_worthwhile(const sampled_run *r)
{
    const size_t unit = r->pass.unit_tiles + 2 * (size_t)r->result->machine->threads;
    const size_t rounds = r->pass.tiles / (unit * SIM_SAMPLE_STRATA);
    return rounds < RUN_SAMPLE_ROUNDS ? rounds : RUN_SAMPLE_ROUNDS;
}

/* The sample of the units between the ends, of which the pass knows the variates. */
static base_status begin_sample(sampled_run *r, base_error *err)
{
    base_status status = sim_sample_create(r->pass.of + 1, r->pass.units - ENDS, SIM_SAMPLE_VARIATES, r->result->options.seed, &r->sample, err);
    r->drawn[1] = r->pass.units - 1;
    for (int i = 0; status == BASE_OK && i < SAMPLERS; i++)
        status = create_sampler(&r->samplers[i], r, err);
    for (unsigned i = 0; status == BASE_OK && i < r->jobs; i++)
        status = create_bench(&r->benches[i], r->result, err);
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
    for (int i = ENDS; i < SAMPLERS; i++) {
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
static void spread_cycles(run_result *result, size_t tiles)
{
    const size_t count = tiles * (SIM_MAX_REGIONS + 1);
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += result->region_cycles[i];
    for (size_t i = 0; sum > 0 && i < count; i++)
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
    result->estimate = (run_estimate){.half_width_95 = half_width_of(r, &e), .tiles = r->pass.tiles};
    for (int i = 0; i < SAMPLERS; i++)
        result->estimate.tiles_simulated += r->samplers[i].simulated;
    estimate_stats(result, r);
    spread_cycles(result, r->pass.tiles);
}

/* What a round costs, as a part of all tiles. */
static double cost_of_round(const sampled_run *r)
{
    double spent = 0, all = 0;
    for (int i = ENDS; i < SAMPLERS; i++)
        spent += r->samplers[i].spent;
    for (size_t unit = 0; unit < r->pass.units; unit++)
        all += r->pass.of[unit].x[0];
    return all > 0 ? spent / (double)r->rounds / all : 0;
}

/* How many rounds are to be measured in all: as many as make the interval narrow enough, to judge by those that there are, but not more
 * than twice these, which may have been bad luck. 0: it is narrow enough now. More than r->most: all tiles cost less. */
static size_t rounds_needed(const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    const double rounds = (double)r->rounds, times = half_width_of(r, &e) / r->result->options.error, needed = rounds * times * times;
    if (times <= 1)
        return 0;
    if (r->rounds == r->most || (needed - rounds) * cost_of_round(r) > 1)
        return r->most + 1;
    const size_t most = r->most < 2 * r->rounds ? r->most : 2 * r->rounds;
    return needed < (double)most ? (size_t)needed + 1 : most;
}

/* Rounds until the interval is narrow enough. It is looked at as few times as can be: to stop when it happens to be narrow
 * favours samples that scatter less than the units do. */
static base_status measure(sampled_run *r, bool *enough, base_error *err)
{
    size_t rounds = RUN_SAMPLE_FIRST;
    base_status status = BASE_OK;
    while (status == BASE_OK && rounds <= r->most && !*enough) {
        while (status == BASE_OK && r->rounds < rounds)
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
        sim_core_destroy(&r->samplers[i].core);
    for (int i = 0; i < SAMPLERS; i++)
        destroy_bench(&r->benches[i], r->result->machine->threads);
    for (int i = 0; i < TILE_LOCKS; i++)
        pthread_mutex_destroy(&r->locks[i]);
    sim_sample_destroy(&r->sample);
    sample_pass_destroy(&r->pass);
}

base_status run_sample(run_result *result, progress *bar, bool *enough, base_error *err)
{
    sampled_run r = {.result = result, .pass = sample_pass_plan(result)};
    r.jobs = result->options.jobs < SAMPLERS ? result->options.jobs : SAMPLERS;
    *enough = false;
    if (result->machine->cores != 1)
        return base_fail(err, BASE_ERR_USAGE, "--error", "samples one core, not the %u of --set cores", result->machine->cores);
    r.most = rounds_worthwhile(&r);
    if (r.most < RUN_SAMPLE_FIRST || r.pass.units < ENDS + SIM_SAMPLE_STRATA)
        return BASE_OK;
    for (int i = 0; i < TILE_LOCKS; i++)
        pthread_mutex_init(&r.locks[i], NULL);
    base_status status = sample_pass_run(&r.pass, result, bar, err);
    if (status == BASE_OK)
        status = begin_sample(&r, err);
    if (status == BASE_OK)
        status = measure(&r, enough, err);
    if (status == BASE_OK && *enough)
        collect(result, &r);
    destroy(&r);
    return status;
}
