/* packet16-soft: soft shadows in packets of the 16 samples of one hit point, S-Packet of Benthin and Wald 2009 (docs/kernels.md).
 *
 * The tile's primary rays go first, as in packet16-primary; then hit point after hit point. A ray that is blocked leaves its
 * packet, and a packet ends with its last ray.
 */
#include "kernels/shadow16.h"
#include "kernels/tile_function.h"
#include "kernels/traversal16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_PACKET16_SOFT

extern kernel_tile_fn KERNEL_TILE_FN(packet16_primary), KERNEL_TILE_FN(visibility_filter);

typedef struct packet16_soft {
    shadow16 w;
    lrb_ptr lane;    /* scratch + 4 * the pixel of the packet */
    lrb_v16f origin; /* for triangle records */
    lrb_v16f d[3];
} packet16_soft;

LRB_INLINE void packet16_soft_leaf(lrb_ctx *c, slab16 *s, void *user, lrb_ptr box, lrb_ptr record, lrb_ptr end, lrb_k16 m)
{
    packet16_soft *p = user;
    (void)box;
    do {
        lrb_v16f edges;
        p->w.n->n[KERNEL_tri_accesses]++;
        lrb_phase(c, KERNEL_PHASE_CULLING);
        if (triangle16_setup(c, p->w.scratch, p->origin, record, p->w.cull, &edges)) {
            p->w.n->n[KERNEL_tri_after_culling]++;
            p->w.n->n[KERNEL_isect_tests]++;
            lrb_phase(c, KERNEL_PHASE_INTERSECTION);
            lrb_k16 blocked = shadow16_blocked(c, &p->w, p->w.scratch, &triangle16_shared, p->lane, record, m, p->d, s->zero);
            if (blocked.bits) { /* the branch is shadow16_blocked's own */
                s->alive = lrb_kxor(c, s->alive, blocked);
                m = lrb_kxor(c, m, blocked);
                if (lrb_jz(c, lrb_kortest(c, m, m)))
                    return;
            }
        }
        record = lrb_lea(c, record, lrb_imm(0), 1, (int32_t)sizeof(bvh_triangle));
    } while (lrb_jb(c, lrb_cmp_ptr(c, record, end)));
}

/* The packet of pixel f, with one set of samples. */
LRB_INLINE void packet16_soft_trace(lrb_ctx *c, traversal16 *t, packet16_soft *p, lrb_v16f zero, lrb_r64 f)
{
    slab16 s = {.own_origins = false};
    lrb_v16f lo[3], hi[3];
    lrb_phase(c, KERNEL_PHASE_SETUP);
    p->lane = lrb_lea(c, p->w.scratch, f, 4, 0);
    t->origin = shadow16_origin(c, p->lane, 0x1111, zero);
    p->origin = lrb_mask_mov_ps(c, zero, lrb_kmov_kr(c, lrb_imm(0x0fff)), t->origin);
    shadow16_rays(c, p->lane, shadow16_set(c, &p->w, f), p->d);
    for (int axis = 0; axis < 3; axis++)
        lo[axis] = hi[axis] = p->d[axis];
    s.alive = lrb_kmov_kr(c, lrb_imm(p->w.sample_mask));
    p->w.n->n[KERNEL_units_shadow_packets]++;
    p->w.n->n[KERNEL_rays] += (unsigned)__builtin_popcount(s.alive.bits);
    p->w.n->n[KERNEL_rays_shadow] += (unsigned)__builtin_popcount(s.alive.bits);
    lrb_v16f slack = lrb_load_1to16_ps(c, lrb_at(p->lane, SCRATCH_LIGHT_SLACK));
    slab16_setup(c, &s, p->w.constants, p->w.scratch, slack, s.alive, lo, hi, p->w.n);
    s.limit = lrb_load_1to16_ps(c, SHADOW16_LIGHT(p->w.constants, farthest));
    traversal16_run(c, t, &s, s.alive);
    lrb_phase(c, KERNEL_PHASE_SETUP);
    lrb_r64 occlusion = lrb_kmov_rk(c, lrb_knot(c, s.alive));
    lrb_store32(c, lrb_at(p->lane, SCRATCH_OCCLUSION), occlusion);
}

/* All packets of a block. */
LRB_INLINE void packet16_soft_block(lrb_ctx *c, traversal16 *t, packet16_soft *p)
{
    shadow16 *w = &p->w;
    lrb_phase(c, KERNEL_PHASE_SHADING);
    shadow16_start start = shadow16_begin(c, w);
    lrb_r64 pixels = lrb_kmov_rk(c, start.alive);
    shadow16_begin_passes(c, w, &start);
    do {
        start.alive = shadow16_begin_pass(c, w, &start);
        lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), pixels);
        while (!lrb_jl(c, lrb_test(c, f, f))) {
            packet16_soft_trace(c, t, p, start.zero, f);
            f = lrb_bsfi(c, f, pixels);
        }
        lrb_phase(c, KERNEL_PHASE_SHADING);
        shadow16_end_pass(c, w);
    } while (shadow16_next_pass(c, w));
    shadow16_end(c, w, start.hits);
}

LRB_INLINE void packet16_soft_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    if (tile >= kernel_job_first_pass(job)) {
        KERNEL_TILE_FN(visibility_filter)(c, job, tile - kernel_job_first_pass(job), n);
        return;
    }
    KERNEL_TILE_FN(packet16_primary)(c, job, tile, n);
    packet16_soft p = {.w = shadow16_of(c, job, tile, n)};
    traversal16 t = traversal16_of(job, p.w.scratch, packet16_soft_leaf, &p, n);
    t.any = true;
    uint32_t block = 0;
    do {
        lrb_region(c, block++);
        packet16_soft_block(c, &t, &p);
    } while (shadow16_next_block(c, &p.w));
    lrb_region(c, LRB_WHOLE_TILE);
}

KERNEL_TILE_FUNCTION(packet16_soft, packet16_soft_tile)
