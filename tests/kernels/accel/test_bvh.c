/* The BVH builder: structure, equal bytes, limits and options (hard cases X6, X7, X10, X11, X15). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "kernels/accel/bvh.h"
#include "scene/scene.h"
#include "tests/kernels/accel/bvh_check.h"
#include "tests/kernels/accel/soup.h"

static bvh *build(const scene *s, const bvh_options *options)
{
    bvh *tree = NULL;
    base_error err = {0};
    if (bvh_build(s, options, &tree, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return tree;
}

/* Build and check with several leaf sizes and numbers of bins; the scene is freed. Returns the greatest depth. */
static unsigned check_soup(scene s)
{
    static const unsigned leaves[] = {1, 2, 4, 8, 64}, bins[] = {2, 16, 64};
    unsigned depth = 0;
    for (size_t l = 0; l < sizeof leaves / sizeof *leaves; l++)
        for (size_t k = 0; k < sizeof bins / sizeof *bins; k++) {
            bvh_options options = bvh_options_default();
            options.max_leaf = leaves[l];
            options.bins = bins[k];
            bvh *tree = build(&s, &options);
            bvh_check(&s, tree, &options);
            depth = tree->depth > depth ? tree->depth : depth;
            bvh_destroy(&tree);
            assert_null(tree);
        }
    soup_free(&s);
    return depth;
}

static void bvh__random_triangles__tree_is_sound(void **state)
{
    (void)state;
    for (size_t count = 1; count <= 70; count++)
        check_soup(soup_random(count, count, 0.1));
    check_soup(soup_random(1, 20000, 0.02));
}

static void bvh__clusters_and_giants__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_clustered(2, 20000));
}

static void bvh__identical_triangles__halved_by_position(void **state)
{
    (void)state;
    scene s = soup_identical(1000);
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    assert_int_equal(tree->depth, 8); /* 1000 / 2^8 is the first to be below 4 */
    for (uint32_t i = 0; i < 1000; i++)
        assert_int_equal(tree->records[i].id, i);
    bvh_destroy(&tree);
    soup_free(&s);
    check_soup(soup_identical(1000));
}

static void bvh__collinear_triangles__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_collinear(3000));
}

static void bvh__coplanar_triangles__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_coplanar(3, 3000));
}

static void bvh__needles__tree_is_sound(void **state)
{
    (void)state;
    check_soup(soup_needles(4, 3000));
}

static void bvh__extreme_scales_and_offsets__tree_is_sound(void **state)
{
    static const float scales[] = {1e-42f, 1e-30f, 1e-4f, 1e4f, 1e18f, 1e30f, 2.5e38f};
    static const float offsets[] = {1e3f, 1e6f};
    (void)state;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++)
        check_soup(soup_placed(5, 1000, scales[i], 0.0f));
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++)
        check_soup(soup_placed(6, 1000, 1.0f, offsets[i]));
}

