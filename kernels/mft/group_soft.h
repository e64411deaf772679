/* Soft shadows of a tile in groups of a block's 16 hit points, Benthin and Wald 2009, 4 and 5.2 (docs/kernels.md).
 *
 * The tile's primary rays have been traced; then block after block goes. A lane is a hit point: the frustum of its 16 shadow rays, or
 * with 256-ray packets the packet of them, against which boxes are tested ray by ray. Triangles are tested against the frusta either
 * way. A lane whose rays are all blocked is done with, and so is a block with its last lane.
 */
#ifndef KERNELS_MFT_GROUP_SOFT_H
#define KERNELS_MFT_GROUP_SOFT_H

#include "kernels/mft/lane_cull.h"
#include "kernels/mft/shrink.h"
#include "kernels/traversal16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT_SOFT

typedef struct mft_soft {
    shadow16 w;
    bool again; /* not the first pass */
    kernel_shrink shrink;
    bool packets; /* a constant: boxes are tested against the rays */
} mft_soft;

/* The rays of frustum f against the triangle in scratch; true if one of them is blocked that was not. */
LRB_INLINE bool mft_soft_intersect(lrb_ctx *c, slab16 *s, const mft_soft *g, lrb_ptr record, lrb_r64 f)
{
    lrb_v16f d[3];
    lrb_ptr lane = lrb_lea(c, g->w.scratch, f, 4, 0);
    shadow16_rays(c, lane, shadow16_set(c, &g->w, f), d);
    g->w.n->n[KERNEL_isect_tests]++;
    lrb_k16 left = shrink_left(c, lane);
    lrb_k16 blocked = shadow16_blocked(c, &g->w, lane, &lane_cull_layout, lane, record, left, d, s->zero);
    if (!blocked.bits) /* the branch is shadow16_blocked's own */
        return false;
    lrb_k16 before = lrb_kmov_kr(c, lrb_load32(c, lrb_at(lane, SCRATCH_OCCLUSION)));
    lrb_r64 occlusion = lrb_kmov_rk(c, lrb_kor(c, before, blocked));
    lrb_store32(c, lrb_at(lane, SCRATCH_OCCLUSION), occlusion);
    if (lrb_jz(c, lrb_cmp(c, occlusion, lrb_imm(0xffff))))
        s->alive = lrb_kxor(c, s->alive, lrb_kmov_kr(c, lrb_bts(c, lrb_imm(0), f)));
    return true;
}

/* One triangle against the frusta of m; returns `updated` with the bits set of those in which rays were blocked. */
LRB_INLINE lrb_r64 mft_soft_triangle(lrb_ctx *c, slab16 *s, const mft_soft *g, lrb_ptr record, lrb_k16 m, lrb_r64 updated)
{
    g->w.n->n[KERNEL_tri_accesses]++;
    lrb_phase(c, KERNEL_PHASE_CULLING);
    lrb_k16 survivors = lane_cull(c, s, g->w.constants, g->w.scratch, record, g->w.cull, m);
    if (!survivors.bits) /* the branch is lane_cull's own */
        return updated;
    g->w.n->n[KERNEL_tri_after_culling]++;
    lrb_phase(c, KERNEL_PHASE_INTERSECTION);
    lrb_r64 bits = lrb_kmov_rk(c, survivors);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        if (mft_soft_intersect(c, s, g, record, f))
            updated = lrb_bts(c, updated, f);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    return updated;
}

LRB_INLINE void mft_soft_leaf(lrb_ctx *c, slab16 *s, void *user, lrb_ptr box, lrb_ptr record, lrb_ptr end, lrb_k16 m)
{
    const mft_soft *g = user;
    lrb_r64 updated = lrb_imm(0);
    if (g->shrink == KERNEL_SHRINK_RAYS) {
        lrb_phase(c, KERNEL_PHASE_CULLING);
        m = shrink_leaf(c, s, &g->w, box, m);
        if (lrb_jz(c, lrb_kortest(c, m, m)))
            return;
    }
    do {
        updated = mft_soft_triangle(c, s, g, record, m, updated);
        m = lrb_kand(c, m, s->alive);
        if (lrb_jz(c, lrb_kortest(c, m, m)))
            break;
        record = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)sizeof(bvh_triangle));
    } while (lrb_jb(c, lrb_cmp_ptr(c, record, end)));
    if (g->shrink == KERNEL_SHRINK_CORNERS || g->shrink == KERNEL_SHRINK_FRUSTA) {
        lrb_phase(c, KERNEL_PHASE_CULLING);
        shrink_frusta(c, s, &g->w, g->shrink, updated);
    }
}

/* Corner rays as they were before the frusta of an earlier pass shrank. */
LRB_INLINE void mft_soft_restore(lrb_ctx *c, const mft_soft *g, const lrb_v16f o[3])
{
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f corner[4], lo, hi;
        shadow16_corners(c, &g->w, axis, o[axis], corner, &lo, &hi);
    }
}

