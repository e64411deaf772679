/* Hard cases X10, X11 and X15: far from the origin, vertices that are not finite, degenerate scenes and the deepest tree;
 * against exact arithmetic (oracle O2) and trying all triangles (O3).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/hard/bundle.h"
#include "tests/hard/pictures.h"
#include "tests/hard/shapes.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "exact/predicates.h"

static const char *kernels[3] = {"packet16-primary", "mft-primary", "packet256-primary"};

static void x10__all_places__hits_of_trying_all_triangles(void **state)
{
    base_random r = {13};
    (void)state;
    for (int i = 0; i < 4 * SHAPES_PLACES; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        char what[64];
        scene s = soup_placed(700 + (uint64_t)i, 300, (float)place.scale, (float)place.offset);
        scene_camera camera = pictures_camera(&r, place);
        snprintf(what, sizeof what, "offset %g, size %g", place.offset, place.scale);
        pictures_check(&s, &camera, 48, what);
        soup_free(&s);
    }
}

/* Every hit at every place is one, and none nearer was left out, but for a few units at edges. */
static void x10__all_places__hits_exact_but_for_four_units(void **state)
{
    enum { TRIANGLES = 60, SIZE = 24 };
    base_random r = {14};
    exact_hit hit, best;
    oracle_ray rays[SIZE * SIZE];
    (void)state;
    exact_hit_init(&hit);
    exact_hit_init(&best);
    for (int i = 0; i < SHAPES_PLACES; i++) {
        shapes_place place = shapes_places[i];
        scene s = soup_placed(800 + (uint64_t)i, TRIANGLES, (float)place.scale, (float)place.offset);
        scene_camera camera = pictures_camera(&r, place);
        bvh *tree = trace_tree(&s, 2);
        trace_request request = {.kernel = kernels[1], .tree = tree, .camera = &camera, .width = SIZE, .height = SIZE, .jobs = 1};
        trace_picture p = trace_run(&request);
        trace_rays(tree, &camera, SIZE, SIZE, rays);
        for (size_t k = 0; k < p.pixels; k++) {
            uint32_t nearest = JOB_NO_HIT;
            int near_edge = 0;
            for (uint32_t n = 0; n < TRIANGLES; n++) {
                const scene_triangle *t = &s.triangles[n];
                int struck = exact_ray_triangle(rays[k].org, rays[k].dir, t->v[0], t->v[1], t->v[2], &hit);
                near_edge |= exact_edge_distance_ulp(rays[k].org, rays[k].dir, t->v[0], t->v[1], t->v[2]) <= 4;
                if (struck && (nearest == JOB_NO_HIT || exact_hit_compare_t(&hit, &best) < 0)) {
                    nearest = n;
                    exact_ray_triangle(rays[k].org, rays[k].dir, t->v[0], t->v[1], t->v[2], &best);
                }
            }
            /* a vertex is moved by up to 2^-24 of its coordinates when it is brought to the camera: so may t be */
            double blur = nearest == JOB_NO_HIT ? 0 : 1e-5 * best.t_double + 0x1p-20 * (place.offset + place.scale);
            if (p.id[k] != nearest && !near_edge && !(p.id[k] != JOB_NO_HIT && fabs((double)p.t[k] - best.t_double) <= blur))
                fail_msg("offset %g size %g, ray %zu: triangle %d, exactly %d", place.offset, place.scale, k, (int)p.id[k], (int)nearest);
        }
        trace_free(&p);
        bvh_destroy(&tree);
        soup_free(&s);
    }
    exact_hit_clear(&hit);
    exact_hit_clear(&best);
}

/* X11: refused at load; and a tree that gets them all the same leaves them out. */
static void x11__vertices_not_finite__refused_or_left_out(void **state)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    base_random r = {15};
    (void)state;
    for (int i = 0; i < 9; i++) {
        scene *whole = NULL;
        base_error err = {0};
        uint32_t material;
        scene s = soup_random(900 + (uint64_t)i, 150, 0.4), clean = soup_random(900 + (uint64_t)i, 150, 0.4);
        for (size_t k = 1; k < s.triangle_count; k += 3) {
            s.triangles[k].v[base_random_bits(&r) % 3][base_random_bits(&r) % 3] = bad[i % 3];
            memset(&clean.triangles[k], 0, sizeof clean.triangles[k]); /* no area: left out as well */
        }
        assert_int_equal(scene_create("not finite", &whole, &err), BASE_OK);
        assert_int_equal(scene_add_material(whole, (scene_material){{1, 1, 1}}, &material, &err), BASE_OK);
        assert_int_equal(scene_add_triangles(whole, s.triangles, s.triangle_count, material, &err), BASE_OK);
        assert_int_equal(scene_finish(whole, &err), BASE_ERR_INPUT);
        scene_destroy(&whole);
        scene_camera camera = pictures_camera(&r, shapes_places[1]);
        bvh *tree = trace_tree(&s, 2), *clean_tree = trace_tree(&clean, 2);
        assert_int_equal(tree->degenerate_count, 50);
        for (int kernel = 0; kernel < 3; kernel++) {
            trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 48, .height = 48, .jobs = 1};
            trace_picture p = trace_run(&request);
            request.tree = clean_tree;
            trace_picture q = trace_run(&request);
            trace_assert_equal(&p, &q, "x11");
            trace_free(&p);
            trace_free(&q);
        }
        bvh_destroy(&tree);
        bvh_destroy(&clean_tree);
        soup_free(&s);
        soup_free(&clean);
    }
}

