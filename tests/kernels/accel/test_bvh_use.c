/* What a tree is for: closest hits found through it equal those of brute force, and it is cheaper than a tree of
   median splits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/bvh.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/single_ray.h"
#include "tests/kernels/accel/soup.h"

/* Closed slabs, widened by far more than the rounding of test_triangle. */
static int meets_box(const single_ray *r, const bvh_node *node)
{
    double in = 0.0, out = HUGE_VAL;
    for (int a = 0; a < 3; a++) {
        double low = (double)node->min[a], high = (double)node->max[a];
        double pad = 1e-9 * (fabs(low) + fabs(high) + fabs(r->o[a]));
        double x = (low - pad - r->o[a]) / r->d[a], y = (high + pad - r->o[a]) / r->d[a];
        in = fmax(in, fmin(x, y));
        out = fmin(out, fmax(x, y));
    }
    return in <= out * (1 + 1e-9);
}

static single_hit traverse(const bvh *tree, const single_ray *r, size_t *tests)
{
    const char *nodes = (const char *)tree->nodes, *records = (const char *)tree->records;
    const bvh_node *stack[BVH_MAX_DEPTH + 1];
    size_t used = 0;
    single_hit h = {HUGE_VAL, SINGLE_NO_HIT};
    stack[used++] = tree->nodes;
    while (used > 0) {
        const bvh_node *node = stack[--used];
        if (!meets_box(r, node))
            continue;
        if (node->count == 0) {
            const bvh_node *pair = (const bvh_node *)(nodes + node->link);
            assert_true(used + 2 <= BVH_MAX_DEPTH + 1);
            stack[used++] = pair + 1;
            stack[used++] = pair;
            continue;
        }
        const bvh_triangle *record = (const bvh_triangle *)(records + node->link);
        for (uint32_t i = 0; i < node->count; i++, record++) {
            single_ray_record(r, record, &h);
            ++*tests;
        }
    }
    return h;
}

/* Shoot rays across a scene; at least one in `one_in` must hit something. The scene is freed. */
static void compare_hits(scene s, double reach, size_t one_in)
{
    enum { RAYS = 400 };
    bvh_options options = bvh_options_default();
    bvh *tree = NULL;
    base_random random = {99};
    size_t hits = 0, tests = 0;
    assert_int_equal(bvh_build(&s, &options, &tree, NULL), BASE_OK);
    for (int i = 0; i < RAYS; i++) {
        single_ray r;
        for (int a = 0; a < 3; a++) {
            r.o[a] = base_random_range(&random, -reach, reach);
            r.d[a] = base_random_range(&random, -reach, reach) - r.o[a];
        }
        single_hit expected = single_ray_brute_force(&s, &r), found = traverse(tree, &r, &tests);
        assert_int_equal(found.id, expected.id);
        assert_true(found.t == expected.t);
        hits += found.id != SINGLE_NO_HIT;
    }
    assert_true(hits * one_in >= RAYS);
    assert_true(tests < (size_t)RAYS * s.triangle_count / 4);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void bvh_use__random_triangles__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_random(1, 3000, 0.1), 1.5, 4);
    compare_hits(soup_random(2, 500, 0.5), 1.5, 4);
}

static void bvh_use__clusters__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_clustered(3, 5000), 12.0, 10);
}

static void bvh_use__coplanar_overlaps__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_coplanar(4, 3000), 1.5, 20);
}

static void bvh_use__degenerate_among_others__hits_of_brute_force(void **state)
{
    (void)state;
    compare_hits(soup_degenerate(5, 2000, 3), 1.5, 4);
}

static void bvh_use__far_from_the_origin__hits_of_brute_force(void **state)
{
    (void)state;
    scene s = soup_placed(6, 2000, 16.0f, 4096.0f);
    bvh_options options = bvh_options_default();
    bvh *tree = NULL;
    base_random random = {7};
    size_t hits = 0, tests = 0;
    assert_int_equal(bvh_build(&s, &options, &tree, NULL), BASE_OK);
    for (int i = 0; i < 400; i++) {
        single_ray r;
        for (int a = 0; a < 3; a++) {
            r.o[a] = base_random_range(&random, 4076.0, 4116.0);
            r.d[a] = base_random_range(&random, 4084.0, 4108.0) - r.o[a];
        }
        single_hit expected = single_ray_brute_force(&s, &r), found = traverse(tree, &r, &tests);
        assert_int_equal(found.id, expected.id);
        hits += found.id != SINGLE_NO_HIT;
    }
    assert_true(hits > 100);
    bvh_destroy(&tree);
    soup_free(&s);
}

/* ---- cost against median splits ---- */

typedef struct item {
    double low[3], high[3], key;
} item;

static int item_compare(const void *a, const void *b)
{
    double x = ((const item *)a)->key, y = ((const item *)b)->key;
    return (x > y) - (x < y);
}

static double items_half_area(const item *items, size_t count, int *longest)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, size[3];
    *longest = 0;
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < count; i++) {
            low[a] = fmin(low[a], items[i].low[a]);
            high[a] = fmax(high[a], items[i].high[a]);
        }
        size[a] = high[a] - low[a];
        *longest = size[a] > size[*longest] ? a : *longest;
    }
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/* Unnormalised cost of the tree that halves the list along its box's longest side. */
static double median_cost(item *items, size_t count, unsigned max_leaf)
{
    int axis;
    double area = items_half_area(items, count, &axis);
    if (count <= max_leaf)
        return area * (double)count;
    for (size_t i = 0; i < count; i++)
        items[i].key = items[i].low[axis] + items[i].high[axis];
    qsort(items, count, sizeof *items, item_compare);
    size_t half = count / 2;
    return area + median_cost(items, half, max_leaf) + median_cost(items + half, count - half, max_leaf);
}

static void bvh_use__clusters__cheaper_than_median_splits(void **state)
{
    static const unsigned leaves[] = {1, 4, 16};
    (void)state;
    scene s = soup_clustered(8, 5000);
    item *items = calloc(s.triangle_count, sizeof *items);
    assert_non_null(items);
    for (size_t i = 0; i < s.triangle_count; i++)
        for (int a = 0; a < 3; a++) {
            float(*v)[3] = s.triangles[i].v;
            items[i].low[a] = (double)fminf(v[0][a], fminf(v[1][a], v[2][a]));
            items[i].high[a] = (double)fmaxf(v[0][a], fmaxf(v[1][a], v[2][a]));
        }
    for (size_t l = 0; l < sizeof leaves / sizeof *leaves; l++) {
        bvh_options options = bvh_options_default();
        bvh *tree = NULL;
        int axis;
        options.max_leaf = leaves[l];
        assert_int_equal(bvh_build(&s, &options, &tree, NULL), BASE_OK);
        double area = items_half_area(items, s.triangle_count, &axis);
        double median = median_cost(items, s.triangle_count, leaves[l]) / area;
        assert_true(tree->sah_cost < 0.8 * median);
        bvh_destroy(&tree);
    }
    free(items);
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bvh_use__random_triangles__hits_of_brute_force),
        cmocka_unit_test(bvh_use__clusters__hits_of_brute_force),
        cmocka_unit_test(bvh_use__coplanar_overlaps__hits_of_brute_force),
        cmocka_unit_test(bvh_use__degenerate_among_others__hits_of_brute_force),
        cmocka_unit_test(bvh_use__far_from_the_origin__hits_of_brute_force),
        cmocka_unit_test(bvh_use__clusters__cheaper_than_median_splits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
