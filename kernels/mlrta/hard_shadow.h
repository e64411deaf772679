/* Shadow rays of a point light: from the light to the hit points of a 4x4 block, lane = pixel (Reshetov, Soupikov and Hurley 2005, 5 and 6).
 *
 * The rays have one origin, so packets of them are traced as those from the camera are. A ray ends above its surface, on the
 * viewer's side, by a share of the scene's diagonal: the surface does not shadow itself. The end is at t = 1.
 */
#ifndef KERNELS_MLRTA_HARD_SHADOW_H
#define KERNELS_MLRTA_HARD_SHADOW_H

#include "kernels/mlrta/kd16_tile.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_HARD_SHADOW

enum { HARD_NORMALS = 3 * 64 }; /* of a block's normals, behind its directions */

/* A tile's shadows. Which tile and block it is lies in scratch: while packets are traced registers do not suffice for pointers. */
typedef struct hard_shadow {
    const kernel_job *job;
    lrb_ptr camera;  /* constants of the primary rays */
    lrb_ptr normals; /* by triangle */
    kernel_shadow_packets packets;
    /* Of a block: */
    lrb_ptr first;  /* direction of its first pixel in scratch, by axis */
    lrb_ptr rays;   /* its rays in scratch */
    lrb_ptr frame, shadows;
    lrb_ptr pixels; /* its pixels in the image */
} hard_shadow;

/* Words of ENTRY_LOOP, and of the block's in HARD_ALIVE and HARD_HITS. */
enum { HARD_TILE = 8, HARD_INDEX, HARD_NODE, HARD_X, HARD_Y };
#define HARD_LOOP(k, word) lrb_at((k)->scratch, ENTRY_LOOP + 4 * (word))
#define HARD_WORD(h, place) lrb_at((h)->first, (place) - SCRATCH_CORNERS)

/* The block that scratch names. */
LRB_INLINE void hard_shadow_here(lrb_ctx *c, hard_shadow *h, const kd16 *k)
{
    lrb_r64 tile = lrb_load32(c, HARD_LOOP(k, HARD_TILE)), block = lrb_load32(c, HARD_LOOP(k, HARD_INDEX));
    lrb_r64 line = lrb_shl(c, block, 6);
    h->first = lrb_lea(c, k->scratch, block, 4, SCRATCH_CORNERS);
    h->rays = lrb_lea(c, k->scratch, lrb_imul(c, block, lrb_imm(HARD_BLOCK)), 1, HARD_RAYS);
    h->frame = lrb_lea(c, lrb_segment_at(h->job->frame, 0), lrb_add(c, lrb_shl(c, tile, 12), line), 1, 0);
    h->shadows = lrb_lea(c, lrb_segment_at(h->job->shadows, 0), lrb_add(c, lrb_shl(c, tile, 11), line), 1, 0);
    h->pixels = lrb_lea(c, lrb_segment_at(h->job->tiles, 0), lrb_shl(c, tile, 6), 1, (int32_t)offsetof(job_tile, pixels));
    h->pixels = lrb_lea(c, h->pixels, block, 2, 0);
}

/** The first block of a tile. */
LRB_INLINE void hard_shadow_first(lrb_ctx *c, hard_shadow *h, const kd16 *k)
{
    lrb_store32(c, HARD_LOOP(k, HARD_INDEX), lrb_imm(0));
    hard_shadow_here(c, h, k);
}

LRB_INLINE hard_shadow hard_shadow_of(lrb_ctx *c, const kernel_job *job, const kd16 *k, lrb_r64 tile)
{
    hard_shadow h = {.job = job, .camera = lrb_segment_at(job->constants, 0), .normals = lrb_segment_at(job->normals, 0)};
    h.packets = (kernel_shadow_packets)job->params.shadow_packets;
    lrb_store32(c, HARD_LOOP(k, HARD_TILE), tile);
    hard_shadow_first(c, &h, k);
    return h;
}

_Static_assert(sizeof(job_frame_tile) == 1 << 12 && sizeof(job_shadow_tile) == 1 << 11 && sizeof(job_tile) == 1 << 6,
               "tiles are addressed by shifts");

/** From one block to the next; false after the last. */
LRB_INLINE bool hard_shadow_next(lrb_ctx *c, hard_shadow *h, const kd16 *k)
{
    lrb_r64 block = lrb_add(c, lrb_load32(c, HARD_LOOP(k, HARD_INDEX)), lrb_imm(1));
    if (!lrb_jb(c, lrb_cmp(c, block, lrb_imm(16))))
        return false;
    lrb_store32(c, HARD_LOOP(k, HARD_INDEX), block);
    hard_shadow_here(c, h, k);
    return true;
}

