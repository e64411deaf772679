#include "lanetrace/session.h"

#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "lanetrace/addresses.h"
#include "lanetrace/here.h"
#include "lanetrace/worker.h"
#include "reports/accounts.h"
#include "reports/table.h"
#include "sim/machine.h"

struct lanetrace_session {
    char *name;
    session_model model;
    sim_machine *machine;
    char *phases[SIM_MAX_PHASES];
    size_t phase_count;
    address_arrays arrays;
    pthread_mutex_t lock; /* of the workers' list and of their `busy` */
    session_worker *workers;
};

_Thread_local lanetrace_thread lanetrace_here;
static _Thread_local session_worker *worker_here; /* of the piece under way */

static base_status load_machine(lanetrace_session *s, const lanetrace_options *o, base_error *err)
{
    base_status status = sim_machine_load(o->machine ? o->machine : "larrabee", &s->machine, err);
    for (size_t i = 0; status == BASE_OK && i < o->sets; i++)
        status = sim_machine_set(s->machine, o->set[i], err);
    return status == BASE_OK ? sim_machine_check(s->machine, err) : status;
}

static base_status find_model(const char *name, session_model *out, base_error *err)
{
    for (int i = 0; i < SESSION_MODELS; i++)
        if (strcmp(name, session_model_names[i]) == 0) {
            *out = (session_model)i;
            return BASE_OK;
        }
    return base_fail(err, BASE_ERR_USAGE, "model", "no model '%s' for a session (there are count, issue)", name);
}

static base_status copy_names(lanetrace_session *s, const lanetrace_options *o, base_error *err)
{
    if (o->phase_count > SIM_MAX_PHASES)
        return base_fail(err, BASE_ERR_USAGE, "phases", "%zu are more than %d", o->phase_count, SIM_MAX_PHASES);
    s->name = strdup(o->name ? o->name : "kernel");
    bool copied = s->name != NULL;
    for (; copied && s->phase_count < o->phase_count; s->phase_count += copied)
        copied = (s->phases[s->phase_count] = strdup(o->phases[s->phase_count])) != NULL;
    return copied ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "session", "out of memory");
}

base_status lanetrace_open(const lanetrace_options *options, lanetrace_session **out, base_error *err)
{
    static const lanetrace_options defaults;
    const lanetrace_options *o = options ? options : &defaults;
    *out = NULL;
    lanetrace_session *s = calloc(1, sizeof *s);
    if (!s)
        return base_fail(err, BASE_ERR_NOMEM, "session", "out of memory");
    s->arrays = address_arrays_empty();
    pthread_mutex_init(&s->lock, NULL);
    base_status status = find_model(o->model ? o->model : "issue", &s->model, err);
    if (status == BASE_OK)
        status = copy_names(s, o, err);
    if (status == BASE_OK)
        status = load_machine(s, o, err);
    if (status != BASE_OK)
        lanetrace_close(&s);
    *out = s;
    return status;
}

