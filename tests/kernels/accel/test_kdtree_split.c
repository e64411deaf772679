/* The rules that cut cells, one by one: covered planes (C7), empty space (C8), the cheapest plane against trying all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/kdtree.h"
#include "kernels/accel/kdtree_cover.h"
#include "kernels/accel/kdtree_split.h"
#include "lrbni/base/random.h"
#include "tests/kernels/accel/kdtree_check.h"
#include "tests/kernels/accel/soup.h"

/* ---- covering ---- */

enum { MOST = 4096 };

typedef struct patches {
    kdtree_flat_triangle triangles[MOST];
    size_t count;
} patches;

static void add_triangle(patches *p, double ax, double ay, double bx, double by, double cx, double cy)
{
    assert_true(p->count < MOST);
    p->triangles[p->count++] = (kdtree_flat_triangle){{{ax, ay}, {bx, by}, {cx, cy}}};
}

/* Cut a rectangle at random until it is small, then in two triangles: edges meet in T-junctions everywhere. */
static void tessellate(patches *p, base_random *random, double x0, double y0, double x1, double y1, int depth)
{
    if (depth == 0) {
        add_triangle(p, x0, y0, x1, y0, x1, y1);
        add_triangle(p, x0, y1, x0, y0, x1, y1); /* wound the other way */
        return;
    }
    double share = base_random_range(random, 0.3, 0.7);
    if (x1 - x0 > y1 - y0) {
        double x = x0 + share * (x1 - x0);
        tessellate(p, random, x0, y0, x, y1, depth - 1);
        tessellate(p, random, x, y0, x1, y1, depth - 1);
    } else {
        double y = y0 + share * (y1 - y0);
        tessellate(p, random, x0, y0, x1, y, depth - 1);
        tessellate(p, random, x0, y, x1, y1, depth - 1);
    }
}

static bool covers(const patches *p, double x0, double y0, double x1, double y1)
{
    const kdtree_rectangle r = {{x0, y0}, {x1, y1}};
    bool covered = false;
    assert_int_equal(kdtree_cover(&r, p->triangles, p->count, &covered, NULL), BASE_OK);
    return covered;
}

static void cover__tessellated_rectangles__covered_until_a_triangle_is_missing(void **state)
{
    static patches p;
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        base_random random = {seed};
        p.count = 0;
        tessellate(&p, &random, -1.0, -2.0, 3.0, 1.0, (int)seed > 10 ? 10 : (int)seed);
        assert_true(covers(&p, -1.0, -2.0, 3.0, 1.0));
        assert_true(covers(&p, -0.3, -1.1, 0.7, 0.9)); /* part of it */
        assert_false(covers(&p, -1.0, -2.0, 3.0, 1.001));
        for (int i = 0; i < 20; i++) {
            size_t hole = base_random_bits(&random) % p.count;
            kdtree_flat_triangle kept = p.triangles[hole];
            p.triangles[hole] = p.triangles[--p.count];
            assert_false(covers(&p, -1.0, -2.0, 3.0, 1.0));
            p.triangles[p.count++] = p.triangles[hole];
            p.triangles[hole] = kept;
        }
    }
}

static void cover__overlaps__union_decides_not_sum(void **state)
{
    static patches p;
    (void)state;
    p.count = 0;
    for (int i = 0; i < 50; i++)
        add_triangle(&p, 0, 0, 1, 0, 1, 1);
    assert_false(covers(&p, 0, 0, 1, 1)); /* the same half fifty times */
    add_triangle(&p, 0, 0, 1.5, 1.5, -1, 3);
    assert_true(covers(&p, 0, 0, 1, 1));
    p.count = 0;
    add_triangle(&p, -1, -1, 3, -1, -1, 3); /* one that covers it all */
    assert_true(covers(&p, 0, 0, 1, 1));
    assert_false(covers(&p, 0, 0, 1, 1.01));
    p.count = 0;
    assert_false(covers(&p, 0, 0, 1, 1));
}

