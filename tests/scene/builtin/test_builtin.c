/* The scenes made by code: exact counts, sound triangles, the same bits everywhere, a camera that sees the thing.
 *
 * usage: test_builtin [SCENE...]: the scenes of that name, or those of fewer than a million triangles.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/builtin.h"
#include "scene/scene.h"

/* What every compiler and optimisation level must build. A new hash is a change for CHANGELOG 'Changed numbers'. */
static const struct expected {
    const char *name;
    size_t triangles;
    uint64_t hash;
    unsigned seen; /* at least that percentage of the camera's rays hits something; outdoors there is sky */
} expected[] = {
    {"rooms-804", 804, UINT64_C(0x8fe28849133d2254), 95},
    {"hall-60k", 60000, UINT64_C(0xc251bfa60df1c820), 95},
    {"creature-69k", 69000, UINT64_C(0xf5a2dbd4a588a9d1), 60},
    {"atrium-76k", 76000, UINT64_C(0x06057a9b1c1354e5), 95},
    {"forest-174k", 174000, UINT64_C(0xa15dbab5a1d6d9b1), 75},
    {"fern-212k", 212000, UINT64_C(0xba6fb8b2ad08bcee), 80},
    {"conference-282k", 282000, UINT64_C(0x677003a2b76771d5), 95},
    {"tower-2195k", 2195000, UINT64_C(0x420920bd89beb00f), 95},
    {"dragon-7m", 7218906, UINT64_C(0x5e7ecc70ae98b18c), 60},
};
enum { SCENES = sizeof expected / sizeof *expected };

/* Those under test, opened once for all tests. */
static const struct expected *chosen[SCENES];
static scene *opened[SCENES];
static size_t chosen_count;

/* Rays a side: every ray is tried against every triangle, so fewer for large scenes. */
static unsigned grid_of(const struct expected *e)
{
    return e->triangles < 100000 ? 64 : 24;
}

static scene *open_scene(const char *name)
{
    char spec[64] = "builtin:";
    strcat(spec, name);
    scene *s = NULL;
    base_error err;
    if (scene_open(spec, &s, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return s;
}

static void edge(const float a[3], const float b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (double)b[k] - (double)a[k];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Moeller-Trumbore in double; the parameter of the hit, or infinity. *front tells whether the ray meets the front. */
static double hit_triangle(const scene_triangle *t, const double origin[3], const double d[3], int *front)
{
    double e1[3], e2[3], p[3], q[3], to[3];
    edge(t->v[0], t->v[1], e1);
    edge(t->v[0], t->v[2], e2);
    cross(d, e2, p);
    double det = dot(e1, p);
    if (det == 0.0)
        return HUGE_VAL;
    for (int k = 0; k < 3; k++)
        to[k] = origin[k] - (double)t->v[0][k];
    double u = dot(to, p) / det;
    if (u < 0.0 || u > 1.0)
        return HUGE_VAL;
    cross(to, e1, q);
    double v = dot(d, q) / det, at = dot(e2, q) / det;
    if (v < 0.0 || u + v > 1.0 || at <= 0.0)
        return HUGE_VAL;
    *front = det > 0.0;
    return at;
}

/* The nearest of `count` triangles on a ray, or infinity. */
static double nearest(const scene_triangle *triangles, size_t count, const double origin[3], const double d[3],
    int *front)
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        int side = 0;
        double at = hit_triangle(&triangles[i], origin, d, &side);
        if (at < best) {
            best = at;
            *front = side;
        }
    }
    return best;
}

/* The triangles that meet the plane through `origin` along a and b, in which all rays of one row lie; their number. */
static size_t meeting_plane(const scene *s, const double origin[3], const double a[3], const double b[3],
    scene_triangle *out)
{
    double normal[3];
    size_t count = 0;
    cross(a, b, normal);
    for (size_t i = 0; i < s->triangle_count; i++) {
        int above = 0, below = 0;
        for (int j = 0; j < 3; j++) {
            double to[3];
            for (int k = 0; k < 3; k++)
                to[k] = (double)s->triangles[i].v[j][k] - origin[k];
            double side = dot(normal, to);
            above += side > 1e-9; /* generous: rounding must not lose a triangle */
            below += side < -1e-9;
        }
        if (above < 3 && below < 3)
            out[count++] = s->triangles[i];
    }
    return count;
}

static int blocked(const scene *s, const double a[3], const double b[3])
{
    double d[3];
    for (int k = 0; k < 3; k++)
        d[k] = b[k] - a[k];
    for (size_t i = 0; i < s->triangle_count; i++) {
        int side;
        if (hit_triangle(&s->triangles[i], a, d, &side) < 1.0 - 1e-6)
            return 1;
    }
    return 0;
}

static void list__all_scenes__named_counted_and_found(void **state)
{
    (void)state;
    size_t count;
    const scene_builtin *list = scene_builtin_list(&count);
    assert_int_equal(count, SCENES);
    for (size_t i = 0; i < count; i++) {
        assert_string_equal(list[i].name, expected[i].name);
        assert_int_equal(list[i].triangle_count, expected[i].triangles);
        assert_ptr_equal(scene_builtin_find(list[i].name), &list[i]);
        assert_true(strlen(list[i].summary) > 0 && strlen(list[i].stands_for) > 0);
    }
    assert_null(scene_builtin_find("rooms"));
    assert_null(scene_builtin_find(""));
}

static void build__every_scene__exact_count_and_hash_twice(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++) {
        scene *again = open_scene(chosen[i]->name);
        assert_int_equal(again->triangle_count, chosen[i]->triangles);
        assert_int_equal(opened[i]->triangle_count, chosen[i]->triangles);
        assert_true(again->hash == opened[i]->hash);
        if (again->hash != chosen[i]->hash)
            fail_msg("%s: hash 0x%016llx", chosen[i]->name, (unsigned long long)again->hash);
        scene_destroy(&again);
    }
}

