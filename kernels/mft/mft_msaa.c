/* mft-msaa: primary rays as in mft-primary, then 16 samples of each pixel that a silhouette crosses: the adaptive anti-aliasing of
 * Benthin and Wald 2009, 6.1 (docs/kernels.md).
 *
 * The first group of a tile is its 16 blocks, in frusta that hold all samples of their pixels; it marks pixels on its way. Then
 * 16 marked pixels at a time are a group, each the frustum of its 16 samples.
 */
#include "kernels/mft/group_primary.h"
#include "kernels/mft/silhouettes.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MFT_MSAA

/* Intervals of the frusta, for slab16_setup. */
typedef struct mft_intervals {
    lrb_v16f lo[3], hi[3];
} mft_intervals;

/* The group of the tile's blocks, whose rays are those of mft-primary; returns the frusta with pixels. */
LRB_INLINE lrb_k16 mft_msaa_blocks(lrb_ctx *c, const kernel_job *job, const silhouettes *w, mft_group *g, mft_intervals *out)
{
    lrb_ptr cell = lrb_segment_at(job->msaa_constants, (uint32_t)offsetof(job_msaa_constants, cell));
    lrb_v16f corner[3];
    lrb_k16 active = lrb_kmov_kr(c, lrb_load32(c, lrb_at(w->tile, (int32_t)offsetof(job_tile, blocks))));
    g->n->n[KERNEL_units_groups]++;
    g->n->n[KERNEL_units_frusta] += (unsigned)__builtin_popcount(active.bits);
    rays16_corners(c, g->constants, w->tile, corner);
    for (int axis = 0; axis < 3; axis++) {
        lrb_store_ps(c, lrb_at(g->scratch, g->first + 64 * axis), corner[axis]);
        corner[axis] = lrb_add_ps_s3(c, corner[axis], lrb_1to16_ps(SILHOUETTES_CONSTANT(w, cell_first[axis])));
    }
    mft_corners(c, g, corner, cell, out->lo, out->hi);
    return active;
}

/* The group of the 16 marked pixels from number `next` on, or of as many as there are. */
LRB_INLINE lrb_k16 mft_msaa_samples(lrb_ctx *c, const kernel_job *job, const silhouettes *w, mft_group *g, lrb_r64 next, lrb_r64 count,
                                    mft_intervals *out)
{
    lrb_ptr delta = lrb_segment_at(job->sample_constants, (uint32_t)offsetof(job_constants, delta));
    lrb_ptr place = lrb_lea(c, g->scratch, next, 4, 0);
    lrb_v16f corner[3];
    lrb_store32(c, lrb_at(g->scratch, SCRATCH_LEFT), lrb_sub(c, count, next));
    lrb_v16i lane = lrb_load_pi(c, SILHOUETTES_CONSTANT(w, lane));
    lrb_k16 active = lrb_cmplt_pi_s3(c, lane, lrb_1to16_pi(lrb_at(g->scratch, SCRATCH_LEFT)));
    lrb_v16f x = lrb_load_1to16_ps(c, lrb_at(place, SCRATCH_MARKED_X));
    x = lrb_mask_mov_ps_s3(c, x, active, lrb_full_ps(lrb_at(place, SCRATCH_MARKED_X)));
    lrb_v16f y = lrb_load_1to16_ps(c, lrb_at(place, SCRATCH_MARKED_Y));
    y = lrb_mask_mov_ps_s3(c, y, active, lrb_full_ps(lrb_at(place, SCRATCH_MARKED_Y)));
    for (int axis = 0; axis < 3; axis++) {
        corner[axis] = lrb_load_1to16_ps(c, RAYS16_CONSTANT(g->constants, d00[axis]));
        corner[axis] = lrb_madd231_ps_s3(c, corner[axis], x, lrb_1to16_ps(RAYS16_CONSTANT(g->constants, dx[axis])));
        corner[axis] = lrb_madd231_ps_s3(c, corner[axis], y, lrb_1to16_ps(RAYS16_CONSTANT(g->constants, dy[axis])));
    }
    mft_corners(c, g, corner, delta, out->lo, out->hi);
    const unsigned pixels = (unsigned)__builtin_popcount(active.bits);
    g->n->n[KERNEL_units_msaa_groups]++;
    g->n->n[KERNEL_units_msaa_frusta] += pixels;
    g->n->n[KERNEL_rays] += 16 * pixels;
    g->n->n[KERNEL_rays_msaa] += 16 * pixels;
    return active;
}

/* No hits yet of the frusta whose results are before `end`. */
LRB_INLINE void mft_msaa_clear(lrb_ctx *c, const mft_group *g, const slab16 *s, lrb_ptr end)
{
    lrb_v16i no_hit = lrb_load_1to16_pi(c, RAYS16_CONSTANT(g->constants, no_hit));
    lrb_ptr hit = lrb_lea(c, g->frame, lrb_imm(0), 1, 0);
    do {
        frame16_store(c, hit, s->infinity, s->zero, s->zero, no_hit);
        hit = lrb_lea(c, hit, lrb_imm(0), 1, 64);
    } while (lrb_jb(c, lrb_cmp_ptr(c, hit, end)));
}

