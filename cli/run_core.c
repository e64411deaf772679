#include "cli/run_core.h"

#include <stdlib.h>
#include <string.h>

#include "cli/record_ahead.h"
#include "cli/recorder.h"
#include "lrbni/base/parallel.h"
#include "sim/core.h"

/* One simulated core and the tiles that are its. */
typedef struct core_run {
    run_result *result;
    const core_watch *watch; /* or NULL */
    progress *bar;
    unsigned worker;
    sim_core *core;
    size_t next, step, end; /* its next tile, how far the one after it is, and where the pass ends */
    recorder *recorder;     /* of its host thread; unused if ... */
    record_ahead *ahead;    /* ... tiles are recorded ahead */
    recording *own;         /* by hardware thread */
    recording **taken;      /* from `ahead`, by hardware thread */
    size_t *tile;           /* of each hardware thread */
} core_run;

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    core_run *r = user;
    recording *tile = &r->own[thread];
    base_status status;
    *events = NULL;
    if (r->taken[thread])
        record_ahead_release(r->ahead, r->taken[thread]);
    r->taken[thread] = NULL;
    if (r->next >= r->end)
        return BASE_OK;
    r->tile[thread] = r->next;
    r->next += r->step;
    if (r->ahead) {
        status = record_ahead_take(r->ahead, r->tile[thread], &tile, err);
        r->taken[thread] = status == BASE_OK ? tile : NULL;
    } else {
        status = recorder_tile(r->recorder, r->tile[thread], tile, err);
    }
    if (status != BASE_OK)
        return status;
    *events = tile->events;
    *count = tile->count;
    if (r->watch)
        r->watch->begin_tile(r->watch->user, thread, r->tile[thread]);
    return BASE_OK;
}

static void tile_done(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1])
{
    core_run *r = user;
    double *cycles = r->result->region_cycles;
    for (int i = 0; cycles && i <= SIM_MAX_REGIONS; i++)
        cycles[r->tile[thread] * (SIM_MAX_REGIONS + 1) + i] = (double)regions[i];
    if (r->watch)
        r->watch->end_tile(r->watch->user, thread);
    progress_step(r->bar, r->worker);
}

static base_status create_core(core_run *r, sim_profile **profile, base_error *err)
{
    const unsigned threads = r->result->machine->threads;
    r->own = calloc(threads, sizeof *r->own);
    r->taken = calloc(threads, sizeof *r->taken);
    r->tile = calloc(threads, sizeof *r->tile);
    if (!r->own || !r->taken || !r->tile)
        return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    base_status status = sim_core_create(r->result->machine, &r->core, err);
    if (status == BASE_OK && profile)
        status = sim_profile_create(profile, err);
    if (status == BASE_OK && profile)
        sim_core_set_profile(r->core, *profile);
    if (status == BASE_OK && r->watch)
        sim_core_observe(r->core, r->watch->observer, r->watch->user);
    return status;
}

static void destroy_core(core_run *r)
{
    sim_core_destroy(&r->core);
    for (unsigned t = 0; r->own && t < r->result->machine->threads; t++)
        recording_free(&r->own[t]);
    free(r->own);
    free(r->taken);
    free(r->tile);
}

/* Simulate the core's tiles of a pass; its caches and its predictor are as the last one left them. */
static base_status simulate_pass(core_run *r, base_error *err)
{
    const sim_core_feed feed = {.next = next_tile, .done = tile_done, .user = r};
    return sim_core_run(r->core, &feed, err);
}

/* All simulated cores of a run. */
typedef struct chip {
    run_result *result;
    const recorder_input *input;
    size_t first, end;   /* tiles of the pass */
    core_run *cores;
    recorder *recorders; /* by host thread */
    sim_core_stats *stats; /* by core */
    sim_profile **profiles; /* by core; NULL if there are to be none */
    base_error *errors;  /* by core */
} chip;

static base_status create_cores(chip *c, progress *bar, base_error *err)
{
    const unsigned cores = c->result->machine->cores;
    base_status status = BASE_OK;
    for (unsigned i = 0; status == BASE_OK && i < cores; i++) {
        c->cores[i] = (core_run){.result = c->result, .bar = bar, .worker = c->input->member, .step = cores,
                                 .watch = cores == 1 ? c->input->watch : NULL};
        status = create_core(&c->cores[i], c->profiles ? &c->profiles[i] : NULL, err);
    }
    return status;
}

static void simulate_core(void *user, size_t core, unsigned worker)
{
    chip *c = user;
    core_run *r = &c->cores[core];
    r->worker = worker;
    r->recorder = &c->recorders[worker];
    simulate_pass(r, &c->errors[core]);
}

/* One core here, its tiles recorded ahead by the other host threads. */
static base_status simulate_single(chip *c, unsigned jobs, base_error *err)
{
    core_run *r = c->cores;
    base_status status = BASE_OK;
    r->recorder = &c->recorders[0];
    if (jobs > 1)
        status = record_ahead_start(c->recorders + 1, jobs - 1, c->first, c->end, c->result->machine->threads, &r->ahead, err);
    if (status == BASE_OK)
        status = simulate_pass(r, err);
    record_ahead_stop(&r->ahead);
    return status;
}

