/* packet256-primary: primary rays in groups of 16 packets of 4x4 rays, Benthin and Wald 2009, 5.2 (docs/kernels.md). */
#include "kernels/mft/group_primary.h"
#include "kernels/tile_function.h"

LRB_INLINE void packet256_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    group_primary_tile(c, job, tile, n, true);
}

KERNEL_TILE_FUNCTION(packet256_primary, packet256_primary_tile)
