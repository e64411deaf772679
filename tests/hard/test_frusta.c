/* Hard cases of the frusta (algorithms H.B: B4-B8): culling against exact arithmetic (O2, O4), generated rays, limits; and
 * what must not change when the picture is mirrored, turned, moved or scaled (O6).
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
#include "exact/predicates.h"

static const char *kernels[3] = {"packet16-primary", "mft-primary", "packet256-primary"};

typedef struct grid {
    float org[3], first[3], right[3], down[3];
} grid;

/* A group of rays about `width` wide, anywhere at a place. */
static grid random_grid(base_random *r, shapes_place place, double width)
{
    grid g;
    double f[3], u[3], v[3], spin = base_random_range(r, 0.3, 1.7);
    shapes_direction(r, f);
    shapes_frame(f, u, v);
    shapes_put_point(r, place, 1, g.org);
    for (int k = 0; k < 3; k++) {
        double a = (u[k] * spin + v[k] * 0.3) * width / 16, b = (v[k] * spin - u[k] * 0.2) * width / 16;
        g.right[k] = (float)a;
        g.down[k] = (float)b;
        g.first[k] = (float)(2 * f[k] - 7.5 * a - 7.5 * b);
    }
    return g;
}

static void set_grid(bundle *b, const grid *g, unsigned mask) { bundle_grid(b, g->org, g->first, g->right, g->down, mask); }

static void corners_of(const bundle *b, unsigned f, float corner[4][3])
{
    static const unsigned pixel[4] = {0, 3, 15, 12};
    for (int k = 0; k < 4; k++)
        bundle_direction(b, f, pixel[k], corner[k]);
}

/* The point at distance t along weights of a frustum's corner rays. */
static void point_in(const grid *g, float corner[4][3], const double weight[4], double t, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = (double)g->org[k];
        for (int c = 0; c < 4; c++)
            out[k] += t * weight[c] * (double)corner[c][k];
    }
}

/* ---- B5, B6: triangles and one frustum ---- */

/* Vertices of a triangle for a frustum, one of several nasty kinds. */
static void nasty_triangle(base_random *r, const grid *g, float corner[4][3], shapes_place place, int kind, scene_triangle *t)
{
    for (int v = 0; v < 3; v++) {
        double w[4] = {0, 0, 0, 0}, p[3], depth = place.scale * base_random_range(r, 0.1, 1.5);
        switch (kind) {
        case 0: /* anywhere: mostly large, behind, across the plane of the origin */
            shapes_point(r, 1, p);
            for (int k = 0; k < 3; k++)
                p[k] = p[k] * place.scale + (double)g->org[k];
            break;
        case 1: /* enclosing the frustum, or nearly */
            w[v] = base_random_range(r, 1, 40);
            w[(v + 2) % 4] = 1 - w[v];
            point_in(g, corner, w, depth, p);
            break;
        case 2: /* vertices exactly on corner rays: an edge along a side of the frustum */
            w[(v + (int)(base_random_bits(r) % 2)) % 4] = 1;
            point_in(g, corner, w, depth, p);
            break;
        case 3: /* edges that touch a side or a corner ray from outside */
            w[v % 2] = base_random_range(r, -3, 4);
            w[1 - v % 2] = 1 - w[v % 2];
            if (v == 2) {
                w[2] = -base_random_range(r, 0, 3);
                w[0] -= w[2];
            }
            point_in(g, corner, w, depth, p);
            break;
        case 4: /* between two rays: smaller than a pixel */
            for (int c = 0; c < 4; c++)
                w[c] = 0.25 + base_random_range(r, -0.04, 0.04);
            point_in(g, corner, w, depth, p);
            break;
        case 5: /* through the origin: a vertex or an edge at it */
            shapes_point(r, v == 0 ? 0 : 1, p);
            for (int k = 0; k < 3; k++)
                p[k] = p[k] * place.scale + (double)g->org[k];
            break;
        default: /* a sliver along the frustum */
            for (int c = 0; c < 4; c++)
                w[c] = base_random_unit(r) * 0.5;
            point_in(g, corner, w, v == 0 ? depth : -depth * base_random_range(r, -3, 1), p);
            break;
        }
        for (int k = 0; k < 3; k++)
            t->v[v][k] = (float)p[k];
    }
}

