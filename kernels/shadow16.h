/* Shadow rays from the 16 hit points of a 4x4 block of pixels, lane = pixel: where they start, the light as seen from there, and
 * what blocks them. The same bits for packets and for frusta (docs/kernels.md).
 *
 * A ray starts above its surface, on the viewer's side, and its direction is the light's corner less that, plus the delta of a
 * sample: one float addition for each ray, so nothing about a ray is stored (Benthin and Wald 2009, 4.4). The light is at t = 1.
 */
#ifndef KERNELS_SHADOW16_H
#define KERNELS_SHADOW16_H

#include "kernels/triangle16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_SHADOW

#define SHADOW16_LIGHT(constants, field) RAYS16_CONSTANT(constants, light.field)

typedef struct shadow16 {
    lrb_ptr constants, scratch, normals, samples;
    lrb_ptr frame, shadows, pixels; /* of the tile: of its first block */
    lrb_ptr filter, rows;           /* constants of shading; the tile's rows of pixels */
    lrb_r64 row_bytes;
    lrb_r64 block;
    bool cull, interleaved, filtered;
    uint32_t sample_mask, passes;
    kernel_counts *n;
} shadow16;

/** The shadow part of a tile, at its first block. */
LRB_INLINE shadow16 shadow16_of(const lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    return (shadow16){
        .constants = lrb_segment_at(job->constants, 0),
        .scratch = lrb_segment_at(c->scratch, 0),
        .normals = lrb_segment_at(job->normals, 0),
        .samples = lrb_segment_at(job->samples, 0),
        .frame = lrb_segment_at(job->frame, tile * (uint32_t)sizeof(job_frame_tile)),
        .shadows = lrb_segment_at(job->shadows, tile * (uint32_t)sizeof(job_shadow_tile)),
        .pixels = lrb_segment_at(job->tiles, tile * (uint32_t)sizeof(job_tile) + (uint32_t)offsetof(job_tile, pixels)),
        .filter = lrb_segment_at(job->filter, 0),
        .rows = lrb_segment_at(job->rows, kernel_job_row_offset(job, tile)),
        .row_bytes = lrb_imm(kernel_job_row_bytes(job)),
        .block = lrb_imm(0),
        .cull = job->params.cull_backface,
        .interleaved = job->params.interleaved,
        .filtered = job->filtered,
        .sample_mask = job->sample_mask,
        .passes = job->sample_passes,
        .n = n,
    };
}

/** To the next block; false after the last. */
LRB_INLINE bool shadow16_next_block(lrb_ctx *c, shadow16 *w)
{
    w->block = lrb_add(c, w->block, lrb_imm(1));
    return lrb_jb(c, lrb_cmp(c, w->block, lrb_imm(16)));
}

/* Unit normals of the triangles that the lanes of k have hit. A gather brings one line at a time. */
LRB_INLINE void shadow16_normals(lrb_ctx *c, const shadow16 *w, lrb_ptr frame, lrb_k16 k, lrb_v16f zero, lrb_v16f n[3])
{
    lrb_v16i index = lrb_load_pi(c, lrb_at(frame, (int32_t)offsetof(job_frame_tile, id)));
    index = lrb_add_pi(c, index, index); /* by 8, the largest scale, to 16 bytes */
    for (int axis = 0; axis < 3; axis++) {
        lrb_k16 left = k;
        n[axis] = lrb_mov_ps(c, zero);
        do
            n[axis] = lrb_gatherd_ps(c, n[axis], &left, lrb_at(w->normals, 4 * axis), index, 8);
        while (lrb_jnz(c, lrb_kortest(c, left, left)));
    }
}

