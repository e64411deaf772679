/* Pieces of work: each done once whatever the number of threads, in order, and no worker shared. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/parallel.h"

enum { MOST_PIECES = 5000, MOST_WORKERS = 4096 };

/* Filled in by pieces on any thread: cmocka's asserts wait until all are done. */
typedef struct work {
    atomic_uint done[MOST_PIECES];
    atomic_uint busy[MOST_WORKERS];   /* 1 while a piece runs as that worker */
    size_t last_of[MOST_WORKERS];     /* highest piece that the worker did, plus 1 */
    atomic_uint shared, out_of_order; /* violations seen */
    unsigned jobs;
    atomic_uint beyond;               /* worker numbers that are not below the number of jobs */
} work;

static void piece_of(void *user, size_t piece, unsigned worker)
{
    work *w = user;
    if (worker >= (w->jobs ? w->jobs : 1)) {
        atomic_fetch_add(&w->beyond, 1);
        return;
    }
    if (atomic_exchange(&w->busy[worker], 1))
        atomic_fetch_add(&w->shared, 1);
    if (piece < w->last_of[worker])
        atomic_fetch_add(&w->out_of_order, 1);
    w->last_of[worker] = piece + 1;
    atomic_fetch_add(&w->done[piece], 1);
    atomic_store(&w->busy[worker], 0);
}

static work w;

static void check(unsigned jobs, size_t pieces)
{
    memset(&w, 0, sizeof w);
    w.jobs = jobs;
    base_parallel_for(jobs, pieces, piece_of, &w);
    for (size_t i = 0; i < MOST_PIECES; i++)
        if (w.done[i] != (i < pieces))
            fail_msg("%u jobs, %zu pieces: piece %zu was done %u times", jobs, pieces, i, w.done[i]);
    assert_int_equal(w.shared, 0);
    assert_int_equal(w.out_of_order, 0);
    assert_int_equal(w.beyond, 0);
}

static void parallel__any_number_of_jobs__each_piece_once(void **state)
{
    (void)state;
    const unsigned jobs[] = {1, 2, 3, 4, 7, 16, 64};
    const size_t pieces[] = {0, 1, 2, 3, 15, 16, 17, 100, MOST_PIECES};
    for (size_t i = 0; i < sizeof jobs / sizeof jobs[0]; i++)
        for (size_t j = 0; j < sizeof pieces / sizeof pieces[0]; j++)
            check(jobs[i], pieces[j]);
}

/* No jobs is one job; more than there may be threads is fewer. */
static void parallel__zero_or_too_many_jobs__each_piece_once(void **state)
{
    (void)state;
    check(0, 10);
    check(MOST_WORKERS, 10);
    check(UINT32_MAX, 3);
}

static void count_on_this_thread(void *user, size_t piece, unsigned worker)
{
    size_t *next = user;
    if (worker == 0 && piece == *next)
        ++*next; /* no atomics: one job is this thread */
}

static void parallel__one_job__in_order_on_worker_zero(void **state)
{
    (void)state;
    size_t next = 0;
    base_parallel_for(1, 1000, count_on_this_thread, &next);
    assert_int_equal(next, 1000);
}

/* A piece may start work of its own. */
static void nested_piece(void *user, size_t piece, unsigned worker)
{
    atomic_uint *sum = user;
    (void)worker;
    atomic_fetch_add(sum, (unsigned)piece);
}

static void outer_piece(void *user, size_t piece, unsigned worker)
{
    (void)piece, (void)worker;
    base_parallel_for(3, 10, nested_piece, user);
}

static void parallel__nested__all_done(void **state)
{
    (void)state;
    atomic_uint sum = 0;
    base_parallel_for(3, 20, outer_piece, &sum);
    assert_int_equal(sum, 20 * 45);
}

static void jobs__here__at_least_one(void **state)
{
    (void)state;
    assert_true(base_parallel_jobs() >= 1 && base_parallel_jobs() <= 1024);
}

/* What a piece got wrong is in its own error; the others are untouched. */
typedef struct outcome {
    base_status status;
    base_error err;
} outcome;

static void fail_every_third(void *user, size_t piece, unsigned worker)
{
    outcome *all = user;
    (void)worker;
    if (piece % 3 == 0)
        all[piece].status = base_fail(&all[piece].err, BASE_ERR_INPUT, "piece", "number %zu", piece);
}

static void parallel__pieces_fail__each_its_own_error(void **state)
{
    (void)state;
    static outcome all[60];
    base_parallel_for(4, 60, fail_every_third, all);
    for (size_t i = 0; i < 60; i++) {
        assert_int_equal(all[i].status, i % 3 == 0 ? BASE_ERR_INPUT : BASE_OK);
        assert_int_equal(all[i].err.why[0] != '\0', i % 3 == 0);
    }
    assert_string_equal(all[57].err.why, "number 57");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallel__any_number_of_jobs__each_piece_once),
        cmocka_unit_test(parallel__zero_or_too_many_jobs__each_piece_once),
        cmocka_unit_test(parallel__one_job__in_order_on_worker_zero),
        cmocka_unit_test(parallel__nested__all_done),
        cmocka_unit_test(jobs__here__at_least_one),
        cmocka_unit_test(parallel__pieces_fail__each_its_own_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
