/* mlrta-shadow: mlrta-primary, then the shadows of a point light: for the rays from the light to the hits of a 16x16 tile an entry
 * point is searched, and their packets are traced from there (docs/kernels-mlrta.md).
 */
#include "kernels/mlrta/entry_search.h"
#include "kernels/mlrta/hit_bounds.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MLRTA_SHADOW

extern kernel_tile_fn KERNEL_TILE_FN(mlrta_primary);

/* Where the rays of a tile are traced from. */
typedef struct mlrta_shadow_start {
    lrb_r64 node;
    bool nothing; /* nothing can be in their way */
} mlrta_shadow_start;

/* The rays of a tile, into scratch; those of all blocks or'ed. */
LRB_INLINE lrb_r64 mlrta_shadow_begin(lrb_ctx *c, hard_shadow h, const kd16 *k)
{
    lrb_r64 any = lrb_imm(0);
    lrb_phase(c, KERNEL_PHASE_SHADING);
    do {
        hard_shadow_begin(c, &h, k);
        any = lrb_or(c, any, lrb_load32(c, HARD_WORD(&h, HARD_ALIVE)));
    } while (hard_shadow_next(c, &h, k));
    return any;
}

/* Search the entry point of a tile's rays, and leave the box of its cell in scratch. */
LRB_INLINE mlrta_shadow_start mlrta_shadow_search(lrb_ctx *c, const kernel_job *job, const hard_shadow *h, const kd16 *k, lrb_r64 any)
{
    const kernel_params params = {.culling = KERNEL_CULL_INVERSE, .empty_occluders = job->params.empty_occluders};
    mlrta_shadow_start r = {.node = lrb_imm(0)};
    tile_bounds bounds = {.negative = lrb_mask(0)};
    lrb_phase(c, KERNEL_PHASE_ENTRY);
    lrb_v16f cell = lrb_load_ps(c, KD16_CELLS(k->cells, cell));
    if (lrb_jz(c, lrb_test(c, any, any))) {
        r.nothing = true;
        return r;
    }
    if (hit_bounds_setup(c, *h, k, &bounds)) { /* its own branches */
        entry_place at = {.node = lrb_imm(0), .cell = tile_turned(c, &bounds, cell)};
        k->n->n[KERNEL_units_tiles]++;
        r.nothing = !entry_search(c, k, &params, &bounds, &at);
        k->n->n[KERNEL_units_empty_tiles] += r.nothing;
        r.node = at.node;
        cell = tile_turned(c, &bounds, at.cell);
    } else {
        k->n->n[KERNEL_units_divergent_tiles]++;
    }
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_store_ps(c, lrb_at(k->scratch, SCRATCH_BOXES), lrb_mask_sub_ps(c, cell, lrb_mask(0xf0), zero, cell));
    return r;
}

/* The directions of the first pixels of a tile's blocks, into scratch. */
LRB_INLINE void mlrta_shadow_corners(lrb_ctx *c, const hard_shadow *h, const kd16 *k)
{
    lrb_v16f first_rays[3];
    lrb_ptr tile = lrb_lea(c, h->pixels, lrb_imm(0), 1, -(int32_t)offsetof(job_tile, pixels));
    lrb_phase(c, KERNEL_PHASE_SETUP);
    rays16_corners(c, h->camera, tile, first_rays);
    for (int axis = 0; axis < 3; axis++)
        lrb_store_ps(c, lrb_at(k->scratch, SCRATCH_CORNERS + 64 * axis), first_rays[axis]);
}

LRB_INLINE void mlrta_shadow_tile(lrb_ctx *c, const kernel_job *job, kd16 *k, lrb_r64 tile)
{
    hard_shadow h = hard_shadow_of(c, job, k, tile);
    mlrta_shadow_corners(c, &h, k);
    lrb_r64 any = mlrta_shadow_begin(c, h, k);
    hard_shadow_first(c, &h, k);
    mlrta_shadow_start start = mlrta_shadow_search(c, job, &h, k, any);
    lrb_store32(c, HARD_LOOP(k, HARD_NODE), start.node);
    hard_shadow_first(c, &h, k);
    uint32_t block = 0;
    do {
        lrb_region(c, kd16_region(k, block++));
        lrb_phase(c, KERNEL_PHASE_SHADING);
        hard_shadow_end(c, &h, k, false, start.nothing);
    } while (hard_shadow_next(c, &h, k));
    lrb_region(c, LRB_WHOLE_TILE);
}

/* Add 1 to a word of the loop; false at the end. */
LRB_INLINE bool mlrta_shadow_step(lrb_ctx *c, const kd16 *k, int word, uint32_t end)
{
    lrb_r64 next = lrb_add(c, lrb_load32(c, HARD_LOOP(k, word)), lrb_imm(1));
    lrb_store32(c, HARD_LOOP(k, word), next);
    return lrb_jb(c, lrb_cmp(c, next, lrb_imm(end)));
}

LRB_INLINE void mlrta_shadow_unit(lrb_ctx *c, const kernel_job *job, uint32_t unit, kernel_counts *n)
{
    const uint32_t edge = 1u << job->unit_log2, units_x = (job->tiles_x + edge - 1) / edge;
    const uint32_t x0 = unit % units_x * edge, y0 = unit / units_x * edge;
    const uint32_t x1 = x0 + edge < job->tiles_x ? x0 + edge : job->tiles_x, y1 = y0 + edge < job->tiles_y ? y0 + edge : job->tiles_y;
    kd16 k = kd16_from_light(c, job, n);
    KERNEL_TILE_FN(mlrta_primary)(c, job, unit, n);
    const uint64_t ep_cells = n->n[KERNEL_ep_cells], ep_inner = n->n[KERNEL_ep_inner];
    kd16_begin(c, &k);
    lrb_store32(c, HARD_LOOP(&k, HARD_Y), lrb_imm(y0));
    do {
        lrb_store32(c, HARD_LOOP(&k, HARD_X), lrb_imm(x0));
        do {
            lrb_r64 x = lrb_load32(c, HARD_LOOP(&k, HARD_X)), y = lrb_load32(c, HARD_LOOP(&k, HARD_Y));
            k.tile_x = (uint32_t)x.value - x0;
            k.tile_y = (uint32_t)y.value - y0;
            mlrta_shadow_tile(c, job, &k, lrb_add(c, lrb_imul(c, y, lrb_imm(job->tiles_x)), x));
        } while (mlrta_shadow_step(c, &k, HARD_X, x1));
    } while (mlrta_shadow_step(c, &k, HARD_Y, y1));
    n->n[KERNEL_traversed_cells] += n->n[KERNEL_ep_cells] - ep_cells;
    n->n[KERNEL_traversed_inner] += n->n[KERNEL_ep_inner] - ep_inner;
}

KERNEL_TILE_FUNCTION(mlrta_shadow, mlrta_shadow_unit)
