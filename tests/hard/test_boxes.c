/* Hard cases of the box test (algorithms H: X1-X4, X12, X13, A1, A3, A6, B1-B4): single boxes against exact arithmetic
 * (oracle O2), trees against trying every triangle with the same float operations (O3).
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
#include "tests/oracles/exact.h"

static const char *kernels[2] = {"packet16-primary", "mft-primary"};

/* A tree whose two leaves share one box, which changes from case to case; the triangles are far from all rays. */
typedef struct box_test {
    bvh *tree;
    bundle packet, frusta;
} box_test;

static box_test box_test_create(void)
{
    static const scene_triangle far_away[2] = {{{{8e8f, 8e8f, 8e8f}, {9e8f, 8e8f, 8e8f}, {8e8f, 9e8f, 8e8f}}},
                                               {{{8e8f, 8e8f, 9e8f}, {9e8f, 8e8f, 9e8f}, {8e8f, 9e8f, 9e8f}}}};
    float boxes[2][2][3] = {{{0}}};
    box_test t = {.tree = bundle_pair(far_away, boxes)};
    t.packet = bundle_create(kernels[0], t.tree, 0);
    t.frusta = bundle_create(kernels[1], t.tree, 0);
    return t;
}

static void box_test_destroy(box_test *t)
{
    bundle_destroy(&t->packet);
    bundle_destroy(&t->frusta);
    bvh_destroy(&t->tree);
}

static void set_box(box_test *t, const float lo[3], const float hi[3])
{
    for (int child = 2; child < 4; child++) {
        memcpy(t->tree->nodes[child].min, lo, sizeof(float[3]));
        memcpy(t->tree->nodes[child].max, hi, sizeof(float[3]));
    }
}

/* Whether any of the rays in `mask` meets the box. */
static int rays_meet(box_test *t, const float org[3], float d[16][3], unsigned mask)
{
    bundle_rays(&t->packet, org, d, mask);
    return bundle_trace(&t->packet).n[KERNEL_tri_accesses] > 0;
}

/* The same for a single ray, in every lane by turns. */
static int ray_meets(box_test *t, const float org[3], const float d[3])
{
    static unsigned lane;
    float all[16][3];
    for (int j = 0; j < 16; j++)
        memcpy(all[j], d, sizeof all[j]);
    lane = (lane + 1) % 16;
    return rays_meet(t, org, all, 1u << lane);
}

/* The box, larger on all sides by `share` of the distance of its farthest corner from the origin. */
static void grow(const float org[3], const float lo[3], const float hi[3], double share, float out_lo[3], float out_hi[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double far_side = fmax(fabs((double)lo[k] - (double)org[k]), fabs((double)hi[k] - (double)org[k]));
        square += far_side * far_side;
    }
    for (int k = 0; k < 3; k++) {
        out_lo[k] = nextafterf((float)((double)lo[k] - share * sqrt(square)), -INFINITY);
        out_hi[k] = nextafterf((float)((double)hi[k] + share * sqrt(square)), INFINITY);
    }
}

/* Directions are widened by 2^-16 of the longest, which is 1.5 times ours; rounding and this share leave room. */
static const double widening = 0x1p-14;

static void check_ray(box_test *t, const float org[3], const float d[3], const float lo[3], const float hi[3], const char *what)
{
    float big_lo[3], big_hi[3];
    set_box(t, lo, hi);
    int met = ray_meets(t, org, d), exact = exact_ray_box(org, d, lo, hi);
    grow(org, lo, hi, widening, big_lo, big_hi);
    if ((exact && !met) || (met && !exact && !exact_ray_box(org, d, big_lo, big_hi)))
        fail_msg("%s: origin (%a %a %a) direction (%a %a %a) box (%a %a %a) (%a %a %a): %s, exactly %s", what, (double)org[0],
                 (double)org[1], (double)org[2], (double)d[0], (double)d[1], (double)d[2], (double)lo[0], (double)lo[1],
                 (double)lo[2], (double)hi[0], (double)hi[1], (double)hi[2], met ? "met" : "missed", exact ? "met" : "missed");
}

