/* The counters of the papers' tables, as counted by plain scalar twins of the two traversals (algorithms A.3), and the
 * pictures, as found by trying every triangle. Images of all sizes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/random.h"
#include "scene/builtin.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/kernels/twin.h"

static scene_camera camera_at(base_random *r, double size)
{
    double eye[3], target[3], up[3];
    for (int k = 0; k < 3; k++) {
        eye[k] = base_random_range(r, -2 * size, 2 * size);
        target[k] = base_random_range(r, -size, size);
        up[k] = base_random_range(r, -1, 1);
    }
    return scene_camera_look_at("random", eye, target, up, base_random_range(r, 0.2, 2.0));
}

static const char *kernel_names[3] = {"packet16-primary", "mft-primary", "packet256-primary"};

static trace_picture kernel_picture(twin_kind kind, const bvh *tree, const scene_camera *camera, unsigned w, unsigned h, unsigned cull)
{
    trace_request request = {.kernel = kernel_names[kind], .tree = tree, .camera = camera, .width = w, .height = h, .cull = cull,
                             .level = LRB_NATIVE, .jobs = 1};
    return trace_run(&request);
}

static void assert_counts_equal(twin_kind kind, const kernel_counts *kernel, const kernel_counts *twin, const char *what)
{
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        if (kernel->n[i] != twin->n[i])
            fail_msg("%s, %s: %s is %llu, the twin's is %llu", what, kernel_names[kind], kernel_counter_table[i].name,
                     (unsigned long long)kernel->n[i], (unsigned long long)twin->n[i]);
}

/* All kernels and their twins on one scene, with the leaf limits of their defaults. Brute force is asked once. */
static void check_scene(const scene *s, const scene_camera *camera, unsigned w, unsigned h, unsigned cull, int brute, const char *what)
{
    static const unsigned leaves[2] = {2, 8};
    bvh *tree[2] = {trace_tree(s, leaves[0]), trace_tree(s, leaves[1])};
    trace_picture reference = {0};
    if (brute)
        reference = twin_brute_force(tree[0], camera, w, h, (int)cull);
    for (twin_kind kind = TWIN_PACKETS; kind <= TWIN_GROUPS; kind++) {
        const bvh *of = tree[kind != TWIN_PACKETS];
        trace_picture kernel = kernel_picture(kind, of, camera, w, h, cull);
        trace_picture twin = twin_trace(kind, of, camera, w, h, (int)cull);
        trace_assert_equal(&kernel, &twin, what);
        assert_counts_equal(kind, &kernel.counts, &twin.counts, what);
        if (brute)
            trace_assert_equal(&kernel, &reference, what);
        trace_free(&kernel);
        trace_free(&twin);
    }
    if (brute)
        trace_free(&reference);
    bvh_destroy(&tree[0]);
    bvh_destroy(&tree[1]);
}

static void check_soup(scene s, double size, uint64_t seed, int pictures)
{
    base_random r = {seed};
    char what[160];
    for (int i = 0; i < pictures; i++) {
        scene_camera camera = camera_at(&r, size);
        for (unsigned cull = 0; cull < 2; cull++) {
            snprintf(what, sizeof what, "soup '%.60s', picture %d, cull_backface %u", s.name, i, cull);
            check_scene(&s, &camera, 61, 47, cull, 1, what);
        }
    }
    soup_free(&s);
}

static void counts__random_soup__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_random(11, 600, 0.25), 1, 1, 12);
}

static void counts__clusters__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_clustered(12, 800), 10, 2, 8);
}

static void counts__needles__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_needles(13, 400), 1, 3, 8);
}

static void counts__coplanar__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_coplanar(14, 300), 1, 4, 8);
}

static void counts__degenerate_ones_between__as_the_twins(void **state)
{
    (void)state;
    check_soup(soup_degenerate(15, 300, 3), 1, 5, 4);
}

static void counts__smallest_builtin_scene__as_the_twins(void **state)
{
    size_t count;
    scene *s = NULL;
    char spec[128];
    (void)state;
    snprintf(spec, sizeof spec, "builtin:%s", scene_builtin_list(&count)[0].name);
    assert_int_equal(scene_open(spec, &s, NULL), BASE_OK);
    for (unsigned cull = 0; cull < 2; cull++)
        check_scene(s, &s->cameras[0], 128, 96, cull, 1, spec);
    scene_destroy(&s);
}

/* A2: sizes that fill no tile, no block, one pixel, one row, one column. */
static void a2__image_sizes__real_pixels_only(void **state)
{
    static const unsigned sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {3, 3}, {4, 4}, {5, 4}, {4, 5}, {15, 15}, {16, 16}, {17, 16},
                                        {16, 17}, {17, 17}, {1, 100}, {100, 1}, {33, 2}, {63, 65}, {31, 47}};
    scene s = soup_random(16, 200, 0.4);
    base_random r = {7};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned w = sizes[i][0], h = sizes[i][1];
        char what[64];
        scene_camera camera = camera_at(&r, 1);
        snprintf(what, sizeof what, "%u x %u", w, h);
        check_scene(&s, &camera, w, h, (unsigned)i & 1, 1, what);
    }
    soup_free(&s);
}

