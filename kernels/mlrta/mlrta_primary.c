/* mlrta-primary: multi-level ray tracing of primary rays, Reshetov, Soupikov and Hurley 2005 (docs/kernels-mlrta.md).
 *
 * A unit of work is an initial tile. For a tile an entry point is searched; then its packets are traced from there, or it is split and
 * each part searches its own from there on.
 */
#include "kernels/mlrta/entry_search.h"
#include "kernels/mlrta/kd16_tile.h"
#include "kernels/shade16.h"
#include "kernels/tile_function.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_MLRTA_PRIMARY

/* A square of pixels, and the node that its rays are traced from. */
typedef struct mlrta_tile {
    lrb_r64 x, y, edge;
    entry_place start;
    bool nothing; /* its rays can hit nothing */
} mlrta_tile;

/* A tile that is being split, in scratch: the cell as its rays see it, then these words. */
enum { FRAME_X = 32, FRAME_Y = 36, FRAME_EDGE = 40, FRAME_NODE = 44, FRAME_NEXT = 48 };

/* Words of ENTRY_LOOP: registers do not suffice for loops around packets. */
enum { LOOP_TOP, LOOP_NODE, LOOP_BLOCKS, LOOP_X, LOOP_Y, LOOP_FIRST_X, LOOP_LAST_X, LOOP_LAST_Y };
#define MLRTA_LOOP(m, word) lrb_at((m)->k.scratch, ENTRY_LOOP + 4 * (word))

typedef struct mlrta_state {
    const kernel_job *job;
    kd16 k;
    lrb_r64 width, height;
    uint64_t first_x, first_y; /* first tile of the unit, of the frame's, for the heat map */
    uint64_t blocks; /* of the tile that is being traced ... */
    uint32_t complexity; /* ... and of what it sees: for the host (kernel_job_complexity) */
} mlrta_state;

/* The smaller of two. */
LRB_INLINE lrb_r64 mlrta_least(lrb_ctx *c, lrb_r64 a, lrb_r64 b)
{
    return lrb_jl(c, lrb_cmp(c, b, a)) ? b : a;
}

/* The pixels of a tile that are in the image. */
LRB_INLINE tile_pixels mlrta_pixels(lrb_ctx *c, const mlrta_state *m, const mlrta_tile *t)
{
    tile_pixels p = {.x0 = t->x, .y0 = t->y};
    lrb_r64 right = lrb_add(c, t->x, t->edge), down = lrb_add(c, t->y, t->edge);
    p.x1 = lrb_sub(c, mlrta_least(c, right, m->width), lrb_imm(1));
    p.y1 = lrb_sub(c, mlrta_least(c, down, m->height), lrb_imm(1));
    return p;
}

/* Blocks of a 16x16 tile that belong to a tile of that edge, at its place. */
LRB_INLINE lrb_r64 mlrta_blocks(lrb_ctx *c, const mlrta_tile *t)
{
    const uint64_t edge = t->edge.value;
    lrb_r64 blocks = lrb_imm(edge >= 16 ? 0xffff : edge == 8 ? 0x33 : 0x1);
    if (!lrb_jb(c, lrb_cmp(c, t->edge, lrb_imm(16)))) /* whole tiles */
        return blocks;
    lrb_r64 column = lrb_and(c, lrb_shr(c, t->x, 2), lrb_imm(3));
    lrb_r64 row = lrb_and(c, t->y, lrb_imm(12)); /* four blocks a row */
    lrb_r64 shift = lrb_add(c, column, row);
    return lrb_shl(c, blocks, (unsigned)shift.value);
}

/* Tell the host of the complexity that a 16x16 tile's blocks see. */
LRB_INLINE void mlrta_tell_complexity(const mlrta_state *m, uint64_t tile)
{
    for (unsigned block = 0; block < 16; block++)
        if (m->blocks >> block & 1)
            m->job->complexity_host[tile][block] = m->complexity;
}

