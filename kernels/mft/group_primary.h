/* A tile's primary rays as one group, Benthin and Wald 2009, 4, 5.2 and appendix A (docs/kernels.md).
 *
 * A lane is a block of 4x4 rays. In multi-frusta tracing it is their frustum, and boxes are tested against the frusta; a frustum's
 * limit is the farthest of its 16 rays' hits, infinite until all have hit. With 256-ray packets boxes are tested against the rays,
 * and a lane is the packet of those that may hit. Triangles are tested against the frusta either way, and in the traversal's leaves
 * rays are made only for the lanes that a triangle survives in. Nearest hits of the 256 rays live in the frame.
 *
 * A kernel may look on (kernels/mft/mft_frusta.h): be told of triangles that culling leaves and of nearer hits, keep limits of its
 * own, have corner rays that enclose a frustum's rays with room to spare, and frusta that are no blocks of the tile. It costs the
 * others nothing: what they leave out is known when they are compiled.
 */
#ifndef KERNELS_MFT_GROUP_PRIMARY_H
#define KERNELS_MFT_GROUP_PRIMARY_H

#include "kernels/frame16.h"
#include "kernels/mft/corner_cull.h"
#include "kernels/mft/mft_frusta.h"
#include "kernels/traversal16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT

/* The rays of a block, whose first stands at `corner`, by axis. */
LRB_INLINE void mft_rays(lrb_ctx *c, const mft_group *g, lrb_ptr corner, lrb_v16f d[3])
{
    for (int axis = 0; axis < 3; axis++)
        d[axis] = lrb_add_ps_s3(c, g->delta[axis], lrb_1to16_ps(lrb_at(corner, 64 * axis)));
}

/* The rays of frustum f against the triangle in scratch; true if one of them has a nearer hit now. */
LRB_INLINE bool mft_intersect(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_r64 f)
{
    lrb_v16f d[3];
    lrb_ptr corner = lrb_lea(c, g->scratch, f, 4, g->first);
    lrb_ptr hit = lrb_lea(c, g->frame, lrb_shl(c, f, 6), 1, 0);
    lrb_mem best_t = lrb_at(hit, (int32_t)offsetof(job_frame_tile, t));
    lrb_mem best_id = lrb_at(hit, (int32_t)offsetof(job_frame_tile, id));
    mft_rays(c, g, corner, d);
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

/* One triangle against the frusta of m; returns `updated` with the bits set of those whose limits change. */
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
        if (mft_intersect(c, s, g, record, f) && !g->packets)
            updated = lrb_bts(c, updated, f);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    lrb_region(c, LRB_WHOLE_TILE);
    return updated;
}

/* The limit of every updated frustum becomes the farthest nearest hit of its rays. */
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
        triangle16_prefetch_next(c, record);
        updated = mft_triangle(c, s, g, record, m, updated);
        record = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)sizeof(bvh_triangle));
    } while (lrb_jb(c, lrb_cmp_ptr(c, record, end)));
    if (!g->packets)
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

/* Ask for the frame's lines of the blocks before `end`, all of which are written before the traversal. */
LRB_INLINE void mft_prefetch_frame(lrb_ctx *c, const mft_group *g, lrb_ptr end)
{
    lrb_ptr hit = lrb_lea(c, g->frame, lrb_imm(0), 1, 0);
    do {
        frame16_prefetch(c, hit);
        hit = lrb_lea(c, hit, lrb_imm(0), 1, 64);
    } while (lrb_jb(c, lrb_cmp_ptr(c, hit, end)));
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
        frame16_store(c, hit, lrb_mask_mov_ps(c, no_pixel, k, s->infinity), s->zero, s->zero, no_hit);
        g->n->n[KERNEL_rays] += (unsigned)__builtin_popcount(k.bits);
        g->n->n[KERNEL_rays_primary] += (unsigned)__builtin_popcount(k.bits);
        pixels = lrb_lea(c, pixels, lrb_imm(0), 1, 2);
        hit = lrb_lea(c, hit, lrb_imm(0), 1, 64);
    } while (lrb_jb(c, lrb_cmp_ptr(c, hit, end)));
}

/* The packets of `active`, one by one, for the box tests. */
LRB_INLINE void mft_packets(lrb_ctx *c, slab16 *s, const mft_group *g, lrb_v16f slack, lrb_k16 active)
{
    lrb_r64 bits = lrb_kmov_rk(c, active);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        lrb_v16f d[3];
        lrb_region(c, (uint32_t)f.value);
        mft_rays(c, g, lrb_lea(c, g->scratch, f, 4, SCRATCH_CORNERS), d);
        packets256_add(c, s, g->constants, g->scratch, f, slack, lrb_imm(0xffff), d);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    lrb_region(c, LRB_WHOLE_TILE);
    slab16_count(s, g->n);
}

/** Trace a tile. @param packets  a constant: 256-ray packets instead of frusta */
LRB_INLINE void group_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n, bool packets)
{
    lrb_ptr tile_ptr = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile));
    lrb_ptr deltas = lrb_segment_at(job->constants, (uint32_t)offsetof(job_constants, delta));
    lrb_v16f first[3], lo[3], hi[3];
    slab16 s = {.own_origins = false};
    mft_group g = {
        .constants = lrb_segment_at(job->constants, 0),
        .scratch = lrb_segment_at(c->scratch, 0),
        .frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile)),
        .limits = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile) + (uint32_t)offsetof(job_frame_tile, t)),
        .first = SCRATCH_CORNERS,
        .cull = job->params.cull_backface,
        .blocks = true,
        .packets = packets,
        .n = n,
    };
    traversal16 t = traversal16_of(job, g.scratch, mft_leaf, &g, n);
    t.packets = packets;
    t.nearest = g.frame;
    lrb_region(c, LRB_WHOLE_TILE);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    mft_prefetch_frame(c, &g, lrb_lea(c, g.frame, lrb_imm(0), 1, (int32_t)sizeof(job_frame_tile) / 4));
    t.origin = lrb_load_ps(c, RAYS16_CONSTANT(g.constants, origin_box));
    g.origin = lrb_load_ps(c, RAYS16_CONSTANT(g.constants, origin_triangle));
    lrb_k16 active = lrb_kmov_kr(c, lrb_load32(c, lrb_at(tile_ptr, (int32_t)offsetof(job_tile, blocks))));
    n->n[KERNEL_units_groups]++;
    n->n[packets ? KERNEL_units_packets : KERNEL_units_frusta] += (unsigned)__builtin_popcount(active.bits);
    rays16_corners(c, g.constants, tile_ptr, first);
    mft_corners(c, &g, first, deltas, lo, hi);
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(g.constants, slack));
    if (packets) {
        packets256_begin(c, &s, g.constants, g.scratch, slack, active, lo, hi);
        mft_packets(c, &s, &g, slack, active);
    } else {
        slab16_setup(c, &s, g.constants, g.scratch, slack, active, lo, hi, n);
        s.limit = lrb_mov_ps(c, s.infinity);
    }
    mft_clear_frame(c, &g, &s, tile_ptr);
    traversal16_run(c, &t, &s, active);
}

#endif
