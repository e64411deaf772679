/* Run independent pieces of work on the host's threads. Results may not depend on which thread ran what. */
#ifndef LRBNI_BASE_PARALLEL_H
#define LRBNI_BASE_PARALLEL_H

#include <stddef.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One piece of work: `worker` is below the number of jobs and is never used by two pieces at the same time. */
typedef void base_parallel_fn(void *user, size_t piece, unsigned worker);

/** Number of host threads that can run at the same time, at least 1 (respects the process's CPU affinity). */
unsigned base_parallel_jobs(void);

/**
 * Call fn(user, piece, worker) once for every piece in [0, pieces), on up to `jobs` threads; return when all are done.
 * Pieces are handed out in order. jobs = 1 runs them here. If the host has no threads to give, fewer are used.
 */
void base_parallel_for(unsigned jobs, size_t pieces, base_parallel_fn *fn, void *user);

#ifdef __cplusplus
}
#endif
#endif
