/* Blocks of 4x4 primary rays through the kd-tree: what kd16-primary does for all of a tile, mlrta-primary for parts of one. */
#ifndef KERNELS_MLRTA_KD16_TILE_H
#define KERNELS_MLRTA_KD16_TILE_H

#include "kernels/frame16.h"
#include "kernels/mlrta/kd16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_KD16_TILE

/** Once per unit of work: what the rows say of the origin, which no packet changes. */
LRB_INLINE void kd16_begin(lrb_ctx *c, kd16 *k)
{
    lrb_phase(c, KERNEL_PHASE_SETUP);
    k->origin = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, origin_triangle));
    for (int axis = 0; axis < 3; axis++) {
        lrb_r64 origin = lrb_load32(c, RAYS16_CONSTANT(k->constants, origin_box[axis]));
        lrb_store32(c, lrb_at(k->scratch, KD_ROWS + 64 * axis + (int32_t)offsetof(kd16_row, origin)), origin);
    }
}

/* No hits yet; the pixels outside the image are never hit. */
LRB_INLINE void kd16_no_hits(lrb_ctx *c, kd16 *k, slab16 *s, lrb_k16 active)
{
    s->limit = lrb_mask_mov_ps(c, lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel)), active, s->infinity);
    k->u = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(s->infinity), lrb_castps_pi(s->infinity)));
    k->v = lrb_mov_ps(c, k->u);
    k->id = lrb_load_1to16_pi(c, RAYS16_CONSTANT(k->constants, no_hit));
}

/* The packet of a block: its hits come back in *s and *k. Where there is nothing to be hit no ray is made. */
LRB_INLINE void kd16_packet(lrb_ctx *c, kd16 *k, slab16 *s, lrb_ptr corner, lrb_r64 start, bool nothing, lrb_k16 active)
{
    if (nothing) {
        s->infinity = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, infinity));
        kd16_no_hits(c, k, s, active);
        return;
    }
    lrb_v16f lo[3], hi[3];
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f delta = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, delta[axis]));
        k->d[axis] = lrb_add_ps_s3(c, delta, lrb_1to16_ps(lrb_at(corner, 64 * axis)));
        lo[axis] = hi[axis] = k->d[axis];
    }
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, slack));
    slab16_setup(c, s, k->constants, k->scratch, slack, active, lo, hi, k->n);
    kd16_no_hits(c, k, s, active);
    kd16_trace(c, k, s, start, active);
    lrb_phase(c, KERNEL_PHASE_SETUP);
}

/* Sixteenth of the unit of work that a block lies in, for the heat map. */
LRB_INLINE uint32_t kd16_region(const kd16 *k, uint32_t block)
{
    uint32_t x = (k->tile_x * 4 + block % 4) >> k->unit_log2, y = (k->tile_y * 4 + block / 4) >> k->unit_log2;
    return y * 4 + x;
}

/**
 * Trace blocks of a 16x16 tile from a node of the tree, whose cell, less the origin, is the box in scratch.
 *
 * @param tile     its job_tile
 * @param frame    its job_frame_tile
 * @param start    where the node's offset is in scratch; NULL: the root
 * @param nothing  no ray of these blocks can hit anything
 * @param blocks   bit f: block f is traced; those outside the image are left out
 */
LRB_INLINE void kd16_blocks(lrb_ctx *c, kd16 *k, lrb_ptr tile, lrb_ptr frame, const lrb_mem *start, bool nothing, lrb_r64 blocks)
{
    lrb_v16f first_rays[3];
    slab16 s = {.own_origins = false};
    lrb_phase(c, KERNEL_PHASE_SETUP);
    if (!nothing) {
        rays16_corners(c, k->constants, tile, first_rays);
        for (int axis = 0; axis < 3; axis++)
            lrb_store_ps(c, lrb_at(k->scratch, SCRATCH_CORNERS + 64 * axis), first_rays[axis]);
    }
    blocks = lrb_and(c, blocks, lrb_load32(c, lrb_at(tile, (int32_t)offsetof(job_tile, blocks))));
    lrb_r64 block = lrb_bsff(c, blocks);
    while (!lrb_jl(c, lrb_test(c, block, block))) {
        lrb_region(c, kd16_region(k, (uint32_t)block.value));
        lrb_k16 active = lrb_kmov_kr(c, lrb_load16(c, lrb_at_index(tile, block, 2, (int32_t)offsetof(job_tile, pixels))));
        k->n->n[KERNEL_units_packets]++;
        k->n->n[KERNEL_rays] += (unsigned)__builtin_popcount(active.bits);
        k->n->n[KERNEL_rays_primary] += (unsigned)__builtin_popcount(active.bits);
        lrb_ptr block_frame = lrb_lea(c, frame, lrb_shl(c, block, 6), 1, 0);
        frame16_prefetch(c, block_frame);
        const lrb_r64 root = start ? lrb_load32(c, *start) : lrb_imm(0);
        kd16_packet(c, k, &s, lrb_lea(c, k->scratch, block, 4, SCRATCH_CORNERS), root, nothing, active);
        frame16_store(c, block_frame, s.limit, k->u, k->v, k->id);
        block = lrb_bsfi(c, block, blocks);
    }
    lrb_region(c, LRB_WHOLE_TILE);
}

#endif