void lanetrace_close(lanetrace_session **session)
{
    lanetrace_session *s = *session;
    *session = NULL;
    if (!s)
        return;
    while (s->workers) {
        session_worker *w = s->workers;
        assert(!w->busy && "lanetrace_close while a piece of work is under way");
        s->workers = w->next;
        session_worker_destroy(&w);
    }
    address_arrays_free(&s->arrays);
    sim_machine_destroy(&s->machine);
    for (size_t i = 0; i < s->phase_count; i++)
        free(s->phases[i]);
    free(s->name);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

base_status lanetrace_map(lanetrace_session *s, const char *name, void *host, size_t size, lrb_segment *out, base_error *err)
{
    return address_arrays_map(&s->arrays, name, host, size, out, err);
}

void lanetrace_unmap(lanetrace_session *s, const void *host)
{
    address_arrays_unmap(&s->arrays, host);
}

/* A worker that no piece uses, marked as used. */
static session_worker *take_idle_worker(lanetrace_session *s)
{
    pthread_mutex_lock(&s->lock);
    session_worker *w = s->workers;
    while (w && w->busy)
        w = w->next;
    if (w)
        w->busy = 1;
    pthread_mutex_unlock(&s->lock);
    return w;
}

static base_status add_worker(lanetrace_session *s, session_worker **out, base_error *err)
{
    base_status status = session_worker_create(s->model, s->machine, out, err);
    if (status != BASE_OK)
        return status;
    (*out)->busy = 1;
    (*out)->owner = s;
    pthread_mutex_lock(&s->lock);
    (*out)->next = s->workers;
    s->workers = *out;
    pthread_mutex_unlock(&s->lock);
    return BASE_OK;
}

base_status lanetrace_begin(lanetrace_session *s, lrb_ctx **c, base_error *err)
{
    if (worker_here)
        return base_fail(err, BASE_ERR_USAGE, "session", "this thread has a piece of work under way");
    session_worker *w = take_idle_worker(s);
    if (!w) {
        base_status status = add_worker(s, &w, err);
        if (status != BASE_OK)
            return status;
    }
    session_worker_begin(w);
    worker_here = w;
    lanetrace_here = (lanetrace_thread){.ctx = w->ctx};
    if (c)
        *c = w->ctx;
    return BASE_OK;
}

base_status lanetrace_end(lanetrace_session *s, base_error *err)
{
    session_worker *w = worker_here;
    if (!w || w->owner != s)
        return base_fail(err, BASE_ERR_USAGE, "session", "this thread has no piece of work of this session under way");
    worker_here = NULL;
    lanetrace_here = (lanetrace_thread){.ctx = NULL};
    base_status status = session_worker_end(w, err);
    pthread_mutex_lock(&s->lock);
    w->busy = 0;
    pthread_mutex_unlock(&s->lock);
    return status;
}

lrb_ctx *lanetrace_ctx(void) { return lanetrace_here.ctx; }

uint32_t lanetrace_address(const void *host)
{
    assert(worker_here && "no piece of work is under way: lanetrace_begin");
    const lanetrace_session *s = worker_here->owner;
    const lrb_segment *array = address_arrays_find(&s->arrays, host);
    return array ? array->address + (uint32_t)((uintptr_t)host - (uintptr_t)array->host) : address_lines_touch(&worker_here->lines, host);
}

static session_sums sum_up(const lanetrace_session *s)
{
    session_sums sums = {0};
    for (const session_worker *w = s->workers; w; w = w->next)
        session_sums_add(&sums, w);
    session_sums_finish(&sums, s->model, s->machine);
    return sums;
}

static report_accounts accounts_of(const lanetrace_session *s, const session_sums *sums)
{
    return (report_accounts){
        .machine = s->machine,
        .ops = sums->counts.ops,
        .memory_operands = sums->counts.memory_operands,
        .idle_lanes = sums->counts.idle_lanes,
        .cycles = sums->cycles,
        .issue = s->model == SESSION_ISSUE ? &sums->issue : NULL,
        .phases = (const char *const *)s->phases,
        .phase_count = s->phase_count,
    };
}

uint64_t lanetrace_cycles(const lanetrace_session *s) { return sum_up(s).cycles; }

uint64_t lanetrace_ops(const lanetrace_session *s)
{
    session_sums sums = sum_up(s);
    report_accounts a = accounts_of(s, &sums);
    return report_accounts_totals(&a).total;
}

uint64_t lanetrace_op_count(const lanetrace_session *s, const char *op)
{
    session_sums sums = sum_up(s);
    for (int i = 0; i < LRB_OP_COUNT; i++)
        if (strcmp(op, lrb_op_table[i].id) == 0)
            return sums.counts.ops[i];
    return 0;
}

base_status lanetrace_print(const lanetrace_session *s, FILE *out, base_error *err)
{
    session_sums sums = sum_up(s);
    report_accounts a = accounts_of(s, &sums);
    char title[256];
    snprintf(title, sizeof title, "%s, model %s, machine %s", s->name, session_model_names[s->model], s->machine->name);
    report_table *t = report_table_create(title);
    report_table_add_column(t, &(report_column){.name = "statistic"});
    report_table_add_column(t, &(report_column){.name = "value", .kind = REPORT_INTEGER});
    report_accounts_rows(t, &a);
    base_status status = report_table_write_text(t, out, err);
    report_table_destroy(&t);
    return status;
}

base_status lanetrace_write_json(const lanetrace_session *s, FILE *out, base_error *err)
{
    session_sums sums = sum_up(s);
    report_accounts a = accounts_of(s, &sums);
    json_t *stats = json_object();
    json_object_set_new(stats, "schema", json_string("lanetrace-session-1"));
    json_object_set_new(stats, "name", json_string(s->name));
    json_object_set_new(stats, "model", json_string(session_model_names[s->model]));
    json_object_set_new(stats, "machine", report_machine_json(s->machine));
    json_object_set_new(stats, "ops", report_ops_json(&a));
    json_object_set_new(stats, "cycles", report_cycles_json(&a));
    base_status status = report_json_write(stats, out, err);
    json_decref(stats);
    return status;
}