/* A box near the origin of a place; `flat` axes have no thickness. */
static void random_box(base_random *r, shapes_place place, unsigned flat, float lo[3], float hi[3])
{
    double a[3], b[3];
    shapes_point(r, 1, a);
    shapes_point(r, 1, b);
    for (int k = 0; k < 3; k++) {
        double low = fmin(a[k], b[k]), high = flat >> k & 1 ? low : fmax(a[k], b[k]);
        a[k] = low;
        b[k] = high;
    }
    shapes_put(place, a, lo);
    shapes_put(place, b, hi);
}

/* A direction with the components in `zeros` replaced by zeros of random sign. */
static void direction_with_zeros(base_random *r, unsigned zeros, float d[3])
{
    double direction[3];
    shapes_direction(r, direction);
    for (int k = 0; k < 3; k++)
        if (zeros >> k & 1)
            direction[k] = base_random_bits(r) & 1 ? 0.0 : -0.0;
    shapes_scaled(direction, 2.9, d);
}

static void x1__zero_components__boxes_met_as_exactly(void **state)
{
    base_random r = {1};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 20000; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        float lo[3], hi[3], org[3], d[3];
        double o[3];
        random_box(&r, place, 0, lo, hi);
        shapes_point(&r, 2, o);
        shapes_put(place, o, org);
        direction_with_zeros(&r, 1 + (unsigned)i % 6, d);
        check_ray(&t, org, d, lo, hi, "x1");
    }
    box_test_destroy(&t);
}

static void x1__zeros_of_either_sign__same_answer(void **state)
{
    base_random r = {2};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 20000; i++) {
        float lo[3], hi[3], org[3], d[3];
        double o[3];
        unsigned zeros = 1 + (unsigned)i % 6;
        random_box(&r, shapes_places[i % SHAPES_PLACES], 0, lo, hi);
        shapes_point(&r, 2, o);
        shapes_put(shapes_places[i % SHAPES_PLACES], o, org);
        direction_with_zeros(&r, zeros, d);
        set_box(&t, lo, hi);
        int met = ray_meets(&t, org, d);
        for (int k = 0; k < 3; k++)
            if (zeros >> k & 1)
                d[k] = -d[k];
        assert_int_equal(ray_meets(&t, org, d), met);
    }
    box_test_destroy(&t);
}

/* X2, X3, B3: the origin on a face, an edge or a corner of the box, or inside, and any direction: closed boxes are met
   where the ray touches them. */
static void check_origin_at_box(unsigned flat, uint64_t seed, const char *what)
{
    base_random r = {seed};
    box_test t = box_test_create();
    for (int i = 0; i < 20000; i++) {
        float lo[3], hi[3], org[3], d[3];
        random_box(&r, shapes_places[i % SHAPES_PLACES], flat, lo, hi);
        for (int k = 0; k < 3; k++)
            switch (base_random_bits(&r) % 3) {
            case 0: org[k] = lo[k]; break;
            case 1: org[k] = hi[k]; break;
            default: org[k] = (float)base_random_range(&r, (double)lo[k], (double)hi[k]); break;
            }
        direction_with_zeros(&r, (unsigned)base_random_bits(&r) % 7, d);
        check_ray(&t, org, d, lo, hi, what);
        assert_true(exact_ray_box(org, d, lo, hi)); /* which makes the answer 'met' */
    }
    box_test_destroy(&t);
}

static void x2__origin_on_a_face__met(void **state)
{
    (void)state;
    check_origin_at_box(0, 3, "x2");
}

static void x3__origin_inside_edge_or_corner_of_flat_boxes__met(void **state)
{
    (void)state;
    for (unsigned flat = 1; flat < 8; flat++)
        check_origin_at_box(flat, 4 + flat, "x3");
}

