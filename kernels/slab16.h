/* The 16-lane slab test: one box against 16 intervals of directions, from one origin or from 16. docs/kernels.md.
 *
 * A lane is a ray of a packet or a frustum of a group. What is tested is, per axis, an interval of direction components:
 * for a frustum the range over its rays; for a ray its own component. Both are widened by `slack` on either side,
 * so that a ray is treated as a cone of 2^-16 of its length. That makes three things true at no cost per box:
 *
 * - a ray with a component of +-0 is an interval around 0 like any other (hard cases X1, X2, B1, B3), and no
 *   reciprocal is infinite;
 * - the rounding of (plane - origin) * reciprocal, a few units in the last place, cannot lose a box that the ray
 *   meets (X13);
 * - a hit that the triangle test accepts within half of that of the triangle's own bounds (triangle16_in_bounds) cannot
 *   be refused by the test of any box around the triangle (X6, X10): every tracer sees the same hits.
 *
 * The reciprocal that multiplies the near plane is that of the component of largest magnitude, for the far plane that
 * of the smallest: numeric min and max would lose hits for one of the two signs.
 */
#ifndef KERNELS_SLAB16_H
#define KERNELS_SLAB16_H

#include "kernels/counters.h"
#include "kernels/kernel.h"
#include "kernels/rays16.h"
#include "kernels/scratch.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_SLAB

/* How the lanes' directions lie; chosen once per packet or group. */
typedef enum slab16_path {
    SLAB16_COMMON, /* all lanes have the same strict sign on every axis: near and far planes by offset */
    SLAB16_BLEND,  /* every lane has a strict sign on every axis: near and far planes by lane */
    SLAB16_ZERO    /* some lane's interval holds 0 on some axis: the tight test */
} slab16_path;

typedef struct slab16 {
    slab16_path path;
    bool own_origins; /* a constant: every lane has an origin of its own, and the boxes in scratch are not relative to one */
    lrb_v16f origin[3]; /* then: of each lane */
    lrb_k16 alive;  /* lanes that look for a hit, of a traversal to which any is enough (kernels/traversal16.h) */
    lrb_v16f limit; /* distance that an entry must not exceed: nearest hit so far */
    lrb_v16f zero, infinity;
    lrb_v16f near_rcp[3]; /* COMMON, BLEND: 1 / largest magnitude; ZERO: 1 / largest component, positive */
    lrb_v16f back_rcp[3]; /* ZERO: 1 / smallest component, negative */
    lrb_v16f far_rcp[3];  /* 1 / smallest magnitude, where the lane has a sign */
    lrb_k16 negative[3];  /* BLEND: active lanes with negative components */
    lrb_k16 strict[3];    /* ZERO: active lanes whose interval does not hold 0 */
    lrb_ptr near_plane[3], far_plane[3]; /* COMMON: addresses of the first box's planes in scratch */
} slab16;

/* The reciprocals of the largest component forward and back, of lanes that may hold 0. */
LRB_INLINE void slab16_setup_zero(lrb_ctx *c, slab16 *s, lrb_ptr constants, int axis, lrb_v16f lo, lrb_v16f hi)
{
    lrb_v16f forward = lrb_max_ps_s3(c, hi, lrb_1to16_ps(RAYS16_CONSTANT(constants, tiny)));
    lrb_v16f back = lrb_min_ps_s3(c, lo, lrb_1to16_ps(RAYS16_CONSTANT(constants, minus_tiny)));
    s->near_rcp[axis] = rays16_reciprocal(c, forward);
    s->back_rcp[axis] = rays16_reciprocal(c, back);
}

/* The reciprocal of the largest magnitude, of lanes that have a sign. */
LRB_INLINE void slab16_setup_strict(lrb_ctx *c, slab16 *s, int axis, lrb_v16f lo, lrb_v16f hi)
{
    s->near_rcp[axis] = rays16_reciprocal(c, lrb_mask_mov_ps(c, hi, s->negative[axis], lo));
}

/* One sign for all active lanes, each of which has one, on every axis? Then the near planes are the same for all. */
LRB_INLINE bool slab16_setup_common(lrb_ctx *c, slab16 *s, lrb_ptr scratch, lrb_k16 active)
{
    for (int axis = 0; axis < 3; axis++) {
        lrb_k16 negative = s->negative[axis];
        bool any_negative = !lrb_jz(c, lrb_kortest(c, negative, negative));
        if (any_negative) {
            lrb_k16 positive = lrb_kxor(c, negative, active);
            if (lrb_jnz(c, lrb_kortest(c, positive, positive)))
                return false;
        }
        int near_word = any_negative ? axis + 4 : axis;
        s->near_plane[axis] = lrb_lea(c, scratch, lrb_imm(0), 1, SCRATCH_BOXES + 4 * near_word);
        s->far_plane[axis] = lrb_lea(c, scratch, lrb_imm(0), 1, SCRATCH_BOXES + 4 * (near_word ^ 4));
    }
    return true;
}

