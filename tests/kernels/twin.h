/* Plain scalar twins of the tracing kernels: the same float operations written out one ray at a time, no lanes, no ops.
 *
 * twin_brute_force tries every triangle for every ray: what the kernels must find, whatever their traversal and culling
 * leave out (oracle O3). twin_trace traverses a tree as packets, frusta or groups of packets and counts by the definitions of
 * algorithms A.3.
 */
#ifndef TESTS_KERNELS_TWIN_H
#define TESTS_KERNELS_TWIN_H

#include "kernels/job.h"
#include "kernels/counters.h"
#include "tests/kernels/trace.h"

/* A triangle relative to a ray origin. */
typedef struct twin_triangle {
    float corner[3][3];
    float edge[3][3]; /* plane through the origin and the edge opposite vertex i */
    float normal[3], plane;
    float lo[3], hi[3]; /* bounds */
    float reach;        /* a hit may lie this much times t outside the bounds */
    uint32_t id;
} twin_triangle;

/* Nearest hit of one ray so far. */
typedef struct twin_hit {
    uint32_t id;
    float t, u, v;
} twin_hit;

/** No hit: id JOB_NO_HIT, t infinite, u and v 0. */
twin_hit twin_hit_none(void);

/** a.b as the kernels form it: a product and two fused multiply-adds, x to z. */
float twin_dot(const float a[3], const float b[3]);

/** @param reach  half the widening of directions in box tests, of the job's constants */
twin_triangle twin_triangle_of(const bvh_triangle *record, const float origin[3], float reach);

/** Intersect one ray; true if `best` became nearer. */
int twin_intersect(const twin_triangle *triangle, int cull, const float direction[3], twin_hit *best);

/** Nearest hits of all pixels by trying all of the tree's triangle records; free with trace_free. */
trace_picture twin_brute_force(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, int cull);

typedef enum twin_kind { TWIN_PACKETS, TWIN_FRUSTA, TWIN_GROUPS } twin_kind;

/** The picture and counts of packet16-primary, mft-primary or packet256-primary; free with trace_free. */
trace_picture twin_trace(twin_kind kind, const bvh *tree, const scene_camera *camera, unsigned width, unsigned height, int cull);

#endif
