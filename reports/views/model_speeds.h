/* The view of host speed against error of the timing models: what a simpler model saves, and how far its cycles are off.
 *
 *   scene      kernel       model                 changed    host seconds  x native  cycles      error [%]  tiles
 *   rooms-804  mft-primary  native                           0.0051        1.0
 *                           core, without caches  l2.latency=3 ...  0.21   41.2      12,616,829  -19.9
 */
#ifndef REPORTS_VIEWS_MODEL_SPEEDS_H
#define REPORTS_VIEWS_MODEL_SPEEDS_H

#include <stdbool.h>
#include <stdint.h>

#include "reports/plot.h"
#include "reports/table.h"

/* One model on one kernel and scene. */
typedef struct model_speed {
    const char *scene, *kernel, *model;
    const char *changed; /* fields of the machine, or the error that was asked for; "" for none */
    double seconds, native_seconds;
    bool has_cycles;
    uint64_t cycles, core_cycles;
    uint64_t tiles_simulated, tiles; /* 0, 0: not sampled */
} model_speed;

/** Relative error of a row's cycles against the full core, in percent; NaN if it has none. */
double model_speed_error(const model_speed *row);

/** All rows; a rule where scene or kernel change. NULL if out of memory. */
report_table *model_speeds_table(const model_speed *rows, size_t count, const char *caption);

/** By model: median and worst of error and slowdown over all kernels and scenes. NULL if out of memory. */
report_table *model_speeds_summary(const model_speed *rows, size_t count, const char *caption);

/* Series of the plot, by model. */
typedef struct model_speed_series {
    report_series *series;
    size_t count;
    double *numbers;
} model_speed_series;

/** Slowdown and size of the error of the models that have one. Destroy with model_speed_series_destroy. Errors: BASE_ERR_NOMEM. */
base_status model_speed_series_create(const model_speed *rows, size_t count, model_speed_series *out, base_error *err);
void model_speed_series_destroy(model_speed_series *s);

#endif
