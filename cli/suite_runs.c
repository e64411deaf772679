#include "cli/suite_runs.h"

#include <pthread.h>
#include <stdlib.h>

#include "cli/progress.h"
#include "lrbni/base/parallel.h"

/* Results that wait for their turn hold frames and trees, so that there may not be many: of so many runs a host thread the first is taken
   before another one begins. */
enum { AHEAD = 2 };

typedef struct outcome {
    bool ended;
    run_result result;
    base_error error;
} outcome;

/* All runs of a list under way. */
typedef struct under_way {
    suite *s;
    const suite_runs *runs;
    void *user;
    outcome *outcomes; /* by run */
    pthread_mutex_t mutex; /* guards what follows, and `ended` */
    pthread_cond_t changed;
    size_t begun, taken;
    size_t end;     /* the first run that failed, or the number of runs: none from there on begins */
    unsigned spare; /* host threads that no run has */
    bool taking;
    base_error error; /* of the run at `taken`, which failed */
    progress bar;
} under_way;

void suite_runs_add(suite_runs *runs, suite_run_entry entry)
{
    suite_run_entry *entries = realloc(runs->entries, (runs->count + 1) * sizeof *entries);
    runs->failed |= !entries;
    if (!entries)
        return;
    runs->entries = entries;
    entries[runs->count++] = entry;
}

/* Wait until a run may begin. Returns the host threads that it gets: those without work are shared with the runs to come; 0: it does not matter any more. */
static unsigned begin(under_way *u, size_t run)
{
    unsigned threads = 0;
    pthread_mutex_lock(&u->mutex);
    while (run < u->end && run >= u->taken + (size_t)AHEAD * u->s->jobs)
        pthread_cond_wait(&u->changed, &u->mutex);
    if (run < u->end) {
        const size_t to_come = u->runs->count - u->begun++;
        threads = u->spare > to_come ? (unsigned)(u->spare / to_come) : 1;
        u->spare -= threads;
    }
    pthread_mutex_unlock(&u->mutex);
    return threads;
}

/* The mutex is held. */
static void fail(under_way *u, size_t run)
{
    u->end = run < u->end ? run : u->end;
    pthread_cond_broadcast(&u->changed);
}

static base_status take_one(under_way *u, size_t run, base_error *err)
{
    const suite_run_entry *entry = &u->runs->entries[run];
    outcome *o = &u->outcomes[run];
    base_status status = o->error.status;
    if (status == BASE_OK)
        status = entry->take(u->s, entry, &o->result, u->user, err);
    else
        *err = o->error;
    err->status = status;
    run_result_destroy(&o->result);
    return status;
}

/* Take what has ended and has its turn, unless another thread does just now; the mutex is held. */
static void take_ended(under_way *u)
{
    while (!u->taking && u->error.status == BASE_OK && u->taken < u->runs->count && u->outcomes[u->taken].ended) {
        base_error error = {0};
        u->taking = true;
        pthread_mutex_unlock(&u->mutex);
        base_status status = take_one(u, u->taken, &error);
        pthread_mutex_lock(&u->mutex);
        u->taking = false;
        progress_step(&u->bar, 0);
        if (status == BASE_OK) {
            u->taken++;
            pthread_cond_broadcast(&u->changed);
        } else {
            u->error = error;
            fail(u, u->taken);
        }
    }
}

static void make_run(void *user, size_t run, unsigned worker)
{
    under_way *u = user;
    const suite_run_entry *entry = &u->runs->entries[run];
    outcome *o = &u->outcomes[run];
    run_options options = entry->options;
    (void)worker;
    options.progress = false;
    options.jobs = begin(u, run);
    if (!options.jobs)
        return;
    base_status status = run_kernel(u->s->scenes[entry->scene].scene, entry->machine ? entry->machine : u->s->options->machine, &options,
                                    &o->result, &o->error);
    pthread_mutex_lock(&u->mutex);
    u->spare += options.jobs;
    o->ended = true;
    o->error.status = status;
    if (status != BASE_OK)
        fail(u, run);
    take_ended(u);
    pthread_mutex_unlock(&u->mutex);
}

/* Make the runs; what was not taken is freed. */
static base_status make_all(under_way *u, base_error *err)
{
    const size_t count = u->runs->count;
    pthread_mutex_init(&u->mutex, NULL);
    pthread_cond_init(&u->changed, NULL);
    u->end = count;
    u->spare = u->s->jobs;
    u->bar = progress_begin(u->s->info->name, count, true);
    base_parallel_for(u->s->jobs, count, make_run, u);
    progress_end(&u->bar);
    for (size_t i = u->taken; i < count; i++)
        run_result_destroy(&u->outcomes[i].result);
    pthread_mutex_destroy(&u->mutex);
    pthread_cond_destroy(&u->changed);
    return u->error.status == BASE_OK ? BASE_OK : base_fail(err, u->error.status, u->error.what, "%s", u->error.why);
}

base_status suite_runs_take(suite *s, suite_runs *runs, void *user, base_error *err)
{
    under_way u = {.s = s, .runs = runs, .user = user, .outcomes = calloc(runs->count, sizeof *u.outcomes)};
    base_status status = u.outcomes && !runs->failed ? suite_open_scenes(s, err)
                                                     : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = make_all(&u, err);
    free(u.outcomes);
    free(runs->entries);
    *runs = (suite_runs){0};
    return status;
}
