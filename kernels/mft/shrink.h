/* Shrinking of shadow frusta whose rays are partly blocked, Benthin and Wald 2009, 5.3 (docs/kernels.md).
 *
 * `corner-rays`: the corner rays go through the corners of the smallest rectangle on the light that holds the samples which are
 * left; triangles are culled better. `frusta`: so does the interval of directions; fewer boxes are met as well. `ray-aabb`: at every
 * leaf the rays that are left are tested against its box one by one, and the frustum stays away if none meets it. None
 * loses a ray's hit, so all give the same shadows.
 */
#ifndef KERNELS_MFT_SHRINK_H
#define KERNELS_MFT_SHRINK_H

#include "kernels/shadow16.h"
#include "kernels/slab16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT_SHRINK

/* Smallest or largest of 16 words, in all lanes. */
LRB_INLINE lrb_v16f shrink_least(lrb_ctx *c, lrb_v16f v)
{
    v = lrb_min_ps_s3(c, v, lrb_swizzle_ps(v, LRB_CDAB));
    v = lrb_min_ps_s3(c, v, lrb_swizzle_ps(v, LRB_BADC));
    v = lrb_min_ps(c, v, lrb_shuf128x32_ps(c, v, 0xb1, LRB_DCBA));
    return lrb_min_ps(c, v, lrb_shuf128x32_ps(c, v, 0x4e, LRB_DCBA));
}

LRB_INLINE lrb_v16f shrink_most(lrb_ctx *c, lrb_v16f v)
{
    v = lrb_max_ps_s3(c, v, lrb_swizzle_ps(v, LRB_CDAB));
    v = lrb_max_ps_s3(c, v, lrb_swizzle_ps(v, LRB_BADC));
    v = lrb_max_ps(c, v, lrb_shuf128x32_ps(c, v, 0xb1, LRB_DCBA));
    return lrb_max_ps(c, v, lrb_shuf128x32_ps(c, v, 0x4e, LRB_DCBA));
}

/* The rays of frustum f that are not blocked. */
LRB_INLINE lrb_k16 shrink_left(lrb_ctx *c, lrb_ptr lane)
{
    return lrb_knot(c, lrb_kmov_kr(c, lrb_load32(c, lrb_at(lane, SCRATCH_OCCLUSION))));
}

/* The rectangle of frustum f's samples that are left. */
LRB_INLINE void shrink_rectangle(lrb_ctx *c, const shadow16 *w, lrb_r64 f)
{
    lrb_k16 left = shrink_left(c, lrb_lea(c, w->scratch, f, 4, 0));
    lrb_k16 lane = lrb_kmov_kr(c, lrb_bts(c, lrb_imm(0), f));
    lrb_ptr set = shadow16_set(c, w, f);
    lrb_v16f infinity = lrb_load_ps(c, RAYS16_CONSTANT(w->constants, infinity));
    lrb_v16f minus_infinity = lrb_load_ps(c, RAYS16_CONSTANT(w->constants, no_pixel));
    for (int axis = 0; axis < 2; axis++) {
        const int32_t field = axis ? (int32_t)offsetof(job_sample_set, b) : (int32_t)offsetof(job_sample_set, a);
        lrb_v16f least = shrink_least(c, lrb_mask_mov_ps_s3(c, infinity, left, lrb_full_ps(lrb_at(set, field))));
        lrb_v16f most = shrink_most(c, lrb_mask_mov_ps_s3(c, minus_infinity, left, lrb_full_ps(lrb_at(set, field))));
        lrb_mask_store_ps(c, lrb_at(w->scratch, SCRATCH_RECTANGLE + 128 * axis), lane, least);
        lrb_mask_store_ps(c, lrb_at(w->scratch, SCRATCH_RECTANGLE + 128 * axis + 64), lane, most);
    }
}