static int has_area(const scene_triangle *t)
{
    double e[3], f[3], n = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = (double)t->v[1][k] - (double)t->v[0][k];
        f[k] = (double)t->v[2][k] - (double)t->v[0][k];
    }
    for (int k = 0; k < 3; k++)
        n += fabs(e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3]);
    return n > 0;
}

/* Whether the plane of a triangle passes the origin so closely that its facing is a matter of rounding. */
static int facing_is_noise(const scene_triangle *t, const float org[3])
{
    double n[3], plane = 0, normal = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = ((double)t->v[1][i] - (double)t->v[0][i]) * ((double)t->v[2][j] - (double)t->v[0][j]) -
               ((double)t->v[1][j] - (double)t->v[0][j]) * ((double)t->v[2][i] - (double)t->v[0][i]);
        plane += n[k] * ((double)t->v[0][k] - (double)org[k]);
        normal += fabs(n[k]);
        for (int v = 0; v < 3; v++)
            size = fmax(size, fabs((double)t->v[v][k]) + fabs((double)org[k]));
    }
    return fabs(plane) <= 0x1p-20 * normal * size;
}

typedef struct cull_tally {
    unsigned exact, kept, cases;
} cull_tally;

/*
 * One frustum, one triangle: every ray hits as when tried alone, culled or not; and where exact arithmetic finds a hit
 * inside the frustum that is not just rounding at the plane of the origin, it is not culled.
 */
static void check_cull(base_random *r, int i, int kind, cull_tally *tally)
{
    shapes_place place = shapes_places[i / 7 % SHAPES_PLACES];
    grid g = random_grid(r, place, i & 1 ? 0.02 : i & 2 ? 0.5 : 1.5);
    unsigned f = (unsigned)base_random_bits(r) % 16;
    int cull = i & 4 ? 1 : 0;
    scene_triangle t = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    bvh *tree = bundle_leaf(&t, 1);
    bundle b = bundle_create(kernels[1], tree, cull);
    float corner[4][3];
    set_grid(&b, &g, 1u << f);
    corners_of(&b, f, corner);
    bundle_destroy(&b);
    bvh_destroy(&tree);
    nasty_triangle(r, &g, corner, place, kind, &t);
    if (!has_area(&t))
        return;
    tree = bundle_leaf(&t, 1);
    b = bundle_create(kernels[1], tree, cull);
    set_grid(&b, &g, 1u << f);
    kernel_counts n = bundle_trace(&b);
    int exact = exact_cone_triangle(g.org, (const float(*)[3])corner, t.v[0], t.v[1], t.v[2], cull);
    bundle_assert_brute_force(&b, "culling");
    tally->cases++;
    tally->exact += (unsigned)exact;
    tally->kept += (unsigned)n.n[KERNEL_isect_tests];
    if (exact && n.n[KERNEL_isect_tests] == 0 && !(cull && facing_is_noise(&t, g.org)))
        fail_msg("case %d kind %d, offset %g size %g: frustum %u loses a triangle", i, kind, place.offset, place.scale, f);
    bundle_destroy(&b);
    bvh_destroy(&tree);
}

static cull_tally check_culls(int kind, uint64_t seed)
{
    base_random r = {seed};
    cull_tally tally = {0};
    for (int i = 0; i < 4000; i++)
        check_cull(&r, i, kind, &tally);
    return tally;
}

static void b5__triangles_anywhere__never_lost_mostly_culled(void **state)
{
    cull_tally t = check_culls(0, 1);
    (void)state;
    assert_true(t.exact > 50);
    assert_true(t.kept < t.exact + t.cases / 4);
}

static void b5__enclosing_the_frustum__kept(void **state)
{
    cull_tally t = check_culls(1, 2);
    (void)state;
    assert_true(t.exact > 200);
}

static void b5__between_rays__no_hit_invented(void **state)
{
    cull_tally t = check_culls(4, 3);
    (void)state;
    assert_true(t.exact > 200);
}

static void b5__slivers_along_the_frustum__never_lost(void **state)
{
    cull_tally t = check_culls(6, 4);
    (void)state;
    assert_true(t.cases > 500);
}

static void b6__edges_through_corner_rays__kept(void **state)
{
    cull_tally t = check_culls(2, 5);
    (void)state;
    assert_true(t.cases > 500);
}

static void b6__edges_touching_from_outside__never_lost(void **state)
{
    cull_tally t = check_culls(3, 6);
    (void)state;
    assert_true(t.cases > 500);
}