/* The tiles from first to end, on all cores. */
static base_status simulate_all(chip *c, unsigned jobs, size_t first, size_t end, base_error *err)
{
    const unsigned cores = c->result->machine->cores;
    c->first = first;
    c->end = end;
    for (unsigned i = 0; i < cores; i++) {
        c->cores[i].next = first + i;
        c->cores[i].end = end;
    }
    if (cores == 1)
        return simulate_single(c, jobs, err);
    base_parallel_for(jobs, cores, simulate_core, c);
    for (unsigned i = 0; i < cores; i++)
        if (c->errors[i].status != BASE_OK)
            return base_fail(err, c->errors[i].status, c->errors[i].what, "%s", c->errors[i].why);
    return BASE_OK;
}

/* A pass takes as long as its slowest core: none begins the next one before all are done. */
static base_status simulate_passes(chip *c, unsigned jobs, base_error *err)
{
    const size_t ends[] = {c->input->first_pass, c->input->tiles};
    base_status status = BASE_OK;
    size_t first = 0;
    for (int pass = 0; status == BASE_OK && pass < 2 && first < c->input->tiles; pass++) {
        uint64_t slowest = 0;
        status = simulate_all(c, jobs, first, ends[pass], err);
        for (unsigned i = 0; i < c->result->machine->cores; i++) {
            const sim_core_stats now = sim_core_get(c->cores[i].core);
            const uint64_t cycles = now.cycles - c->stats[i].cycles;
            slowest = cycles > slowest ? cycles : slowest;
            c->stats[i] = now;
        }
        c->result->cycles += slowest;
        first = ends[pass];
    }
    return status;
}

/* The other cores have no work while they wait for the slowest. */
static base_status collect(const chip *c, unsigned jobs, base_error *err)
{
    base_status status = BASE_OK;
    run_result *result = c->result;
    for (unsigned i = 0; i < result->machine->cores; i++) {
        sim_core_stats_idle(&c->stats[i], result->machine, result->cycles - c->stats[i].cycles);
        sim_core_stats_add(&result->core, &c->stats[i]);
    }
    for (unsigned i = 0; i < jobs; i++) {
        sim_chains_add(&result->chains, &c->recorders[i].chains);
        if (c->recorders[i].registers)
            sim_registers_stats_add(&result->registers, sim_registers_get(c->recorders[i].registers));
        for (int n = 0; n < KERNEL_COUNTER_COUNT; n++)
            result->counts.n[n] += c->recorders[i].counts.n[n];
    }
    memcpy(result->ops, result->core.ops, sizeof result->ops);
    result->memory_operands = result->core.memory_operands;
    for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
        result->idle_lanes += result->core.phase_idle_lanes[phase];
    for (unsigned i = 0; c->profiles && status == BASE_OK && i < result->machine->cores; i++)
        status = sim_profile_add(result->profile, c->profiles[i], err);
    return status;
}

base_status run_core(run_result *result, const recorder_input *input, progress *bar, base_error *err)
{
    enum { MAX_RECORDERS = 5 }; /* of a single core: more are faster than it can be */
    const unsigned cores = result->machine->cores, most = cores > 1 ? cores : MAX_RECORDERS;
    const unsigned jobs = result->options.jobs < most ? result->options.jobs : most;
    chip c = {.result = result, .input = input};
    c.cores = calloc(cores, sizeof *c.cores);
    c.recorders = calloc(jobs, sizeof *c.recorders);
    c.stats = calloc(cores, sizeof *c.stats);
    c.errors = calloc(cores, sizeof *c.errors);
    c.profiles = result->profile ? calloc(cores, sizeof *c.profiles) : NULL;
    base_status status = BASE_OK;
    if (!c.cores || !c.recorders || !c.stats || !c.errors || (result->profile && !c.profiles))
        status = base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    for (unsigned i = 0; status == BASE_OK && i < jobs; i++)
        status = recorder_create(input, result->machine, i, &c.recorders[i], err);
    if (status == BASE_OK)
        status = create_cores(&c, bar, err);
    if (status == BASE_OK)
        status = simulate_passes(&c, jobs, err);
    if (status == BASE_OK)
        status = collect(&c, jobs, err);
    for (unsigned i = 0; c.recorders && i < jobs; i++)
        recorder_destroy(&c.recorders[i]);
    for (unsigned i = 0; c.cores && i < cores && c.cores[i].result; i++)
        destroy_core(&c.cores[i]);
    free(c.cores);
    free(c.recorders);
    free(c.stats);
    free(c.errors);
    for (unsigned i = 0; c.profiles && i < cores; i++)
        sim_profile_destroy(&c.profiles[i]);
    free(c.profiles);
    return status;
}
