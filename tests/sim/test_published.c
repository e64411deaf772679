/* Published measurements of Knights Corner against the core model with knc.ini, which was fitted to none of them.
 *
 * test_published prints the table that docs/machine-model.md has. A row fails if its error is above its tolerance: 10 %,
 * or what is known and explained there. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/core.h"

enum { LINE = 64, MAX_EVENTS = 1 << 16 };

/* A stream for each hardware thread, the same or at an address of its own. */
typedef struct stream {
    lrb_event events[4][MAX_EVENTS];
    size_t count, from; /* the threads' tile: events from `from` on */
    unsigned threads, next;
} stream;

static stream all;

static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    stream *s = user;
    (void)thread, (void)err;
    *events = s->next < s->threads ? s->events[s->next++] : NULL;
    *count = s->count;
    return BASE_OK;
}

/* Cycles of `threads` threads over their first `count` events on knc with this many cores at work. */
static uint64_t cycles_of(unsigned cores, unsigned threads, size_t count)
{
    const sim_core_feed feed = {next_tile, NULL, &all};
    sim_machine *machine = NULL;
    sim_core *core = NULL;
    char assignment[32];
    snprintf(assignment, sizeof assignment, "cores=%u", cores);
    assert_int_equal(sim_machine_load("knc", &machine, NULL), BASE_OK);
    assert_int_equal(sim_machine_set(machine, assignment, NULL), BASE_OK);
    all.count = count;
    all.threads = threads;
    all.next = 0;
    assert_int_equal(sim_core_create(machine, &core, NULL), BASE_OK);
    assert_int_equal(sim_core_run(core, &feed, NULL), BASE_OK);
    uint64_t cycles = sim_core_get(core).cycles;
    sim_core_destroy(&core);
    sim_machine_destroy(&machine);
    return cycles;
}

/* Core cycles an item of `per_item` events once the start is over: of the last third of 3 x `part` events of each thread. */
static double steady(unsigned cores, unsigned threads, size_t part, unsigned per_item)
{
    assert_true(3 * part <= MAX_EVENTS);
    return (double)(cycles_of(cores, threads, 3 * part) - cycles_of(cores, threads, 2 * part)) * per_item / (double)(part * threads);
}

static lrb_event op(unsigned id, unsigned distance)
{
    return (lrb_event){.op = (uint16_t)id, .mask = 0xffff, .src = {(uint16_t)distance}};
}

static lrb_event at(unsigned id, uint32_t address, unsigned distance)
{
    lrb_event e = op(id, distance);
    e.aux = address;
    return e;
}

/* Core cycles a multiply-add (or multiply) of `chains` independent chains in each of the threads. */
static double chains(unsigned id, unsigned threads, unsigned count)
{
    for (unsigned t = 0; t < 4; t++)
        for (unsigned i = 0; i < 6000; i++)
            all.events[t][i] = op(id, i >= count ? count : 0);
    return steady(1, threads, 2000, 1);
}

/* Core cycles a turn of a loop over n dependent multiply-adds with add, compare and jump. The order of the published loop is not
 * known: here a scalar op stands behind each multiply-add, as compilers for this core place them. */
static double unrolled(unsigned threads, unsigned n)
{
    static lrb_event turn[16];
    const lrb_event scalar[3] = {op(LRB_OP_add, n + 3), op(LRB_OP_cmp, n > 1 ? 2 : 1), {.op = LRB_OP_jcc, .mask = 1, .src = {n > 2 ? 2 : 1}, .aux = 1}};
    const unsigned length = n + 3;
    unsigned k = 0;
    for (unsigned f = 0, i = 0; f < n || i < 3; f++) {
        if (f < n)
            turn[k++] = op(LRB_OP_madd231_ps, f == 0 ? length - (n < 4 ? 2 * n - 2 : n + 2) : f < 4 ? 2 : 1);
        if (i < 3)
            turn[k++] = scalar[i++];
    }
    for (unsigned t = 0; t < 4; t++)
        for (unsigned i = 0; i < 600 * length; i++) {
            all.events[t][i] = turn[i % length];
            if (i < length)
                all.events[t][i].src[0] = 0;
        }
    return steady(1, threads, 200 * length, length);
}

/* Cycles an access of a pointer chase through `bytes` with a stride, in the last of three passes. */
static double chase(unsigned bytes, unsigned stride)
{
    const unsigned n = bytes / stride;
    for (unsigned i = 0; i < 3 * n; i++)
        all.events[0][i] = at(LRB_OP_load32, i % n * stride, i ? 1 : 0);
    return steady(1, 1, n, 1);
}

/* Cycles of a gather of n lines in the first level or the second, as a loop of executions and jknzd whose data the index of the next one
 * hangs on. Of three passes over the lines the last counts. */