static void cover__gaps__a_millionth_of_the_area_is_allowed(void **state)
{
    static patches p;
    (void)state;
    for (int i = 0; i < 2; i++) {
        double gap = i == 0 ? 0.9e-6 : 1.1e-6;
        p.count = 0;
        add_triangle(&p, 0, 0, 1, 0, 1, 1 - gap);
        add_triangle(&p, 0, 0, 1, 1 - gap, 0, 1 - gap);
        assert_int_equal(covers(&p, 0, 0, 1, 1), i == 0);
    }
}

static void cover__many_slivers_through_one_point__ends(void **state)
{
    static patches p;
    (void)state;
    p.count = 0;
    for (int i = 0; i < 2000; i++) {
        double a = i * 6.28318530718 / 2000, b = (i + 1) * 6.28318530718 / 2000;
        add_triangle(&p, 0, 0, 3 * cos(a), 3 * sin(a), 3 * cos(b), 3 * sin(b));
    }
    assert_true(covers(&p, 0.1, 0.1, 1, 1));
    covers(&p, -1, -1, 1, 1); /* either answer: the fan's centre may take too many pieces */
}

/* ---- rules 1 and 3 ---- */

static kdtree_ref box_ref(float x0, float y0, float z0, float x1, float y1, float z1)
{
    return (kdtree_ref){.box = {{x0, y0, z0}, {x1, y1, z1}}};
}

static void empty__gap_of_just_the_limit__stays(void **state)
{
    const kdtree_rules rules = {.empty_share = 0.25};
    const kdtree_cell cell = {{0, 0, 0}, {4, 4, 4}};
    const kdtree_cell fits = {{1, 1, 1}, {3, 3, 3}}, less = {{1, 1, 1}, {3, 3, 2.5f}}, flat = {{0, 0, 0}, {4, 4, 0}};
    (void)state;
    assert_int_equal(kdtree_split_empty(&rules, &cell, &fits).axis, -1);
    kdtree_split split = kdtree_split_empty(&rules, &cell, &less);
    assert_int_equal(split.axis, 2);
    assert_true(split.plane == 2.5f && !split.flat_above);
    split = kdtree_split_empty(&rules, &flat, &flat);
    assert_int_equal(split.axis, -1);
    split = kdtree_split_empty(&rules, &cell, &flat);
    assert_true(split.axis == 2 && split.plane == 0.0f && !split.flat_above);
    const kdtree_rules off = {.empty_share = 1.0};
    assert_int_equal(kdtree_split_empty(&off, &cell, &flat).axis, -1);
}

/* The cost of a plane by its definition. */
static double cost_at(const kdtree_cell *cell, const kdtree_ref *refs, size_t count, int axis, float plane, double *smaller)
{
    kdtree_cell half[2] = {kdtree_cell_half(cell, axis, plane, 0), kdtree_cell_half(cell, axis, plane, 1)};
    double area[2] = {kdtree_cell_half_area(&half[0]), kdtree_cell_half_area(&half[1])}, cost = 0.0;
    *smaller = fmin(area[0], area[1]);
    for (size_t i = 0; i < count; i++) {
        if (refs[i].box.min[axis] < plane)
            cost += area[0];
        if (refs[i].box.max[axis] > plane)
            cost += area[1];
        if (refs[i].box.min[axis] == plane && refs[i].box.max[axis] == plane)
            cost += *smaller;
    }
    return cost;
}

