/* Two other ways to tell which cells a tile's rays reach, for comparison with conditions (1) and (2) of entry_search.h.
 *
 * Direct culling: a cell is out of reach if it lies outside one of the four planes through neighbouring corner rays (Reshetov, Soupikov
 * and Hurley 2005, figure 3). What lies behind the apex is not, so a nearer child is also dropped if the plane is behind
 * the origin. Corner rays: a cell is entered if a corner ray enters it. That is not sound: a ray between them may enter a
 * cell that none of the corner rays does (figure 2).
 */
#ifndef KERNELS_MLRTA_ENTRY_CULL_H
#define KERNELS_MLRTA_ENTRY_CULL_H

#include "kernels/mlrta/tile_bounds.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_ENTRY_CULL

/* Sum over the first three groups of four, in all groups: in one order, so that its rounding, and its sign, is the same in all. */
LRB_INLINE lrb_v16f entry_axes_sum(lrb_ctx *c, lrb_v16f v)
{
    lrb_v16f sum = lrb_shuf128x32_ps(c, v, 0x00, LRB_DCBA);
    sum = lrb_add_ps(c, sum, lrb_shuf128x32_ps(c, v, 0x55, LRB_DCBA));
    return lrb_add_ps(c, sum, lrb_shuf128x32_ps(c, v, 0xaa, LRB_DCBA));
}

/*
 * Leave the four planes in scratch, as factors of the six words of a cell: of the vertex that lies farthest in. A normal is tilted outwards
 * by twice the widening of the rays and by the rounding of its cross product, along all axes: the rays' components are positive
 * and add up to at least 1.
 */
LRB_INLINE void entry_planes_setup(lrb_ctx *c, const kd16 *k)
{
    lrb_v16f rays = lrb_load_ps(c, lrb_at(k->scratch, ENTRY_CORNERS));
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(rays), lrb_castps_pi(rays)));
    lrb_v16f from = lrb_shuf128x32_ps(c, rays, 0xe4, 0xb4); /* corners 0 1 3 2, once around */
    lrb_v16f to = lrb_shuf128x32_ps(c, rays, 0xe4, 0x2d);   /* 1 3 2 0 */
    lrb_v16f inner = lrb_shuf128x32_ps(c, rays, 0xe4, 0x4b); /* 3 2 0 1 */
    lrb_v16f to_third = lrb_shuf128x32_ps(c, to, 0xd2, LRB_DCBA);
    lrb_v16f to_second = lrb_shuf128x32_ps(c, to, 0xc9, LRB_DCBA);
    lrb_v16f normal = lrb_mul_ps(c, lrb_shuf128x32_ps(c, from, 0xc9, LRB_DCBA), to_third);
    normal = lrb_msubr231_ps(c, normal, lrb_shuf128x32_ps(c, from, 0xd2, LRB_DCBA), to_second);
    lrb_k16 inwards = lrb_cmplt_ps(c, zero, entry_axes_sum(c, lrb_mul_ps(c, normal, inner)));
    normal = lrb_mask_sub_ps(c, normal, inwards, zero, normal);
    lrb_v16i bits = lrb_and_pi_s3(c, lrb_castps_pi(normal), lrb_full_pi(RAYS16_CONSTANT(k->constants, absolute)));
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, slack));
    lrb_v16f tilt = lrb_load_1to16_ps(c, KD16_CELLS(k->cells, plane_error));
    lrb_v16f span = entry_axes_sum(c, lrb_castpi_ps(bits));
    tilt = lrb_madd231_ps(c, tilt, lrb_add_ps(c, slack, slack), span);
    normal = lrb_sub_ps(c, normal, tilt);
    lrb_v16f low = lrb_max_ps(c, normal, zero);
    lrb_v16f high = lrb_max_ps(c, lrb_sub_ps(c, zero, normal), zero);
    for (int axis = 0; axis < 3; axis++) {
        lrb_store_ps(c, lrb_at(k->scratch, ENTRY_PLANES + 64 * axis), lrb_shuf128x32_ps(c, low, 0x55 * (unsigned)axis, LRB_DCBA));
        lrb_store_ps(c, lrb_at(k->scratch, ENTRY_PLANES + 192 + 64 * axis), lrb_shuf128x32_ps(c, high, 0x55 * (unsigned)axis, LRB_DCBA));
    }
}

/* Leave the reciprocals of the corner rays in scratch, by axis. */
LRB_INLINE void entry_rays_setup(lrb_ctx *c, const kd16 *k)
{
    lrb_v16f reciprocal = rays16_reciprocal(c, lrb_load_ps(c, lrb_at(k->scratch, ENTRY_CORNERS)));
    for (int axis = 0; axis < 3; axis++)
        lrb_store_ps(c, lrb_at(k->scratch, ENTRY_PLANES + 64 * axis), lrb_shuf128x32_ps(c, reciprocal, 0x55 * (unsigned)axis, LRB_DCBA));
}

/* Whether no plane has the whole cell outside. */
LRB_INLINE bool entry_between_planes(lrb_ctx *c, const kd16 *k, lrb_v16f cell)
{
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_v16f sum = zero;
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CELL), cell);
    for (int i = 0; i < 6; i++) {
        lrb_v16f factor = lrb_load_ps(c, lrb_at(k->scratch, ENTRY_PLANES + 64 * i));
        sum = lrb_madd231_ps_s3(c, sum, factor, lrb_1to16_ps(lrb_at(k->scratch, ENTRY_CELL + 4 * (i + i / 3))));
    }
    lrb_k16 outside = lrb_cmplt_ps(c, zero, sum);
    return lrb_jz(c, lrb_kortest(c, outside, outside));
}

/* Whether a corner ray enters the cell. */
LRB_INLINE bool entry_corner_enters(lrb_ctx *c, const kd16 *k, lrb_v16f cell)
{
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_v16f entry = zero, minus_exit = zero;
    lrb_store_ps(c, lrb_at(k->scratch, ENTRY_CELL), cell);
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f reciprocal = lrb_load_ps(c, lrb_at(k->scratch, ENTRY_PLANES + 64 * axis));
        entry = lrb_max_ps(c, entry, lrb_mul_ps_s3(c, reciprocal, lrb_1to16_ps(lrb_at(k->scratch, ENTRY_CELL + 4 * axis))));
        lrb_v16f leaves = lrb_mul_ps_s3(c, reciprocal, lrb_1to16_ps(lrb_at(k->scratch, ENTRY_CELL + 16 + 4 * axis)));
        minus_exit = axis == 0 ? leaves : lrb_max_ps(c, minus_exit, leaves);
    }
    lrb_k16 enters = lrb_cmple_ps(c, entry, lrb_sub_ps(c, zero, minus_exit));
    return lrb_jnz(c, lrb_kortest(c, enters, enters));
}

#endif