/* Flat boxes from outside: aimed at a point of the box, and past it. */
static void x3__zero_thickness__met_as_exactly(void **state)
{
    base_random r = {20};
    box_test t = box_test_create();
    unsigned met = 0;
    (void)state;
    for (int i = 0; i < 40000; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        float lo[3], hi[3], org[3], d[3];
        double o[3], to[3];
        random_box(&r, place, 1 + (unsigned)i % 7, lo, hi);
        shapes_point(&r, 3, o);
        shapes_put(place, o, org);
        for (int k = 0; k < 3; k++)
            to[k] = base_random_range(&r, (double)lo[k], (double)hi[k] + (i & 1 ? place.scale * 1e-3 : 0)) - (double)org[k];
        if (to[0] == 0 && to[1] == 0 && to[2] == 0)
            continue;
        shapes_scaled(to, 2.9, d);
        check_ray(&t, org, d, lo, hi, "x3");
        met += (unsigned)exact_ray_box(org, d, lo, hi);
    }
    assert_true(met > 100);
    box_test_destroy(&t);
}

static void x4__denormal_and_tiny_components__boxes_met_as_exactly(void **state)
{
    static const float tiny[] = {0x1p-149f, -0x1p-149f, 0x1p-130f, -0x1p-127f, 0x1p-126f, 1e-30f, -1e-20f, 1e-18f, -1e-17f, 1e-8f};
    base_random r = {30};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 20000; i++) {
        float lo[3], hi[3], org[3], d[3];
        double o[3];
        random_box(&r, shapes_places[i % SHAPES_PLACES], 0, lo, hi);
        shapes_point(&r, 2, o);
        shapes_put(shapes_places[i % SHAPES_PLACES], o, org);
        direction_with_zeros(&r, i & 8 ? 1u << i % 3 | 1u << (i + 1) % 3 : 1u << i % 3, d);
        for (int k = 0; k < (i & 8 ? 2 : 1); k++)
            d[(i + k) % 3] = tiny[base_random_bits(&r) % (sizeof tiny / sizeof *tiny)];
        check_ray(&t, org, d, lo, hi, "x4");
    }
    box_test_destroy(&t);
}

/* Any sixteen rays: the packet enters the box if one of them does. Signs agree, differ, or are undecided. */
static void a1__packets_across_axis_planes__met_if_a_ray_does(void **state)
{
    base_random r = {40};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 20000; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        float lo[3], hi[3], org[3], d[16][3];
        double o[3], base[3];
        int exact = 0;
        random_box(&r, place, 0, lo, hi);
        shapes_point(&r, 2, o);
        shapes_put(place, o, org);
        shapes_direction(&r, base);
        base[i % 3] *= 0.01; /* close to an axis plane */
        for (int j = 0; j < 16; j++) {
            double p[3];
            shapes_point(&r, i & 1 ? 0.05 : 1, p);
            for (int k = 0; k < 3; k++)
                p[k] += base[k];
            shapes_scaled(p, 2.9, d[j]);
            exact |= exact_ray_box(org, d[j], lo, hi);
        }
        set_box(&t, lo, hi);
        if (exact && !rays_meet(&t, org, d, 0xffff))
            fail_msg("case %d: box (%a %a %a) (%a %a %a) lost from (%a %a %a)", i, (double)lo[0], (double)lo[1], (double)lo[2],
                     (double)hi[0], (double)hi[1], (double)hi[2], (double)org[0], (double)org[1], (double)org[2]);
    }
    box_test_destroy(&t);
}

/* ---- groups of frusta ---- */

