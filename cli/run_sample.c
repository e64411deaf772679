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

/* The first unit and the last of each pass of the kernel are like no other: threads that begin together, threads that run out of work. They are
   always simulated, each on a core of its own, and the sample is of the others. */
enum { ENDS = 4, SAMPLERS = SIM_SAMPLE_STRATA + ENDS };

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
    const sample_unit *unit;
    size_t next;         /* the tile to be taken next */
    size_t left;         /* tiles of the unit that are not done yet */
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
    sim_sample *sample; /* of the units between the ends */
    const sample_unit **between; /* these */
    size_t most, rounds; /* as many as may be needed; that have been measured */
    size_t ends;         /* ENDS, or less */
    const sample_unit *drawn[SAMPLERS]; /* the ends, from ENDS on units of the round */
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

static bool is_of_unit(const sampler *s, size_t tile) { return tile >= s->unit->first && tile < s->unit->end; }

/* The thread's next tile, or of a tile before or behind the unit the next piece: once the unit is done the rest of it does not matter. */
static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    sampler *s = user;
    const bench *at = s->at;
    const recording *tile = &at->own[thread];
    base_status status = BASE_OK;
    *events = NULL;
    if (s->left == 0)
        return BASE_OK;
    if (at->used[thread] == tile->count) {
        if (s->next == s->unit->limit)
            return BASE_OK;
        status = take_tile(s, thread, err);
    }
    const size_t left = tile->count - at->used[thread];
    *events = tile->events + at->used[thread];
    *count = is_of_unit(s, at->tile[thread]) || left < RUN_SAMPLE_PIECE ? left : RUN_SAMPLE_PIECE;
    at->used[thread] += *count;
    return status;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    sampler *s = user;
    if (!is_of_unit(s, s->at->tile[thread]))
        return;
    for (int i = 0; i <= SIM_MAX_REGIONS; i++)
        s->cycles += regions[i];
    s->left--;
}

