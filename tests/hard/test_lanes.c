/* Hard cases of packets and groups as wholes (algorithms H: X11-X13, A3, A6, B2): what lanes may not do to each other, and
 * trees against trying all triangles with the same float operations (oracle O3).
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
#include "tests/hard/rays.h"
#include "tests/hard/shapes.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

static const char *kernels[2] = {"packet16-primary", "mft-primary"};

/* Small soups: each block of a group as it is alone, when its neighbours make the group take another path. */
static void b2__frusta_of_unlike_signs__each_as_alone(void **state)
{
    base_random r = {52};
    (void)state;
    for (int i = 0; i < 60; i++) {
        scene s = soup_random(100 + (uint64_t)i, 300, 0.3);
        bvh *tree = trace_tree(&s, 4);
        bundle b = bundle_create(kernels[1], tree, i & 1);
        float org[3], first[3], right[3], down[3];
        shapes_put_point(&r, shapes_places[1], 1.5, org);
        rays_grid(&r, 2, i % 8, first, right, down);
        bundle_grid(&b, org, first, right, down, 0xffff);
        bundle_trace(&b);
        job_frame_tile all = b.job->frame_host[0];
        for (unsigned f = 0; f < 16; f++) {
            bundle_grid(&b, org, first, right, down, 1u << f);
            bundle_trace(&b);
            assert_memory_equal(all.t[f], b.job->frame_host[0].t[f], sizeof all.t[f]);
            assert_memory_equal(all.u[f], b.job->frame_host[0].u[f], sizeof all.u[f]);
            assert_memory_equal(all.v[f], b.job->frame_host[0].v[f], sizeof all.v[f]);
            assert_memory_equal(all.id[f], b.job->frame_host[0].id[f], sizeof all.id[f]);
        }
        bundle_destroy(&b);
        bvh_destroy(&tree);
        soup_free(&s);
    }
}

/* X13: reciprocals are estimates, refined twice; no box that a hit lies in may be refused for it. */
static void x13__estimated_reciprocals__hits_of_trying_all_triangles(void **state)
{
    base_random r = {60};
    (void)state;
    for (int i = 0; i < 9; i++) {
        shapes_place place = shapes_places[i];
        scene s = soup_placed(200 + (uint64_t)i, 400, (float)place.scale, (float)place.offset);
        bvh *tree = trace_tree(&s, 1);
        for (int cull = 0; cull < 2; cull++) {
            bundle b = bundle_create(kernels[0], tree, cull);
            for (int k = 0; k < 150; k++) {
                float org[3], d[16][3];
                shapes_put_point(&r, place, 1.5, org);
                rays_wild(&r, d);
                bundle_rays(&b, org, d, 0xffff);
                bundle_trace(&b);
                bundle_assert_brute_force(&b, "x13");
            }
            bundle_destroy(&b);
        }
        bvh_destroy(&tree);
        soup_free(&s);
    }
}

static void a3__identical_rays__as_one_ray(void **state)
{
    base_random r = {61};
    scene s = soup_random(300, 500, 0.3);
    bvh *tree = trace_tree(&s, 2);
    bundle b = bundle_create(kernels[0], tree, 0);
    (void)state;
    for (int i = 0; i < 500; i++) {
        float org[3], d[16][3];
        shapes_put_point(&r, shapes_places[1], 1.5, org);
        rays_with_zeros(&r, i % 3 ? 0 : (unsigned)i % 7, d[0]);
        for (int j = 1; j < 16; j++)
            memcpy(d[j], d[0], sizeof d[j]);
        bundle_rays(&b, org, d, 0xffff);
        kernel_counts all = bundle_trace(&b);
        job_frame_tile frame = b.job->frame_host[0];
        bundle_rays(&b, org, d, 1u << i % 16);
        kernel_counts one = bundle_trace(&b);
        for (unsigned j = 0; j < 16; j++) {
            assert_int_equal(frame.id[0][j], b.job->frame_host[0].id[0][i % 16]);
            assert_memory_equal(&frame.t[0][j], &b.job->frame_host[0].t[0][i % 16], 4);
        }
        assert_int_equal(all.n[KERNEL_rays], 16);
        assert_int_equal(one.n[KERNEL_rays], 1);
        all.n[KERNEL_rays] = all.n[KERNEL_rays_primary] = one.n[KERNEL_rays] = one.n[KERNEL_rays_primary] = 0;
        assert_memory_equal(&all, &one, sizeof all);
    }
    bundle_destroy(&b);
    bvh_destroy(&tree);
    soup_free(&s);
}