static void build__scene_already_holding_a_triangle__count_is_refused(void **state)
{
    (void)state;
    static const scene_triangle extra = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    for (size_t i = 0; i < chosen_count; i++) {
        scene *s = NULL;
        base_error err;
        uint32_t material;
        assert_int_equal(scene_create(chosen[i]->name, &s, &err), BASE_OK);
        assert_int_equal(scene_add_material(s, (scene_material){{1, 1, 1}}, &material, &err), BASE_OK);
        assert_int_equal(scene_add_triangles(s, &extra, 1, material, &err), BASE_OK);
        assert_int_equal(scene_builtin_find(chosen[i]->name)->build(s, &err), BASE_ERR_UNSUPPORTED);
        assert_string_equal(err.what, chosen[i]->name);
        scene_destroy(&s);
    }
}

static void triangles__every_scene__finite_with_area_and_material(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++) {
        const scene *s = opened[i];
        for (size_t t = 0; t < s->triangle_count; t++) {
            const scene_triangle *tri = &s->triangles[t];
            double e1[3], e2[3], normal[3];
            for (int k = 0; k < 9; k++)
                assert_true(isfinite(tri->v[k / 3][k % 3]));
            edge(tri->v[0], tri->v[1], e1);
            edge(tri->v[0], tri->v[2], e2);
            cross(e1, e2, normal);
            /* 1e-10 m2 is a hundredth of a millimetre squared: far above rounding of these coordinates */
            if (!(sqrt(dot(normal, normal)) / 2 > 1e-10))
                fail_msg("%s: triangle %zu has area %g", chosen[i]->name, t, sqrt(dot(normal, normal)) / 2);
            assert_true(s->triangle_material[t] < s->material_count);
        }
        for (size_t k = 0; k < s->material_count; k++)
            for (int c = 0; c < 3; c++)
                assert_true(s->materials[k].base_color[c] >= 0.0F && s->materials[k].base_color[c] <= 1.0F);
    }
}

