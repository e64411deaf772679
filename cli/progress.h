/* A progress bar on stderr: only on a terminal, only for work that takes a while. */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct progress {
    const char *label;
    size_t total;
    atomic_size_t done;
    bool shown; /* wanted, and stderr is a terminal */
    double start, last;
} progress;

/** Begin; `label` must live as long as the bar. */
progress progress_begin(const char *label, size_t total, bool wanted);

/** One piece is done; any thread may say so, worker 0 draws. */
void progress_step(progress *p, unsigned worker);

/** Wipe the bar. */
void progress_end(progress *p);

#endif
