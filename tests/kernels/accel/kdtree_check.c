#include "tests/kernels/accel/kdtree_check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/box.h"
#include "lrbni/base/hash.h"

typedef struct walk {
    const scene *scene;
    const kdtree *tree;
    const kdtree_options *options;
    size_t pairs, entries, records, leaves, empty, flat, covered, enclosed;
    unsigned depth;
    double cost;
} walk;

static double half_area(const kdtree_leaf *cell)
{
    double x = (double)cell->max[0] - (double)cell->min[0], y = (double)cell->max[1] - (double)cell->min[1],
           z = (double)cell->max[2] - (double)cell->min[2];
    return x * y + y * z + z * x;
}

static kdtree_leaf root_of(const kdtree *tree)
{
    kdtree_leaf cell = {.node = tree->nodes};
    memcpy(cell.min, tree->min, sizeof cell.min);
    memcpy(cell.max, tree->max, sizeof cell.max);
    return cell;
}

static kdtree_leaf child_of(const kdtree *tree, const kdtree_leaf *cell, int side)
{
    kdtree_leaf child = *cell;
    int axis = (int)(cell->node->link & KDTREE_KIND);
    child.node = kdtree_children(tree, cell->node) + side;
    child.depth++;
    if (side == 0)
        child.max[axis] = cell->node->split;
    else
        child.min[axis] = cell->node->split;
    return child;
}

static void each_leaf(const kdtree *tree, const kdtree_leaf *cell, kdtree_leaf_fn *fn, void *user)
{
    if (kdtree_is_leaf(cell->node)) {
        fn(user, tree, cell);
        return;
    }
    for (int side = 0; side < 2; side++) {
        kdtree_leaf child = child_of(tree, cell, side);
        each_leaf(tree, &child, fn, user);
    }
}

void kdtree_each_leaf(const kdtree *tree, kdtree_leaf_fn *fn, void *user)
{
    kdtree_leaf root = root_of(tree);
    each_leaf(tree, &root, fn, user);
}

uint32_t kdtree_leaf_id(const kdtree *tree, const kdtree_node *leaf, size_t i)
{
    return tree->records[kdtree_leaf_list(tree, leaf)[i] / sizeof(bvh_triangle)].id;
}

static int flat_axes(const kdtree_leaf *cell)
{
    int axes = 0;
    for (int axis = 0; axis < 3; axis++)
        axes += cell->min[axis] == cell->max[axis];
    return axes;
}

static void check_flags(walk *w, const kdtree_leaf *leaf)
{
    const kdtree_node *node = leaf->node;
    size_t count = kdtree_leaf_count(node);
    uint32_t set = node->link / 4;
    if (node->extent & KDTREE_OCCLUDER)
        assert_true(count == 0 && set > 0);
    if (node->extent & KDTREE_COVERED)
        assert_true(count > 0 && flat_axes(leaf) == 1);
    if (count == 0) {
        assert_true(set < w->tree->set_count);
        assert_true(set == 0 || flat_axes(leaf) == 0);
        w->enclosed += set > 0;
    }
    w->empty += count == 0;
    w->flat += flat_axes(leaf) > 0;
    w->covered += (node->extent & KDTREE_COVERED) != 0;
}

static void check_record(walk *w, size_t record)
{
    const bvh_triangle *found = &w->tree->records[record];
    assert_true(found->id < w->scene->triangle_count);
    bvh_triangle made = bvh_triangle_create(&w->scene->triangles[found->id], found->id);
    assert_memory_equal(found, &made, sizeof made);
}

static void check_leaf(walk *w, const kdtree_leaf *leaf)
{
    size_t count = kdtree_leaf_count(leaf->node);
    check_flags(w, leaf);
    if (count > 0)
        assert_int_equal(leaf->node->link, 4 * w->entries + KDTREE_LEAF);
    for (size_t i = 0; i < count; i++, w->entries++) {
        assert_true(w->entries < w->tree->list_count);
        uint32_t offset = w->tree->lists[w->entries];
        size_t record = offset / sizeof(bvh_triangle);
        assert_int_equal(offset % sizeof(bvh_triangle), 0);
        assert_true(record <= w->records && record < w->tree->record_count);
        if (record == w->records) {
            check_record(w, record);
            w->records++;
        }
        assert_true(i == 0 || kdtree_leaf_id(w->tree, leaf->node, i - 1) < kdtree_leaf_id(w->tree, leaf->node, i));
    }
    w->leaves++;
    w->cost += half_area(leaf) * (double)count;
}