/* X15: nothing but triangles without area. */
static void x15__nothing_to_hit__background_and_no_work(void **state)
{
    scene s = soup_create("empty", 7);
    scene_camera camera = {0};
    base_random r = {16};
    bvh *tree = trace_tree(&s, 2);
    (void)state;
    camera = pictures_camera(&r, shapes_places[1]);
    assert_int_equal(tree->record_count, 0);
    for (int kernel = 0; kernel < 3; kernel++)
        for (int level = LRB_NATIVE; level <= LRB_RECORD; level++) {
            trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 37, .height = 18,
                                     .level = level, .jobs = 1};
            trace_picture p = trace_run(&request);
            for (size_t i = 0; i < p.pixels; i++) {
                assert_int_equal(p.id[i], JOB_NO_HIT);
                assert_true(p.t[i] == INFINITY && p.u[i] == 0.0f && p.v[i] == 0.0f);
            }
            assert_int_equal(p.counts.n[KERNEL_rays], 37 * 18);
            assert_int_equal(p.counts.n[KERNEL_traversed_cells] + p.counts.n[KERNEL_tri_accesses] + p.counts.n[KERNEL_aabb_tests], 0);
            trace_free(&p);
        }
    bvh_destroy(&tree);
    soup_free(&s);
}

static void x15__one_triangle_and_identical_ones__as_all_tried(void **state)
{
    static const size_t counts[] = {1, 2, 3, 17, 200};
    base_random r = {17};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        for (int k = 0; k < 4; k++) {
            scene s = soup_identical(counts[i]);
            scene_camera camera = pictures_camera(&r, shapes_places[1]);
            pictures_check(&s, &camera, 40, "x15 identical");
            soup_free(&s);
            s = soup_collinear(counts[i]);
            pictures_check(&s, &camera, 40, "x15 collinear");
            soup_free(&s);
        }
}

/* The root itself is a leaf: no box is tested, all its triangles are. */
static void x15__root_is_a_leaf__all_accessed(void **state)
{
    base_random r = {18};
    scene s = soup_random(950, 40, 0.5);
    bvh *tree = trace_tree(&s, 64);
    scene_camera camera = pictures_camera(&r, shapes_places[1]);
    (void)state;
    assert_int_equal(tree->inner_count, 0);
    for (int kernel = 0; kernel < 3; kernel++) {
        trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 32, .height = 32, .jobs = 1};
        trace_picture p = trace_run(&request), all = twin_brute_force(tree, &camera, 32, 32, 0);
        uint64_t units = p.counts.n[kernel ? KERNEL_units_groups : KERNEL_units_packets];
        trace_assert_equal(&p, &all, "root leaf");
        assert_int_equal(p.counts.n[KERNEL_aabb_tests], 0);
        assert_int_equal(p.counts.n[KERNEL_traversed_cells], units);
        assert_int_equal(p.counts.n[KERNEL_tri_accesses], units * tree->record_count);
        trace_free(&p);
        trace_free(&all);
    }
    bvh_destroy(&tree);
    soup_free(&s);
}

/* The deepest tree there can be, all of whose boxes are entered: the stack holds an entry a level, at either child. */
static void x15__depth_of_64__stack_holds(void **state)
{
    base_random r = {19};
    scene s = soup_random(951, BVH_MAX_DEPTH + 1, 0.8);
    (void)state;
    for (int swapped = 0; swapped < 2; swapped++) {
        bvh *tree = bundle_chain(s.triangles, BVH_MAX_DEPTH, -3, 3);
        if (swapped)
            bundle_swap_children(tree);
        for (int kernel = 0; kernel < 3; kernel++) {
            scene_camera camera = pictures_camera(&r, shapes_places[1]);
            trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 32, .height = 32, .jobs = 1};
            trace_picture p = trace_run(&request), all = twin_brute_force(tree, &camera, 32, 32, 0);
            trace_assert_equal(&p, &all, "depth 64");
            assert_true(p.counts.n[KERNEL_traversed_inner] <= BVH_MAX_DEPTH * p.counts.n[kernel ? KERNEL_units_groups : KERNEL_units_packets]);
            trace_free(&p);
            trace_free(&all);
        }
        bvh_destroy(&tree);
    }
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x10__all_places__hits_of_trying_all_triangles),
        cmocka_unit_test(x10__all_places__hits_exact_but_for_four_units),
        cmocka_unit_test(x11__vertices_not_finite__refused_or_left_out),
        cmocka_unit_test(x15__nothing_to_hit__background_and_no_work),
        cmocka_unit_test(x15__one_triangle_and_identical_ones__as_all_tried),
        cmocka_unit_test(x15__root_is_a_leaf__all_accessed),
        cmocka_unit_test(x15__depth_of_64__stack_holds),
    };
    return cmocka_run_group_tests_name("hard scenes", tests, NULL, NULL);
}
