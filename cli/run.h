/* One kernel over one scene on one model: what run-kernel, report and regress all do. */
#ifndef CLI_RUN_H
#define CLI_RUN_H

#include <stdbool.h>
#include <stddef.h>

#include "kernels/kernel.h"
#include "reports/accounts.h"
#include "scene/scene.h"
#include "sim/bounds.h"
#include "sim/core.h"
#include "sim/issue.h"
#include "sim/machine.h"
#include "sim/registers.h"

/* How much of the machine is modelled; each a stated simplification of the next (docs/machine-model.md). */
typedef enum run_model { RUN_NATIVE, RUN_COUNT, RUN_ISSUE, RUN_CORE, RUN_MODELS } run_model;

/** "native", "count", "issue", "core". */
extern const char *const run_model_names[RUN_MODELS];

/** The model of that name. Errors: BASE_ERR_USAGE, with the names there are. */
base_status run_model_find(const char *name, run_model *out, base_error *err);

typedef struct run_options {
    const kernel_info *kernel;
    kernel_params params;
    const char *camera; /* NULL: the first */
    unsigned width, height;
    run_model model;
    double error;          /* RUN_CORE: relative half-width of the 95% interval of the cycles that is good enough; 0: all tiles */
    uint64_t seed;         /* of the choice of tiles */
    unsigned jobs;
    bool keep_tile_counts; /* fill tile_counts of the result */
    bool progress;         /* a bar on stderr */
    const char *trace;     /* file to record the events to, or NULL */
    const char *cache;     /* folder that keeps kd-trees (kernels/accel/kdtree_file.h), or NULL */
    bool profile, registers; /* fill these of the result: the annotated kernel, which must be there, is run. RUN_ISSUE and RUN_CORE, without a trace */
} run_options;

/* How well a sampled run knows its cycles. */
typedef struct run_estimate {
    double half_width_95; /* relative; 0: exact */
    size_t tiles_simulated, tiles; /* 0, 0: not sampled */
} run_estimate;

/* Everything that a run has found, or a replay of its trace. Owns all but the scene and the machine. */
typedef struct run_result {
    run_options options;
    const char *scene_name;
    size_t triangle_count;
    const struct json_t *traced; /* of a replay: what the trace says was run; belongs to the caller. NULL: a run */
    const scene *scene;          /* this and the next four: of a run only */
    const scene_camera *camera;
    bvh *tree;       /* one of the two, what the kernel traverses */
    kdtree *kdtree;
    kernel_job *job; /* with the frame: nearest hits by pixel */
    const sim_machine *machine;
    kernel_counts counts;
    uint64_t ops[LRB_OP_COUNT]; /* all models but RUN_NATIVE */
    uint64_t memory_operands, idle_lanes;
    sim_issue_stats issue; /* RUN_ISSUE */
    sim_core_stats core;   /* RUN_CORE: summed over the simulated cores */
    sim_chains chains;     /* RUN_CORE: of the tiles */
    run_estimate estimate; /* RUN_CORE with options.error above 0: cycles and core are estimates */
    uint64_t cycles;       /* all models but RUN_NATIVE; RUN_CORE: of the slowest core */
    double *region_cycles; /* all models but RUN_NATIVE: by tile, SIM_MAX_REGIONS + 1 each: blocks, then the whole tile */
    kernel_counts *tile_counts; /* by tile, or NULL */
    sim_profile *profile;  /* options.profile */
    sim_registers_stats registers; /* options.registers */
    double build_seconds, kernel_seconds;
    double processor_seconds; /* of all host threads, in the same time as kernel_seconds; 0: a replay */
} run_result;

/**
 * Build the tree, lay out the job, trace all tiles on options->jobs host threads.
 *
 * @param s, machine  owned by the caller; must outlive the result
 * @param out         destroy with run_result_destroy, also after a failure
 *
 * Errors: those of bvh_build and kdtree_build, kernel_job_create, scene_find_camera and of the trace's writer; BASE_ERR_NOMEM.
 */
base_status run_kernel(const scene *s, const sim_machine *machine, const run_options *options, run_result *out, base_error *err);

/** What follows from the sums over the tiles: cycles from `ops` (RUN_COUNT), or all of them from `issue` (RUN_ISSUE). */
void run_finish_cycles(run_result *result);

/** Free what a result owns. */
void run_result_destroy(run_result *result);

/** Simulated cycles of image pixel (x, y): its share of its block's and its tile's, in all passes. All models but RUN_NATIVE. */
double run_pixel_cycles(const run_result *result, unsigned x, unsigned y);

/** A counter's value for pixel (x, y): its tile's, divided by the pixels of the tile. Needs keep_tile_counts. */
double run_pixel_count(const run_result *result, kernel_counter counter, unsigned x, unsigned y);

/** Totals over the ops of a run. */
report_op_totals run_totals(const run_result *result);

#endif
