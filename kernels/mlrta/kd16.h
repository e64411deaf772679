/* Interval traversal of the kd-tree by 4x4 packets of rays with one origin: Reshetov, Soupikov and Hurley 2005, 4.3.
 *
 * A packet goes through the tree as a whole: of the distances at which its rays meet a plane, and of those in its cell, only the
 * smallest and the largest matter. Because the rays have one origin, those are products of the plane's offset and of a reciprocal
 * that is found once per packet: in a vector whose even lanes say something about the largest distance in the cell and whose
 * odd lanes about the smallest, negated, a step is one subtraction, one product and one comparison (docs/kernels-mlrta.md).
 *
 * As in slab16.h rays are thin cones: directions are widened by `slack`, so that rounding loses no cell, and no hit that the
 * triangle test accepts. Rays whose signs differ go one octant after another; where a ray's interval of directions holds 0 its
 * packet reaches both sides of a plane, the side of the origin first.
 */
#ifndef KERNELS_MLRTA_KD16_H
#define KERNELS_MLRTA_KD16_H

#include "kernels/mlrta/kd_scratch.h"
#include "kernels/slab16.h"
#include "kernels/triangle16.h"

#undef LRB_SOURCE
#define LRB_SOURCE KERNEL_SOURCE_KD16

/* How the rays of a packet meet planes across one axis, 64 bytes. Factors of the offset from the origin: even words give the
   smallest distance, odd ones the largest, negated. */
typedef struct kd16_row {
    float forward[4], back[4]; /* planes at or above the origin, below it; the same but where an interval holds 0 */
    float limit[4];            /* distances are at most this: inf, -inf where an interval holds 0: the plane is never left */
    float origin;
    uint32_t near_forward, near_back; /* offset of the nearer of two siblings: 0 or 8 */
    uint32_t pad;
} kd16_row;

_Static_assert(sizeof(kd16_row) == 64, "a row is a line");

#define KD16_ROW(row, field) lrb_at(row, (int32_t)offsetof(kd16_row, field))
#define KD16_CELLS(cells, field) lrb_at(cells, (int32_t)offsetof(job_cells, field))

enum { KD16_EVEN = 0x5555, KD16_ODD = 0xaaaa };

/* What does not change from packet to packet; then the packet's rays and hits. */
typedef struct kd16 {
    lrb_ptr constants, scratch, cells, nodes, lists, records;
    bool cull, mailbox, single_rays;
    bool any;   /* the rays end at any hit before their limit, which then becomes -inf... */
    bool early; /* ...unless they are to go on all the same: then u, which began as the limit, becomes -inf */
    uint32_t unit_log2, tile_x, tile_y; /* edge of the unit of work, in tiles; the place in it of the tile that is being traced */
    kernel_counts *n;
    lrb_v16f origin;     /* for triangle records */
    lrb_v16f d[3], u, v; /* u, v: of the nearest hits; their distances are slab16's limit */
    lrb_v16i id;
} kd16;

/** What traverses a job's tree; the rays are the caller's to fill in. */
LRB_INLINE kd16 kd16_of(lrb_ctx *c, const kernel_job *job, kernel_counts *n)
{
    return (kd16){
        .constants = lrb_segment_at(job->constants, 0),
        .scratch = lrb_segment_at(c->scratch, 0),
        .cells = lrb_segment_at(job->cells, 0),
        .nodes = lrb_segment_at(job->nodes, 0),
        .lists = lrb_segment_at(job->lists, 0),
        .records = lrb_segment_at(job->records, 0),
        .cull = job->params.cull_backface,
        .mailbox = job->params.mailbox,
        .single_rays = job->params.divergent_packets == KERNEL_PACKETS_RAYS,
        .unit_log2 = job->unit_log2,
        .n = n,
    };
}

