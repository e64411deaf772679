/* packet16-primary: 4x4 primary rays a packet, one lane a ray. P-Packet of Benthin and Wald 2009 (docs/kernels.md).
 *
 * The sixteen packets of a tile are traced one after another; a packet's directions and nearest hits live in registers.
 */
#include "kernels/frame16.h"
#include "kernels/shade16.h"
#include "kernels/tile_function.h"
#include "kernels/traversal16.h"
#include "kernels/triangle16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_PACKET16

typedef struct packet16 {
    lrb_ptr constants, scratch;
    lrb_v16f origin; /* for triangle records */
    lrb_v16f d[3];
    lrb_v16f u, v; /* of the nearest hits; their distances are the limits of the box test */
    lrb_v16i id;
    bool cull;
    kernel_counts *n;
} packet16;

LRB_INLINE void packet16_leaf(lrb_ctx *c, slab16 *s, void *user, lrb_ptr box, lrb_ptr record, lrb_ptr end, lrb_k16 m)
{
    packet16 *p = user;
    (void)box;
    do {
        lrb_v16f edges;
        triangle16_prefetch_next(c, record);
        p->n->n[KERNEL_tri_accesses]++;
        lrb_phase(c, KERNEL_PHASE_CULLING);
        if (triangle16_setup(c, p->scratch, p->origin, record, p->cull, &edges)) {
            p->n->n[KERNEL_tri_after_culling]++;
            p->n->n[KERNEL_isect_tests]++;
            lrb_phase(c, KERNEL_PHASE_INTERSECTION);
            triangle16_hits hits = triangle16_intersect(c, p->constants, p->scratch, p->origin, record, p->cull, m, p->d,
                                                        s->zero, s->limit, p->id);
            if (hits.m.bits) { /* the branch is triangle16_intersect's own */
                s->limit = lrb_mask_mov_ps(c, s->limit, hits.m, hits.t);
                p->u = lrb_mask_mov_ps(c, p->u, hits.m, hits.u);
                p->v = lrb_mask_mov_ps(c, p->v, hits.m, hits.v);
                p->id = lrb_mask_mov_pi_s3(c, p->id, hits.m, lrb_1to16_pi(lrb_at(record, (int32_t)offsetof(bvh_triangle, id))));
            }
        }
        record = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)sizeof(bvh_triangle));
    } while (lrb_jb(c, lrb_cmp_ptr(c, record, end)));
}

/* Directions, signs and empty hits of one block of the tile; its first ray stands at `corner`, by axis. */
LRB_INLINE void packet16_start(lrb_ctx *c, packet16 *p, slab16 *s, lrb_ptr constants, lrb_ptr corner, lrb_k16 active)
{
    lrb_v16f lo[3], hi[3];
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f delta = lrb_load_ps(c, RAYS16_CONSTANT(constants, delta[axis]));
        p->d[axis] = lrb_add_ps_s3(c, delta, lrb_1to16_ps(lrb_at(corner, 64 * axis)));
        lo[axis] = hi[axis] = p->d[axis];
    }
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(constants, slack));
    slab16_setup(c, s, constants, p->scratch, slack, active, lo, hi, p->n);
    s->limit = lrb_mask_mov_ps(c, lrb_load_ps(c, RAYS16_CONSTANT(constants, no_pixel)), active, s->infinity);
    p->u = lrb_mov_ps(c, s->zero);
    p->v = lrb_mov_ps(c, s->zero);
    p->id = lrb_load_1to16_pi(c, RAYS16_CONSTANT(constants, no_hit));
}

/* Trace the packet of one block: `pixels` points at its mask of pixels, `block_frame` at its results. */
LRB_INLINE void packet16_trace(lrb_ctx *c, const traversal16 *t, packet16 *p, lrb_ptr constants, lrb_ptr pixels, lrb_ptr corner,
                               lrb_ptr block_frame)
{
    slab16 s = {.own_origins = false};
    lrb_phase(c, KERNEL_PHASE_SETUP);
    lrb_k16 active = lrb_kmov_kr(c, lrb_load16(c, lrb_at(pixels, 0)));
    if (lrb_jz(c, lrb_kortest(c, active, active)))
        return;
    t->n->n[KERNEL_units_packets]++;
    t->n->n[KERNEL_rays] += (unsigned)__builtin_popcount(active.bits);
    t->n->n[KERNEL_rays_primary] += (unsigned)__builtin_popcount(active.bits);
    frame16_prefetch(c, block_frame);
    packet16_start(c, p, &s, constants, corner, active);
    traversal16_run(c, t, &s, active);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    frame16_store(c, block_frame, s.limit, p->u, p->v, p->id);
}

LRB_INLINE void packet16_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    lrb_ptr constants = lrb_segment_at(job->constants, 0);
    lrb_ptr tile_ptr = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile));
    lrb_ptr block_frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile));
    lrb_v16f first_rays[3];
    packet16 p = {.constants = constants, .scratch = lrb_segment_at(c->scratch, 0), .cull = job->params.cull_backface, .n = n};
    traversal16 t = traversal16_of(job, p.scratch, packet16_leaf, &p, n);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    t.origin = lrb_load_ps(c, RAYS16_CONSTANT(constants, origin_box));
    p.origin = lrb_load_ps(c, RAYS16_CONSTANT(constants, origin_triangle));
    rays16_corners(c, constants, tile_ptr, first_rays);
    for (int axis = 0; axis < 3; axis++)
        lrb_store_ps(c, lrb_at(p.scratch, SCRATCH_CORNERS + 64 * axis), first_rays[axis]);
    lrb_ptr corner = lrb_lea(c, p.scratch, lrb_imm(0), 1, SCRATCH_CORNERS);
    lrb_ptr last_corner = lrb_lea(c, corner, lrb_imm(0), 1, 64);
    lrb_ptr pixels = lrb_lea(c, tile_ptr, lrb_imm(0), 1, (int32_t)offsetof(job_tile, pixels));
    uint32_t block = 0;
    do {
        lrb_region(c, block++);
        packet16_trace(c, &t, &p, constants, pixels, corner, block_frame);
        pixels = lrb_lea(c, pixels, lrb_imm(0), 1, 2);
        block_frame = lrb_lea(c, block_frame, lrb_imm(0), 1, 64);
        corner = lrb_lea(c, corner, lrb_imm(0), 1, 4);
    } while (lrb_jb(c, lrb_cmp_ptr(c, corner, last_corner)));
    lrb_region(c, LRB_WHOLE_TILE);
    shade16_tile(c, job, lrb_imm(tile), lrb_imm(0xffff));
}

KERNEL_TILE_FUNCTION(packet16_primary, packet16_tile)
