/* Corner-ray culling of shadow frusta, each lane with an origin of its own: which frusta can a triangle's hits lie in?
 *
 * As kernels/mft/corner_cull.h, but the edge planes differ from lane to lane. They are formed as triangle16_setup forms them for
 * one origin, operation by operation, and are left in scratch for the intersection test: a frustum's rays get the same bits as a
 * packet's. The rounding to allow for is larger, u = 2^-24, D the largest component of a corner ray:
 *
 *   3 roundings of a dot product, at the corner and at the ray                              2 * 3 u
 *   a ray is corner + (a U + b V), six roundings of terms of at most 2 D and one of D           7 u D
 *   a corner ray likewise (kernels/mft/shrink.h), or better                                    7 u D
 *
 * together 20 u |edge|_1 D; the guard takes 32, and D is bounded by the sum over the axes.
 */
#ifndef KERNELS_MFT_LANE_CULL_H
#define KERNELS_MFT_LANE_CULL_H

#include "kernels/shadow16.h"
#include "kernels/slab16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_LANE_CULL

/* Edge planes opposite a, b and c by lane: words of vectors instead of vectors of words. */
static const triangle16_layout lane_cull_layout = {
    {SCRATCH_LANE_EDGES, SCRATCH_LANE_EDGES + 192, SCRATCH_LANE_EDGES + 384}, {0, 64, 128}, SCRATCH_LANE_PLANE};

/* Vertex 0, 1 or 2 relative to each lane's origin. */
LRB_INLINE void lane_cull_vertex(lrb_ctx *c, const slab16 *s, lrb_ptr record, int vertex, lrb_v16f out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = lrb_subr_ps_s3(c, s->origin[axis], lrb_1to16_ps(lrb_at(record, 16 * vertex + 4 * axis)));
}

/* N.v, in the order of triangle16_group_sum. */
LRB_INLINE lrb_v16f lane_cull_distance(lrb_ctx *c, lrb_ptr record, const lrb_v16f v[3])
{
    const int32_t normal = (int32_t)offsetof(bvh_triangle, normal);
    lrb_v16f x = lrb_mul_ps_s3(c, v[0], lrb_1to16_ps(lrb_at(record, normal)));
    lrb_v16f y = lrb_mul_ps_s3(c, v[1], lrb_1to16_ps(lrb_at(record, normal + 4)));
    lrb_v16f z = lrb_mul_ps_s3(c, v[2], lrb_1to16_ps(lrb_at(record, normal + 8)));
    return lrb_add_ps(c, lrb_add_ps(c, x, y), z);
}

/* The plane's distance from each lane's origin, as triangle16_plane. Returns the lanes that see the front, or all. */
LRB_INLINE lrb_k16 lane_cull_plane(lrb_ctx *c, const slab16 *s, lrb_ptr scratch, lrb_ptr record, bool cull, lrb_k16 m)
{
    lrb_v16f v[3], distance[3];
    for (int vertex = 0; vertex < 3; vertex++) {
        lane_cull_vertex(c, s, record, vertex, v);
        distance[vertex] = lane_cull_distance(c, record, v);
    }
    lrb_v16f plane = lrb_max_ps(c, lrb_max_ps(c, distance[0], distance[1]), distance[2]);
    if (!cull) {
        lrb_v16f smallest = lrb_min_ps(c, lrb_min_ps(c, distance[0], distance[1]), distance[2]);
        smallest = lrb_max_ps(c, smallest, s->zero);
        plane = lrb_min_ps(c, plane, s->zero);
        plane = lrb_add_ps(c, smallest, plane);
    }
    lrb_store_ps(c, lrb_at(scratch, SCRATCH_LANE_PLANE), plane);
    return cull ? lrb_mask_cmplt_ps(c, m, plane, s->zero) : m;
}

/* One component of from x to, as triangle16_cross. */
LRB_INLINE lrb_v16f lane_cull_component(lrb_ctx *c, const lrb_v16f from[3], const lrb_v16f to[3], int i, int j)
{
    lrb_v16f p = lrb_mul_ps(c, from[i], to[j]);
    lrb_v16f q = lrb_mul_ps(c, to[i], from[j]);
    lrb_v16f p_error = lrb_msub231_ps(c, lrb_mov_ps(c, p), from[i], to[j]);
    lrb_v16f q_error = lrb_msub231_ps(c, lrb_mov_ps(c, q), to[i], from[j]);
    lrb_v16f product = lrb_sub_ps(c, p, q);
    lrb_v16f error = lrb_sub_ps(c, p_error, q_error);
    return lrb_add_ps(c, product, error);
}

