/* Hard cases X7 to X9: coplanar triangles, planes through the camera, hits at the very start of a ray; against exact
 * arithmetic (oracle O2) and brute force (O1).
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

static const char *kernels[2] = {"packet16-primary", "mft-primary"};

/* ---- X7: coplanar triangles ---- */

/* Copies of one triangle, some wound the other way: the smallest id wins, of the front ones if backs are culled. */
static void x7__duplicates_and_opposites__smallest_id(void **state)
{
    enum { COPIES = 23 };
    base_random r = {8};
    (void)state;
    for (int i = 0; i < 300; i++) {
        scene_triangle copies[COPIES], t;
        shapes_place place = shapes_places[i % 6];
        unsigned opposite = (unsigned)base_random_bits(&r);
        float org[3], d[16][3];
        double p[3];
        for (int v = 0; v < 3; v++) {
            shapes_put_point(&r, shapes_place_is_fine(place) ? place : shapes_places[1], 1, t.v[v]);
        }
        shapes_put_point(&r, shapes_place_is_fine(place) ? place : shapes_places[1], 2, org);
        for (int n = 0; n < COPIES; n++)
            for (int v = 0; v < 3; v++)
                memcpy(copies[n].v[v], t.v[opposite >> n & 1 ? (3 - v) % 3 : v], sizeof t.v[v]);
        for (int j = 0; j < 16; j++) {
            double w[2] = {base_random_range(&r, 0.1, 0.4), base_random_range(&r, 0.1, 0.4)};
            for (int k = 0; k < 3; k++)
                p[k] = (1 - w[0] - w[1]) * (double)t.v[0][k] + w[0] * (double)t.v[1][k] + w[1] * (double)t.v[2][k] - (double)org[k];
            shapes_scaled(p, 2.9, d[j]);
        }
        scene s = {.triangle_count = COPIES, .triangles = copies};
        bvh *tree = trace_tree(&s, 2);
        for (int cull = 0; cull < 2; cull++) {
            bundle b = bundle_create(kernels[0], tree, cull);
            exact_hit hit;
            exact_hit_init(&hit);
            bundle_rays(&b, org, d, 0xffff);
            bundle_trace(&b);
            for (int j = 0; j < 16; j++) {
                uint32_t expected = JOB_NO_HIT;
                for (uint32_t n = COPIES; n-- > 0;)
                    if (exact_ray_triangle(org, d[j], copies[n].v[0], copies[n].v[1], copies[n].v[2], &hit) &&
                        (!cull || hit.facing > 0))
                        expected = n;
                assert_int_equal(b.job->frame_host[0].id[0][j], expected);
            }
            exact_hit_clear(&hit);
            bundle_destroy(&b);
        }
        bvh_destroy(&tree);
    }
}

static void x7__coplanar_and_overlapping__kernels_agree(void **state)
{
    base_random r = {9};
    (void)state;
    for (int i = 0; i < 20; i++) {
        scene s = soup_coplanar(600 + (uint64_t)i, 120);
        scene_camera camera = pictures_camera(&r, shapes_places[1]);
        pictures_check(&s, &camera, 48, "x7");
        soup_free(&s);
    }
}

/* ---- X8, X9: planes through the camera ---- */

/* The camera on a vertex of a triangle, wherever: t would be 0, so it is not hit, by any ray and any kernel. */
static void x8__camera_on_a_vertex__triangle_not_hit(void **state)
{
    base_random r = {10};
    (void)state;
    for (int i = 0; i < 900; i++) {
        scene_triangle t;
        float d[16][3];
        double p[3];
        for (int v = 0; v < 3; v++) {
            shapes_put_point(&r, shapes_places[i % SHAPES_PLACES], 1, t.v[v]);
        }
        for (int j = 0; j < 16; j++) {
            shapes_direction(&r, p);
            for (int k = 0; j < 8 && k < 3; k++) /* into the wedge that the triangle spans, nearly */
                p[k] = (double)t.v[0][k] + (double)t.v[1][k] + (double)t.v[2][k] - 3 * (double)t.v[i / 9 % 3][k] +
                       1e-3 * shapes_places[i % SHAPES_PLACES].scale * p[k];
            shapes_scaled(p, 2.9, d[j]);
        }
        bvh *tree = bundle_leaf(&t, 1);
        for (int cull = 0; cull < 2; cull++) {
            bundle b = bundle_create(kernels[0], tree, cull);
            bundle_rays(&b, t.v[i / 9 % 3], d, 0xffff);
            bundle_trace(&b);
            for (int j = 0; j < 16; j++)
                if (b.job->frame_host[0].id[0][j] != JOB_NO_HIT)
                    fail_msg("camera on vertex %d, offset %g size %g: hit at t = %g", i / 9 % 3, shapes_places[i % SHAPES_PLACES].offset,
                             shapes_places[i % SHAPES_PLACES].scale, (double)b.job->frame_host[0].t[0][j]);
            bundle_destroy(&b);
        }
        bvh_destroy(&tree);
    }
}

