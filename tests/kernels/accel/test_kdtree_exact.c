/* Leaves cover exactly: the parts of a triangle in the leaves that list it add up to the triangle, in rational arithmetic.
 *
 * Closed cells overlap in planes alone, and a triangle in a plane is in a list on one side only. So the areas of the parts,
 * projected along an axis that the triangle does not contain, add up to the triangle's own if nothing is lost, and to less
 * if any leaf whose open cell the triangle meets fails to list it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/box.h"
#include "kernels/accel/kdtree.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/kdtree_check.h"
#include "tests/kernels/accel/soup.h"
#include "exact/clip.h"

typedef struct sums {
    const scene *scene;
    mpq_t *area;  /* by triangle: twice that of its parts so far */
    int *axis;    /* by triangle: along which it is projected */
    double slack; /* a listed triangle must come this close to its cell */
    size_t entries;
} sums;

static void add_leaf(void *user, const kdtree *tree, const kdtree_leaf *leaf)
{
    sums *s = user;
    double min[3], max[3], wide_min[3], wide_max[3];
    mpq_t area;
    mpq_init(area);
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = (double)leaf->min[axis];
        max[axis] = (double)leaf->max[axis];
        wide_min[axis] = min[axis] - s->slack;
        wide_max[axis] = max[axis] + s->slack;
    }
    for (size_t i = 0; i < kdtree_leaf_count(leaf->node); i++) {
        uint32_t id = kdtree_leaf_id(tree, leaf->node, i);
        const float(*v)[3] = (const float(*)[3])s->scene->triangles[id].v;
        if (s->slack > 0.0)
            assert_true(exact_clip(v, wide_min, wide_max, s->axis[id], area) > 0);
        exact_clip(v, min, max, s->axis[id], area);
        mpq_add(s->area[id], s->area[id], area);
        s->entries++;
    }
    mpq_clear(area);
}

static int largest_axis(const scene_triangle *t)
{
    double n[3];
    accel_triangle_normal(t, n);
    int axis = fabs(n[1]) > fabs(n[0]) ? 1 : 0;
    return fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
}

static size_t check_tree(const scene *s, const kdtree_options *options)
{
    const double everywhere[3] = {1e30, 1e30, 1e30}, nowhere[3] = {-1e30, -1e30, -1e30};
    sums sum = {.scene = s, .area = malloc(s->triangle_count * sizeof *sum.area), .axis = malloc(s->triangle_count * sizeof *sum.axis)};
    kdtree *tree = NULL;
    mpq_t whole;
    mpq_init(whole);
    assert_true(sum.area && sum.axis);
    assert_int_equal(kdtree_build(s, options, &tree, NULL), BASE_OK);
    for (size_t i = 0; i < s->triangle_count; i++) {
        mpq_init(sum.area[i]);
        sum.axis[i] = largest_axis(&s->triangles[i]);
    }
    double scale = 0.0;
    for (int axis = 0; axis < 3; axis++)
        scale = fmax(scale, fmax(fabs((double)tree->min[axis]), fabs((double)tree->max[axis])));
    sum.slack = options->perfect_splits ? scale * 0x1p-41 : 0.0;
    kdtree_each_leaf(tree, add_leaf, &sum);
    assert_int_equal(sum.entries, tree->list_count);
    for (size_t i = 0; i < s->triangle_count; i++) {
        exact_clip((const float(*)[3])s->triangles[i].v, nowhere, everywhere, sum.axis[i], whole);
        if (!accel_triangle_is_degenerate(&s->triangles[i]))
            assert_true(mpq_equal(sum.area[i], whole));
        mpq_clear(sum.area[i]);
    }
    mpq_clear(whole);
    free(sum.area);
    free(sum.axis);
    kdtree_destroy(&tree);
    return sum.entries;
}

/* With each rule off and on: parts are to be `parts` times as many as triangles, or more. The scene is freed. */
static void check_soup(scene s, size_t parts)
{
    size_t entries = 0;
    for (int i = 0; i < 5; i++) {
        kdtree_options options = kdtree_options_default();
        options.min_area = i == 0 ? 1000 : 0;
        options.traversal_cost = i == 0 ? 1.0f : 0.0f; /* as many cells as there can be */
        options.covered_planes = i != 2;
        options.empty_percent = i == 3 ? 100 : 10;
        options.perfect_splits = i != 4;
        options.empty_occluders = 0;
        entries += check_tree(&s, &options);
    }
    assert_true(entries >= parts * 5 * s.triangle_count);
    soup_free(&s);
}

static void exact__random_triangles__nothing_is_lost(void **state)
{
    (void)state;
    check_soup(soup_random(1, 60, 0.5), 4);
    check_soup(soup_random(2, 300, 0.3), 2);
}

static void exact__clusters_needles_and_lines__nothing_is_lost(void **state)
{
    (void)state;
    check_soup(soup_clustered(3, 500), 1);
    check_soup(soup_needles(4, 20), 2);
    check_soup(soup_collinear(100), 1);
}

static void exact__in_one_plane_or_equal__nothing_is_lost(void **state)
{
    (void)state;
    check_soup(soup_coplanar(5, 80), 2);
    check_soup(soup_identical(20), 1);
    check_soup(soup_degenerate(6, 60, 4), 0);
}

static void exact__large_coordinates_and_tiny_triangles__nothing_is_lost(void **state)
{
    (void)state;
    check_soup(soup_placed(7, 60, 300.0f, 1e7f), 1);
    check_soup(soup_placed(8, 60, 1e7f, 0.0f), 1);
    check_soup(soup_placed(9, 60, 1e-20f, 0.0f), 1);
    check_soup(soup_telescope(1), 1);
}

/* Corners on a grid: planes shared by many, triangles along them, edges and vertices in planes. */
static void exact__on_a_grid__nothing_is_lost(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        scene s = soup_create("grid", 60);
        base_random random = {seed};
        for (size_t i = 0; i < s.triangle_count; i++)
            for (int k = 0; k < 9; k++)
                s.triangles[i].v[k / 3][k % 3] = (float)(base_random_bits(&random) % (seed + 3));
        check_soup(s, 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact__random_triangles__nothing_is_lost),
        cmocka_unit_test(exact__clusters_needles_and_lines__nothing_is_lost),
        cmocka_unit_test(exact__in_one_plane_or_equal__nothing_is_lost),
        cmocka_unit_test(exact__large_coordinates_and_tiny_triangles__nothing_is_lost),
        cmocka_unit_test(exact__on_a_grid__nothing_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
