#include "tests/kernels/views.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lrbni/base/random.h"

static void add(views *v, const char *name, const double eye[3], const double target[3], const double up[3], double yfov)
{
    if (v->count < VIEWS_MOST)
        v->camera[v->count++] = scene_camera_look_at(name, eye, target, up, yfov);
}

scene_camera views_camera(const char *name, const double position[3], const double forward[3], const double up[3], double yfov)
{
    scene_camera c = {.yfov = yfov};
    snprintf(c.name, sizeof c.name, "%s", name);
    memcpy(c.position, position, sizeof c.position);
    memcpy(c.forward, forward, sizeof c.forward);
    memcpy(c.up, up, sizeof c.up);
    for (int i = 0; i < 3; i++)
        c.right[i] = forward[(i + 1) % 3] * up[(i + 2) % 3] - forward[(i + 2) % 3] * up[(i + 1) % 3];
    return c;
}

/* Along the six half-axes, exactly, from the middle of the bounds. */
static void add_axes(views *v, const double center[3])
{
    static const char *names[6] = {"from the middle along +x", "from the middle along -x", "from the middle along +y",
                                   "from the middle along -y", "from the middle along +z", "from the middle along -z"};
    for (int i = 0; i < 6; i++) {
        double forward[3] = {0}, up[3] = {0};
        forward[i / 2] = i % 2 ? -1 : 1;
        up[(i / 2 + 1) % 3] = 1;
        v->camera[v->count++] = views_camera(names[i], center, forward, up, 1.2);
    }
}

/* From outside, far away, along an axis: parallel-looking rays, most of whose components are close to 0. */
static void add_far(views *v, const double center[3], double diagonal)
{
    static const double z_up[3] = {0, 0, 1}, y_up[3] = {0, 1, 0};
    double above[3] = {center[0], center[1] + 40 * diagonal, center[2]};
    double before[3] = {center[0] - 40 * diagonal, center[1], center[2]};
    add(v, "from far above", above, center, z_up, 0.03);
    add(v, "from far before", before, center, y_up, 0.03);
}

/* Points and planes of one triangle. */
static void add_triangle(views *v, const scene_triangle *t, const double center[3], const char *names[4])
{
    static const double up[3] = {0.1, 1, 0.05};
    double vertex[3], beyond[3], edge_on[3], middle[3], above[3], normal[3], n = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        vertex[k] = (double)t->v[0][k];
        middle[k] = ((double)t->v[0][k] + (double)t->v[1][k] + (double)t->v[2][k]) / 3;
        beyond[k] = vertex[k] + 2.5 * ((double)t->v[1][k] - vertex[k]);
        edge_on[k] = vertex[k] - 3.0 * (middle[k] - vertex[k]);
        normal[k] = ((double)t->v[1][i] - (double)t->v[0][i]) * ((double)t->v[2][j] - (double)t->v[0][j]) -
                    ((double)t->v[1][j] - (double)t->v[0][j]) * ((double)t->v[2][i] - (double)t->v[0][i]);
        n += normal[k] * normal[k];
    }
    for (int k = 0; k < 3; k++)
        above[k] = middle[k] + (n > 0 ? 1e-3 * normal[k] / sqrt(sqrt(n)) : 1e-3);
    add(v, names[0], vertex, center, up, 1.3);
    add(v, names[1], beyond, vertex, up, 0.6);
    add(v, names[2], edge_on, middle, up, 0.9);
    add(v, names[3], above, beyond, up, 1.5);
}

views views_of(const scene *s, uint64_t seed)
{
    static const char *first[4] = {"at a vertex", "on the line of an edge", "in the plane of a triangle", "grazing a triangle"};
    static const char *second[4] = {"at another vertex", "on the line of another edge", "in the plane of another triangle",
                                    "grazing another triangle"};
    static const double rolled_up[3] = {0.7, 0.3, -0.4}, up[3] = {0, 1, 0};
    views v = {.count = 1};
    base_random r = {seed};
    double center[3], square = 0, outside[3], inside[3];
    for (int k = 0; k < 3; k++) {
        center[k] = 0.5 * (s->bounds_min[k] + s->bounds_max[k]);
        square += (s->bounds_max[k] - s->bounds_min[k]) * (s->bounds_max[k] - s->bounds_min[k]);
        outside[k] = s->bounds_max[k] + 0.3 * (s->bounds_max[k] - s->bounds_min[k]);
        inside[k] = s->bounds_min[k] + (0.3 + 0.1 * k) * (s->bounds_max[k] - s->bounds_min[k]);
    }
    v.camera[0] = s->cameras[0];
    add_axes(&v, center);
    add_far(&v, center, sqrt(square));
    add(&v, "rolled, from outside", outside, center, rolled_up, 1.0);
    add(&v, "from inside, very wide", inside, center, up, 2.9);
    add(&v, "from inside, through a keyhole", inside, center, rolled_up, 1e-3);
    add_triangle(&v, &s->triangles[base_random_bits(&r) % s->triangle_count], center, first);
    add_triangle(&v, &s->triangles[base_random_bits(&r) % s->triangle_count], center, second);
    return v;
}
