/* A binary bounding volume hierarchy in the layout that the 16-lane kernels read: two boxes to a 64-byte line.
 *
 * The layout is Benthin and Wald 2009, appendix A: siblings lie side by side, so one 16-float load fetches both
 * boxes; the second box starts at float 8 and a box's max lies 4 floats behind its min. Built on the host, binned
 * surface area heuristic (Wald 2007), not charged to the simulated machine.
 */
#ifndef KERNELS_ACCEL_BVH_H
#define KERNELS_ACCEL_BVH_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "scene/scene.h"

/* 32 bytes. Links are byte offsets, so a kernel adds them to a base register as they are. */
typedef struct bvh_node {
    float min[3];
    uint32_t link; /* inner: offset in `nodes` of the pair of children, a multiple of 64; leaf: offset in `records` */
    float max[3];
    uint32_t count; /* inner: 0; leaf: number of consecutive triangle records, at least 1 */
} bvh_node;

/* 64 bytes, one line: three vertices and the normal in 4-float groups, so that one load, less the origin three times,
   translates the triangle. A group's fourth float is not geometry. */
typedef struct bvh_triangle {
    float v0[3];
    uint32_t id; /* of the triangle in the scene */
    float v1[3];
    uint32_t zero1;
    float v2[3];
    uint32_t zero2;
    float normal[3]; /* (v1-v0) x (v2-v0) in double, divided by its largest magnitude, rounded */
    uint32_t zero3;
} bvh_triangle;

typedef struct bvh_options {
    unsigned max_leaf;     /* largest number of triangles in a leaf; 1..64; a node within the limit becomes a leaf */
    unsigned bins;         /* bins per axis; 2..64 */
    float traversal_cost;  /* of an inner node, at least 0; the unit is that of ... */
    float intersect_cost;  /* ... a triangle test, above 0; both enter sah_cost only: no split depends on them */
    unsigned jobs;         /* host threads, at least 1; the tree does not depend on it */
} bvh_options;

typedef struct bvh {
    bvh_node *nodes; /* 64-byte aligned; nodes[0] is the root, nodes[1] its unused neighbour (zero), then pairs */
    size_t node_count; /* entries of nodes, always even */
    bvh_triangle *records; /* 64-byte aligned; in the order of the leaves */
    size_t record_count;
    size_t inner_count, leaf_count;
    size_t degenerate_count; /* triangles left out: normal zero or not finite, computed in double */
    unsigned depth;          /* edges from the root to the deepest leaf */
    double sah_cost;         /* expected cost of a random ray that meets the root box, in triangle tests */
} bvh;

/* Deepest tree that is ever built: bounds the traversal stacks of the kernels. */
#define BVH_MAX_DEPTH 64

/** Defaults: max_leaf 4, 16 bins, both costs 1, one job. */
bvh_options bvh_options_default(void);

/**
 * Build the tree of a scene.
 *
 * A leaf is made as soon as the count is within max_leaf. A larger node is split at the bin boundary
 * of least cost (of equal ones at the lowest axis, then the lowest bin) of those that leave no more on either side
 * than the levels up to BVH_MAX_DEPTH can hold; where there is none (equal centroids) its list is cut in the middle.
 * Triangles whose normal is zero are left out and counted (kernels/accel/box.h). Boxes are exact unions of float
 * vertices, -0 counting as +0. Pairs lie in depth-first order, left before right, and so do records; within a leaf
 * ids ascend. Equal input gives equal bytes on every host, with any number of jobs. At work it takes up to 256 bytes
 * for each triangle, the tree included, and a little more.
 *
 * @param out  owned by the caller: free with bvh_destroy; a scene of degenerate triangles alone gives a tree whose
 *             root is a leaf with an empty box (min +inf, max -inf) and count 0
 *
 * Errors: BASE_ERR_USAGE naming the option that is out of range, BASE_ERR_INPUT naming a scene of more than
 * SCENE_MAX_TRIANGLES triangles, BASE_ERR_NOMEM.
 */
base_status bvh_build(const scene *s, const bvh_options *options, bvh **out, base_error *err);

/** The record of a triangle that is not degenerate (kernels/accel/box.h). */
bvh_triangle bvh_triangle_create(const scene_triangle *t, uint32_t id);

/** Free a tree; sets the pointer to NULL. */
void bvh_destroy(bvh **tree);

#endif