/* The origins: P + lift * n, n on the viewer's side. */
LRB_INLINE void shadow16_origins(lrb_ctx *c, const shadow16 *w, lrb_k16 k, lrb_v16f zero, lrb_v16f t, lrb_v16f n[3], lrb_v16f o[3])
{
    lrb_v16f d[3], side = zero;
    lrb_ptr first = lrb_lea(c, w->scratch, w->block, 4, SCRATCH_CORNERS);
    for (int axis = 0; axis < 3; axis++) {
        d[axis] = lrb_load_ps(c, RAYS16_CONSTANT(w->constants, delta[axis]));
        d[axis] = lrb_add_ps_s3(c, d[axis], lrb_1to16_ps(lrb_at(first, 64 * axis)));
        side = axis ? lrb_madd231_ps(c, side, n[axis], d[axis]) : lrb_mul_ps(c, n[axis], d[axis]);
    }
    lrb_k16 back = lrb_mask_cmplt_ps(c, k, zero, side);
    for (int axis = 0; axis < 3; axis++) {
        n[axis] = lrb_mask_sub_ps(c, n[axis], back, zero, n[axis]);
        o[axis] = lrb_load_1to16_ps(c, RAYS16_CONSTANT(w->constants, origin_box[axis]));
        o[axis] = lrb_madd231_ps(c, o[axis], d[axis], t);
        o[axis] = lrb_madd231_ps_s3(c, o[axis], n[axis], lrb_1to16_ps(SHADOW16_LIGHT(w->constants, lift)));
        lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_HIT_POINTS + 64 * axis), o[axis]);
    }
}

/* Bounds of the rounding errors, in proportion to an upper bound of the directions' length. */
LRB_INLINE lrb_v16f shadow16_bounds(lrb_ctx *c, const shadow16 *w, lrb_v16f zero, const lrb_v16f lo[3], const lrb_v16f hi[3])
{
    lrb_v16f length = zero;
    for (int axis = 0; axis < 3; axis++)
        length = lrb_add_ps(c, length, lrb_max_ps(c, hi[axis], lrb_sub_ps(c, zero, lo[axis])));
    lrb_v16f slack = lrb_mul_ps_s3(c, length, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, slack)));
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_SLACK), slack);
    lrb_v16f reach = lrb_mul_ps_s3(c, length, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, reach)));
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_REACH), reach);
    lrb_v16f guard = lrb_mul_ps_s3(c, length, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, guard)));
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_GUARD), guard);
    return slack;
}

/* The light's four corners on one axis, as directions: into scratch, and their range. */
LRB_INLINE void shadow16_corners(lrb_ctx *c, const shadow16 *w, int axis, lrb_v16f o, lrb_v16f corner[4], lrb_v16f *lo, lrb_v16f *hi)
{
    corner[0] = lrb_subr_ps_s3(c, o, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, corner[axis])));
    corner[1] = lrb_add_ps_s3(c, corner[0], lrb_1to16_ps(SHADOW16_LIGHT(w->constants, u[axis])));
    corner[2] = lrb_add_ps_s3(c, corner[0], lrb_1to16_ps(SHADOW16_LIGHT(w->constants, uv[axis])));
    corner[3] = lrb_add_ps_s3(c, corner[0], lrb_1to16_ps(SHADOW16_LIGHT(w->constants, v[axis])));
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_TO_LIGHT + 64 * axis), corner[0]);
    for (int k = 0; k < 4; k++)
        lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_LIGHT_CORNERS + 192 * k + 64 * axis), corner[k]);
    lrb_v16f half = lrb_min_ps(c, corner[0], corner[1]);
    *lo = lrb_min_ps(c, half, lrb_min_ps(c, corner[2], corner[3]));
    half = lrb_max_ps(c, corner[0], corner[1]);
    *hi = lrb_max_ps(c, half, lrb_max_ps(c, corner[2], corner[3]));
}

/* The four rows of pixels of a block, and their lanes. */
typedef struct shadow16_rows {
    lrb_ptr at[4]; /* of the first pixel's depth */
    lrb_k16 lanes[4];
} shadow16_rows;

