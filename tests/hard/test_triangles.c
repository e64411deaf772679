/* Hard cases of the triangle test and of scenes (algorithms H: X5-X11, X15): leaks, needles, coplanar triangles, planes seen
 * edge-on, far from the origin, degenerate scenes. Exact arithmetic (O2), brute force (O1), single rays (O3).
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
#include "tests/hard/shapes.h"
#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"
#include "tests/oracles/exact.h"

static const char *kernels[2] = {"packet16-primary", "mft-primary"};

/* ---- X5: closed surfaces ---- */

/* Rays from an inner point, 16 at a time, and how many find nothing. `aim` gives the point that ray j is aimed at. */
typedef void aim_fn(base_random *r, const shapes_mesh *m, double point[3]);

static void aim_at_edge(base_random *r, const shapes_mesh *m, double point[3])
{
    const uint32_t *corner = m->corner[base_random_bits(r) % m->triangle_count];
    unsigned e = (unsigned)base_random_bits(r) % 3;
    double s = base_random_range(r, 0.001, 0.999);
    for (int k = 0; k < 3; k++)
        point[k] = (1 - s) * (double)m->vertices[corner[e]][k] + s * (double)m->vertices[corner[(e + 1) % 3]][k];
}

static void aim_at_vertex(base_random *r, const shapes_mesh *m, double point[3])
{
    const float *v = m->vertices[base_random_bits(r) % m->vertex_count];
    for (int k = 0; k < 3; k++)
        point[k] = (double)v[k];
}

static void inner_point(base_random *r, shapes_place place, float org[3])
{
    double p[3];
    shapes_point(r, 0.2, p);
    shapes_put(place, p, org);
}

/* A missed ray must at least be one that only rounding can miss: it passes a triangle's edges by a few units. */
static void assert_near_edge(const shapes_mesh *m, const float org[3], const float d[3], const char *what)
{
    exact_hit hit;
    double closest = INFINITY;
    exact_hit_init(&hit);
    for (size_t i = 0; i < m->triangle_count; i++) {
        const scene_triangle *t = &m->triangles[i];
        if (exact_ray_triangle(org, d, t->v[0], t->v[1], t->v[2], &hit))
            closest = fmin(closest, exact_edge_distance_ulp(org, d, t->v[0], t->v[1], t->v[2]));
    }
    exact_hit_clear(&hit);
    if (!(closest <= 4))
        fail_msg("%s: a ray %g units inside a triangle hits nothing", what, closest);
}

static uint64_t count_leaks(base_random *r, const shapes_mesh *m, shapes_place place, aim_fn *aim, unsigned packets, const char *what)
{
    scene s = shapes_scene(m);
    bvh *tree = trace_tree(&s, 2);
    bundle b = bundle_create(kernels[0], tree, 0);
    uint64_t leaks = 0;
    assert_int_equal(tree->degenerate_count, 0);
    for (unsigned i = 0; i < packets; i++) {
        float org[3], d[16][3];
        inner_point(r, place, org);
        for (int j = 0; j < 16; j++) {
            double p[3];
            aim(r, m, p);
            for (int k = 0; k < 3; k++)
                p[k] -= (double)org[k];
            shapes_scaled(p, 2.9, d[j]);
        }
        bundle_rays(&b, org, d, 0xffff);
        bundle_trace(&b);
        for (int j = 0; j < 16; j++)
            if (b.job->frame_host[0].id[0][j] == JOB_NO_HIT) {
                if (leaks++ < 20)
                    assert_near_edge(m, org, d[j], what);
            }
    }
    bundle_destroy(&b);
    bvh_destroy(&tree);
    return leaks;
}

