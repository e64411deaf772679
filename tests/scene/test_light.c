#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "tests/scene/near.h"

static const double low[3] = {-1, 0, 2}, high[3] = {3, 4, 9}; /* diagonal 9, centre (1, 2, 5.5) */

static void assert_vector(const double v[3], double x, double y, double z)
{
    assert_near(v[0], x, 1e-14);
    assert_near(v[1], y, 1e-14);
    assert_near(v[2], z, 1e-14);
}

static scene_light area_light(void)
{
    return (scene_light){.has_area = 1, .corner = {1, 5, 2}, .u = {2, 0, 0}, .v = {0, 0, 4}};
}

static void complete__no_light__square_above_the_centre_facing_down(void **state)
{
    (void)state;
    scene_light light = {0};
    scene_light_complete(&light, low, high);
    assert_vector(light.corner, 1 - 0.45, 2 + 2.25, 5.5 - 0.45);
    assert_vector(light.u, 0.9, 0, 0);
    assert_vector(light.v, 0, 0, 0.9);
    assert_true(light.u[2] * light.v[0] - light.u[0] * light.v[2] < 0); /* y of u x v */
    assert_vector(light.point, 1, 4.25, 5.5);
    assert_int_equal(light.has_area, 0);
    assert_int_equal(light.has_point, 0);
    assert_int_equal(scene_light_check(&light, NULL), BASE_OK);
}

static void complete__area_only__point_is_its_centre(void **state)
{
    (void)state;
    scene_light light = area_light();
    scene_light_complete(&light, low, high);
    assert_vector(light.corner, 1, 5, 2);
    assert_vector(light.u, 2, 0, 0);
    assert_vector(light.point, 2, 5, 4);
}

static void complete__point_only__default_area_and_own_point(void **state)
{
    (void)state;
    scene_light light = {.has_point = 1, .point = {7, 8, 9}};
    scene_light_complete(&light, low, high);
    assert_vector(light.point, 7, 8, 9);
    assert_vector(light.u, 0.9, 0, 0);
}

static void complete__bounds_of_a_point__still_an_area(void **state)
{
    (void)state;
    scene_light light = {0};
    scene_light_complete(&light, low, low);
    light.has_area = 1;
    assert_int_equal(scene_light_check(&light, NULL), BASE_OK);
}

static void scale__twice_and_half__centre_stays(void **state)
{
    (void)state;
    scene_light light = area_light();
    scene_light_complete(&light, low, high);
    scene_light_scale(&light, 2);
    assert_vector(light.corner, 0, 5, 0);
    assert_vector(light.u, 4, 0, 0);
    assert_vector(light.v, 0, 0, 8);
    assert_vector(light.point, 2, 5, 4);
    scene_light_scale(&light, 0.25);
    assert_vector(light.corner, 1.5, 5, 3);
    assert_vector(light.v, 0, 0, 2);
}

static void check__each_bad_field__named(void **state)
{
    (void)state;
    base_error err;
    scene_light light = area_light();
    assert_int_equal(scene_light_check(&light, &err), BASE_OK);
    light.corner[0] = (double)NAN;
    assert_int_equal(scene_light_check(&light, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light.corner");
    light = area_light();
    light.u[1] = HUGE_VAL;
    assert_int_equal(scene_light_check(&light, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light.u");
    light = area_light();
    light.v[2] = -2e10;
    assert_int_equal(scene_light_check(&light, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light.v");
    light = area_light();
    light.point[2] = (double)NAN;
    assert_int_equal(scene_light_check(&light, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light.point");
    light = area_light();
    memcpy(light.v, light.u, sizeof light.v);
    assert_int_equal(scene_light_check(&light, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "light");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(complete__no_light__square_above_the_centre_facing_down),
        cmocka_unit_test(complete__area_only__point_is_its_centre),
        cmocka_unit_test(complete__point_only__default_area_and_own_point),
        cmocka_unit_test(complete__bounds_of_a_point__still_an_area),
        cmocka_unit_test(scale__twice_and_half__centre_stays),
        cmocka_unit_test(check__each_bad_field__named),
    };
    return cmocka_run_group_tests_name("scene/light", tests, NULL, NULL);
}
