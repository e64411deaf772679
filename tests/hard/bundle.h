/* Rays of the test's own choosing through the tracing kernels, one tile at a time.
 *
 * A kernel traces what the job's constants say: ray j of block f is first[f] + delta[j]. Here the constants are
 * overwritten, so that a packet can hold any 16 rays, and a group any 16 frusta of a grid. Directions must be at most
 * BUNDLE_LONGEST long, for which the job's margins are made (kernels/job.c).
 *
 * What a box test or a cull decided is read from the counters: a leaf that is reached adds to tri_accesses, a frustum that
 * is not culled to isect_tests.
 */
#ifndef TESTS_HARD_BUNDLE_H
#define TESTS_HARD_BUNDLE_H

#include "kernels/kernel.h"
#include "tests/kernels/twin.h"

#define BUNDLE_LONGEST 3.0f

typedef struct bundle {
    kernel_job *job;
    lrb_ctx *c;
    kernel_tile_fn *tile;
    const bvh *tree; /* not owned */
    int cull;
} bundle;

/** Make ready to trace one tree with a kernel; free it with bundle_destroy. Any failure fails the running test. */
bundle bundle_create(const char *kernel, const bvh *tree, int cull);
void bundle_destroy(bundle *b);

/** The next packet: 16 rays, of which those in `mask` count; they are block 0 of the tile. For packet16-primary;
    for packet256-primary if all 16 are the same, since it takes the signs of rays from the corners of their block. */
void bundle_rays(bundle *b, const float origin[3], float d[16][3], unsigned mask);

/** The next group: pixel (x, y) of the tile has direction first + x*right + y*down; blocks in `mask` count. */
void bundle_grid(bundle *b, const float origin[3], const float first[3], const float right[3], const float down[3], unsigned mask);

/** Trace; results lie in job->frame_host[0], by block and pixel. Returns the counts of this tile. */
kernel_counts bundle_trace(bundle *b);

/** The direction of pixel j of block f, the bits that are traced. */
void bundle_direction(const bundle *b, unsigned block, unsigned pixel, float out[3]);

/** Nearest hit of one of the bundle's rays by trying all triangles with the same float operations. */
twin_hit bundle_brute_force(const bundle *b, unsigned block, unsigned pixel);

/** Fail the running test, with `what`, unless all rays that count have exactly the hits of bundle_brute_force. */
void bundle_assert_brute_force(const bundle *b, const char *what);

/** A tree that is one leaf; free it with bvh_destroy. */
bvh *bundle_leaf(const scene_triangle *triangles, uint32_t count);

/** A tree of one inner node over two leaves of one triangle each, with boxes as given: box[child][0 min, 1 max]. */
bvh *bundle_pair(const scene_triangle triangles[2], float box[2][2][3]);

/** A tree that is `depth` inner nodes deep, each with a leaf and the rest, all boxes the same: count is depth + 1. */
bvh *bundle_chain(const scene_triangle *triangles, uint32_t depth, float low, float high);

/** The tree with the two children of every inner node exchanged. */
void bundle_swap_children(bvh *tree);

#endif
