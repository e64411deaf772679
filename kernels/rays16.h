/* Primary rays of a tile: first rays of its 16 blocks, in lanes; the others follow by adding the block's 16 deltas.
 *
 * Benthin and Wald 2009, 4.4: rays are not stored; ray j of block f is corner[f] + delta[j], the same float operation in
 * every kernel, so all kernels trace the same bits (docs/kernels.md).
 */
#ifndef KERNELS_RAYS16_H
#define KERNELS_RAYS16_H

#include <stddef.h>

#include "kernels/kernel.h"
#include "lrbni/lrbni.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_RAYS

/* Memory operand of a field of the job's constants. */
#define RAYS16_CONSTANT(constants, field) lrb_at(constants, (int32_t)offsetof(job_constants, field))

/** Directions of pixel 0 of the 16 blocks of a tile: corner[axis], lane = block. */
LRB_INLINE void rays16_corners(lrb_ctx *c, lrb_ptr constants, lrb_ptr tile, lrb_v16f corner[3])
{
    lrb_v16f x = lrb_load_ps(c, RAYS16_CONSTANT(constants, block_x));
    lrb_v16f y = lrb_load_ps(c, RAYS16_CONSTANT(constants, block_y));
    x = lrb_add_ps_s3(c, x, lrb_1to16_ps(lrb_at(tile, (int32_t)offsetof(job_tile, x))));
    y = lrb_add_ps_s3(c, y, lrb_1to16_ps(lrb_at(tile, (int32_t)offsetof(job_tile, y))));
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f d = lrb_load_1to16_ps(c, RAYS16_CONSTANT(constants, d00[axis]));
        d = lrb_madd231_ps_s3(c, d, x, lrb_1to16_ps(RAYS16_CONSTANT(constants, dx[axis])));
        corner[axis] = lrb_madd231_ps_s3(c, d, y, lrb_1to16_ps(RAYS16_CONSTANT(constants, dy[axis])));
    }
}

/** 1/x by the machine's estimate and two Newton steps: relative error below 2^-22. */
LRB_INLINE lrb_v16f rays16_reciprocal(lrb_ctx *c, lrb_v16f x)
{
    lrb_v16f r = lrb_rcpres_ps(c, x);
    r = lrb_rcprefine_ps(c, r, x);
    return lrb_rcprefine_ps(c, r, x);
}

#endif