static void camera__grid_of_rays__sees_fronts_nearly_everywhere(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++) {
        const scene *s = opened[i];
        const scene_camera *camera = NULL;
        unsigned grid = grid_of(chosen[i]);
        assert_int_equal(scene_find_camera(s, "main", &camera, NULL), BASE_OK);
        scene_primary_rays rays = scene_camera_rays(camera, grid, grid);
        double origin[3], least = HUGE_VAL;
        unsigned hits = 0, fronts = 0;
        for (int k = 0; k < 3; k++)
            origin[k] = (double)rays.origin[k];
        scene_triangle *row = malloc(s->triangle_count * sizeof *row);
        assert_non_null(row);
        for (unsigned y = 0; y < grid; y++) {
            double first[3], step[3];
            for (int k = 0; k < 3; k++) {
                first[k] = (double)rays.d00[k] + y * (double)rays.dy[k];
                step[k] = (double)rays.dx[k];
            }
            size_t count = meeting_plane(s, origin, first, step, row);
            for (unsigned x = 0; x < grid; x++) {
                double d[3] = {first[0] + x * step[0], first[1] + x * step[1], first[2] + x * step[2]};
                int front = 0;
                double at = nearest(row, count, origin, d, &front);
                hits += at < HUGE_VAL;
                fronts += at < HUGE_VAL && front;
                least = at < least ? at : least;
            }
        }
        free(row);
        assert_true(hits * 100 >= chosen[i]->seen * grid * grid);
        assert_true(fronts * 100 >= 99 * hits); /* gaps between turned legs show a back here and there */
        assert_true(least > 0.3);               /* not with its nose in a wall */
    }
}

static void light__from_what_the_camera_sees__free_and_facing_down(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++) {
        const scene *s = opened[i];
        double down[3], centre[3], origin[3];
        assert_true(s->light.has_area);
        cross(s->light.u, s->light.v, down);
        assert_true(down[1] < 0 && down[0] == 0 && down[2] == 0);
        for (int k = 0; k < 3; k++) {
            centre[k] = s->light.corner[k] + 0.5 * s->light.u[k] + 0.5 * s->light.v[k];
            assert_true(centre[k] > s->bounds_min[k] && (k == 1 || centre[k] < s->bounds_max[k]));
        }
        unsigned grid = chosen[i]->triangles < 100000 ? 16 : 8, lit = 0, seen = 0;
        scene_primary_rays rays = scene_camera_rays(&s->cameras[0], grid, grid);
        for (int k = 0; k < 3; k++)
            origin[k] = (double)rays.origin[k];
        for (unsigned n = 0; n < grid * grid; n++) {
            double d[3], point[3];
            int front = 0;
            for (int k = 0; k < 3; k++)
                d[k] = (double)rays.d00[k] + n % grid * (double)rays.dx[k] + n / grid * (double)rays.dy[k];
            double at = nearest(s->triangles, s->triangle_count, origin, d, &front);
            if (at == HUGE_VAL)
                continue;
            seen++;
            for (int k = 0; k < 3; k++) /* a millimetre short of the surface */
                point[k] = origin[k] + (at - 0.001) * d[k];
            lit += point[1] < centre[1] && !blocked(s, point, centre);
        }
        assert_true(lit * 10 >= seen * 3);
    }
}

static int open_all(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++)
        opened[i] = open_scene(chosen[i]->name);
    return 0;
}

static int close_all(void **state)
{
    (void)state;
    for (size_t i = 0; i < chosen_count; i++)
        scene_destroy(&opened[i]);
    return 0;
}

static int wanted(const struct expected *e, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], e->name) == 0)
            return 1;
    return argc <= 1 && e->triangles < 1000000;
}

int main(int argc, char **argv)
{
    for (size_t i = 0; i < SCENES; i++)
        if (wanted(&expected[i], argc, argv))
            chosen[chosen_count++] = &expected[i];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(list__all_scenes__named_counted_and_found),
        cmocka_unit_test(build__every_scene__exact_count_and_hash_twice),
        cmocka_unit_test(build__scene_already_holding_a_triangle__count_is_refused),
        cmocka_unit_test(triangles__every_scene__finite_with_area_and_material),
        cmocka_unit_test(camera__grid_of_rays__sees_fronts_nearly_everywhere),
        cmocka_unit_test(light__from_what_the_camera_sees__free_and_facing_down),
    };
    return cmocka_run_group_tests_name("builtin", tests, open_all, close_all);
}
