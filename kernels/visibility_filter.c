/* The 4x4 discontinuity filter of interleaved soft shadows (Benthin and Wald 2009, 4.5): the second pass of the kernels that trace them.
 *
 * A pixel's visibility becomes the mean over its 4x4 window, x-1..x+2 and y-1..y+2, of the pixels that have a hit, a normal within
 * some 18 degrees of its own (n.n' >= 0.95) and a depth that differs by at most 2 % of the smaller. Every window holds each of the 16
 * sets of samples once, so on a plane the mean is that of 256 samples.
 *
 * The lanes are 16 pixels side by side, a row of a tile; a neighbour's values are a stream that begins up to two pixels to the right of
 * the row, or one to the left (kernels/job.h has the rows).
 */
#include "kernels/rays16.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_FILTER

#define FILTER_CONSTANT(f, field) lrb_at((f)->constants, (int32_t)offsetof(job_filter, field))
#define FILTER_ROW(row, field) lrb_at(row, (int32_t)offsetof(job_row, field))

typedef struct visibility_filter {
    lrb_ptr constants;
    lrb_r64 row_bytes;
    lrb_v16f zero, one, least_cosine;
    lrb_k16 hits; /* of the row's own pixels; and what else is theirs */
    lrb_v16f depth, normal[3];
    lrb_v16f sum, count; /* of the pixels that are mixed */
} visibility_filter;

/* A plane of the pixels that are dx to the right of the row's own; `plane`: offset in job_row. */
LRB_INLINE lrb_v16f filter_load(lrb_ctx *c, const visibility_filter *f, lrb_ptr row, size_t plane, int dx)
{
    const int32_t row_size = (int32_t)sizeof(job_row), first = (int32_t)plane + 4 * dx + (dx < 0 ? 64 - row_size : 0);
    const lrb_k16 all = lrb_mask(0xffff);
    if (dx == 0)
        return lrb_load_ps(c, lrb_at(row, first));
    lrb_v16f values = lrb_loadunpackl_ps(c, f->zero, all, lrb_at(row, first));
    return lrb_loadunpackh_ps(c, values, all, lrb_at(row, first + row_size));
}

/* Own pixels whose neighbours, dx to the right in `row`, are of the same surface. */
LRB_INLINE lrb_k16 filter_alike(lrb_ctx *c, const visibility_filter *f, lrb_ptr row, int dx)
{
    lrb_v16f depth = filter_load(c, f, row, offsetof(job_row, depth), dx);
    lrb_v16i step = lrb_castps_pi(lrb_sub_ps(c, f->depth, depth));
    step = lrb_and_pi_s3(c, step, lrb_1to16_pi(FILTER_CONSTANT(f, absolute)));
    lrb_v16f most = lrb_min_ps(c, f->depth, depth);
    most = lrb_mul_ps_s3(c, most, lrb_1to16_ps(FILTER_CONSTANT(f, most_step)));
    lrb_k16 alike = lrb_mask_cmple_ps(c, f->hits, lrb_castpi_ps(step), most);
    lrb_v16f cosine = f->zero;
    for (int axis = 0; axis < 3; axis++) {
        lrb_v16f n = filter_load(c, f, row, offsetof(job_row, normal[axis]), dx);
        cosine = axis ? lrb_madd231_ps(c, cosine, f->normal[axis], n) : lrb_mul_ps(c, f->normal[axis], n);
    }
    return lrb_mask_cmple_ps(c, alike, f->least_cosine, cosine);
}

/* The lines of a row that windows need, its own and those to its right; those to its left came for the tile there. */
LRB_INLINE void filter_prefetch(lrb_ctx *c, lrb_ptr row)
{
    for (int cell = 0; cell < 2; cell++)
        for (int line = 0; line < 5; line++)
            lrb_prefetch1(c, lrb_at(row, cell * (int32_t)sizeof(job_row) + 64 * line));
}

/* Four rows from the one above the own: sum and count over the windows. */
LRB_INLINE void filter_windows(lrb_ctx *c, visibility_filter *f, lrb_ptr row)
{
    lrb_ptr end = lrb_lea(c, row, f->row_bytes, 4, 0);
    f->sum = lrb_mov_ps(c, f->zero);
    f->count = lrb_mov_ps(c, f->zero);
    do {
        for (int dx = -1; dx <= 2; dx++) {
            lrb_k16 alike = filter_alike(c, f, row, dx);
            lrb_v16f visibility = filter_load(c, f, row, offsetof(job_row, visibility), dx);
            f->sum = lrb_mask_add_ps(c, f->sum, alike, f->sum, visibility);
            f->count = lrb_mask_add_ps(c, f->count, alike, f->count, f->one);
        }
        row = lrb_lea(c, row, f->row_bytes, 1, 0);
    } while (lrb_jb(c, lrb_cmp_ptr(c, row, end)));
}

