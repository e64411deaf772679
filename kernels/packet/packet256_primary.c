/* packet256-primary: primary rays in groups of 16 packets of 4x4 rays, Benthin and Wald 2009, 5.2 (docs/kernels.md). */
#include "kernels/mft/group_primary.h"
#include "kernels/shade16.h"
#include "kernels/tile_function.h"

LRB_INLINE void packet256_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    group_primary_tile(c, job, tile, n, true);
    shade16_tile(c, job, lrb_imm(tile), lrb_imm(0xffff));
}

KERNEL_TILE_FUNCTION(packet256_primary, packet256_primary_tile)
