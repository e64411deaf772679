#include "kernels/accel/kdtree_tally.h"

#include <math.h>
#include <stdlib.h>

#include "kernels/accel/kdtree_cell.h"

typedef struct visit {
    kdtree_cell cell;
    size_t node;
    unsigned depth;
} visit;

typedef struct walk {
    kdtree *tree;
    const kdtree_options *options;
    size_t pairs, entries, records; /* met so far */
    double cost;
} walk;

static int flat_axes(const kdtree_cell *cell)
{
    int axes = 0;
    for (int axis = 0; axis < 3; axis++)
        axes += cell->min[axis] == cell->max[axis];
    return axes;
}

/* The functions below return what is wrong, or NULL. */

static const char *visit_inner(walk *w, const visit *v, visit children[2])
{
    const kdtree_node *node = &w->tree->nodes[v->node];
    uint32_t axis = node->link & KDTREE_KIND;
    w->pairs++;
    if (node->link - axis != 2 * sizeof *node * w->pairs || 2 * w->pairs + 1 >= w->tree->node_count)
        return "a pair of nodes is not where it belongs";
    if (v->depth >= w->options->max_depth)
        return "it is too deep";
    if (!(node->split >= v->cell.min[axis] && node->split <= v->cell.max[axis]))
        return "a plane lies outside its cell";
    for (int side = 0; side < 2; side++)
        children[side] = (visit){kdtree_cell_half(&v->cell, (int)axis, node->split, side), 2 * w->pairs + (size_t)side, v->depth + 1};
    w->cost += kdtree_cell_half_area(&v->cell) * (double)w->options->traversal_cost;
    return NULL;
}

static const char *visit_list(walk *w, const kdtree_node *leaf)
{
    const kdtree *tree = w->tree;
    size_t count = kdtree_leaf_count(leaf);
    if (leaf->link != 4 * w->entries + KDTREE_LEAF || count > tree->list_count - w->entries)
        return "a list is not where it belongs";
    for (size_t i = 0; i < count; i++) {
        uint32_t offset = tree->lists[w->entries + i], before = i > 0 ? tree->lists[w->entries + i - 1] : 0;
        size_t record = offset / sizeof(bvh_triangle);
        if (offset % sizeof(bvh_triangle) != 0 || record > w->records || record >= tree->record_count)
            return "a list names no record";
        if (i > 0 && tree->records[record].id <= tree->records[before / sizeof(bvh_triangle)].id)
            return "a list is out of order";
        w->records += record == w->records;
    }
    w->entries += count;
    return NULL;
}

static const char *visit_leaf(walk *w, const visit *v)
{
    kdtree *tree = w->tree;
    const kdtree_node *leaf = &tree->nodes[v->node];
    size_t count = kdtree_leaf_count(leaf);
    int flat = flat_axes(&v->cell);
    uint32_t flags = leaf->extent & KDTREE_KIND;
    tree->depth = v->depth > tree->depth ? v->depth : tree->depth;
    tree->flat_count += flat > 0;
    if (count == 0) {
        if (leaf->link / 4 >= tree->set_count || (flat > 0 && leaf->link / 4 > 0) || flags != 0)
            return "an empty leaf's set or flags are wrong";
        tree->empty_count++;
        tree->enclosed_count += leaf->link / 4 > 0;
        return NULL;
    }
    if (flags != 0 && (flags != KDTREE_COVERED || flat != 1))
        return "a leaf's flags are wrong";
    tree->covered_count += flags == KDTREE_COVERED;
    w->cost += kdtree_cell_half_area(&v->cell) * (double)count;
    return visit_list(w, leaf);
}

static const char *walk_all(walk *w)
{
    kdtree *tree = w->tree;
    visit stack[KDTREE_MAX_DEPTH + 2], children[2];
    size_t used = 0;
    const char *wrong = NULL;
    stack[used++] = (visit){{{tree->min[0], tree->min[1], tree->min[2]}, {tree->max[0], tree->max[1], tree->max[2]}}, 0, 0};
    while (!wrong && used > 0) {
        visit now = stack[--used];
        if (kdtree_is_leaf(&tree->nodes[now.node])) {
            wrong = visit_leaf(w, &now);
            continue;
        }
        wrong = visit_inner(w, &now, children);
        for (int side = 1; !wrong && side >= 0; side--)
            stack[used++] = children[side];
    }
    if (!wrong && (2 * (w->pairs + 1) != tree->node_count || w->entries != tree->list_count || w->records != tree->record_count))
        wrong = "it does not use all of its nodes, lists or records";
    return wrong;
}

/* Children have higher numbers than their parents. */
static void fill_sizes(kdtree *tree)
{
    for (size_t i = tree->node_count; i-- > 0;) {
        const kdtree_node *node = &tree->nodes[i];
        size_t children = (size_t)(kdtree_children(tree, node) - tree->nodes);
        tree->sizes[i] = 1;
        if (i != 1 && !kdtree_is_leaf(node))
            tree->sizes[i] += tree->sizes[children] + tree->sizes[children + 1];
    }
    tree->sizes[1] = 0;
}

base_status kdtree_tally(kdtree *tree, const kdtree_options *options, const char *what, base_error *err)
{
    walk w = {.tree = tree, .options = options};
    const char *wrong = walk_all(&w);
    if (wrong)
        return base_fail(err, BASE_ERR_INPUT, what, "%s", wrong);
    tree->sizes = aligned_alloc(64, (tree->node_count * sizeof *tree->sizes + 63) / 64 * 64);
    if (!tree->sizes)
        return base_fail(err, BASE_ERR_NOMEM, "kd-tree", "out of memory");
    fill_sizes(tree);
    tree->inner_count = w.pairs;
    tree->leaf_count = w.pairs + 1;
    const kdtree_cell root = {{tree->min[0], tree->min[1], tree->min[2]}, {tree->max[0], tree->max[1], tree->max[2]}};
    tree->sah_cost = tree->record_count ? w.cost / kdtree_cell_half_area(&root) : 0.0;
    return BASE_OK;
}
