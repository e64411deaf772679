/* Box tests of 16 packets of 16 rays that are traversed together: the 256-ray packets of Benthin and Wald 2009, 5.2.
 *
 * A lane of the traversal is a packet, and its bit says 'packet i may hit'. Where a frustum has one interval of directions for its 16
 * rays, a packet is met if one of its rays is: each of them is tested as packet16-primary tests it (kernels/slab16.h), with its own
 * reciprocals, which are formed when the group starts and wait in scratch, and its own limit. The path of the test is the group's.
 */
#ifndef KERNELS_PACKET_PACKETS256_H
#define KERNELS_PACKET_PACKETS256_H

#include "kernels/shadow16.h"
#include "kernels/slab16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_PACKETS256

/* Where the reciprocals of packet f stand: by axis from there. */
LRB_INLINE lrb_ptr packets256_wide(lrb_ctx *c, lrb_ptr scratch, lrb_r64 f)
{
    return lrb_lea(c, scratch, lrb_shl(c, f, 6), 1, 0);
}

/**
 * Begin a group: are all its rays of one sign on every axis? Then they are on the common path; else on that of blended planes until
 * a ray without a sign is added.
 *
 * @param s       own_origins, origin and alive are the caller's to set
 * @param active  packets that are traced
 * @param lo, hi  per axis bounds of each packet's directions; out: widened by `slack`
 */
LRB_INLINE void packets256_begin(lrb_ctx *c, slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_v16f slack, lrb_k16 active,
                                 lrb_v16f lo[3], lrb_v16f hi[3])
{
    lrb_k16 all_strict = active;
    slab16_begin(c, s, constants, scratch, slack);
    for (int axis = 0; axis < 3; axis++) {
        slab16_signs(c, s, axis, slack, active, &lo[axis], &hi[axis]);
        all_strict = lrb_kand(c, all_strict, s->strict[axis]);
    }
    s->path = SLAB16_BLEND;
    lrb_k16 some_zero = lrb_kxor(c, all_strict, active);
    if (lrb_jnz(c, lrb_kortest(c, some_zero, some_zero)))
        return;
    if (slab16_setup_common(c, s, scratch, active))
        s->path = SLAB16_COMMON;
}

/* One axis of packet f, into scratch; returns the rays that have a sign on it. */
LRB_INLINE lrb_r64 packets256_add_axis(lrb_ctx *c, const slab16 *s, slab16 *p, lrb_ptr constants, lrb_ptr wide, lrb_ptr lane, int axis,
                                       lrb_v16f slack, lrb_k16 rays, lrb_v16f d)
{
    lrb_v16f lo = d, hi = d;
    slab16_signs(c, p, axis, slack, rays, &lo, &hi);
    slab16_setup_far(c, p, axis, lo, hi);
    lrb_store_ps(c, lrb_at(wide, SCRATCH_PACKET_FAR + 1024 * axis), p->far_rcp[axis]);
    if (s->path == SLAB16_COMMON) {
        slab16_setup_strict(c, p, axis, lo, hi);
        lrb_store_ps(c, lrb_at(wide, SCRATCH_PACKET_NEAR + 1024 * axis), p->near_rcp[axis]);
        return lrb_imm(0xffff);
    }
    slab16_setup_zero(c, p, constants, axis, lo, hi);
    lrb_store_ps(c, lrb_at(wide, SCRATCH_PACKET_NEAR + 1024 * axis), p->near_rcp[axis]);
    lrb_store_ps(c, lrb_at(wide, SCRATCH_PACKET_BACK + 1024 * axis), p->back_rcp[axis]);
    lrb_store32(c, lrb_at(lane, SCRATCH_PACKET_NEGATIVE + 64 * axis), lrb_kmov_rk(c, p->negative[axis]));
    lrb_r64 strict = lrb_kmov_rk(c, p->strict[axis]);
    lrb_store32(c, lrb_at(lane, SCRATCH_PACKET_STRICT + 64 * axis), strict);
    return strict;
}

/**
 * Add packet f: its reciprocals, and for the other paths the signs of its rays, into scratch.
 *
 * @param slack  what its directions d are widened by
 * @param rays   bits of those that are traced
 */
LRB_INLINE void packets256_add(lrb_ctx *c, slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_r64 f, lrb_v16f slack, lrb_r64 rays,
                               const lrb_v16f d[3])
{
    slab16 p = {.zero = s->zero};
    lrb_ptr wide = packets256_wide(c, scratch, f);
    lrb_ptr lane = lrb_lea(c, scratch, f, 4, 0);
    lrb_k16 m = lrb_kmov_kr(c, rays);
    lrb_r64 all_strict = rays;
    for (int axis = 0; axis < 3; axis++) {
        lrb_r64 strict = packets256_add_axis(c, s, &p, constants, wide, lane, axis, slack, m, d[axis]);
        if (s->path != SLAB16_COMMON)
            all_strict = lrb_and(c, all_strict, strict);
    }
    if (s->path != SLAB16_COMMON && lrb_jnz(c, lrb_cmp(c, all_strict, rays)))
        s->path = SLAB16_ZERO;
}

