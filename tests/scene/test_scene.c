#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "tests/scene/near.h"

static const scene_triangle unit = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

static scene *empty_scene(void)
{
    scene *s;
    assert_int_equal(scene_create("test", &s, NULL), BASE_OK);
    return s;
}

/* One triangle, one material. */
static scene *one_triangle(const scene_triangle *triangle)
{
    scene *s = empty_scene();
    uint32_t material;
    assert_int_equal(scene_add_material(s, (scene_material){{0.5f, 0.25f, 1}}, &material, NULL), BASE_OK);
    assert_int_equal(material, 0);
    assert_int_equal(scene_add_triangles(s, triangle, 1, material, NULL), BASE_OK);
    return s;
}

static void create__long_name__cut(void **state)
{
    (void)state;
    char name[300];
    scene *s;
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_int_equal(scene_create(name, &s, NULL), BASE_OK);
    assert_int_equal(strlen(s->name), sizeof s->name - 1);
    scene_destroy(&s);
    assert_null(s);
    scene_destroy(&s);
    scene_destroy(NULL);
}

static void add__many_small_batches__order_and_materials_kept(void **state)
{
    (void)state;
    scene *s = empty_scene();
    scene_triangle batch[7];
    size_t added = 0;
    for (uint32_t m = 0; m < 100; m++) {
        uint32_t index;
        assert_int_equal(scene_add_material(s, (scene_material){{(float)m / 100, 0, 0}}, &index, NULL), BASE_OK);
        assert_int_equal(index, m);
        for (size_t i = 0; i < m % 8; i++, added++) {
            batch[i] = unit;
            batch[i].v[0][2] = (float)added;
        }
        assert_int_equal(scene_add_triangles(s, batch, m % 8, m, NULL), BASE_OK);
    }
    assert_int_equal(s->triangle_count, added);
    for (size_t i = 0; i < added; i++) {
        assert_true(s->triangles[i].v[0][2] == (float)i);
        if (i > 0)
            assert_true(s->triangle_material[i] >= s->triangle_material[i - 1]);
    }
    assert_int_equal(s->triangle_material[0], 1);
    assert_int_equal(s->triangle_material[added - 1], 99);
    assert_true(s->materials[42].base_color[0] == 0.42f);
    scene_destroy(&s);
}

static void add__unknown_material_or_too_many__refused_unchanged(void **state)
{
    (void)state;
    base_error err;
    scene *s = one_triangle(&unit);
    assert_int_equal(scene_add_triangles(s, &unit, 1, 1, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "material 1"));
    assert_int_equal(scene_add_triangles(s, &unit, SCENE_MAX_TRIANGLES, 0, &err), BASE_ERR_INPUT);
    assert_non_null(strstr(err.why, "more than"));
    assert_int_equal(s->triangle_count, 1);
    scene_destroy(&s);
}

static void finish__plain_triangle__bounds_camera_light(void **state)
{
    (void)state;
    scene *s = one_triangle(&unit);
    assert_int_equal(scene_finish(s, NULL), BASE_OK);
    assert_true(s->bounds_min[0] == 0 && s->bounds_min[1] == 0 && s->bounds_min[2] == 0);
    assert_true(s->bounds_max[0] == 1 && s->bounds_max[1] == 1 && s->bounds_max[2] == 0);
    assert_int_equal(s->camera_count, 1);
    assert_string_equal(s->cameras[0].name, "default");
    assert_near(s->light.u[0], sqrt(2.0) / 10, 1e-15);
    assert_near(s->light.point[1], 0.5 + sqrt(2.0) / 4, 1e-15);
    scene_destroy(&s);
}

static void finish__same_scene__same_hash_on_every_host(void **state)
{
    (void)state;
    scene *s = one_triangle(&unit);
    s->light = (scene_light){.has_area = 1, .corner = {1, 5, 2}, .u = {2, 0, 0}, .v = {0, 0, 4}};
    const double eye[3] = {0, 0, 2}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    assert_int_equal(scene_add_camera(s, scene_camera_look_at("eye", eye, target, up, 1), NULL), BASE_OK);
    assert_int_equal(scene_finish(s, NULL), BASE_OK);
    assert_true(s->hash == UINT64_C(0x22cb142e3b1491ad)); /* by a program of its own, from the layout in scene.c */
    scene_destroy(&s);
}

/* Hash of the one-triangle scene after a change. */
static uint64_t hash_with(void (*change)(scene *s))
{
    scene *s = one_triangle(&unit);
    if (change)
        change(s);
    assert_int_equal(scene_finish(s, NULL), BASE_OK);
    uint64_t hash = s->hash;
    scene_destroy(&s);
    return hash;
}

static void rename_scene(scene *s) { strcpy(s->name, "other"); }
static void move_vertex(scene *s) { s->triangles[0].v[1][1] = 0x1p-20f; }
static void change_color(scene *s) { s->materials[0].base_color[2] = 0.75f; }
static void point_light(scene *s) { s->light.has_point = 1; }
static void add_camera(scene *s)
{
    const double low[3] = {0, 0, 0}, high[3] = {1, 2, 3};
    assert_int_equal(scene_add_camera(s, scene_camera_framing(low, high), NULL), BASE_OK);
}
static void add_material(scene *s)
{
    uint32_t index;
    assert_int_equal(scene_add_material(s, (scene_material){{1, 1, 1}}, &index, NULL), BASE_OK);
}