/* The 16x16 tile that the loop is at: its place, and its number in the frame. */
typedef struct mlrta_here {
    lrb_r64 x, y, index;
} mlrta_here;

LRB_INLINE mlrta_here mlrta_loop_at(lrb_ctx *c, const mlrta_state *m)
{
    mlrta_here at = {.x = lrb_load32(c, MLRTA_LOOP(m, LOOP_X))};
    at.y = lrb_load32(c, MLRTA_LOOP(m, LOOP_Y));
    at.index = lrb_add(c, lrb_imul(c, at.y, lrb_imm(m->job->tiles_x)), at.x);
    return at;
}

/* Trace the packets of the 16x16 tile that the loop is at. */
LRB_INLINE void mlrta_trace_tile(lrb_ctx *c, mlrta_state *m, bool nothing)
{
    const lrb_mem start = MLRTA_LOOP(m, LOOP_NODE);
    const mlrta_here at = mlrta_loop_at(c, m);
    const lrb_r64 x = at.x, y = at.y, index = at.index;
    lrb_ptr tile = lrb_lea(c, lrb_segment_at(m->job->tiles, 0), lrb_shl(c, index, 6), 1, 0);
    lrb_ptr frame = lrb_lea(c, lrb_segment_at(m->job->frame, 0), lrb_shl(c, index, 12), 1, 0);
    mlrta_tell_complexity(m, index.value);
    m->k.tile_x = (uint32_t)(x.value - m->first_x);
    m->k.tile_y = (uint32_t)(y.value - m->first_y);
    kd16_blocks(c, &m->k, tile, frame, &start, nothing, lrb_load32(c, MLRTA_LOOP(m, LOOP_BLOCKS)));
    if (m->job->params.shader != KERNEL_SHADER_NONE) {
        const lrb_r64 traced = mlrta_loop_at(c, m).index;
        shade16_tile(c, m->job, traced, lrb_load32(c, MLRTA_LOOP(m, LOOP_BLOCKS)));
    }
}

/* The next 16x16 tile of the loop, row by row; false after the last. */
LRB_INLINE bool mlrta_next_tile(lrb_ctx *c, mlrta_state *m)
{
    lrb_r64 x = lrb_add(c, lrb_load32(c, MLRTA_LOOP(m, LOOP_X)), lrb_imm(1));
    lrb_store32(c, MLRTA_LOOP(m, LOOP_X), x);
    if (!lrb_jl(c, lrb_cmp(c, lrb_load32(c, MLRTA_LOOP(m, LOOP_LAST_X)), x)))
        return true;
    lrb_store32(c, MLRTA_LOOP(m, LOOP_X), lrb_load32(c, MLRTA_LOOP(m, LOOP_FIRST_X)));
    lrb_r64 y = lrb_add(c, lrb_load32(c, MLRTA_LOOP(m, LOOP_Y)), lrb_imm(1));
    lrb_store32(c, MLRTA_LOOP(m, LOOP_Y), y);
    return !lrb_jl(c, lrb_cmp(c, lrb_load32(c, MLRTA_LOOP(m, LOOP_LAST_Y)), y));
}

/* Trace the packets of a tile. */
LRB_INLINE void mlrta_trace(lrb_ctx *c, mlrta_state *m, const mlrta_tile *t, const tile_pixels *p, const tile_bounds *bounds)
{
    lrb_r64 blocks = mlrta_blocks(c, t);
    lrb_v16f cell = tile_turned(c, bounds, t->start.cell);
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_store_ps(c, lrb_at(m->k.scratch, SCRATCH_BOXES), lrb_mask_sub_ps(c, cell, lrb_mask(0xf0), zero, cell));
    m->blocks = blocks.value;
    m->complexity = t->nothing ? 0 : m->job->kdtree->sizes[t->start.node.value / sizeof(kdtree_node)];
    lrb_r64 first_x = lrb_shr(c, p->x0, 4);
    lrb_store32(c, MLRTA_LOOP(m, LOOP_NODE), t->start.node);
    lrb_store32(c, MLRTA_LOOP(m, LOOP_BLOCKS), blocks);
    lrb_store32(c, MLRTA_LOOP(m, LOOP_FIRST_X), first_x);
    lrb_store32(c, MLRTA_LOOP(m, LOOP_LAST_X), lrb_shr(c, p->x1, 4));
    lrb_store32(c, MLRTA_LOOP(m, LOOP_LAST_Y), lrb_shr(c, p->y1, 4));
    lrb_store32(c, MLRTA_LOOP(m, LOOP_X), first_x);
    lrb_store32(c, MLRTA_LOOP(m, LOOP_Y), lrb_shr(c, p->y0, 4));
    do
        mlrta_trace_tile(c, m, t->nothing);
    while (mlrta_next_tile(c, m));
}

