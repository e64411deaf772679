/* Silhouettes seen on the way: which pixels does an edge cross, behind which one of its triangle's neighbours does not go on?
 * Benthin and Wald 2009, 6.1; docs/kernels.md.
 *
 * All of it is conservative. A triangle's volume over an edge is linear in the direction, so at a pixel's middle it says whether
 * the edge's line crosses the pixel's cell, the square that holds its samples. That the edge itself does is then asked on both
 * axes of the image: a cell's four sides are planes through the eye, and an edge with both ends beyond one of them is outside, be
 * an end in front of the eye or behind it. Its distance in the cell is at least that of its triangle's plane there, and at least
 * that of its nearer end.
 *
 * What hides it is found with it. For each pixel a limit is kept: how far the surface in its middle would be two pixels beside it,
 * were it flat; the limit of a frustum is the farthest of its pixels'. When the tile is done with, and so the limits are final, a
 * pixel is marked if its nearest silhouette is no farther than the farthest limit of the pixel and the eight around it, those
 * beyond the tile being unknown, thus unlimited: where a surface ends one of them sees past it (docs/kernels.md).
 */
#ifndef KERNELS_MFT_SILHOUETTES_H
#define KERNELS_MFT_SILHOUETTES_H

#include "kernels/accel/bvh_edges.h"
#include "kernels/job_msaa.h"
#include "kernels/mft/corner_cull.h"
#include "kernels/mft/mft_frusta.h"
#include "kernels/mft/silhouettes_scratch.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_SILHOUETTES

#define SILHOUETTES_CONSTANT(w, field) lrb_at((w)->constants, (int32_t)offsetof(job_msaa_constants, field))

typedef struct silhouettes {
    lrb_ptr constants;   /* job_msaa_constants */
    lrb_ptr tile, edge;  /* job_tile; nearest silhouettes by block and pixel */
    lrb_ptr marked;      /* masks by block */
    uint32_t neighbours; /* from a triangle's record to its edges */
    bool whole_blocks;   /* blocks are marked, not pixels */
} silhouettes;

/* |v| */
LRB_INLINE lrb_v16f silhouettes_magnitude(lrb_ctx *c, lrb_ptr constants, lrb_v16f v)
{
    return lrb_castpi_ps(lrb_and_pi_s3(c, lrb_castps_pi(v), lrb_full_pi(RAYS16_CONSTANT(constants, absolute))));
}

/* How much the volumes over the edges, and N.d, change from a pixel to the next: |p.dx| + |p.dy| of the groups of `planes`. */
LRB_INLINE lrb_v16f silhouettes_extent(lrb_ctx *c, const silhouettes *w, lrb_ptr constants, lrb_v16f planes)
{
    lrb_v16f right = lrb_mul_ps_s3(c, planes, lrb_full_ps(SILHOUETTES_CONSTANT(w, dx)));
    lrb_v16f down = lrb_mul_ps_s3(c, planes, lrb_full_ps(SILHOUETTES_CONSTANT(w, dy)));
    right = silhouettes_magnitude(c, constants, triangle16_group_sum(c, right));
    down = silhouettes_magnitude(c, constants, triangle16_group_sum(c, down));
    return lrb_add_ps(c, right, down);
}

/* The edges that are silhouettes and that this triangle has to look at: bits 0, 4, 8. The vertices opposite an edge, the triangle's
   and its neighbour's, have volumes of one sign over it; that of the triangle's own is the sign of its plane's distance. */
