#include "scene/camera.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/scene.h"
#include "scene/vector.h"

#define HALF_PI 1.57079632679489661923

/* Half of the framing camera's opening angle is atan(1/2), so that its sine is 1/sqrt(5). */
#define FRAMING_YFOV 0.92729521800161223243
#define FRAMING_MARGIN 1.02

/* Lambert's continued fraction on [0, pi/4]: only + - * /, so the bits are the same with every C library. */
static double tan_small(double x)
{
    double x2 = x * x, tail = 25.0;
    for (int odd = 23; odd >= 1; odd -= 2)
        tail = odd - x2 / tail;
    return x / tail;
}

/* tan on (0, pi/2). */
static double tan_quadrant(double x)
{
    return x <= HALF_PI / 2 ? tan_small(x) : 1 / tan_small(HALF_PI - x);
}

/* right and up from forward, which is a unit vector. */
static void complete_axes(scene_camera *camera, const double up[3])
{
    const double *f = camera->forward;
    double wanted[3] = {up[0], up[1], up[2]};
    int usable = scene_normalize(wanted);
    scene_cross(camera->right, f, wanted);
    if (!usable || !(scene_dot(camera->right, camera->right) > 1e-20)) {
        int least = fabs(f[0]) <= fabs(f[1]) ? 0 : 1;
        if (fabs(f[2]) < fabs(f[least]))
            least = 2;
        double axis[3] = {0, 0, 0};
        axis[least] = 1;
        scene_cross(camera->right, f, axis);
    }
    scene_normalize(camera->right);
    scene_cross(camera->up, camera->right, f);
    scene_normalize(camera->up);
}

scene_camera scene_camera_look_at(const char *name, const double eye[3], const double target[3], const double up[3], double yfov)
{
    scene_camera camera = {.yfov = yfov};
    snprintf(camera.name, sizeof camera.name, "%s", name);
    for (int axis = 0; axis < 3; axis++) {
        camera.position[axis] = eye[axis];
        camera.forward[axis] = target[axis] - eye[axis];
    }
    if (!scene_normalize(camera.forward)) { /* looking at itself: as glTF's default camera, along -Z */
        camera.forward[0] = camera.forward[1] = 0;
        camera.forward[2] = -1;
    }
    complete_axes(&camera, up);
    return camera;
}

scene_camera scene_camera_framing(const double bounds_min[3], const double bounds_max[3])
{
    static const double up[3] = {0, 1, 0};
    double center[3], eye[3], extent[3];
    for (int axis = 0; axis < 3; axis++) {
        center[axis] = 0.5 * (bounds_min[axis] + bounds_max[axis]);
        extent[axis] = 0.5 * (bounds_max[axis] - bounds_min[axis]);
    }
    double radius = sqrt(scene_dot(extent, extent));
    if (!(radius > 0))
        radius = 1;
    /* far enough for the sphere around the box to touch the view cone, along the diagonal of a cube */
    double along_axis = FRAMING_MARGIN * radius * sqrt(5.0) / sqrt(3.0);
    for (int axis = 0; axis < 3; axis++)
        eye[axis] = center[axis] + along_axis;
    return scene_camera_look_at("default", eye, center, up, FRAMING_YFOV);
}

static int orthonormal(const scene_camera *c)
{
    const double tolerance = 1e-6;
    double cross[3];
    if (!scene_within(c->forward, 2) || !scene_within(c->right, 2) || !scene_within(c->up, 2))
        return 0;
    scene_cross(cross, c->forward, c->up);
    for (int axis = 0; axis < 3; axis++)
        if (fabs(cross[axis] - c->right[axis]) > tolerance)
            return 0;
    return fabs(scene_dot(c->forward, c->forward) - 1) <= tolerance && fabs(scene_dot(c->up, c->up) - 1) <= tolerance &&
           fabs(scene_dot(c->right, c->right) - 1) <= tolerance && fabs(scene_dot(c->forward, c->up)) <= tolerance;
}

base_status scene_camera_check(const scene_camera *camera, base_error *err)
{
    char what[96];
    snprintf(what, sizeof what, "camera '%.*s'", (int)strnlen(camera->name, sizeof camera->name), camera->name);
    if (!scene_within(camera->position, 10 * SCENE_MAX_COORDINATE))
        return base_fail(err, BASE_ERR_INPUT, what, "position (%g, %g, %g) is not within %g of the origin", camera->position[0],
                         camera->position[1], camera->position[2], 10 * SCENE_MAX_COORDINATE);
    if (!orthonormal(camera))
        return base_fail(err, BASE_ERR_INPUT, what, "forward, right and up are not orthonormal with right = forward x up");
    if (!(camera->yfov > 0 && camera->yfov < 2 * HALF_PI))
        return base_fail(err, BASE_ERR_INPUT, what, "yfov %g is not between 0 and pi", camera->yfov);
    return BASE_OK;
}

scene_primary_rays scene_camera_rays(const scene_camera *camera, unsigned width, unsigned height)
{
    scene_primary_rays rays;
    double w = width, h = height;
    double half = tan_quadrant(0.5 * camera->yfov);
    double sx0 = half * (w / h) * (1 / w - 1), step_x = half * 2 / h;
    double sy0 = half * (1 - 1 / h), step_y = -half * 2 / h;
    for (int axis = 0; axis < 3; axis++) {
        rays.origin[axis] = (float)camera->position[axis];
        rays.d00[axis] = (float)(camera->forward[axis] + sx0 * camera->right[axis] + sy0 * camera->up[axis]);
        rays.dx[axis] = (float)(step_x * camera->right[axis]);
        rays.dy[axis] = (float)(step_y * camera->up[axis]);
    }
    return rays;
}