/* Returns the size of the subtree. */
static uint32_t check_node(walk *w, const kdtree_leaf *cell)
{
    uint32_t size = 1;
    assert_true(cell->depth <= w->options->max_depth);
    w->depth = cell->depth > w->depth ? cell->depth : w->depth;
    if (kdtree_is_leaf(cell->node)) {
        check_leaf(w, cell);
    } else {
        uint32_t axis = cell->node->link & KDTREE_KIND;
        w->pairs++;
        assert_int_equal(cell->node->link - axis, w->pairs * 16);
        assert_true(2 * w->pairs + 1 < w->tree->node_count);
        assert_true(cell->node->split >= cell->min[axis] && cell->node->split <= cell->max[axis]);
        assert_false(cell->node->split == 0.0f && signbit(cell->node->split));
        w->cost += half_area(cell) * (double)w->options->traversal_cost;
        for (int side = 0; side < 2; side++) {
            kdtree_leaf child = child_of(w->tree, cell, side);
            size += check_node(w, &child);
        }
    }
    assert_int_equal(w->tree->sizes[cell->node - w->tree->nodes], size);
    return size;
}

static void check_totals(const walk *w)
{
    const kdtree *tree = w->tree;
    assert_int_equal(w->pairs, tree->inner_count);
    assert_int_equal(w->leaves, tree->leaf_count);
    assert_int_equal(tree->node_count, 2 * (w->pairs + 1));
    assert_int_equal(w->entries, tree->list_count);
    assert_int_equal(w->records, tree->record_count);
    assert_int_equal(w->empty, tree->empty_count);
    assert_int_equal(w->flat, tree->flat_count);
    assert_int_equal(w->covered, tree->covered_count);
    assert_int_equal(w->enclosed, tree->enclosed_count);
    assert_int_equal(w->depth, tree->depth);
}

/* The root's box is that of all triangles that are kept, and each of those has a record. */
static void check_triangles(const walk *w)
{
    const kdtree *tree = w->tree;
    const scene *s = w->scene;
    float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
    size_t kept = 0;
    unsigned char *found = calloc(s->triangle_count + 1, 1);
    assert_non_null(found);
    for (size_t i = 0; i < tree->record_count; i++)
        assert_int_equal(found[tree->records[i].id]++, 0);
    for (size_t i = 0; i < s->triangle_count; i++) {
        int degenerate = accel_triangle_is_degenerate(&s->triangles[i]);
        assert_int_equal(found[i], !degenerate);
        for (int corner = 0; !degenerate && corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++) {
                min[axis] = fminf(min[axis], s->triangles[i].v[corner][axis] + 0.0f);
                max[axis] = fmaxf(max[axis], s->triangles[i].v[corner][axis] + 0.0f);
            }
        kept += !degenerate;
    }
    free(found);
    assert_int_equal(tree->degenerate_count, s->triangle_count - kept);
    assert_true(min[0] == tree->min[0] && min[1] == tree->min[1] && min[2] == tree->min[2]);
    assert_true(max[0] == tree->max[0] && max[1] == tree->max[1] && max[2] == tree->max[2]);
}

static void check_sets(const kdtree *tree)
{
    size_t members = 0;
    assert_true(tree->set_count >= 1);
    assert_int_equal(tree->sets[0].count, 0);
    for (size_t i = 0; i < tree->set_count; i++) {
        const kdtree_set *set = &tree->sets[i];
        assert_true(i == 0 || set->count > 0);
        assert_int_equal(set->first, members);
        members += set->count;
        assert_true(members <= tree->member_count);
        for (uint32_t k = 1; k < set->count; k++)
            assert_true(tree->members[set->first + k - 1] < tree->members[set->first + k]);
    }
    assert_int_equal(members, tree->member_count);
}

void kdtree_check(const scene *s, const kdtree *tree, const kdtree_options *options)
{
    static const kdtree_node zero;
    walk w = {.scene = s, .tree = tree, .options = options};
    kdtree_leaf root = root_of(tree);
    assert_int_equal((uintptr_t)tree->nodes % 64, 0);
    assert_int_equal((uintptr_t)tree->lists % 64, 0);
    assert_int_equal((uintptr_t)tree->records % 64, 0);
    assert_memory_equal(&tree->nodes[1], &zero, sizeof zero);
    assert_int_equal(tree->sizes[1], 0);
    check_sets(tree);
    check_node(&w, &root);
    check_totals(&w);
    check_triangles(&w);
    double cost = tree->record_count ? w.cost / half_area(&root) : 0.0;
    assert_true(fabs(cost - tree->sah_cost) <= 1e-9 * cost);
}

uint64_t kdtree_check_hash(const kdtree *tree)
{
    uint64_t hash = base_hash(BASE_HASH_START, tree->nodes, tree->node_count * sizeof *tree->nodes);
    hash = base_hash(hash, tree->lists, tree->list_count * sizeof *tree->lists);
    hash = base_hash(hash, tree->records, tree->record_count * sizeof *tree->records);
    hash = base_hash(hash, tree->sizes, tree->node_count * sizeof *tree->sizes);
    hash = base_hash(hash, tree->components, tree->record_count * sizeof *tree->components);
    hash = base_hash(hash, tree->sets, tree->set_count * sizeof *tree->sets);
    hash = base_hash(hash, tree->members, tree->member_count * sizeof *tree->members);
    return base_hash(hash, &tree->sah_cost, sizeof tree->sah_cost);
}