/* A random grid of directions; `touch` makes components 0 at a pixel, so that intervals end there, or hold it. */
static void random_grid(base_random *r, double width, int touch, float first[3], float right[3], float down[3])
{
    double f[3], u[3], v[3], spin = base_random_range(r, 0.3, 1.7);
    shapes_direction(r, f);
    shapes_frame(f, u, v);
    for (int k = 0; k < 3; k++) {
        double a = (u[k] * spin + v[k] * 0.3) * width / 16, b = (v[k] * spin - u[k] * 0.2) * width / 16;
        right[k] = (float)a;
        down[k] = (float)b;
        first[k] = (float)(f[k] - 8 * a - 8 * b);
    }
    for (int k = 0; k < 3 && touch; k++)
        if (touch >> k & 1) { /* exactly 0 at the first ray of a block, all along a column or row */
            int n = 4 * (int)(base_random_bits(r) % 4) + (base_random_bits(r) & 1 ? 3 : 0);
            right[k] = base_random_bits(r) & 1 ? 0x1p-6f : -0x1p-6f;
            down[k] = 0.0f;
            first[k] = -(float)n * right[k];
        }
}

static void frustum_corners(const bundle *b, unsigned f, float corner[4][3])
{
    static const unsigned pixel[4] = {0, 3, 15, 12};
    for (int k = 0; k < 4; k++)
        bundle_direction(b, f, pixel[k], corner[k]);
}

static void check_frusta(box_test *t, base_random *r, int i, double width, int touch)
{
    shapes_place place = shapes_places[i % SHAPES_PLACES];
    float lo[3], hi[3], org[3], first[3], right[3], down[3], corner[4][3], big_lo[3], big_hi[3];
    double o[3];
    unsigned f = (unsigned)base_random_bits(r) % 16;
    random_box(r, place, i & 64 ? (unsigned)i % 8 : 0, lo, hi);
    shapes_point(r, 2, o);
    shapes_put(place, o, org);
    if (i & 128) /* box face through the origin (B3) */
        org[i % 3] = i & 256 ? lo[i % 3] : hi[i % 3];
    random_grid(r, width, touch, first, right, down);
    set_box(t, lo, hi);
    bundle_grid(&t->frusta, org, first, right, down, 1u << f);
    int met = bundle_trace(&t->frusta).n[KERNEL_tri_accesses] > 0;
    frustum_corners(&t->frusta, f, corner);
    grow(org, lo, hi, widening, big_lo, big_hi);
    if (!met && exact_cone_box(org, (const float(*)[3])corner, lo, hi))
        fail_msg("case %d: frustum %u loses box (%a %a %a) (%a %a %a) from (%a %a %a)", i, f, (double)lo[0], (double)lo[1],
                 (double)lo[2], (double)hi[0], (double)hi[1], (double)hi[2], (double)org[0], (double)org[1], (double)org[2]);
}

static void b1__intervals_hold_or_touch_zero__no_box_lost(void **state)
{
    base_random r = {50};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 6000; i++)
        check_frusta(&t, &r, i, i & 1 ? 0.3 : 2, 1 + i % 7);
    box_test_destroy(&t);
}

static void b1__any_frusta__no_box_lost(void **state)
{
    base_random r = {51};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 6000; i++)
        check_frusta(&t, &r, i, i & 1 ? 0.02 : 1, 0);
    box_test_destroy(&t);
}

/* The path taken is the one for the signs at hand: all three occur, and are counted. */
static void b1__paths__counted_as_the_signs_say(void **state)
{
    static const float forward[3] = {0.5f, 0.4f, -1}, across[3] = {-0.6f, 0.4f, -1}, right[3] = {0.08f, 0, 0}, tiny_right[3] = {0.01f, 0, 0},
                       down[3] = {0, -0.01f, 0}, org[3] = {0, 0, 0}, wide_down[3] = {0, -0.08f, 0};
    box_test t = box_test_create();
    (void)state;
    bundle_grid(&t.frusta, org, forward, tiny_right, down, 0xffff);
    kernel_counts n = bundle_trace(&t.frusta);
    assert_int_equal(n.n[KERNEL_units_common], 1);
    bundle_grid(&t.frusta, org, across, right, down, 0x9999); /* the columns left and right of the change of sign */
    n = bundle_trace(&t.frusta);
    assert_int_equal(n.n[KERNEL_units_blend], 1);
    bundle_grid(&t.frusta, org, across, right, wide_down, 0xffff);
    n = bundle_trace(&t.frusta);
    assert_int_equal(n.n[KERNEL_units_zero], 1);
    assert_int_equal(n.n[KERNEL_units_common] + n.n[KERNEL_units_blend], 0);
    box_test_destroy(&t);
}

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
        double o[3];
        shapes_point(&r, 1.5, o);
        shapes_put(shapes_places[1], o, org);
        random_grid(&r, 2, i % 8, first, right, down);
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