static base_status create_sampler(sampler *s, sampled_run *r, base_error *err)
{
    s->result = r->result;
    s->locks = r->locks;
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

/* Where the rest of a tile begins of which a part is done: at the phase that is under way there. */
static size_t rest_of(const recording *tile, double done)
{
    size_t at = (size_t)((double)tile->count * done);
    while (at > 0 && (tile->events[at].op & LRB_EVENT_ID) != LRB_OP_phase)
        at--;
    return at;
}

/* The hardware thread that is in a tile when the unit begins; of a tile that is done by then, one that is in a later one, or in none. */
static unsigned thread_in(const sampler *s, size_t tile)
{
    const sample_begun *begun = s->unit->begun;
    const unsigned threads = s->result->machine->threads;
    unsigned thread = 0;
    while (thread < threads && begun[thread].tile != tile)
        thread++;
    if (thread == threads)
        for (thread = 0; begun[thread].tile < tile; thread++) {
        }
    return thread;
}

/* Trace a tile that was begun before the unit: up to where its thread is it warms the caches, if they have not seen it. */
static base_status begin_tile(sampler *s, size_t tile)
{
    bench *at = s->at;
    const unsigned thread = thread_in(s, tile);
    const sample_begun *begun = &s->unit->begun[thread];
    at->tile[thread] = tile;
    base_status status = record_tile(s, thread, &s->error);
    if (status != BASE_OK)
        return status;
    at->used[thread] = begun->tile == tile ? rest_of(&at->own[thread], begun->done) : at->own[thread].count;
    s->simulated += begun->tile == tile;
    if (tile >= s->unit->begin)
        sim_warmer_events(at->warmer, thread, at->own[thread].events, at->used[thread]);
    return BASE_OK;
}

/* Bring the threads to where they are when the unit begins, and the caches too. */
static base_status warm_up(sampler *s)
{
    bench *at = s->at;
    const sample_unit *unit = s->unit;
    const unsigned threads = s->result->machine->threads;
    base_status status = BASE_OK;
    sim_warmer_fill(at->warmer, &unit->contents);
    for (unsigned t = 0; t < threads; t++)
        at->own[t].count = at->used[t] = 0;
    for (unsigned t = 0; status == BASE_OK && t < threads; t++)
        if (unit->begun[t].tile < unit->begin)
            status = begin_tile(s, unit->begun[t].tile);
    for (size_t tile = unit->begin; status == BASE_OK && tile < unit->first; tile++)
        status = begin_tile(s, tile);
    sim_core_fill(s->core, sim_warmer_contents(at->warmer));
    return status;
}

/* The sampler of the i-th unit of a round: with the first round the ends come first. */
static sampler *sampler_of(sampled_run *r, size_t i)
{
    const size_t ends = r->rounds == 0 ? r->ends : 0;
    return &r->samplers[i < ends ? i : ENDS + i - ends];
}

/* Simulate a unit. */
static void measure_unit(void *user, size_t which, unsigned worker)
{
    sampled_run *r = user;
    sampler *s = sampler_of(r, which);
    const sim_core_feed feed = {.next = next_tile, .done = tile_done, .user = s};
    s->at = &r->benches[worker];
    s->unit = r->drawn[s - r->samplers];
    s->next = s->unit->first;
    s->left = s->unit->end - s->unit->first;
    s->cycles = 0;
    s->status = warm_up(s);
    if (s->status == BASE_OK)
        s->status = sim_core_run(s->core, &feed, &s->error);
}

/* Draw a round of units and simulate them side by side, with the first round the ends. */
static base_status measure_round(sampled_run *r, base_error *err)
{
    size_t units[SIM_SAMPLE_STRATA];
    const size_t ends = r->rounds == 0 ? r->ends : 0, count = sim_sample_draw(r->sample, units);
    for (size_t i = 0; i < count; i++)
        r->drawn[ENDS + i] = r->between[units[i]];
    base_parallel_for(r->jobs, ends + count, measure_unit, r);
    for (size_t i = 0; i < ends + count; i++) {
        const sampler *s = sampler_of(r, i);
        if (s->status != BASE_OK)
            return base_fail(err, s->status, s->error.what, "%s", s->error.why);
        if (i < ends)
            r->ends_cycles += (double)s->cycles;
        else
            sim_sample_add(r->sample, units[i - ends], (double)s->cycles);
    }
    r->rounds++;
    return BASE_OK;
}

/* Rounds that cost less than all tiles, those that are begun before and behind the units included. */
static size_t rounds_worthwhile(const run_result *result)
{
    const size_t unit = sample_pass_unit_tiles(result) + 2 * (size_t)result->machine->threads;
    const size_t rounds = kernel_job_tiles(result->job) / (unit * SIM_SAMPLE_STRATA);
    return rounds < RUN_SAMPLE_ROUNDS ? rounds : RUN_SAMPLE_ROUNDS;
}

/* The sample of the units between the ends, of which the pass knows the variates. */
static base_status begin_sample(sampled_run *r, base_error *err)
{
    const sample_pass *p = &r->pass;
    size_t count = 0;
    r->between = calloc(p->unit_count, sizeof *r->between);
    sim_variates *of = calloc(p->unit_count, sizeof *of);
    base_status status = r->between && of ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu units", p->unit_count);
    for (size_t i = 0; status == BASE_OK && i < p->unit_count; i++)
        if (p->units[i].edge) {
            r->drawn[r->ends++] = &p->units[i];
        } else {
            r->between[count] = &p->units[i];
            of[count++] = p->units[i].of;
        }
    if (status == BASE_OK)
        status = sim_sample_create(of, count, SIM_SAMPLE_VARIATES, r->result->options.seed, &r->sample, err);
    for (int i = 0; status == BASE_OK && i < SAMPLERS; i++)
        status = create_sampler(&r->samplers[i], r, err);
    for (unsigned i = 0; status == BASE_OK && i < r->jobs; i++)
        status = create_bench(&r->benches[i], r->result, err);
    free(of);
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
static const double bias = 0.005;

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
    for (size_t i = 0; i < r->pass.unit_count; i++)
        all += r->pass.units[i].of.x[0];
    return all > 0 ? spent / (double)r->rounds / all : 0;
}

/* How many rounds are to be measured in all: as many as make the interval narrow enough, to judge by those that there are, but not more
 * than twice these, which may have been bad luck. 0: it is narrow enough now. More than r->most: all tiles cost less than half of what is needed. */
static size_t rounds_needed(const sampled_run *r)
{
    const sim_estimate e = sim_sample_estimate(r->sample);
    const double rounds = (double)r->rounds, times = half_width_of(r, &e) / r->result->options.error, needed = rounds * times * times;
    if (times <= 1)
        return 0;
    if (r->rounds == r->most || (needed / 2 - rounds) * cost_of_round(r) > 1)
        return r->most + 1;
    const size_t most = r->most < 2 * r->rounds ? r->most : 2 * r->rounds;
    return needed < (double)most ? (size_t)needed + 1 : most;
}

/* Rounds before the interval is looked at. Where few units have most of the cycles, a stratum of many small ones may hold a few that are unlike
 * the others: three of it would not tell. */
static size_t first_rounds(const sampled_run *r)
{
    const size_t share = sim_sample_largest(r->sample) / RUN_SAMPLE_SHARE;
    return share > RUN_SAMPLE_FIRST ? share : RUN_SAMPLE_FIRST;
}

/* Rounds until the interval is narrow enough. It is looked at as few times as can be: to stop when it happens to be narrow
 * favours samples that scatter less than the units do. */
static base_status measure(sampled_run *r, bool *enough, base_error *err)
{
    size_t rounds = first_rounds(r);
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
    free(r->between);
}

base_status run_sample(run_result *result, progress *bar, bool *enough, base_error *err)
{
    sampled_run r = {.result = result, .most = rounds_worthwhile(result)};
    *enough = false;
    if (result->machine->cores != 1)
        return base_fail(err, BASE_ERR_USAGE, "--error", "samples one core, not the %u of --set cores", result->machine->cores);
    if (r.most < RUN_SAMPLE_FIRST)
        return BASE_OK;
    r.jobs = result->options.jobs < SAMPLERS ? result->options.jobs : SAMPLERS;
    for (int i = 0; i < TILE_LOCKS; i++)
        pthread_mutex_init(&r.locks[i], NULL);
    base_status status = sample_pass_run(result, bar, &r.pass, err);
    if (status == BASE_OK)
        status = begin_sample(&r, err);
    if (status == BASE_OK)
        status = measure(&r, enough, err);
    if (status == BASE_OK && *enough)
        collect(result, &r);
    destroy(&r);
    return status;
}
