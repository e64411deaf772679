/* Traversal of the BVH by 16 lanes, with one origin or 16: packets of rays, groups of frusta and of packets alike. docs/kernels.md.
 *
 * The stack holds nodes and masks, no distances, as in Benthin and Wald's appendix A: distances are checked again at
 * the children. The nearer child is first: the one that any lane in both enters first. Lanes that look for any hit leave
 * `alive` when they need no more; then they are not taken from the stack, and with the last of them the traversal ends.
 */
#ifndef KERNELS_TRAVERSAL16_H
#define KERNELS_TRAVERSAL16_H

#include "kernels/packet/packets256.h"
#include "kernels/slab16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_TRAVERSAL

/* Intersect the triangles of one leaf: records [first, end), lanes m; `box` is its node. Shortens s->limit or empties s->alive. */
typedef void traversal16_leaf(lrb_ctx *c, slab16 *s, void *user, lrb_ptr box, lrb_ptr first, lrb_ptr end, lrb_k16 m);

typedef struct traversal16 {
    lrb_ptr nodes, records, scratch;
    lrb_v16f origin; /* x y z 0, four times */
    uint32_t root_link, root_count;
    bool any;   /* a constant: any hit will do, s->alive are the lanes that still look for one */
    bool packets; /* a constant: a lane is a packet of 16 rays, tested one by one (kernels/packet/packets256.h) */
    lrb_ptr nearest; /* then: distances of the rays' nearest hits, 64 bytes a packet, unless any hit will do */
    bool empty; /* a tree without triangles: nothing is launched */
    traversal16_leaf *leaf; /* a constant, so that it is inlined */
    void *user;
    kernel_counts *n;
} traversal16;

/** What traverses a job's tree; the origin is the caller's to load. */
LRB_INLINE traversal16 traversal16_of(const kernel_job *job, lrb_ptr scratch, traversal16_leaf *leaf, void *user, kernel_counts *n)
{
    return (traversal16){
        .nodes = lrb_segment_at(job->nodes, 0),
        .records = lrb_segment_at(job->records, 0),
        .scratch = scratch,
        .root_link = job->root_link,
        .root_count = job->root_count,
        .empty = job->record_count == 0,
        .leaf = leaf,
        .user = user,
        .n = n,
    };
}

/* A node as the traversal holds it: where it is, its link and count, and the lanes that are in it. */
typedef struct traversal16_node {
    lrb_ptr box;
    lrb_r64 link, count;
    lrb_k16 m;
} traversal16_node;

LRB_INLINE traversal16_node traversal16_read(lrb_ctx *c, lrb_ptr node, lrb_k16 m)
{
    traversal16_node r = {.box = node, .m = m};
    r.link = lrb_load32(c, lrb_at(node, (int32_t)offsetof(bvh_node, link)));
    r.count = lrb_load32(c, lrb_at(node, (int32_t)offsetof(bvh_node, count)));
    return r;
}

LRB_INLINE lrb_ptr traversal16_push(lrb_ctx *c, lrb_ptr top, lrb_r64 node_offset, lrb_k16 m)
{
    lrb_store32(c, lrb_at(top, 0), node_offset);
    lrb_store32(c, lrb_at(top, 4), lrb_kmov_rk(c, m));
    return lrb_lea(c, top, lrb_imm(0), 1, SCRATCH_STACK_ENTRY);
}

/* Counts of an inner node that the lanes of m visit. */
LRB_INLINE void traversal16_count(const traversal16 *t, lrb_k16 m)
{
    t->n->n[KERNEL_traversed_cells]++;
    t->n->n[KERNEL_traversed_inner]++;
    if (t->packets)
        t->n->n[KERNEL_aabb_group_tests] += 2;
    t->n->n[KERNEL_aabb_tests] += t->packets ? 2 * (unsigned)__builtin_popcount(m.bits) : 2;
}

/* A pair of boxes into scratch, relative to the origin if it is common. */
LRB_INLINE void traversal16_boxes(lrb_ctx *c, const traversal16 *t, const slab16 *s, lrb_ptr pair)
{
    lrb_v16f boxes;
    if (s->own_origins)
        boxes = lrb_load_ps(c, lrb_at(pair, 0));
    else
        boxes = lrb_subr_ps_s3(c, t->origin, lrb_full_ps(lrb_at(pair, 0)));
    lrb_store_ps(c, lrb_at(t->scratch, SCRATCH_BOXES), boxes);
}