LRB_INLINE lrb_k16 silhouettes_edges(lrb_ctx *c, const silhouettes *w, const mft_group *g, lrb_ptr edges, lrb_v16f planes, lrb_v16f zero)
{
    lrb_v16f opposite = lrb_subr_ps_s3(c, g->origin, lrb_full_ps(lrb_at(edges, 0)));
    lrb_v16f products = lrb_mul_ps(c, opposite, planes);
    lrb_v16f volume = triangle16_group_sum(c, products);
    lrb_v16f tolerance = triangle16_group_sum(c, silhouettes_magnitude(c, g->constants, products));
    tolerance = lrb_mul_ps_s3(c, tolerance, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, minus_tolerance)));
    lrb_v16f plane = lrb_load_1to16_ps(c, lrb_at(g->scratch, SCRATCH_PLANE));
    lrb_k16 front = lrb_cmplt_ps(c, plane, zero);
    volume = lrb_mask_sub_ps(c, volume, front, zero, volume);
    lrb_k16 found = lrb_cmpnlt_ps(c, volume, tolerance);
    found = lrb_kor(c, found, lrb_cmpeq_ps(c, plane, zero)); /* seen edge-on: all of them */
    lrb_r64 always = lrb_load32(c, lrb_at(edges, (int32_t)offsetof(bvh_edges, always)));
    found = lrb_kor(c, found, lrb_kmov_kr(c, always));
    lrb_r64 own = lrb_load32(c, lrb_at(edges, (int32_t)offsetof(bvh_edges, own)));
    return lrb_kand(c, found, lrb_kmov_kr(c, own));
}

/* Where the triangle's vertices are in the image, and what its edges have to be from a pixel's middle, into scratch. */
LRB_INLINE void silhouettes_place(lrb_ctx *c, const silhouettes *w, const mft_group *g, lrb_ptr record, lrb_v16f extent)
{
    lrb_v16f cell = lrb_load_ps(c, lrb_at(g->scratch, SCRATCH_GUARD));
    cell = lrb_madd231_ps_s3(c, cell, extent, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, reach)));
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_CELL), cell);
    lrb_v16f ends = lrb_subr_ps_s3(c, g->origin, lrb_full_ps(lrb_at(record, 0)));
    ends = lrb_shuf128x32_ps(c, ends, 0x24, LRB_DCBA); /* a | b | c | a */
    lrb_v16f x = lrb_mul_ps_s3(c, ends, lrb_full_ps(SILHOUETTES_CONSTANT(w, image_x)));
    lrb_v16f y = lrb_mul_ps_s3(c, ends, lrb_full_ps(SILHOUETTES_CONSTANT(w, image_y)));
    lrb_v16f depth = lrb_mul_ps_s3(c, ends, lrb_full_ps(SILHOUETTES_CONSTANT(w, depth)));
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_IMAGE_X), triangle16_group_sum(c, x));
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_IMAGE_Y), triangle16_group_sum(c, y));
    depth = triangle16_group_sum(c, depth);
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_DEPTH), depth);
    lrb_v16f next = lrb_shuf128x32_ps(c, depth, 0x39, LRB_DCBA); /* b | c | a | a */
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_NEAREST_END), lrb_min_ps(c, depth, next));
}

/* The frusta of m that the line of the edge crosses: its volume is 0 between their corners. `edge`: scratch + the edge's group. */
LRB_INLINE lrb_k16 silhouettes_frusta(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr edge, lrb_k16 m)
{
    lrb_v16f smallest, largest;
    corner_cull_range(c, g->scratch, edge, SCRATCH_EDGES, false, &smallest, &largest);
    m = lrb_mask_cmple_ps_s3(c, m, smallest, lrb_1to16_ps(lrb_at(edge, SCRATCH_GUARD)));
    largest = lrb_add_ps_s3(c, largest, lrb_1to16_ps(lrb_at(edge, SCRATCH_GUARD)));
    return lrb_mask_cmple_ps(c, m, s->zero, largest);
}

