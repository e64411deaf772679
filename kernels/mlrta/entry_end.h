/* Whether no ray of a tile gets past a leaf: a triangle that all of them hit there, or an empty cell inside a closed object that
 * all of them enter. Reshetov, Soupikov and Hurley 2005, 3.4 and 4.1.
 *
 * All rays hit a triangle if its volumes have one sign at the four corner rays and are beyond the rounding of the intersection test
 * (kernels/mft/corner_cull.h): then the test accepts every ray between them. Its distance is told from rounding if neither of the two
 * dot products that make it loses more than three bits. All hits lie in the cell if the corner rays' do, by a margin for their rounding;
 * an axis along which the whole triangle lies in the cell needs no margin.
 */
#ifndef KERNELS_MLRTA_ENTRY_END_H
#define KERNELS_MLRTA_ENTRY_END_H

#include "kernels/mft/corner_cull.h"
#include "kernels/mlrta/tile_bounds.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_ENTRY_END

/* A node, as its offset, and its cell as the tile's rays see it. */
typedef struct entry_place {
    lrb_r64 node;
    lrb_v16f cell;
} entry_place;

/* Whether every ray is in all three pairs of faces at once, somewhere. */
LRB_INLINE bool entry_all_enter(lrb_ctx *c, const kd16 *k, lrb_v16f cell)
{
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_v16f least = lrb_mul_ps_s3(c, cell, lrb_full_ps(lrb_at(k->scratch, ENTRY_LEAST)));
    lrb_v16f most = lrb_mul_ps_s3(c, cell, lrb_full_ps(lrb_at(k->scratch, ENTRY_MOST)));
    lrb_v16f first = tile_largest(c, lrb_max_ps(c, least, most)); /* the latest entry; minus the earliest exit */
    lrb_v16f last = lrb_sub_ps(c, zero, lrb_shuf128x32_ps(c, first, 0xb1, LRB_DCBA));
    lrb_r64 enter = lrb_kmov_rk(c, lrb_cmple_ps(c, first, last));
    return lrb_jnz(c, lrb_test(c, enter, lrb_imm(1)));
}

/* Whether all corner rays have a volume of that sign over edge plane `edge` of triangle16_shared, by more than rounding. */
LRB_INLINE bool entry_all_beside(lrb_ctx *c, const kd16 *k, int edge, bool front, lrb_v16f volume)
{
    int group = triangle16_shared.edge[edge] - SCRATCH_EDGES;
    lrb_k16 m;
    if (front)
        m = lrb_cmplt_ps_s3(c, volume, lrb_1to16_ps(lrb_at(k->scratch, SCRATCH_MINUS_GUARD + group)));
    else
        m = lrb_cmpnle_ps_s3(c, volume, lrb_1to16_ps(lrb_at(k->scratch, SCRATCH_GUARD + group)));
    return lrb_jb(c, lrb_kortest(c, m, m));
}

/* Whether all corner rays pass inside the edge planes in scratch, in front or behind. */
LRB_INLINE bool entry_all_inside(lrb_ctx *c, const kd16 *k, lrb_v16f zero, lrb_v16f edges, const lrb_v16f d[3])
{
    corner_cull_guard(c, k->constants, k->scratch, zero, edges, false);
    lrb_v16f volume = triangle16_edge(c, k->scratch, &triangle16_shared, 0, d);
    bool front = entry_all_beside(c, k, 0, true, volume); /* from here on its branch's side */
    if (!front && (k->cull || !entry_all_beside(c, k, 0, false, volume)))
        return false;
    volume = triangle16_edge(c, k->scratch, &triangle16_shared, 1, d);
    if (!entry_all_beside(c, k, 1, front, volume))
        return false;
    volume = triangle16_edge(c, k->scratch, &triangle16_shared, 2, d);
    return entry_all_beside(c, k, 2, front, volume);
}