/* One axis of the four corner rays of the frusta of m, from their rectangles: formed as the rays are. Their range too. */
LRB_INLINE void shrink_corners(lrb_ctx *c, const shadow16 *w, int axis, lrb_k16 m, lrb_v16f *lo, lrb_v16f *hi)
{
    lrb_v16f along[4], corner[4], first = lrb_load_ps(c, lrb_at(w->scratch, SCRATCH_TO_LIGHT + 64 * axis));
    for (int i = 0; i < 4; i++) {
        lrb_mem edge = i < 2 ? SHADOW16_LIGHT(w->constants, u[axis]) : SHADOW16_LIGHT(w->constants, v[axis]);
        along[i] = lrb_load_ps(c, lrb_at(w->scratch, SCRATCH_RECTANGLE + 64 * i));
        along[i] = lrb_mul_ps_s3(c, along[i], lrb_1to16_ps(edge));
    }
    for (int k = 0; k < 4; k++) {
        lrb_v16f delta = lrb_add_ps(c, along[k == 1 || k == 2], along[k < 2 ? 2 : 3]);
        corner[k] = lrb_add_ps(c, first, delta);
        lrb_mask_store_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_CORNERS + 192 * k + 64 * axis), m, corner[k]);
    }
    lrb_v16f half = lrb_min_ps(c, corner[0], corner[1]);
    *lo = lrb_min_ps(c, half, lrb_min_ps(c, corner[2], corner[3]));
    half = lrb_max_ps(c, corner[0], corner[1]);
    *hi = lrb_max_ps(c, half, lrb_max_ps(c, corner[2], corner[3]));
}

/* Keep the widened intervals that slab16_setup has left in lo and hi. */
LRB_INLINE void shrink_keep_intervals(lrb_ctx *c, const shadow16 *w, const lrb_v16f lo[3], const lrb_v16f hi[3])
{
    for (int axis = 0; axis < 3; axis++) {
        lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_INTERVALS + 64 * axis), lo[axis]);
        lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_INTERVALS + 192 + 64 * axis), hi[axis]);
    }
}

/* Narrow the box test's interval of one axis to lo..hi, widened, for the lanes of m. It stays within what it was, so a sign that a
   lane has is never lost (hard case B12). */
LRB_INLINE void shrink_interval(lrb_ctx *c, slab16 *s, const shadow16 *w, int axis, lrb_k16 m, lrb_v16f lo, lrb_v16f hi)
{
    lrb_v16f slack = lrb_load_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_SLACK));
    lrb_mem low = lrb_at(w->scratch, SCRATCH_INTERVALS + 64 * axis), high = lrb_at(w->scratch, SCRATCH_INTERVALS + 192 + 64 * axis);
    lo = lrb_max_ps_s3(c, lrb_sub_ps(c, lo, slack), lrb_full_ps(low));
    hi = lrb_min_ps_s3(c, lrb_add_ps(c, hi, slack), lrb_full_ps(high));
    lrb_mask_store_ps(c, low, m, lo);
    lrb_mask_store_ps(c, high, m, hi);
    lrb_k16 negative = lrb_mask_cmplt_ps(c, m, hi, s->zero);
    s->far_rcp[axis] = lrb_mask_mov_ps(c, s->far_rcp[axis], m, rays16_reciprocal(c, lrb_mask_mov_ps(c, lo, negative, hi)));
    if (s->path != SLAB16_ZERO) {
        s->near_rcp[axis] = lrb_mask_mov_ps(c, s->near_rcp[axis], m, rays16_reciprocal(c, lrb_mask_mov_ps(c, hi, negative, lo)));
        return;
    }
    lrb_k16 positive = lrb_mask_cmplt_ps(c, m, s->zero, lo);
    s->strict[axis] = lrb_kor(c, s->strict[axis], lrb_kor(c, positive, negative));
    hi = lrb_max_ps_s3(c, hi, lrb_1to16_ps(RAYS16_CONSTANT(w->constants, tiny)));
    lo = lrb_min_ps_s3(c, lo, lrb_1to16_ps(RAYS16_CONSTANT(w->constants, minus_tiny)));
    s->near_rcp[axis] = lrb_mask_mov_ps(c, s->near_rcp[axis], m, rays16_reciprocal(c, hi));
    s->back_rcp[axis] = lrb_mask_mov_ps(c, s->back_rcp[axis], m, rays16_reciprocal(c, lo));
}

/**
 * After a leaf: shrink the frusta in which rays were blocked and some are left.
 *
 * @param frusta  those that had rays blocked in the leaf: bits
 */
LRB_INLINE void shrink_frusta(lrb_ctx *c, slab16 *s, const shadow16 *w, kernel_shrink shrink, lrb_r64 frusta)
{
    lrb_k16 m = lrb_kand(c, lrb_kmov_kr(c, frusta), s->alive);
    if (lrb_jz(c, lrb_kortest(c, m, m)))
        return;
    w->n->n[KERNEL_additional_tests] += (unsigned)__builtin_popcount(m.bits);
    w->n->n[KERNEL_additional_tests16]++;
    lrb_r64 bits = lrb_kmov_rk(c, m);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        shrink_rectangle(c, w, f);
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f lo, hi;
        shrink_corners(c, w, axis, m, &lo, &hi);
        if (shrink == KERNEL_SHRINK_FRUSTA)
            shrink_interval(c, s, w, axis, m, lo, hi);
    }
}

