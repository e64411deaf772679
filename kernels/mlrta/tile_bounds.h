/* Bounds of all primary rays of a tile, from its four corner rays: Reshetov, Soupikov and Hurley 2005, 3.3 and 4.1.
 *
 * With the common sign of their components taken off, the rays lie between two slopes d_u / d_k for every pair of axes, and between two
 * reciprocals for every axis. A cell is held as the tile's rays see it: near faces less the origin in words 0 to 2, far faces less the
 * origin, negated, in words 4 to 6, word 3 is 0, word 7 minus the largest distance. Then all that is asked of a plane
 * across axis k is one product: the plane's offset from the origin times row k gives, in words 0 to 2, the farthest that a ray
 * can have come along each axis, in words 4 to 6 the least, negated, and both words of axis k are the plane itself
 * (kernels/mlrta/entry_search.h). Rays are thin cones, as in slab16.h.
 */
#ifndef KERNELS_MLRTA_TILE_BOUNDS_H
#define KERNELS_MLRTA_TILE_BOUNDS_H

#include "kernels/mlrta/kd16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_TILE_BOUNDS

/* Row of one axis. */
typedef struct tile_row {
    float factors[8];
    float origin;
    uint32_t nearer; /* offset of the nearer of two siblings: 0 or 8 */
    uint32_t pad[6];
} tile_row;

_Static_assert(sizeof(tile_row) == 64, "a row is a line");

#define TILE_ROW(row, field) lrb_at(row, (int32_t)offsetof(tile_row, field))

/* A square of pixels of the image; x1 and y1 are inside. */
typedef struct tile_pixels {
    lrb_r64 x0, y0, x1, y1;
} tile_pixels;

typedef struct tile_bounds {
    lrb_k16 negative; /* words of a cell that belong to axes along which the rays go down */
} tile_bounds;

/* Directions of the corner rays: lane 4 * axis + corner; corner 1 is to the right of 0, 2 below it. */
LRB_INLINE lrb_v16f tile_corners(lrb_ctx *c, const kd16 *k, const tile_pixels *pixels)
{
    lrb_store32(c, lrb_at(k->scratch, ENTRY_CELL), pixels->x0);
    lrb_store32(c, lrb_at(k->scratch, ENTRY_CELL + 4), pixels->x1);
    lrb_store32(c, lrb_at(k->scratch, ENTRY_CELL + 8), pixels->y0);
    lrb_store32(c, lrb_at(k->scratch, ENTRY_CELL + 12), pixels->y1);
    lrb_v16i words = lrb_load_4to16_pi(c, lrb_at(k->scratch, ENTRY_CELL));
    lrb_v16f edges = lrb_cvtpi2ps(c, words, LRB_RN, LRB_ADJUST_NONE);
    lrb_v16f x = lrb_shuf128x32_ps(c, edges, 0xe4, 0x44); /* x0 x1 x0 x1 */
    lrb_v16f y = lrb_shuf128x32_ps(c, edges, 0xe4, 0xfa); /* y0 y0 y1 y1 */
    lrb_v16f d = lrb_load_ps(c, KD16_CELLS(k->cells, d00));
    d = lrb_madd231_ps_s3(c, d, x, lrb_full_ps(KD16_CELLS(k->cells, dx)));
    return lrb_madd231_ps_s3(c, d, y, lrb_full_ps(KD16_CELLS(k->cells, dy)));
}

/* The largest, or smallest, of each group of four, in all of them. */
LRB_INLINE lrb_v16f tile_largest(lrb_ctx *c, lrb_v16f v)
{
    v = lrb_max_ps_s3(c, v, lrb_swizzle_ps(v, LRB_CDAB));
    return lrb_max_ps_s3(c, v, lrb_swizzle_ps(v, LRB_BADC));
}

LRB_INLINE lrb_v16f tile_smallest(lrb_ctx *c, lrb_v16f v)
{
    v = lrb_min_ps_s3(c, v, lrb_swizzle_ps(v, LRB_CDAB));
    return lrb_min_ps_s3(c, v, lrb_swizzle_ps(v, LRB_BADC));
}

/* Words 0 to 2 of the groups in `groups` of the result: the values of groups 0 to 2, each of which is the same in its lanes. */
LRB_INLINE lrb_v16f tile_words(lrb_ctx *c, lrb_v16f old, unsigned groups, lrb_v16f v)
{
    for (unsigned axis = 0; axis < 3; axis++)
        old = lrb_mask_shuf128x32_ps(c, old, lrb_mask(groups << axis), v, 0x55 * axis, LRB_DCBA);
    return old;
}

