/* 16 rays with one origin against one triangle: edge planes through the origin, shared by culling and intersection.
 *
 * This is the Moeller-Trumbore test rearranged for a common origin: with vertices a, b, c relative to it, a ray's signed
 * volumes over the edges are d.(b x c), d.(c x a), d.(a x b); it hits where all three have one sign, and they are the
 * barycentric weights of a, b and c. The cross products depend on the triangle alone and are formed once for
 * 16 rays or 256. They are computed to about one unit in the last place, with the rounding errors of their
 * products added back (Cornea, Harrison and Tang's symmetric form of Kahan's difference of products), and an edge
 * gives exactly the negative plane to its other triangle: edges do not leak (X5; vertices may, docs/kernels.md), and
 * edges seen nearly end-on, where a plain cross product loses all digits, stay sharp. The distance is that of the plane,
 * N.a / N.d, with the normal from the scene's vertices.
 */
#ifndef KERNELS_TRIANGLE16_H
#define KERNELS_TRIANGLE16_H

#include "kernels/kernel.h"
#include "kernels/rays16.h"
#include "kernels/scratch.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_TRIANGLE

/* Ask for the next triangle of a leaf while this one is tested; behind the last one that is the first of another leaf. */
LRB_INLINE void triangle16_prefetch_next(lrb_ctx *c, lrb_ptr record)
{
    lrb_prefetch1(c, lrb_at(record, (int32_t)sizeof(bvh_triangle)));
}

/* Words of the three edge planes in scratch, by the vertex opposite the edge: group 0 holds a x b, 1 b x c, 2 c x a, the
   components of a group in the order z, x, y that one rotation leaves them in. */
enum { TRIANGLE16_EDGE_A = SCRATCH_EDGES + 16, TRIANGLE16_EDGE_B = SCRATCH_EDGES + 32, TRIANGLE16_EDGE_C = SCRATCH_EDGES };
static const int triangle16_component[3] = {4, 8, 0}; /* byte offset of x, y, z in a group */

/* Where the edge planes opposite a, b and c and the plane's distance stand, for one origin: byte offsets from a place in scratch. */
typedef struct triangle16_layout {
    int edge[3], component[3], plane;
} triangle16_layout;
static const triangle16_layout triangle16_shared = {{TRIANGLE16_EDGE_A, TRIANGLE16_EDGE_B, TRIANGLE16_EDGE_C}, {4, 8, 0}, SCRATCH_PLANE};

/* Sum of the words of each group of four, in all of them. */
LRB_INLINE lrb_v16f triangle16_group_sum(lrb_ctx *c, lrb_v16f v)
{
    v = lrb_add_ps_s3(c, v, lrb_swizzle_ps(v, LRB_CDAB));
    return lrb_add_ps_s3(c, v, lrb_swizzle_ps(v, LRB_BADC));
}

/* a x b, b x c, c x a of the groups of `from` and `to`: from[j] to[j+1] - to[j] from[j+1] in word j. */
LRB_INLINE lrb_v16f triangle16_cross(lrb_ctx *c, lrb_v16f from, lrb_v16f to)
{
    lrb_v16f p = lrb_mul_ps_s3(c, from, lrb_swizzle_ps(to, LRB_DACB));
    lrb_v16f q = lrb_mul_ps_s3(c, to, lrb_swizzle_ps(from, LRB_DACB));
    lrb_v16f p_error = lrb_msub231_ps_s3(c, lrb_mov_ps(c, p), from, lrb_swizzle_ps(to, LRB_DACB));
    lrb_v16f q_error = lrb_msub231_ps_s3(c, lrb_mov_ps(c, q), to, lrb_swizzle_ps(from, LRB_DACB));
    lrb_v16f product = lrb_sub_ps(c, p, q);
    lrb_v16f error = lrb_sub_ps(c, p_error, q_error);
    return lrb_add_ps(c, product, error);
}

/*
 * The plane's distance from N.a, N.b, N.c in groups 0 to 2: the one nearest to 0, and 0 if they differ in sign. They are
 * equal but for rounding; where the origin is a vertex one of them is exactly 0, and then nothing is hit (X8).
 */
LRB_INLINE lrb_v16f triangle16_plane(lrb_ctx *c, lrb_v16f a, lrb_v16f zero, bool cull)
{
    lrb_v16f b = lrb_shuf128x32_ps(c, a, 0xc9, LRB_DCBA);
    lrb_v16f third = lrb_shuf128x32_ps(c, a, 0xd2, LRB_DCBA);
    lrb_v16f largest = lrb_max_ps(c, lrb_max_ps(c, a, b), third);
    if (cull) /* front: all negative */
        return largest;
    lrb_v16f smallest = lrb_min_ps(c, lrb_min_ps(c, a, b), third);
    smallest = lrb_max_ps(c, smallest, zero);
    largest = lrb_min_ps(c, largest, zero);
    return lrb_add_ps(c, smallest, largest);
}

