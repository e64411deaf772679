/* How a kd-tree is built:
 *
 * 1. Every triangle that is not degenerate becomes a reference (box and id), in the order of ids.
 * 2. The top of the tree is divided breadth first, one cell after the other, each by all threads: they sort the bounds of the
 *    triangles axis by axis, and divide the triangles in pieces of fixed length. Cells of few triangles are left.
 * 3. Each of those becomes a subtree, depth first, one thread a subtree.
 * 4. Pairs of nodes and lists move to their final places: a pair, then all below its first node, then all below its second.
 * 5. The lists' ids become offsets of records, which are written in the order in which the lists name them.
 *
 * A cell is divided without changing the order of references, so ids ascend in every list. Sorting a cell's bounds takes
 * time in proportion to them (radix sort of 32-bit keys), so all of it takes O(n log n), as with Wald and Havran's
 * presorted events, but nothing has to be kept sorted from level to level. What is done in which piece depends on counts,
 * never on threads.
 */
#include "kernels/accel/kdtree_builder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/accel/box.h"
#include "kernels/accel/kdtree_subtree.h"
#include "lrbni/base/parallel.h"

enum {
    LINE = 64,
    PIECE = 1 << 15,       /* references that one thread works on at a time */
    MIN_SUBTREE = 1 << 10, /* bounds of the references of a cell that is left to one thread: ... */
    MAX_SUBTREE = 1 << 16, /* ... more cost balance and memory, fewer cost starting threads */
    SUBTREES = 64          /* as many are wanted, within those bounds */
};

/* A cell of the top of the tree; those without a child are the roots of subtrees. */
typedef struct top_node {
    kdtree_span span; /* references: owned until the cell is divided or built */
    kdtree_split split;
    size_t child; /* of two neighbours in `tops`; 0: none */
    kdtree_subtree below;
    size_t pair_count, first_pair; /* pairs below this node, and the final number of the first of them */
    size_t first_id;               /* place of its first list */
} top_node;

typedef struct builder {
    const scene *scene;
    kdtree_rules rules;
    unsigned max_depth, jobs;
    kdtree *tree;
    top_node *tops;
    size_t top_count, top_room;
    size_t subtree_count; /* most references of a cell that is left to one thread */
    size_t *subtrees;     /* the tops without a child */
    size_t subtrees_count;
    kdtree_worker *workers; /* by thread */
    base_status *statuses;  /* by thread: its first failure, and ... */
    base_error *errors;     /* ... its words */
    kdtree_bounds bounds[3];
    /* the cell that is being divided by all threads, and its pieces */
    const kdtree_span *span;
    const kdtree_split *split;
    kdtree_split axes[3];
    kdtree_ref *halves[2];
    size_t (*piece_counts)[2]; /* references below and above, then where they go */
    kdtree_ref *to[2];
} builder;