/* Whether a tile is to be split on. */
LRB_INLINE bool mlrta_splits(lrb_ctx *c, const mlrta_state *m, const mlrta_tile *t, bool coherent)
{
    const kernel_params *params = &m->job->params;
    if (!coherent)
        return params->divergent == KERNEL_DIVERGENT_SPLIT && lrb_jnz(c, lrb_cmp(c, t->edge, lrb_imm(4)));
    if (t->nothing)
        return false;
    if (!lrb_jl(c, lrb_cmp(c, lrb_imm(UINT64_C(4) << params->mts), t->edge)))
        return false;
    lrb_r64 link = lrb_load32(c, lrb_at_index(m->k.nodes, t->start.node, 1, (int32_t)offsetof(kdtree_node, link)));
    lrb_r64 axis = lrb_and(c, link, lrb_imm(KDTREE_KIND));
    return lrb_jnz(c, lrb_cmp(c, axis, lrb_imm(KDTREE_LEAF)));
}

LRB_INLINE void mlrta_push(lrb_ctx *c, mlrta_state *m, const mlrta_tile *t)
{
    lrb_r64 top = lrb_load32(c, MLRTA_LOOP(m, LOOP_TOP));
    lrb_ptr frame = lrb_lea(c, m->k.scratch, top, 1, ENTRY_TILES);
    lrb_store_ps(c, lrb_at(frame, 0), t->start.cell);
    lrb_store32(c, lrb_at(frame, FRAME_X), t->x);
    lrb_store32(c, lrb_at(frame, FRAME_Y), t->y);
    lrb_store32(c, lrb_at(frame, FRAME_EDGE), t->edge);
    lrb_store32(c, lrb_at(frame, FRAME_NODE), t->start.node);
    lrb_store32(c, lrb_at(frame, FRAME_NEXT), lrb_imm(0));
    lrb_store32(c, MLRTA_LOOP(m, LOOP_TOP), lrb_add(c, top, lrb_imm(ENTRY_TILE_FRAME)));
}

/* Search a tile's entry point, then trace it, or put it on the stack of those that are split. */
LRB_INLINE void mlrta_process(lrb_ctx *c, mlrta_state *m, mlrta_tile *t)
{
    tile_bounds bounds = {.negative = lrb_mask(0)};
    lrb_phase(c, KERNEL_PHASE_ENTRY);
    tile_pixels pixels = mlrta_pixels(c, m, t);
    bool coherent = tile_bounds_setup(c, &m->k, &pixels, &bounds);
    t->nothing = false;
    if (coherent) { /* its own branches */
        if (lrb_jz(c, lrb_test(c, t->start.node, t->start.node))) /* the root's cell is not turned yet */
            t->start.cell = tile_turned(c, &bounds, lrb_load_ps(c, KD16_CELLS(m->k.cells, cell)));
        m->k.n->n[KERNEL_units_tiles]++;
        t->nothing = !entry_search(c, &m->k, &m->job->params, &bounds, &t->start);
        m->k.n->n[KERNEL_units_empty_tiles] += t->nothing;
    } else {
        m->k.n->n[KERNEL_units_divergent_tiles]++;
    }
    if (mlrta_splits(c, m, t, coherent))
        mlrta_push(c, m, t);
    else
        mlrta_trace(c, m, t, &pixels, &bounds);
}