LRB_INLINE shadow16_rows shadow16_rows_of(lrb_ctx *c, const shadow16 *w)
{
    shadow16_rows r;
    lrb_r64 down = lrb_shl(c, lrb_shr(c, w->block, 2), 2);
    down = lrb_imul(c, down, w->row_bytes);
    lrb_r64 right = lrb_shl(c, lrb_and(c, w->block, lrb_imm(3)), 4);
    r.at[0] = lrb_lea(c, w->rows, lrb_add(c, down, right), 1, 0);
    for (int j = 0; j < 4; j++) {
        r.lanes[j] = lrb_kmov_kr(c, lrb_imm(UINT64_C(0xf) << 4 * j));
        if (j > 0)
            r.at[j] = lrb_lea(c, r.at[j - 1], w->row_bytes, 1, 0);
    }
    return r;
}

/* A block's values into its rows; `plane`: offset in job_row. */
LRB_INLINE void shadow16_store_rows(lrb_ctx *c, const shadow16_rows *r, size_t plane, lrb_v16f values)
{
    for (int j = 0; j < 4; j++)
        lrb_packstorel_ps(c, lrb_at(r->at[j], (int32_t)plane), r->lanes[j], values);
}

/* 1/sqrt(x) for x above 0, given where 0.5 is, by the machine's estimate and two Newton steps: relative error below 2^-21. */
LRB_INLINE lrb_v16f shadow16_rsqrt(lrb_ctx *c, lrb_mem half_of_one, lrb_v16f x)
{
    lrb_v16f r = lrb_rsqrtlut_ps(c, x);
    for (int step = 0; step < 2; step++) {
        lrb_v16f error = lrb_msubr23c1_ps(c, lrb_mul_ps(c, x, r), r);
        lrb_v16f half = lrb_mul_ps_s3(c, r, lrb_1to16_ps(half_of_one));
        r = lrb_madd231_ps(c, r, half, error);
    }
    return r;
}

/* Shading by the light's point, of the cosine at the hit point; it and the normals go to the rows of pixels. */
LRB_INLINE void shadow16_shade(lrb_ctx *c, const shadow16 *w, lrb_k16 hits, lrb_v16f zero, const lrb_v16f n[3], const lrb_v16f o[3])
{
    lrb_v16f cosine = zero, square = zero;
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f to = lrb_subr_ps_s3(c, o[axis], lrb_1to16_ps(SHADOW16_LIGHT(w->constants, point[axis])));
        cosine = axis ? lrb_madd231_ps(c, cosine, n[axis], to) : lrb_mul_ps(c, n[axis], to);
        square = axis ? lrb_madd231_ps(c, square, to, to) : lrb_mul_ps(c, to, to);
    }
    square = lrb_max_ps_s3(c, square, lrb_1to16_ps(RAYS16_CONSTANT(w->constants, tiny)));
    cosine = lrb_max_ps(c, cosine, zero);
    lrb_v16f shading = lrb_mask_mul_ps(c, zero, hits, cosine, shadow16_rsqrt(c, lrb_at(w->filter, (int32_t)offsetof(job_filter, half)), square));
    const shadow16_rows rows = shadow16_rows_of(c, w);
    for (int axis = 0; axis < 3; axis++)
        shadow16_store_rows(c, &rows, offsetof(job_row, normal[axis]), n[axis]);
    shadow16_store_rows(c, &rows, offsetof(job_row, shading), shading);
    if (!w->filtered)
        lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_SHADING), shading);
}

/* What a block's shadow rays begin with. */
typedef struct shadow16_start {
    lrb_k16 hits, alive;   /* pixels with a hit; those of them that may see the light */
    lrb_v16f lo[3], hi[3]; /* ranges of the directions to the light */
    lrb_v16f zero, slack;
} shadow16_start;