/* Lanes in which |sum| is at least an eighth of `magnitude`, the sum of the magnitudes of its terms. */
LRB_INLINE lrb_k16 entry_is_sharp(lrb_ctx *c, const kd16 *k, lrb_v16f sum, lrb_v16f magnitude)
{
    lrb_v16i bits = lrb_and_pi_s3(c, lrb_castps_pi(sum), lrb_full_pi(RAYS16_CONSTANT(k->constants, absolute)));
    lrb_v16f least = lrb_mul_ps_s3(c, magnitude, lrb_1to16_ps(KD16_CELLS(k->cells, eighth)));
    return lrb_cmple_ps(c, least, lrb_castpi_ps(bits));
}

LRB_INLINE lrb_v16f entry_magnitude(lrb_ctx *c, const kd16 *k, lrb_v16f v)
{
    return lrb_castpi_ps(lrb_and_pi_s3(c, lrb_castps_pi(v), lrb_full_pi(RAYS16_CONSTANT(k->constants, absolute))));
}

/* Distances of the corner rays' hits; false if one is not positive, or not sharp. `from`: the vertices and the normal, less the origin. */
LRB_INLINE bool entry_distances(lrb_ctx *c, const kd16 *k, lrb_v16f zero, lrb_ptr record, lrb_v16f from, const lrb_v16f d[3], lrb_v16f *t)
{
    const int32_t normal = (int32_t)offsetof(bvh_triangle, normal);
    lrb_v16f product = lrb_mul_ps_s3(c, d[0], lrb_1to16_ps(lrb_at(record, normal)));
    lrb_v16f det = product, magnitude = entry_magnitude(c, k, product);
    for (int axis = 1; axis < 3; axis++) {
        product = lrb_mul_ps_s3(c, d[axis], lrb_1to16_ps(lrb_at(record, normal + 4 * axis)));
        det = lrb_add_ps(c, det, product);
        magnitude = lrb_add_ps(c, magnitude, entry_magnitude(c, k, product));
    }
    *t = lrb_mul_ps_s3(c, rays16_reciprocal(c, det), lrb_1to16_ps(lrb_at(k->scratch, SCRATCH_PLANE)));
    lrb_k16 good = lrb_mask_cmplt_ps(c, entry_is_sharp(c, k, det, magnitude), zero, *t);
    product = lrb_mul_ps(c, from, lrb_shuf128x32_ps(c, from, 0xff, LRB_DCBA));
    lrb_v16f sum = triangle16_group_sum(c, product);
    magnitude = triangle16_group_sum(c, entry_magnitude(c, k, product));
    lrb_k16 sharp = lrb_kor(c, entry_is_sharp(c, k, sum, magnitude), lrb_mask(0xf000)); /* the last group is the normal's */
    good = lrb_kand(c, good, sharp);
    return lrb_jb(c, lrb_kortest(c, good, good));
}

/* Axes along which the whole triangle lies in the cell that is in scratch as seen along the axes: four bits each. */
LRB_INLINE lrb_k16 entry_axes_inside(lrb_ctx *c, const kd16 *k, lrb_v16f zero, lrb_v16f from)
{
    lrb_v16f minus = lrb_sub_ps(c, zero, from);
    lrb_v16f low = lrb_load_4to16_ps(c, lrb_at(k->scratch, ENTRY_CELL));
    lrb_v16f minus_high = lrb_load_4to16_ps(c, lrb_at(k->scratch, ENTRY_CELL + 16));
    lrb_k16 inside = lrb_mask_cmple_ps(c, lrb_cmple_ps(c, low, from), minus_high, minus);
    lrb_r64 bits = lrb_kmov_rk(c, inside);
    lrb_r64 axes = lrb_and(c, bits, lrb_shr(c, bits, 4));
    axes = lrb_and(c, axes, lrb_shr(c, bits, 8));
    axes = lrb_and(c, axes, lrb_imm(7));
    lrb_r64 spread = lrb_or(c, axes, lrb_shl(c, axes, 3));
    spread = lrb_or(c, spread, lrb_shl(c, axes, 6));
    spread = lrb_and(c, spread, lrb_imm(0x111));
    return lrb_kmov_kr(c, lrb_imul(c, spread, lrb_imm(0xf)));
}