/** The same for rays from the point light, which end at what they hit first. */
LRB_INLINE kd16 kd16_from_light(lrb_ctx *c, const kernel_job *job, kernel_counts *n)
{
    kd16 k = kd16_of(c, job, n);
    k.constants = lrb_segment_at(job->light_constants, 0);
    k.cells = lrb_segment_at(job->cells, sizeof(job_cells));
    k.any = true;
    k.early = job->params.early_termination;
    return k;
}

/* The largest of a in even lanes, of b in odd lanes. */
LRB_INLINE lrb_v16f kd16_largest(lrb_ctx *c, lrb_v16f a, lrb_v16f b)
{
    lrb_v16f r = lrb_max_ps_s3(c, a, lrb_swizzle_ps(a, LRB_CDAB));
    r = lrb_mask_max_ps_s3(c, r, lrb_mask(KD16_ODD), b, lrb_swizzle_ps(b, LRB_CDAB));
    r = lrb_max_ps_s3(c, r, lrb_swizzle_ps(r, LRB_BADC));
    r = lrb_max_ps(c, r, lrb_shuf128x32_ps(c, r, 0xb1, LRB_DCBA));
    return lrb_max_ps(c, r, lrb_shuf128x32_ps(c, r, 0x4e, LRB_DCBA));
}

/* The row of one axis for the rays of m. */
LRB_INLINE void kd16_row_setup(lrb_ctx *c, const kd16 *k, const slab16 *s, int axis, lrb_k16 m)
{
    lrb_ptr row = lrb_lea(c, k->scratch, lrb_imm(0), 1, KD_ROWS + 64 * axis);
    lrb_v16f lowest = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel));
    lrb_v16f minus = lrb_mask_sub_ps(c, lowest, m, s->zero, k->d[axis]);
    lrb_v16f ends = kd16_largest(c, lrb_mask_mov_ps(c, lowest, m, k->d[axis]), minus);
    ends = lrb_add_ps_s3(c, ends, lrb_1to16_ps(RAYS16_CONSTANT(k->constants, slack))); /* largest, minus smallest component */
    lrb_v16f tiny = lrb_load_1to16_ps(c, RAYS16_CONSTANT(k->constants, tiny));
    lrb_v16f limit = lrb_mov_ps(c, s->infinity);
    lrb_r64 strict = lrb_kmov_rk(c, lrb_cmplt_ps_s3(c, ends, lrb_1to16_ps(RAYS16_CONSTANT(k->constants, minus_tiny))));
    lrb_r64 near_forward = lrb_imm(0), near_back = lrb_imm(0);
    bool zero = lrb_jz(c, lrb_test(c, strict, lrb_imm(3)));
    if (zero) {
        ends = lrb_max_ps(c, ends, tiny);
        limit = lrb_mask_sub_ps(c, limit, lrb_mask(KD16_ODD), s->zero, s->infinity);
    }
    lrb_v16f forward = rays16_reciprocal(c, ends); /* 1 / largest, -1 / smallest */
    lrb_v16f back = lrb_sub_ps_s3(c, s->zero, lrb_swizzle_ps(forward, LRB_CDAB));
    if (zero) {
        near_back = lrb_imm(sizeof(kdtree_node));
    } else if (lrb_jnz(c, lrb_test(c, strict, lrb_imm(1)))) {
        near_forward = near_back = lrb_imm(sizeof(kdtree_node));
        forward = back;
    } else {
        back = forward;
    }
    lrb_store_4_ps(c, KD16_ROW(row, forward), forward);
    lrb_store_4_ps(c, KD16_ROW(row, back), back);
    lrb_store_4_ps(c, KD16_ROW(row, limit), limit);
    lrb_store32(c, KD16_ROW(row, near_forward), near_forward);
    lrb_store32(c, KD16_ROW(row, near_back), near_back);
}

/* Where the traversal is: a node, and the packet's distances in its cell: the largest in even lanes, minus the smallest in odd ones. */
typedef struct kd16_place {
    lrb_r64 node; /* its offset */
    lrb_v16f t;
} kd16_place;

