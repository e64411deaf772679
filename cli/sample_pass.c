#include "cli/sample_pass.h"

#include <stdlib.h>
#include <string.h>

#include "sim/count.h"

/* Bytes that the contents of a machine's caches take: a line, and when it was used. */
static size_t contents_bytes(const sim_machine *machine)
{
    return ((size_t)machine->l1.size_bytes / machine->l1.line_bytes + machine->l2.size_bytes / machine->l2.line_bytes) * 2 * sizeof(uint64_t);
}

sample_pass sample_pass_plan(const run_result *result)
{
    const size_t tiles = kernel_job_tiles(result->job), fit = SAMPLE_PASS_BYTES / contents_bytes(result->machine);
    const size_t most = fit < SAMPLE_PASS_UNITS ? fit + 1 : SAMPLE_PASS_UNITS;
    const size_t cut = (tiles + SAMPLE_PASS_UNIT - 1) / SAMPLE_PASS_UNIT;
    sample_pass p = {.tiles = tiles, .warmup = result->machine->threads};
    p.unit_tiles = SAMPLE_PASS_UNIT * ((cut + most - 1) / most);
    p.units = (tiles + p.unit_tiles - 1) / p.unit_tiles;
    return p;
}

/* The pass at work. */
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

static void trace_tile(tracer *t, size_t tile)
{
    run_result *result = t->result;
    kernel_counts counts = {{0}};
    t->thread = (unsigned)(tile % result->machine->threads);
    t->came = (sim_lines){0};
    memcpy(t->ops, t->ctx->ops, sizeof t->ops);
    result->options.kernel->tile[LRB_TOUCH](t->ctx, result->job, (uint32_t)tile, &counts);
    lrb_ctx_end(t->ctx);
    const double cycles = cycles_since(t);
    result->region_cycles[tile * (SIM_MAX_REGIONS + 1) + SIM_MAX_REGIONS] = cycles;
    const double x[SIM_SAMPLE_VARIATES] = {cycles, 1, (double)t->came.l1, (double)t->came.l2};
    for (int k = 0; k < SIM_SAMPLE_VARIATES; k++)
        t->pass->of[tile / t->pass->unit_tiles].x[k] += x[k];
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        result->counts.n[i] += counts.n[i];
    if (result->tile_counts)
        result->tile_counts[tile] = counts;
}

/* The caches are those of the units whose warm-up begins with the tile. */
static base_status keep_contents(tracer *t, size_t tile, size_t *next, base_error *err)
{
    sample_pass *p = t->pass;
    base_status status = BASE_OK;
    for (; status == BASE_OK && *next < p->units && sample_pass_begin(p, *next) == tile; ++*next) {
        status = sim_contents_create(t->result->machine, &p->contents[*next], err);
        if (status == BASE_OK)
            sim_contents_assign(&p->contents[*next], sim_warmer_contents(t->warmer));
    }
    return status;
}

static base_status trace_all(tracer *t, progress *bar, base_error *err)
{
    sample_pass *p = t->pass;
    base_status status = BASE_OK;
    size_t next = 0; /* unit whose caches are kept next */
    for (size_t tile = 0; status == BASE_OK && tile < p->tiles; tile++) {
        status = keep_contents(t, tile, &next, err);
        trace_tile(t, tile);
        progress_step(bar, 0);
    }
    return status;
}

base_status sample_pass_run(sample_pass *pass, run_result *result, progress *bar, base_error *err)
{
    tracer t = {.pass = pass, .result = result};
    pass->of = calloc(pass->units, sizeof *pass->of);
    pass->contents = calloc(pass->units, sizeof *pass->contents);
    if (!pass->of || !pass->contents)
        return base_fail(err, BASE_ERR_NOMEM, "--error", "out of memory for %zu units", pass->units);
    base_status status = sim_warmer_create(result->machine, &t.warmer, err);
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
    }
    lrb_ctx_destroy(&t.ctx);
    sim_warmer_destroy(&t.warmer);
    return status;
}

void sample_pass_destroy(sample_pass *pass)
{
    for (size_t i = 0; pass->contents && i < pass->units; i++)
        sim_contents_destroy(&pass->contents[i]);
    free(pass->contents);
    free(pass->of);
}
