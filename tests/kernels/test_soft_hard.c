/* Soft shadows where they are hard: lights edge-on, behind, near, tiny, of no size (B9, B10), rays left over (B11, B13), all blocked at
 * once (A4), and pictures whose shadows have a formula.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/kernels/accel/soup.h"
#include "tests/kernels/trace.h"

enum { SIZE = 32, WAYS = 6 };

/* A ground of 2 triangles at y = 0, up to `reach` from the origin, facing up, and room for others. */
static scene ground(float reach, size_t others)
{
    scene s = soup_create("ground", 2 + others);
    const scene_triangle a = {{{-reach, 0, -reach}, {-reach, 0, reach}, {reach, 0, reach}}};
    const scene_triangle b = {{{-reach, 0, -reach}, {reach, 0, reach}, {reach, 0, -reach}}};
    s.triangles[0] = a;
    s.triangles[1] = b;
    return s;
}

/* A rectangle from (x0, z0) to (x1, z1) at height y, facing up, as triangles i and i + 1. */
static void put_rectangle(scene *s, size_t i, float x0, float z0, float x1, float z1, float y)
{
    const scene_triangle a = {{{x0, y, z0}, {x0, y, z1}, {x1, y, z1}}};
    const scene_triangle b = {{{x0, y, z0}, {x1, y, z1}, {x1, y, z0}}};
    s->triangles[i] = a;
    s->triangles[i + 1] = b;
}

/* A square light around (x, y, z), facing down if width is positive. */
static scene_light square_light(double x, double y, double z, double width)
{
    scene_light light = {.has_area = 1, .corner = {x - width / 2, y, z - fabs(width) / 2}, .u = {width, 0, 0}, .v = {0, 0, fabs(width)}};
    light.point[0] = x;
    light.point[1] = y;
    light.point[2] = z;
    return light;
}

static scene_camera above(void)
{
    static const double eye[3] = {0.013, 3, 0.021}, target[3] = {0.013, 0, 0.02}, up[3] = {0, 0, -1};
    return scene_camera_look_at("above", eye, target, up, 0.6);
}

/* packet16-soft, packet256-soft, then mft-soft with each way to shrink. */
static const char *way_name(int way) { return way > 1 ? "mft-soft" : way ? "packet256-soft" : "packet16-soft"; }

static trace_picture trace_way(int way, const scene *s, const scene_camera *camera, unsigned samples, double light_scale)
{
    const char *name = way_name(way);
    bvh *tree = trace_tree(s, way ? 8 : 2);
    kernel_params params = kernel_find(name)->defaults;
    params.samples = samples;
    params.light_scale = light_scale;
    params.shrink = way > 1 ? (unsigned)way - 2 : 0;
    trace_request request = {.kernel = name, .tree = tree, .camera = camera, .width = SIZE, .height = SIZE, .params = &params,
                             .light = &s->light, .level = LRB_NATIVE, .jobs = 1};
    trace_picture p = trace_run(&request);
    bvh_destroy(&tree);
    return p;
}

/* All ways agree; the picture of the last. */
static trace_picture trace_all(const scene *s, const scene_camera *camera, unsigned samples, double light_scale)
{
    trace_picture first = trace_way(0, s, camera, samples, light_scale), other = {0};
    for (int way = 1; way < WAYS; way++) {
        trace_free(&other);
        other = trace_way(way, s, camera, samples, light_scale);
        trace_assert_equal(&first, &other, way_name(way));
    }
    trace_free(&first);
    return other;
}

static void assert_all_visible(const scene *s, float expected, int rays)
{
    scene_camera camera = above();
    trace_picture p = trace_all(s, &camera, 16, 1);
    for (size_t i = 0; i < p.pixels; i++) {
        assert_int_not_equal(p.id[i], JOB_NO_HIT);
        assert_true(p.visibility[i] == expected);
    }
    assert_int_equal(p.counts.n[KERNEL_rays_shadow], rays ? 16 * SIZE * SIZE : 0);
    trace_free(&p);
}