/* One axis of the image: the pixels of m between whose cells' two sides an end of the edge is, or its ends are on both. */
LRB_INLINE lrb_k16 silhouettes_between(lrb_ctx *c, const silhouettes *w, lrb_ptr edge, int32_t image, lrb_v16f middle, lrb_v16f zero,
                                       lrb_k16 m)
{
    lrb_v16f low[2], high[2];
    for (int end = 0; end < 2; end++) {
        lrb_mem depth = lrb_at(edge, SCRATCH_DEPTH + 16 * end);
        lrb_v16f half = lrb_load_1to16_ps(c, depth);
        half = lrb_mul_ps_s3(c, half, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, reach)));
        lrb_v16f from_middle = lrb_load_1to16_ps(c, lrb_at(edge, image + 16 * end));
        from_middle = lrb_msubr231_ps_s3(c, from_middle, middle, lrb_1to16_ps(depth));
        low[end] = lrb_add_ps(c, from_middle, half);
        high[end] = lrb_sub_ps(c, from_middle, half);
    }
    m = lrb_mask_cmple_ps(c, m, zero, lrb_max_ps(c, low[0], low[1]));
    return lrb_mask_cmple_ps(c, m, lrb_min_ps(c, high[0], high[1]), zero);
}

/* The pixels of block f whose cells the edge crosses. */
LRB_INLINE lrb_k16 silhouettes_cells(lrb_ctx *c, const slab16 *s, const silhouettes *w, const mft_group *g, lrb_ptr edge, lrb_r64 f,
                                     const lrb_v16f d[3])
{
    const triangle16_layout at = {{SCRATCH_EDGES, SCRATCH_EDGES, SCRATCH_EDGES}, {4, 8, 0}, SCRATCH_PLANE};
    lrb_v16f volume = silhouettes_magnitude(c, g->constants, triangle16_edge(c, edge, &at, 0, d));
    lrb_k16 m = lrb_cmple_ps_s3(c, volume, lrb_1to16_ps(lrb_at(edge, SCRATCH_CELL)));
    if (lrb_jz(c, lrb_kortest(c, m, m)))
        return m;
    lrb_ptr block = lrb_lea(c, g->constants, f, 4, 0);
    lrb_v16f x = lrb_load_ps(c, SILHOUETTES_CONSTANT(w, pixel_x));
    x = lrb_add_ps_s3(c, x, lrb_1to16_ps(RAYS16_CONSTANT(block, block_x)));
    x = lrb_add_ps_s3(c, x, lrb_1to16_ps(lrb_at(w->tile, (int32_t)offsetof(job_tile, x))));
    m = silhouettes_between(c, w, edge, SCRATCH_IMAGE_X, x, s->zero, m);
    lrb_v16f y = lrb_load_ps(c, SILHOUETTES_CONSTANT(w, pixel_y));
    y = lrb_add_ps_s3(c, y, lrb_1to16_ps(RAYS16_CONSTANT(block, block_y)));
    y = lrb_add_ps_s3(c, y, lrb_1to16_ps(lrb_at(w->tile, (int32_t)offsetof(job_tile, y))));
    return silhouettes_between(c, w, edge, SCRATCH_IMAGE_Y, y, s->zero, m);
}

/* How near the edge may be in the cells of a block: the triangle's plane, or the edge's nearer end. */
LRB_INLINE lrb_v16f silhouettes_distance(lrb_ctx *c, const mft_group *g, lrb_ptr record, lrb_ptr edge, const lrb_v16f d[3])
{
    const int32_t normal = (int32_t)offsetof(bvh_triangle, normal);
    lrb_v16f steepest = lrb_mul_ps_s3(c, d[0], lrb_1to16_ps(lrb_at(record, normal)));
    steepest = lrb_madd231_ps_s3(c, steepest, d[1], lrb_1to16_ps(lrb_at(record, normal + 4)));
    steepest = lrb_madd231_ps_s3(c, steepest, d[2], lrb_1to16_ps(lrb_at(record, normal + 8)));
    steepest = silhouettes_magnitude(c, g->constants, steepest);
    steepest = lrb_add_ps_s3(c, steepest, lrb_1to16_ps(lrb_at(g->scratch, SCRATCH_CELL + 48)));
    lrb_v16f t = lrb_mul_ps_s3(c, rays16_reciprocal(c, steepest), lrb_1to16_ps(lrb_at(g->scratch, SCRATCH_DISTANCE)));
    return lrb_max_ps_s3(c, t, lrb_1to16_ps(lrb_at(edge, SCRATCH_NEAREST_END)));
}