static void a6__children_exchanged__same_hits(void **state)
{
    base_random r = {62};
    (void)state;
    for (int i = 0; i < 20; i++) {
        scene s = soup_clustered(400 + (uint64_t)i, 500);
        bvh *tree = trace_tree(&s, 2);
        bundle b = bundle_create(kernels[0], tree, 0);
        for (int k = 0; k < 30; k++) {
            float org[3], d[16][3];
            shapes_put_point(&r, shapes_places[1], 8, org);
            rays_wild(&r, d);
            bundle_rays(&b, org, d, 0xffff);
            bundle_trace(&b);
            job_frame_tile frame = b.job->frame_host[0];
            bundle_swap_children(tree);
            bundle_trace(&b);
            bundle_swap_children(tree);
            assert_memory_equal(frame.t[0], b.job->frame_host[0].t[0], sizeof frame.t[0]);
            assert_memory_equal(frame.id[0], b.job->frame_host[0].id[0], sizeof frame.id[0]);
            assert_memory_equal(frame.u[0], b.job->frame_host[0].u[0], sizeof frame.u[0]);
        }
        bundle_destroy(&b);
        bvh_destroy(&tree);
        soup_free(&s);
    }
}

/* X12: lanes that do not count hold NaN, infinities and denormals; the others notice nothing, whatever their order (O6). */
static void x12__inactive_lanes_hold_garbage__active_ones_unchanged(void **state)
{
    static const uint32_t garbage[] = {0x7fc00000, 0xffc00001, 0x7f800001, 0x7f800000, 0xff800000, 0x00000001, 0x80000000, 0x7f7fffff};
    base_random r = {63};
    scene s = soup_random(301, 500, 0.3);
    bvh *tree = trace_tree(&s, 2);
    bundle b = bundle_create(kernels[0], tree, 0);
    (void)state;
    for (int i = 0; i < 600; i++) {
        float org[3], d[16][3], spoilt[16][3];
        unsigned mask = (unsigned)base_random_bits(&r) & 0xffff, turn = (unsigned)base_random_bits(&r) % 16;
        shapes_put_point(&r, shapes_places[1], 1.5, org);
        rays_wild(&r, d);
        if (i & 1) /* one sign on all axes, the common path */
            for (int j = 0; j < 16; j++)
                for (int k = 0; k < 3; k++)
                    d[j][k] = fabsf(d[j][k]) * 0.9f + 0.1f;
        bundle_rays(&b, org, d, mask | 1);
        kernel_counts n = bundle_trace(&b);
        job_frame_tile frame = b.job->frame_host[0];
        unsigned turned = 0;
        for (unsigned j = 0; j < 16; j++) {
            unsigned to = (j + turn) % 16;
            int active = (mask | 1) >> j & 1;
            turned |= (unsigned)active << to;
            for (int k = 0; k < 3; k++)
                if (active)
                    spoilt[to][k] = d[j][k];
                else
                    memcpy(&spoilt[to][k], &garbage[base_random_bits(&r) % 8], 4);
        }
        bundle_rays(&b, org, spoilt, turned);
        kernel_counts m = bundle_trace(&b);
        assert_memory_equal(&n, &m, sizeof n);
        for (unsigned j = 0; j < 16; j++)
            if ((mask | 1) >> j & 1) {
                assert_int_equal(frame.id[0][j], b.job->frame_host[0].id[0][(j + turn) % 16]);
                assert_memory_equal(&frame.t[0][j], &b.job->frame_host[0].t[0][(j + turn) % 16], 4);
                assert_memory_equal(&frame.u[0][j], &b.job->frame_host[0].u[0][(j + turn) % 16], 4);
            }
    }
    bundle_destroy(&b);
    bvh_destroy(&tree);
    soup_free(&s);
}