/* Whether the corner rays at distances t are inside the cell, by a margin, along all axes but those of `inside`. */
LRB_INLINE bool entry_hits_inside(lrb_ctx *c, const kd16 *k, lrb_v16f zero, lrb_v16f cell, lrb_v16f t, lrb_k16 inside)
{
    lrb_v16f near_face = zero, far_face = zero;
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CELL), cell);
    for (int axis = 0; axis < 3; axis++) {
        lrb_k16 group = lrb_mask(0xfu << 4 * axis);
        near_face = lrb_mask_load_1to16_ps(c, near_face, group, lrb_at(k->scratch, ENTRY_CELL + 4 * axis));
        far_face = lrb_mask_load_1to16_ps(c, far_face, group, lrb_at(k->scratch, ENTRY_CELL + 16 + 4 * axis));
    }
    lrb_v16f at = lrb_mul_ps_s3(c, t, lrb_full_ps(lrb_at(k->scratch, ENTRY_CORNERS)));
    lrb_v16f margin = lrb_mul_ps_s3(c, at, lrb_1to16_ps(KD16_CELLS(k->cells, margin)));
    lrb_v16f early = lrb_sub_ps(c, at, margin);
    lrb_v16f late = lrb_add_ps(c, at, margin);
    lrb_k16 good = lrb_cmple_ps(c, near_face, early);
    good = lrb_mask_cmple_ps(c, good, late, lrb_sub_ps(c, zero, far_face));
    good = lrb_kor(c, good, inside);
    good = lrb_kor(c, good, lrb_mask(0xf000));
    return lrb_jb(c, lrb_kortest(c, good, good));
}

/* Whether all rays of the tile hit the triangle, in the cell. */
LRB_INLINE bool entry_triangle_ends(lrb_ctx *c, const kd16 *k, const tile_bounds *b, lrb_v16f cell, lrb_ptr record)
{
    lrb_v16f edges, d[3], t;
    k->n->n[KERNEL_end_tests]++;
    if (!triangle16_setup(c, k->scratch, k->origin, record, k->cull, &edges))
        return false;
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(edges), lrb_castps_pi(edges)));
    for (int axis = 0; axis < 3; axis++)
        d[axis] = lrb_load_ps(c, lrb_at(k->scratch, ENTRY_CORNERS + 64 + 64 * axis));
    if (!entry_all_inside(c, k, zero, edges, d))
        return false;
    lrb_v16f from = lrb_subr_ps_s3(c, k->origin, lrb_full_ps(lrb_at(record, 0)));
    if (!entry_distances(c, k, zero, record, from, d, &t))
        return false;
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CELL), tile_turned(c, b, cell));
    lrb_k16 inside = entry_axes_inside(c, k, zero, from);
    if (!entry_hits_inside(c, k, zero, cell, t, inside))
        return false;
    k->n->n[KERNEL_end_hits]++;
    return true;
}

/* Whether a triangle of the leaf is hit by all rays of the tile, in its cell. */
LRB_INLINE bool entry_ends(lrb_ctx *c, const kd16 *k, const tile_bounds *b, const entry_place *leaf)
{
    lrb_r64 link = lrb_load32(c, lrb_at_index(k->nodes, leaf->node, 1, (int32_t)offsetof(kdtree_node, link)));
    lrb_r64 bytes = lrb_load32(c, lrb_at_index(k->nodes, leaf->node, 1, (int32_t)offsetof(kdtree_node, extent)));
    bytes = lrb_and(c, bytes, lrb_imm(~(uint64_t)KDTREE_KIND));
    lrb_ptr entry = lrb_lea(c, k->lists, link, 1, -KDTREE_LEAF);
    lrb_ptr end = lrb_lea(c, entry, bytes, 1, 0);
    do {
        if (entry_triangle_ends(c, k, b, leaf->cell, lrb_lea(c, k->records, lrb_load32(c, lrb_at(entry, 0)), 1, 0)))
            return true;
        entry = lrb_lea(c, entry, lrb_imm(0), 1, 4);
    } while (lrb_jb(c, lrb_cmp_ptr(c, entry, end)));
    return false;
}

#endif
