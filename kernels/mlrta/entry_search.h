/* The entry point of a tile's rays: the deepest node of the kd-tree from which all of them can be traced.
 * Reshetov, Soupikov and Hurley 2005, 3.3, conditions (1) and (2), and 3.4.
 *
 * The search goes down, nearer child first, to the first leaf that could be hit. Behind it, what lies off that path is looked
 * at from the deepest branching up, each only until a leaf that could be hit is found: if there is one, the branching becomes the
 * candidate. It ends at once where no ray gets past the leaf (kernels/mlrta/entry_end.h).
 */
#ifndef KERNELS_MLRTA_ENTRY_SEARCH_H
#define KERNELS_MLRTA_ENTRY_SEARCH_H

#include "kernels/mlrta/entry_cull.h"
#include "kernels/mlrta/entry_end.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_ENTRY_SEARCH

/* How a way down ends. */
typedef enum entry_way { ENTRY_LEAF, ENTRY_NOTHING, ENTRY_OCCLUDED } entry_way;

/* A plane as the tile's rays meet it. */
typedef struct entry_plane {
    lrb_v16f at;           /* its offset times the axis's row */
    lrb_r64 axis, pair;    /* offset of the nodes' first child */
    lrb_r64 nearer;        /* offset of the nearer child */
} entry_plane;

LRB_INLINE entry_plane entry_plane_of(lrb_ctx *c, const kd16 *k, lrb_r64 node, lrb_r64 link, lrb_r64 axis)
{
    entry_plane p = {.axis = axis, .pair = lrb_sub(c, link, axis)};
    lrb_ptr row = lrb_lea(c, k->scratch, lrb_shl(c, axis, 6), 1, ENTRY_ROWS);
    lrb_v16f offset = lrb_load_1to16_ps(c, lrb_at_index(k->nodes, node, 1, (int32_t)offsetof(kdtree_node, split)));
    offset = lrb_sub_ps_s3(c, offset, lrb_1to16_ps(TILE_ROW(row, origin)));
    p.at = lrb_mul_ps_s3(c, offset, lrb_full_ps(TILE_ROW(row, factors)));
    p.nearer = lrb_add(c, p.pair, lrb_load32(c, TILE_ROW(row, nearer)));
    return p;
}

/* The children: one face of the cell becomes the plane. */
LRB_INLINE entry_place entry_near(lrb_ctx *c, const entry_plane *p, lrb_v16f cell)
{
    lrb_k16 far_face = lrb_kmov_kr(c, lrb_shl(c, lrb_bts(c, lrb_imm(0), p->axis), 4));
    return (entry_place){.node = p->nearer, .cell = lrb_mask_mov_ps(c, cell, far_face, p->at)};
}

LRB_INLINE entry_place entry_far(lrb_ctx *c, const entry_plane *p, lrb_v16f cell)
{
    lrb_r64 farther = lrb_xor(c, p->nearer, lrb_imm(sizeof(kdtree_node)));
    lrb_k16 near_face = lrb_kmov_kr(c, lrb_bts(c, lrb_imm(0), p->axis));
    return (entry_place){.node = farther, .cell = lrb_mask_mov_ps(c, cell, near_face, p->at)};
}

LRB_INLINE lrb_ptr entry_push(lrb_ctx *c, const entry_place *at, lrb_ptr top)
{
    lrb_store_ps(c, lrb_at(top, 0), at->cell);
    lrb_store32(c, lrb_at(top, ENTRY_STACK_ENTRY - 4), at->node);
    return lrb_lea(c, top, lrb_imm(0), 1, ENTRY_STACK_ENTRY);
}

LRB_INLINE entry_place entry_pop(lrb_ctx *c, lrb_ptr *top)
{
    *top = lrb_lea(c, *top, lrb_imm(0), 1, -ENTRY_STACK_ENTRY);
    lrb_v16f cell = lrb_load_ps(c, lrb_at(*top, 0));
    return (entry_place){.node = lrb_load32(c, lrb_at(*top, ENTRY_STACK_ENTRY - 4)), .cell = cell};
}

