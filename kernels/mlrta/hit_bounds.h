/* Bounds of the rays from a point light to the hits of a 16x16 tile, in the form that tile_bounds.h leaves: ranges over the rays
 * themselves (Reshetov, Soupikov and Hurley 2005, 5). Slopes of quotients, not quotients of ranges.
 */
#ifndef KERNELS_MLRTA_HIT_BOUNDS_H
#define KERNELS_MLRTA_HIT_BOUNDS_H

#include "kernels/mlrta/hard_shadow.h"
#include "kernels/mlrta/tile_bounds.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_HIT_BOUNDS

/* Ranges over the rays so far, by lane: the largest of each; what is wanted the least of is negated. */
typedef struct hit_ranges {
    lrb_v16f farthest[3][3], nearest[3][3]; /* [k][u]: slopes d_u / d_k; those of an axis by itself are not used */
    lrb_v16f most[3], least[3];             /* reciprocals */
    lrb_r64 minus, plus;                    /* bit 16 axis + lane: some ray goes down, or up; as masks they would be too many */
} hit_ranges;

/* The bits of one axis in `minus` and `plus`. */
#define HIT_SIGNS(axis) lrb_imm(UINT64_C(0xffff) << 16 * (axis))

LRB_INLINE lrb_r64 hit_signs_add(lrb_ctx *c, lrb_r64 signs, int axis, lrb_k16 m)
{
    lrb_r64 lanes = lrb_kmov_rk(c, m);
    if (axis)
        lanes = lrb_shl(c, lanes, 16u * (unsigned)axis);
    return lrb_or(c, signs, lanes);
}

/* Add the rays of one block; false if one has no strict sign. */
LRB_INLINE bool hit_ranges_add(lrb_ctx *c, const hard_shadow *h, const kd16 *k, lrb_v16f zero, lrb_k16 alive, hit_ranges *r)
{
    lrb_v16f small[3], large[3];
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, slack));
    lrb_k16 loose = lrb_mask(0);
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f d = lrb_load_ps(c, lrb_at(h->rays, 64 * axis));
        lrb_k16 minus = lrb_mask_cmplt_ps(c, alive, d, zero);
        r->minus = hit_signs_add(c, r->minus, axis, minus);
        lrb_k16 plus = lrb_kxor(c, alive, minus);
        r->plus = hit_signs_add(c, r->plus, axis, plus);
        d = lrb_mask_sub_ps(c, d, minus, zero, d);
        small[axis] = lrb_sub_ps(c, d, slack);
        large[axis] = lrb_add_ps(c, d, slack);
        loose = lrb_kor(c, loose, lrb_mask_cmple_ps_s3(c, alive, small[axis], lrb_1to16_ps(RAYS16_CONSTANT(k->constants, tiny))));
    }
    if (lrb_jnz(c, lrb_kortest(c, loose, loose)))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f most = rays16_reciprocal(c, small[axis]);
        lrb_v16f minus_least = lrb_sub_ps(c, zero, rays16_reciprocal(c, large[axis]));
        r->most[axis] = lrb_mask_max_ps(c, r->most[axis], alive, r->most[axis], most);
        r->least[axis] = lrb_mask_max_ps(c, r->least[axis], alive, r->least[axis], minus_least);
        for (int u = 0; u < 3; u++) {
            if (u == axis)
                continue;
            lrb_v16f slope = lrb_mul_ps(c, large[u], most);
            r->farthest[axis][u] = lrb_mask_max_ps(c, r->farthest[axis][u], alive, r->farthest[axis][u], slope);
            slope = lrb_mul_ps(c, small[u], minus_least);
            r->nearest[axis][u] = lrb_mask_max_ps(c, r->nearest[axis][u], alive, r->nearest[axis][u], slope);
        }
    }
    return true;
}

/* Word `word` of `old` becomes the largest lane of v, and word `second` that of w. */
LRB_INLINE lrb_v16f hit_words(lrb_ctx *c, lrb_v16f old, unsigned word, lrb_v16f v, unsigned second, lrb_v16f w)
{
    lrb_v16f both = kd16_largest(c, v, w);
    old = lrb_mask_mov_ps_s3(c, old, lrb_mask(1u << word), lrb_swizzle_ps(both, LRB_AAAA));
    return lrb_mask_mov_ps_s3(c, old, lrb_mask(1u << second), lrb_swizzle_ps(both, LRB_BBBB));
}