/* The vectors that all lanes share; what a path does not use is defined all the same. */
LRB_INLINE void slab16_begin(lrb_ctx *c, slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_v16f slack)
{
    s->infinity = lrb_load_ps(c, RAYS16_CONSTANT(constants, infinity));
    s->zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(slack), lrb_castps_pi(slack)));
    for (int axis = 0; axis < 3; axis++) {
        s->near_rcp[axis] = s->back_rcp[axis] = s->far_rcp[axis] = s->zero;
        s->near_plane[axis] = s->far_plane[axis] = scratch;
    }
}

/* Widen the interval of one axis and find the lanes' signs on it. */
LRB_INLINE void slab16_signs(lrb_ctx *c, slab16 *s, int axis, lrb_v16f slack, lrb_k16 active, lrb_v16f *lo, lrb_v16f *hi)
{
    *lo = lrb_sub_ps(c, *lo, slack);
    *hi = lrb_add_ps(c, *hi, slack);
    s->negative[axis] = lrb_mask_cmplt_ps(c, active, *hi, s->zero);
    lrb_k16 positive = lrb_mask_cmplt_ps(c, active, s->zero, *lo);
    s->strict[axis] = lrb_kor(c, positive, s->negative[axis]);
}

/* The reciprocal of the smallest magnitude, of lanes that have a sign. */
LRB_INLINE void slab16_setup_far(lrb_ctx *c, slab16 *s, int axis, lrb_v16f lo, lrb_v16f hi)
{
    lrb_v16f smallest = lrb_mask_mov_ps(c, lo, s->negative[axis], hi);
    s->far_rcp[axis] = rays16_reciprocal(c, smallest);
}

/* Widen the intervals and find the lanes' signs; returns the lanes of `active` that have one on every axis. */
LRB_INLINE lrb_k16 slab16_widen(lrb_ctx *c, slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_v16f slack, lrb_k16 active,
                                lrb_v16f lo[3], lrb_v16f hi[3])
{
    lrb_k16 all_strict = active;
    slab16_begin(c, s, constants, scratch, slack);
    for (int axis = 0; axis < 3; axis++) {
        slab16_signs(c, s, axis, slack, active, &lo[axis], &hi[axis]);
        all_strict = lrb_kand(c, all_strict, s->strict[axis]);
        slab16_setup_far(c, s, axis, lo[axis], hi[axis]);
    }
    return all_strict;
}

/* Count the packet or group by its path. */
LRB_INLINE void slab16_count(const slab16 *s, kernel_counts *n)
{
    if (s->path == SLAB16_ZERO)
        n->n[KERNEL_units_zero]++;
    else
        n->n[s->path == SLAB16_COMMON ? KERNEL_units_common : KERNEL_units_blend]++;
}

/**
 * Prepare the test for a packet or group and choose its path.
 *
 * @param s       own_origins and origin are the caller's to set
 * @param slack   what the intervals are widened by: 2^-16 of the length of the longest direction in the lane
 * @param lo, hi  per axis the smallest and largest direction component of each lane; out: widened
 * @param active  lanes that will be tested; the others may hold anything
 * @param n       the path is counted here
 */
LRB_INLINE void slab16_setup(lrb_ctx *c, slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_v16f slack, lrb_k16 active,
                             lrb_v16f lo[3], lrb_v16f hi[3], kernel_counts *n)
{
    lrb_k16 all_strict = slab16_widen(c, s, constants, scratch, slack, active, lo, hi);
    lrb_k16 some_zero = lrb_kxor(c, all_strict, active);
    if (lrb_jnz(c, lrb_kortest(c, some_zero, some_zero))) {
        s->path = SLAB16_ZERO;
        for (int axis = 0; axis < 3; axis++)
            slab16_setup_zero(c, s, constants, axis, lo[axis], hi[axis]);
    } else {
        for (int axis = 0; axis < 3; axis++)
            slab16_setup_strict(c, s, axis, lo[axis], hi[axis]);
        s->path = slab16_setup_common(c, s, scratch, active) ? SLAB16_COMMON : SLAB16_BLEND;
    }
    slab16_count(s, n);
}

