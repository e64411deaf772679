/* Tracing of one group of primary rays, as Benthin and Wald 2009 do it (docs/kernels.md): what the kernels of multi-frusta
 * tracing share.
 *
 * A group is 16 frusta of 4x4 rays, one lane a frustum. Boxes and triangles are tested against the frusta; rays are made
 * only for the frusta that a triangle survives in. Nearest hits of the 256 rays live in the frame; a frustum's limit is the
 * farthest of its 16 rays' limits: their hits, or a little more for those who ask for it; infinite until all have hit.
 */
#ifndef KERNELS_MFT_GROUP_PRIMARY_H
#define KERNELS_MFT_GROUP_PRIMARY_H

#include "kernels/mft/corner_cull.h"
#include "kernels/mft/mft_frusta.h"
#include "kernels/traversal16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT

/* The rays of frustum f against the triangle in scratch; true if one of them has a nearer hit now. */
LRB_INLINE bool mft_intersect(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_r64 f)
{
    lrb_v16f d[3];
    lrb_ptr corner = lrb_lea(c, g->scratch, f, 4, g->first);
    lrb_ptr hit = lrb_lea(c, g->frame, lrb_shl(c, f, 6), 1, 0);
    lrb_mem best_t = lrb_at(hit, (int32_t)offsetof(job_frame_tile, t));
    lrb_mem best_id = lrb_at(hit, (int32_t)offsetof(job_frame_tile, id));
    for (int axis = 0; axis < 3; axis++)
        d[axis] = lrb_add_ps_s3(c, g->delta[axis], lrb_1to16_ps(lrb_at(corner, 64 * axis)));
    g->n->n[KERNEL_isect_tests]++;
    lrb_v16f old_t = lrb_load_ps(c, best_t);
    lrb_v16i old_id = lrb_load_pi(c, best_id);
    triangle16_hits hits = triangle16_intersect(c, g->constants, g->scratch, g->origin, record, g->cull, lrb_mask(0xffff), d,
                                                s->zero, old_t, old_id);
    if (!hits.m.bits) /* the branch is triangle16_intersect's own */
        return false;
    lrb_mask_store_ps(c, best_t, hits.m, hits.t);
    lrb_mask_store_ps(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, u)), hits.m, hits.u);
    lrb_mask_store_ps(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, v)), hits.m, hits.v);
    lrb_mask_store_pi(c, best_id, hits.m, lrb_load_1to16_pi(c, lrb_at(record, (int32_t)offsetof(bvh_triangle, id))));
    if (g->nearer)
        g->nearer(c, g, record, f, d, hits.m);
    return true;
}

/* One triangle against the frusta of m; returns `updated` with the bits set of those that have new hits. */
LRB_INLINE lrb_r64 mft_triangle(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_k16 m, lrb_r64 updated)
{
    lrb_v16f edges;
    g->n->n[KERNEL_tri_accesses]++;
    lrb_phase(c, KERNEL_PHASE_CULLING);
    if (!triangle16_setup(c, g->scratch, g->origin, record, g->cull, &edges))
        return updated;
    lrb_k16 survivors = corner_cull(c, g->constants, g->scratch, s->zero, edges, g->cull, m);
    if (!survivors.bits) /* the branch is corner_cull's own */
        return updated;
    g->n->n[KERNEL_tri_after_culling]++;
    if (g->survivor)
        g->survivor(c, s, g, record, edges, survivors);
    lrb_phase(c, KERNEL_PHASE_INTERSECTION);
    lrb_r64 bits = lrb_kmov_rk(c, survivors);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        lrb_region(c, g->blocks ? (uint32_t)f.value : LRB_WHOLE_TILE);
        if (mft_intersect(c, s, g, record, f))
            updated = lrb_bts(c, updated, f);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    lrb_region(c, LRB_WHOLE_TILE);
    return updated;
}

/* The limit of every updated frustum becomes the farthest of its rays'. */
LRB_INLINE void mft_update_limits(lrb_ctx *c, slab16 *s, const mft_group *g, lrb_r64 updated)
{
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), updated);
    while (!lrb_jl(c, lrb_test(c, f, f))) {
        lrb_ptr limits = lrb_lea(c, g->limits, lrb_shl(c, f, 6), 1, 0);
        lrb_v16f t = lrb_load_ps(c, lrb_at(limits, 0));
        t = lrb_max_ps_s3(c, t, lrb_swizzle_ps(t, LRB_CDAB));
        t = lrb_max_ps_s3(c, t, lrb_swizzle_ps(t, LRB_BADC));
        t = lrb_max_ps(c, t, lrb_shuf128x32_ps(c, t, 0xb1, LRB_DCBA));
        t = lrb_max_ps(c, t, lrb_shuf128x32_ps(c, t, 0x4e, LRB_DCBA));
        s->limit = lrb_mask_mov_ps(c, s->limit, lrb_kmov_kr(c, lrb_bts(c, lrb_imm(0), f)), t);
        f = lrb_bsfi(c, f, updated);
    }
}