/* From an inner node to the child that its packet enters first, pushing the other if it is entered too. */
LRB_INLINE void kd16_descend(lrb_ctx *c, const kd16 *k, const slab16 *s, bool zero, lrb_r64 link, lrb_r64 axis, kd16_place *at, lrb_ptr *top)
{
    lrb_ptr row = lrb_lea(c, k->scratch, lrb_shl(c, axis, 6), 1, KD_ROWS);
    lrb_v16f offset = lrb_load_1to16_ps(c, lrb_at_index(k->nodes, at->node, 1, (int32_t)offsetof(kdtree_node, split)));
    offset = lrb_sub_ps_s3(c, offset, lrb_1to16_ps(KD16_ROW(row, origin)));
    lrb_r64 nearer, pair = lrb_sub(c, link, axis);
    lrb_v16f plane;
    k->n->n[KERNEL_traversed_inner]++;
    if (zero) {
        lrb_k16 below = lrb_cmplt_ps(c, offset, s->zero);
        if (lrb_jz(c, lrb_kortest(c, below, below))) {
            plane = lrb_mul_ps_s3(c, offset, lrb_4to16_ps(KD16_ROW(row, forward)));
            nearer = lrb_load32(c, KD16_ROW(row, near_forward));
        } else {
            plane = lrb_mul_ps_s3(c, offset, lrb_4to16_ps(KD16_ROW(row, back)));
            nearer = lrb_load32(c, KD16_ROW(row, near_back));
        }
        plane = lrb_min_ps_s3(c, plane, lrb_4to16_ps(KD16_ROW(row, limit)));
    } else {
        plane = lrb_mul_ps_s3(c, offset, lrb_4to16_ps(KD16_ROW(row, forward)));
        nearer = lrb_load32(c, KD16_ROW(row, near_forward));
    }
    lrb_r64 outside = lrb_kmov_rk(c, lrb_cmplt_ps(c, at->t, plane)); /* bit 0: left before the plane; bit 1: entered behind it */
    at->node = lrb_add(c, pair, nearer);
    if (lrb_jnz(c, lrb_test(c, outside, lrb_imm(1))))
        return;
    lrb_r64 second = lrb_xor(c, at->node, lrb_imm(sizeof(kdtree_node)));
    if (lrb_jnz(c, lrb_test(c, outside, lrb_imm(2)))) {
        at->node = second;
        return;
    }
    lrb_v16f turned = lrb_sub_ps_s3(c, s->zero, lrb_swizzle_ps(plane, LRB_CDAB)); /* largest, minus smallest */
    lrb_store_4_ps(c, lrb_at(*top, 0), lrb_mask_min_ps(c, at->t, lrb_mask(KD16_ODD), at->t, turned));
    lrb_store32(c, lrb_at(*top, 8), second);
    *top = lrb_lea(c, *top, lrb_imm(0), 1, KD_STACK_ENTRY);
    at->t = lrb_mask_min_ps(c, at->t, lrb_mask(KD16_EVEN), at->t, turned);
}

/* Whether the packet has tested this triangle; if not, it has now. */
LRB_INLINE bool kd16_tested(lrb_ctx *c, const kd16 *k, lrb_r64 offset)
{
    if (!k->mailbox)
        return false;
    lrb_r64 slot = lrb_and(c, lrb_shr(c, offset, 6), lrb_imm(KD_MAILBOX_SLOTS - 1));
    lrb_mem latest = lrb_at_index(k->scratch, slot, 4, KD_MAILBOX);
    if (lrb_jz(c, lrb_cmp(c, lrb_load32(c, latest), offset))) {
        k->n->n[KERNEL_mailbox_hits]++;
        return true;
    }
    lrb_store32(c, latest, offset);
    return false;
}