static void b6__through_the_origin__never_lost(void **state)
{
    cull_tally t = check_culls(5, 7);
    (void)state;
    assert_true(t.cases > 500);
}

/* ---- B7: generated rays ---- */

/* Every ray's components lie within those of its block's corner rays, for whole images of wild cameras. */
static void b7__generated_rays__within_their_corners(void **state)
{
    enum { SIZE = 64 };
    static oracle_ray rays[SIZE * SIZE];
    base_random r = {8};
    scene s = soup_random(1, 4, 0.3);
    bvh *tree = trace_tree(&s, 4);
    (void)state;
    for (int i = 0; i < 300; i++) {
        static const double yfov[] = {1e-6, 1e-3, 0.5, 1.5, 3.0, 3.1415};
        double eye[3], target[3], up[3];
        shapes_point(&r, 1, eye);
        shapes_point(&r, 1, target);
        shapes_direction(&r, up);
        scene_camera camera = scene_camera_look_at("wild", eye, target, up, yfov[i % 6]);
        trace_rays(tree, &camera, SIZE, SIZE, rays);
        for (unsigned k = 0; k < SIZE * SIZE; k++) {
            unsigned x = k % SIZE / 4 * 4, y = k / SIZE / 4 * 4;
            const float *a = rays[y * SIZE + x].dir, *b = rays[y * SIZE + x + 3].dir;
            const float *c = rays[(y + 3) * SIZE + x].dir, *d = rays[(y + 3) * SIZE + x + 3].dir;
            for (int axis = 0; axis < 3; axis++) {
                float lo = fminf(fminf(a[axis], b[axis]), fminf(c[axis], d[axis]));
                float hi = fmaxf(fmaxf(a[axis], b[axis]), fmaxf(c[axis], d[axis]));
                assert_true(lo <= rays[k].dir[axis] && rays[k].dir[axis] <= hi);
            }
        }
    }
    bvh_destroy(&tree);
    soup_free(&s);
}

/* What is hit by a corner ray alone is found: tiny triangles about the outermost rays of blocks. */
static void b7__hits_of_corner_rays__found(void **state)
{
    base_random r = {9};
    unsigned found = 0;
    (void)state;
    for (int i = 0; i < 4000; i++) {
        static const unsigned pixel[4] = {0, 3, 15, 12};
        shapes_place place = shapes_places[i % 3 + (i & 1 ? 3 : 0)];
        grid g = random_grid(&r, place, i % 5 ? 0.7 : 0.01);
        unsigned f = (unsigned)base_random_bits(&r) % 16;
        scene_triangle t = {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
        bvh *tree = bundle_leaf(&t, 1);
        bundle b = bundle_create(kernels[1], tree, 0);
        float d[3];
        set_grid(&b, &g, 0xffff);
        bundle_direction(&b, f, pixel[i % 4], d);
        bundle_destroy(&b);
        bvh_destroy(&tree);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                t.v[v][k] = (float)((double)g.org[k] + place.scale * ((double)d[k] + 1e-6 * base_random_range(&r, -1, 1)));
        if (!has_area(&t))
            continue;
        tree = bundle_leaf(&t, 1);
        b = bundle_create(kernels[1], tree, 0);
        set_grid(&b, &g, 0xffff);
        bundle_trace(&b);
        bundle_assert_brute_force(&b, "b7");
        found += b.job->frame_host[0].id[f][pixel[i % 4]] == 0;
        bundle_destroy(&b);
        bvh_destroy(&tree);
    }
    assert_true(found > 100);
}

/* ---- B8: the limit of a frustum ---- */

/* A near triangle that covers some of the 16 rays of a frustum, two far ones behind it below a node of their own: their
   leaves are visited exactly if not all 16 rays have hit the near one. */
static void b8__some_of_16_rays_hit__far_leaf_still_visited(void **state)
{
    unsigned seen = 0;
    (void)state;
    for (int covered = 0; covered <= 16; covered++) {
        /* pixel j of block 0 at x = j % 4, y = j / 4, on the plane z = 1: rows above the slanted edge y + x/4 = c are hit */
        float cut = (float)covered / 4 - 0.125f, org[3] = {0, 0, 0}, first[3] = {0.25f, 0.25f, 1}, right[3] = {0x1p-6f, 0, 0},
              down[3] = {0, 0x1p-6f, 0};
        scene_triangle t[3] = {{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}}, {{{-9, -9, 2}, {9, -9, 2}, {0, 18, 2}}},
                               {{{-9, -9, 3}, {9, -9, 3}, {0, 18, 3}}}};
        const float at[3][2] = {{-64, cut + 16}, {64, cut - 16}, {0, -64}}; /* in pixels; the first two on the edge's line */
        for (int v = 0; v < 3; v++) {
            t[0].v[v][0] = 0.25f + at[v][0] * 0x1p-6f;
            t[0].v[v][1] = 0.25f + at[v][1] * 0x1p-6f;
        }
        bvh *tree = bundle_chain(t, 2, -9, 18);
        for (size_t node = 2; node < 6; node++) {
            tree->nodes[node].min[2] = node == 2 ? 1 : 2;
            tree->nodes[node].max[2] = node == 2 ? 1 : 3;
        }
        bundle b = bundle_create(kernels[1], tree, 0);
        bundle_grid(&b, org, first, right, down, 1);
        kernel_counts n = bundle_trace(&b);
        int near_hits = 0;
        bundle_assert_brute_force(&b, "b8");
        for (int j = 0; j < 16; j++)
            near_hits += b.job->frame_host[0].id[0][j] == 0;
        seen |= 1u << near_hits;
        assert_int_equal(n.n[KERNEL_tri_accesses], near_hits == 16 ? 1 : 3);
        bundle_destroy(&b);
        bvh_destroy(&tree);
    }
    assert_int_equal(seen, 0x1ffff); /* each number from 0 to 16 occurred */
}

