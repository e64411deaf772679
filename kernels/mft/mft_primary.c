/* mft-primary: multi-frusta tracing of primary rays, Benthin and Wald 2009 (docs/kernels.md). A tile is one group. */
#include "kernels/mft/group_primary.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT_PRIMARY

LRB_INLINE void mft_primary_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    lrb_ptr tile_ptr = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile));
    lrb_ptr deltas = lrb_segment_at(job->constants, (uint32_t)offsetof(job_constants, delta));
    lrb_v16f first[3], lo[3], hi[3];
    slab16 s = {.own_origins = false};
    mft_group g = {
        .constants = lrb_segment_at(job->constants, 0),
        .scratch = lrb_segment_at(c->scratch, 0),
        .frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile)),
        .limits = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile) + (uint32_t)offsetof(job_frame_tile, t)),
        .first = SCRATCH_CORNERS,
        .cull = job->params.cull_backface,
        .blocks = true,
        .n = n,
    };
    traversal16 t = traversal16_of(job, g.scratch, mft_leaf, &g, n);
    lrb_region(c, LRB_WHOLE_TILE);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    t.origin = lrb_load_ps(c, RAYS16_CONSTANT(g.constants, origin_box));
    g.origin = lrb_load_ps(c, RAYS16_CONSTANT(g.constants, origin_triangle));
    lrb_k16 active = lrb_kmov_kr(c, lrb_load32(c, lrb_at(tile_ptr, (int32_t)offsetof(job_tile, blocks))));
    n->n[KERNEL_units_groups]++;
    n->n[KERNEL_units_frusta] += (unsigned)__builtin_popcount(active.bits);
    rays16_corners(c, g.constants, tile_ptr, first);
    mft_corners(c, &g, first, deltas, lo, hi);
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(g.constants, slack));
    slab16_setup(c, &s, g.constants, g.scratch, slack, active, lo, hi, n);
    s.limit = lrb_mov_ps(c, s.infinity);
    mft_clear_frame(c, &g, &s, tile_ptr);
    traversal16_run(c, &t, &s, active);
}

KERNEL_TILE_FUNCTION(mft_primary, mft_primary_tile)
