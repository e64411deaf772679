/* Vectors of three doubles, for cameras, lights and transforms; private to scene/. */
#ifndef SCENE_VECTOR_H
#define SCENE_VECTOR_H

#include <math.h>

/** a . b */
static inline double scene_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** out = a x b; out may be neither a nor b. */
static inline void scene_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/** Scale v to unit length, without overflow or underflow on the way; 0 and v unchanged if v is zero or not finite. */
static inline int scene_normalize(double v[3])
{
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0 && isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2])))
        return 0;
    double w[3] = {v[0] / largest, v[1] / largest, v[2] / largest};
    double length = sqrt(scene_dot(w, w));
    for (int axis = 0; axis < 3; axis++)
        v[axis] = w[axis] / length;
    return 1;
}

/** Whether all three are finite and at most `limit` in size. */
static inline int scene_within(const double v[3], double limit)
{
    /* written so that a NaN is not within anything */
    return fabs(v[0]) <= limit && fabs(v[1]) <= limit && fabs(v[2]) <= limit;
}

#endif
