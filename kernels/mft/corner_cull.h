/* Corner-ray culling: which of 16 frusta with one origin can a triangle's hits lie in? docs/kernels.md.
 *
 * A ray hits only if its signed volumes over the three edges have one sign. A volume is linear in the direction, so if
 * it has the wrong strict sign at the four corner rays of a frustum, it has it for every ray between them. The
 * volumes are formed from the same edge planes, by the same three operations, as in the intersection test, so all
 * that has to be allowed for is the rounding of those operations and of the rays themselves:
 *
 *   3 roundings of a dot product, at the corner and at the ray         2 * 3 u
 *   a ray is corner + delta, each rounded, not exactly between corners      4 u
 *
 * together 10 u |edge|_1 |direction|_inf with u = 2^-24; the guard takes 16. A hit that the intersection test
 * would find is never culled.
 */
#ifndef KERNELS_MFT_CORNER_CULL_H
#define KERNELS_MFT_CORNER_CULL_H

#include "kernels/triangle16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_CORNER_CULL

/* Directions of corner ray k of the 16 frusta in scratch, lane = frustum; 12 vectors are too many to keep in registers. */
LRB_INLINE lrb_mem corner_cull_ray(lrb_ptr scratch, int k, int axis)
{
    return lrb_at(scratch, k == 0 ? SCRATCH_CORNERS + 64 * axis : SCRATCH_OTHER_CORNERS + 192 * (k - 1) + 64 * axis);
}

/* Leave the rounding bound of each edge plane in scratch, in all words of the edge's group. */
LRB_INLINE void corner_cull_guard(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, lrb_v16f zero, lrb_v16f edges, bool cull)
{
    lrb_v16i magnitude = lrb_and_pi_s3(c, lrb_castps_pi(edges), lrb_full_pi(RAYS16_CONSTANT(constants, absolute)));
    lrb_v16f guard = triangle16_group_sum(c, lrb_castpi_ps(magnitude));
    guard = lrb_mul_ps_s3(c, guard, lrb_1to16_ps(RAYS16_CONSTANT(constants, guard)));
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_GUARD), guard);
    if (!cull)
        lrb_store_ps(c, lrb_at(scratch, SCRATCH_MINUS_GUARD), lrb_sub_ps(c, zero, guard));
}

/* Smallest and largest volume over the edge at planes + edge among the four corner rays: triangle16_edge with the factors exchanged, for
   the four side by side, so that none waits for its own last product. */
LRB_INLINE void corner_cull_range(lrb_ctx *c, lrb_ptr scratch, lrb_ptr planes, int edge, bool cull, lrb_v16f *smallest, lrb_v16f *largest)
{
    lrb_v16f plane[3], volume[4];
    for (int axis = 0; axis < 3; axis++)
        plane[axis] = lrb_load_1to16_ps(c, lrb_at(planes, edge + triangle16_component[axis]));
    for (int k = 0; k < 4; k++)
        volume[k] = lrb_mul_ps_s3(c, plane[0], lrb_full_ps(corner_cull_ray(scratch, k, 0)));
    for (int axis = 1; axis < 3; axis++)
        for (int k = 0; k < 4; k++)
            volume[k] = lrb_madd231_ps_s3(c, volume[k], plane[axis], lrb_full_ps(corner_cull_ray(scratch, k, axis)));
    lrb_v16f half = lrb_min_ps(c, volume[0], volume[1]);
    lrb_v16f other = lrb_min_ps(c, volume[2], volume[3]);
    *smallest = lrb_min_ps(c, half, other);
    *largest = *smallest;
    if (!cull) {
        half = lrb_max_ps(c, volume[0], volume[1]);
        other = lrb_max_ps(c, volume[2], volume[3]);
        *largest = lrb_max_ps(c, half, other);
    }
}

/**
 * The frusta of m, whose corner rays are in scratch, that may hold a hit of the triangle which triangle16_setup left there.
 *
 * @param edges  the edge planes that it returned
 * @param cull   1: front hits only, all volumes negative; 0: or all positive
 *
 * Returns early, with no lanes, after the first edge that leaves none.
 */
LRB_INLINE lrb_k16 corner_cull(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, lrb_v16f zero, lrb_v16f edges, bool cull, lrb_k16 m)
{
    static const int edge_planes[3] = {TRIANGLE16_EDGE_A, TRIANGLE16_EDGE_B, TRIANGLE16_EDGE_C};
    lrb_k16 front = m, back = m;
    corner_cull_guard(c, constants, scratch, zero, edges, cull);
    for (int i = 0; i < 3; i++) {
        lrb_v16f smallest, largest;
        int group = edge_planes[i] - SCRATCH_EDGES;
        corner_cull_range(c, scratch, scratch, edge_planes[i], cull, &smallest, &largest);
        front = lrb_mask_cmple_ps_s3(c, front, smallest, lrb_1to16_ps(lrb_at(scratch, SCRATCH_GUARD + group)));
        if (!cull)
            back = lrb_mask_cmpnlt_ps_s3(c, back, largest, lrb_1to16_ps(lrb_at(scratch, SCRATCH_MINUS_GUARD + group)));
        if (lrb_jz(c, lrb_kortest(c, front, cull ? front : back)))
            return lrb_mask(0);
    }
    return cull ? front : lrb_kor(c, front, back);
}

#endif