/* The rays of m against one triangle; returns `nearer`, or 1 if one of them has a nearer hit now. */
LRB_INLINE lrb_r64 kd16_triangle(lrb_ctx *c, kd16 *k, slab16 *s, lrb_ptr record, lrb_k16 m, lrb_r64 nearer)
{
    lrb_v16f edges;
    k->n->n[KERNEL_tri_accesses]++;
    lrb_phase(c, KERNEL_PHASE_CULLING);
    if (!triangle16_setup(c, k->scratch, k->origin, record, k->cull, &edges))
        return nearer;
    k->n->n[KERNEL_tri_after_culling]++;
    k->n->n[KERNEL_isect_tests]++;
    lrb_phase(c, KERNEL_PHASE_INTERSECTION);
    triangle16_hits hits = triangle16_intersect(c, k->constants, k->scratch, k->origin, record, k->cull, m, k->d, s->zero, s->limit, k->id);
    if (!hits.m.bits) /* the branch is triangle16_intersect's own */
        return nearer;
    k->n->n[KERNEL_isect_hits]++;
    if (k->any) {
        lrb_k16 blocked = lrb_mask_cmpnle_ps_s3(c, hits.m, hits.t, lrb_1to16_ps(RAYS16_CONSTANT(k->constants, light.nearest)));
        lrb_v16f *way = k->early ? &s->limit : &k->u;
        *way = lrb_mask_mov_ps_s3(c, *way, blocked, lrb_full_ps(RAYS16_CONSTANT(k->constants, no_pixel)));
        return lrb_mov(c, lrb_imm(1));
    }
    s->limit = lrb_mask_mov_ps(c, s->limit, hits.m, hits.t);
    k->u = lrb_mask_mov_ps(c, k->u, hits.m, hits.u);
    k->v = lrb_mask_mov_ps(c, k->v, hits.m, hits.v);
    k->id = lrb_mask_mov_pi_s3(c, k->id, hits.m, lrb_1to16_pi(lrb_at(record, (int32_t)offsetof(bvh_triangle, id))));
    return lrb_mov(c, lrb_imm(1));
}

/* The rays of m against the triangles of a leaf; true if one of them has a nearer hit now. */
LRB_INLINE bool kd16_leaf(lrb_ctx *c, kd16 *k, slab16 *s, lrb_r64 leaf, lrb_r64 link, lrb_k16 m)
{
    lrb_r64 bytes = lrb_load32(c, lrb_at_index(k->nodes, leaf, 1, (int32_t)offsetof(kdtree_node, extent)));
    bytes = lrb_and(c, bytes, lrb_imm(~(uint64_t)KDTREE_KIND));
    lrb_r64 nearer = lrb_imm(0);
    if (lrb_jz(c, lrb_test(c, bytes, bytes)))
        return false;
    lrb_ptr entry = lrb_lea(c, k->lists, link, 1, -KDTREE_LEAF);
    lrb_ptr end = lrb_lea(c, entry, bytes, 1, 0);
    do {
        lrb_r64 offset = lrb_load32(c, lrb_at(entry, 0));
        if (!kd16_tested(c, k, offset))
            nearer = kd16_triangle(c, k, s, lrb_lea(c, k->records, offset, 1, 0), m, nearer);
        entry = lrb_lea(c, entry, lrb_imm(0), 1, 4);
    } while (lrb_jb(c, lrb_cmp_ptr(c, entry, end)));
    lrb_phase(c, KERNEL_PHASE_TRAVERSAL);
    return lrb_jnz(c, lrb_test(c, nearer, nearer));
}

/* Minus the farthest of the nearest hits of the rays of m, in all lanes: what is entered behind it cannot change a hit. */
LRB_INLINE lrb_v16f kd16_farthest(lrb_ctx *c, const kd16 *k, const slab16 *s, lrb_k16 m)
{
    lrb_v16f t = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel));
    t = lrb_mask_mov_ps(c, t, m, s->limit);
    t = kd16_largest(c, t, t);
    return lrb_sub_ps(c, s->zero, t);
}

