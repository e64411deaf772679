/* Where to cut a list of triangles in two: binned surface area heuristic (Wald 2007, "On fast Construction of
 * SAH-based Bounding Volume Hierarchies").
 *
 * The steps are separate functions on pieces of a list, so that a long list can be worked on in parallel: frames
 * and bins of pieces are joined, and the answer does not depend on the pieces. Centroids are those of the boxes,
 * doubled (min + max), all in float; costs are in double.
 */
#ifndef KERNELS_ACCEL_BVH_SPLIT_H
#define KERNELS_ACCEL_BVH_SPLIT_H

#include <stddef.h>
#include <stdint.h>

#include "kernels/accel/box.h"

enum { BVH_MAX_BINS = 64 };

/* A triangle in the lists: its box and, in the box's first unused float, its id (bvh_ref_id). */
typedef accel_box bvh_ref;

/* Bounds of doubled centroids; the fourth floats mean nothing. */
typedef struct bvh_extent {
    float low[4], high[4];
} bvh_extent;

/* Maps a doubled centroid to a bin on each axis: (c - origin) * scale, at most top, rounded down. */
typedef struct bvh_frame {
    float origin[4];
    float scale[4]; /* 0 on an axis that cannot be split */
    float top;      /* number of bins - 1 */
} bvh_frame;

/* What fell into each bin of each axis. */
typedef struct bvh_bins {
    accel_box box[3][BVH_MAX_BINS];
    uint32_t count[3][BVH_MAX_BINS];
} bvh_bins;

typedef struct bvh_split {
    int axis;             /* 0..2, or -1: no bin boundary divides the list, cut it in the middle */
    unsigned bin;         /* last bin of the left side */
    size_t left_count;    /* 1 .. count-1 */
    accel_box left, right;
} bvh_split;

/** Reference to a triangle. */
bvh_ref bvh_ref_create(const scene_triangle *t, uint32_t id);

/** Id of the triangle, below SCENE_MAX_TRIANGLES. */
uint32_t bvh_ref_id(const bvh_ref *ref);

/** Box around all triangles of a list. */
accel_box bvh_refs_box(const bvh_ref *refs, size_t count);

/** Bounds of the doubled centroids of a list. */
bvh_extent bvh_refs_extent(const bvh_ref *refs, size_t count);

/** Make `extent` the bounds around both. */
void bvh_extent_add(bvh_extent *extent, const bvh_extent *other);

/** Frame of `bins` bins over an extent. An axis whose extent is 0, or whose scale overflows, is not split. */
bvh_frame bvh_frame_create(bvh_extent extent, unsigned bins);

/** Sort a list into bins; `out` is overwritten up to the frame's number of bins. */
void bvh_bins_fill(bvh_bins *out, const bvh_frame *frame, const bvh_ref *refs, size_t count);

/** Add the contents of `from` to `into`; both have `bins` bins. */
void bvh_bins_add(bvh_bins *into, const bvh_bins *from, unsigned bins);

/**
 * The boundary between bins with the least cost (area times number of triangles, both sides added); of equal ones
 * the lowest axis, then the lowest bin.
 *
 * @param bins       number of bins, 2..BVH_MAX_BINS
 * @param most       largest number of triangles allowed on either side
 */
bvh_split bvh_bins_split(const bvh_bins *b, unsigned bins, size_t most);

/** Number of a list's triangles on the left of a split, from the list's bins; split->axis is not -1. */
size_t bvh_bins_left_count(const bvh_bins *b, const bvh_split *split);

/**
 * Copy a list into the two sides of a split; each keeps the list's order.
 *
 * @param to           array that receives the triangles, not overlapping refs
 * @param left, right  first entries of `to` for the two sides; neither side runs into the other
 */
void bvh_refs_divide(const bvh_ref *restrict refs, size_t count, const bvh_frame *frame, const bvh_split *split,
                     bvh_ref *restrict to, size_t left, size_t right);

#endif