static void bvh__one_triangle__root_is_a_leaf(void **state)
{
    (void)state;
    scene s = soup_random(7, 1, 1.0);
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    bvh_check(&s, tree, &options);
    assert_int_equal(tree->node_count, 2);
    assert_int_equal(tree->nodes[0].count, 1);
    assert_int_equal(tree->leaf_count, 1);
    assert_int_equal(tree->depth, 0);
    assert_true(tree->sah_cost == 1.0);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void bvh__no_triangles__empty_root(void **state)
{
    (void)state;
    check_soup(soup_create("empty", 0));
}

static void bvh__degenerate_triangles__left_out_and_counted(void **state)
{
    (void)state;
    scene s = soup_degenerate(8, 1000, 7);
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    assert_int_equal(tree->degenerate_count, 143); /* 0, 7, ... 994 */
    for (size_t i = 0; i < tree->record_count; i++)
        assert_int_not_equal(tree->records[i].id % 7, 0);
    bvh_destroy(&tree);
    soup_free(&s);
    check_soup(soup_degenerate(8, 1000, 7));
    check_soup(soup_create("points", 100)); /* all degenerate */
}

static void bvh__vertices_not_finite__left_out_and_counted(void **state)
{
    (void)state;
    scene s = soup_random(9, 100, 0.1);
    s.triangles[3].v[0][0] = NAN;
    s.triangles[50].v[2][1] = INFINITY;
    s.triangles[99].v[1][2] = -INFINITY;
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    bvh_check(&s, tree, &options);
    assert_int_equal(tree->degenerate_count, 3);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void bvh__smallest_triangle_of_floats__is_kept(void **state)
{
    const float tiny = 0x1p-149f;
    (void)state;
    scene s = soup_create("tiny", 1);
    s.triangles[0] = (scene_triangle){{{0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}};
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    bvh_check(&s, tree, &options);
    assert_int_equal(tree->degenerate_count, 0);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void bvh__zeros_of_both_signs__one_box(void **state)
{
    (void)state;
    scene s = soup_random(10, 64, 0.5);
    for (size_t i = 0; i < 64; i++)
        for (int corner = 0; corner < 3; corner++)
            s.triangles[i].v[corner][1] = (i + (size_t)corner) % 2 ? 0.0f : -0.0f;
    bvh_options options = bvh_options_default();
    bvh *tree = build(&s, &options);
    bvh_check(&s, tree, &options);
    for (size_t i = 0; i < tree->node_count; i++)
        assert_false(signbit(tree->nodes[i].min[1]) || signbit(tree->nodes[i].max[1]));
    bvh_destroy(&tree);
    soup_free(&s);
}

static void bvh__sizes_halve_again_and_again__depth_is_bounded(void **state)
{
    (void)state;
    assert_int_equal(check_soup(soup_telescope(1)), BVH_MAX_DEPTH);
    assert_int_equal(check_soup(soup_telescope(200)), BVH_MAX_DEPTH);
}

static void bvh__any_number_of_jobs__same_bytes(void **state)
{
    static const unsigned jobs[] = {1, 1, 2, 2, 3, 8};
    (void)state;
    scene s = soup_clustered(11, 150000); /* long enough to be split in pieces */
    for (size_t i = 0; i < s.triangle_count; i += 1000)
        s.triangles[i] = (scene_triangle){0};
    bvh_options options = bvh_options_default();
    bvh *first = build(&s, &options);
    bvh_check(&s, first, &options);
    for (size_t j = 0; j < sizeof jobs / sizeof *jobs; j++) {
        options.jobs = jobs[j];
        bvh *tree = build(&s, &options);
        assert_int_equal(tree->node_count, first->node_count);
        assert_int_equal(tree->record_count, first->record_count);
        assert_memory_equal(tree->nodes, first->nodes, first->node_count * sizeof *first->nodes);
        assert_memory_equal(tree->records, first->records, first->record_count * sizeof *first->records);
        assert_int_equal(tree->depth, first->depth);
        assert_true(tree->sah_cost == first->sah_cost);
        bvh_destroy(&tree);
    }
    bvh_destroy(&first);
    soup_free(&s);
}

/* The hashes are of trees that satisfied bvh_check; they pin the bytes across compilers, options and hosts. */
static void bvh__seeded_scenes__bytes_are_the_stored_ones(void **state)
{
    static const struct {
        unsigned max_leaf, bins;
        uint64_t hash;
    } stored[] = {
        {4, 16, UINT64_C(0xc2c2f3e4a023ffad)},
        {1, 7, UINT64_C(0xebd7acaceb90b7b8)},
        {8, 64, UINT64_C(0x56c0c0f8bdc70b82)},
    };
    (void)state;
    scene s = soup_clustered(12, 70000);
    for (size_t i = 0; i < sizeof stored / sizeof *stored; i++) {
        bvh_options options = bvh_options_default();
        options.max_leaf = stored[i].max_leaf;
        options.bins = stored[i].bins;
        bvh *tree = build(&s, &options);
        bvh_check(&s, tree, &options);
        uint64_t hash = bvh_check_hash(tree);
        if (hash != stored[i].hash)
            fail_msg("max_leaf %u, bins %u: hash 0x%016llx", options.max_leaf, options.bins, (unsigned long long)hash);
        bvh_destroy(&tree);
    }
    soup_free(&s);
}

static void expect_refused(const scene *s, const bvh_options *options, base_status status, const char *what)
{
    bvh *tree = (bvh *)options; /* must be overwritten */
    base_error err = {0};
    assert_int_equal(bvh_build(s, options, &tree, &err), status);
    assert_null(tree);
    assert_int_equal(err.status, status);
    assert_string_equal(err.what, what);
    assert_true(err.why[0] != '\0');
    assert_int_equal(bvh_build(s, options, &tree, NULL), status);
}

static void bvh__option_out_of_range__usage_error_names_it(void **state)
{
    (void)state;
    scene s = soup_random(13, 10, 0.1);
    const bvh_options good = bvh_options_default();
    bvh_options bad;
#define REFUSED(field, value) (bad = good, bad.field = (value), expect_refused(&s, &bad, BASE_ERR_USAGE, #field))
    REFUSED(max_leaf, 0);
    REFUSED(max_leaf, 65);
    REFUSED(bins, 1);
    REFUSED(bins, 65);
    REFUSED(traversal_cost, -0.5f);
    REFUSED(traversal_cost, INFINITY);
    REFUSED(traversal_cost, NAN);
    REFUSED(intersect_cost, 0.0f);
    REFUSED(intersect_cost, -1.0f);
    REFUSED(intersect_cost, NAN);
    REFUSED(jobs, 0);
#undef REFUSED
    soup_free(&s);
}

static void bvh__too_many_triangles__input_error_names_the_scene(void **state)
{
    (void)state;
    scene s = {.name = "vast", .triangle_count = SCENE_MAX_TRIANGLES + 1}; /* refused before it is read */
    bvh_options options = bvh_options_default();
    expect_refused(&s, &options, BASE_ERR_INPUT, "vast");
}

static void bvh__costs__enter_the_expected_cost_only(void **state)
{
    (void)state;
    scene s = soup_clustered(14, 5000);
    bvh_options options = bvh_options_default();
    bvh *one = build(&s, &options);
    options.traversal_cost = 3.0f;
    options.intersect_cost = 2.0f;
    bvh *other = build(&s, &options);
    bvh_check(&s, other, &options);
    assert_true(bvh_check_hash(one) == bvh_check_hash(other));
    assert_true(other->sah_cost > one->sah_cost);
    bvh_destroy(&one);
    bvh_destroy(&other);
    soup_free(&s);
}

static void bvh__defaults__as_documented(void **state)
{
    (void)state;
    bvh_options o = bvh_options_default();
    assert_int_equal(o.max_leaf, 4);
    assert_int_equal(o.bins, 16);
    assert_int_equal(o.jobs, 1);
    assert_true(o.traversal_cost == 1.0f && o.intersect_cost == 1.0f);
    bvh *none = NULL;
    bvh_destroy(&none);
}

static void bvh__real_scenes__tree_is_sound(void **state)
{
    static const char *const files[] = {"teapot.glb", "bart_museum_10k.glb", "fern_patch_213k.glb"};
    const char *folder = getenv("LANETRACE_SCENES");
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[1024];
        scene *s = NULL;
        base_error err = {0};
        snprintf(path, sizeof path, "%s/%s", folder ? folder : ".", files[i]);
        FILE *file = fopen(path, "rb");
        if (!file) { /* said of each file; cmocka's skip() would print "not ok" */
            print_message("# skipped: %s is not there\n", files[i]);
            continue;
        }
        fclose(file);
        base_status status = scene_open(path, &s, &err);
        if (status == BASE_ERR_UNSUPPORTED) {
            print_message("# skipped: %s: %s\n", files[i], err.why);
            continue;
        }
        if (status != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        bvh_options options = bvh_options_default();
        options.jobs = 2;
        bvh *tree = build(s, &options);
        bvh_check(s, tree, &options);
        bvh_destroy(&tree);
        scene_destroy(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bvh__random_triangles__tree_is_sound),
        cmocka_unit_test(bvh__clusters_and_giants__tree_is_sound),
        cmocka_unit_test(bvh__identical_triangles__halved_by_position),
        cmocka_unit_test(bvh__collinear_triangles__tree_is_sound),
        cmocka_unit_test(bvh__coplanar_triangles__tree_is_sound),
        cmocka_unit_test(bvh__needles__tree_is_sound),
        cmocka_unit_test(bvh__extreme_scales_and_offsets__tree_is_sound),
        cmocka_unit_test(bvh__one_triangle__root_is_a_leaf),
        cmocka_unit_test(bvh__no_triangles__empty_root),
        cmocka_unit_test(bvh__degenerate_triangles__left_out_and_counted),
        cmocka_unit_test(bvh__vertices_not_finite__left_out_and_counted),
        cmocka_unit_test(bvh__smallest_triangle_of_floats__is_kept),
        cmocka_unit_test(bvh__zeros_of_both_signs__one_box),
        cmocka_unit_test(bvh__sizes_halve_again_and_again__depth_is_bounded),
        cmocka_unit_test(bvh__any_number_of_jobs__same_bytes),
        cmocka_unit_test(bvh__seeded_scenes__bytes_are_the_stored_ones),
        cmocka_unit_test(bvh__option_out_of_range__usage_error_names_it),
        cmocka_unit_test(bvh__too_many_triangles__input_error_names_the_scene),
        cmocka_unit_test(bvh__costs__enter_the_expected_cost_only),
        cmocka_unit_test(bvh__defaults__as_documented),
        cmocka_unit_test(bvh__real_scenes__tree_is_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