/* The packets of `alive`, one by one, for the box tests. */
LRB_INLINE void mft_soft_packets(lrb_ctx *c, slab16 *s, const mft_soft *g, lrb_k16 alive)
{
    lrb_r64 bits = lrb_kmov_rk(c, alive);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        lrb_v16f d[3];
        lrb_ptr lane = lrb_lea(c, g->w.scratch, f, 4, 0);
        lrb_v16f origin = shadow16_origin(c, lane, 0x1111, s->zero);
        lrb_store_ps(c, lrb_at(packets256_wide(c, g->w.scratch, f), SCRATCH_PACKET_ORIGIN), origin);
        shadow16_rays(c, lane, shadow16_set(c, &g->w, f), d);
        lrb_v16f slack = lrb_load_1to16_ps(c, lrb_at(lane, SCRATCH_LIGHT_SLACK));
        packets256_add(c, s, g->w.constants, g->w.scratch, f, slack, lrb_imm(g->w.sample_mask), d);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    slab16_count(s, g->w.n);
}

/* The frusta of a block, with one set of samples each. */
LRB_INLINE void mft_soft_trace(lrb_ctx *c, const traversal16 *t, mft_soft *g, const shadow16_start *start)
{
    slab16 s = {.own_origins = true, .alive = start->alive};
    lrb_v16f lo[3], hi[3];
    lrb_phase(c, KERNEL_PHASE_SETUP);
    for (int axis = 0; axis < 3; axis++) {
        lo[axis] = start->lo[axis];
        hi[axis] = start->hi[axis];
        s.origin[axis] = lrb_load_ps(c, lrb_at(g->w.scratch, SCRATCH_HIT_POINTS + 64 * axis));
    }
    if (g->again && (g->shrink == KERNEL_SHRINK_CORNERS || g->shrink == KERNEL_SHRINK_FRUSTA))
        mft_soft_restore(c, g, s.origin);
    const unsigned frusta = (unsigned)__builtin_popcount(start->alive.bits);
    g->w.n->n[KERNEL_units_shadow_groups]++;
    g->w.n->n[g->packets ? KERNEL_units_shadow_packets : KERNEL_units_shadow_frusta] += frusta;
    g->w.n->n[KERNEL_rays] += frusta * (unsigned)__builtin_popcount(g->w.sample_mask);
    g->w.n->n[KERNEL_rays_shadow] += frusta * (unsigned)__builtin_popcount(g->w.sample_mask);
    if (g->packets) {
        packets256_begin(c, &s, g->w.constants, g->w.scratch, start->slack, start->alive, lo, hi);
        mft_soft_packets(c, &s, g, start->alive);
    } else {
        slab16_setup(c, &s, g->w.constants, g->w.scratch, start->slack, start->alive, lo, hi, g->w.n);
    }
    if (g->shrink == KERNEL_SHRINK_FRUSTA)
        shrink_keep_intervals(c, &g->w, lo, hi);
    s.limit = lrb_load_1to16_ps(c, SHADOW16_LIGHT(g->w.constants, farthest));
    traversal16_run(c, t, &s, start->alive);
}

/* All passes of a block. */
LRB_INLINE void mft_soft_block(lrb_ctx *c, const traversal16 *t, mft_soft *g)
{
    shadow16 *w = &g->w;
    lrb_phase(c, KERNEL_PHASE_SHADING);
    g->again = false;
    shadow16_start start = shadow16_begin(c, w);
    shadow16_begin_passes(c, w, &start);
    do {
        start.alive = shadow16_begin_pass(c, w, &start);
        if (!lrb_jz(c, lrb_kortest(c, start.alive, start.alive)))
            mft_soft_trace(c, t, g, &start);
        lrb_phase(c, KERNEL_PHASE_SHADING);
        shadow16_end_pass(c, w);
        g->again = true;
    } while (shadow16_next_pass(c, w));
    shadow16_end(c, w, start.hits);
}

/** The shadows of a tile whose primary rays have been traced. @param packets  a constant: 256-ray packets instead of frusta */
LRB_INLINE void group_soft_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n, bool packets)
{
    mft_soft g = {.w = shadow16_of(c, job, tile, n), .shrink = packets ? KERNEL_SHRINK_NONE : job->params.shrink, .packets = packets};
    traversal16 t = traversal16_of(job, g.w.scratch, mft_soft_leaf, &g, n);
    t.any = true;
    t.packets = packets;
    uint32_t block = 0;
    do {
        lrb_region(c, block++);
        mft_soft_block(c, &t, &g);
    } while (shadow16_next_block(c, &g.w));
    lrb_region(c, LRB_WHOLE_TILE);
}

#endif