/**
 * Translate a triangle record to the origin and leave its edge planes and plane distance in scratch.
 *
 * @param origin   x y z 0 three times, then 0
 * @param record   of the triangle
 * @param cull     1: stop if the triangle shows its back, or its edge, to the origin
 * @param edges    out: the edge planes as stored
 *
 * Returns false if it was culled. One test for all rays: with a common origin the facing is
 * theirs as well.
 */
LRB_INLINE bool triangle16_setup(lrb_ctx *c, lrb_ptr scratch, lrb_v16f origin, lrb_ptr record, bool cull, lrb_v16f *edges)
{
    lrb_v16f from = lrb_subr_ps_s3(c, origin, lrb_full_ps(lrb_at(record, 0))); /* a | b | c | normal */
    lrb_v16f normal = lrb_shuf128x32_ps(c, from, 0xff, LRB_DCBA);
    lrb_v16f zero = lrb_sub_ps(c, normal, normal);
    lrb_v16f plane = triangle16_plane(c, triangle16_group_sum(c, lrb_mul_ps(c, normal, from)), zero, cull);
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_PLANE), plane);
    if (cull) {
        lrb_r64 front = lrb_kmov_rk(c, lrb_cmplt_ps(c, plane, zero));
        if (lrb_jz(c, lrb_test(c, front, lrb_imm(1))))
            return false;
    }
    lrb_v16f to = lrb_shuf128x32_ps(c, from, 0xc9, LRB_DCBA); /* b | c | a | normal */
    *edges = triangle16_cross(c, from, to);
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_EDGES), *edges);
    return true;
}

/** d . e for 16 directions and one edge plane: the same three operations for rays and for corner rays. */
LRB_INLINE lrb_v16f triangle16_edge(lrb_ctx *c, lrb_ptr place, const triangle16_layout *at, int edge, const lrb_v16f d[3])
{
    lrb_v16f sum = lrb_mul_ps_s3(c, d[0], lrb_1to16_ps(lrb_at(place, at->edge[edge] + at->component[0])));
    sum = lrb_madd231_ps_s3(c, sum, d[1], lrb_1to16_ps(lrb_at(place, at->edge[edge] + at->component[1])));
    return lrb_madd231_ps_s3(c, sum, d[2], lrb_1to16_ps(lrb_at(place, at->edge[edge] + at->component[2])));
}

/* Hits of 16 rays: lanes of `m`, all other lanes hold anything. */
typedef struct triangle16_hits {
    lrb_k16 m;
    lrb_v16f t, u, v; /* u, v: weights of the second and third vertex */
} triangle16_hits;

/* Lanes whose weights have one sign, and not all three 0 (edge-on, hard case X8). */
LRB_INLINE lrb_k16 triangle16_inside(lrb_ctx *c, bool cull, lrb_k16 m, lrb_v16f a, lrb_v16f b, lrb_v16f w, lrb_v16f sum, lrb_v16f zero)
{
    lrb_v16f largest = lrb_max_ps(c, lrb_max_ps(c, a, b), w);
    lrb_k16 inside = lrb_mask_cmple_ps(c, m, largest, zero); /* front: det(a, b, c) is negative */
    if (!cull) {
        lrb_v16f smallest = lrb_min_ps(c, lrb_min_ps(c, a, b), w);
        inside = lrb_kor(c, inside, lrb_mask_cmple_ps(c, m, zero, smallest));
    }
    return lrb_mask_cmpneq_ps(c, inside, sum, zero);
}

/*
 * Lanes of m whose point at distance t lies in the triangle's bounds, or as good as. What this refuses are rays within
 * rounding of an edge's line but beyond the edge's end: between the long edges of a needle both volumes are noise far
 * past its tip (X6), and the distance of a plane seen nearly edge-on is noise as well. Box tests refuse some of those hits
 * and let others pass, by the boxes that a kernel happens to test; so none of them may count.
 */