/* The next part of the tiles that are being split; false if there is none. Parts outside the image are passed over. */
LRB_INLINE bool mlrta_next(lrb_ctx *c, mlrta_state *m, mlrta_tile *t)
{
    for (;;) {
        lrb_r64 top = lrb_load32(c, MLRTA_LOOP(m, LOOP_TOP));
        if (lrb_jz(c, lrb_test(c, top, top)))
            return false;
        lrb_ptr frame = lrb_lea(c, m->k.scratch, top, 1, ENTRY_TILES - ENTRY_TILE_FRAME);
        lrb_r64 edge = lrb_load32(c, lrb_at(frame, FRAME_EDGE));
        lrb_r64 next = lrb_load32(c, lrb_at(frame, FRAME_NEXT));
        const unsigned log2 = m->job->params.sf && edge.value >= 16 ? 2 : 1; /* parts an edge */
        lrb_r64 after = lrb_add(c, next, lrb_imm(1));
        lrb_store32(c, lrb_at(frame, FRAME_NEXT), after);
        if (lrb_jz(c, lrb_cmp(c, after, lrb_imm(UINT64_C(1) << 2 * log2))))
            lrb_store32(c, MLRTA_LOOP(m, LOOP_TOP), lrb_sub(c, top, lrb_imm(ENTRY_TILE_FRAME)));
        t->edge = lrb_shr(c, edge, log2);
        lrb_r64 column = lrb_and(c, next, lrb_imm((1u << log2) - 1)), row = lrb_shr(c, next, log2);
        lrb_r64 right = lrb_imul(c, column, t->edge);
        t->x = lrb_add(c, lrb_load32(c, lrb_at(frame, FRAME_X)), right);
        lrb_r64 down = lrb_imul(c, row, t->edge);
        t->y = lrb_add(c, lrb_load32(c, lrb_at(frame, FRAME_Y)), down);
        if (lrb_jl(c, lrb_cmp(c, t->x, m->width)) && lrb_jl(c, lrb_cmp(c, t->y, m->height))) {
            t->start.node = lrb_load32(c, lrb_at(frame, FRAME_NODE));
            t->start.cell = lrb_load_ps(c, lrb_at(frame, 0));
            return true;
        }
    }
}

/* A unit of work: an initial tile. */
LRB_INLINE void mlrta_primary_unit(lrb_ctx *c, const kernel_job *job, uint32_t unit, kernel_counts *n)
{
    const uint32_t edge = 1u << job->unit_log2, units_x = (job->tiles_x + edge - 1) / edge;
    mlrta_state m = {.job = job, .k = kd16_of(c, job, n), .width = lrb_imm(job->width), .height = lrb_imm(job->height)};
    uint64_t ep_cells = n->n[KERNEL_ep_cells], ep_inner = n->n[KERNEL_ep_inner];
    m.first_x = unit % units_x * edge;
    m.first_y = unit / units_x * edge;
    kd16_begin(c, &m.k);
    lrb_store32(c, MLRTA_LOOP(&m, LOOP_TOP), lrb_imm(0));
    mlrta_tile t = {.x = lrb_imm(m.first_x * JOB_TILE_PIXELS), .y = lrb_imm(m.first_y * JOB_TILE_PIXELS)};
    t.edge = lrb_imm(edge * JOB_TILE_PIXELS);
    t.start.node = lrb_imm(0);
    t.start.cell = lrb_load_ps(c, KD16_CELLS(m.k.cells, cell));
    do
        mlrta_process(c, &m, &t);
    while (mlrta_next(c, &m, &t));
    n->n[KERNEL_traversed_cells] += n->n[KERNEL_ep_cells] - ep_cells;
    n->n[KERNEL_traversed_inner] += n->n[KERNEL_ep_inner] - ep_inner;
}

KERNEL_TILE_FUNCTION(mlrta_primary, mlrta_primary_unit)
