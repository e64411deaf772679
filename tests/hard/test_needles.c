/* Hard case X6: needles, slivers, triangles without area. Single triangles against exact arithmetic (oracle O2), pictures
 * against trying all triangles with the same float operations (O3).
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

/* One triangle, exact answer against the kernel's: they may differ only within 4 units of an edge. */
static void check_alone(const scene_triangle *t, const float org[3], float d[16][3], const char *what)
{
    bvh *tree = bundle_leaf(t, 1);
    bundle b = bundle_create(kernels[0], tree, 0);
    exact_hit hit;
    exact_hit_init(&hit);
    bundle_rays(&b, org, d, 0xffff);
    bundle_trace(&b);
    const job_frame_tile *frame = b.job->frame_host;
    for (int j = 0; j < 16; j++) {
        int exact = exact_ray_triangle(org, d[j], t->v[0], t->v[1], t->v[2], &hit);
        int ours = frame->id[0][j] == 0;
        if (ours && !(frame->t[0][j] > 0 && frame->t[0][j] < INFINITY && fabsf(frame->u[0][j]) <= 1.5f && fabsf(frame->v[0][j]) <= 1.5f))
            fail_msg("%s: t %a u %a v %a", what, (double)frame->t[0][j], (double)frame->u[0][j], (double)frame->v[0][j]);
        if (ours != exact && !(exact_edge_distance_ulp(org, d[j], t->v[0], t->v[1], t->v[2]) <= 4))
            fail_msg("%s: %s, exactly %s, %g units from an edge", what, ours ? "hit" : "missed", exact ? "hit" : "missed",
                     exact_edge_distance_ulp(org, d[j], t->v[0], t->v[1], t->v[2]));
    }
    exact_hit_clear(&hit);
    bundle_destroy(&b);
    bvh_destroy(&tree);
}

/* A needle of the given length and width somewhere about the place's origin. */
static scene_triangle needle(base_random *r, shapes_place place, double length, double width)
{
    scene_triangle t;
    double a[3], along[3], right[3], down[3], p[3];
    shapes_point(r, 0.5, a);
    shapes_direction(r, along);
    shapes_frame(along, right, down);
    shapes_put(place, a, t.v[0]);
    for (int k = 0; k < 3; k++)
        p[k] = a[k] + length * along[k];
    shapes_put(place, p, t.v[1]);
    for (int k = 0; k < 3; k++)
        p[k] += width * right[k];
    shapes_put(place, p, t.v[2]);
    return t;
}

static void x6__needles_and_slivers__hits_exact_but_for_four_units(void **state)
{
    static const double sizes[][2] = {{1, 1e-6}, {0.3, 1e-4}, {1e-3, 1e-3}, {1e-7, 2e-13}, {1e-10, 1e-10}, {1, 1e-3}};
    base_random r = {4};
    (void)state;
    for (int i = 0; i < 6000; i++) {
        shapes_place place = shapes_places[i % 3]; /* a needle this thin exists near the origin of space only */
        scene_triangle t = needle(&r, place, sizes[i % 6][0], sizes[i % 6][1]);
        float org[3], d[16][3];
        if (i % 6 >= 3) /* tiny: about the very origin, where floats are dense */
            for (int v = 0; v < 3; v++)
                for (int k = 0; k < 3; k++)
                    t.v[v][k] -= t.v[0][k] * (v > 0);
        if (i % 6 >= 3)
            memset(t.v[0], 0, sizeof t.v[0]);
        shapes_put_point(&r, place, 1, org);
        for (int j = 0; j < 16; j++) {
            double p[3], a = base_random_range(&r, -0.2, 1.2), c = base_random_range(&r, -0.2, 1.2);
            if (j < 6) { /* on the lines of edges, also beyond their ends */
                c = 0;
                a = base_random_range(&r, -1, 2);
            }
            for (int k = 0; k < 3; k++)
                p[k] = (double)t.v[j % 3][k] + a * ((double)t.v[(j + 1) % 3][k] - (double)t.v[j % 3][k]) +
                       c * ((double)t.v[(j + 2) % 3][k] - (double)t.v[j % 3][k]) - (double)org[k];
            shapes_scaled(p, 2.9, d[j]);
        }
        double e[3], f[3], n = 0;
        for (int k = 0; k < 3; k++) {
            e[k] = (double)t.v[1][k] - (double)t.v[0][k];
            f[k] = (double)t.v[2][k] - (double)t.v[0][k];
        }
        for (int k = 0; k < 3; k++)
            n += fabs(e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3]);
        if (n > 0)
            check_alone(&t, org, d, "x6");
    }
}

enum { ROW_SIZE = 64, ROW_NEEDLES = 200 };