/* From the group of blocks, which is traced, to the samples: how many pixels there are to trace again. */
LRB_INLINE lrb_r64 mft_msaa_mark(lrb_ctx *c, const kernel_job *job, uint32_t tile, const silhouettes *w, mft_group *g)
{
    const uint32_t samples = tile * (uint32_t)sizeof(job_msaa_tile) + (uint32_t)offsetof(job_msaa_tile, samples);
    lrb_phase(c, KERNEL_PHASE_SILHOUETTES);
    lrb_r64 count = silhouettes_mark(c, w, g);
    g->user = NULL;
    g->blocks = false;
    g->constants = lrb_segment_at(job->sample_constants, 0);
    g->first = SCRATCH_CORNERS;
    g->frame = g->limits = lrb_segment_at(job->msaa_tiles, samples);
    return job->params.retrace ? count : lrb_imm(0);
}

LRB_INLINE void mft_msaa_trace(lrb_ctx *c, const kernel_job *job, uint32_t tile, const silhouettes *w, mft_group *g)
{
    lrb_r64 next = lrb_imm(0), count = next;
    mft_intervals i;
    traversal16 t = traversal16_of(job, g->scratch, mft_leaf, g, g->n);
    t.origin = lrb_load_ps(c, RAYS16_CONSTANT(g->constants, origin_box));
    g->origin = lrb_load_ps(c, RAYS16_CONSTANT(g->constants, origin_triangle));
    do {
        slab16 s = {.own_origins = false};
        lrb_phase(c, KERNEL_PHASE_SETUP);
        lrb_k16 active = g->user ? mft_msaa_blocks(c, job, w, g, &i) : mft_msaa_samples(c, job, w, g, next, count, &i);
        lrb_ptr end = lrb_lea(c, g->frame, lrb_shl(c, lrb_popcnt(c, lrb_kmov_rk(c, active)), 6), 1, 0);
        mft_prefetch_frame(c, g, end);
        lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(g->constants, slack));
        slab16_setup(c, &s, g->constants, g->scratch, slack, active, i.lo, i.hi, g->n);
        s.limit = lrb_mov_ps(c, s.infinity);
        if (g->user) {
            mft_clear_frame(c, g, &s, w->tile);
            silhouettes_clear(c, w, g, &s);
        } else {
            mft_msaa_clear(c, g, &s, end);
        }
        traversal16_run(c, &t, &s, active);
        if (g->user) {
            count = mft_msaa_mark(c, job, tile, w, g);
            lrb_store32(c, lrb_at(g->scratch, SCRATCH_COUNT), count);
        } else {
            next = lrb_add(c, lrb_load32(c, lrb_at(g->scratch, SCRATCH_NEXT)), lrb_imm(16));
            count = lrb_load32(c, lrb_at(g->scratch, SCRATCH_COUNT));
            g->frame = g->limits = lrb_lea(c, g->frame, lrb_imm(sizeof(job_frame_tile)), 1, 0);
        }
        lrb_store32(c, lrb_at(g->scratch, SCRATCH_NEXT), next);
    } while (lrb_jb(c, lrb_cmp(c, next, count)));
}

LRB_INLINE void mft_msaa_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    const uint32_t results = tile * (uint32_t)sizeof(job_msaa_tile);
    const silhouettes w = {
        .constants = lrb_segment_at(job->msaa_constants, 0),
        .tile = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile)),
        .edge = lrb_segment_at(job->msaa_tiles, results + (uint32_t)offsetof(job_msaa_tile, edge)),
        .marked = lrb_segment_at(job->msaa_tiles, results + (uint32_t)offsetof(job_msaa_tile, marked)),
        .neighbours = job->record_count * (uint32_t)sizeof(bvh_triangle),
        .whole_blocks = job->params.marking == KERNEL_MARKING_BLOCK,
    };
    mft_group g = {
        .constants = lrb_segment_at(job->constants, 0),
        .scratch = lrb_segment_at(c->scratch, 0),
        .frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile)),
        .limits = lrb_segment_at(job->msaa_tiles, results + (uint32_t)offsetof(job_msaa_tile, limit)),
        .first = SCRATCH_FIRST_RAYS,
        .cull = job->params.cull_backface,
        .blocks = true,
        .n = n,
        .user = &w,
        .survivor = silhouettes_triangle,
        .nearer = silhouettes_limit,
    };
    lrb_region(c, LRB_WHOLE_TILE);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    mft_msaa_trace(c, job, tile, &w, &g);
}

KERNEL_TILE_FUNCTION(mft_msaa, mft_msaa_tile)
