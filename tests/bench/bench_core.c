/* The core model alone: host time of an event, from the tiles of a trace that are in memory.
 *
 *   bench_core [--repeat N] TRACE.ltr...
 *
 * A row of CSV for each trace: events, cycles on larrabee, and the processor's nanoseconds an event of the core model and of the lower
 * bounds, the least of N runs (5); lines of '#' name the compiler and the CPU.
 */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "sim/bounds.h"
#include "sim/core.h"
#include "tests/bench/measure.h"
#include "traces/reader.h"

typedef struct tiles {
    lrb_event *events;
    size_t *begin; /* of each tile, and the end */
    uint32_t count, next;
} tiles;

static void tiles_free(tiles *t)
{
    free(t->events);
    free(t->begin);
}

static base_status read_tiles(const trace_reader *r, trace_source *s, tiles *t, base_error *err)
{
    base_status status = BASE_OK;
    t->count = trace_reader_tiles(r);
    t->events = malloc((trace_reader_events(r) + 1) * sizeof *t->events);
    t->begin = calloc(t->count + 1u, sizeof *t->begin);
    if (!t->events || !t->begin)
        return base_fail(err, BASE_ERR_NOMEM, "bench_core", "out of memory");
    for (uint32_t i = 0; i < t->count && status == BASE_OK; i++) {
        const uint32_t size = trace_reader_tile_events(r, i);
        uint32_t count = 0;
        t->begin[i + 1] = t->begin[i] + size;
        status = trace_source_seek(s, i, err);
        if (status == BASE_OK)
            status = trace_source_read(s, t->events + t->begin[i], size, &count, err);
    }
    return status;
}

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    tiles *t = user;
    (void)thread;
    (void)err;
    *events = t->next < t->count ? t->events + t->begin[t->next] : NULL;
    *count = t->next < t->count ? t->begin[t->next + 1] - t->begin[t->next] : 0;
    t->next++;
    return BASE_OK;
}

static double processor_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static base_status time_core(const sim_machine *machine, tiles *t, double *least, uint64_t *cycles, base_error *err)
{
    const sim_core_feed feed = {.next = next_tile, .user = t};
    sim_core *core = NULL;
    t->next = 0;
    base_status status = sim_core_create(machine, &core, err);
    const double begin = processor_seconds();
    if (status == BASE_OK)
        status = sim_core_run(core, &feed, err);
    const double seconds = processor_seconds() - begin;
    *least = seconds < *least ? seconds : *least;
    if (status == BASE_OK)
        *cycles = sim_core_get(core).cycles;
    sim_core_destroy(&core);
    return status;
}

static base_status time_bounds(const sim_machine *machine, const tiles *t, double *least, base_error *err)
{
    sim_chain_meter *meter = NULL;
    sim_chains chains = {0};
    base_status status = sim_chain_meter_create(machine, &meter, err);
    const double begin = processor_seconds();
    for (uint32_t i = 0; i < t->count && status == BASE_OK; i++)
        sim_chain_meter_tile(meter, t->events + t->begin[i], t->begin[i + 1] - t->begin[i], &chains);
    const double seconds = processor_seconds() - begin;
    *least = seconds < *least ? seconds : *least;
    sim_chain_meter_destroy(&meter);
    return status;
}

static base_status bench(const char *path, const sim_machine *machine, int repeat, base_error *err)
{
    trace_reader *r = NULL;
    trace_source *s = NULL;
    tiles t = {0};
    double core = 1e9, bounds = 1e9;
    uint64_t cycles = 0;
    base_status status = trace_reader_open(path, &r, err);
    if (status == BASE_OK)
        status = trace_source_create(r, &s, err);
    if (status == BASE_OK)
        status = read_tiles(r, s, &t, err);
    for (int i = 0; i < repeat && status == BASE_OK; i++) {
        status = time_core(machine, &t, &core, &cycles, err);
        if (status == BASE_OK)
            status = time_bounds(machine, &t, &bounds, err);
    }
    const double events = status == BASE_OK ? (double)t.begin[t.count] : 1;
    if (status == BASE_OK)
        printf("%s,%.0f,%llu,%.2f,%.2f,%.1f\n", path, events, (unsigned long long)cycles, core * 1e9 / events, bounds * 1e9 / events,
               events / core / 1e6);
    tiles_free(&t);
    trace_source_destroy(&s);
    trace_reader_close(&r);
    return status;
}

int main(int argc, char **argv)
{
    const bool repeats = argc > 2 && strcmp(argv[1], "--repeat") == 0;
    const int repeat = repeats ? atoi(argv[2]) : 5;
    sim_machine *machine = NULL;
    base_error err = {0};
    base_status status = sim_machine_load("larrabee", &machine, &err);
    measure_print_head();
    puts("trace,events,cycles,core_ns_per_event,bounds_ns_per_event,core_million_events_per_s");
    for (int i = repeats ? 3 : 1; i < argc && status == BASE_OK; i++)
        status = bench(argv[i], machine, repeat, &err);
    sim_machine_destroy(&machine);
    if (status != BASE_OK)
        fprintf(stderr, "bench_core: %s: %s\n", err.what, err.why);
    return status != BASE_OK;
}