/* ---- O6: what must not change ---- */

/* One group of rays on one soup; results of all kernels. */
typedef struct metamorph {
    scene s;
    grid g;
    job_frame_tile frame[3];
} metamorph;

static void trace_metamorph(metamorph *m)
{
    for (int kernel = 0; kernel < 3; kernel++) {
        bvh *tree = trace_tree(&m->s, kernel ? 8 : 2);
        bundle b = bundle_create(kernels[kernel], tree, 0);
        set_grid(&b, &m->g, 0xffff);
        bundle_trace(&b);
        bundle_assert_brute_force(&b, "metamorph");
        m->frame[kernel] = b.job->frame_host[0];
        bundle_destroy(&b);
        bvh_destroy(&tree);
    }
    for (int kernel = 1; kernel < 3; kernel++) {
        assert_memory_equal(m->frame[0].t, m->frame[kernel].t, sizeof m->frame[0].t);
        assert_memory_equal(m->frame[0].id, m->frame[kernel].id, sizeof m->frame[0].id);
    }
}

static metamorph metamorph_create(base_random *r, int i)
{
    metamorph m = {.s = soup_random(2000 + (uint64_t)i, 250, 0.35)};
    m.g = random_grid(r, shapes_places[1], i & 1 ? 1.5 : 0.3);
    trace_metamorph(&m);
    return m;
}

/* The vectors of `from`, their axes reordered: axis k of the result is sign[k] times axis[k]. */
static metamorph turned(const metamorph *from, const int axis[3], const float sign[3])
{
    metamorph m = {.s = soup_create("turned", from->s.triangle_count)};
    for (size_t i = 0; i < m.s.triangle_count; i++)
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                m.s.triangles[i].v[v][k] = sign[k] * from->s.triangles[i].v[v][axis[k]];
    for (int k = 0; k < 3; k++) {
        m.g.org[k] = sign[k] * from->g.org[axis[k]];
        m.g.first[k] = sign[k] * from->g.first[axis[k]];
        m.g.right[k] = sign[k] * from->g.right[axis[k]];
        m.g.down[k] = sign[k] * from->g.down[axis[k]];
    }
    trace_metamorph(&m);
    return m;
}

