/* The simple shader of primary rays: Lambert's law with a light at the eye, on the nearest hits in the frame, lane = pixel of a 4x4
 * block (Reshetov, Soupikov and Hurley 2005, Table 1; docs/kernels.md).
 *
 * It runs over a tile once its rays are traced, when their hits are still in the cache, and so is the same for all kernels: rays are
 * made again, by one addition an axis, from the corners that the tracer left in scratch.
 */
#ifndef KERNELS_SHADE16_H
#define KERNELS_SHADE16_H

#include "kernels/shadow16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_SHADE

/* What the light at the eye lends a block's hits: |n.d| / |d|. A surface is lit on the side that is seen. */
LRB_INLINE lrb_v16f shade16_cosine(lrb_ctx *c, const shadow16 *w, lrb_ptr frame, lrb_k16 hits, lrb_v16f zero)
{
    lrb_v16f n[3], cosine = zero, square = zero;
    lrb_ptr first = lrb_lea(c, w->scratch, w->block, 4, SCRATCH_CORNERS);
    shadow16_normals(c, w, frame, hits, zero, n);
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f d = lrb_load_ps(c, RAYS16_CONSTANT(w->constants, delta[axis]));
        d = lrb_add_ps_s3(c, d, lrb_1to16_ps(lrb_at(first, 64 * axis)));
        cosine = axis ? lrb_madd231_ps(c, cosine, n[axis], d) : lrb_mul_ps(c, n[axis], d);
        square = axis ? lrb_madd231_ps(c, square, d, d) : lrb_mul_ps(c, d, d);
    }
    square = lrb_max_ps_s3(c, square, lrb_1to16_ps(RAYS16_CONSTANT(w->constants, tiny)));
    cosine = lrb_max_ps(c, cosine, lrb_sub_ps(c, zero, cosine));
    lrb_v16f scale = shadow16_rsqrt(c, RAYS16_CONSTANT(w->constants, half), square);
    return lrb_mask_mul_ps(c, zero, hits, cosine, scale);
}

LRB_INLINE void shade16_block(lrb_ctx *c, const shadow16 *w, lrb_ptr shades)
{
    lrb_r64 line = lrb_shl(c, w->block, 6);
    lrb_ptr frame = lrb_lea(c, w->frame, line, 1, 0);
    lrb_v16f t = lrb_load_ps(c, lrb_at(frame, (int32_t)offsetof(job_frame_tile, t)));
    lrb_v16f shade = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(t), lrb_castps_pi(t)));
    lrb_k16 hits = lrb_kmov_kr(c, lrb_load16(c, lrb_at_index(w->pixels, w->block, 2, 0)));
    hits = lrb_mask_cmplt_ps_s3(c, hits, t, lrb_full_ps(RAYS16_CONSTANT(w->constants, infinity)));
    if (lrb_jnz(c, lrb_kortest(c, hits, hits)))
        shade = shade16_cosine(c, w, frame, hits, shade);
    lrb_store_ps(c, lrb_at_index(shades, line, 1, 0), shade);
}

_Static_assert(sizeof(job_shade_tile) == 1 << 10, "tiles are addressed by shifts");

/**
 * Shade blocks of a tile that have been traced, if the job has a shader.
 *
 * @param tile    its number in the frame
 * @param blocks  bit f: block f; those outside the image are left out
 */
LRB_INLINE void shade16_tile(lrb_ctx *c, const kernel_job *job, lrb_r64 tile, lrb_r64 blocks)
{
    shadow16 w = {.constants = lrb_segment_at(job->constants, 0), .scratch = lrb_segment_at(c->scratch, 0)};
    if (job->params.shader == KERNEL_SHADER_NONE)
        return;
    lrb_phase(c, KERNEL_PHASE_SHADING);
    w.normals = lrb_segment_at(job->normals, 0);
    w.frame = lrb_lea(c, lrb_segment_at(job->frame, 0), lrb_shl(c, tile, 12), 1, 0);
    lrb_ptr record = lrb_lea(c, lrb_segment_at(job->tiles, 0), lrb_shl(c, tile, 6), 1, 0);
    lrb_ptr shades = lrb_lea(c, lrb_segment_at(job->shades, 0), lrb_shl(c, tile, 10), 1, 0);
    w.pixels = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)offsetof(job_tile, pixels));
    blocks = lrb_and(c, blocks, lrb_load32(c, lrb_at(record, (int32_t)offsetof(job_tile, blocks))));
    w.block = lrb_bsff(c, blocks);
    while (!lrb_jl(c, lrb_test(c, w.block, w.block))) {
        shade16_block(c, &w, shades);
        w.block = lrb_bsfi(c, w.block, blocks);
    }
}

#endif
