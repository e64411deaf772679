/* Runs a kernel over a whole picture, for tests: per-pixel results row by row, counts, ops, and a hash of the events. */
#ifndef TESTS_KERNELS_TRACE_H
#define TESTS_KERNELS_TRACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/kernel.h"
#include "tests/oracles/ray.h"

typedef struct trace_picture {
    unsigned width, height;
    bool soft;       /* of a kernel with soft shadows */
    size_t pixels;   /* width * height */
    uint32_t *id;    /* pixels each, row by row from the top left; owned */
    float *t, *u, *v;
    uint32_t *occlusion; /* of kernels that trace shadows, else 0: bits of the last set of samples (of mft-msaa a hash of a pixel's samples)... */
    float *visibility;   /* ...and what is seen of the light */
    float *filtered, *lit; /* of soft shadows, else 0: visibility as the filter leaves it, and times the shading; lit: or of a shader */
    size_t tiles;               /* that were traced: units of work, then those of a second pass */
    kernel_counts *tile_counts; /* by tile; owned */
    kernel_counts counts;       /* their sum */
    uint64_t ops[LRB_OP_COUNT]; /* COUNT: the context's histogram; RECORD: that of the events; NATIVE: 0 */
    uint64_t idle_lanes;        /* likewise */
    uint64_t events;            /* RECORD: their number ... */
    uint64_t events_hash;       /* ... and a hash of their bytes, tile after tile */
} trace_picture;

/* What to trace; the caller owns what is pointed to. */
typedef struct trace_request {
    const char *kernel; /* name in the registry */
    const bvh *tree;       /* of kernels that traverse one, or ... */
    const kdtree *kdtree;  /* ... of those that traverse this */
    const scene_camera *camera;
    unsigned width, height;
    unsigned cull; /* parameter cull_backface */
    const kernel_params *params; /* the others; NULL: the kernel's defaults */
    const scene_light *light;    /* of kernels that trace shadows */
    int level;     /* LRB_NATIVE, LRB_COUNT or LRB_RECORD */
    unsigned jobs; /* host threads, at least 1; the result does not depend on it */
} trace_request;

/** Trace all tiles; free the result with trace_free. Any failure fails the running test. */
trace_picture trace_run(const trace_request *request);

/** A picture of zeros; free it with trace_free. Running out of memory fails the running test. */
trace_picture trace_picture_create(unsigned width, unsigned height);

/** Free what a picture holds. */
void trace_free(trace_picture *picture);

/** The tree with a leaf limit; free it with bvh_destroy. Any failure fails the running test. */
bvh *trace_tree(const scene *s, unsigned max_leaf);

/** The kd-tree of a scene with a kernel's default parameters, its occluders marked for the camera and rays
    that do not see back faces; free it with kdtree_destroy. */
kdtree *trace_kdtree(const scene *s, const scene_camera *camera);

/* The tree that a kernel traverses; the other is NULL. */
typedef struct trace_trees {
    bvh *tree;
    kdtree *kdtree;
} trace_trees;

/** A kernel's tree with its default parameters; free it with trace_trees_destroy. Any failure fails the running test. */
trace_trees trace_trees_of(const kernel_info *kernel, const scene *s, const scene_camera *camera);

void trace_trees_destroy(trace_trees *trees);

/** A job of the kernel on the tree it traverses, as trace_run makes it; free it with kernel_job_destroy. */
kernel_job *trace_job(const trace_request *request);

/** The primary rays of a picture, the bits that kernels trace: width * height of them, row by row. */
void trace_rays(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, oracle_ray *rays);

/**
 * A picture's shadow rays of one pass, the bits that kernels trace: 16 a pixel, row by row.
 *
 * @param request  what was traced
 * @param rays     out, 16 * width * height; those of a pixel that traces none are 0
 * @param taken    out, width * height: the samples that are traced, as bits
 */
void trace_shadow_rays(const trace_request *request, const trace_picture *picture, unsigned pass, oracle_ray *rays, uint32_t *taken);

/** One pixel's result as the oracles give theirs. */
oracle_hit trace_hit(const trace_picture *picture, size_t pixel);

/* Where two pictures differ in the bits of id, t, u, v, occlusion or visibility. */
typedef struct trace_difference {
    size_t count, first; /* pixels that differ, and the first of them (SIZE_MAX: none) */
} trace_difference;

/** Compare two pictures of one size. */
trace_difference trace_compare(const trace_picture *a, const trace_picture *b);

/** Compare, and fail the running test with `what` and the first pixel's values if they differ. */
void trace_assert_equal(const trace_picture *a, const trace_picture *b, const char *what);

/** Hash of all of a picture's results. */
uint64_t trace_hash(const trace_picture *picture);

#endif