/* The box test of packet f, as it was left in scratch; its limit is the caller's to set. */
LRB_INLINE slab16 packets256_load(lrb_ctx *c, const slab16 *s, slab16_path path, lrb_ptr wide, lrb_ptr lane)
{
    slab16 p = {.path = path, .own_origins = false, .zero = s->zero, .infinity = s->infinity};
    for (int axis = 0; axis < 3; axis++) {
        p.near_plane[axis] = s->near_plane[axis];
        p.far_plane[axis] = s->far_plane[axis];
        p.far_rcp[axis] = lrb_load_ps(c, lrb_at(wide, SCRATCH_PACKET_FAR + 1024 * axis));
        p.near_rcp[axis] = lrb_load_ps(c, lrb_at(wide, SCRATCH_PACKET_NEAR + 1024 * axis));
        lrb_mem back = lrb_at(wide, SCRATCH_PACKET_BACK + 1024 * axis);
        if (path == SLAB16_BLEND) {
            p.negative[axis] = lrb_kmov_kr(c, lrb_load32(c, lrb_at(lane, SCRATCH_PACKET_NEGATIVE + 64 * axis)));
            p.near_rcp[axis] = lrb_mask_mov_ps_s3(c, p.near_rcp[axis], p.negative[axis], lrb_full_ps(back));
        } else if (path == SLAB16_ZERO) {
            p.strict[axis] = lrb_kmov_kr(c, lrb_load32(c, lrb_at(lane, SCRATCH_PACKET_STRICT + 64 * axis)));
            p.back_rcp[axis] = lrb_load_ps(c, back);
        }
    }
    return p;
}

/* The rays of a packet that look for hits, and their limits: the nearest hits so far, -infinity for no pixel; or, if any hit
   will do, the rays that are not blocked. */
LRB_INLINE lrb_k16 packets256_rays(lrb_ctx *c, const slab16 *s, lrb_ptr nearest, lrb_r64 offset, lrb_ptr lane, lrb_v16f *limit)
{
    if (s->own_origins) {
        *limit = s->limit;
        return lrb_knot(c, lrb_kmov_kr(c, lrb_load32(c, lrb_at(lane, SCRATCH_OCCLUSION))));
    }
    lrb_ptr limits = lrb_lea(c, nearest, offset, 1, 0);
    *limit = lrb_load_ps(c, lrb_at(limits, 0));
    return lrb_mask(0xffff);
}

/**
 * Test a pair of boxes.
 *
 * @param path     a constant, equal to s->path
 * @param nearest  of rays with a common origin: the distances of their nearest hits, 64 bytes a packet
 * @param pair     the boxes; if the origin is common they are in scratch as well, relative to it
 * @param m        packets to test, at least one
 * @param met      out: those of m of which a ray meets the first box, and the second
 *
 * Returns the rays, whatever their packet, that meet both boxes and enter the first before the second.
 */
LRB_INLINE lrb_k16 packets256_test(lrb_ctx *c, const slab16 *s, slab16_path path, lrb_ptr scratch, lrb_ptr nearest, lrb_ptr pair,
                                   lrb_k16 m, lrb_k16 met[2])
{
    lrb_r64 nearer = lrb_imm(0);
    lrb_r64 bits = lrb_kmov_rk(c, m);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    do {
        lrb_v16f entry[2];
        lrb_k16 hit[2];
        lrb_r64 offset = lrb_shl(c, f, 6);
        lrb_ptr wide = lrb_lea(c, scratch, offset, 1, 0);
        lrb_ptr lane = lrb_lea(c, scratch, f, 4, 0);
        if (s->own_origins) {
            lrb_v16f origin = lrb_load_ps(c, lrb_at(wide, SCRATCH_PACKET_ORIGIN));
            lrb_store_ps(c, lrb_at(scratch, SCRATCH_BOXES), lrb_subr_ps_s3(c, origin, lrb_full_ps(lrb_at(pair, 0))));
        } else {
            lrb_region(c, (uint32_t)f.value);
        }
        slab16 p = packets256_load(c, s, path, wide, lane);
        lrb_k16 rays = packets256_rays(c, s, nearest, offset, lane, &p.limit);
        for (int i = 0; i < 2; i++) {
            hit[i] = slab16_test(c, &p, path, scratch, 32 * i, rays, &entry[i]);
            lrb_store32(c, lrb_at(lane, SCRATCH_PACKET_MET + 64 * i), lrb_kmov_rk(c, hit[i]));
        }
        lrb_k16 first = lrb_mask_cmplt_ps(c, lrb_kand(c, hit[0], hit[1]), entry[0], entry[1]);
        nearer = lrb_or(c, nearer, lrb_kmov_rk(c, first));
        f = lrb_bsfi(c, f, bits);
    } while (!lrb_jl(c, lrb_test(c, f, f)));
    if (!s->own_origins)
        lrb_region(c, LRB_WHOLE_TILE);
    m = lrb_kmov_kr(c, bits);
    lrb_v16i zero = lrb_castps_pi(s->zero);
    for (int i = 0; i < 2; i++)
        met[i] = lrb_mask_cmplt_pi_s3(c, m, zero, lrb_full_pi(lrb_at(scratch, SCRATCH_PACKET_MET + 64 * i)));
    return lrb_kmov_kr(c, nearer);
}

#endif
