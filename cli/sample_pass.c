#include "cli/sample_pass.h"

#include <stdlib.h>
#include <string.h>

#include "sim/count.h"

/* Bytes that the contents of a machine's caches take: a line, and when it was used. */
static size_t contents_bytes(const sim_machine *machine)
{
    return ((size_t)machine->l1.size_bytes / machine->l1.line_bytes + machine->l2.size_bytes / machine->l2.line_bytes) * 2 * sizeof(uint64_t);
}

size_t sample_pass_unit_tiles(const run_result *result)
{
    const size_t fit = SAMPLE_PASS_BYTES / contents_bytes(result->machine), most = fit < SAMPLE_PASS_UNITS ? fit + 1 : SAMPLE_PASS_UNITS;
    const size_t units = (kernel_job_tiles(result->job) + SAMPLE_PASS_UNIT - 1) / SAMPLE_PASS_UNIT;
    return SAMPLE_PASS_UNIT * ((units + most - 1) / most);
}

/* Cut tiles [first, limit), a pass of the kernel, into units. */
static void cut(sample_pass *p, const run_result *result, size_t first, size_t limit)
{
    const size_t tiles = sample_pass_unit_tiles(result), threads = result->machine->threads;
    for (size_t at = first; at < limit; at += tiles) {
        const size_t end = limit - at > tiles ? at + tiles : limit, begin = at - first > threads ? at - threads : first;
        p->units[p->unit_count++] = (sample_unit){.first = at, .end = end, .begin = begin, .limit = limit, .edge = at == first || end == limit};
    }
}

static base_status lay_out(sample_pass *p, const run_result *result, base_error *err)
{
    const size_t tiles = kernel_job_tiles(result->job), most = tiles / sample_pass_unit_tiles(result) + 2, threads = result->machine->threads;
    *p = (sample_pass){.tiles = tiles};
    p->units = calloc(most, sizeof *p->units);
    p->begun = calloc(most * threads, sizeof *p->begun);
    if (!p->units || !p->begun)
        return base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu units", most);
    cut(p, result, 0, kernel_job_first_pass(result->job));
    cut(p, result, kernel_job_first_pass(result->job), tiles);
    for (size_t i = 0; i < p->unit_count; i++)
        p->units[i].begun = p->begun + i * threads;
    return BASE_OK;
}

/* The trace at work. */
typedef struct tracer {
    sample_pass *pass;
    run_result *result;
    lrb_ctx *ctx;
    sim_warmer *warmer;
    unsigned thread; /* hardware thread whose tile is traced */
    sim_lines came;  /* of the tile */
    uint64_t ops[LRB_OP_COUNT]; /* before the tile */
} tracer;

static void warm(void *user, const lrb_event *events, uint32_t count)
{
    tracer *t = user;
    const sim_lines came = sim_warmer_events(t->warmer, t->thread, events, count);
    t->came.l1 += came.l1;
    t->came.l2 += came.l2;
}

/* Cycles in `count` of the ops since the tile began. */
static double cycles_since(const tracer *t)
{
    uint64_t ops[LRB_OP_COUNT];
    for (int i = 0; i < LRB_OP_COUNT; i++)
        ops[i] = t->ctx->ops[i] - t->ops[i];
    return (double)sim_count_half_cycles(t->result->machine, ops) / 2;
}

static void trace_tile(tracer *t, size_t tile, sample_unit *unit)
{
    run_result *result = t->result;
    kernel_counts counts = {{0}};
    t->thread = (unsigned)(tile % result->machine->threads);
    t->came = (sim_lines){0};
    memcpy(t->ops, t->ctx->ops, sizeof t->ops);
    result->options.kernel->tile[LRB_TOUCH](t->ctx, result->job, (uint32_t)tile, &counts);
    lrb_ctx_end(t->ctx);
    const double cycles = cycles_since(t), second = tile >= kernel_job_first_pass(result->job);
    const double x[SIM_SAMPLE_VARIATES] = {cycles, 1, second, (double)t->came.l1, (double)t->came.l2};
    for (int k = 0; k < SIM_SAMPLE_VARIATES; k++)
        unit->of.x[k] += x[k];
    result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS] = cycles;
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        result->counts.n[i] += counts.n[i];
    if (result->tile_counts)
        result->tile_counts[tile] = counts;
}