/* All closed surfaces at all places that have room for them; returns the rays that leaked. */
static uint64_t leaks_everywhere(uint64_t seed, aim_fn *aim, unsigned packets, uint64_t *rays)
{
    base_random r = {seed};
    uint64_t leaks = 0;
    *rays = 0;
    for (int i = 0; i < SHAPES_PLACES; i++) {
        if (!shapes_place_is_fine(shapes_places[i]))
            continue;
        for (int shape = 0; shape < 5; shape++) {
            char what[96];
            shapes_mesh m = shape == 0   ? shapes_sphere(&r, 12, 18, 0.0, shapes_places[i])
                            : shape == 1 ? shapes_sphere(&r, 16, 3, 0.1, shapes_places[i])
                            : shape == 2 ? shapes_sphere(&r, 8, 64, 0.1, shapes_places[i])
                            : shape == 3 ? shapes_box(&r, 5, 1, shapes_places[i])
                                         : shapes_box(&r, 5, 0, shapes_places[i]);
            snprintf(what, sizeof what, "shape %d at %g, size %g", shape, shapes_places[i].offset, shapes_places[i].scale);
            leaks += count_leaks(&r, &m, shapes_places[i], aim, packets, what);
            *rays += 16 * packets;
            shapes_free(&m);
        }
    }
    return leaks;
}

static void x5__closed_surfaces__rays_at_edges__no_leak(void **state)
{
    uint64_t rays, leaks = leaks_everywhere(1, aim_at_edge, 2600, &rays);
    (void)state;
    print_message("# %llu rays at edges, %llu leaks\n", (unsigned long long)rays, (unsigned long long)leaks);
    assert_true(rays >= 1000000);
    assert_int_equal(leaks, 0);
}

/* Edges do not leak because both triangles see the negative of the same plane. Around a vertex three or more planes meet,
   each rounded on its own: rays that pass within rounding of it (2^-22 of the distance) may find none. */
static void x5__closed_surfaces__rays_at_vertices__leaks_only_within_rounding(void **state)
{
    uint64_t rays, leaks = leaks_everywhere(2, aim_at_vertex, 800, &rays);
    (void)state;
    print_message("# %llu rays at vertices, %llu leaks\n", (unsigned long long)rays, (unsigned long long)leaks);
    assert_true(leaks * 8 < rays); /* for valence 3 one in four at most, if all signs were chance */
}

