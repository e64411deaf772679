#include "tests/kernels/accel/bvh_check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "lrbni/base/hash.h"

typedef struct walk {
    const scene *scene;
    const bvh *tree;
    const bvh_options *options;
    unsigned char *seen; /* per triangle */
    size_t pairs, records, leaves;
    unsigned depth;
    double inner_area, leaf_area;
} walk;

static double half_area(const bvh_node *n)
{
    double x = (double)n->max[0] - (double)n->min[0], y = (double)n->max[1] - (double)n->min[1],
           z = (double)n->max[2] - (double)n->min[2];
    return x * y + y * z + z * x;
}

static void box_around(float low[3], float high[3], const float p[3])
{
    for (int axis = 0; axis < 3; axis++) {
        float value = p[axis] == 0.0f ? 0.0f : p[axis]; /* -0 counts as +0 */
        low[axis] = fminf(low[axis], value);
        high[axis] = fmaxf(high[axis], value);
    }
}

static void check_box(const bvh_node *node, const float low[3], const float high[3])
{
    assert_memory_equal(node->min, low, 3 * sizeof(float));
    assert_memory_equal(node->max, high, 3 * sizeof(float));
}

/* Flat or not finite; written apart from the builder, in the widest type there is. */
static int is_degenerate(const scene_triangle *t)
{
    double e[3], f[3];
    for (int axis = 0; axis < 3; axis++) {
        e[axis] = (double)t->v[1][axis] - (double)t->v[0][axis];
        f[axis] = (double)t->v[2][axis] - (double)t->v[0][axis];
        if (!isfinite(e[axis]) || !isfinite(f[axis]))
            return 1;
    }
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        if (e[next] * f[last] != e[last] * f[next])
            return 0;
    }
    return 1;
}

/* The normal's largest component is 1 or -1, and it is perpendicular to the edges as far as floats tell. */
static void check_normal(const bvh_triangle *record, const scene_triangle *t)
{
    double largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmax(largest, fabs((double)record->normal[axis]));
    assert_true(largest == 1.0);
    for (int edge = 1; edge < 3; edge++) {
        double dot = 0, length = 0;
        for (int axis = 0; axis < 3; axis++) {
            double e = (double)t->v[edge][axis] - (double)t->v[0][axis];
            dot += e * (double)record->normal[axis];
            length += fabs(e);
        }
        assert_true(fabs(dot) <= 0x1p-22 * length);
    }
}

static void check_leaf(walk *w, const bvh_node *node)
{
    const float inf = INFINITY;
    float low[3] = {inf, inf, inf}, high[3] = {-inf, -inf, -inf};
    assert_in_range(node->count, 1, w->options->max_leaf);
    assert_int_equal(node->link, w->records * sizeof(bvh_triangle));
    for (size_t i = 0; i < node->count; i++, w->records++) {
        assert_true(w->records < w->tree->record_count);
        const bvh_triangle *record = &w->tree->records[w->records];
        assert_true(record->id < w->scene->triangle_count);
        const scene_triangle *t = &w->scene->triangles[record->id];
        assert_true(i == 0 || record[-1].id < record->id);
        assert_int_equal(w->seen[record->id]++, 0);
        assert_memory_equal(record->v0, t->v[0], 12);
        assert_memory_equal(record->v1, t->v[1], 12);
        assert_memory_equal(record->v2, t->v[2], 12);
        check_normal(record, t);
        assert_int_equal(record->zero1 | record->zero2 | record->zero3, 0);
        for (int corner = 0; corner < 3; corner++)
            box_around(low, high, t->v[corner]);
    }
    check_box(node, low, high);
    w->leaves++;
    w->leaf_area += half_area(node) * node->count;
}

/* Recursion ends: pairs are numbered in the order of the walk, and depth is bounded. */
static void check_node(walk *w, const bvh_node *node, unsigned depth)
{
    assert_true(depth <= BVH_MAX_DEPTH);
    w->depth = depth > w->depth ? depth : w->depth;
    if (node->count != 0) {
        check_leaf(w, node);
        return;
    }
    w->pairs++;
    assert_int_equal(node->link, w->pairs * 64);
    assert_true(2 * w->pairs + 1 < w->tree->node_count);
    const bvh_node *pair = &w->tree->nodes[2 * w->pairs];
    float low[3], high[3];
    memcpy(low, pair[0].min, sizeof low);
    memcpy(high, pair[0].max, sizeof high);
    box_around(low, high, pair[1].min);
    box_around(low, high, pair[1].max);
    check_box(node, low, high);
    w->inner_area += half_area(node);
    check_node(w, &pair[0], depth + 1);
    check_node(w, &pair[1], depth + 1);
}

static void check_empty(const bvh *tree)
{
    const float inf = INFINITY;
    float low[3] = {inf, inf, inf}, high[3] = {-inf, -inf, -inf};
    check_box(&tree->nodes[0], low, high);
    assert_int_equal(tree->nodes[0].link, 0);
    assert_int_equal(tree->nodes[0].count, 0);
    assert_int_equal(tree->node_count, 2);
    assert_int_equal(tree->inner_count, 0);
    assert_int_equal(tree->depth, 0);
    assert_true(tree->sah_cost == 0.0);
}

static void check_totals(const walk *w)
{
    const bvh *tree = w->tree;
    double node = (double)w->options->traversal_cost, test = (double)w->options->intersect_cost;
    double cost = (w->inner_area * node + w->leaf_area * test) / (half_area(&tree->nodes[0]) * test);
    assert_int_equal(w->records, tree->record_count);
    assert_int_equal(w->pairs, tree->inner_count);
    assert_int_equal(w->leaves, tree->leaf_count);
    assert_int_equal(w->depth, tree->depth);
    assert_int_equal(tree->node_count, 2 * (w->pairs + 1));
    assert_true(fabs(cost - tree->sah_cost) <= 1e-9 * cost);
}

void bvh_check(const scene *s, const bvh *tree, const bvh_options *options)
{
    static const bvh_node zero;
    walk w = {.scene = s, .tree = tree, .options = options, .seen = calloc(s->triangle_count + 1, 1)};
    size_t degenerate = 0;
    assert_non_null(w.seen);
    assert_int_equal((uintptr_t)tree->nodes % 64, 0);
    assert_int_equal((uintptr_t)tree->records % 64, 0);
    assert_memory_equal(&tree->nodes[1], &zero, sizeof zero);
    if (tree->record_count == 0)
        check_empty(tree);
    else {
        check_node(&w, &tree->nodes[0], 0);
        check_totals(&w);
    }
    for (size_t i = 0; i < s->triangle_count; i++) {
        int left_out = is_degenerate(&s->triangles[i]);
        assert_int_equal(w.seen[i], !left_out);
        degenerate += (size_t)left_out;
    }
    assert_int_equal(tree->degenerate_count, degenerate);
    free(w.seen);
}

uint64_t bvh_check_hash(const bvh *tree)
{
    uint64_t hash = base_hash(BASE_HASH_START, tree->nodes, tree->node_count * sizeof *tree->nodes);
    return base_hash(hash, tree->records, tree->record_count * sizeof *tree->records);
}