/* Unit normals of the triangles that the lanes of m have hit, on the viewer's side. */
LRB_INLINE void hard_shadow_normals(lrb_ctx *c, const hard_shadow *h, lrb_v16f zero, lrb_k16 m, const lrb_v16f view[3], lrb_v16f n[3])
{
    lrb_v16i index = lrb_load_pi(c, lrb_at(h->frame, (int32_t)offsetof(job_frame_tile, id)));
    lrb_v16f side = zero;
    index = lrb_add_pi(c, index, index); /* by 8, the largest scale, to 16 bytes */
    for (int axis = 0; axis < 3; axis++) {
        n[axis] = lrb_gather_all_ps(c, zero, m, lrb_at(h->normals, 4 * axis), index, 8);
        side = axis ? lrb_madd231_ps(c, side, n[axis], view[axis]) : lrb_mul_ps(c, n[axis], view[axis]);
    }
    lrb_k16 back = lrb_mask_cmplt_ps(c, m, zero, side);
    for (int axis = 0; axis < 3; axis++)
        n[axis] = lrb_mask_sub_ps(c, n[axis], back, zero, n[axis]);
}

/* Directions of the rays to the hits of m, into scratch; returns those that come from above the surface. */
LRB_INLINE lrb_k16 hard_shadow_rays(lrb_ctx *c, const hard_shadow *h, const kd16 *k, lrb_v16f zero, lrb_v16f t, lrb_k16 m)
{
    lrb_v16f view[3], n[3], d, height = zero;
    for (int axis = 0; axis < 3; axis++) {
        view[axis] = lrb_load_ps(c, RAYS16_CONSTANT(h->camera, delta[axis]));
        view[axis] = lrb_add_ps_s3(c, view[axis], lrb_1to16_ps(lrb_at(h->first, 64 * axis)));
    }
    hard_shadow_normals(c, h, zero, m, view, n);
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f end = lrb_load_1to16_ps(c, RAYS16_CONSTANT(h->camera, origin_box[axis]));
        end = lrb_madd231_ps(c, end, view[axis], t);
        end = lrb_madd231_ps_s3(c, end, n[axis], lrb_1to16_ps(RAYS16_CONSTANT(h->camera, light.lift)));
        d = lrb_sub_ps_s3(c, end, lrb_1to16_ps(RAYS16_CONSTANT(k->constants, origin_box[axis])));
        height = axis ? lrb_madd231_ps(c, height, n[axis], d) : lrb_mul_ps(c, n[axis], d);
        lrb_store_ps(c, lrb_at(h->rays, 64 * axis), d);
        lrb_store_ps(c, lrb_at(h->rays, HARD_NORMALS + 64 * axis), n[axis]);
    }
    return lrb_mask_cmplt_ps(c, m, height, zero);
}

/* Those rays of m that go with the first of them. */
LRB_INLINE lrb_k16 hard_shadow_alike(lrb_ctx *c, const hard_shadow *h, const kd16 *k, lrb_k16 m)
{
    if (h->packets == KERNEL_SHADOW_WHOLE)
        return m;
    lrb_r64 first = lrb_bsff(c, lrb_kmov_rk(c, m));
    if (h->packets == KERNEL_SHADOW_TRIANGLE) {
        lrb_v16i ids = lrb_load_pi(c, lrb_at(h->frame, (int32_t)offsetof(job_frame_tile, id)));
        lrb_ptr lane = lrb_lea(c, h->frame, first, 4, (int32_t)offsetof(job_frame_tile, id));
        return lrb_mask_cmpeq_pi_s3(c, m, ids, lrb_1to16_pi(lrb_at(lane, 0)));
    }
    lrb_ptr lane = lrb_lea(c, h->rays, first, 4, HARD_NORMALS);
    lrb_v16f cosine = lrb_load_ps(c, lrb_at(h->rays, HARD_NORMALS));
    cosine = lrb_mul_ps_s3(c, cosine, lrb_1to16_ps(lrb_at(lane, 0)));
    for (int axis = 1; axis < 3; axis++) {
        lrb_v16f n = lrb_load_ps(c, lrb_at(h->rays, HARD_NORMALS + 64 * axis));
        cosine = lrb_madd231_ps_s3(c, cosine, n, lrb_1to16_ps(lrb_at(lane, 64 * axis)));
    }
    lrb_k16 alike = lrb_mask_cmpnlt_ps_s3(c, m, cosine, lrb_1to16_ps(KD16_CELLS(k->cells, alike)));
    return lrb_kor(c, alike, lrb_kmov_kr(c, lrb_bts(c, lrb_imm(0), first))); /* with itself, whatever is rounded */
}

