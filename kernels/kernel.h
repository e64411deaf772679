/* What a kernel is: a function from a tile number to pixels, counters and events, with a name and parameters.
 *
 * A kernel's source is compiled once per level (lrbni/ctx.h); its descriptor in registry.c holds the functions.
 * Tiles are independent: any order, any host thread, the same results. Those of a second pass (kernel_job_first_pass) come after
 * all of the first.
 */
#ifndef KERNELS_KERNEL_H
#define KERNELS_KERNEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/counters.h"
#include "kernels/job.h"
#include "lrbni/ctx.h"

/* Trace one tile: its pixels go to the job's frame, its counts are added to *n, its ops to the context. */
typedef void kernel_tile_fn(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n);

/* What a kernel traverses. */
typedef enum kernel_accel { KERNEL_ACCEL_BVH, KERNEL_ACCEL_KDTREE } kernel_accel;

typedef struct kernel_info {
    const char *name;
    const char *summary;       /* a line for `lanetrace kernels` */
    const char *paper;         /* section that it follows */
    kernel_params defaults;
    kernel_accel accel;
    uint64_t counters;         /* bit i: counter i is reported */
    uint64_t params;           /* bit i: kernel_param i is taken */
    uint64_t phases;           /* bit i: kernel_phase i is part of it, whatever its parameters are */
    kernel_tile_fn *tile[LRB_LEVELS]; /* by level */
    kernel_tile_fn *annotated; /* LRB_RECORD, with more markers (lrbni/annotate.h) */
} kernel_info;

/** All kernels; *count entries. */
const kernel_info *kernel_list(size_t *count);

/** The kernel of that name, or NULL. */
const kernel_info *kernel_find(const char *name);

/* Phases of the tracing kernels, the numbers of their phase events. */
typedef enum kernel_phase {
    KERNEL_PHASE_SETUP,        /* rays and intervals of a packet or group */
    KERNEL_PHASE_TRAVERSAL,    /* box tests, stack */
    KERNEL_PHASE_CULLING,      /* triangles against frusta, back faces */
    KERNEL_PHASE_INTERSECTION, /* triangles against rays, hit records */
    KERNEL_PHASE_SHADING,      /* hit points, what light they could see and how much of it they do, and what it lends them */
    KERNEL_PHASE_ENTRY,        /* entry-point search for a tile */
    KERNEL_PHASE_FILTER,       /* means of visibility over neighbouring pixels */
    KERNEL_PHASE_SILHOUETTES,  /* which pixels edges of silhouettes cross */
    KERNEL_PHASE_COUNT
} kernel_phase;

/** "setup", "traversal" and so on. */
extern const char *const kernel_phase_names[KERNEL_PHASE_COUNT];

/** Whether a phase is to be reported: it is a part of the kernel, or a parameter brought it in, so it has taken something. */
static inline bool kernel_has_phase(const kernel_info *kernel, int phase, uint64_t taken)
{
    return (kernel->phases >> phase & 1) || taken > 0;
}

/* Numbers of the source files, for branches and lines in events (LRB_SOURCE; kernels/sources.h has the files). */
enum { KERNEL_SOURCE_SLAB = 1, KERNEL_SOURCE_TRAVERSAL, KERNEL_SOURCE_TRIANGLE, KERNEL_SOURCE_CORNER_CULL, KERNEL_SOURCE_PACKET16, KERNEL_SOURCE_MFT,
       KERNEL_SOURCE_RAYS, KERNEL_SOURCE_SHADOW, KERNEL_SOURCE_PACKET16_SOFT,
       KERNEL_SOURCE_LANE_CULL, KERNEL_SOURCE_MFT_SHRINK, KERNEL_SOURCE_MFT_SOFT,
       KERNEL_SOURCE_KD16, KERNEL_SOURCE_KD16_TILE, KERNEL_SOURCE_KD16_PRIMARY, KERNEL_SOURCE_TILE_BOUNDS, KERNEL_SOURCE_ENTRY_SEARCH,
       KERNEL_SOURCE_ENTRY_END, KERNEL_SOURCE_ENTRY_CULL, KERNEL_SOURCE_MLRTA_PRIMARY, KERNEL_SOURCE_HARD_SHADOW,
       KERNEL_SOURCE_KD16_SHADOW, KERNEL_SOURCE_HIT_BOUNDS, KERNEL_SOURCE_MLRTA_SHADOW, KERNEL_SOURCE_FILTER,
       KERNEL_SOURCE_PACKETS256, KERNEL_SOURCE_SILHOUETTES, KERNEL_SOURCE_MFT_MSAA, KERNEL_SOURCE_FRAME, KERNEL_SOURCE_SHADE, KERNEL_SOURCE_END };

/* The name of a tile function at the level that is being compiled: mft_primary_count. */
#if defined(LRB_LEVEL) && LRB_LEVEL == 0
#define KERNEL_TILE_FN(name) name##_native
#elif defined(LRB_LEVEL) && LRB_LEVEL == 1
#define KERNEL_TILE_FN(name) name##_count
#elif defined(LRB_LEVEL) && LRB_LEVEL == 3
#define KERNEL_TILE_FN(name) name##_touch
#elif defined(LRB_ANNOTATED)
#define KERNEL_TILE_FN(name) name##_annotated
#elif defined(LRB_LEVEL) && LRB_LEVEL == 2
#define KERNEL_TILE_FN(name) name##_record
#endif

#endif