/* B4: mirroring changes signs alone, so every bit of t, u and v stays. */
static void b4__mirror_images__same_bits(void **state)
{
    static const int axis[3] = {0, 1, 2};
    base_random r = {20};
    (void)state;
    for (int i = 0; i < 24; i++) {
        metamorph m = metamorph_create(&r, i);
        for (int mirror = 1; mirror < 8; mirror++) {
            const float sign[3] = {mirror & 1 ? -1.0f : 1.0f, mirror & 2 ? -1.0f : 1.0f, mirror & 4 ? -1.0f : 1.0f};
            metamorph n = turned(&m, axis, sign);
            assert_memory_equal(m.frame[1].id, n.frame[1].id, sizeof m.frame[1].id);
            assert_memory_equal(m.frame[1].t, n.frame[1].t, sizeof m.frame[1].t);
            for (int k = 0; k < 256; k++) { /* as numbers: zeros may differ in sign */
                assert_true(m.frame[1].u[k / 16][k % 16] == n.frame[1].u[k / 16][k % 16]);
                assert_true(m.frame[1].v[k / 16][k % 16] == n.frame[1].v[k / 16][k % 16]);
            }
            soup_free(&n.s);
        }
        soup_free(&m.s);
    }
}

/* How far from the edges of one of two triangles a ray passes. */
static double edge_distance(const metamorph *m, uint32_t a, uint32_t b, const float d[3])
{
    const uint32_t ids[2] = {a, b};
    double least = (double)INFINITY;
    for (int k = 0; k < 2; k++)
        if (ids[k] != JOB_NO_HIT) {
            const scene_triangle *t = &m->s.triangles[ids[k]];
            least = fmin(least, exact_edge_distance_ulp(m->g.org, d, t->v[0], t->v[1], t->v[2]));
        }
    return least;
}