/* Store what the block's pixels see: 1 without a hit; `hits` that are not `seen` see nothing. */
LRB_INLINE void hard_shadow_store(lrb_ctx *c, const hard_shadow *h, const kd16 *k, lrb_v16f zero, lrb_k16 hits, lrb_k16 seen)
{
    lrb_v16f visibility = lrb_load_1to16_ps(c, KD16_CELLS(k->cells, signs)); /* 1 */
    lrb_k16 dark = lrb_kxor(c, hits, seen);
    visibility = lrb_mask_mov_ps(c, visibility, dark, zero);
    lrb_v16i occlusion = lrb_load_1to16_pi(c, KD16_CELLS(k->cells, untraced));
    occlusion = lrb_mask_mov_pi_s3(c, occlusion, seen, lrb_1to16_pi(KD16_CELLS(k->cells, unblocked)));
    lrb_store_ps(c, lrb_at(h->shadows, (int32_t)offsetof(job_shadow_tile, visibility)), visibility);
    lrb_store_pi(c, lrb_at(h->shadows, (int32_t)offsetof(job_shadow_tile, occlusion)), occlusion);
}

/* Trace rays of a block from the light; returns those that arrive. */
LRB_INLINE lrb_k16 hard_shadow_trace(lrb_ctx *c, const hard_shadow *h, kd16 *k, lrb_r64 start, lrb_k16 active)
{
    slab16 s = {.own_origins = false};
    lrb_v16f lo[3], hi[3];
    lrb_phase(c, KERNEL_PHASE_SETUP);
    for (int axis = 0; axis < 3; axis++) {
        k->d[axis] = lrb_load_ps(c, lrb_at(h->rays, 64 * axis));
        lo[axis] = hi[axis] = k->d[axis];
    }
    k->n->n[KERNEL_units_hard_packets]++;
    lrb_v16f slack = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, slack));
    slab16_setup(c, &s, k->constants, k->scratch, slack, active, lo, hi, k->n);
    lrb_v16f farthest = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, light.farthest));
    s.limit = lrb_mask_mov_ps(c, lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel)), active, farthest);
    k->u = lrb_mov_ps(c, k->early ? s.zero : s.limit);
    k->v = lrb_mov_ps(c, s.zero);
    k->id = lrb_load_1to16_pi(c, RAYS16_CONSTANT(k->constants, no_hit));
    kd16_trace(c, k, &s, start, active);
    return lrb_mask_cmplt_ps(c, active, s.zero, k->early ? s.limit : k->u);
}

/** The rays of a block that could see the light, into scratch, as its pixels with a hit. */
LRB_INLINE void hard_shadow_begin(lrb_ctx *c, const hard_shadow *h, const kd16 *k)
{
    lrb_v16f t = lrb_load_ps(c, lrb_at(h->frame, (int32_t)offsetof(job_frame_tile, t)));
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(t), lrb_castps_pi(t)));
    lrb_k16 alive = lrb_kmov_kr(c, lrb_load16(c, lrb_at(h->pixels, 0)));
    lrb_k16 hits = lrb_mask_cmplt_ps_s3(c, alive, t, lrb_full_ps(RAYS16_CONSTANT(k->constants, infinity)));
    alive = hits;
    if (lrb_jnz(c, lrb_kortest(c, hits, hits)))
        alive = hard_shadow_rays(c, h, k, zero, t, hits);
    k->n->n[KERNEL_rays] += (unsigned)__builtin_popcount(alive.bits);
    k->n->n[KERNEL_rays_shadow] += (unsigned)__builtin_popcount(alive.bits);
    lrb_store32(c, HARD_WORD(h, HARD_HITS), lrb_kmov_rk(c, hits));
    lrb_store32(c, HARD_WORD(h, HARD_ALIVE), lrb_kmov_rk(c, alive));
}

/** Trace the rays of a block from the node in scratch, or the root, part by part; `nothing`: they all arrive. */
LRB_INLINE void hard_shadow_end(lrb_ctx *c, hard_shadow *h, kd16 *k, bool root, bool nothing)
{
    lrb_k16 rest = lrb_kmov_kr(c, lrb_load32(c, HARD_WORD(h, HARD_ALIVE))), seen = rest;
    if (!nothing) { /* the caller's branch */
        seen = lrb_mask(0);
        while (lrb_jnz(c, lrb_kortest(c, rest, rest))) {
            lrb_k16 together = hard_shadow_alike(c, h, k, rest);
            rest = lrb_kxor(c, rest, together);
            lrb_r64 start = root ? lrb_imm(0) : lrb_load32(c, HARD_LOOP(k, HARD_NODE));
            seen = lrb_kor(c, seen, hard_shadow_trace(c, h, k, start, together));
            lrb_phase(c, KERNEL_PHASE_SHADING);
            hard_shadow_here(c, h, k);
        }
    }
    lrb_v16f one = lrb_load_1to16_ps(c, KD16_CELLS(k->cells, signs));
    lrb_k16 hits = lrb_kmov_kr(c, lrb_load32(c, HARD_WORD(h, HARD_HITS)));
    hard_shadow_store(c, h, k, lrb_sub_ps(c, one, one), hits, seen);
}

#endif