/* A silhouette against the pixels of block f. */
LRB_INLINE void silhouettes_block(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_ptr edge, lrb_r64 f)
{
    const silhouettes *w = g->user;
    lrb_v16f d[3];
    lrb_ptr first = lrb_lea(c, g->scratch, f, 4, g->first);
    lrb_k16 m = lrb_mask(0xffff);
    g->n->n[KERNEL_edge_tests]++;
    for (int axis = 0; axis < 3; axis++)
        d[axis] = lrb_add_ps_s3(c, g->delta[axis], lrb_1to16_ps(lrb_at(first, 64 * axis)));
    if (!w->whole_blocks) {
        m = silhouettes_cells(c, s, w, g, edge, f, d);
        if (lrb_jz(c, lrb_kortest(c, m, m)))
            return;
    }
    lrb_v16f t = silhouettes_distance(c, g, record, edge, d);
    lrb_ptr nearest = lrb_lea(c, w->edge, lrb_shl(c, f, 6), 1, 0);
    t = lrb_min_ps_s3(c, t, lrb_full_ps(lrb_at(nearest, 0)));
    lrb_mask_store_ps(c, lrb_at(nearest, 0), m, t);
}

/* A silhouette against the frusta of m. */
LRB_INLINE void silhouettes_edge(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_ptr edge, lrb_k16 m)
{
    g->n->n[KERNEL_silhouettes]++;
    m = silhouettes_frusta(c, s, g, edge, m);
    lrb_r64 bits = lrb_kmov_rk(c, m);
    lrb_r64 f = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
    while (!lrb_jl(c, lrb_test(c, f, f))) {
        lrb_region(c, (uint32_t)f.value);
        silhouettes_block(c, s, g, record, edge, f);
        f = lrb_bsfi(c, f, bits);
    }
    lrb_region(c, LRB_WHOLE_TILE);
}

/* mft_group.survivor: a triangle that culling has left in the frusta of m. */
LRB_INLINE void silhouettes_triangle(lrb_ctx *c, const slab16 *s, const mft_group *g, lrb_ptr record, lrb_v16f edges, lrb_k16 m)
{
    const silhouettes *w = g->user;
    if (!w)
        return;
    lrb_phase(c, KERNEL_PHASE_SILHOUETTES);
    lrb_v16f planes = lrb_mov_ps_s3(c, lrb_swizzle_ps(edges, LRB_DACB)); /* z x y to x y z */
    planes = lrb_mask_mov_ps_s3(c, planes, lrb_kmov_kr(c, lrb_imm(0xf000)), lrb_full_ps(lrb_at(record, 0))); /* the normal */
    lrb_v16f extent = silhouettes_extent(c, w, g->constants, planes);
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_EXTENT), extent);
    lrb_v16f distance = silhouettes_magnitude(c, g->constants, lrb_load_ps(c, lrb_at(g->scratch, SCRATCH_PLANE)));
    lrb_store_ps(c, lrb_at(g->scratch, SCRATCH_DISTANCE), distance);
    lrb_ptr neighbours = lrb_lea(c, record, lrb_imm(w->neighbours), 1, 0);
    lrb_r64 left = lrb_kmov_rk(c, silhouettes_edges(c, w, g, neighbours, planes, s->zero));
    if (lrb_jz(c, lrb_test(c, left, left)))
        return;
    silhouettes_place(c, w, g, record, extent);
    lrb_r64 edge = lrb_bsfi(c, lrb_imm(UINT64_MAX), left);
    lrb_store32(c, lrb_at(g->scratch, SCRATCH_EDGES_LEFT), left);
    do {
        lrb_store32(c, lrb_at(g->scratch, SCRATCH_EDGE), edge);
        silhouettes_edge(c, s, g, record, lrb_lea(c, g->scratch, edge, 4, 0), m);
        edge = lrb_load32(c, lrb_at(g->scratch, SCRATCH_EDGE));
        left = lrb_load32(c, lrb_at(g->scratch, SCRATCH_EDGES_LEFT));
        edge = lrb_bsfi(c, edge, left);
    } while (!lrb_jl(c, lrb_test(c, edge, edge)));
}

