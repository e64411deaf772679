#include "lrbni/base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { MAX_JOBS = 1024 };

typedef struct shared_work {
    atomic_size_t next;
    size_t pieces;
    base_parallel_fn *fn;
    void *user;
} shared_work;

typedef struct worker {
    shared_work *work;
    unsigned index;
    pthread_t thread;
} worker;

static void *run_pieces(void *arg)
{
    worker *w = arg;
    for (;;) {
        size_t piece = atomic_fetch_add(&w->work->next, 1);
        if (piece >= w->work->pieces)
            return NULL;
        w->work->fn(w->work->user, piece, w->index);
    }
}

unsigned base_parallel_jobs(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return 1;
    int count = CPU_COUNT(&set);
    return count < 1 ? 1 : count > MAX_JOBS ? MAX_JOBS : (unsigned)count;
}

void base_parallel_for(unsigned jobs, size_t pieces, base_parallel_fn *fn, void *user)
{
    shared_work work = {.pieces = pieces, .fn = fn, .user = user};
    worker workers[MAX_JOBS];
    unsigned started = 1;
    if (jobs > MAX_JOBS)
        jobs = MAX_JOBS;
    if (jobs > pieces)
        jobs = (unsigned)pieces;
    if (jobs < 1)
        jobs = 1;
    atomic_init(&work.next, 0);
    for (unsigned i = 0; i < jobs; i++)
        workers[i] = (worker){.work = &work, .index = i};
    while (started < jobs && pthread_create(&workers[started].thread, NULL, run_pieces, &workers[started]) == 0)
        started++;
    run_pieces(&workers[0]);
    for (unsigned i = 1; i < started; i++)
        pthread_join(workers[i].thread, NULL);
}