/* The next cell on the stack that is entered before the farthest hit; false if there is none. */
LRB_INLINE bool kd16_pop(lrb_ctx *c, lrb_v16f minus_farthest, lrb_ptr bottom, lrb_ptr *top, kd16_place *at)
{
    while (!lrb_jz(c, lrb_cmp_ptr(c, *top, bottom))) {
        *top = lrb_lea(c, *top, lrb_imm(0), 1, -KD_STACK_ENTRY);
        at->t = lrb_load_4to16_ps(c, lrb_at(*top, 0));
        lrb_r64 entered = lrb_kmov_rk(c, lrb_cmple_ps(c, minus_farthest, at->t));
        if (lrb_jnz(c, lrb_test(c, entered, lrb_imm(2)))) {
            at->node = lrb_load32(c, lrb_at(*top, 8));
            return true;
        }
    }
    return false;
}

/* Trace the rays of m, whose rows are in scratch, from a place in the tree. `zero`: a row's interval may hold 0; a constant. */
LRB_INLINE void kd16_run(lrb_ctx *c, kd16 *k, slab16 *s, bool zero, kd16_place at, lrb_k16 m)
{
    lrb_ptr bottom = lrb_lea(c, k->scratch, lrb_imm(0), 1, KD_STACK);
    lrb_ptr top = bottom;
    lrb_v16f minus_farthest = kd16_farthest(c, k, s, m);
    uint64_t inner_before = k->n->n[KERNEL_traversed_inner];
    do {
        lrb_r64 link, axis;
        for (;;) {
            link = lrb_load32(c, lrb_at_index(k->nodes, at.node, 1, (int32_t)offsetof(kdtree_node, link)));
            axis = lrb_and(c, link, lrb_imm(KDTREE_KIND));
            if (lrb_jz(c, lrb_cmp(c, axis, lrb_imm(KDTREE_LEAF))))
                break;
            kd16_descend(c, k, s, zero, link, axis, &at, &top);
        }
        k->n->n[KERNEL_traversed_cells]++; /* leaves; the inner nodes are added at the end */
        if (kd16_leaf(c, k, s, at.node, link, m)) /* the branch is kd16_leaf's own */
            minus_farthest = kd16_farthest(c, k, s, m);
    } while (kd16_pop(c, minus_farthest, bottom, &top, &at));
    k->n->n[KERNEL_traversed_cells] += k->n->n[KERNEL_traversed_inner] - inner_before;
}

/* Rows, mailbox and start of the rays of m, which have one octant; then the traversal. */
LRB_INLINE void kd16_octant(lrb_ctx *c, kd16 *k, slab16 *s, bool zero, lrb_r64 start, lrb_v16f entry, lrb_v16f exit, lrb_k16 m)
{
    kd16_place at = {.node = start};
    lrb_phase(c, KERNEL_PHASE_SETUP);
    for (int axis = 0; axis < 3; axis++)
        kd16_row_setup(c, k, s, axis, m);
    if (k->mailbox) {
        lrb_v16i none = lrb_load_1to16_pi(c, RAYS16_CONSTANT(k->constants, no_hit));
        for (int i = 0; i < KD_MAILBOX_SLOTS / 16; i++)
            lrb_store_pi(c, lrb_at(k->scratch, KD_MAILBOX + 64 * i), none);
    }
    lrb_v16f lowest = lrb_load_ps(c, RAYS16_CONSTANT(k->constants, no_pixel));
    lrb_v16f minus_entry = lrb_mask_sub_ps(c, lowest, m, s->zero, entry);
    at.t = kd16_largest(c, lrb_mask_mov_ps(c, lowest, m, exit), minus_entry);
    lrb_phase(c, KERNEL_PHASE_TRAVERSAL);
    kd16_run(c, k, s, zero, at, m);
}