/* mft_group.nearer: how far could one see the surface that rays m of frustum f have hit, were it flat, up to two pixels beside them? */
LRB_INLINE void silhouettes_limit(lrb_ctx *c, const mft_group *g, lrb_ptr record, lrb_r64 f, const lrb_v16f d[3], lrb_k16 m)
{
    const int32_t normal = (int32_t)offsetof(bvh_triangle, normal);
    const silhouettes *w = g->user;
    if (!w)
        return;
    lrb_phase(c, KERNEL_PHASE_SILHOUETTES);
    lrb_v16f flattest = lrb_mul_ps_s3(c, d[0], lrb_1to16_ps(lrb_at(record, normal)));
    flattest = lrb_madd231_ps_s3(c, flattest, d[1], lrb_1to16_ps(lrb_at(record, normal + 4)));
    flattest = lrb_madd231_ps_s3(c, flattest, d[2], lrb_1to16_ps(lrb_at(record, normal + 8)));
    flattest = silhouettes_magnitude(c, g->constants, flattest);
    lrb_v16f extent = lrb_load_1to16_ps(c, lrb_at(g->scratch, SCRATCH_EXTENT + 48));
    flattest = lrb_msubr231_ps_s3(c, flattest, extent, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, further)));
    flattest = lrb_max_ps_s3(c, flattest, lrb_1to16_ps(RAYS16_CONSTANT(g->constants, tiny)));
    lrb_v16f t = lrb_mul_ps_s3(c, rays16_reciprocal(c, flattest), lrb_1to16_ps(lrb_at(g->scratch, SCRATCH_DISTANCE)));
    lrb_ptr limits = lrb_lea(c, g->limits, lrb_shl(c, f, 6), 1, 0);
    lrb_mask_store_ps(c, lrb_at(limits, 0), m, t);
    lrb_phase(c, KERNEL_PHASE_INTERSECTION);
}

/** No silhouettes yet; the limits are the distances of an empty frame. */
LRB_INLINE void silhouettes_clear(lrb_ctx *c, const silhouettes *w, const mft_group *g, const slab16 *s)
{
    lrb_r64 row = lrb_imm(0);
    do {
        lrb_ptr frame = lrb_lea(c, g->frame, row, 1, 0);
        lrb_ptr limits = lrb_lea(c, g->limits, row, 1, 0);
        lrb_ptr edge = lrb_lea(c, w->edge, row, 1, 0);
        lrb_store_ps(c, lrb_at(limits, 0), lrb_load_ps(c, lrb_at(frame, (int32_t)offsetof(job_frame_tile, t))));
        lrb_store_ps(c, lrb_at(edge, 0), s->infinity);
        row = lrb_add(c, row, lrb_imm(64));
    } while (lrb_jb(c, lrb_cmp(c, row, lrb_imm(1024))));
}

/* Append the pixels m of a block to the marked ones, of which there are `count`. */
LRB_INLINE lrb_r64 silhouettes_append(lrb_ctx *c, const silhouettes *w, const mft_group *g, lrb_r64 block, lrb_k16 m, lrb_r64 count)
{
    lrb_ptr corner = lrb_lea(c, g->constants, block, 4, 0);
    lrb_ptr place = lrb_lea(c, g->scratch, count, 4, 0);
    lrb_v16f x = lrb_load_ps(c, SILHOUETTES_CONSTANT(w, pixel_x));
    lrb_v16f y = lrb_load_ps(c, SILHOUETTES_CONSTANT(w, pixel_y));
    x = lrb_add_ps_s3(c, x, lrb_1to16_ps(RAYS16_CONSTANT(corner, block_x)));
    y = lrb_add_ps_s3(c, y, lrb_1to16_ps(RAYS16_CONSTANT(corner, block_y)));
    x = lrb_add_ps_s3(c, x, lrb_1to16_ps(lrb_at(w->tile, (int32_t)offsetof(job_tile, x))));
    y = lrb_add_ps_s3(c, y, lrb_1to16_ps(lrb_at(w->tile, (int32_t)offsetof(job_tile, y))));
    x = lrb_mul_ps_s3(c, x, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, samples_edge)));
    y = lrb_mul_ps_s3(c, y, lrb_1to16_ps(SILHOUETTES_CONSTANT(w, samples_edge)));
    lrb_packstorel_ps(c, lrb_at(place, SCRATCH_MARKED_X), m, x);
    lrb_packstoreh_ps(c, lrb_at(place, SCRATCH_MARKED_X + 64), m, x);
    lrb_packstorel_ps(c, lrb_at(place, SCRATCH_MARKED_Y), m, y);
    lrb_packstoreh_ps(c, lrb_at(place, SCRATCH_MARKED_Y + 64), m, y);
    return lrb_add(c, count, lrb_popcnt(c, lrb_kmov_rk(c, m)));
}