/* The farther child of a branching. */
LRB_INLINE entry_place entry_other_side(lrb_ctx *c, const kd16 *k, const entry_place *at)
{
    lrb_r64 link = lrb_load32(c, lrb_at_index(k->nodes, at->node, 1, (int32_t)offsetof(kdtree_node, link)));
    entry_plane plane = entry_plane_of(c, k, at->node, link, lrb_and(c, link, lrb_imm(KDTREE_KIND)));
    return entry_far(c, &plane, at->cell);
}

/* Which children of a plane the tile's rays can reach: bits 0 to 3 all set: the nearer; bits 4 to 7: the farther. Condition (1):
   along every other axis some ray must get from the plane into the cell's range, or have been in it before the plane. */
LRB_INLINE lrb_r64 entry_children(lrb_ctx *c, const entry_plane *p, lrb_v16f cell)
{
    return lrb_kmov_rk(c, lrb_cmpnlt_ps(c, p->at, cell));
}

/* The same by the ways of entry_cull.h, which look at the children's cells. */
LRB_INLINE lrb_r64 entry_children_by_cell(lrb_ctx *c, const kd16 *k, kernel_culling culling, const entry_plane *p, lrb_v16f cell)
{
    entry_place nearer = entry_near(c, p, cell), farther = entry_far(c, p, cell);
    lrb_r64 children = lrb_imm(0);
    if (culling == KERNEL_CULL_CORNER_RAYS) {
        if (entry_corner_enters(c, k, nearer.cell))
            children = lrb_or(c, children, lrb_imm(0x0f));
        if (entry_corner_enters(c, k, farther.cell))
            children = lrb_or(c, children, lrb_imm(0xf0));
        return children;
    }
    lrb_r64 ahead = lrb_and(c, entry_children(c, p, cell), lrb_imm(8)); /* word 3: the plane is not behind the origin */
    if (lrb_jnz(c, lrb_test(c, ahead, ahead)) && entry_between_planes(c, k, nearer.cell))
        children = lrb_or(c, children, lrb_imm(0x0f));
    if (entry_between_planes(c, k, farther.cell))
        children = lrb_or(c, children, lrb_imm(0xf0));
    return children;
}

LRB_INLINE bool entry_reaches(lrb_ctx *c, lrb_r64 children, uint64_t bits)
{
    return lrb_jz(c, lrb_cmp(c, lrb_and(c, children, lrb_imm(bits)), lrb_imm(bits)));
}

/* Condition (2): whether the rays can be in all three pairs of faces at once. */
LRB_INLINE bool entry_meets(lrb_ctx *c, const kd16 *k, lrb_v16f cell)
{
    lrb_v16f zero = lrb_castpi_ps(lrb_xor_pi(c, lrb_castps_pi(cell), lrb_castps_pi(cell)));
    lrb_v16f least = lrb_mul_ps_s3(c, cell, lrb_full_ps(lrb_at(k->scratch, ENTRY_LEAST)));
    lrb_v16f most = lrb_mul_ps_s3(c, cell, lrb_full_ps(lrb_at(k->scratch, ENTRY_MOST)));
    lrb_v16f first = tile_largest(c, lrb_min_ps(c, least, most)); /* latest of the earliest entries; minus the earliest of the latest exits */
    lrb_v16f last = lrb_sub_ps(c, zero, lrb_shuf128x32_ps(c, first, 0xb1, LRB_DCBA));
    lrb_r64 meets = lrb_kmov_rk(c, lrb_cmple_ps(c, first, last));
    return lrb_jnz(c, lrb_test(c, meets, lrb_imm(1)));
}

/* Go down from a place to the first leaf that the rays could hit something in, leaving branchings on the stack; those whose nearer
   side turns out to hold none are taken off it. */