LRB_INLINE void mft_leaf(lrb_ctx *c, slab16 *s, void *user, lrb_ptr box, lrb_ptr record, lrb_ptr end, lrb_k16 m)
{
    const mft_group *g = user;
    lrb_r64 updated = lrb_imm(0);
    (void)box;
    do {
        updated = mft_triangle(c, s, g, record, m, updated);
        record = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)sizeof(bvh_triangle));
    } while (lrb_jb(c, lrb_cmp_ptr(c, record, end)));
    mft_update_limits(c, s, g, updated);
}

/* Corner rays and direction intervals of 16 frusta, and the deltas of their rays. A frustum's corners are its extreme rays, or others
   that enclose them: the first of each frustum, and, with deltas[axis][ray] numbered as rays,
   the three others. */
LRB_INLINE void mft_corners(lrb_ctx *c, mft_group *g, const lrb_v16f first[3], lrb_ptr deltas, lrb_v16f lo[3], lrb_v16f hi[3])
{
    static const int ray[4] = {0, 3, 15, 12};
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f corner[4] = {first[axis]};
        lrb_store_ps(c, corner_cull_ray(g->scratch, 0, axis), corner[0]);
        for (int k = 1; k < 4; k++) {
            corner[k] = lrb_add_ps_s3(c, corner[0], lrb_1to16_ps(lrb_at(deltas, 64 * axis + 4 * ray[k])));
            lrb_store_ps(c, corner_cull_ray(g->scratch, k, axis), corner[k]);
        }
        lrb_v16f half = lrb_min_ps(c, corner[0], corner[1]);
        lrb_v16f other = lrb_min_ps(c, corner[2], corner[3]);
        lo[axis] = lrb_min_ps(c, half, other);
        half = lrb_max_ps(c, corner[0], corner[1]);
        other = lrb_max_ps(c, corner[2], corner[3]);
        hi[axis] = lrb_max_ps(c, half, other);
        g->delta[axis] = lrb_load_ps(c, RAYS16_CONSTANT(g->constants, delta[axis]));
    }
}

/* No hits yet: t is infinite for the pixels of the image, -infinity for the others, which so never count as nearest. */
LRB_INLINE void mft_clear_frame(lrb_ctx *c, const mft_group *g, const slab16 *s, lrb_ptr tile)
{
    lrb_v16f no_pixel = lrb_load_ps(c, RAYS16_CONSTANT(g->constants, no_pixel));
    lrb_v16i no_hit = lrb_load_1to16_pi(c, RAYS16_CONSTANT(g->constants, no_hit));
    lrb_ptr hit = lrb_lea(c, g->frame, lrb_imm(0), 1, 0);
    lrb_ptr end = lrb_lea(c, g->frame, lrb_imm(0), 1, (int32_t)sizeof(job_frame_tile) / 4);
    lrb_ptr pixels = lrb_lea(c, tile, lrb_imm(0), 1, (int32_t)offsetof(job_tile, pixels));
    do {
        lrb_k16 k = lrb_kmov_kr(c, lrb_load16(c, lrb_at(pixels, 0)));
        lrb_store_ps(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, t)), lrb_mask_mov_ps(c, no_pixel, k, s->infinity));
        lrb_store_ps(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, u)), s->zero);
        lrb_store_ps(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, v)), s->zero);
        lrb_store_pi(c, lrb_at(hit, (int32_t)offsetof(job_frame_tile, id)), no_hit);
        g->n->n[KERNEL_rays] += (unsigned)__builtin_popcount(k.bits);
        g->n->n[KERNEL_rays_primary] += (unsigned)__builtin_popcount(k.bits);
        pixels = lrb_lea(c, pixels, lrb_imm(0), 1, 2);
        hit = lrb_lea(c, hit, lrb_imm(0), 1, 64);
    } while (lrb_jb(c, lrb_cmp_ptr(c, hit, end)));
}

#endif