static size_t size_min(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void *lines_alloc(size_t size)
{
    return aligned_alloc(LINE, size ? (size + LINE - 1) / LINE * LINE : LINE);
}

static base_status out_of_memory(base_error *err)
{
    return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
}

/* ---- 1. references ---- */

static void create_refs(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t begin = piece * PIECE, end = size_min(begin + PIECE, b->scene->triangle_count), count = 0;
    (void)worker;
    for (size_t i = begin; i < end; i++) {
        const scene_triangle *t = &b->scene->triangles[i];
        if (accel_triangle_is_degenerate(t))
            continue;
        accel_box box = accel_box_of_triangle(t);
        kdtree_ref ref = {.id = (uint32_t)i};
        for (int axis = 0; axis < 3; axis++) {
            ref.box.min[axis] = box.v[axis];
            ref.box.max[axis] = 0.0f - box.v[axis + 4];
        }
        b->halves[0][begin + count++] = ref;
    }
    b->piece_counts[piece][0] = count;
}

/* References of all triangles in halves[0] without gaps; returns their number. */
static size_t gather_refs(builder *b)
{
    size_t pieces = (b->scene->triangle_count + PIECE - 1) / PIECE, count = 0;
    base_parallel_for(b->jobs, pieces, create_refs, b);
    for (size_t piece = 0; piece < pieces; piece++) {
        if (count != piece * PIECE)
            memmove(b->halves[0] + count, b->halves[0] + piece * PIECE, b->piece_counts[piece][0] * sizeof(kdtree_ref));
        count += b->piece_counts[piece][0];
    }
    return count;
}

/* ---- 2. the top of the tree ---- */

static void sort_bounds(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    int axis = (int)piece / 2, side = (int)piece % 2;
    (void)worker;
    kdtree_bounds_sort(&b->bounds[axis], side, b->span->refs, b->span->count, axis);
}

static void sweep_bounds(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    int axis = (int)piece;
    (void)worker;
    b->axes[axis] = kdtree_split_cheapest(&b->rules, &b->span->cell, &b->bounds[axis], b->span->count, axis);
}

/* kdtree_span_split by all threads. */
static base_status split_wide(builder *b, const kdtree_span *span, kdtree_split *out, base_error *err)
{
    base_status status = BASE_OK;
    b->span = span;
    *out = (kdtree_split){.axis = -1};
    if (span->depth >= b->max_depth)
        return BASE_OK;
    kdtree_cell around = kdtree_refs_around(span->refs, span->count);
    *out = kdtree_split_empty(&b->rules, &span->cell, &around);
    if (out->axis >= 0)
        return BASE_OK;
    status = kdtree_split_covered(&b->rules, &span->cell, span->refs, span->count, &b->bounds[0], out, err);
    for (int axis = 0; status == BASE_OK && axis < 3; axis++)
        status = kdtree_bounds_reserve(&b->bounds[axis], span->count, err);
    if (status != BASE_OK || out->axis >= 0)
        return status;
    base_parallel_for(b->jobs, 6, sort_bounds, b);
    base_parallel_for(b->jobs, 3, sweep_bounds, b);
    *out = kdtree_split_best(&b->rules, &span->cell, b->axes, span->count);
    return BASE_OK;
}

static void divide_piece(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    size_t begin = piece * PIECE, count = size_min(PIECE, b->span->count - begin);
    (void)worker;
    kdtree_refs_divide(&b->rules, &b->span->cell, b->split, b->span->refs + begin, count, b->halves[0] + begin,
                       b->halves[1] + begin, b->piece_counts[piece]);
}

static void copy_piece(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    (void)worker;
    for (int side = 0; side < 2; side++) {
        size_t first = b->piece_counts[piece][side], last = b->piece_counts[piece + 1][side];
        if (last > first)
            memcpy(b->to[side] + first, b->halves[side] + piece * PIECE, (last - first) * sizeof(kdtree_ref));
    }
}

/* Divide a cell by all threads; its references are freed. */
static base_status divide_wide(builder *b, top_node *top, kdtree_span children[2], base_error *err)
{
    size_t pieces = (top->span.count + PIECE - 1) / PIECE, sum[2] = {0, 0};
    b->span = &top->span;
    b->split = &top->split;
    base_parallel_for(b->jobs, pieces, divide_piece, b);
    for (size_t piece = 0; piece <= pieces; piece++)
        for (int side = 0; side < 2; side++) {
            size_t count = piece < pieces ? b->piece_counts[piece][side] : 0;
            b->piece_counts[piece][side] = sum[side];
            sum[side] += count;
        }
    free(top->span.refs);
    top->span.refs = NULL;
    for (int side = 0; side < 2; side++) {
        b->to[side] = malloc((sum[side] + 1) * sizeof(kdtree_ref));
        kdtree_cell cell = kdtree_cell_half(&top->span.cell, top->split.axis, top->split.plane, side);
        children[side] = (kdtree_span){b->to[side], sum[side], cell, top->span.depth + 1};
    }
    if (!b->to[0] || !b->to[1])
        return out_of_memory(err);
    base_parallel_for(b->jobs, pieces, copy_piece, b);
    return BASE_OK;
}

/* Room for two more top nodes. */
static base_status reserve_tops(builder *b, base_error *err)
{
    if (b->top_count + 2 <= b->top_room)
        return BASE_OK;
    size_t room = 2 * b->top_room + 64;
    top_node *tops = realloc(b->tops, room * sizeof *tops);
    if (!tops)
        return out_of_memory(err);
    b->tops = tops;
    b->top_room = room;
    return BASE_OK;
}

static base_status divide_top(builder *b, size_t i, base_error *err)
{
    base_status status = reserve_tops(b, err);
    top_node *top = &b->tops[i];
    if (status == BASE_OK)
        status = split_wide(b, &top->span, &top->split, err);
    if (status != BASE_OK || top->split.axis < 0)
        return status;
    top->child = b->top_count;
    b->top_count += 2;
    memset(&b->tops[top->child], 0, 2 * sizeof *top);
    kdtree_span children[2];
    status = divide_wide(b, top, children, err);
    for (int side = 0; side < 2; side++)
        b->tops[top->child + (size_t)side].span = children[side];
    return status;
}

static base_status build_top(builder *b, base_error *err)
{
    size_t count = b->scene->triangle_count;
    b->halves[0] = malloc((count + 1) * sizeof *b->halves[0]);
    b->piece_counts = malloc((count / PIECE + 2) * sizeof *b->piece_counts);
    base_status status = reserve_tops(b, err);
    if (!b->halves[0] || !b->piece_counts || status != BASE_OK)
        return out_of_memory(err);
    count = gather_refs(b);
    kdtree_span root = {.refs = b->halves[0], .count = count, .cell = kdtree_refs_around(b->halves[0], count)};
    b->tops[0] = (top_node){.span = root};
    b->top_count = 1;
    b->halves[0] = malloc((count + 1) * sizeof *b->halves[0]);
    b->halves[1] = malloc((count + 1) * sizeof *b->halves[1]);
    if (!b->halves[0] || !b->halves[1])
        return out_of_memory(err);
    b->rules.margin = kdtree_cell_margin(&root.cell);
    b->rules.min_half_area *= count ? kdtree_cell_half_area(&root.cell) : 0.0;
    size_t wanted = count / SUBTREES;
    b->subtree_count = wanted < MIN_SUBTREE ? MIN_SUBTREE : size_min(wanted, MAX_SUBTREE);
    for (size_t i = 0; status == BASE_OK && i < b->top_count; i++)
        if (b->tops[i].span.count > b->subtree_count)
            status = divide_top(b, i, err);
    return status;
}

/* ---- 3. subtrees ---- */

static void build_subtree(void *user, size_t piece, unsigned worker)
{
    builder *b = user;
    top_node *top = &b->tops[b->subtrees[piece]];
    if (b->statuses[worker] != BASE_OK)
        return;
    b->statuses[worker] =
        kdtree_subtree_build(&b->rules, b->max_depth, &top->span, &b->workers[worker], &top->below, &b->errors[worker]);
    free(top->span.refs);
    top->span.refs = NULL;
}

static base_status build_subtrees(builder *b, base_error *err)
{
    for (int side = 0; side < 2; side++) {
        free(b->halves[side]);
        b->halves[side] = NULL;
    }
    for (int axis = 0; axis < 3; axis++)
        kdtree_bounds_free(&b->bounds[axis]);
    b->subtrees = malloc(b->top_count * sizeof *b->subtrees);
    b->workers = calloc(b->jobs, sizeof *b->workers);
    b->statuses = calloc(b->jobs, sizeof *b->statuses);
    b->errors = calloc(b->jobs, sizeof *b->errors);
    if (!b->subtrees || !b->workers || !b->statuses || !b->errors)
        return out_of_memory(err);
    for (size_t i = 0; i < b->top_count; i++)
        if (b->tops[i].child == 0)
            b->subtrees[b->subtrees_count++] = i;
    base_parallel_for(b->jobs, b->subtrees_count, build_subtree, b);
    for (unsigned worker = 0; worker < b->jobs; worker++) {
        kdtree_worker_free(&b->workers[worker]);
        if (b->statuses[worker] != BASE_OK)
            return base_fail(err, b->statuses[worker], b->errors[worker].what, "%s", b->errors[worker].why);
    }
    return BASE_OK;
}

/* ---- 4. final places ---- */

/* Number pairs and lists: children have higher numbers in `tops` than their parents. */
static void number_tops(builder *b)
{
    top_node *tops = b->tops;
    for (size_t i = b->top_count; i-- > 0;) {
        tops[i].pair_count = tops[i].below.pair_count;
        if (tops[i].child != 0) {
            const top_node *below = &tops[tops[i].child], *above = below + 1;
            tops[i].pair_count = 1 + below->pair_count + above->pair_count;
            tops[i].below.id_count = below->below.id_count + above->below.id_count;
        }
    }
    for (size_t i = 0; i < b->top_count; i++)
        if (tops[i].child != 0) {
            top_node *below = &tops[tops[i].child], *above = below + 1;
            below->first_pair = tops[i].first_pair + 1;
            above->first_pair = below->first_pair + below->pair_count;
            below->first_id = tops[i].first_id;
            above->first_id = below->first_id + below->below.id_count;
        }
}

/* A node of a subtree in its final place; pair 0 is the one at entry 2, after the root and its neighbour. */
static kdtree_node place_node(const top_node *top, kdtree_node node)
{
    if (!kdtree_is_leaf(&node))
        node.link += (uint32_t)(2 * sizeof node * (top->first_pair + 1));
    else if (kdtree_leaf_count(&node) > 0)
        node.link += (uint32_t)(sizeof(uint32_t) * top->first_id);
    return node;
}

static kdtree_node place_top(const top_node *top)
{
    if (top->child == 0)
        return place_node(top, top->below.root);
    uint32_t children = (uint32_t)(2 * sizeof(kdtree_node) * (top->first_pair + 1));
    return (kdtree_node){.link = children | (uint32_t)top->split.axis, .split = top->split.plane};
}

static void place_subtree(void *user, size_t piece, unsigned worker)
{
    const builder *b = user;
    top_node *top = &b->tops[b->subtrees[piece]];
    kdtree_node *to = b->tree->nodes + 2 * (top->first_pair + 1);
    (void)worker;
    for (size_t i = 0; i < 2 * top->below.pair_count; i++)
        to[i] = place_node(top, top->below.pairs[i]);
    if (top->below.id_count)
        memcpy(b->tree->lists + top->first_id, top->below.ids, top->below.id_count * sizeof *top->below.ids);
    free(top->below.pairs);
    free(top->below.ids);
    top->below.pairs = NULL;
    top->below.ids = NULL;
}

static base_status place_nodes(builder *b, base_error *err)
{
    kdtree *tree = b->tree;
    number_tops(b);
    tree->node_count = 2 * (b->tops[0].pair_count + 1);
    tree->list_count = b->tops[0].below.id_count;
    if (tree->node_count * sizeof *tree->nodes > UINT32_MAX || tree->list_count * sizeof *tree->lists > UINT32_MAX)
        return base_fail(err, BASE_ERR_INPUT, b->scene->name, "its kd-tree is larger than 4 GiB");
    tree->nodes = lines_alloc(tree->node_count * sizeof *tree->nodes);
    tree->lists = lines_alloc(tree->list_count * sizeof *tree->lists);
    if (!tree->nodes || !tree->lists)
        return out_of_memory(err);
    tree->nodes[0] = place_top(&b->tops[0]);
    memset(&tree->nodes[1], 0, sizeof tree->nodes[1]);
    for (size_t i = 0; i < b->top_count; i++)
        if (b->tops[i].child != 0) {
            kdtree_node *pair = tree->nodes + 2 * (b->tops[i].first_pair + 1);
            pair[0] = place_top(&b->tops[b->tops[i].child]);
            pair[1] = place_top(&b->tops[b->tops[i].child + 1]);
        }
    base_parallel_for(b->jobs, b->subtrees_count, place_subtree, b);
    return BASE_OK;
}

/* ---- 5. records ---- */

/* Number the records in the order in which the lists name their triangles; entries become offsets. */
static base_status write_records(builder *b, size_t count, base_error *err)
{
    kdtree *tree = b->tree;
    uint32_t *places = malloc((b->scene->triangle_count + 1) * sizeof *places);
    tree->records = lines_alloc(count * sizeof *tree->records);
    if (!places || !tree->records) {
        free(places);
        return out_of_memory(err);
    }
    memset(places, 0xff, b->scene->triangle_count * sizeof *places);
    for (size_t i = 0; i < tree->list_count; i++) {
        uint32_t id = tree->lists[i];
        if (places[id] == UINT32_MAX) {
            places[id] = (uint32_t)(tree->record_count * sizeof *tree->records);
            tree->records[tree->record_count++] = bvh_triangle_create(&b->scene->triangles[id], id);
        }
        tree->lists[i] = places[id];
    }
    free(places);
    return BASE_OK;
}

/* ---- all together ---- */

static void builder_free(builder *b)
{
    for (size_t i = 0; i < b->top_count; i++) {
        free(b->tops[i].span.refs);
        free(b->tops[i].below.pairs);
        free(b->tops[i].below.ids);
    }
    for (int axis = 0; axis < 3; axis++)
        kdtree_bounds_free(&b->bounds[axis]);
    free(b->tops);
    free(b->subtrees);
    free(b->workers);
    free(b->statuses);
    free(b->errors);
    free(b->halves[0]);
    free(b->halves[1]);
    free(b->piece_counts);
}

static base_status build(builder *b, base_error *err)
{
    kdtree *tree = b->tree;
    base_status status = build_top(b, err);
    if (status != BASE_OK)
        return status;
    kdtree_cell root = b->tops[0].span.cell;
    size_t count = b->tops[0].span.count;
    memcpy(tree->min, root.min, sizeof tree->min);
    memcpy(tree->max, root.max, sizeof tree->max);
    tree->degenerate_count = b->scene->triangle_count - count;
    status = build_subtrees(b, err);
    if (status == BASE_OK)
        status = place_nodes(b, err);
    if (status == BASE_OK)
        status = write_records(b, count, err);
    return status;
}

base_status kdtree_builder_run(const scene *s, const kdtree_options *options, kdtree *tree, base_error *err)
{
    if (s->triangle_count > SCENE_MAX_TRIANGLES)
        return base_fail(err, BASE_ERR_INPUT, s->name, "%zu triangles are more than %zu", s->triangle_count, SCENE_MAX_TRIANGLES);
    builder b = {.scene = s, .max_depth = options->max_depth, .jobs = options->jobs, .tree = tree};
    b.rules = (kdtree_rules){
        .triangles = s->triangles,
        .traversal_cost = (double)options->traversal_cost,
        .empty_share = options->empty_percent / 100.0,
        .covered_planes = options->covered_planes != 0,
        .min_half_area = options->min_area * 1e-9, /* of the root's, which is not known yet */
        .perfect_splits = options->perfect_splits != 0,
    };
    base_status status = build(&b, err);
    builder_free(&b);
    return status;
}
