/* How a tree is built:
 *
 * 1. Every triangle that is not degenerate becomes a reference (box and id), in the order of ids.
 * 2. The top of the tree is split breadth first until its leaves are lists of moderate length. Long lists are split
 *    one after the other, each by all threads in pieces of fixed length; shorter ones next to each other.
 * 3. Each of those lists becomes a subtree, depth first, one thread a subtree.
 * 4. Node pairs move to their final places: a pair, then all below its left node, then all below its right node.
 *
 * A split copies the list from one of two arrays to the same range of the other and keeps the order of either side,
 * so ids ascend in every list and every leaf. A list of n triangles has at most n-1 splits: the pairs of a subtree
 * fit into the same range of an array of pairs. What is done in which piece depends on counts, never on threads.
 */
#include "kernels/accel/bvh_builder.h"

#include <stdlib.h>
#include <string.h>

#include "kernels/accel/bvh_split.h"
#include "lrbni/base/parallel.h"

enum {
    LINE = 64,
    PIECE = 1 << 15,         /* triangles of a list that one thread works on at a time */
    MIN_SUBTREE = 1 << 11,   /* bounds of the length of a list that is left to one thread: ... */
    MAX_SUBTREE = 1 << 14,   /* ... longer costs balance, shorter costs starting threads */
    SUBTREES = 64            /* as many lists are wanted, within those bounds */
};

/* A list still to be divided, and its box. */
typedef struct span {
    accel_box box;
    size_t begin, count;
    unsigned depth; /* edges from the root */
    unsigned side;  /* which of the two arrays holds the references */
} span;

/* A node of the top; those without a child are the roots of the subtrees. */
typedef struct top_node {
    span list;
    size_t child;       /* of two neighbours in `tops`; 0: none */
    size_t pair_count;  /* pairs below this node */
    size_t first_pair;  /* final number of the first of them */
    unsigned depth;     /* deepest leaf below, edges from the root */
} top_node;

typedef struct builder {
    const scene *scene;
    unsigned max_leaf, bins, jobs;
    size_t count;         /* references */
    size_t subtree_count; /* longest list that is left to one thread */
    bvh_ref *refs[2];
    bvh_node *pairs; /* of the subtrees, two nodes each: entry 2*i belongs to the subtree whose list holds i */
    bvh *tree;
    top_node *tops;
    size_t top_count, top_room;
    size_t *work; /* numbers of top nodes, as many as top_room */
    size_t work_count;
    size_t *piece_count; /* by piece: references, then those on the left */
    bvh_extent *piece_extent;
    bvh_bins *piece_bins;
    accel_box *piece_box;
    size_t pieces; /* of the whole scene */
    /* the long list that is being split in pieces */
    span *list;
    bvh_frame frame;
    bvh_split split;
} builder;

