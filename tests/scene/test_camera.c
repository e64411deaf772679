#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "scene/scene.h"
#include "tests/scene/near.h"

#define PI 3.14159265358979323846

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void random_point(base_random *r, double p[3])
{
    for (int axis = 0; axis < 3; axis++)
        p[axis] = base_random_range(r, -10, 10);
}

static scene_camera random_camera(base_random *r)
{
    double eye[3], target[3], up[3];
    random_point(r, eye);
    random_point(r, target);
    random_point(r, up);
    return scene_camera_look_at("random", eye, target, up, base_random_range(r, 0.05, 3.0));
}

static void assert_vector(const double v[3], double x, double y, double z, double tolerance)
{
    assert_near(v[0], x, tolerance);
    assert_near(v[1], y, tolerance);
    assert_near(v[2], z, tolerance);
}

static void look_at__plain_view__axes_are_the_worlds(void **state)
{
    (void)state;
    const double eye[3] = {1, 2, 3}, target[3] = {1, 2, -7}, up[3] = {0, 5, 0};
    scene_camera c = scene_camera_look_at("plain", eye, target, up, 1);
    assert_string_equal(c.name, "plain");
    assert_vector(c.position, 1, 2, 3, 0);
    assert_vector(c.forward, 0, 0, -1, 0);
    assert_vector(c.right, 1, 0, 0, 0);
    assert_vector(c.up, 0, 1, 0, 0);
    assert_true(c.yfov == 1.0);
}

static void look_at__random_views__orthonormal_and_towards_target(void **state)
{
    (void)state;
    base_random r = {7};
    for (int i = 0; i < 1000; i++) {
        scene_camera c = random_camera(&r);
        assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
        assert_near(dot(c.forward, c.right), 0, 1e-14);
        assert_near(dot(c.up, c.up), 1, 1e-14);
    }
}

static void look_at__up_parallel_or_zero__another_axis(void **state)
{
    (void)state;
    const double eye[3] = {0, 0, 0}, target[3] = {0, -3, 0}, up[3] = {0, 1, 0}, zero[3] = {0, 0, 0};
    scene_camera c = scene_camera_look_at("down", eye, target, up, 1);
    assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
    assert_vector(c.forward, 0, -1, 0, 0);
    c = scene_camera_look_at("no up", eye, target, zero, 1);
    assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
    c = scene_camera_look_at("nowhere", eye, eye, up, 1);
    assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
    assert_vector(c.forward, 0, 0, -1, 0);
}

static void look_at__huge_and_tiny_distances__no_overflow(void **state)
{
    (void)state;
    const double eye[3] = {0, 0, 0}, far[3] = {1e300, 1e300, 0}, near[3] = {0, 0, -1e-300}, up[3] = {0, 1e-200, 0};
    scene_camera c = scene_camera_look_at("far", eye, far, up, 1);
    assert_vector(c.forward, sqrt(0.5), sqrt(0.5), 0, 1e-15);
    c = scene_camera_look_at("near", eye, near, up, 1);
    assert_vector(c.forward, 0, 0, -1, 0);
    assert_vector(c.up, 0, 1, 0, 0);
}

static void look_at__long_name__cut(void **state)
{
    (void)state;
    char name[200];
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    scene_camera c = scene_camera_look_at(name, eye, target, up, 1);
    assert_int_equal(strlen(c.name), sizeof c.name - 1);
}

/* Every corner within the square cone of view. */
static void assert_sees_box(const scene_camera *c, const double low[3], const double high[3])
{
    double edge = tan(c->yfov / 2);
    for (int corner = 0; corner < 8; corner++) {
        double to[3];
        for (int axis = 0; axis < 3; axis++)
            to[axis] = (corner >> axis & 1 ? high[axis] : low[axis]) - c->position[axis];
        double depth = dot(to, c->forward);
        assert_true(depth > 0);
        assert_true(fabs(dot(to, c->right)) <= edge * depth);
        assert_true(fabs(dot(to, c->up)) <= edge * depth);
    }
}

static void framing__random_boxes__all_corners_in_view(void **state)
{
    (void)state;
    base_random r = {11};
    for (int i = 0; i < 1000; i++) {
        double low[3], high[3];
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = base_random_range(&r, -100, 100);
            high[axis] = low[axis] + (base_random_bits(&r) % 4 ? base_random_range(&r, 0, 50) : 0);
        }
        scene_camera c = scene_camera_framing(low, high);
        assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
        assert_sees_box(&c, low, high);
        assert_true(c.position[1] > high[1]);
    }
}

static void framing__largest_and_empty_boxes__valid(void **state)
{
    (void)state;
    const double low[3] = {-SCENE_MAX_COORDINATE, -SCENE_MAX_COORDINATE, -SCENE_MAX_COORDINATE};
    const double high[3] = {SCENE_MAX_COORDINATE, SCENE_MAX_COORDINATE, SCENE_MAX_COORDINATE};
    scene_camera c = scene_camera_framing(low, high);
    assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
    assert_sees_box(&c, low, high);
    c = scene_camera_framing(high, high);
    assert_int_equal(scene_camera_check(&c, NULL), BASE_OK);
}