/* The same for whole frusta outside the image. */
static void x12__inactive_frusta_hold_garbage__active_ones_unchanged(void **state)
{
    base_random r = {64};
    scene s = soup_random(302, 500, 0.3);
    bvh *tree = trace_tree(&s, 8);
    bundle b = bundle_create(kernels[1], tree, 0);
    (void)state;
    for (int i = 0; i < 200; i++) {
        float org[3], first[3], right[3], down[3];
        unsigned columns = 1 + (unsigned)i % 3, mask = 0;
        for (unsigned f = 0; f < 16; f++)
            mask |= ((f & 3) < columns ? 1u : 0u) << f;
        shapes_put_point(&r, shapes_places[1], 1.5, org);
        rays_grid(&r, 0.7, i % 8, first, right, down);
        bundle_grid(&b, org, first, right, down, mask);
        kernel_counts n = bundle_trace(&b);
        job_frame_tile frame = b.job->frame_host[0];
        float kept[16];
        memcpy(kept, b.job->constants_host->block_x, sizeof kept);
        for (unsigned f = 0; f < 16; f++)
            if (!(mask >> f & 1))
                b.job->constants_host->block_x[f] = i & 1 ? NAN : -INFINITY;
        kernel_counts m = bundle_trace(&b);
        memcpy(b.job->constants_host->block_x, kept, sizeof kept);
        assert_memory_equal(&n, &m, sizeof n);
        for (unsigned f = 0; f < 16; f++)
            if (mask >> f & 1) {
                assert_memory_equal(frame.id[f], b.job->frame_host[0].id[f], sizeof frame.id[f]);
                assert_memory_equal(frame.t[f], b.job->frame_host[0].t[f], sizeof frame.t[f]);
            }
    }
    bundle_destroy(&b);
    bvh_destroy(&tree);
    soup_free(&s);
}

/* X11: a ray with a NaN hits nothing, and its neighbours what they hit without it. */
static void x11__rays_with_nan__miss(void **state)
{
    base_random r = {65};
    scene s = soup_random(303, 500, 0.3);
    bvh *tree = trace_tree(&s, 2);
    bundle b = bundle_create(kernels[0], tree, 0);
    (void)state;
    for (int i = 0; i < 600; i++) {
        float org[3], d[16][3];
        unsigned bad = (unsigned)base_random_bits(&r) % 16;
        shapes_put_point(&r, shapes_places[1], 1.5, org);
        rays_wild(&r, d);
        bundle_rays(&b, org, d, 0xffff);
        bundle_trace(&b);
        job_frame_tile frame = b.job->frame_host[0];
        d[bad][i % 3] = NAN;
        bundle_rays(&b, org, d, 0xffff);
        bundle_trace(&b);
        for (unsigned j = 0; j < 16; j++) {
            if (j == bad) {
                assert_int_equal(b.job->frame_host[0].id[0][j], JOB_NO_HIT);
                assert_true(b.job->frame_host[0].t[0][j] == INFINITY);
                continue;
            }
            assert_int_equal(frame.id[0][j], b.job->frame_host[0].id[0][j]);
            assert_memory_equal(&frame.t[0][j], &b.job->frame_host[0].t[0][j], 4);
        }
    }
    bundle_destroy(&b);
    bvh_destroy(&tree);
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(b2__frusta_of_unlike_signs__each_as_alone),
        cmocka_unit_test(x13__estimated_reciprocals__hits_of_trying_all_triangles),
        cmocka_unit_test(a3__identical_rays__as_one_ray),
        cmocka_unit_test(a6__children_exchanged__same_hits),
        cmocka_unit_test(x12__inactive_lanes_hold_garbage__active_ones_unchanged),
        cmocka_unit_test(x12__inactive_frusta_hold_garbage__active_ones_unchanged),
        cmocka_unit_test(x11__rays_with_nan__miss),
    };
    return cmocka_run_group_tests_name("hard lanes", tests, NULL, NULL);
}