/* Place of a block's first pixel among the rows in scratch. */
LRB_INLINE lrb_ptr silhouettes_in_rows(lrb_ctx *c, lrb_ptr scratch, lrb_r64 block)
{
    lrb_r64 down = lrb_shl(c, lrb_shr(c, block, 2), 9); /* four rows */
    lrb_r64 right = lrb_shl(c, lrb_and(c, block, lrb_imm(3)), 4);
    return lrb_lea(c, scratch, lrb_add(c, down, right), 1, SCRATCH_ROWS + SCRATCH_ROW + 64);
}

/* The four pixels of each row of a block. */
LRB_INLINE lrb_k16 silhouettes_row_of_block(lrb_ctx *c, int row)
{
    return lrb_kmov_kr(c, lrb_imm(UINT64_C(0xf) << (4 * row)));
}

/* The limits, from blocks to rows of the image; of pixels that are not there they are infinite. */
LRB_INLINE void silhouettes_fill_rows(lrb_ctx *c, const silhouettes *w, const mft_group *g)
{
    lrb_v16f infinity = lrb_load_ps(c, RAYS16_CONSTANT(g->constants, infinity));
    lrb_ptr row = lrb_lea(c, g->scratch, lrb_imm(0), 1, SCRATCH_ROWS);
    lrb_ptr end = lrb_lea(c, g->scratch, lrb_imm(0), 1, SCRATCH_ROWS_END);
    lrb_r64 block = lrb_imm(0);
    do {
        lrb_store_ps(c, lrb_at(row, 0), infinity);
        row = lrb_lea(c, row, lrb_imm(0), 1, 64);
    } while (lrb_jb(c, lrb_cmp_ptr(c, row, end)));
    do {
        lrb_ptr limits = lrb_lea(c, g->limits, lrb_shl(c, block, 6), 1, 0);
        lrb_ptr pixels = lrb_lea(c, w->tile, block, 2, 0);
        lrb_ptr place = silhouettes_in_rows(c, g->scratch, block);
        lrb_k16 in_image = lrb_kmov_kr(c, lrb_load16(c, lrb_at(pixels, (int32_t)offsetof(job_tile, pixels))));
        lrb_v16f limit = lrb_mask_mov_ps_s3(c, infinity, in_image, lrb_full_ps(lrb_at(limits, 0)));
        for (int i = 0; i < 4; i++)
            lrb_packstorel_ps(c, lrb_at(place, i * SCRATCH_ROW), silhouettes_row_of_block(c, i), limit);
        block = lrb_add(c, block, lrb_imm(1));
    } while (lrb_jb(c, lrb_cmp(c, block, lrb_imm(16))));
}

/* The largest of each pixel of a row and the pixels beside it. */
LRB_INLINE lrb_v16f silhouettes_beside(lrb_ctx *c, lrb_ptr row)
{
    const lrb_k16 all = lrb_mask(0xffff);
    lrb_v16f middle = lrb_load_ps(c, lrb_at(row, 0));
    lrb_v16f left = lrb_loadunpackl_ps(c, middle, all, lrb_at(row, -4));
    left = lrb_loadunpackh_ps(c, left, all, lrb_at(row, 60));
    lrb_v16f right = lrb_loadunpackl_ps(c, middle, all, lrb_at(row, 4));
    right = lrb_loadunpackh_ps(c, right, all, lrb_at(row, 68));
    return lrb_max_ps(c, lrb_max_ps(c, middle, left), right);
}