/** Hit points and light of a block, into scratch. If no pixel has a hit only `hits`, `alive` and `zero` mean anything. */
LRB_INLINE shadow16_start shadow16_begin(lrb_ctx *c, const shadow16 *w)
{
    shadow16_start r = {.alive = lrb_mask(0)};
    lrb_v16f n[3], o[3], height[4], front, highest;
    lrb_ptr frame = lrb_lea(c, w->frame, lrb_shl(c, w->block, 6), 1, 0);
    lrb_ptr pixels = lrb_lea(c, w->pixels, w->block, 2, 0);
    lrb_v16f t = lrb_load_ps(c, lrb_at(frame, (int32_t)offsetof(job_frame_tile, t)));
    r.zero = r.slack = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(t), lrb_castps_pi(t)));
    lrb_k16 in_image = lrb_kmov_kr(c, lrb_load16(c, lrb_at(pixels, 0)));
    r.hits = lrb_mask_cmplt_ps_s3(c, in_image, t, lrb_full_ps(RAYS16_CONSTANT(w->constants, infinity)));
    front = r.zero;
    for (int axis = 0; axis < 3; axis++)
        r.lo[axis] = r.hi[axis] = r.zero;
    for (int k = 0; k < 4; k++)
        height[k] = r.zero;
    if (lrb_jz(c, lrb_kortest(c, r.hits, r.hits)))
        return r;
    shadow16_normals(c, w, frame, r.hits, r.zero, n);
    shadow16_origins(c, w, r.hits, r.zero, t, n, o);
    shadow16_shade(c, w, r.hits, r.zero, n, o);
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f corner[4];
        shadow16_corners(c, w, axis, o[axis], corner, &r.lo[axis], &r.hi[axis]);
        lrb_v16f normal = lrb_load_1to16_ps(c, SHADOW16_LIGHT(w->constants, normal[axis]));
        front = axis ? lrb_madd231_ps(c, front, corner[0], normal) : lrb_mul_ps(c, corner[0], normal);
        for (int k = 0; k < 4; k++)
            height[k] = axis ? lrb_madd231_ps(c, height[k], n[axis], corner[k]) : lrb_mul_ps(c, n[axis], corner[k]);
    }
    highest = lrb_max_ps(c, height[0], height[1]);
    highest = lrb_max_ps(c, highest, lrb_max_ps(c, height[2], height[3]));
    r.alive = lrb_mask_cmplt_ps(c, r.hits, front, r.zero);
    r.alive = lrb_mask_cmplt_ps(c, r.alive, r.zero, highest);
    r.slack = shadow16_bounds(c, w, r.zero, r.lo, r.hi);
    return r;
}

/* Place of the set of samples that pixel f of the block uses in this pass. */
LRB_INLINE lrb_ptr shadow16_set(lrb_ctx *c, const shadow16 *w, lrb_r64 f)
{
    _Static_assert(sizeof(job_sample_set) == 1 << 9, "sets are addressed by a shift");
    lrb_r64 set = w->interleaved ? f : lrb_imm(0);
    if (w->passes > 1) {
        lrb_r64 pass = lrb_load32(c, lrb_at(w->scratch, SCRATCH_PASS));
        set = w->interleaved ? lrb_xor(c, f, pass) : pass;
    }
    return lrb_lea(c, w->samples, lrb_shl(c, set, 9), 1, 0);
}

/* The 16 rays of pixel f. */
LRB_INLINE void shadow16_rays(lrb_ctx *c, lrb_ptr lane, lrb_ptr set, lrb_v16f d[3])
{
    for (int axis = 0; axis < 3; axis++) {
        d[axis] = lrb_load_ps(c, lrb_at(set, (int32_t)offsetof(job_sample_set, delta[axis])));
        d[axis] = lrb_add_ps_s3(c, d[axis], lrb_1to16_ps(lrb_at(lane, SCRATCH_TO_LIGHT + 64 * axis)));
    }
}

/* A lane's origin, x y z 0 in groups: three and zeros as triangle records take it (x 0x111), or four as boxes do (0x1111).
   `lane`: scratch + 4 * lane. */