static void finish__each_change__changes_the_hash_but_the_name_does_not(void **state)
{
    (void)state;
    void (*const changes[])(scene *) = {move_vertex, change_color, point_light, add_camera, add_material};
    uint64_t plain = hash_with(NULL);
    assert_true(hash_with(NULL) == plain);
    assert_true(hash_with(rename_scene) == plain);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        assert_true(hash_with(changes[i]) != plain);
}

static void assert_finish_fails(scene_triangle second, const char *why)
{
    base_error err;
    scene *s = one_triangle(&unit);
    assert_int_equal(scene_add_triangles(s, &second, 1, 0, NULL), BASE_OK);
    assert_int_equal(scene_finish(s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "test");
    assert_string_equal(err.why, why);
    scene_destroy(&s);
}

static void finish__bad_vertex__triangle_named(void **state)
{
    (void)state;
    scene_triangle t = unit;
    t.v[2][1] = NAN;
    assert_finish_fails(t, "triangle 1: vertex is NaN");
    t.v[2][1] = -INFINITY;
    assert_finish_fails(t, "triangle 1: vertex is infinite");
    t.v[2][1] = -2e9f;
    assert_finish_fails(t, "triangle 1: coordinate -2e+09 is beyond 1e+09");
}

static void finish__largest_coordinates__float_normals_stay_finite(void **state)
{
    (void)state;
    const float c = (float)SCENE_MAX_COORDINATE;
    const scene_triangle t = {{{-c, -c, -c}, {c, c, -c}, {-c, c, c}}};
    scene *s = one_triangle(&t);
    assert_int_equal(scene_finish(s, NULL), BASE_OK);
    float a[3], b[3], n[3], squared = 0;
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = t.v[1][axis] - t.v[0][axis];
        b[axis] = t.v[2][axis] - t.v[0][axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        n[axis] = fabsf(a[(axis + 1) % 3] * b[(axis + 2) % 3]) + fabsf(a[(axis + 2) % 3] * b[(axis + 1) % 3]);
        squared += n[axis] * n[axis];
    }
    assert_true(isfinite(squared));
    scene_destroy(&s);
}

static void finish__no_triangles_bad_color_bad_light__refused(void **state)
{
    (void)state;
    base_error err;
    scene *s = empty_scene();
    assert_int_equal(scene_finish(s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.why, "no triangles");
    scene_destroy(&s);
    const float bad[] = {-0.1f, 1.1f, NAN};
    for (int i = 0; i < 3; i++) {
        s = one_triangle(&unit);
        s->materials[0].base_color[1] = bad[i];
        assert_int_equal(scene_finish(s, &err), BASE_ERR_INPUT);
        assert_non_null(strstr(err.why, "material 0"));
        scene_destroy(&s);
    }
    s = one_triangle(&unit);
    s->light.has_area = 1;
    assert_int_equal(scene_finish(s, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light");
    scene_destroy(&s);
}

static void add_camera__bad_camera__refused(void **state)
{
    (void)state;
    base_error err;
    scene *s = one_triangle(&unit);
    assert_int_equal(scene_add_camera(s, (scene_camera){.name = "bad"}, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "camera 'bad'");
    assert_int_equal(s->camera_count, 0);
    scene_destroy(&s);
}

static void find_camera__by_index_name_and_default__found(void **state)
{
    (void)state;
    const double eye[3] = {0, 0, 2}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const char *const names[] = {"front", "7", "front", ""};
    const scene_camera *found;
    base_error err;
    scene *s = one_triangle(&unit);
    assert_int_equal(scene_find_camera(s, NULL, &found, &err), BASE_ERR_USAGE);
    assert_non_null(strstr(err.why, "none"));
    for (int i = 0; i < 4; i++)
        assert_int_equal(scene_add_camera(s, scene_camera_look_at(names[i], eye, target, up, 1), NULL), BASE_OK);
    const struct {
        const char *name;
        int index;
    } rows[] = {{NULL, 0}, {"0", 0}, {"3", 3}, {"2", 2}, {"front", 0}, {"7", 1}, {"", 3}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(scene_find_camera(s, rows[i].name, &found, NULL), BASE_OK);
        assert_ptr_equal(found, &s->cameras[rows[i].index]);
    }
    const char *const unknown[] = {"4", "-1", "back", "99999999999999999999999", "0x0"};
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++) {
        assert_int_equal(scene_find_camera(s, unknown[i], &found, &err), BASE_ERR_USAGE);
        assert_null(found);
        assert_string_equal(err.what, unknown[i]);
        assert_non_null(strstr(err.why, "0 (front), 1 (7)"));
    }
    scene_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create__long_name__cut),
        cmocka_unit_test(add__many_small_batches__order_and_materials_kept),
        cmocka_unit_test(add__unknown_material_or_too_many__refused_unchanged),
        cmocka_unit_test(finish__plain_triangle__bounds_camera_light),
        cmocka_unit_test(finish__same_scene__same_hash_on_every_host),
        cmocka_unit_test(finish__each_change__changes_the_hash_but_the_name_does_not),
        cmocka_unit_test(finish__bad_vertex__triangle_named),
        cmocka_unit_test(finish__largest_coordinates__float_normals_stay_finite),
        cmocka_unit_test(finish__no_triangles_bad_color_bad_light__refused),
        cmocka_unit_test(add_camera__bad_camera__refused),
        cmocka_unit_test(find_camera__by_index_name_and_default__found),
    };
    return cmocka_run_group_tests_name("scene/scene", tests, NULL, NULL);
}