LRB_INLINE lrb_k16 triangle16_in_bounds(lrb_ctx *c, lrb_mem reach_per_t, lrb_ptr scratch, lrb_v16f origin, lrb_ptr record, lrb_k16 m,
                                        const lrb_v16f d[3], lrb_v16f t)
{
    lrb_v16f first = lrb_subr_ps_s3(c, origin, lrb_full_ps(lrb_at(record, 0))); /* a | b | c | normal */
    lrb_v16f second = lrb_shuf128x32_ps(c, first, 0xc9, LRB_DCBA);
    lrb_v16f third = lrb_shuf128x32_ps(c, first, 0xd2, LRB_DCBA);
    lrb_v16f reach = lrb_mul_ps_s3(c, t, lrb_1to16_ps(reach_per_t));
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_LOW), lrb_min_ps(c, lrb_min_ps(c, first, second), third));
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_HIGH), lrb_max_ps(c, lrb_max_ps(c, first, second), third));
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f above = lrb_madd231_ps(c, lrb_mov_ps(c, reach), d[axis], t);
        lrb_v16f below = lrb_msub231_ps(c, lrb_mov_ps(c, reach), d[axis], t);
        m = lrb_mask_cmpnlt_ps_s3(c, m, above, lrb_1to16_ps(lrb_at(scratch, SCRATCH_LOW + 4 * axis)));
        m = lrb_mask_cmple_ps_s3(c, m, below, lrb_1to16_ps(lrb_at(scratch, SCRATCH_HIGH + 4 * axis)));
    }
    return m;
}

/* The rays of m that meet the triangle, or its plane behind them: their weights and distances. */
typedef struct triangle16_meeting {
    lrb_k16 m;
    lrb_v16f weight[3], sum, t;
} triangle16_meeting;

/* Where 16 rays meet a triangle whose edge planes are at `place`. t is formed if m is not empty: a branch. */
LRB_INLINE triangle16_meeting triangle16_meet(lrb_ctx *c, lrb_ptr place, const triangle16_layout *at, lrb_ptr record, bool cull, lrb_k16 m,
                                              const lrb_v16f d[3], lrb_v16f zero)
{
    triangle16_meeting r = {.t = zero};
    const int32_t normal = (int32_t)offsetof(bvh_triangle, normal);
    for (int i = 0; i < 3; i++)
        r.weight[i] = triangle16_edge(c, place, at, i, d);
    r.sum = lrb_add_ps(c, lrb_add_ps(c, r.weight[0], r.weight[1]), r.weight[2]);
    r.m = triangle16_inside(c, cull, m, r.weight[0], r.weight[1], r.weight[2], r.sum, zero);
    if (lrb_jz(c, lrb_kortest(c, r.m, r.m)))
        return r;
    lrb_v16f det = lrb_mul_ps_s3(c, d[0], lrb_1to16_ps(lrb_at(record, normal)));
    det = lrb_madd231_ps_s3(c, det, d[1], lrb_1to16_ps(lrb_at(record, normal + 4)));
    det = lrb_madd231_ps_s3(c, det, d[2], lrb_1to16_ps(lrb_at(record, normal + 8)));
    r.t = lrb_mul_ps_s3(c, rays16_reciprocal(c, det), lrb_1to16_ps(lrb_at(place, at->plane)));
    return r;
}

/**
 * Intersect 16 rays with the triangle that triangle16_setup left in scratch.
 *
 * @param m        lanes to test
 * @param best_t   distance of each lane's nearest hit, best_id its triangle: a hit counts if it is nearer, or as near
 *                 and of a smaller id
 *
 * Counts as one isect test. Returns the lanes that now have a nearer hit.
 */
LRB_INLINE triangle16_hits triangle16_intersect(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, lrb_v16f origin, lrb_ptr record,
                                                bool cull, lrb_k16 m, const lrb_v16f d[3], lrb_v16f zero, lrb_v16f best_t, lrb_v16i best_id)
{
    triangle16_meeting at = triangle16_meet(c, scratch, &triangle16_shared, record, cull, m, d, zero);
    triangle16_hits hits = {.m = at.m, .t = at.t, .u = zero, .v = zero};
    if (!at.m.bits) /* the branch is triangle16_meet's own */
        return hits;
    hits.m = lrb_mask_cmplt_ps(c, hits.m, zero, hits.t);
    lrb_k16 nearer = lrb_mask_cmplt_ps(c, hits.m, hits.t, best_t);
    lrb_k16 equal = lrb_mask_cmpeq_ps(c, hits.m, hits.t, best_t);
    lrb_k16 kept = lrb_mask_cmple_pi_s3(c, equal, best_id, lrb_1to16_pi(lrb_at(record, (int32_t)offsetof(bvh_triangle, id))));
    hits.m = lrb_kor(c, nearer, lrb_kxor(c, equal, kept));
    if (lrb_jz(c, lrb_kortest(c, hits.m, hits.m)))
        return hits;
    hits.m = triangle16_in_bounds(c, RAYS16_CONSTANT(constants, reach), scratch, origin, record, hits.m, d, hits.t);
    if (lrb_jz(c, lrb_kortest(c, hits.m, hits.m)))
        return hits;
    lrb_v16f scale = rays16_reciprocal(c, at.sum);
    hits.u = lrb_mul_ps(c, at.weight[1], scale);
    hits.v = lrb_mul_ps(c, at.weight[2], scale);
    return hits;
}

#endif