static void visibility__open_sky__one(void **state)
{
    scene s = ground(10, 0);
    (void)state;
    s.light = square_light(0, 5, 0, 1);
    assert_all_visible(&s, 1, 1);
    soup_free(&s);
}

/* B9, and what the contract says of points that see no light: nothing is traced. */
static void b9__light_behind_or_below__zero_untraced(void **state)
{
    scene s = ground(10, 0);
    (void)state;
    s.light = square_light(0, 5, 0, -1); /* faces up */
    assert_all_visible(&s, 0, 0);
    s.light = square_light(0, -5, 0, -1); /* faces up from below the ground, whose viewer's side is above */
    assert_all_visible(&s, 0, 0);
    s.light = square_light(0, 0, 0, 1); /* in the ground's plane */
    assert_all_visible(&s, 0, 0);
    soup_free(&s);
}

/* The light's plane goes through the points of a line of the ground: on one side it is seen, on the other from behind. */
static void b9__light_edge_on__one_side_only(void **state)
{
    scene s = ground(10, 0);
    scene_camera camera = above();
    (void)state;
    s.light = (scene_light){.has_area = 1, .corner = {0, 1, -1}, .u = {0, 2, 0}, .v = {0, 0, 2}}; /* u x v is +x */
    trace_picture p = trace_all(&s, &camera, 16, 1);
    int seen = 0, behind = 0;
    for (size_t i = 0; i < p.pixels; i++) {
        seen += p.visibility[i] == 1;
        behind += p.visibility[i] == 0;
    }
    assert_true(seen > SIZE * SIZE / 3 && behind > SIZE * SIZE / 3 && seen + behind == SIZE * SIZE);
    trace_free(&p);
    soup_free(&s);
}

static void visibility__no_hit__one(void **state)
{
    scene s = ground(0.2f, 0);
    scene_camera camera = above();
    (void)state;
    s.light = square_light(0, 5, 0, -1); /* what is hit sees nothing of it */
    trace_picture p = trace_all(&s, &camera, 16, 1);
    int missed = 0;
    for (size_t i = 0; i < p.pixels; i++) {
        missed += p.id[i] == JOB_NO_HIT;
        assert_true(p.visibility[i] == (p.id[i] == JOB_NO_HIT ? 1.0f : 0.0f));
    }
    assert_in_range(missed, 1, SIZE * SIZE - 1);
    trace_free(&p);
    soup_free(&s);
}

/* B10: all rays of a pixel are one ray. */
static void b10__tiny_and_no_light__all_or_nothing(void **state)
{
    static const double scales[] = {0, 1e-30, 1e-7};
    scene s = ground(10, 4);
    scene_camera camera = above();
    (void)state;
    put_rectangle(&s, 2, -0.37f, -0.41f, 0.11f, 0.23f, 0.5f);
    put_rectangle(&s, 4, 0.2f, 0.2f, 0.3f, 0.4f, 0.25f);
    s.light = square_light(3, 5, 2, 1);
    for (int i = 0; i < 3; i++) {
        trace_picture p = trace_all(&s, &camera, 16, scales[i]);
        int dark = 0;
        for (size_t k = 0; k < p.pixels; k++) {
            assert_true(p.visibility[k] == 0 || p.visibility[k] == 1);
            dark += p.visibility[k] == 0;
        }
        assert_in_range(dark, 10, SIZE * SIZE - 10);
        trace_free(&p);
    }
    soup_free(&s);
}

/* B10: directions to the corners nearly opposite; every interval holds 0. Nothing is in between. */
static void b10__large_and_near__zero_path(void **state)
{
    scene s = ground(1000, 0);
    scene_camera camera = above();
    (void)state;
    s.light = square_light(0, 3.5, 0, 500);
    assert_all_visible(&s, 1, 1);
    trace_picture p = trace_way(2, &s, &camera, 16, 1);
    assert_true(p.counts.n[KERNEL_units_zero] >= SIZE * SIZE / 16); /* each block's group */
    trace_free(&p);
    soup_free(&s);
}