LRB_INLINE entry_way entry_descend(lrb_ctx *c, const kd16 *k, kernel_culling culling, bool occluders, lrb_ptr bottom, lrb_ptr *top,
                                   entry_place *at)
{
    for (;;) {
        lrb_r64 link = lrb_load32(c, lrb_at_index(k->nodes, at->node, 1, (int32_t)offsetof(kdtree_node, link)));
        lrb_r64 axis = lrb_and(c, link, lrb_imm(KDTREE_KIND));
        k->n->n[KERNEL_ep_cells]++;
        if (lrb_jz(c, lrb_cmp(c, axis, lrb_imm(KDTREE_LEAF)))) {
            lrb_r64 extent = lrb_load32(c, lrb_at_index(k->nodes, at->node, 1, (int32_t)offsetof(kdtree_node, extent)));
            if (lrb_jb(c, lrb_cmp(c, extent, lrb_imm(KDTREE_KIND + 1)))) {
                if (occluders && lrb_jnz(c, lrb_test(c, extent, lrb_imm(KDTREE_OCCLUDER))) && entry_all_enter(c, k, at->cell))
                    return ENTRY_OCCLUDED;
            } else if (culling != KERNEL_CULL_INVERSE || entry_meets(c, k, at->cell)) {
                return ENTRY_LEAF;
            }
        } else {
            k->n->n[KERNEL_ep_inner]++;
            entry_plane plane = entry_plane_of(c, k, at->node, link, axis);
            lrb_r64 children = culling == KERNEL_CULL_INVERSE ? entry_children(c, &plane, at->cell)
                                                              : entry_children_by_cell(c, k, culling, &plane, at->cell);
            if (entry_reaches(c, children, 0x0f)) {
                if (entry_reaches(c, children, 0xf0))
                    *top = entry_push(c, at, *top);
                *at = entry_near(c, &plane, at->cell);
                continue;
            }
            if (entry_reaches(c, children, 0xf0)) {
                *at = entry_far(c, &plane, at->cell);
                continue;
            }
        }
        if (lrb_jz(c, lrb_cmp_ptr(c, *top, bottom)))
            return ENTRY_NOTHING;
        entry_place branching = entry_pop(c, top);
        *at = entry_other_side(c, k, &branching);
    }
}

/**
 * Search the entry point of a tile whose bounds are in scratch.
 *
 * @param params  culling, ends, empty_occluders
 * @param at      in: where to begin; out: the entry point
 *
 * Returns false if the rays can hit nothing.
 */
LRB_INLINE bool entry_search(lrb_ctx *c, const kd16 *k, const kernel_params *params, const tile_bounds *b, entry_place *at)
{
    const kernel_culling culling = (kernel_culling)params->culling;
    lrb_ptr bottom = lrb_lea(c, k->scratch, lrb_imm(0), 1, ENTRY_STACK);
    lrb_ptr top = bottom, base = bottom;
    entry_place branching = *at, leaf = *at;
    bool occluders = params->empty_occluders, first = true;
    if (culling == KERNEL_CULL_DIRECT)
        entry_planes_setup(c, k);
    if (culling == KERNEL_CULL_CORNER_RAYS)
        entry_rays_setup(c, k);
    for (;;) {
        entry_way way = entry_descend(c, k, culling, occluders, base, &top, &leaf);
        if (way == ENTRY_OCCLUDED) {
            k->n->n[KERNEL_end_hits]++;
            if (!first)
                return true;
            occluders = false; /* the origin must be inside: this way down once more */
            top = base;
            leaf = branching;
            continue;
        }
        occluders = params->empty_occluders;
        if (way == ENTRY_NOTHING && first)
            return false;
        if (way == ENTRY_LEAF)
            *at = first ? leaf : branching;
        top = first ? top : base;
        first = false;
        if (lrb_jz(c, lrb_cmp_ptr(c, top, bottom)))
            return true;
        if (params->ends && way == ENTRY_LEAF && entry_ends(c, k, b, &leaf))
            return true;
        branching = entry_pop(c, &top);
        base = top;
        leaf = entry_other_side(c, k, &branching);
    }
}

#endif