/* ---- whole trees, any rays ---- */

/* Sixteen rays in random directions, some exactly along axes, some equal. */
static void wild_rays(base_random *r, float d[16][3])
{
    for (int j = 0; j < 16; j++) {
        direction_with_zeros(r, base_random_bits(r) % 4 == 0 ? (unsigned)base_random_bits(r) % 7 : 0, d[j]);
        if (j > 0 && base_random_bits(r) % 8 == 0)
            memcpy(d[j], d[j - 1], sizeof d[j]);
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
                double o[3];
                shapes_point(&r, 1.5, o);
                shapes_put(place, o, org);
                wild_rays(&r, d);
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
        double o[3];
        shapes_point(&r, 1.5, o);
        shapes_put(shapes_places[1], o, org);
        direction_with_zeros(&r, i % 3 ? 0 : (unsigned)i % 7, d[0]);
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
            double o[3];
            shapes_point(&r, 8, o);
            shapes_put(shapes_places[1], o, org);
            wild_rays(&r, d);
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
        double o[3];
        unsigned mask = (unsigned)base_random_bits(&r) & 0xffff, turn = (unsigned)base_random_bits(&r) % 16;
        shapes_point(&r, 1.5, o);
        shapes_put(shapes_places[1], o, org);
        wild_rays(&r, d);
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
        double o[3];
        unsigned columns = 1 + (unsigned)i % 3, mask = 0;
        for (unsigned f = 0; f < 16; f++)
            mask |= ((f & 3) < columns ? 1u : 0u) << f;
        shapes_point(&r, 1.5, o);
        shapes_put(shapes_places[1], o, org);
        random_grid(&r, 0.7, i % 8, first, right, down);
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
        double o[3];
        unsigned bad = (unsigned)base_random_bits(&r) % 16;
        shapes_point(&r, 1.5, o);
        shapes_put(shapes_places[1], o, org);
        wild_rays(&r, d);
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
        cmocka_unit_test(x1__zero_components__boxes_met_as_exactly),
        cmocka_unit_test(x1__zeros_of_either_sign__same_answer),
        cmocka_unit_test(x2__origin_on_a_face__met),
        cmocka_unit_test(x3__origin_inside_edge_or_corner_of_flat_boxes__met),
        cmocka_unit_test(x3__zero_thickness__met_as_exactly),
        cmocka_unit_test(x4__denormal_and_tiny_components__boxes_met_as_exactly),
        cmocka_unit_test(x11__rays_with_nan__miss),
        cmocka_unit_test(x12__inactive_lanes_hold_garbage__active_ones_unchanged),
        cmocka_unit_test(x12__inactive_frusta_hold_garbage__active_ones_unchanged),
        cmocka_unit_test(x13__estimated_reciprocals__hits_of_trying_all_triangles),
        cmocka_unit_test(a1__packets_across_axis_planes__met_if_a_ray_does),
        cmocka_unit_test(a3__identical_rays__as_one_ray),
        cmocka_unit_test(a6__children_exchanged__same_hits),
        cmocka_unit_test(b1__intervals_hold_or_touch_zero__no_box_lost),
        cmocka_unit_test(b1__any_frusta__no_box_lost),
        cmocka_unit_test(b1__paths__counted_as_the_signs_say),
        cmocka_unit_test(b2__frusta_of_unlike_signs__each_as_alone),
    };
    return cmocka_run_group_tests_name("hard boxes", tests, NULL, NULL);
}
