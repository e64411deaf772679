/* packet256-soft: soft shadows in groups of 16 packets, one a hit point, Benthin and Wald 2009, 5.2 (docs/kernels.md). */
#include "kernels/mft/group_soft.h"
#include "kernels/tile_function.h"

extern kernel_tile_fn KERNEL_TILE_FN(packet256_primary), KERNEL_TILE_FN(visibility_filter);

LRB_INLINE void packet256_soft_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    if (tile >= kernel_job_first_pass(job)) {
        KERNEL_TILE_FN(visibility_filter)(c, job, tile - kernel_job_first_pass(job), n);
        return;
    }
    KERNEL_TILE_FN(packet256_primary)(c, job, tile, n);
    group_soft_tile(c, job, tile, n, true);
}

KERNEL_TILE_FUNCTION(packet256_soft, packet256_soft_tile)
