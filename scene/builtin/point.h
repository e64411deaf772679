/* Points and directions of the built-in scenes, in double. */
#ifndef SCENE_BUILTIN_POINT_H
#define SCENE_BUILTIN_POINT_H

#include <math.h>

typedef struct scene_point {
    double x, y, z;
} scene_point;

static inline scene_point scene_at(double x, double y, double z)
{
    return (scene_point){x, y, z};
}

static inline scene_point scene_point_add(scene_point a, scene_point b)
{
    return scene_at(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline scene_point scene_point_sub(scene_point a, scene_point b)
{
    return scene_at(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline scene_point scene_point_scale(scene_point a, double f)
{
    return scene_at(a.x * f, a.y * f, a.z * f);
}

/** a*x + b*y */
static inline scene_point scene_point_mix(scene_point x, double a, scene_point y, double b)
{
    return scene_point_add(scene_point_scale(x, a), scene_point_scale(y, b));
}

static inline double scene_point_dot(scene_point a, scene_point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline scene_point scene_point_cross(scene_point a, scene_point b)
{
    return scene_at(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double scene_point_length(scene_point a)
{
    return sqrt(scene_point_dot(a, a));
}

static inline scene_point scene_point_unit(scene_point a)
{
    return scene_point_scale(a, 1.0 / scene_point_length(a));
}

#endif