static void cheapest__random_boxes__none_is_cheaper(void **state)
{
    enum { COUNT = 200 };
    kdtree_ref refs[COUNT];
    kdtree_bounds bounds = {0};
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        base_random random = {seed};
        size_t count = 1 + base_random_bits(&random) % COUNT;
        const kdtree_cell cell = {{-1, 0, 2}, {15, 9, 12}};
        const kdtree_rules rules = {.min_half_area = seed % 3 == 0 ? 0.3 * kdtree_cell_half_area(&cell) : 0.0};
        for (size_t i = 0; i < count; i++)
            for (int axis = 0; axis < 3; axis++) { /* on a grid, so that bounds coincide, in every third scene */
                double a = base_random_range(&random, (double)cell.min[axis], (double)cell.max[axis]);
                double b = base_random_range(&random, a, (double)cell.max[axis]);
                refs[i].box.min[axis] = seed % 3 == 1 ? (float)floor(a) : (float)a;
                refs[i].box.max[axis] = seed % 3 == 1 ? (float)floor(b) : fmaxf((float)b, (float)a);
            }
        assert_int_equal(kdtree_bounds_reserve(&bounds, count, NULL), BASE_OK);
        for (int axis = 0; axis < 3; axis++) {
            double best = HUGE_VAL, smaller;
            kdtree_bounds_sort(&bounds, 0, refs, count, axis);
            kdtree_bounds_sort(&bounds, 1, refs, count, axis);
            kdtree_split split = kdtree_split_cheapest(&rules, &cell, &bounds, count, axis);
            for (size_t i = 0; i < 2 * count; i++) {
                float plane = i % 2 ? refs[i / 2].box.max[axis] : refs[i / 2].box.min[axis];
                double cost = cost_at(&cell, refs, count, axis, plane, &smaller);
                if (plane > cell.min[axis] && plane < cell.max[axis] && smaller >= rules.min_half_area)
                    best = fmin(best, cost);
            }
            if (split.axis < 0) {
                assert_true(best == HUGE_VAL);
                continue;
            }
            assert_true(fabs(split.cost - best) <= 1e-12 * best);
            assert_true(fabs(cost_at(&cell, refs, count, axis, split.plane, &smaller) - best) <= 1e-12 * best);
        }
    }
    kdtree_bounds_free(&bounds);
}

static void best__no_cheaper_than_a_leaf__none(void **state)
{
    const kdtree_rules rules = {.traversal_cost = 1.0};
    const kdtree_cell cell = {{0, 0, 0}, {1, 1, 1}}; /* half area 3 */
    kdtree_split axes[3] = {{.axis = 0, .cost = 3.0}, {.axis = 1, .cost = 2.5}, {.axis = 2, .cost = 2.5}};
    (void)state;
    assert_int_equal(kdtree_split_best(&rules, &cell, axes, 2).axis, 1); /* 2.5 + 3 < 6 */
    axes[1].cost = axes[2].cost = 3.0;
    assert_int_equal(kdtree_split_best(&rules, &cell, axes, 2).axis, -1); /* 3 + 3 = 6 */
}

/* ---- rule 2 ---- */

/* Two triangles of a rectangle across an axis. */
static void put_wall(scene_triangle *t, int axis, float at, float u0, float v0, float u1, float v1)
{
    for (int half = 0; half < 2; half++)
        for (int corner = 0; corner < 3; corner++) {
            int u = half == 0 ? corner > 0 : corner == 1, v = half == 0 ? corner > 1 : corner > 0;
            t[half].v[corner][axis] = at;
            t[half].v[corner][(axis + 1) % 3] = u ? u1 : u0;
            t[half].v[corner][(axis + 2) % 3] = v ? v1 : v0;
        }
}

typedef struct found {
    size_t covered, triangles;
    float at[8];
} found;

static void note_covered(void *user, const kdtree *tree, const kdtree_leaf *leaf)
{
    found *f = user;
    (void)tree;
    if (!(leaf->node->extent & KDTREE_COVERED))
        return;
    assert_true(f->covered < 8);
    for (int axis = 0; axis < 3; axis++)
        if (leaf->min[axis] == leaf->max[axis])
            f->at[f->covered] = leaf->min[axis];
    f->triangles += kdtree_leaf_count(leaf->node);
    f->covered++;
}