/* Needles that lie along rows of pixel rays, so that many rays pass their tips within rounding of both long edges. */
static void needles_along_rows(base_random *r, const scene_camera *camera, int kind, scene *s)
{
    static oracle_ray rays[ROW_SIZE * ROW_SIZE];
    scene one = {.triangle_count = 1, .triangles = &(scene_triangle){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    bvh *any = trace_tree(&one, 2);
    trace_rays(any, camera, ROW_SIZE, ROW_SIZE, rays);
    bvh_destroy(&any);
    for (int i = 0; i < ROW_NEEDLES; i++) {
        scene_triangle *t = &s->triangles[i];
        unsigned y = (unsigned)base_random_bits(r) % ROW_SIZE, x[2];
        double depth[2];
        for (int k = 0; k < 2; k++) {
            x[k] = (unsigned)base_random_bits(r) % ROW_SIZE;
            depth[k] = base_random_range(r, 0.5, 3);
        }
        if (kind == 1)
            depth[1] = depth[0];
        for (int k = 0; k < 3; k++) {
            const oracle_ray *from = &rays[y * ROW_SIZE + x[0]], *to = &rays[y * ROW_SIZE + x[kind == 2 ? 0 : 1]];
            t->v[0][k] = (float)((double)from->org[k] + depth[0] * (double)from->dir[k]);
            if (kind == 2) { /* a wall seen edge-on, along one ray */
                t->v[1][k] = (float)((double)from->org[k] + depth[0] * 1.5 * (double)from->dir[k] + 1e-6 * camera->right[k]);
                t->v[2][k] = (float)((double)from->org[k] + depth[0] * 1.2 * ((double)from->dir[k] + camera->up[k] * 0.2));
            } else {
                t->v[1][k] = (float)((double)to->org[k] + depth[1] * (double)to->dir[k]);
                t->v[2][k] = (float)((double)t->v[1][k] + camera->up[k] * (i & 1 ? 1e-6 : -1e-6));
            }
        }
    }
}

/* Past a needle's tip rays lie between its long edges as far as rounding can tell. Whether they hit must not depend on the
   boxes that a kernel tests. */
static void x6__rays_past_needle_tips__kernels_agree(void **state)
{
    base_random r = {5};
    (void)state;
    for (int i = 0; i < 60; i++) {
        char what[64];
        scene s = soup_create("needles along rows", ROW_NEEDLES);
        scene_camera camera = pictures_camera(&r, shapes_places[1]);
        needles_along_rows(&r, &camera, i % 3, &s);
        snprintf(what, sizeof what, "kind %d, picture %d", i % 3, i);
        pictures_check(&s, &camera, ROW_SIZE, what);
        soup_free(&s);
    }
}

/* The smallest such case: a needle, and two triangles elsewhere that give the tree an inner node. */
static void x6__one_needle__kernels_agree(void **state)
{
    base_random r = {6};
    (void)state;
    for (int i = 0; i < 300; i++) {
        scene all = soup_create("needles along rows", ROW_NEEDLES);
        scene_camera camera = pictures_camera(&r, shapes_places[1]);
        needles_along_rows(&r, &camera, i % 3, &all);
        scene s = {.triangle_count = 3, .triangles = all.triangles};
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                for (int n = 1; n < 3; n++)
                    all.triangles[n].v[v][k] = (float)(camera.position[k] - (n + 1) * camera.forward[k] + (v == k) * 0.1);
        pictures_check(&s, &camera, ROW_SIZE, "one needle");
        soup_free(&all);
    }
}

static void x6__no_area__removed_and_never_hit(void **state)
{
    base_random r = {7};
    (void)state;
    for (int i = 0; i < 30; i++) {
        scene s = soup_degenerate(500 + (uint64_t)i, 200, 2);
        bvh *tree = trace_tree(&s, 2);
        scene_camera camera = pictures_camera(&r, shapes_places[1]);
        assert_true(tree->degenerate_count > 0);
        assert_int_equal(tree->degenerate_count + tree->record_count, s.triangle_count);
        for (int kernel = 0; kernel < 3; kernel++) {
            trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 64, .height = 64, .jobs = 1};
            trace_picture p = trace_run(&request);
            for (size_t k = 0; k < p.pixels; k++)
                if (p.id[k] != JOB_NO_HIT) {
                    double n[3];
                    const scene_triangle *t = &s.triangles[p.id[k]];
                    for (int a = 0; a < 3; a++) {
                        int x = (a + 1) % 3, y = (a + 2) % 3;
                        n[a] = ((double)t->v[1][x] - (double)t->v[0][x]) * ((double)t->v[2][y] - (double)t->v[0][y]) -
                               ((double)t->v[1][y] - (double)t->v[0][y]) * ((double)t->v[2][x] - (double)t->v[0][x]);
                    }
                    assert_true(n[0] != 0 || n[1] != 0 || n[2] != 0);
                }
            trace_free(&p);
        }
        bvh_destroy(&tree);
        soup_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x6__needles_and_slivers__hits_exact_but_for_four_units),
        cmocka_unit_test(x6__rays_past_needle_tips__kernels_agree),
        cmocka_unit_test(x6__one_needle__kernels_agree),
        cmocka_unit_test(x6__no_area__removed_and_never_hit),
    };
    return cmocka_run_group_tests_name("hard needles", tests, NULL, NULL);
}