static void a2__image_sizes__rays_and_units_counted_exactly(void **state)
{
    scene s = soup_random(17, 50, 0.4);
    base_random r = {8};
    scene_camera camera = camera_at(&r, 1);
    bvh *tree = trace_tree(&s, 4);
    (void)state;
    for (unsigned w = 1; w <= 35; w += 3)
        for (unsigned h = 1; h <= 35; h += 2) {
            trace_picture packets = kernel_picture(TWIN_PACKETS, tree, &camera, w, h, 0);
            trace_picture frusta = kernel_picture(TWIN_FRUSTA, tree, &camera, w, h, 0);
            trace_picture groups = kernel_picture(TWIN_GROUPS, tree, &camera, w, h, 0);
            uint64_t blocks = (uint64_t)((w + 3) / 4) * ((h + 3) / 4), tiles = (uint64_t)((w + 15) / 16) * ((h + 15) / 16);
            const uint64_t *p = packets.counts.n, *f = frusta.counts.n, *g = groups.counts.n;
            assert_int_equal(p[KERNEL_rays], w * h);
            assert_int_equal(p[KERNEL_rays_primary], w * h);
            assert_int_equal(p[KERNEL_units_packets], blocks);
            assert_int_equal(p[KERNEL_units_common] + p[KERNEL_units_blend] + p[KERNEL_units_zero], blocks);
            assert_int_equal(p[KERNEL_units_groups] + p[KERNEL_units_frusta], 0);
            assert_int_equal(f[KERNEL_rays], w * h);
            assert_int_equal(f[KERNEL_rays_primary], w * h);
            assert_int_equal(f[KERNEL_units_groups], tiles);
            assert_int_equal(f[KERNEL_units_frusta], blocks);
            assert_int_equal(f[KERNEL_units_common] + f[KERNEL_units_blend] + f[KERNEL_units_zero], tiles);
            assert_int_equal(f[KERNEL_units_packets], 0);
            assert_int_equal(g[KERNEL_rays], w * h);
            assert_int_equal(g[KERNEL_units_groups], tiles);
            assert_int_equal(g[KERNEL_units_packets], blocks);
            assert_int_equal(g[KERNEL_units_common] + g[KERNEL_units_blend] + g[KERNEL_units_zero], tiles);
            if (blocks == 1) /* A5: a box of the group is a box of its only packet */
                assert_int_equal(g[KERNEL_aabb_tests], g[KERNEL_aabb_group_tests]);
            trace_free(&groups);
            trace_free(&packets);
            trace_free(&frusta);
        }
    bvh_destroy(&tree);
    soup_free(&s);
}

/* A kernel adds to no counter that its descriptor does not list. */
static void counts__unlisted_counters__stay_zero(void **state)
{
    scene s = soup_random(18, 300, 0.4);
    base_random r = {9};
    scene_camera camera = camera_at(&r, 1);
    bvh *tree = trace_tree(&s, 4);
    (void)state;
    for (twin_kind kind = TWIN_PACKETS; kind <= TWIN_GROUPS; kind++) {
        trace_picture p = kernel_picture(kind, tree, &camera, 64, 64, 0);
        uint64_t listed = kernel_find(kernel_names[kind])->counters;
        for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
            assert_true((listed >> i & 1) || p.counts.n[i] == 0);
        trace_free(&p);
    }
    bvh_destroy(&tree);
    soup_free(&s);
}

/* Relations that the definitions imply, on a real scene and all leaf limits. */
static void counts__definitions__relations_hold(void **state)
{
    static const unsigned leaves[] = {1, 2, 4, 8, 16, 64};
    scene s = soup_clustered(19, 3000);
    base_random r = {10};
    scene_camera camera = camera_at(&r, 8);
    (void)state;
    for (size_t i = 0; i < sizeof leaves / sizeof *leaves; i++) {
        bvh *tree = trace_tree(&s, leaves[i]);
        for (twin_kind kind = TWIN_PACKETS; kind <= TWIN_GROUPS; kind++)
            for (unsigned cull = 0; cull < 2; cull++) {
                trace_picture p = kernel_picture(kind, tree, &camera, 96, 96, cull);
                const uint64_t *n = p.counts.n;
                assert_int_equal(n[kind == TWIN_GROUPS ? KERNEL_aabb_group_tests : KERNEL_aabb_tests], 2 * n[KERNEL_traversed_inner]);
                if (kind == TWIN_GROUPS)
                    assert_true(n[KERNEL_aabb_tests] >= n[KERNEL_aabb_group_tests] && n[KERNEL_aabb_tests] <= 16 * n[KERNEL_aabb_group_tests]);
                assert_true(n[KERNEL_tri_accesses] >= n[KERNEL_tri_after_culling]);
                assert_true(n[KERNEL_traversed_cells] >= n[KERNEL_traversed_inner]);
                assert_true(n[KERNEL_tri_accesses] <= leaves[i] * (n[KERNEL_traversed_cells] - n[KERNEL_traversed_inner]));
                if (kind == TWIN_PACKETS)
                    assert_int_equal(n[KERNEL_isect_tests], n[KERNEL_tri_after_culling]);
                else
                    assert_true(n[KERNEL_isect_tests] >= n[KERNEL_tri_after_culling] &&
                                n[KERNEL_isect_tests] <= 16 * n[KERNEL_tri_after_culling]);
                trace_free(&p);
            }
        bvh_destroy(&tree);
    }
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts__random_soup__as_the_twins),
        cmocka_unit_test(counts__clusters__as_the_twins),
        cmocka_unit_test(counts__needles__as_the_twins),
        cmocka_unit_test(counts__coplanar__as_the_twins),
        cmocka_unit_test(counts__degenerate_ones_between__as_the_twins),
        cmocka_unit_test(counts__smallest_builtin_scene__as_the_twins),
        cmocka_unit_test(a2__image_sizes__real_pixels_only),
        cmocka_unit_test(a2__image_sizes__rays_and_units_counted_exactly),
        cmocka_unit_test(counts__unlisted_counters__stay_zero),
        cmocka_unit_test(counts__definitions__relations_hold),
    };
    return cmocka_run_group_tests_name("counts", tests, NULL, NULL);
}