static found covered_of(const scene *s)
{
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    found f = {0};
    options.empty_percent = 100;
    assert_int_equal(kdtree_build(s, &options, &tree, NULL), BASE_OK);
    kdtree_check(s, tree, &options);
    kdtree_each_leaf(tree, note_covered, &f);
    kdtree_destroy(&tree);
    return f;
}

/* A wall across a cube that slanted triangles at both ends span; the cube is [0,4]^3. */
static scene walled(size_t walls, int axis)
{
    scene s = soup_create("walled", 4 + 2 * walls);
    static const float ends[4][3][3] = {{{0, 0, 0}, {4, 0.5f, 0}, {0, 0.25f, 4}}, {{4, 0, 4}, {4, 0.5f, 0}, {0, 0.25f, 4}},
                                        {{0, 4, 0}, {4, 3.5f, 0}, {0, 3.75f, 4}}, {{4, 4, 4}, {4, 3.5f, 0}, {0, 3.75f, 4}}};
    for (int i = 0; i < 4; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 3; k++) /* the ends are across y: turn that to the axis */
                s.triangles[i].v[corner][(k + axis + 2) % 3] = ends[i][corner][k];
    return s;
}

static void planes__wall_across__flat_cell_of_its_two_triangles(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        scene s = walled(1, axis);
        put_wall(&s.triangles[4], axis, 1.5f, 0, 0, 4, 4);
        found f = covered_of(&s);
        assert_int_equal(f.covered, 1);
        assert_int_equal(f.triangles, 2);
        assert_true(f.at[0] == 1.5f);
        soup_free(&s);
    }
}

static void planes__two_halves_of_a_wall_with_overlap__covered(void **state)
{
    (void)state;
    scene s = walled(2, 0);
    put_wall(&s.triangles[4], 0, 1.5f, 0, 0, 3, 4);
    put_wall(&s.triangles[6], 0, 1.5f, 2, 0, 4, 4);
    found f = covered_of(&s);
    assert_in_range(f.covered, 1, 8);
    assert_in_range(f.triangles, 4, 16);
    soup_free(&s);
}

static void planes__wall_with_a_hole_or_two_on_one_side__not_covered(void **state)
{
    (void)state;
    scene s = walled(2, 1);
    put_wall(&s.triangles[4], 1, 1.5f, 0, 0, 3, 4); /* 3/4 of the section, twice */
    put_wall(&s.triangles[6], 1, 1.5f, 0, 0, 3, 4);
    kdtree_split split;
    kdtree_bounds bounds = {0};
    kdtree_ref refs[8];
    kdtree_cell cell = {{0, 0, 0}, {4, 4, 4}};
    for (uint32_t i = 0; i < 8; i++) {
        refs[i] = box_ref(0, 0, 0, 4, 4, 4);
        refs[i].id = i;
        if (i >= 4)
            refs[i].box = (kdtree_cell){{0, 1.5f, 0}, {4, 1.5f, 3}};
    }
    const kdtree_rules rules = {.triangles = s.triangles, .covered_planes = true};
    assert_int_equal(kdtree_split_covered(&rules, &cell, refs, 8, &bounds, &split, NULL), BASE_OK);
    assert_int_equal(split.axis, -1);
    put_wall(&s.triangles[6], 1, 1.5f, 3, 0, 4, 4); /* the rest of it */
    refs[6].box = refs[7].box = (kdtree_cell){{0, 1.5f, 3}, {4, 1.5f, 4}};
    assert_int_equal(kdtree_split_covered(&rules, &cell, refs, 8, &bounds, &split, NULL), BASE_OK);
    assert_true(split.axis == 1 && split.plane == 1.5f && !split.flat_above);
    const kdtree_rules off = {.triangles = s.triangles, .covered_planes = false};
    assert_int_equal(kdtree_split_covered(&off, &cell, refs, 8, &bounds, &split, NULL), BASE_OK);
    assert_int_equal(split.axis, -1);
    kdtree_bounds_free(&bounds);
    soup_free(&s);
}