static void check__each_bad_field__named(void **state)
{
    (void)state;
    const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    const scene_camera good = scene_camera_framing(low, high);
    base_error err;
    scene_camera c = good;
    c.position[1] = (double)NAN;
    assert_int_equal(scene_camera_check(&c, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "camera 'default'");
    assert_non_null(strstr(err.why, "position"));
    c = good;
    c.position[2] = 1.1e10;
    assert_int_equal(scene_camera_check(&c, &err), BASE_ERR_INPUT);
    for (int axis = 0; axis < 3; axis++) { /* left-handed */
        c = good;
        for (int i = 0; i < 3; i++)
            c.right[i] = -c.right[i];
        assert_int_equal(scene_camera_check(&c, &err), BASE_ERR_INPUT);
        assert_non_null(strstr(err.why, "orthonormal"));
        c = good;
        c.forward[axis] += 1e-3;
        assert_int_equal(scene_camera_check(&c, NULL), BASE_ERR_INPUT);
        c = good;
        c.up[axis] = (double)NAN;
        assert_int_equal(scene_camera_check(&c, NULL), BASE_ERR_INPUT);
    }
    const double bad_yfov[] = {0, -1, PI, 4, (double)NAN, HUGE_VAL};
    for (size_t i = 0; i < sizeof bad_yfov / sizeof bad_yfov[0]; i++) {
        c = good;
        c.yfov = bad_yfov[i];
        assert_int_equal(scene_camera_check(&c, &err), BASE_ERR_INPUT);
        assert_non_null(strstr(err.why, "yfov"));
    }
}

/* The formula of docs/interface.md, written out, with the C library's tan. */
static void contract_direction(const scene_camera *c, unsigned w, unsigned h, unsigned x, unsigned y, double d[3])
{
    double half = tan(c->yfov / 2);
    double sy = half * (1 - 2 * (y + 0.5) / h), sx = half * ((double)w / h) * (2 * (x + 0.5) / w - 1);
    for (int axis = 0; axis < 3; axis++)
        d[axis] = c->forward[axis] + sx * c->right[axis] + sy * c->up[axis];
}

static void rays__random_cameras__contract_formula(void **state)
{
    (void)state;
    base_random r = {3};
    for (int i = 0; i < 500; i++) {
        scene_camera c = random_camera(&r);
        unsigned w = 1 + (unsigned)(base_random_bits(&r) % 3000), h = 1 + (unsigned)(base_random_bits(&r) % 3000);
        scene_primary_rays rays = scene_camera_rays(&c, w, h);
        double first[3], last[3], size = tan(c.yfov / 2) * (1 + (double)w / h) + 1;
        contract_direction(&c, w, h, 0, 0, first);
        contract_direction(&c, w, h, w - 1, h - 1, last);
        for (int axis = 0; axis < 3; axis++) {
            assert_true(rays.origin[axis] == (float)c.position[axis]);
            assert_near((double)rays.d00[axis], first[axis], 0x1p-23 * size); /* one rounding to float */
            double reached = (double)rays.d00[axis] + (w - 1.0) * (double)rays.dx[axis] + (h - 1.0) * (double)rays.dy[axis];
            assert_near(reached, last[axis], 0x1p-21 * size);
        }
    }
}

static void rays__right_angle_square__exact_values(void **state)
{
    (void)state;
    const double eye[3] = {1, 2, 3}, target[3] = {1, 2, 0}, up[3] = {0, 1, 0};
    scene_camera c = scene_camera_look_at("square", eye, target, up, PI / 2);
    scene_primary_rays rays = scene_camera_rays(&c, 4, 4);
    const float d00[3] = {-0.75f, 0.75f, -1}, dx[3] = {0.5f, 0, 0}, dy[3] = {0, -0.5f, 0}, origin[3] = {1, 2, 3};
    for (int axis = 0; axis < 3; axis++) {
        assert_true(rays.d00[axis] == d00[axis]);
        assert_true(rays.dx[axis] == dx[axis]);
        assert_true(rays.dy[axis] == dy[axis]);
        assert_true(rays.origin[axis] == origin[axis]);
    }
}

static void rays__all_opening_angles__tangent_to_the_last_bits(void **state)
{
    (void)state;
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    for (int i = 1; i < 3000; i++) {
        double yfov = i * (PI / 3000);
        scene_camera c = scene_camera_look_at("angle", eye, target, up, yfov);
        scene_primary_rays rays = scene_camera_rays(&c, 1, 1); /* dy is -2 tan(yfov/2) */
        float want = (float)(-2 * tan(yfov / 2));
        assert_true(rays.dy[1] == want || rays.dy[1] == nextafterf(want, 0) || rays.dy[1] == nextafterf(want, -INFINITY));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(look_at__plain_view__axes_are_the_worlds),
        cmocka_unit_test(look_at__random_views__orthonormal_and_towards_target),
        cmocka_unit_test(look_at__up_parallel_or_zero__another_axis),
        cmocka_unit_test(look_at__huge_and_tiny_distances__no_overflow),
        cmocka_unit_test(look_at__long_name__cut),
        cmocka_unit_test(framing__random_boxes__all_corners_in_view),
        cmocka_unit_test(framing__largest_and_empty_boxes__valid),
        cmocka_unit_test(check__each_bad_field__named),
        cmocka_unit_test(rays__random_cameras__contract_formula),
        cmocka_unit_test(rays__right_angle_square__exact_values),
        cmocka_unit_test(rays__all_opening_angles__tangent_to_the_last_bits),
    };
    return cmocka_run_group_tests_name("scene/camera", tests, NULL, NULL);
}