LRB_INLINE lrb_v16f shadow16_origin(lrb_ctx *c, lrb_ptr lane, uint64_t x, lrb_v16f zero)
{
    lrb_v16f o = zero;
    for (int axis = 0; axis < 3; axis++) {
        lrb_k16 words = lrb_kmov_kr(c, lrb_imm(x << axis));
        o = lrb_mask_mov_ps_s3(c, o, words, lrb_1to16_ps(lrb_at(lane, SCRATCH_HIT_POINTS + 64 * axis)));
    }
    return o;
}

/**
 * Which of 16 rays of one origin a triangle blocks: those that meet it between both ends, within its bounds. Counts as one
 * isect test.
 *
 * @param place, at  where the triangle's edge planes are
 * @param lane       scratch + 4 * the lane of the origin
 * @param m          rays to test
 */
LRB_INLINE lrb_k16 shadow16_blocked(lrb_ctx *c, const shadow16 *w, lrb_ptr place, const triangle16_layout *at, lrb_ptr lane,
                                    lrb_ptr record, lrb_k16 m, const lrb_v16f d[3], lrb_v16f zero)
{
    triangle16_meeting hit = triangle16_meet(c, place, at, record, w->cull, m, d, zero);
    if (!hit.m.bits) /* the branch is triangle16_meet's own */
        return hit.m;
    m = lrb_mask_cmple_ps_s3(c, hit.m, hit.t, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, nearest)));
    m = lrb_kxor(c, m, hit.m); /* beyond the nearest */
    m = lrb_mask_cmplt_ps_s3(c, m, hit.t, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, farthest)));
    if (lrb_jz(c, lrb_kortest(c, m, m)))
        return m;
    lrb_v16f origin = shadow16_origin(c, lane, 0x111, zero);
    return triangle16_in_bounds(c, lrb_at(lane, SCRATCH_LIGHT_REACH), w->scratch, origin, record, m, d, hit.t);
}

/** No sample seen yet. What several passes need to know of each other is in scratch: a traversal leaves no registers for it. */
LRB_INLINE void shadow16_begin_passes(lrb_ctx *c, const shadow16 *w, const shadow16_start *start)
{
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_SEEN), start->zero);
    if (w->passes > 1) {
        lrb_store32(c, lrb_at(w->scratch, SCRATCH_ALIVE), lrb_kmov_rk(c, start->alive));
        lrb_store32(c, lrb_at(w->scratch, SCRATCH_PASS), lrb_imm(0));
    }
}

/** Of the pixels that may see the light all samples that are taken are unblocked, of the others none. Returns those pixels. */
LRB_INLINE lrb_k16 shadow16_begin_pass(lrb_ctx *c, const shadow16 *w, const shadow16_start *start)
{
    lrb_k16 alive = start->alive;
    if (w->passes > 1)
        alive = lrb_kmov_kr(c, lrb_load32(c, lrb_at(w->scratch, SCRATCH_ALIVE)));
    lrb_v16i none = lrb_load_1to16_pi(c, SHADOW16_LIGHT(w->constants, all_samples));
    lrb_v16i occlusion = lrb_mask_mov_pi_s3(c, none, alive, lrb_1to16_pi(SHADOW16_LIGHT(w->constants, untaken_samples)));
    lrb_store_pi(c, lrb_at(w->scratch, SCRATCH_OCCLUSION), occlusion);
    return alive;
}