/* One of a box's planes, relative to each lane's origin. */
LRB_INLINE lrb_s3f slab16_plane(lrb_ctx *c, const slab16 *s, lrb_mem plane, int axis)
{
    if (!s->own_origins)
        return lrb_1to16_ps(plane);
    return lrb_reg_ps(lrb_subr_ps_s3(c, s->origin[axis], lrb_1to16_ps(plane)));
}

/* The two planes of one axis: the near one and the far one (COMMON), or the smaller and the larger. `second`: 32 for the box's
   neighbour in scratch. */
LRB_INLINE void slab16_planes(lrb_ctx *c, const slab16 *s, slab16_path path, lrb_ptr scratch, int axis, int second, lrb_s3f planes[2])
{
    const bool common = path == SLAB16_COMMON;
    lrb_mem min = lrb_at(scratch, SCRATCH_BOXES + second + 4 * axis);
    lrb_mem max = lrb_at(scratch, SCRATCH_BOXES + second + 4 * (axis + 4));
    planes[0] = slab16_plane(c, s, common ? lrb_at(s->near_plane[axis], second) : min, axis);
    planes[1] = slab16_plane(c, s, common ? lrb_at(s->far_plane[axis], second) : max, axis);
}

/* Entry and exit distances of one axis. */
LRB_INLINE lrb_v16f slab16_entry(lrb_ctx *c, const slab16 *s, slab16_path path, const lrb_s3f planes[2], int axis)
{
    lrb_v16f entry = lrb_mul_ps_s3(c, s->near_rcp[axis], planes[0]);
    switch (path) {
    case SLAB16_COMMON:
        return entry;
    case SLAB16_BLEND:
        return lrb_mask_mul_ps_s3(c, entry, s->negative[axis], s->near_rcp[axis], planes[1]);
    case SLAB16_ZERO:
        /* Whatever the lane's sign: the box is reached going forward at min / largest, going back at max / smallest;
           the product of the wrong direction is negative, or huge where that direction cannot reach the box. */
        return lrb_max_ps(c, entry, lrb_mul_ps_s3(c, s->back_rcp[axis], planes[1]));
    }
    return s->zero;
}

LRB_INLINE lrb_v16f slab16_exit(lrb_ctx *c, const slab16 *s, slab16_path path, const lrb_s3f planes[2], int axis)
{
    lrb_v16f by_min, by_max;
    switch (path) {
    case SLAB16_COMMON:
        return lrb_mul_ps_s3(c, s->far_rcp[axis], planes[1]);
    case SLAB16_BLEND:
        by_max = lrb_mul_ps_s3(c, s->far_rcp[axis], planes[1]);
        return lrb_mask_mul_ps_s3(c, by_max, s->negative[axis], s->far_rcp[axis], planes[0]);
    case SLAB16_ZERO:
        by_min = lrb_mul_ps_s3(c, s->far_rcp[axis], planes[0]);
        by_max = lrb_mul_ps_s3(c, s->far_rcp[axis], planes[1]);
        return lrb_mask_max_ps(c, lrb_mov_ps(c, s->infinity), s->strict[axis], by_min, by_max);
    }
    return s->infinity;
}

/**
 * Test one box of the pair in scratch.
 *
 * @param path    a constant, equal to s->path, so that each path is code of its own
 * @param second  0 or 32: which box of the pair
 * @param m       lanes to test
 * @param entry   out: entry distances, at least 0
 *
 * Returns the lanes of m that meet the box. 13 ops on the common path, as Benthin and Wald's appendix A; six more if the lanes have
 * origins of their own.
 */
LRB_INLINE lrb_k16 slab16_test(lrb_ctx *c, const slab16 *s, slab16_path path, lrb_ptr scratch, int second, lrb_k16 m, lrb_v16f *entry)
{
    lrb_v16f e = s->zero, x = s->limit;
    for (int axis = 0; axis < 3; axis++) {
        lrb_s3f planes[2];
        slab16_planes(c, s, path, scratch, axis, second, planes);
        lrb_v16f axis_entry = slab16_entry(c, s, path, planes, axis);
        e = axis ? lrb_max_ps(c, e, axis_entry) : axis_entry;
        lrb_v16f axis_exit = slab16_exit(c, s, path, planes, axis);
        x = axis ? lrb_min_ps(c, x, axis_exit) : axis_exit;
    }
    e = lrb_max_ps(c, e, s->zero);
    x = lrb_min_ps(c, x, s->limit);
    *entry = e;
    return lrb_mask_cmple_ps(c, m, e, x);
}

#endif