/* A surface whose vertices lie on every second pixel's ray: the others pass through its edges. */
static void x5__mesh_on_pixel_rays__kernels_agree_and_edges_do_not_leak(void **state)
{
    enum { N = 33, CELLS = (N - 1) / 2 };
    static const double eye[3] = {0.3, -0.2, 0.7}, target[3] = {-1, 0.4, -2}, up[3] = {0.2, 1, 0.1};
    scene_camera camera = scene_camera_look_at("pixel rays", eye, target, up, 0.9);
    base_random r = {3};
    oracle_ray rays[N * N];
    scene_triangle triangles[2 * CELLS * CELLS];
    float vertex[CELLS + 1][CELLS + 1][3];
    (void)state;
    for (int turn = 0; turn < 20; turn++) {
        scene s = {.triangle_count = 1, .triangles = &(scene_triangle){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
        bvh *any = trace_tree(&s, 2);
        trace_rays(any, &camera, N, N, rays);
        bvh_destroy(&any);
        for (int y = 0; y <= CELLS; y++)
            for (int x = 0; x <= CELLS; x++) {
                double t = 2 + base_random_unit(&r);
                for (int k = 0; k < 3; k++)
                    vertex[y][x][k] = (float)((double)rays[2 * y * N + 2 * x].org[k] + t * (double)rays[2 * y * N + 2 * x].dir[k]);
            }
        for (int i = 0; i < CELLS * CELLS; i++) {
            int x = i % CELLS, y = i / CELLS;
            for (int k = 0; k < 3; k++) {
                triangles[2 * i].v[0][k] = triangles[2 * i + 1].v[2][k] = vertex[y][x][k];
                triangles[2 * i].v[1][k] = vertex[y][x + 1][k];
                triangles[2 * i].v[2][k] = triangles[2 * i + 1].v[0][k] = vertex[y + 1][x + 1][k];
                triangles[2 * i + 1].v[1][k] = vertex[y + 1][x][k];
            }
        }
        s = (scene){.triangle_count = 2 * CELLS * CELLS, .triangles = triangles};
        bvh *deep = trace_tree(&s, 2), *shallow = trace_tree(&s, 8);
        trace_request request = {.kernel = kernels[0], .tree = deep, .camera = &camera, .width = N, .height = N, .jobs = 1};
        trace_picture packets = trace_run(&request);
        request.kernel = kernels[1];
        request.tree = shallow;
        trace_picture frusta = trace_run(&request);
        trace_assert_equal(&packets, &frusta, "mesh on pixel rays");
        for (int y = 1; y < N - 1; y++)
            for (int x = 1; x < N - 1; x++)
                if (x % 2 || y % 2)
                    assert_int_not_equal(packets.id[y * N + x], JOB_NO_HIT);
        trace_free(&packets);
        trace_free(&frusta);
        bvh_destroy(&deep);
        bvh_destroy(&shallow);
    }
}

/* ---- X6: needles and slivers ---- */

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
        double o[3];
        if (i % 6 >= 3) /* tiny: about the very origin, where floats are dense */
            for (int v = 0; v < 3; v++)
                for (int k = 0; k < 3; k++)
                    t.v[v][k] -= t.v[0][k] * (v > 0);
        if (i % 6 >= 3)
            memset(t.v[0], 0, sizeof t.v[0]);
        shapes_point(&r, 1, o);
        shapes_put(place, o, org);
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

/* Both kernels and trying all triangles on one picture. */
static void check_picture(const scene *s, const scene_camera *camera, unsigned size, const char *what)
{
    bvh *deep = trace_tree(s, 2), *shallow = trace_tree(s, 8);
    for (unsigned cull = 0; cull < 2; cull++) {
        trace_request request = {.kernel = kernels[0], .tree = deep, .camera = camera, .width = size, .height = size, .cull = cull,
                                 .jobs = 1};
        trace_picture packets = trace_run(&request), all = twin_brute_force(deep, camera, size, size, (int)cull);
        request.kernel = kernels[1];
        request.tree = shallow;
        trace_picture frusta = trace_run(&request);
        trace_assert_equal(&packets, &all, what);
        trace_assert_equal(&frusta, &all, what);
        trace_free(&packets);
        trace_free(&frusta);
        trace_free(&all);
    }
    bvh_destroy(&deep);
    bvh_destroy(&shallow);
}

static scene_camera random_camera(base_random *r, shapes_place place)
{
    double eye[3], target[3], up[3];
    shapes_point(r, 1.5, eye);
    shapes_point(r, 0.7, target);
    shapes_direction(r, up);
    for (int k = 0; k < 3; k++) {
        eye[k] = place.scale * eye[k] + place.offset;
        target[k] = place.scale * target[k] + place.offset;
    }
    return scene_camera_look_at("random", eye, target, up, base_random_range(r, 0.3, 1.8));
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
        scene_camera camera = random_camera(&r, shapes_places[1]);
        needles_along_rows(&r, &camera, i % 3, &s);
        snprintf(what, sizeof what, "kind %d, picture %d", i % 3, i);
        check_picture(&s, &camera, ROW_SIZE, what);
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
        scene_camera camera = random_camera(&r, shapes_places[1]);
        needles_along_rows(&r, &camera, i % 3, &all);
        scene s = {.triangle_count = 3, .triangles = all.triangles};
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                for (int n = 1; n < 3; n++)
                    all.triangles[n].v[v][k] = (float)(camera.position[k] - (n + 1) * camera.forward[k] + (v == k) * 0.1);
        check_picture(&s, &camera, ROW_SIZE, "one needle");
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
        scene_camera camera = random_camera(&r, shapes_places[1]);
        assert_true(tree->degenerate_count > 0);
        assert_int_equal(tree->degenerate_count + tree->record_count, s.triangle_count);
        for (int kernel = 0; kernel < 2; kernel++) {
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
        double p[3], o[3];
        for (int v = 0; v < 3; v++) {
            shapes_point(&r, 1, p);
            shapes_put(shapes_place_is_fine(place) ? place : shapes_places[1], p, t.v[v]);
        }
        shapes_point(&r, 2, o);
        shapes_put(shapes_place_is_fine(place) ? place : shapes_places[1], o, org);
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
        scene_camera camera = random_camera(&r, shapes_places[1]);
        check_picture(&s, &camera, 48, "x7");
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
            shapes_point(&r, 1, p);
            shapes_put(shapes_places[i % SHAPES_PLACES], p, t.v[v]);
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

/* ---- X10, X11, X15: scenes ---- */

static void x10__all_places__hits_of_trying_all_triangles(void **state)
{
    base_random r = {13};
    (void)state;
    for (int i = 0; i < 4 * SHAPES_PLACES; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        char what[64];
        scene s = soup_placed(700 + (uint64_t)i, 300, (float)place.scale, (float)place.offset);
        scene_camera camera = random_camera(&r, place);
        snprintf(what, sizeof what, "offset %g, size %g", place.offset, place.scale);
        check_picture(&s, &camera, 48, what);
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
        scene_camera camera = random_camera(&r, place);
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
        scene_camera camera = random_camera(&r, shapes_places[1]);
        bvh *tree = trace_tree(&s, 2), *clean_tree = trace_tree(&clean, 2);
        assert_int_equal(tree->degenerate_count, 50);
        for (int kernel = 0; kernel < 2; kernel++) {
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
    camera = random_camera(&r, shapes_places[1]);
    assert_int_equal(tree->record_count, 0);
    for (int kernel = 0; kernel < 2; kernel++)
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
            scene_camera camera = random_camera(&r, shapes_places[1]);
            check_picture(&s, &camera, 40, "x15 identical");
            soup_free(&s);
            s = soup_collinear(counts[i]);
            check_picture(&s, &camera, 40, "x15 collinear");
            soup_free(&s);
        }
}

/* The root itself is a leaf: no box is tested, all its triangles are. */
static void x15__root_is_a_leaf__all_accessed(void **state)
{
    base_random r = {18};
    scene s = soup_random(950, 40, 0.5);
    bvh *tree = trace_tree(&s, 64);
    scene_camera camera = random_camera(&r, shapes_places[1]);
    (void)state;
    assert_int_equal(tree->inner_count, 0);
    for (int kernel = 0; kernel < 2; kernel++) {
        trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 32, .height = 32, .jobs = 1};
        trace_picture p = trace_run(&request), all = twin_brute_force(tree, &camera, 32, 32, 0);
        uint64_t units = p.counts.n[KERNEL_units_packets] + p.counts.n[KERNEL_units_groups];
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
        for (int kernel = 0; kernel < 2; kernel++) {
            scene_camera camera = random_camera(&r, shapes_places[1]);
            trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 32, .height = 32, .jobs = 1};
            trace_picture p = trace_run(&request), all = twin_brute_force(tree, &camera, 32, 32, 0);
            trace_assert_equal(&p, &all, "depth 64");
            assert_true(p.counts.n[KERNEL_traversed_inner] <= BVH_MAX_DEPTH * (p.counts.n[KERNEL_units_packets] + p.counts.n[KERNEL_units_groups]));
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
        cmocka_unit_test(x5__closed_surfaces__rays_at_edges__no_leak),
        cmocka_unit_test(x5__closed_surfaces__rays_at_vertices__leaks_only_within_rounding),
        cmocka_unit_test(x5__mesh_on_pixel_rays__kernels_agree_and_edges_do_not_leak),
        cmocka_unit_test(x6__needles_and_slivers__hits_exact_but_for_four_units),
        cmocka_unit_test(x6__rays_past_needle_tips__kernels_agree),
        cmocka_unit_test(x6__one_needle__kernels_agree),
        cmocka_unit_test(x6__no_area__removed_and_never_hit),
        cmocka_unit_test(x7__duplicates_and_opposites__smallest_id),
        cmocka_unit_test(x7__coplanar_and_overlapping__kernels_agree),
        cmocka_unit_test(x8__camera_on_a_vertex__triangle_not_hit),
        cmocka_unit_test(x8__exact_coordinates__hit_iff_exactly_hit),
        cmocka_unit_test(x9__surface_at_or_just_before_the_camera__open_interval),
        cmocka_unit_test(x10__all_places__hits_of_trying_all_triangles),
        cmocka_unit_test(x10__all_places__hits_exact_but_for_four_units),
        cmocka_unit_test(x11__vertices_not_finite__refused_or_left_out),
        cmocka_unit_test(x15__nothing_to_hit__background_and_no_work),
        cmocka_unit_test(x15__one_triangle_and_identical_ones__as_all_tried),
        cmocka_unit_test(x15__root_is_a_leaf__all_accessed),
        cmocka_unit_test(x15__depth_of_64__stack_holds),
    };
    return cmocka_run_group_tests_name("hard triangles", tests, NULL, NULL);
}