/* from x to into scratch. */
LRB_INLINE void lane_cull_cross(lrb_ctx *c, lrb_ptr scratch, int edge, const lrb_v16f from[3], const lrb_v16f to[3], lrb_v16f out[3])
{
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = lane_cull_component(c, from, to, (axis + 1) % 3, (axis + 2) % 3);
        lrb_store_ps(c, lrb_at(scratch, lane_cull_layout.edge[edge] + lane_cull_layout.component[axis]), out[axis]);
    }
}

/* Rounding bound of an edge plane. */
LRB_INLINE lrb_v16f lane_cull_guard(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, const lrb_v16f edge[3])
{
    lrb_v16f sum = edge[0];
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16i magnitude = lrb_and_pi_s3(c, lrb_castps_pi(edge[axis]), lrb_full_pi(RAYS16_CONSTANT(constants, absolute)));
        sum = axis ? lrb_add_ps(c, sum, lrb_castpi_ps(magnitude)) : lrb_castpi_ps(magnitude);
    }
    return lrb_mul_ps_s3(c, sum, lrb_full_ps(lrb_at(scratch, SCRATCH_LIGHT_GUARD)));
}

/* Take from `front` and `back` the lanes whose four corner rays lie outside one edge; false if none is left in either. */
LRB_INLINE bool lane_cull_edge(lrb_ctx *c, lrb_ptr constants, lrb_ptr scratch, lrb_v16f zero, const lrb_v16f edge[3], bool cull,
                               lrb_k16 *front, lrb_k16 *back)
{
    lrb_v16f volume[4];
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 4; k++) {
            lrb_s3f corner = lrb_full_ps(lrb_at(scratch, SCRATCH_LIGHT_CORNERS + 192 * k + 64 * axis));
            volume[k] = axis ? lrb_madd231_ps_s3(c, volume[k], edge[axis], corner) : lrb_mul_ps_s3(c, edge[axis], corner);
        }
    lrb_v16f guard = lane_cull_guard(c, constants, scratch, edge);
    lrb_v16f half = lrb_min_ps(c, volume[0], volume[1]);
    lrb_v16f least = lrb_min_ps(c, half, lrb_min_ps(c, volume[2], volume[3]));
    *front = lrb_mask_cmple_ps(c, *front, least, guard);
    if (!cull) {
        half = lrb_max_ps(c, volume[0], volume[1]);
        lrb_v16f most = lrb_max_ps(c, half, lrb_max_ps(c, volume[2], volume[3]));
        *back = lrb_mask_cmpnlt_ps(c, *back, most, lrb_sub_ps(c, zero, guard));
    }
    return !lrb_jz(c, lrb_kortest(c, *front, cull ? *front : *back));
}

/**
 * The frusta of m that may hold a hit of a triangle. Leaves its edge planes and its distance, as seen from each lane, in scratch
 * (lane_cull_layout), unless it returns no lanes.
 *
 * @param s     origins of the lanes
 * @param cull  1: front hits only, all volumes negative; 0: or all positive
 */
LRB_INLINE lrb_k16 lane_cull(lrb_ctx *c, const slab16 *s, lrb_ptr constants, lrb_ptr scratch, lrb_ptr record, bool cull, lrb_k16 m)
{
    lrb_v16f v[3][3], edge[3];
    lrb_k16 front = lane_cull_plane(c, s, scratch, record, cull, m), back = front;
    if (cull && lrb_jz(c, lrb_kortest(c, front, front)))
        return front;
    lane_cull_vertex(c, s, record, 0, v[0]);
    lane_cull_vertex(c, s, record, 1, v[1]);
    for (int from = 0; from < 3; from++) {
        const int to = (from + 1) % 3, opposite = (from + 2) % 3;
        if (from > 0) /* again for the first: too many to keep */
            lane_cull_vertex(c, s, record, to, v[to]);
        lane_cull_cross(c, scratch, opposite, v[from], v[to], edge);
        if (!lane_cull_edge(c, constants, scratch, s->zero, edge, cull, &front, &back))
            return lrb_mask(0);
    }
    return cull ? front : lrb_kor(c, front, back);
}

#endif