/* The row of one axis. */
LRB_INLINE void hit_row(lrb_ctx *c, const kd16 *k, int axis, lrb_v16f zero, const hit_ranges *r)
{
    lrb_ptr row = lrb_lea(c, k->scratch, lrb_imm(0), 1, ENTRY_ROWS + 64 * axis);
    const unsigned u = (unsigned)(axis + 1) % 3, v = (unsigned)(axis + 2) % 3;
    lrb_v16f factors = lrb_load_ps(c, KD16_CELLS(k->cells, signs)); /* of the axis itself, and of word 3 */
    factors = hit_words(c, factors, u, r->farthest[axis][u], 4 + u, r->nearest[axis][u]);
    factors = hit_words(c, factors, v, r->farthest[axis][v], 4 + v, r->nearest[axis][v]);
    factors = hit_words(c, factors, 7, r->least[axis], 7, r->least[axis]);
    lrb_r64 nearer = lrb_imm(0);
    if (lrb_jnz(c, lrb_test(c, r->minus, HIT_SIGNS(axis)))) {
        factors = lrb_sub_ps(c, zero, factors);
        nearer = lrb_imm(sizeof(kdtree_node));
    }
    lrb_store_ps(c, TILE_ROW(row, factors), factors);
    lrb_store32(c, TILE_ROW(row, origin), lrb_load32(c, RAYS16_CONSTANT(k->constants, origin_box[axis])));
    lrb_store32(c, TILE_ROW(row, nearer), nearer);
}

/* Rows, reciprocals and signs from the ranges of all rays; false if their signs differ. */
LRB_INLINE bool hit_bounds_store(lrb_ctx *c, const kd16 *k, lrb_v16f zero, const hit_ranges *r, tile_bounds *out)
{
    lrb_v16f least = lrb_load_1to16_ps(c, KD16_CELLS(k->cells, signs)), most = least;
    out->negative = lrb_mask(0);
    for (int axis = 0; axis < 3; axis++) {
        if (lrb_jnz(c, lrb_test(c, r->minus, HIT_SIGNS(axis)))) {
            if (lrb_jnz(c, lrb_test(c, r->plus, HIT_SIGNS(axis))))
                return false;
            out->negative = lrb_kor(c, out->negative, lrb_mask(0x11u << axis));
        }
        hit_row(c, k, axis, zero, r);
        lrb_v16f both = kd16_largest(c, r->most[axis], r->least[axis]);
        most = lrb_mask_mov_ps_s3(c, most, lrb_mask(0x11u << axis), lrb_swizzle_ps(both, LRB_AAAA));
        least = lrb_mask_sub_ps_s3(c, least, lrb_mask(0x11u << axis), zero, lrb_swizzle_ps(both, LRB_BBBB));
    }
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_LEAST), least);
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_MOST), most);
    return true;
}

/* No rays yet. */
LRB_INLINE hit_ranges hit_ranges_none(lrb_v16f lowest)
{
    hit_ranges r = {.minus = lrb_imm(0), .plus = lrb_imm(0)};
    for (int k = 0; k < 3; k++) {
        for (int u = 0; u < 3; u++)
            r.farthest[k][u] = r.nearest[k][u] = lowest;
        r.most[k] = r.least[k] = lowest;
    }
    return r;
}

/**
 * Leave the bounds of a tile's rays from the light in scratch; `h` is at its first block.
 *
 * Returns false if they differ in sign, or have none.
 */
LRB_INLINE bool hit_bounds_setup(lrb_ctx *c, hard_shadow h, const kd16 *k, tile_bounds *out)
{
    lrb_v16f lowest = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel));
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(lowest), lrb_castps_pi(lowest)));
    hit_ranges r = hit_ranges_none(lowest);
    do {
        lrb_k16 alive = lrb_kmov_kr(c, lrb_load32(c, HARD_WORD(&h, HARD_ALIVE)));
        if (lrb_jz(c, lrb_kortest(c, alive, alive)))
            continue;
        if (!hit_ranges_add(c, &h, k, zero, alive, &r)) /* its own branch */
            return false;
    } while (hard_shadow_next(c, &h, k));
    return hit_bounds_store(c, k, zero, &r, out);
}

#endif