static double gather_loop(unsigned bytes, unsigned n)
{
    const unsigned gathers = bytes / LINE / n, per_gather = 2 * n + 1;
    lrb_event *e = all.events[0];
    for (unsigned g = 0; g < 3 * gathers; g++) {
        *e++ = op(LRB_OP_add_pi, g ? 2 : 0);
        for (unsigned i = 0; i < n; i++) {
            *e++ = (lrb_event){.op = LRB_OP_gatherd_ps | LRB_FORM_LINE, .mask = (uint16_t)((1u << 16 / n) - 1), .aux = (g % gathers * n + i) * LINE,
                               .src = {0, (uint16_t)(2 * i + 1), i ? 2 : 0, i ? 2 : 0}};
            *e++ = (lrb_event){.op = LRB_OP_jknzd, .mask = i + 1 < n, .src = {1}, .aux = 1};
        }
    }
    return steady(1, 1, gathers * per_gather, per_gather) - 4; /* less the addition */
}

/* GB/s that `cores` cores read, each with `threads` threads that add up lines, `ahead` lines prefetched; 0: none. */
static double read_bandwidth(unsigned cores, unsigned threads, unsigned ahead)
{
    enum { LINES = 3000 };
    const unsigned per_line = ahead ? 2 : 1;
    for (unsigned t = 0; t < 4; t++)
        for (unsigned i = 0; i < LINES; i++) {
            const uint32_t address = (t * LINES + i) * LINE;
            if (ahead)
                all.events[t][2 * i] = at(LRB_OP_prefetch1, address + ahead * LINE, 0);
            all.events[t][per_line * i + per_line - 1] = at(LRB_OP_add_ps | LRB_FORM_MEMORY, address, 0);
        }
    const double cycles = steady(cores, threads, per_line * LINES / 3, per_line);
    return cores * LINE * 1.1 / cycles;
}

/* Cycles a line of a stream through lines of the second level, prefetched to the first. */
static double l2_stream(void)
{
    enum { LINES = 4096 };
    for (unsigned pass = 0, n = 0; pass < 3; pass++)
        for (unsigned i = 0; i < LINES; i++, n += 2) {
            all.events[0][n] = at(LRB_OP_prefetch1, (i + 16) % LINES * LINE, 0);
            all.events[0][n + 1] = at(LRB_OP_add_ps | LRB_FORM_MEMORY, i * LINE, 0);
        }
    return steady(1, 1, 2 * LINES, 2);
}

/* Share of the peak that a step of a matrix kernel reaches: 30 multiply-adds, a load and a broadcast in U, scalar work in V. */
static double blocked_product(void)
{
    enum { STEP = 64 };
    for (unsigned t = 0; t < 4; t++)
        for (unsigned i = 0; i < 150 * STEP; i++) {
            unsigned k = i % STEP;
            all.events[t][i] = k % 2              ? op(LRB_OP_add, 0)
                               : k == 0 || k == 2 ? at(LRB_OP_load_ps, 4096 * t, 0)
                                                  : op(LRB_OP_madd231_ps, i >= STEP ? STEP : 0);
        }
    return 100 * 30 / steady(1, 4, 50 * STEP, STEP);
}

typedef struct row {
    const char *what, *source, *unit;
    double measured, simulated, tolerance;
} row;

