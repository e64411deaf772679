/* Skins over limbs: closed, turned outwards, where they should be, and the same however the lattice is cut into blocks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/hash.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/skin.h"

static scene *draw(const scene_limb *limbs, size_t count, double cell)
{
    scene *s = NULL;
    base_error err;
    assert_int_equal(scene_create("skin", &s, &err), BASE_OK);
    scene_mesh m = scene_mesh_begin(s, 1, &err);
    scene_mesh_paint(&m, 1, 1, 1);
    scene_skin_draw(&m, limbs, count, cell, NULL, NULL);
    assert_int_equal(scene_mesh_end(&m, s->triangle_count), BASE_OK);
    assert_true(s->triangle_count > 100);
    return s;
}

static uint64_t vertex_hash(const float v[3], uint64_t start)
{
    return base_hash(start, v, 3 * sizeof *v);
}

/* Every edge is passed as often one way as the other: over all edges, hashes of (from, to) and of (to, from) sum to the same. */
static void assert_closed(const scene *s)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < s->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const float *a = s->triangles[i].v[k], *b = s->triangles[i].v[(k + 1) % 3];
            sum += vertex_hash(b, vertex_hash(a, BASE_HASH_START)) - vertex_hash(a, vertex_hash(b, BASE_HASH_START));
        }
    assert_true(sum == 0);
}

static double volume(const scene *s)
{
    double sum = 0;
    for (size_t i = 0; i < s->triangle_count; i++) {
        double v[3][3];
        for (int k = 0; k < 9; k++)
            v[k / 3][k % 3] = (double)s->triangles[i].v[k / 3][k % 3];
        sum += v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2])
            + v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    }
    return sum / 6;
}

static void skin__capsule__closed_with_its_volume(void **state)
{
    static const scene_joint joints[] = {{{-0.5, 0, 0}, 0.3}, {{0.5, 0, 0}, 0.3}};
    static const scene_limb limb = {joints, 2, 1.0, 0.1, 0, NULL, 0};
    (void)state;
    scene *s = draw(&limb, 1, 0.02);
    assert_closed(s);
    double expected = 3.141592653589793 * 0.09 * (1.0 + 0.4);
    assert_true(fabs(volume(s) / expected - 1) < 0.01);
    for (size_t i = 0; i < s->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const float *v = s->triangles[i].v[k];
            double x = fmax(fabs((double)v[0]) - 0.5, 0), off = sqrt(x * x + (double)(v[1] * v[1]) + (double)(v[2] * v[2]));
            assert_true(fabs(off - 0.3) < 0.01); /* half a cell */
        }
    scene_destroy(&s);
}

static void skin__wide_limb__wide_along_z(void **state)
{
    static const scene_joint joints[] = {{{-0.5, 0, 0}, 0.2}, {{0.5, 0, 0}, 0.2}};
    static const scene_limb limb = {joints, 2, 2.0, 0.1, 0, NULL, 0};
    (void)state;
    scene *s = draw(&limb, 1, 0.02);
    assert_int_equal(scene_finish(s, NULL), BASE_OK);
    assert_closed(s);
    assert_true(fabs(s->bounds_max[2] - 0.4) < 0.01 && fabs(s->bounds_max[1] - 0.2) < 0.01);
    scene_destroy(&s);
}

static double bumps(const scene_skin_place *place)
{
    return 0.03 * scene_noise(scene_point_scale(place->at, 12.0));
}

static const scene_joint cross_bar[] = {{{-0.6, 0.1, 0}, 0.2}, {{0, 0, 0.1}, 0.25}, {{0.6, 0.2, 0}, 0.15}};
static const scene_joint upright[] = {{{0, -0.5, 0}, 0.15}, {{0, 0.5, 0.1}, 0.12}};
static const scene_joint bite[] = {{{0.4, 0.3, 0}, 0.1}, {{0.5, 0.5, 0}, 0.2}};

static void skin__melted_bumpy_and_carved__closed(void **state)
{
    static const scene_limb limbs[] = {{cross_bar, 3, 0.8, 0.1, 0, bumps, 0.03}, {upright, 2, 1.2, 0.2, 0, NULL, 0},
        {bite, 2, 1.0, 0.05, 1, NULL, 0}};
    (void)state;
    scene *all = draw(limbs, 3, 0.013), *uncut = draw(limbs, 2, 0.013), *bar = draw(limbs, 1, 0.013);
    assert_closed(all);
    assert_closed(uncut);
    assert_true(volume(bar) < volume(all) && volume(all) < volume(uncut));
    scene_destroy(&all);
    scene_destroy(&uncut);
    scene_destroy(&bar);
}

/* A limb far away moves nothing near by: which limbs count is decided block by block, and must not show. */
static void skin__far_limb_added__same_triangles_besides_its_own(void **state)
{
    static const scene_joint far[] = {{{5, 0, 0}, 0.2}, {{6, 0, 0}, 0.2}};
    static const scene_limb limbs[] = {{cross_bar, 3, 0.8, 0.1, 0, bumps, 0.03}, {upright, 2, 1.2, 0.2, 0, NULL, 0},
        {far, 2, 1.0, 0.1, 0, NULL, 0}};
    (void)state;
    scene *two = draw(limbs, 2, 0.02), *three = draw(limbs, 3, 0.02);
    size_t at = 0;
    for (size_t i = 0; i < three->triangle_count; i++)
        if ((double)three->triangles[i].v[0][0] < 2.0) {
            assert_true(at < two->triangle_count);
            /* the lattice starts at the bounds, whose y and z ends the far limb does not move */
            assert_memory_equal(&three->triangles[i], &two->triangles[at], sizeof(scene_triangle));
            at++;
        }
    assert_int_equal(at, two->triangle_count);
    scene_destroy(&two);
    scene_destroy(&three);
}

static void around__quarter_turns__whole_numbers(void **state)
{
    (void)state;
    assert_true(scene_skin_around(scene_at(0, 1, 0)) == 0.0);
    assert_true(scene_skin_around(scene_at(0, 0, 1)) == 1.0);
    assert_true(scene_skin_around(scene_at(0, -1, 0)) == 2.0);
    assert_true(scene_skin_around(scene_at(0, 0, -1)) == 3.0);
    assert_true(scene_skin_around(scene_at(0, 1, -1)) == 3.5);
    assert_true(scene_skin_around(scene_at(1, 0, 0)) == 0.0);
}

static void noise__many_places__bounded_smooth_and_uneven(void **state)
{
    double least = 1, most = -1;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        scene_point p = {i * 0.0371, i * 0.0113 - 90.0, 7.0 - i * 0.021};
        double a = scene_noise(p), b = scene_noise(scene_at(p.x + 1e-6, p.y, p.z));
        assert_true(fabs(a) <= 1.0 && fabs(a - b) <= 3.75e-6 * 1.001);
        least = fmin(least, a);
        most = fmax(most, a);
    }
    assert_true(least < -0.7 && most > 0.7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skin__capsule__closed_with_its_volume),
        cmocka_unit_test(skin__wide_limb__wide_along_z),
        cmocka_unit_test(skin__melted_bumpy_and_carved__closed),
        cmocka_unit_test(skin__far_limb_added__same_triangles_besides_its_own),
        cmocka_unit_test(around__quarter_turns__whole_numbers),
        cmocka_unit_test(noise__many_places__bounded_smooth_and_uneven),
    };
    return cmocka_run_group_tests_name("skin", tests, NULL, NULL);
}