/* From an inner node to its nearer child, pushing the other; false if no lane meets either. */
LRB_INLINE bool traversal16_descend(lrb_ctx *c, const traversal16 *t, const slab16 *s, slab16_path path, traversal16_node *node,
                                    lrb_ptr *top)
{
    lrb_v16f entry[2] = {s->zero, s->zero};
    lrb_k16 met[2], nearer = lrb_mask(0);
    lrb_ptr pair = lrb_lea(c, t->nodes, node->link, 1, 0);
    traversal16_count(t, node->m);
    if (!t->packets || !s->own_origins) /* else every packet has its own */
        traversal16_boxes(c, t, s, pair);
    if (t->packets)
        nearer = packets256_test(c, s, path, t->scratch, t->nearest, pair, node->m, met);
    else
        for (int i = 0; i < 2; i++)
            met[i] = slab16_test(c, s, path, t->scratch, 32 * i, node->m, &entry[i]);
    lrb_ptr second = lrb_lea(c, pair, lrb_imm(0), 1, 32);
    if (lrb_jz(c, lrb_kortest(c, met[0], met[0]))) {
        *node = traversal16_read(c, second, met[1]);
        return !lrb_jz(c, lrb_kortest(c, met[1], met[1]));
    }
    if (lrb_jz(c, lrb_kortest(c, met[1], met[1]))) {
        *node = traversal16_read(c, pair, met[0]);
        return true;
    }
    if (!t->packets)
        nearer = lrb_mask_cmplt_ps(c, lrb_kand(c, met[0], met[1]), entry[0], entry[1]);
    if (lrb_jnz(c, lrb_kortest(c, nearer, nearer))) {
        *top = traversal16_push(c, *top, lrb_add(c, node->link, lrb_imm(32)), met[1]);
        *node = traversal16_read(c, pair, met[0]);
    } else {
        *top = traversal16_push(c, *top, node->link, met[0]);
        *node = traversal16_read(c, second, met[1]);
    }
    return true;
}

/* The same, on the path that slab16_setup chose: each has a box test of its own. */
LRB_INLINE bool traversal16_descend_path(lrb_ctx *c, const traversal16 *t, const slab16 *s, traversal16_node *node, lrb_ptr *top)
{
    switch (s->path) {
    case SLAB16_COMMON:
        return traversal16_descend(c, t, s, SLAB16_COMMON, node, top);
    case SLAB16_BLEND:
        return traversal16_descend(c, t, s, SLAB16_BLEND, node, top);
    case SLAB16_ZERO:
        return traversal16_descend(c, t, s, SLAB16_ZERO, node, top);
    }
    return false;
}

/** Visit every leaf that a lane of `active` meets nearer than its limit, or, if any hit will do, until no lane is alive. */
LRB_INLINE void traversal16_run(lrb_ctx *c, const traversal16 *t, slab16 *s, lrb_k16 active)
{
    if (t->empty)
        return;
    lrb_phase(c, KERNEL_PHASE_TRAVERSAL);
    lrb_ptr bottom = lrb_lea(c, t->scratch, lrb_imm(0), 1, SCRATCH_STACK);
    lrb_ptr top = bottom;
    traversal16_node node = {.box = t->nodes, .link = lrb_imm(t->root_link), .count = lrb_imm(t->root_count), .m = active};
    bool reached = true;
    for (;;) {
        while (reached && !lrb_jnz(c, lrb_test(c, node.count, node.count)))
            reached = traversal16_descend_path(c, t, s, &node, &top);
        if (reached) {
            t->n->n[KERNEL_traversed_cells]++;
            lrb_ptr first = lrb_lea(c, t->records, node.link, 1, 0);
            lrb_ptr end = lrb_lea(c, first, lrb_shl(c, node.count, 6), 1, 0);
            t->leaf(c, s, t->user, node.box, first, end, node.m);
            if (t->any && lrb_jz(c, lrb_kortest(c, s->alive, s->alive)))
                return;
            lrb_phase(c, KERNEL_PHASE_TRAVERSAL);
        }
        if (lrb_jz(c, lrb_cmp_ptr(c, top, bottom)))
            return;
        top = lrb_lea(c, top, lrb_imm(0), 1, -SCRATCH_STACK_ENTRY);
        lrb_r64 offset = lrb_load32(c, lrb_at(top, 0));
        lrb_k16 m = lrb_kmov_kr(c, lrb_load32(c, lrb_at(top, 4)));
        reached = true;
        if (t->any) {
            m = lrb_kand(c, m, s->alive);
            reached = !lrb_jz(c, lrb_kortest(c, m, m));
        }
        if (reached)
            node = traversal16_read(c, lrb_lea(c, t->nodes, offset, 1, 0), m);
    }
}

#endif