static base_status keep_contents(const tracer *t, sample_unit *unit, base_error *err)
{
    base_status status = sim_contents_create(t->result->machine, &unit->contents, err);
    if (status == BASE_OK)
        sim_contents_assign(&unit->contents, sim_warmer_contents(t->warmer));
    return status;
}

static base_status trace_all(tracer *t, progress *bar, base_error *err)
{
    sample_pass *p = t->pass;
    base_status status = BASE_OK;
    sample_unit *unit = p->units, *next = p->units; /* of the tile; whose caches are kept next */
    for (size_t tile = 0; status == BASE_OK && tile < p->tiles; tile++) {
        for (; status == BASE_OK && next < p->units + p->unit_count && next->begin == tile; next++)
            status = keep_contents(t, next, err);
        unit += tile == unit->end;
        trace_tile(t, tile, unit);
        progress_step(bar, 0);
    }
    return status;
}

/* Where the hardware threads are when a unit begins: in the tiles just before it, evenly out of step. But one that has been in a tile for
 * longer is still there: `in`, until `until`, if each tile takes as long as its cycles in `count` and the thread that is through first takes the next. */
static void find_begun(sample_unit *unit, const run_result *result, const double *until, const sample_begun *in, double now)
{
    const unsigned threads = result->machine->threads;
    unsigned others = 0, at = 0;
    for (unsigned t = 0; t < threads; t++) {
        unit->begun[t] = (sample_begun){.tile = SIZE_MAX};
        if (in[t].tile < unit->begin && until[t] > now)
            unit->begun[t] = (sample_begun){in[t].tile, 1 - (until[t] - now) / sample_pass_tile_cycles(result, in[t].tile)};
        others += unit->begun[t].tile == SIZE_MAX;
    }
    for (unsigned t = 0; unit->first - unit->begin >= others && t < threads; t++)
        if (unit->begun[t].tile == SIZE_MAX) {
            unit->begun[t] = (sample_begun){unit->first - others + at, 1 - (double)(at + 1) / others};
            at++;
        }
}

static base_status schedule(sample_pass *p, const run_result *result, base_error *err)
{
    const unsigned threads = result->machine->threads;
    double *until = calloc(threads, sizeof *until);
    sample_begun *in = calloc(threads, sizeof *in);
    for (sample_unit *unit = p->units; until && in && unit < p->units + p->unit_count; unit++) {
        const bool begins = unit == p->units || unit->limit != unit[-1].limit; /* a pass of the kernel */
        for (unsigned t = 0; begins && t < threads; t++)
            until[t] = 0, in[t].tile = SIZE_MAX;
        for (size_t tile = unit->first; tile < unit->end; tile++) {
            unsigned taker = 0;
            for (unsigned t = 1; t < threads; t++)
                taker = until[t] < until[taker] ? t : taker;
            if (tile == unit->first)
                find_begun(unit, result, until, in, until[taker]);
            in[taker].tile = tile;
            until[taker] += sample_pass_tile_cycles(result, tile);
        }
    }
    const bool failed = !until || !in;
    free(until);
    free(in);
    return failed ? base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %u threads", threads) : BASE_OK;
}

base_status sample_pass_run(run_result *result, progress *bar, sample_pass *pass, base_error *err)
{
    tracer t = {.pass = pass, .result = result};
    base_status status = lay_out(pass, result, err);
    if (status == BASE_OK)
        status = sim_warmer_create(result->machine, &t.warmer, err);
    if (status == BASE_OK)
        status = lrb_ctx_create(warm, &t, &t.ctx, err);
    if (status == BASE_OK) {
        const sim_cache *l1 = sim_warmer_contents(t.warmer)->l1;
        lrb_ctx_set_lines(t.ctx, 1u << l1->line_bits, l1->sets);
        status = trace_all(&t, bar, err);
    }
    if (status == BASE_OK) {
        memcpy(result->ops, t.ctx->ops, sizeof result->ops);
        result->memory_operands = t.ctx->memory_operands;
        result->idle_lanes = t.ctx->idle_lanes;
        status = schedule(pass, result, err);
    }
    lrb_ctx_destroy(&t.ctx);
    sim_warmer_destroy(&t.warmer);
    return status;
}

void sample_pass_destroy(sample_pass *pass)
{
    for (size_t i = 0; i < pass->unit_count; i++)
        sim_contents_destroy(&pass->units[i].contents);
    free(pass->units);
    free(pass->begun);
}