/* Turning by right angles changes the order of additions: t may move by rounding, ids at edges alone. */
static void o6__axes_permuted__same_hits(void **state)
{
    static const int axes[5][3] = {{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
    static const float plus[3] = {1, 1, 1};
    base_random r = {21};
    (void)state;
    for (int i = 0; i < 24; i++) {
        metamorph m = metamorph_create(&r, i);
        bvh *tree = trace_tree(&m.s, 2);
        bundle b = bundle_create(kernels[0], tree, 0);
        set_grid(&b, &m.g, 0xffff);
        for (int p = 0; p < 5; p++) {
            metamorph n = turned(&m, axes[p], plus);
            for (unsigned k = 0; k < 256; k++) {
                float d[3], ta = m.frame[1].t[k / 16][k % 16], tb = n.frame[1].t[k / 16][k % 16];
                uint32_t a = m.frame[1].id[k / 16][k % 16], c = n.frame[1].id[k / 16][k % 16];
                bundle_direction(&b, k / 16, k % 16, d);
                if (a != c)
                    assert_true(edge_distance(&m, a, c, d) <= 4);
                else if (a != JOB_NO_HIT) /* 4 units, more where the plane is seen edge-on */
                    assert_true(fabsf(ta - tb) <= 1e-4f * ta);
            }
            soup_free(&n.s);
        }
        bundle_destroy(&b);
        bvh_destroy(&tree);
        soup_free(&m.s);
    }
}

/* A power of two scales everything exactly: t in proportion, u and v to the bit. */
static void o6__scaled_by_powers_of_two__same_bits(void **state)
{
    base_random r = {22};
    (void)state;
    for (int i = 0; i < 24; i++) {
        metamorph m = metamorph_create(&r, i);
        for (int power = -16; power <= 24; power += 8) {
            metamorph n = {.s = soup_create("scaled", m.s.triangle_count), .g = m.g};
            for (size_t k = 0; k < 9 * m.s.triangle_count; k++)
                n.s.triangles[k / 9].v[k % 9 / 3][k % 3] = ldexpf(m.s.triangles[k / 9].v[k % 9 / 3][k % 3], power);
            for (int k = 0; k < 3; k++)
                n.g.org[k] = ldexpf(m.g.org[k], power);
            trace_metamorph(&n);
            assert_memory_equal(m.frame[1].id, n.frame[1].id, sizeof m.frame[1].id);
            assert_memory_equal(m.frame[1].u, n.frame[1].u, sizeof m.frame[1].u);
            assert_memory_equal(m.frame[1].v, n.frame[1].v, sizeof m.frame[1].v);
            for (int k = 0; k < 256; k++)
                assert_true(ldexpf(m.frame[1].t[k / 16][k % 16], power) == n.frame[1].t[k / 16][k % 16]);
            soup_free(&n.s);
        }
        soup_free(&m.s);
    }
}

/* Coordinates of few bits can be moved by a power of two exactly: nothing changes. */
static void o6__moved_by_a_power_of_two__same_bits(void **state)
{
    base_random r = {23};
    (void)state;
    for (int i = 0; i < 24; i++) {
        metamorph m = {.s = soup_random(3000 + (uint64_t)i, 250, 0.35)};
        m.g = random_grid(&r, shapes_places[1], 0.8);
        for (size_t k = 0; k < 9 * m.s.triangle_count; k++) {
            float *x = &m.s.triangles[k / 9].v[k % 9 / 3][k % 3];
            *x = rintf(*x * 1024) / 1024;
        }
        for (int k = 0; k < 3; k++)
            m.g.org[k] = rintf(m.g.org[k] * 1024) / 1024;
        trace_metamorph(&m);
        for (int power = 0; power <= 10; power += 5) {
            metamorph n = {.s = soup_create("moved", m.s.triangle_count), .g = m.g};
            for (size_t k = 0; k < 9 * m.s.triangle_count; k++)
                n.s.triangles[k / 9].v[k % 9 / 3][k % 3] =
                    m.s.triangles[k / 9].v[k % 9 / 3][k % 3] + ldexpf(k % 3 == 1 ? -1 : 1, power);
            for (int k = 0; k < 3; k++)
                n.g.org[k] += ldexpf(k == 1 ? -1 : 1, power);
            trace_metamorph(&n);
            assert_memory_equal(m.frame[1].id, n.frame[1].id, sizeof m.frame[1].id);
            assert_memory_equal(m.frame[1].t, n.frame[1].t, sizeof m.frame[1].t);
            assert_memory_equal(m.frame[1].u, n.frame[1].u, sizeof m.frame[1].u);
            soup_free(&n.s);
        }
        soup_free(&m.s);
    }
}

/* Leaf limits and bins change the tree and the counts, never a hit. */
static void o6__other_trees__same_bits(void **state)
{
    base_random r = {24};
    (void)state;
    for (int i = 0; i < 6; i++) {
        scene s = soup_clustered(4000 + (uint64_t)i, 900);
        double eye[3], target[3], up[3];
        shapes_point(&r, 9, eye);
        shapes_point(&r, 4, target);
        shapes_direction(&r, up);
        scene_camera camera = scene_camera_look_at("other trees", eye, target, up, 1.2);
        trace_picture first = {0};
        for (unsigned leaf = 1; leaf <= 64; leaf *= 4)
            for (unsigned bins = 2; bins <= 32; bins += 10)
                for (int kernel = 0; kernel < 3; kernel++) {
                    bvh_options options = bvh_options_default();
                    bvh *tree = NULL;
                    options.max_leaf = leaf;
                    options.bins = bins;
                    assert_int_equal(bvh_build(&s, &options, &tree, NULL), BASE_OK);
                    trace_request request = {.kernel = kernels[kernel], .tree = tree, .camera = &camera, .width = 70, .height = 50,
                                             .cull = (unsigned)i & 1, .jobs = 1};
                    trace_picture p = trace_run(&request);
                    if (first.pixels == 0)
                        first = p;
                    else {
                        trace_assert_equal(&first, &p, "other trees");
                        trace_free(&p);
                    }
                    bvh_destroy(&tree);
                }
        trace_free(&first);
        soup_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(b4__mirror_images__same_bits),
        cmocka_unit_test(b5__triangles_anywhere__never_lost_mostly_culled),
        cmocka_unit_test(b5__enclosing_the_frustum__kept),
        cmocka_unit_test(b5__between_rays__no_hit_invented),
        cmocka_unit_test(b5__slivers_along_the_frustum__never_lost),
        cmocka_unit_test(b6__edges_through_corner_rays__kept),
        cmocka_unit_test(b6__edges_touching_from_outside__never_lost),
        cmocka_unit_test(b6__through_the_origin__never_lost),
        cmocka_unit_test(b7__generated_rays__within_their_corners),
        cmocka_unit_test(b7__hits_of_corner_rays__found),
        cmocka_unit_test(b8__some_of_16_rays_hit__far_leaf_still_visited),
        cmocka_unit_test(o6__axes_permuted__same_hits),
        cmocka_unit_test(o6__scaled_by_powers_of_two__same_bits),
        cmocka_unit_test(o6__moved_by_a_power_of_two__same_bits),
        cmocka_unit_test(o6__other_trees__same_bits),
    };
    return cmocka_run_group_tests_name("hard frusta", tests, NULL, NULL);
}
