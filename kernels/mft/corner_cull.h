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

/* Directions of the four corner rays of 16 frusta, lane = frustum. */
typedef struct corner_rays {
    lrb_v16f d[4][3];
} corner_rays;

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

/* Smallest and largest volume over one edge among the four corner rays. */
LRB_INLINE void corner_cull_range(lrb_ctx *c, lrb_ptr scratch, int edge, const corner_rays *corners, bool cull, lrb_v16f *smallest,
                                  lrb_v16f *largest)
{
    lrb_v16f volume[4];
    for (int k = 0; k < 4; k++)
        volume[k] = triangle16_edge(c, scratch, edge, corners->d[k]);
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
 * The frusta of m that may hold a hit of the triangle which triangle16_setup left in scratch.
 *
 * @param edges  the edge planes that it returned
 * @param cull   1: front hits only, all volumes negative; 0: or all positive
 *
 * Returns early, with no lanes, after the first edge that leaves none.
 */
LRB_INLINE lrb_k16 corner_cull(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, lrb_v16f zero, const corner_rays *corners,
                               lrb_v16f edges, bool cull, lrb_k16 m)
{
    static const int edge_planes[3] = {TRIANGLE16_EDGE_A, TRIANGLE16_EDGE_B, TRIANGLE16_EDGE_C};
    lrb_k16 front = m, back = m;
    corner_cull_guard(c, constants, scratch, zero, edges, cull);
    for (int i = 0; i < 3; i++) {
        lrb_v16f smallest, largest;
        int group = edge_planes[i] - SCRATCH_EDGES;
        corner_cull_range(c, scratch, edge_planes[i], corners, cull, &smallest, &largest);
        front = lrb_mask_cmple_ps_s3(c, front, smallest, lrb_1to16_ps(lrb_at(scratch, SCRATCH_GUARD + group)));
        if (!cull)
            back = lrb_mask_cmpnlt_ps_s3(c, back, largest, lrb_1to16_ps(lrb_at(scratch, SCRATCH_MINUS_GUARD + group)));
        if (lrb_jz(c, lrb_kortest(c, front, cull ? front : back)))
            return lrb_mask(0);
    }
    return cull ? front : lrb_kor(c, front, back);
}

#endif