static size_t size_min(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Memory in whole lines, never none; to be freed by free(). */
static void *lines_alloc(size_t size)
{
    return aligned_alloc(LINE, size ? (size + LINE - 1) / LINE * LINE : LINE);
}

/* Most triangles on one side of a split of a list at this depth: more would not fit into the levels that remain. */
static size_t most_below(const builder *b, unsigned depth)
{
    unsigned levels = BVH_MAX_DEPTH - (depth + 1);
    return levels > 32 ? SIZE_MAX : (size_t)b->max_leaf << levels;
}

static bvh_node node_of_box(const accel_box *box)
{
    bvh_node node = {.link = 0, .count = 0};
    for (int axis = 0; axis < 3; axis++) {
        node.min[axis] = box->v[axis];
        node.max[axis] = 0.0f - box->v[axis + 4];
    }
    return node;
}

/* The two lists of a split; where there is none, the halves by position. */
static void spans_of_split(const builder *b, const span *list, const bvh_split *split, span out[2])
{
    size_t left_count = split->left_count;
    unsigned side = list->side ^ 1;
    accel_box left = split->left, right = split->right;
    if (split->axis < 0) {
        const bvh_ref *refs = b->refs[list->side] + list->begin;
        side = list->side;
        left_count = list->count - list->count / 2;
        left = bvh_refs_box(refs, left_count);
        right = bvh_refs_box(refs + left_count, list->count - left_count);
    }
    out[0] = (span){left, list->begin, left_count, list->depth + 1, side};
    out[1] = (span){right, list->begin + left_count, list->count - left_count, list->depth + 1, side};
}

/* Divide a list in this thread. */
static void span_divide(const builder *b, const span *list, bvh_bins *bins, span out[2])
{
    const bvh_ref *refs = b->refs[list->side] + list->begin;
    bvh_ref *to = b->refs[list->side ^ 1] + list->begin;
    bvh_frame frame = bvh_frame_create(bvh_refs_extent(refs, list->count), b->bins);
    bvh_bins_fill(bins, &frame, refs, list->count);
    bvh_split split = bvh_bins_split(bins, b->bins, most_below(b, list->depth));
    if (split.axis >= 0)
        bvh_refs_divide(refs, list->count, &frame, &split, to, 0, split.left_count);
    spans_of_split(b, list, &split, out);
}

/* ---- 1. references ---- */

static void create_refs(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t begin = piece * PIECE, end = size_min(begin + PIECE, b->scene->triangle_count);
    bvh_ref *refs = b->refs[1] + begin;
    size_t count = 0;
    (void)worker;
    for (size_t i = begin; i < end; i++)
        if (!accel_triangle_is_degenerate(&b->scene->triangles[i]))
            refs[count++] = bvh_ref_create(&b->scene->triangles[i], (uint32_t)i);
    b->piece_count[piece] = count;
    b->piece_box[piece] = bvh_refs_box(refs, count);
}

/* References of all triangles in refs[1] without gaps, and the box around them. */
static accel_box gather_refs(builder *b)
{
    accel_box box = accel_box_empty();
    base_parallel_for(b->jobs, b->pieces, create_refs, b);
    for (size_t piece = 0; piece < b->pieces; piece++) {
        if (b->count != piece * PIECE)
            memmove(b->refs[1] + b->count, b->refs[1] + piece * PIECE, b->piece_count[piece] * sizeof(bvh_ref));
        b->count += b->piece_count[piece];
        accel_box_add(&box, &b->piece_box[piece]);
    }
    return box;
}

/* ---- 2. the top of the tree ---- */

static const bvh_ref *piece_of_list(const builder *b, size_t piece, size_t *count)
{
    size_t begin = piece * PIECE;
    *count = size_min(PIECE, b->list->count - begin);
    return b->refs[b->list->side] + b->list->begin + begin;
}

static void piece_measure(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t count;
    const bvh_ref *refs = piece_of_list(b, piece, &count);
    (void)worker;
    b->piece_extent[piece] = bvh_refs_extent(refs, count);
}

static void piece_fill(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t count;
    const bvh_ref *refs = piece_of_list(b, piece, &count);
    (void)worker;
    bvh_bins_fill(&b->piece_bins[piece], &b->frame, refs, count);
}

static void piece_divide(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t count, left = b->piece_count[piece], right = piece * PIECE - left;
    const bvh_ref *refs = piece_of_list(b, piece, &count);
    bvh_ref *to = b->refs[b->list->side ^ 1] + b->list->begin;
    (void)worker;
    bvh_refs_divide(refs, count, &b->frame, &b->split, to, left, b->split.left_count + right);
}

/* Divide a list with all threads; the result is that of span_divide. `bins` is scratch. */
static void span_divide_wide(builder *b, span *list, bvh_bins *bins, span out[2])
{
    size_t pieces = (list->count + PIECE - 1) / PIECE, left = 0;
    b->list = list;
    base_parallel_for(b->jobs, pieces, piece_measure, b);
    bvh_extent extent = b->piece_extent[0];
    for (size_t p = 1; p < pieces; p++)
        bvh_extent_add(&extent, &b->piece_extent[p]);
    b->frame = bvh_frame_create(extent, b->bins);
    base_parallel_for(b->jobs, pieces, piece_fill, b);
    *bins = b->piece_bins[0];
    for (size_t p = 1; p < pieces; p++)
        bvh_bins_add(bins, &b->piece_bins[p], b->bins);
    b->split = bvh_bins_split(bins, b->bins, most_below(b, list->depth));
    if (b->split.axis >= 0) {
        for (size_t p = 0; p < pieces; p++) {
            b->piece_count[p] = left;
            left += bvh_bins_left_count(&b->piece_bins[p], &b->split);
        }
        base_parallel_for(b->jobs, pieces, piece_divide, b);
    }
    spans_of_split(b, list, &b->split, out);
}

static void divide_one(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    top_node *node = &b->tops[b->work[piece]];
    bvh_bins bins;
    span out[2];
    (void)worker;
    span_divide(b, &node->list, &bins, out);
    b->tops[node->child].list = out[0];
    b->tops[node->child + 1].list = out[1];
}

/* Room for at least `room` top nodes. */
static base_status reserve_tops(builder *b, size_t room, base_error *err)
{
    if (room <= b->top_room)
        return BASE_OK;
    room += b->top_room;
    top_node *tops = realloc(b->tops, room * sizeof *tops);
    if (tops)
        b->tops = tops;
    size_t *work = tops ? realloc(b->work, room * sizeof *work) : NULL;
    if (!work)
        return base_fail(err, BASE_ERR_NOMEM, "bvh", "out of memory");
    b->work = work;
    b->top_room = room;
    return BASE_OK;
}

/* Divide the nodes from `first` on where they are too long for one thread; their children follow at the end. */
static base_status divide_tops(builder *b, size_t first, bvh_bins *bins, base_error *err)
{
    size_t last = b->top_count;
    base_status status = reserve_tops(b, last + 2 * (last - first), err);
    if (status != BASE_OK)
        return status;
    b->work_count = 0;
    for (size_t i = first; i < last; i++) {
        top_node *node = &b->tops[i];
        if (node->list.count <= b->subtree_count)
            continue;
        node->child = b->top_count;
        b->top_count += 2;
        memset(&b->tops[node->child], 0, 2 * sizeof *node);
        if (node->list.count > 2 * PIECE) {
            span out[2];
            span_divide_wide(b, &node->list, bins, out);
            b->tops[node->child].list = out[0];
            b->tops[node->child + 1].list = out[1];
        } else
            b->work[b->work_count++] = i;
    }
    base_parallel_for(b->jobs, b->work_count, divide_one, b);
    return BASE_OK;
}

static base_status build_top(builder *b, accel_box box, base_error *err)
{
    bvh_bins bins;
    size_t first = 0, last = 1, wanted = b->count / SUBTREES;
    b->subtree_count = wanted < MIN_SUBTREE ? MIN_SUBTREE : size_min(wanted, MAX_SUBTREE);
    base_status status = reserve_tops(b, 1, err);
    if (status != BASE_OK)
        return status;
    b->tops[0] = (top_node){.list = {.box = box, .count = b->count, .side = 1}};
    b->top_count = 1;
    while (status == BASE_OK && first < last) {
        status = divide_tops(b, first, &bins, err);
        first = last;
        last = b->top_count;
    }
    return status;
}

/* ---- 3. subtrees ---- */

/* Write a leaf: the records of the list, which is in the order of ids. */
static void write_leaf(const builder *b, const span *list, bvh_node *node)
{
    const bvh_ref *refs = b->refs[list->side] + list->begin;
    bvh_triangle *records = b->tree->records + list->begin;
    *node = node_of_box(&list->box);
    node->link = (uint32_t)(list->begin * sizeof *records);
    node->count = (uint32_t)list->count;
    for (size_t i = 0; i < list->count; i++) {
        uint32_t id = bvh_ref_id(&refs[i]);
        records[i] = bvh_triangle_create(&b->scene->triangles[id], id);
    }
}

typedef struct pending {
    span list;
    bvh_node *node; /* where it goes */
} pending;

/* Build the pairs below a top node, whose own node place_top makes. Links count from the subtree's first pair. A right
   list waits while all on its left is built: at most one at each depth. */
static void build_subtree(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    top_node *top = &b->tops[b->work[piece]];
    bvh_node *pairs = b->pairs + 2 * top->list.begin;
    bvh_node root;
    bvh_bins bins;
    pending waiting[BVH_MAX_DEPTH + 1], now = {top->list, &root};
    unsigned waiting_count = 0;
    (void)worker;
    top->depth = top->list.depth;
    for (;;) {
        if (now.list.count <= b->max_leaf) {
            write_leaf(b, &now.list, now.node);
            top->depth = now.list.depth > top->depth ? now.list.depth : top->depth;
            if (waiting_count == 0)
                return;
            now = waiting[--waiting_count];
            continue;
        }
        bvh_node *pair = pairs + 2 * top->pair_count;
        span sides[2];
        *now.node = node_of_box(&now.list.box);
        now.node->link = (uint32_t)(top->pair_count * LINE);
        top->pair_count++;
        span_divide(b, &now.list, &bins, sides);
        waiting[waiting_count++] = (pending){sides[1], pair + 1};
        now = (pending){sides[0], pair};
    }
}

static void build_subtrees(builder *b)
{
    b->work_count = 0;
    for (size_t i = 0; i < b->top_count; i++)
        if (b->tops[i].child == 0)
            b->work[b->work_count++] = i;
    base_parallel_for(b->jobs, b->work_count, build_subtree, b);
}

/* ---- 4. final places ---- */

/* Number the pairs: children have higher numbers in `tops` than their parents. */
static void number_pairs(builder *b)
{
    top_node *tops = b->tops;
    for (size_t i = b->top_count; i-- > 0;)
        if (tops[i].child != 0) {
            const top_node *left = &tops[tops[i].child], *right = left + 1;
            tops[i].pair_count = 1 + left->pair_count + right->pair_count;
            tops[i].depth = left->depth > right->depth ? left->depth : right->depth;
        }
    for (size_t i = 0; i < b->top_count; i++)
        if (tops[i].child != 0) {
            top_node *left = &tops[tops[i].child], *right = left + 1;
            left->first_pair = tops[i].first_pair + 1;
            right->first_pair = left->first_pair + left->pair_count;
        }
}

/* The node of a top node; pair 0 is the one at entry 2, after the root and its neighbour. */
static bvh_node place_top(const builder *b, const top_node *top)
{
    bvh_node node = node_of_box(&top->list.box);
    if (top->pair_count > 0)
        node.link = (uint32_t)((top->first_pair + 1) * LINE);
    else {
        node.link = (uint32_t)(top->list.begin * sizeof *b->tree->records);
        node.count = (uint32_t)top->list.count;
    }
    return node;
}

static void place_subtree(void *user, size_t piece, unsigned worker)
{
    const builder *b = user;
    const top_node *top = &b->tops[b->work[piece]];
    const bvh_node *from = b->pairs + 2 * top->list.begin;
    bvh_node *to = b->tree->nodes + 2 * (top->first_pair + 1);
    uint32_t shift = (uint32_t)((top->first_pair + 1) * LINE);
    (void)worker;
    for (size_t i = 0; i < 2 * top->pair_count; i++) {
        to[i] = from[i];
        to[i].link += to[i].count == 0 ? shift : 0;
    }
}

static base_status place_nodes(builder *b, base_error *err)
{
    bvh *tree = b->tree;
    number_pairs(b);
    tree->inner_count = b->tops[0].pair_count;
    tree->depth = b->tops[0].depth;
    tree->node_count = 2 * (tree->inner_count + 1);
    tree->nodes = lines_alloc(tree->node_count * sizeof *tree->nodes);
    if (!tree->nodes)
        return base_fail(err, BASE_ERR_NOMEM, "bvh", "out of memory");
    tree->nodes[0] = place_top(b, &b->tops[0]);
    memset(&tree->nodes[1], 0, sizeof tree->nodes[1]);
    for (size_t i = 0; i < b->top_count; i++)
        if (b->tops[i].child != 0) {
            bvh_node *pair = tree->nodes + 2 * (b->tops[i].first_pair + 1);
            pair[0] = place_top(b, &b->tops[b->tops[i].child]);
            pair[1] = place_top(b, &b->tops[b->tops[i].child + 1]);
        }
    base_parallel_for(b->jobs, b->work_count, place_subtree, b);
    return BASE_OK;
}

/* ---- all together ---- */

/* All memory whose size is known from the number of triangles, at most 2^25: no product overflows. */
static base_status builder_alloc(builder *b, base_error *err)
{
    size_t n = b->scene->triangle_count;
    b->pieces = (n + PIECE - 1) / PIECE;
    b->refs[0] = lines_alloc(n * sizeof(bvh_ref));
    b->refs[1] = lines_alloc(n * sizeof(bvh_ref));
    b->piece_count = lines_alloc(b->pieces * sizeof *b->piece_count);
    b->piece_extent = lines_alloc(b->pieces * sizeof *b->piece_extent);
    b->piece_bins = lines_alloc(b->pieces * sizeof *b->piece_bins);
    b->piece_box = lines_alloc(b->pieces * sizeof *b->piece_box);
    if (!b->refs[0] || !b->refs[1] || !b->piece_count || !b->piece_extent || !b->piece_bins || !b->piece_box)
        return base_fail(err, BASE_ERR_NOMEM, "bvh", "out of memory for %zu triangles", n);
    return BASE_OK;
}

static void builder_free(builder *b)
{
    free(b->refs[0]);
    free(b->refs[1]);
    free(b->pairs);
    free(b->tops);
    free(b->work);
    free(b->piece_count);
    free(b->piece_extent);
    free(b->piece_bins);
    free(b->piece_box);
}

static base_status build(builder *b, base_error *err)
{
    bvh *tree = b->tree;
    base_status status = builder_alloc(b, err);
    if (status != BASE_OK)
        return status;
    accel_box box = gather_refs(b);
    tree->record_count = b->count;
    tree->degenerate_count = b->scene->triangle_count - b->count;
    tree->records = lines_alloc(b->count * sizeof *tree->records);
    b->pairs = lines_alloc(2 * b->count * sizeof *b->pairs);
    if (!tree->records || !b->pairs)
        return base_fail(err, BASE_ERR_NOMEM, "bvh", "out of memory for %zu triangles", b->count);
    status = build_top(b, box, err);
    if (status != BASE_OK)
        return status;
    build_subtrees(b);
    return place_nodes(b, err);
}

base_status bvh_builder_run(const scene *s, const bvh_options *options, bvh *tree, base_error *err)
{
    if (s->triangle_count > SCENE_MAX_TRIANGLES)
        return base_fail(err, BASE_ERR_INPUT, s->name, "%zu triangles are more than %zu", s->triangle_count,
                         SCENE_MAX_TRIANGLES);
    builder b = {.scene = s, .max_leaf = options->max_leaf, .bins = options->bins, .jobs = options->jobs, .tree = tree};
    base_status status = build(&b, err);
    builder_free(&b);
    return status;
}
