#include "lanetrace/worker.h"

#include <stdlib.h>
#include <string.h>

const char *const session_model_names[SESSION_MODELS] = {"count", "issue"};

static base_status create_model(session_worker *w, const sim_machine *machine, base_error *err)
{
    switch (w->model) {
    case SESSION_ISSUE: {
        base_status status = sim_issue_create(machine, &w->issue, err);
        return status == BASE_OK ? lrb_ctx_create(sim_issue_events, w->issue, &w->ctx, err) : status;
    }
    default:
        return lrb_ctx_create(sim_count_events, &w->counts, &w->ctx, err);
    }
}

base_status session_worker_create(session_model model, const sim_machine *machine, session_worker **out, base_error *err)
{
    session_worker *w = calloc(1, sizeof *w);
    if (!w)
        return base_fail(err, BASE_ERR_NOMEM, "session", "out of memory");
    w->model = model;
    base_status status = create_model(w, machine, err);
    if (status != BASE_OK)
        session_worker_destroy(&w);
    *out = w;
    return status;
}

void session_worker_destroy(session_worker **w)
{
    if (*w) {
        lrb_ctx_destroy(&(*w)->ctx);
        sim_issue_destroy(&(*w)->issue);
        address_lines_free(&(*w)->lines);
        free(*w);
    }
    *w = NULL;
}

void session_worker_begin(session_worker *w)
{
    address_lines_begin(&w->lines);
    if (w->model == SESSION_ISSUE)
        sim_issue_begin(w->issue);
}

/* Move to the worker what a kernel at LRB_COUNT has counted in the context; whether that was anything. */
static bool take_counts(session_worker *w)
{
    uint64_t any = 0;
    for (int i = 0; i < LRB_OP_COUNT; i++) {
        any |= w->ctx->ops[i];
        w->counts.ops[i] += w->ctx->ops[i];
    }
    w->counts.memory_operands += w->ctx->memory_operands;
    w->counts.idle_lanes += w->ctx->idle_lanes;
    memset(w->ctx->ops, 0, sizeof w->ctx->ops);
    w->ctx->memory_operands = w->ctx->idle_lanes = 0;
    return any != 0;
}

base_status session_worker_end(session_worker *w, base_error *err)
{
    uint64_t regions[SIM_MAX_REGIONS + 1];
    bool counted = take_counts(w);
    lrb_ctx_end(w->ctx);
    if (w->model == SESSION_ISSUE)
        sim_issue_end(w->issue, regions);
    if (w->lines.status == BASE_ERR_NOMEM)
        return base_fail(err, BASE_ERR_NOMEM, "session", "out of memory for the addresses of unmapped memory");
    if (w->lines.status != BASE_OK)
        return base_fail(err, w->lines.status, "session", "a piece of work touched more unmapped memory than there are addresses");
    if (counted && w->model != SESSION_COUNT)
        return base_fail(err, BASE_ERR_USAGE, "session", "model '%s' needs events: compile the kernel with LRB_LEVEL=2", session_model_names[w->model]);
    return BASE_OK;
}

void session_sums_add(session_sums *sums, const session_worker *w)
{
    if (w->model == SESSION_ISSUE) {
        sim_issue_stats_add(&sums->issue, sim_issue_get(w->issue));
        return;
    }
    for (int i = 0; i < LRB_OP_COUNT; i++)
        sums->counts.ops[i] += w->counts.ops[i];
    sums->counts.memory_operands += w->counts.memory_operands;
    sums->counts.idle_lanes += w->counts.idle_lanes;
}

void session_sums_finish(session_sums *sums, session_model model, const sim_machine *machine)
{
    if (model == SESSION_ISSUE) {
        memcpy(sums->counts.ops, sums->issue.ops, sizeof sums->counts.ops);
        sums->counts.memory_operands = sums->issue.memory_operands;
        for (int phase = 0; phase < SIM_MAX_PHASES; phase++)
            sums->counts.idle_lanes += sums->issue.phase_idle_lanes[phase];
        sums->cycles = sums->issue.cycles;
    } else {
        sums->cycles = (sim_count_half_cycles(machine, sums->counts.ops) + 1) / 2;
    }
}
