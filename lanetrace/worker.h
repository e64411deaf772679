/* What one host thread accounts a piece of work with: the context of its ops and the model that its events go to. Private to
 * lanetrace. A further model is a member of session_model and a case in each function of worker.c. */
#ifndef LANETRACE_WORKER_H
#define LANETRACE_WORKER_H

#include "lanetrace/addresses.h"
#include "lrbni/ctx.h"
#include "sim/count.h"
#include "sim/issue.h"

typedef enum session_model { SESSION_COUNT, SESSION_ISSUE, SESSION_MODELS } session_model;

/** "count", "issue". */
extern const char *const session_model_names[SESSION_MODELS];

typedef struct session_worker {
    session_model model;
    lrb_ctx *ctx;
    sim_op_counts counts; /* SESSION_COUNT */
    sim_issue *issue;     /* SESSION_ISSUE */
    address_lines lines;
    const void *owner;           /* the session */
    struct session_worker *next; /* of the session's, all of them */
    int busy;                    /* a piece is under way */
} session_worker;

/** Errors: BASE_ERR_NOMEM. Free with session_worker_destroy. */
base_status session_worker_create(session_model model, const sim_machine *machine, session_worker **out, base_error *err);
void session_worker_destroy(session_worker **w);

void session_worker_begin(session_worker *w);

/** Errors: see lanetrace_end. */
base_status session_worker_end(session_worker *w, base_error *err);

/* Sums over pieces. */
typedef struct session_sums {
    sim_op_counts counts;
    sim_issue_stats issue; /* SESSION_ISSUE */
    uint64_t cycles;
} session_sums;

/** Add what a worker has accounted for; session_sums_finish makes the totals of it. */
void session_sums_add(session_sums *sums, const session_worker *w);
void session_sums_finish(session_sums *sums, session_model model, const sim_machine *machine);

#endif