/** Add up what is seen. Bits are counted in all lanes at once, in pairs, fours, eights. */
LRB_INLINE void shadow16_end_pass(lrb_ctx *c, const shadow16 *w)
{
    lrb_v16i bits = lrb_load_1to16_pi(c, SHADOW16_LIGHT(w->constants, all_samples));
    bits = lrb_xor_pi_s3(c, bits, lrb_full_pi(lrb_at(w->scratch, SCRATCH_OCCLUSION)));
    for (int step = 0; step < 4; step++) {
        lrb_v16i shift = lrb_load_1to16_pi(c, SHADOW16_LIGHT(w->constants, count_shift[step]));
        lrb_v16i upper = lrb_srl_pi(c, bits, shift);
        lrb_s3i fields = lrb_1to16_pi(SHADOW16_LIGHT(w->constants, count_fields[step]));
        upper = lrb_and_pi_s3(c, upper, fields);
        bits = lrb_and_pi_s3(c, bits, fields);
        bits = lrb_add_pi(c, bits, upper);
    }
    lrb_v16f seen = lrb_cvtpi2ps(c, bits, LRB_RN, LRB_ADJUST_NONE);
    seen = lrb_add_ps_s3(c, seen, lrb_full_ps(lrb_at(w->scratch, SCRATCH_SEEN)));
    lrb_store_ps(c, lrb_at(w->scratch, SCRATCH_SEEN), seen);
}

/** Whether another pass follows. */
LRB_INLINE bool shadow16_next_pass(lrb_ctx *c, const shadow16 *w)
{
    if (w->passes == 1)
        return false;
    lrb_r64 pass = lrb_add(c, lrb_load32(c, lrb_at(w->scratch, SCRATCH_PASS)), lrb_imm(1));
    lrb_store32(c, lrb_at(w->scratch, SCRATCH_PASS), pass);
    return lrb_jb(c, lrb_cmp(c, pass, lrb_imm(w->passes)));
}

/* Visibility and depth into the rows of pixels; lit, too, if no filter comes. */
LRB_INLINE void shadow16_end_rows(lrb_ctx *c, const shadow16 *w, lrb_k16 hits, lrb_v16f visibility)
{
    const shadow16_rows rows = shadow16_rows_of(c, w);
    lrb_ptr frame = lrb_lea(c, w->frame, lrb_shl(c, w->block, 6), 1, 0);
    lrb_v16f depth = lrb_load_1to16_ps(c, lrb_at(w->filter, (int32_t)offsetof(job_filter, infinity)));
    depth = lrb_mask_load_ps(c, depth, hits, lrb_at(frame, (int32_t)offsetof(job_frame_tile, t)));
    shadow16_store_rows(c, &rows, offsetof(job_row, depth), depth);
    shadow16_store_rows(c, &rows, offsetof(job_row, visibility), visibility);
    if (w->filtered)
        return;
    lrb_v16f lit = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(visibility), lrb_castps_pi(visibility)));
    lit = lrb_mask_mul_ps_s3(c, lit, hits, visibility, lrb_full_ps(lrb_at(w->scratch, SCRATCH_SHADING)));
    shadow16_store_rows(c, &rows, offsetof(job_row, lit), lit);
}

/** A block's results: 1 for pixels without a hit. */
LRB_INLINE void shadow16_end(lrb_ctx *c, const shadow16 *w, lrb_k16 hits)
{
    lrb_ptr shadows = lrb_lea(c, w->shadows, lrb_shl(c, w->block, 6), 1, 0);
    lrb_v16f seen = lrb_load_ps(c, lrb_at(w->scratch, SCRATCH_SEEN));
    seen = lrb_mul_ps_s3(c, seen, lrb_1to16_ps(SHADOW16_LIGHT(w->constants, share)));
    lrb_v16f visibility = lrb_load_1to16_ps(c, SHADOW16_LIGHT(w->constants, one));
    visibility = lrb_mask_mov_ps(c, visibility, hits, seen);
    lrb_store_ps(c, lrb_at(shadows, (int32_t)offsetof(job_shadow_tile, visibility)), visibility);
    lrb_v16i occlusion = lrb_load_pi(c, lrb_at(w->scratch, SCRATCH_OCCLUSION));
    lrb_store_pi(c, lrb_at(shadows, (int32_t)offsetof(job_shadow_tile, occlusion)), occlusion);
    shadow16_end_rows(c, w, hits, visibility);
}

#endif
