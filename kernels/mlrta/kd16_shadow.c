/* kd16-shadow: kd16-primary, then the shadows of a point light in packets from the light, all from the root of the tree: the rows
 * 'no MLRT' with shadows of Reshetov, Soupikov and Hurley 2005 (docs/kernels-mlrta.md).
 */
#include "kernels/mlrta/hard_shadow.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_KD16_SHADOW

extern kernel_tile_fn KERNEL_TILE_FN(kd16_primary);

LRB_INLINE void kd16_shadow_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    kd16 k = kd16_from_light(c, job, n);
    KERNEL_TILE_FN(kd16_primary)(c, job, tile, n);
    kd16_begin(c, &k);
    lrb_store_ps(c, lrb_at(k.scratch, SCRATCH_BOXES), lrb_load_ps(c, KD16_CELLS(k.cells, box)));
    hard_shadow h = hard_shadow_of(c, job, &k, lrb_imm(tile));
    uint32_t block = 0;
    do {
        lrb_region(c, block++);
        lrb_phase(c, KERNEL_PHASE_SHADING);
        hard_shadow_begin(c, &h, &k);
        hard_shadow_end(c, &h, &k, true, false);
    } while (hard_shadow_next(c, &h, &k));
    lrb_region(c, LRB_WHOLE_TILE);
}

KERNEL_TILE_FUNCTION(kd16_shadow, kd16_shadow_tile)
