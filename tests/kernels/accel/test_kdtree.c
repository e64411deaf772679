/* The kd-tree's builder: structure, equal bytes, limits and options (hard cases X6, X7, X15, C1, C7, C8, C15). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/kdtree.h"
#include "scene/scene.h"
#include "tests/kernels/accel/kdtree_check.h"
#include "tests/kernels/accel/soup.h"

static kdtree *build(const scene *s, const kdtree_options *options)
{
    kdtree *tree = NULL;
    base_error err = {0};
    if (kdtree_build(s, options, &tree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return tree;
}

/* The options of the paper, and each rule off. */
static size_t variants(kdtree_options out[8])
{
    for (int i = 0; i < 8; i++)
        out[i] = kdtree_options_default();
    out[1].empty_percent = 100;
    out[2].covered_planes = 0;
    out[3].min_area = 0;
    out[4].perfect_splits = 0;
    out[5].empty_occluders = 0;
    out[6].traversal_cost = 0.0f;
    out[6].max_depth = 40;
    out[7].max_depth = 3;
    return 8;
}

/* Build and check with all variants; the scene is freed. */
static void check_soup(scene s)
{
    kdtree_options options[8];
    size_t count = variants(options);
    for (size_t i = 0; i < count; i++) {
        kdtree *tree = build(&s, &options[i]);
        kdtree_check(&s, tree, &options[i]);
        kdtree_destroy(&tree);
        assert_null(tree);
    }
    soup_free(&s);
}

static void kdtree__random_triangles__tree_is_sound(void **state)
{
    (void)state;
    for (size_t count = 1; count <= 40; count++)
        check_soup(soup_random(count, count, 0.3));
    check_soup(soup_random(1, 5000, 0.05));
}

static void kdtree__clusters_and_giants__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_clustered(2, 3000));
}

static void kdtree__identical_triangles__in_every_list(void **state)
{
    (void)state;
    scene s = soup_identical(500);
    kdtree_options options = kdtree_options_default();
    kdtree *tree = build(&s, &options);
    kdtree_check(&s, tree, &options);
    for (size_t i = 0; i < tree->node_count; i++)
        if (i != 1 && kdtree_is_leaf(&tree->nodes[i]))
            assert_true(kdtree_leaf_count(&tree->nodes[i]) == 0 || kdtree_leaf_count(&tree->nodes[i]) == 500);
    kdtree_destroy(&tree);
    check_soup(s);
}

static void kdtree__lines_planes_and_needles__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_collinear(2000));
    check_soup(soup_coplanar(3, 2000));
    check_soup(soup_needles(4, 1000));
}

static void kdtree__extreme_scales_and_offsets__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_placed(5, 1000, 1e-20f, 0.0f));
    check_soup(soup_placed(6, 1000, 1.0f, 1e7f));
    check_soup(soup_placed(7, 1000, 1e7f, -1e7f));
    check_soup(soup_telescope(3));
}

static void kdtree__one_triangle__empty_space_is_cut_off(void **state)
{
    (void)state;
    scene s = soup_create("one", 1);
    const scene_triangle t = {{{0, 0, 0}, {4, 0, 1}, {0, 2, 3}}};
    s.triangles[0] = t;
    kdtree_options options = kdtree_options_default();
    kdtree *tree = build(&s, &options);
    assert_int_equal(tree->node_count, 2); /* its box is the root's: nothing to cut */
    assert_int_equal(kdtree_leaf_count(&tree->nodes[0]), 1);
    assert_int_equal(tree->record_count, 1);
    kdtree_check(&s, tree, &options);
    kdtree_destroy(&tree);
    check_soup(s);
}

static void kdtree__no_triangles__empty_root(void **state)
{
    (void)state;
    scene s = soup_degenerate(1, 10, 1);
    kdtree_options options = kdtree_options_default();
    kdtree *tree = build(&s, &options);
    assert_int_equal(tree->node_count, 2);
    assert_int_equal(tree->nodes[0].link, KDTREE_LEAF);
    assert_int_equal(tree->nodes[0].extent, 0);
    assert_true(tree->min[0] > tree->max[0]);
    kdtree_check(&s, tree, &options);
    kdtree_destroy(&tree);
    soup_free(&s);
}

static void kdtree__degenerate_triangles__left_out_and_counted(void **state)
{
    (void)state;
    check_soup(soup_degenerate(2, 1000, 3));
}