/* One axis of the tight test, for rays d that are cones of `slack`: later entry, earlier exit. Axis by axis, because eight mask
   registers hold no more. */
LRB_INLINE void shrink_ray_axis(lrb_ctx *c, slab16 *rays, lrb_ptr constants, lrb_ptr box, int axis, lrb_k16 m, lrb_v16f d, lrb_v16f slack,
                                lrb_v16f *entry, lrb_v16f *exit)
{
    lrb_s3f planes[2];
    lrb_v16f lo = lrb_sub_ps(c, d, slack);
    lrb_v16f hi = lrb_add_ps(c, d, slack);
    lrb_k16 negative = lrb_mask_cmplt_ps(c, m, hi, rays->zero);
    rays->far_rcp[axis] = rays16_reciprocal(c, lrb_mask_mov_ps(c, lo, negative, hi));
    rays->strict[axis] = lrb_kor(c, negative, lrb_mask_cmplt_ps(c, m, rays->zero, lo));
    hi = lrb_max_ps_s3(c, hi, lrb_1to16_ps(RAYS16_CONSTANT(constants, tiny)));
    lo = lrb_min_ps_s3(c, lo, lrb_1to16_ps(RAYS16_CONSTANT(constants, minus_tiny)));
    rays->near_rcp[axis] = rays16_reciprocal(c, hi);
    rays->back_rcp[axis] = rays16_reciprocal(c, lo);
    slab16_planes(c, rays, SLAB16_ZERO, box, axis, 0, planes);
    *entry = lrb_max_ps(c, *entry, slab16_entry(c, rays, SLAB16_ZERO, planes, axis));
    *exit = lrb_min_ps(c, *exit, slab16_exit(c, rays, SLAB16_ZERO, planes, axis));
}

/* Whether one of frustum f's rays that are left meets a leaf's box: the tight test, whatever their signs. */
LRB_INLINE bool shrink_meets(lrb_ctx *c, const slab16 *s, const shadow16 *w, lrb_ptr box, lrb_r64 f)
{
    _Static_assert(SCRATCH_BOXES == 0, "a box anywhere stands where slab16 looks for one in scratch");
    slab16 rays = {.own_origins = true, .path = SLAB16_ZERO, .zero = s->zero, .infinity = s->infinity};
    lrb_v16f d[3], entry = s->zero, exit = s->limit;
    lrb_ptr lane = lrb_lea(c, w->scratch, f, 4, 0);
    lrb_k16 left = shrink_left(c, lane);
    shadow16_rays(c, lane, shadow16_set(c, w, f), d);
    lrb_v16f slack = lrb_load_1to16_ps(c, lrb_at(lane, SCRATCH_LIGHT_SLACK));
    w->n->n[KERNEL_aabb_tests]++;
    for (int axis = 0; axis < 3; axis++) {
        rays.origin[axis] = lrb_load_1to16_ps(c, lrb_at(lane, SCRATCH_HIT_POINTS + 64 * axis));
        shrink_ray_axis(c, &rays, w->constants, box, axis, left, d[axis], slack, &entry, &exit);
    }
    lrb_k16 hit = lrb_mask_cmple_ps(c, left, entry, exit);
    return !lrb_jz(c, lrb_kortest(c, hit, hit));
}

/** Before a leaf: the frusta of m without those, partly blocked, none of whose rays that are left meets its box. */
LRB_INLINE lrb_k16 shrink_leaf(lrb_ctx *c, const slab16 *s, const shadow16 *w, lrb_ptr box, lrb_k16 m)
{
    lrb_r64 kept = lrb_kmov_rk(c, m);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), kept);
    do {
        lrb_r64 occlusion = lrb_load32(c, lrb_at(lrb_lea(c, w->scratch, f, 4, 0), SCRATCH_OCCLUSION));
        if (!lrb_jz(c, lrb_cmp(c, occlusion, lrb_imm(0xffffu & ~w->sample_mask))))
            if (!shrink_meets(c, s, w, box, f))
                kept = lrb_xor(c, kept, lrb_bts(c, lrb_imm(0), f));
        f = lrb_bsfi(c, f, kept); /* bits before f do not matter */
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    return lrb_kmov_kr(c, kept);
}

#endif