/* Those of the rays of `rest` that are traced together with the first of them: its octant, or it alone. */
LRB_INLINE lrb_r64 kd16_alike(lrb_ctx *c, const kd16 *k, lrb_r64 rest, const lrb_r64 negative[3])
{
    lrb_r64 first = lrb_bts(c, lrb_imm(0), lrb_bsff(c, rest));
    if (k->single_rays)
        return first;
    for (int axis = 0; axis < 3; axis++) {
        lrb_r64 alike = negative[axis];
        if (lrb_jz(c, lrb_test(c, first, alike)))
            alike = lrb_xor(c, alike, lrb_imm(0xffff));
        rest = lrb_and(c, rest, alike);
    }
    return rest;
}

/* The rays of m part by part; `common`: they are of one octant. */
LRB_INLINE void kd16_parts(lrb_ctx *c, kd16 *k, slab16 *s, bool zero, bool common, lrb_r64 start, lrb_v16f entry, lrb_v16f exit, lrb_k16 m)
{
    if (lrb_jz(c, lrb_kortest(c, m, m)))
        return;
    lrb_r64 rest = lrb_kmov_rk(c, m), same = rest, negative[3] = {rest, rest, rest};
    for (int axis = 0; !common && axis < 3; axis++)
        negative[axis] = lrb_kmov_rk(c, lrb_cmplt_ps(c, k->d[axis], s->zero));
    do {
        if (!common) /* which of the two is known since the packet's path was chosen */
            same = kd16_alike(c, k, rest, negative);
        rest = lrb_xor(c, rest, same);
        kd16_octant(c, k, s, zero, start, entry, exit, lrb_kmov_kr(c, same));
    } while (lrb_jnz(c, lrb_test(c, rest, rest)));
}

/* Distances at which rays enter and leave the box in scratch; returns the rays of m that meet it before they end. */
LRB_INLINE lrb_k16 kd16_enter(lrb_ctx *c, const kd16 *k, const slab16 *s, slab16_path path, lrb_k16 m, lrb_v16f *entry, lrb_v16f *exit)
{
    *entry = s->zero;
    *exit = s->infinity;
    for (int axis = 0; axis < 3; axis++) {
        lrb_s3f planes[2];
        slab16_planes(c, s, path, k->scratch, axis, 0, planes);
        *entry = lrb_max_ps(c, *entry, slab16_entry(c, s, path, planes, axis));
        lrb_v16f axis_exit = slab16_exit(c, s, path, planes, axis);
        *exit = axis ? lrb_min_ps(c, *exit, axis_exit) : axis_exit;
    }
    if (k->any)
        *exit = lrb_min_ps(c, *exit, s->limit);
    return lrb_mask_cmple_ps(c, m, *entry, *exit);
}

/**
 * Trace the rays d of `active` from a node whose cell, relative to the origin, is the box in scratch.
 *
 * @param s  as slab16_setup left it, its limit set; the nearest hits come back in it and in *k
 */
LRB_INLINE void kd16_trace(lrb_ctx *c, kd16 *k, slab16 *s, lrb_r64 start, lrb_k16 active)
{
    lrb_v16f entry, exit;
    lrb_k16 m;
    lrb_phase(c, KERNEL_PHASE_TRAVERSAL);
    if (s->path == SLAB16_ZERO) { /* slab16_setup's branches */
        k->n->n[KERNEL_units_divergent]++;
        m = kd16_enter(c, k, s, SLAB16_ZERO, active, &entry, &exit);
        kd16_parts(c, k, s, true, false, start, entry, exit, m);
        return;
    }
    if (s->path == SLAB16_BLEND) {
        k->n->n[KERNEL_units_divergent]++;
        m = kd16_enter(c, k, s, SLAB16_BLEND, active, &entry, &exit);
    } else {
        m = kd16_enter(c, k, s, SLAB16_COMMON, active, &entry, &exit);
    }
    kd16_parts(c, k, s, false, s->path == SLAB16_COMMON, start, entry, exit, m);
}

#endif