/* Each limit in the rows becomes the largest of the nine around it. */
LRB_INLINE void silhouettes_widen_rows(lrb_ctx *c, lrb_ptr scratch)
{
    lrb_ptr row = lrb_lea(c, scratch, lrb_imm(0), 1, SCRATCH_ROWS + SCRATCH_ROW + 64);
    lrb_ptr end = lrb_lea(c, scratch, lrb_imm(0), 1, SCRATCH_ROWS + 17 * SCRATCH_ROW + 64);
    lrb_v16f above = silhouettes_beside(c, lrb_lea(c, row, lrb_imm(0), 1, -SCRATCH_ROW));
    lrb_v16f here = silhouettes_beside(c, row);
    do {
        lrb_ptr next = lrb_lea(c, row, lrb_imm(0), 1, SCRATCH_ROW);
        lrb_v16f below = silhouettes_beside(c, next);
        lrb_store_ps(c, lrb_at(row, 0), lrb_max_ps(c, lrb_max_ps(c, above, here), below));
        above = here;
        here = below;
        row = next;
    } while (lrb_jb(c, lrb_cmp_ptr(c, row, end)));
}

/* The pixels of a block to be marked. */
LRB_INLINE lrb_k16 silhouettes_marked(lrb_ctx *c, const silhouettes *w, const mft_group *g, lrb_r64 block)
{
    lrb_ptr edge = lrb_lea(c, w->edge, lrb_shl(c, block, 6), 1, 0);
    lrb_ptr pixels = lrb_lea(c, w->tile, block, 2, 0);
    lrb_v16f nearest = lrb_load_ps(c, lrb_at(edge, 0)), limit = nearest;
    lrb_k16 in_image = lrb_kmov_kr(c, lrb_load16(c, lrb_at(pixels, (int32_t)offsetof(job_tile, pixels))));
    lrb_k16 m = lrb_mask_cmplt_ps_s3(c, in_image, nearest, lrb_full_ps(RAYS16_CONSTANT(g->constants, infinity)));
    if (lrb_jz(c, lrb_kortest(c, m, m)))
        return m;
    lrb_ptr place = silhouettes_in_rows(c, g->scratch, block);
    for (int i = 0; i < 4; i++)
        limit = lrb_loadunpackl_ps(c, limit, silhouettes_row_of_block(c, i), lrb_at(place, i * SCRATCH_ROW));
    m = lrb_mask_cmple_ps(c, m, nearest, limit);
    if (!w->whole_blocks || lrb_jz(c, lrb_kortest(c, m, m)))
        return m;
    return in_image;
}

/** Mark the pixels with a silhouette that may be seen; returns their number, and in scratch their places. */
LRB_INLINE lrb_r64 silhouettes_mark(lrb_ctx *c, const silhouettes *w, const mft_group *g)
{
    lrb_r64 block = lrb_imm(0), count = lrb_imm(0);
    silhouettes_fill_rows(c, w, g);
    silhouettes_widen_rows(c, g->scratch);
    do {
        lrb_ptr marked = lrb_lea(c, w->marked, block, 4, 0);
        lrb_k16 m = silhouettes_marked(c, w, g, block);
        lrb_store32(c, lrb_at(marked, 0), lrb_kmov_rk(c, m));
        g->n->n[KERNEL_pixels_marked] += (unsigned)__builtin_popcount(m.bits);
        if (lrb_jnz(c, lrb_kortest(c, m, m)))
            count = silhouettes_append(c, w, g, block, m, count);
        block = lrb_add(c, block, lrb_imm(1));
    } while (lrb_jb(c, lrb_cmp(c, block, lrb_imm(16))));
    return count;
}

#endif