/* The row of one axis, from the magnitudes of the corner rays and their reciprocals, least and most. */
LRB_INLINE void tile_row_setup(lrb_ctx *c, const kd16 *k, int axis, lrb_v16f zero, lrb_v16f small, lrb_v16f large, lrb_v16f least,
                               lrb_v16f most, lrb_v16f minus_least, lrb_r64 negative)
{
    const unsigned blocks = 0x55 * (unsigned)axis;
    lrb_ptr row = lrb_lea(c, k->scratch, lrb_imm(0), 1, ENTRY_ROWS + 64 * axis);
    lrb_v16f farthest = tile_largest(c, lrb_mul_ps(c, large, lrb_shuf128x32_ps(c, most, blocks, LRB_DCBA)));
    lrb_v16f nearest = tile_smallest(c, lrb_mul_ps(c, small, lrb_shuf128x32_ps(c, least, blocks, LRB_DCBA)));
    lrb_v16f factors = tile_words(c, farthest, 0x1111, farthest);
    factors = tile_words(c, factors, 0x0010, lrb_sub_ps(c, zero, nearest));
    factors = lrb_mask_shuf128x32_ps(c, factors, lrb_mask(0x0080), minus_least, blocks, LRB_DCBA);
    factors = lrb_mask_mov_ps_s3(c, factors, lrb_mask(0x11u << axis | 8), lrb_full_ps(KD16_CELLS(k->cells, signs)));
    lrb_r64 nearer = lrb_imm(0);
    if (lrb_jnz(c, lrb_test(c, negative, lrb_imm(UINT64_C(1) << 4 * axis)))) {
        factors = lrb_sub_ps(c, zero, factors);
        nearer = lrb_imm(sizeof(kdtree_node));
    }
    lrb_store_ps(c, TILE_ROW(row, factors), factors);
    lrb_store32(c, TILE_ROW(row, origin), lrb_load32(c, RAYS16_CONSTANT(k->constants, origin_box[axis])));
    lrb_store32(c, TILE_ROW(row, nearer), nearer);
}

/* Whether all corner rays have the same strict sign, axis by axis. */
LRB_INLINE bool tile_is_coherent(lrb_ctx *c, const kd16 *k, lrb_v16f small, lrb_k16 minus)
{
    lrb_k16 loose = lrb_mask_cmple_ps_s3(c, lrb_mask(0x0fff), small, lrb_1to16_ps(RAYS16_CONSTANT(k->constants, tiny)));
    if (lrb_jnz(c, lrb_kortest(c, loose, loose)))
        return false;
    lrb_r64 down = lrb_quadmask16(c, lrb_kmov_rk(c, minus));
    lrb_r64 up = lrb_quadmask16(c, lrb_kmov_rk(c, lrb_kxor(c, minus, lrb_mask(0x0fff))));
    return lrb_jz(c, lrb_test(c, down, up));
}

/**
 * Leave the bounds of a tile's rays in scratch.
 *
 * Returns false if the corner rays differ in sign, or have none: such a tile has no bounds.
 */
LRB_INLINE bool tile_bounds_setup(lrb_ctx *c, const kd16 *k, const tile_pixels *pixels, tile_bounds *out)
{
    lrb_v16f d = tile_corners(c, k, pixels);
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, slack));
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(d), lrb_castps_pi(d)));
    lrb_v16i bits = lrb_and_pi_s3(c, lrb_castps_pi(d), lrb_full_pi(RAYS16_CONSTANT(k->constants, absolute)));
    lrb_k16 minus = lrb_mask_cmplt_ps(c, lrb_mask(0x0fff), d, zero);
    lrb_v16f small = lrb_sub_ps(c, lrb_castpi_ps(bits), slack);
    if (!tile_is_coherent(c, k, small, minus)) /* its own branches */
        return false;
    lrb_v16f large = lrb_add_ps(c, lrb_castpi_ps(bits), slack);
    lrb_v16f least = rays16_reciprocal(c, large);
    lrb_v16f most = rays16_reciprocal(c, small);
    lrb_v16f least_of_all = tile_smallest(c, least);
    lrb_v16f minus_least = lrb_sub_ps(c, zero, least_of_all);
    lrb_r64 negative = lrb_kmov_rk(c, minus);
    for (int axis = 0; axis < 3; axis++) {
        tile_row_setup(c, k, axis, zero, small, large, least, most, minus_least, negative);
        lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CORNERS + 64 + 64 * axis), lrb_shuf128x32_ps(c, d, 0x55 * (unsigned)axis, LRB_DCBA));
    }
    lrb_v16f ones = lrb_load_1to16_ps(c, KD16_CELLS(k->cells, signs));
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_LEAST), tile_words(c, ones, 0x1111, least_of_all));
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_MOST), tile_words(c, ones, 0x1111, tile_largest(c, most)));
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CORNERS), lrb_castpi_ps(bits)); /* magnitudes: as the rays see them */
    lrb_r64 words = lrb_and(c, negative, lrb_imm(1)); /* nibbles to words: one bit an axis ... */
    words = lrb_or(c, words, lrb_and(c, lrb_shr(c, negative, 3), lrb_imm(2)));
    words = lrb_or(c, words, lrb_and(c, lrb_shr(c, negative, 6), lrb_imm(4)));
    words = lrb_or(c, words, lrb_shl(c, words, 4)); /* ... for the near face, and one for the far one */
    out->negative = lrb_kmov_kr(c, words);
    return true;
}

/** A cell as seen along the axes, or as the tile's rays see it: each is made of the other. */
LRB_INLINE lrb_v16f tile_turned(lrb_ctx *c, const tile_bounds *b, lrb_v16f cell)
{
    return lrb_mask_shuf128x32_ps(c, cell, b->negative, cell, 0xb1, LRB_DCBA);
}

#endif