static void published__each__within_its_tolerance(void **state)
{
    (void)state;
    const unsigned fma = LRB_OP_madd231_ps, mul = LRB_OP_mul_ps;
    const row rows[] = {
        {"dependent FMA, 1 thread", "MM bench_vpu", "cycles/FMA", 4.03, chains(fma, 1, 1), 0.10},
        {"the same, 2 threads", "MM bench_vpu", "cycles/FMA", 2.02, chains(fma, 2, 1), 0.10},
        {"the same, 4 threads", "MM bench_vpu", "cycles/FMA", 1.02, chains(fma, 4, 1), 0.10},
        {"2 chains of FMA, 1 thread", "MM bench_vpu", "cycles/FMA", 2.02, chains(fma, 1, 2), 0.10},
        {"4 chains of FMA, 1 thread", "MM bench_vpu", "cycles/FMA", 2.02, chains(fma, 1, 4), 0.10},
        {"8 chains of FMA, 1 thread", "MM bench_vpu", "cycles/FMA", 2.02, chains(fma, 1, 8), 0.10},
        {"2 chains of FMA, 2 threads", "MM bench_vpu", "cycles/FMA", 1.02, chains(fma, 2, 2), 0.10},
        {"2 chains of FMA, 4 threads", "MM bench_vpu", "cycles/FMA", 1.01, chains(fma, 4, 2), 0.10},
        {"dependent multiply, 1 thread", "MM bench_vpu", "cycles/op", 4.03, chains(mul, 1, 1), 0.10},
        {"dependent multiply, 4 threads", "MM bench_vpu", "cycles/op", 1.01, chains(mul, 4, 1), 0.10},
        {"loop of 1 FMA, 4 threads", "MM unroll sweep", "cycles/turn", 3.08, unrolled(4, 1), 0.40},
        {"loop of 2 FMA, 4 threads", "MM unroll sweep", "cycles/turn", 3.08, unrolled(4, 2), 0.10},
        {"loop of 3 FMA, 4 threads", "MM unroll sweep", "cycles/turn", 3.13, unrolled(4, 3), 0.10},
        {"loop of 4 FMA, 4 threads", "MM unroll sweep", "cycles/turn", 4.12, unrolled(4, 4), 0.10},
        {"loop of 1 FMA, 1 thread", "MM unroll sweep", "cycles/turn", 7.0, unrolled(1, 1), 0.45},
        {"loop of 2 FMA, 1 thread", "MM unroll sweep", "cycles/turn", 8.5, unrolled(1, 2), 0.10},
        {"loop of 3 FMA, 1 thread", "MM unroll sweep", "cycles/turn", 12.3, unrolled(1, 3), 0.10},
        {"loop of 4 FMA, 1 thread", "MM unroll sweep", "cycles/turn", 16.1, unrolled(1, 4), 0.10},
        {"chase in the first level", "MM latency", "cycles", 3.0, chase(16384, LINE), 0.10},
        {"chase in the second level", "MM latency", "cycles", 24.2, chase(131072, LINE), 0.10},
        {"the same", "MCC", "cycles", 23.4, chase(131072, LINE), 0.10},
        {"the same, stride 32", "MM latency", "ns", 12.4, chase(131072, 32) / 1.1, 0.10},
        {"the same, stride 16", "MM latency", "ns", 7.6, chase(131072, 16) / 1.1, 0.10},
        {"the same, stride 8", "MM latency", "ns", 5.1, chase(131072, 8) / 1.1, 0.10},
        {"chase in memory", "MM latency", "cycles", 296, chase(1048576, LINE), 0.10},
        {"reading, 1 thread, no prefetch", "MM bandwidth", "GB/s", 0.22, read_bandwidth(1, 1, 0), 0.10},
        {"reading, 1 thread, prefetch", "MM bandwidth", "GB/s", 4.67, read_bandwidth(1, 1, 32), 0.10},
        {"reading, 4 threads, prefetch", "MM bandwidth", "GB/s", 4.78, read_bandwidth(1, 4, 32), 0.10},
        {"reading, 4 cores", "MM bandwidth", "GB/s", 18.5, read_bandwidth(4, 1, 32), 0.10},
        {"reading, 8 cores", "MM bandwidth", "GB/s", 35.7, read_bandwidth(8, 1, 32), 0.10},
        {"reading, 16 cores", "MM bandwidth", "GB/s", 66.2, read_bandwidth(16, 1, 32), 0.20},
        {"reading, 32 cores", "MM bandwidth", "GB/s", 112, read_bandwidth(32, 1, 32), 0.40},
        {"reading, 48 cores", "MM bandwidth", "GB/s", 150, read_bandwidth(48, 1, 32), 0.10},
        {"reading, 60 cores", "MM bandwidth", "GB/s", 160, read_bandwidth(60, 1, 32), 0.10},
        {"gather of 1 line, first level", "HOF (recalled)", "cycles", 9.0, gather_loop(16384, 1), 0.30},
        {"gather of 2 lines", "HOF (recalled)", "cycles", 8.4, gather_loop(16384, 2), 0.10},
        {"gather of 4 lines", "HOF (recalled)", "cycles", 14.8, gather_loop(16384, 4), 0.15},
        {"gather of 8 lines", "HOF (recalled)", "cycles", 23.2, gather_loop(16384, 8), 0.10},
        {"gather of 16 lines", "HOF (recalled)", "cycles", 36.8, gather_loop(16384, 16), 0.10},
        {"gather of 16 lines, second level", "HOF (recalled)", "cycles", 129.6, gather_loop(131072, 16), 2.0},
        {"stream from the second level", "MCC", "cycles/line", 3.06, l2_stream(), 0.10},
        {"30 x 8 matrix kernel, 4 threads", "BLIS", "% of peak", 93.75, blocked_product(), 0.10},
    };
    bool good = true;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const row *r = &rows[i];
        const double error = r->simulated / r->measured - 1;
        printf("# | %s | %s | %s | %.4g | %.4g | %+.1f %% |\n", r->what, r->source, r->unit, r->measured, r->simulated, 100 * error);
        good = good && error <= r->tolerance && error >= -r->tolerance;
    }
    assert_true(good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published__each__within_its_tolerance),
    };
    return cmocka_run_group_tests_name("sim/published", tests, NULL, NULL);
}
