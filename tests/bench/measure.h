/* What the benchmarks share: the clock, medians, options, the lines that name the host, and the timing of a build of the BVH. */
#ifndef TESTS_BENCH_MEASURE_H
#define TESTS_BENCH_MEASURE_H

#include "kernels/accel/bvh.h"
#include "lrbni/base/status.h"
#include "scene/scene.h"

#define MEASURE_MAX_RUNS 99

/* What benchmarks of kernels are told: the edge of the picture in pixels, and how many runs. */
typedef struct measure_picture {
    unsigned size;
    int repeat;
} measure_picture;

/** Read [--size 1..most_size] [--repeat 1..MEASURE_MAX_RUNS]; returns the index of the first argument behind them, 0 if one is wrong. */
int measure_picture_parse(int argc, char **argv, unsigned most_size, measure_picture *out);

/** Seconds on a clock that only goes forward. */
double measure_seconds(void);

/** Median of `count` numbers, 1 to MEASURE_MAX_RUNS; of an even count the mean of the middle two. */
double measure_median(const double *numbers, int count);

/** Print the head of a CSV: lines of '#' with the compiler, its flags, the back end and the CPU. */
void measure_print_head(void);

/**
 * Build the tree of a scene `repeat` times.
 *
 * @param best  out: seconds of the fastest build
 * @param out   one of the trees, free with bvh_destroy; NULL on failure
 *
 * Errors: those of bvh_build.
 */
base_status measure_bvh_build(const scene *s, const bvh_options *options, int repeat, double *best, bvh **out, base_error *err);

#endif
