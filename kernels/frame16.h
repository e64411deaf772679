/* A block's results in the frame: the nearest hits of its 16 rays, a line each of distances, weights and triangles.
 *
 * Lines of the frame are written once and were not there before. A store that misses makes its thread wait, because a thread of
 * these machines has one demand miss under way (docs/machine-model.md); so kernels ask for the lines long before they write them.
 */
#ifndef KERNELS_FRAME16_H
#define KERNELS_FRAME16_H

#include "kernels/kernel.h"
#include "lrbni/lrbni.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_FRAME

/** Ask for the lines of a block's results. `block`: a job_frame_tile and 64 bytes for each block before it. */
LRB_INLINE void frame16_prefetch(lrb_ctx *c, lrb_ptr block)
{
    lrb_prefetch1_ex(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, t)));
    lrb_prefetch1_ex(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, u)));
    lrb_prefetch1_ex(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, v)));
    lrb_prefetch1_ex(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, id)));
}

/** Write a block's results. */
LRB_INLINE void frame16_store(lrb_ctx *c, lrb_ptr block, lrb_v16f t, lrb_v16f u, lrb_v16f v, lrb_v16i id)
{
    lrb_store_ps(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, t)), t);
    lrb_store_ps(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, u)), u);
    lrb_store_ps(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, v)), v);
    lrb_store_pi(c, lrb_at(block, (int32_t)offsetof(job_frame_tile, id)), id);
}

#endif
