/* kd16-primary: 4x4 primary rays a packet through the kd-tree, all from its root: the rows 'no MLRT' of Reshetov, Soupikov and
 * Hurley 2005 (docs/kernels-mlrta.md).
 */
#include "kernels/mlrta/kd16_tile.h"
#include "kernels/shade16.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_KD16_PRIMARY

LRB_INLINE void kd16_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    kd16 k = kd16_of(c, job, n);
    lrb_ptr tile_ptr = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile));
    lrb_ptr frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile));
    kd16_begin(c, &k);
    lrb_store_ps(c, lrb_at(k.scratch, SCRATCH_BOXES), lrb_load_ps(c, KD16_CELLS(k.cells, box)));
    if (job->record_count == 0)
        kd16_blocks(c, &k, tile_ptr, frame, NULL, true, lrb_imm(0xffff));
    else
        kd16_blocks(c, &k, tile_ptr, frame, NULL, false, lrb_imm(0xffff));
    shade16_tile(c, job, lrb_imm(tile), lrb_imm(0xffff));
}

KERNEL_TILE_FUNCTION(kd16_primary, kd16_primary_tile)
