/* The host's clock: for host seconds and progress bars, never for results. */
#ifndef CLI_CLOCK_H
#define CLI_CLOCK_H

#include <time.h>

/** Seconds since some fixed moment. */
static inline double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/** Seconds that the host's processors have spent on this process, all its threads together. */
static inline double clock_processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