/* A blocker's edge at half the light's height: the seen fraction is linear in x. */
static void penumbra__straight_edge__as_the_formula(void **state)
{
    static const struct {
        unsigned samples;
        double most;
    } cases[] = {{4, 0.5}, {16, 0.126}, {64, 0.05}, {256, 0.02}, {4096, 0.004}};
    const double width = 0.8, height = 2;
    scene s = ground(10, 2);
    scene_camera camera = above();
    (void)state;
    put_rectangle(&s, 2, -8, -8, 0, 8, (float)height / 2);
    s.light = square_light(0, height, 0, width);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        trace_picture p = trace_all(&s, &camera, cases[c].samples, 1);
        double worst = 0, partly = 0;
        for (size_t i = 0; i < p.pixels; i++) {
            if (p.id[i] > 1)
                continue; /* the blocker, seen from above */
            double x = 0.013 + 3 * tan(0.3) * (2 * ((double)(i % SIZE) + 0.5) / SIZE - 1);
            double exact = fmin(1, fmax(0, (width / 2 + x) / width));
            worst = fmax(worst, fabs(exact - (double)p.visibility[i]));
            partly += p.visibility[i] > 0 && p.visibility[i] < 1;
        }
        print_message("# %u samples: worst %.4f\n", cases[c].samples, worst);
        assert_true(partly > 50);
        assert_true(worst <= cases[c].most);
        trace_free(&p);
    }
    soup_free(&s);
}

/* Four samples are some of the sixteen. */
static void samples__four__those_of_sixteen(void **state)
{
    scene s = ground(10, 2);
    scene_camera camera = above();
    (void)state;
    put_rectangle(&s, 2, -8, -8, 0.1f, 8, 1);
    s.light = square_light(0, 2, 0, 0.8);
    trace_picture four = trace_all(&s, &camera, 4, 1), sixteen = trace_all(&s, &camera, 16, 1);
    assert_int_equal(4 * four.counts.n[KERNEL_rays_shadow], sixteen.counts.n[KERNEL_rays_shadow]);
    for (size_t i = 0; i < four.pixels; i++) {
        uint32_t left_out = four.occlusion[i] & ~sixteen.occlusion[i];
        assert_int_equal(sixteen.occlusion[i] & ~four.occlusion[i], 0);
        assert_true(four.visibility[i] == (float)(16 - __builtin_popcount(four.occlusion[i])) / 4);
        assert_true(sixteen.visibility[i] == (float)(16 - __builtin_popcount(sixteen.occlusion[i])) / 16);
        assert_true(__builtin_popcount(left_out) <= 12);
    }
    trace_free(&four);
    trace_free(&sixteen);
    soup_free(&s);
}

/* B11, B13: bars that leave one column or row of the samples, then fewer, then none; frusta end in different leaves. */
static void b11__bars_one_by_one__all_ways_agree(void **state)
{
    enum { BARS = 40 };
    scene s = ground(10, 2 * BARS);
    scene_camera camera = above();
    (void)state;
    for (int i = 0; i < BARS; i++) {
        float at = -0.6f + 0.03f * (float)i, y = 0.5f + 0.01f * (float)(i * 7 % BARS);
        if (i % 2)
            put_rectangle(&s, 2 + 2 * (size_t)i, at, -0.7f, at + 0.033f, 0.7f, y);
        else
            put_rectangle(&s, 2 + 2 * (size_t)i, -0.7f, at, 0.7f, at + 0.033f, y);
    }
    s.light = square_light(0, 2, 0, 0.8);
    trace_picture p = trace_all(&s, &camera, 16, 1), shrinking = trace_way(3, &s, &camera, 16, 1);
    int by_left[17] = {0};
    for (size_t i = 0; i < p.pixels; i++)
        by_left[16 - __builtin_popcount(p.occlusion[i] & 0xffff)]++;
    assert_true(by_left[0] > 0 && by_left[1] > 0 && by_left[2] > 0);
    assert_true(shrinking.counts.n[KERNEL_additional_tests] >= shrinking.counts.n[KERNEL_additional_tests16]);
    assert_true(shrinking.counts.n[KERNEL_additional_tests16] > 0);
    trace_free(&p);
    trace_free(&shrinking);
    soup_free(&s);
}