/* A point of a lattice of halves. */
static void lattice_point(base_random *r, float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)((int)(base_random_bits(r) % 9) - 4) / 2;
}

/* Coordinates with few bits, where every operation is exact but the reciprocals: rays in the plane of a triangle, cameras in
   it, rays through edges and vertices. Exactly those are hit that exact arithmetic says. */
static void x8__exact_coordinates__hit_iff_exactly_hit(void **state)
{
    base_random r = {11};
    unsigned in_plane = 0, hits = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 20000; i++) {
        scene_triangle t;
        float org[3], d[16][3], e[3], f[3], n = 0;
        for (int v = 0; v < 3; v++)
            lattice_point(&r, t.v[v]);
        lattice_point(&r, org);
        for (int j = 0; j < 16; j++) {
            float to[3];
            lattice_point(&r, to);
            for (int k = 0; k < 3; k++)
                d[j][k] = (to[k] - org[k]) * 0x1p-2f;
        }
        for (int k = 0; k < 3; k++) {
            e[k] = t.v[1][k] - t.v[0][k];
            f[k] = t.v[2][k] - t.v[0][k];
        }
        for (int k = 0; k < 3; k++)
            n += fabsf(e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3]);
        if (n == 0)
            continue;
        bvh *tree = bundle_leaf(&t, 1);
        bundle b = bundle_create(kernels[0], tree, i & 1);
        bundle_rays(&b, org, d, 0xffff);
        bundle_trace(&b);
        for (int j = 0; j < 16; j++) {
            int exact = exact_ray_triangle(org, d[j], t.v[0], t.v[1], t.v[2], &hit) && (!(i & 1) || hit.facing > 0);
            in_plane += hit.facing == 0;
            hits += (unsigned)exact;
            if (exact != (b.job->frame_host[0].id[0][j] == 0))
                fail_msg("case %d ray %d: %s", i, j, exact ? "lost" : "hit, and should not be");
        }
        bundle_destroy(&b);
        bvh_destroy(&tree);
    }
    exact_hit_clear(&hit);
    assert_true(in_plane > 1000 && hits > 1000);
}

/* X9: a surface through the camera is at t = 0 and not hit; one just in front of it is. (Blockers at the light and self
   shadows belong to the shadow kernels of a later version.) */
static void x9__surface_at_or_just_before_the_camera__open_interval(void **state)
{
    base_random r = {12};
    (void)state;
    for (int i = 0; i < 400; i++) {
        float height = i % 2 ? ldexpf(1, -1 - i % 20) : 0.0f, org[3], d[16][3];
        int axis = i % 3;
        scene_triangle t = {{{-4, -4, -4}, {4, -4, -4}, {-4, 12, -4}}};
        for (int v = 0; v < 3; v++) {
            float flat[3] = {t.v[v][0], t.v[v][1], 0.5f};
            for (int k = 0; k < 3; k++)
                t.v[v][k] = flat[(k + 2 - axis + 3) % 3];
        }
        double p[3];
        shapes_point(&r, 1, p);
        for (int k = 0; k < 3; k++)
            org[k] = k == axis ? 0.5f - height : (float)p[k];
        for (int j = 0; j < 16; j++) {
            shapes_direction(&r, p);
            p[axis] = fabs(p[axis]) + 0.1;
            shapes_scaled(p, 2.9, d[j]);
        }
        bvh *tree = bundle_leaf(&t, 1);
        bundle b = bundle_create(kernels[0], tree, 0);
        bundle_rays(&b, org, d, 0xffff);
        bundle_trace(&b);
        for (int j = 0; j < 16; j++) {
            float t_hit = b.job->frame_host[0].t[0][j];
            if (height == 0.0f)
                assert_int_equal(b.job->frame_host[0].id[0][j], JOB_NO_HIT);
            else if (fabsf(height / d[j][axis]) < 1)
                assert_true(fabsf(t_hit - height / d[j][axis]) <= 4 * 0x1p-24f * t_hit);
        }
        bundle_destroy(&b);
        bvh_destroy(&tree);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x7__duplicates_and_opposites__smallest_id),
        cmocka_unit_test(x7__coplanar_and_overlapping__kernels_agree),
        cmocka_unit_test(x8__camera_on_a_vertex__triangle_not_hit),
        cmocka_unit_test(x8__exact_coordinates__hit_iff_exactly_hit),
        cmocka_unit_test(x9__surface_at_or_just_before_the_camera__open_interval),
    };
    return cmocka_run_group_tests_name("hard triangles", tests, NULL, NULL);
}
