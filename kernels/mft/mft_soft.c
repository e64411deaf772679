/* mft-soft: soft shadows by multi-frusta tracing, S-Frusta of Benthin and Wald 2009 (docs/kernels.md): groups of 16 frusta. */
#include "kernels/mft/group_soft.h"
#include "kernels/tile_function.h"

extern kernel_tile_fn KERNEL_TILE_FN(mft_primary), KERNEL_TILE_FN(visibility_filter);

LRB_INLINE void mft_soft_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    if (tile >= kernel_job_first_pass(job)) {
        KERNEL_TILE_FN(visibility_filter)(c, job, tile - kernel_job_first_pass(job), n);
        return;
    }
    KERNEL_TILE_FN(mft_primary)(c, job, tile, n);
    group_soft_tile(c, job, tile, n, false);
}

KERNEL_TILE_FUNCTION(mft_soft, mft_soft_tile)