/* A4: all rays of a packet, or a block, are blocked by the nearest of many blockers; none of the others is looked at. */
static void a4__all_blocked_at_once__traversal_ends(void **state)
{
    enum { LAYERS = 64 };
    static const double eye[3] = {0.013, 0.4, 0.021}, target[3] = {0.013, 0, 0.02}, up[3] = {0, 0, -1};
    const scene_camera camera = scene_camera_look_at("below the blockers", eye, target, up, 0.6);
    scene s = ground(10, 2 * LAYERS);
    (void)state;
    for (int i = 0; i < LAYERS; i++)
        put_rectangle(&s, 2 + 2 * (size_t)i, -8, -8, 8, 8, 0.5f + 0.05f * (float)i);
    s.light = square_light(0.3, 5, 0.2, 1);
    for (int way = 0; way < WAYS; way++) {
        bvh *tree = trace_tree(&s, way ? 8 : 2);
        trace_request primary = {.kernel = way > 1 ? "mft-primary" : way ? "packet256-primary" : "packet16-primary", .tree = tree,
                                 .camera = &camera, .width = SIZE, .height = SIZE, .level = LRB_NATIVE, .jobs = 1};
        trace_picture before = trace_run(&primary), p = trace_way(way, &s, &camera, 16, 1);
        const uint64_t units = p.counts.n[way ? KERNEL_units_shadow_groups : KERNEL_units_shadow_packets];
        for (size_t i = 0; i < p.pixels; i++)
            assert_true(p.visibility[i] == 0 && p.occlusion[i] == 0xffff);
        assert_true(units > 0);
        /* of a leaf on the way out and of the one that blocks, at most */
        assert_true(p.counts.n[KERNEL_tri_accesses] - before.counts.n[KERNEL_tri_accesses] <= 2 * (way ? 8 : 2) * units);
        trace_free(&before);
        trace_free(&p);
        bvh_destroy(&tree);
    }
    soup_free(&s);
}

/* A surface does not shadow itself: a tilted plane and a light at grazing height (X9). */
static void x9__plane_and_grazing_light__no_acne(void **state)
{
    scene s = ground(10, 0);
    (void)state;
    for (double height = 5; height > 0.02; height /= 2) {
        s.light = square_light(4, height, 1, 0.01);
        assert_all_visible(&s, 1, 1);
    }
    soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(visibility__open_sky__one),
        cmocka_unit_test(b9__light_behind_or_below__zero_untraced),
        cmocka_unit_test(b9__light_edge_on__one_side_only),
        cmocka_unit_test(visibility__no_hit__one),
        cmocka_unit_test(b10__tiny_and_no_light__all_or_nothing),
        cmocka_unit_test(b10__large_and_near__zero_path),
        cmocka_unit_test(penumbra__straight_edge__as_the_formula),
        cmocka_unit_test(samples__four__those_of_sixteen),
        cmocka_unit_test(b11__bars_one_by_one__all_ways_agree),
        cmocka_unit_test(a4__all_blocked_at_once__traversal_ends),
        cmocka_unit_test(x9__plane_and_grazing_light__no_acne),
    };
    return cmocka_run_group_tests_name("soft_hard", tests, NULL, NULL);
}
