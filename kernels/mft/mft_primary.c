/* mft-primary: multi-frusta tracing of primary rays, Benthin and Wald 2009 (docs/kernels.md): groups of 16 frusta. */
#include "kernels/mft/group_primary.h"
#include "kernels/shade16.h"
#include "kernels/tile_function.h"

LRB_INLINE void mft_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    group_primary_tile(c, job, tile, n, false);
    shade16_tile(c, job, lrb_imm(tile), lrb_imm(0xffff));
}

KERNEL_TILE_FUNCTION(mft_primary, mft_primary_tile)