static void planes__on_a_face__flat_child_takes_them(void **state)
{
    (void)state;
    for (int side = 0; side < 2; side++) {
        scene s = soup_create("face", 3);
        put_wall(s.triangles, 2, side ? 4.0f : 0.0f, 0, 0, 4, 4);
        kdtree_ref refs[3] = {box_ref(0, 0, 0, 4, 4, 0), box_ref(0, 0, 0, 4, 4, 0), box_ref(0, 0, 1, 4, 4, 3)};
        for (uint32_t i = 0; i < 3; i++) {
            refs[i].id = i;
            if (i < 2)
                refs[i].box.min[2] = refs[i].box.max[2] = side ? 4.0f : 0.0f;
        }
        const kdtree_cell cell = {{0, 0, 0}, {4, 4, 4}};
        const kdtree_rules rules = {.triangles = s.triangles, .covered_planes = true};
        kdtree_split split;
        kdtree_bounds bounds = {0};
        kdtree_ref below[3], above[3];
        size_t counts[2];
        assert_int_equal(kdtree_split_covered(&rules, &cell, refs, 3, &bounds, &split, NULL), BASE_OK);
        assert_true(split.axis == 2 && split.plane == (side ? 4.0f : 0.0f));
        kdtree_refs_divide(&rules, &cell, &split, refs, 3, below, above, counts);
        assert_int_equal(counts[side], 2);
        assert_int_equal(counts[1 - side], 1);
        kdtree_bounds_free(&bounds);
        soup_free(&s);
    }
}

/* Every plane is covered: each is weighed at each level, in little more than constant time. */
static void planes__stack_of_sheets__each_in_a_flat_cell(void **state)
{
    enum { SHEETS = 20000 };
    scene s = soup_create("stack", 2 * SHEETS);
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    (void)state;
    options.min_area = 0;
    for (int i = 0; i < SHEETS; i++)
        put_wall(&s.triangles[2 * i], 1, (float)i / 1024.0f, 0, 0, 4, 4);
    assert_int_equal(kdtree_build(&s, &options, &tree, NULL), BASE_OK);
    kdtree_check(&s, tree, &options);
    assert_int_equal(tree->covered_count, SHEETS);
    assert_int_equal(tree->list_count, 2 * SHEETS);
    assert_in_range(tree->depth, 14, 48);
    kdtree_destroy(&tree);
    soup_free(&s);
}

static void planes__all_in_one__the_root_is_flat(void **state)
{
    scene s = soup_create("flat", 2);
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    (void)state;
    put_wall(s.triangles, 1, 0.25f, -1, -1, 1, 1);
    assert_int_equal(kdtree_build(&s, &options, &tree, NULL), BASE_OK);
    assert_int_equal(tree->node_count, 2);
    assert_int_equal(tree->covered_count, 1);
    assert_int_equal(kdtree_leaf_count(tree->nodes), 2);
    kdtree_check(&s, tree, &options);
    kdtree_destroy(&tree);
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cover__tessellated_rectangles__covered_until_a_triangle_is_missing),
        cmocka_unit_test(cover__overlaps__union_decides_not_sum),
        cmocka_unit_test(cover__gaps__a_millionth_of_the_area_is_allowed),
        cmocka_unit_test(cover__many_slivers_through_one_point__ends),
        cmocka_unit_test(empty__gap_of_just_the_limit__stays),
        cmocka_unit_test(cheapest__random_boxes__none_is_cheaper),
        cmocka_unit_test(best__no_cheaper_than_a_leaf__none),
        cmocka_unit_test(planes__wall_across__flat_cell_of_its_two_triangles),
        cmocka_unit_test(planes__two_halves_of_a_wall_with_overlap__covered),
        cmocka_unit_test(planes__wall_with_a_hole_or_two_on_one_side__not_covered),
        cmocka_unit_test(planes__on_a_face__flat_child_takes_them),
        cmocka_unit_test(planes__stack_of_sheets__each_in_a_flat_cell),
        cmocka_unit_test(planes__all_in_one__the_root_is_flat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