/* sum / count, correctly rounded: a quotient by the rounded reciprocal, and what is missing (Markstein 1990). All reciprocals lie in
   one line, that of 1 first. */
LRB_INLINE lrb_v16f filter_mean(lrb_ctx *c, const visibility_filter *f)
{
    const lrb_mem reciprocals = lrb_at(f->constants, (int32_t)offsetof(job_filter, reciprocal) - 4);
    lrb_k16 left = f->hits;
    lrb_v16i index = lrb_cvtps2pi(c, f->count, LRB_RN, LRB_ADJUST_NONE);
    lrb_v16f reciprocal = lrb_mov_ps(c, f->one);
    do
        reciprocal = lrb_gatherd_ps(c, reciprocal, &left, reciprocals, index, 4);
    while (lrb_jnz(c, lrb_kortest(c, left, left)));
    lrb_v16f quotient = lrb_mul_ps(c, f->sum, reciprocal);
    lrb_v16f missing = lrb_msubr231_ps(c, f->sum, quotient, f->count);
    return lrb_madd231_ps(c, quotient, missing, reciprocal);
}

LRB_INLINE void filter_row(lrb_ctx *c, visibility_filter *f, lrb_ptr above)
{
    lrb_ptr row = lrb_lea(c, above, f->row_bytes, 1, 0);
    lrb_ptr next = lrb_lea(c, row, f->row_bytes, 1, 0);
    lrb_v16f filtered = lrb_mov_ps(c, f->one), lit = f->zero;
    filter_prefetch(c, lrb_lea(c, above, f->row_bytes, 4, 0));
    lrb_prefetch1(c, FILTER_ROW(next, shading));
    lrb_prefetch1_ex(c, FILTER_ROW(next, filtered));
    lrb_prefetch1_ex(c, FILTER_ROW(next, lit));
    f->depth = lrb_load_ps(c, FILTER_ROW(row, depth));
    f->hits = lrb_cmplt_ps_s3(c, f->depth, lrb_1to16_ps(FILTER_CONSTANT(f, infinity)));
    if (!lrb_jz(c, lrb_kortest(c, f->hits, f->hits))) {
        for (int axis = 0; axis < 3; axis++)
            f->normal[axis] = lrb_load_ps(c, FILTER_ROW(row, normal[axis]));
        filter_windows(c, f, above);
        filtered = lrb_mask_mov_ps(c, filtered, f->hits, filter_mean(c, f));
        lit = lrb_mul_ps_s3(c, filtered, lrb_full_ps(FILTER_ROW(row, shading)));
    }
    lrb_store_ps(c, FILTER_ROW(row, filtered), filtered);
    lrb_store_ps(c, FILTER_ROW(row, lit), lit);
}

LRB_INLINE void filter_tile(lrb_ctx *c, const kernel_job *job, uint32_t tile, kernel_counts *n)
{
    visibility_filter f = {.constants = lrb_segment_at(job->filter, 0), .row_bytes = lrb_imm(kernel_job_row_bytes(job))};
    lrb_ptr above = lrb_segment_at(job->rows, kernel_job_row_offset(job, tile) - kernel_job_row_bytes(job));
    (void)n;
    lrb_region(c, LRB_WHOLE_TILE);
    lrb_phase(c, KERNEL_PHASE_FILTER);
    f.one = lrb_load_1to16_ps(c, FILTER_CONSTANT(&f, one));
    f.zero = lrb_sub_ps(c, f.one, f.one);
    f.least_cosine = lrb_load_1to16_ps(c, FILTER_CONSTANT(&f, least_cosine));
    lrb_ptr end = lrb_lea(c, above, f.row_bytes, 8, 0);
    end = lrb_lea(c, end, f.row_bytes, 8, 0);
    lrb_ptr row = above;
    for (int i = 0; i < 4; i++) {
        filter_prefetch(c, row);
        row = lrb_lea(c, row, f.row_bytes, 1, 0);
    }
    do {
        filter_row(c, &f, above);
        above = lrb_lea(c, above, f.row_bytes, 1, 0);
    } while (lrb_jb(c, lrb_cmp_ptr(c, above, end)));
}

KERNEL_TILE_FUNCTION(visibility_filter, filter_tile)
