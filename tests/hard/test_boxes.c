/* Hard cases of the box test (algorithms H: X1-X4, A1, B1, B3): single boxes against exact arithmetic (oracle O2). */
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
#include "exact/predicates.h"

static const char *kernels[3] = {"packet16-primary", "mft-primary", "packet256-primary"};

/* A tree whose two leaves share one box, which changes from case to case; the triangles are far from all rays. */
typedef struct box_test {
    bvh *tree;
    bundle packet, frusta, group;
} box_test;

static box_test box_test_create(void)
{
    static const scene_triangle far_away[2] = {{{{8e8f, 8e8f, 8e8f}, {9e8f, 8e8f, 8e8f}, {8e8f, 9e8f, 8e8f}}},
                                               {{{8e8f, 8e8f, 9e8f}, {9e8f, 8e8f, 9e8f}, {8e8f, 9e8f, 9e8f}}}};
    float boxes[2][2][3] = {{{0}}};
    box_test t = {.tree = bundle_pair(far_away, boxes)};
    t.packet = bundle_create(kernels[0], t.tree, 0);
    t.frusta = bundle_create(kernels[1], t.tree, 0);
    t.group = bundle_create(kernels[2], t.tree, 0);
    return t;
}

static void box_test_destroy(box_test *t)
{
    bundle_destroy(&t->packet);
    bundle_destroy(&t->frusta);
    bundle_destroy(&t->group);
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

/* The same for a single ray, in every lane by turns, and in a group of one packet. */
static int ray_meets(box_test *t, const float org[3], const float d[3])
{
    static unsigned lane;
    float all[16][3];
    for (int j = 0; j < 16; j++)
        memcpy(all[j], d, sizeof all[j]);
    lane = (lane + 1) % 16;
    const int met = rays_meet(t, org, all, 1u << lane);
    bundle_rays(&t->group, org, all, 1u << lane);
    assert_int_equal(bundle_trace(&t->group).n[KERNEL_tri_accesses] > 0, met);
    return met;
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

static void x1__zero_components__boxes_met_as_exactly(void **state)
{
    base_random r = {1};
    box_test t = box_test_create();
    (void)state;
    for (int i = 0; i < 20000; i++) {
        shapes_place place = shapes_places[i % SHAPES_PLACES];
        float lo[3], hi[3], org[3], d[3];
        random_box(&r, place, 0, lo, hi);
        shapes_put_point(&r, place, 2, org);
        rays_with_zeros(&r, 1 + (unsigned)i % 6, d);
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
        unsigned zeros = 1 + (unsigned)i % 6;
        random_box(&r, shapes_places[i % SHAPES_PLACES], 0, lo, hi);
        shapes_put_point(&r, shapes_places[i % SHAPES_PLACES], 2, org);
        rays_with_zeros(&r, zeros, d);
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
        rays_with_zeros(&r, (unsigned)base_random_bits(&r) % 7, d);
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
        double to[3];
        random_box(&r, place, 1 + (unsigned)i % 7, lo, hi);
        shapes_put_point(&r, place, 3, org);
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
        random_box(&r, shapes_places[i % SHAPES_PLACES], 0, lo, hi);
        shapes_put_point(&r, shapes_places[i % SHAPES_PLACES], 2, org);
        rays_with_zeros(&r, i & 8 ? 1u << i % 3 | 1u << (i + 1) % 3 : 1u << i % 3, d);
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
        double base[3];
        int exact = 0;
        random_box(&r, place, 0, lo, hi);
        shapes_put_point(&r, place, 2, org);
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
    unsigned f = (unsigned)base_random_bits(r) % 16;
    random_box(r, place, i & 64 ? (unsigned)i % 8 : 0, lo, hi);
    shapes_put_point(r, place, 2, org);
    if (i & 128) /* box face through the origin (B3) */
        org[i % 3] = i & 256 ? lo[i % 3] : hi[i % 3];
    rays_grid(r, width, touch, first, right, down);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(x1__zero_components__boxes_met_as_exactly),
        cmocka_unit_test(x1__zeros_of_either_sign__same_answer),
        cmocka_unit_test(x2__origin_on_a_face__met),
        cmocka_unit_test(x3__origin_inside_edge_or_corner_of_flat_boxes__met),
        cmocka_unit_test(x3__zero_thickness__met_as_exactly),
        cmocka_unit_test(x4__denormal_and_tiny_components__boxes_met_as_exactly),
        cmocka_unit_test(a1__packets_across_axis_planes__met_if_a_ray_does),
        cmocka_unit_test(b1__intervals_hold_or_touch_zero__no_box_lost),
        cmocka_unit_test(b1__any_frusta__no_box_lost),
        cmocka_unit_test(b1__paths__counted_as_the_signs_say),
    };
    return cmocka_run_group_tests_name("hard boxes", tests, NULL, NULL);
}