static void kdtree__any_number_of_jobs__same_bytes(void **state)
{
    scene scenes[] = {soup_random(8, 70000, 0.01), soup_clustered(9, 5000), soup_coplanar(10, 3000)};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        kdtree_options options = kdtree_options_default();
        uint64_t hash = 0;
        for (unsigned jobs = 1; jobs <= 7; jobs += 3) {
            options.jobs = jobs;
            kdtree *tree = build(&scenes[i], &options);
            if (jobs == 1)
                hash = kdtree_check_hash(tree);
            assert_true(kdtree_check_hash(tree) == hash);
            kdtree_destroy(&tree);
        }
        soup_free(&scenes[i]);
    }
}

/* Another compiler, host or thread count must give these; a change of the rules changes them, and VERSION in kdtree_file.c. */
static void kdtree__seeded_scenes__bytes_are_the_stored_ones(void **state)
{
    static const uint64_t stored[] = {0xfadb2117222a88d9, 0x6baa80624416fce0, 0xa014d60ba609d2e9, 0x7406da40b18eb44c};
    scene scenes[] = {soup_random(21, 3000, 0.1), soup_clustered(22, 2000), soup_coplanar(23, 500), soup_placed(24, 500, 1e7f, 3e5f)};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        kdtree_options options = kdtree_options_default();
        options.min_area = 0;
        options.jobs = (unsigned)i + 1;
        kdtree *tree = build(&scenes[i], &options);
        if (kdtree_check_hash(tree) != stored[i])
            fail_msg("scene %zu: hash 0x%016llx", i, (unsigned long long)kdtree_check_hash(tree));
        kdtree_destroy(&tree);
        soup_free(&scenes[i]);
    }
}

static void kdtree__option_out_of_range__usage_error_names_it(void **state)
{
    static const char *const names[] = {"traversal_cost", "traversal_cost", "empty_percent", "empty_percent", "min_area",
                                        "max_depth",      "jobs",           "covered_planes", "perfect_splits", "empty_occluders"};
    scene s = soup_random(1, 10, 0.1);
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        kdtree_options bad = kdtree_options_default();
        kdtree *tree = NULL;
        base_error err = {0};
        bad.traversal_cost = i == 0 ? -1.0f : i == 1 ? NAN : 1.0f;
        bad.empty_percent = i == 2 ? 0 : i == 3 ? 101 : 10;
        bad.min_area = i == 4 ? 1000000001u : 0;
        bad.max_depth = i == 5 ? KDTREE_MAX_DEPTH + 1 : 10;
        bad.jobs = i == 6 ? 0 : 1;
        bad.covered_planes = i == 7 ? 2 : 1;
        bad.perfect_splits = i == 8 ? 2 : 1;
        bad.empty_occluders = i == 9 ? 2 : 1;
        assert_int_equal(kdtree_build(&s, &bad, &tree, &err), BASE_ERR_USAGE);
        assert_string_equal(err.what, names[i]);
        assert_null(tree);
    }
    soup_free(&s);
}

static void kdtree__too_many_triangles__input_error_names_the_scene(void **state)
{
    scene s = {.name = "crowd", .triangle_count = SCENE_MAX_TRIANGLES + 1};
    kdtree_options options = kdtree_options_default();
    kdtree *tree = NULL;
    base_error err = {0};
    (void)state;
    assert_int_equal(kdtree_build(&s, &options, &tree, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "crowd");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kdtree__random_triangles__tree_is_sound),
        cmocka_unit_test(kdtree__clusters_and_giants__tree_is_sound),
        cmocka_unit_test(kdtree__identical_triangles__in_every_list),
        cmocka_unit_test(kdtree__lines_planes_and_needles__tree_is_sound),
        cmocka_unit_test(kdtree__extreme_scales_and_offsets__tree_is_sound),
        cmocka_unit_test(kdtree__one_triangle__empty_space_is_cut_off),
        cmocka_unit_test(kdtree__no_triangles__empty_root),
        cmocka_unit_test(kdtree__degenerate_triangles__left_out_and_counted),
        cmocka_unit_test(kdtree__any_number_of_jobs__same_bytes),
        cmocka_unit_test(kdtree__seeded_scenes__bytes_are_the_stored_ones),
        cmocka_unit_test(kdtree__option_out_of_range__usage_error_names_it),
        cmocka_unit_test(kdtree__too_many_triangles__input_error_names_the_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
