/* Axis-aligned boxes of the acceleration structures' builders: eight floats, so that a union is eight minima.
 *
 * The maximum is kept negated. Zeros are kept as +0 (box_of_triangle), because the minimum of -0 and +0 would
 * depend on the order of the operands, and trees must not depend on the order in which boxes are joined.
 */
#ifndef KERNELS_ACCEL_BOX_H
#define KERNELS_ACCEL_BOX_H

#include <math.h>

#include "scene/scene.h"

/* Before a loop over lanes: gcc 12 then makes it 4-lane operations, where it would otherwise unroll it early into
   scalar ones (half the speed); clang does well unasked. The results are the same. */
#if defined(__GNUC__) && !defined(__clang__)
#define ACCEL_LANES _Pragma("GCC unroll 1")
#else
#define ACCEL_LANES
#endif

typedef struct accel_box {
    float v[8]; /* min x y z, unused, -max x y z, unused; the unused floats are joined too but mean nothing */
} accel_box;

/** The box of nothing: its union with any box is that box. */
static inline accel_box accel_box_empty(void)
{
    const float inf = INFINITY;
    return (accel_box){{inf, inf, inf, inf, inf, inf, inf, inf}};
}

/** Make `box` the smallest box around both; they are not the same object. */
static inline void accel_box_add(accel_box *restrict box, const accel_box *restrict other)
{
    ACCEL_LANES
    for (int i = 0; i < 8; i++)
        box->v[i] = other->v[i] < box->v[i] ? other->v[i] : box->v[i];
}

/** Half the surface area, in double: neither overflows nor vanishes for any box of finite floats around a triangle. */
static inline double accel_box_half_area(const accel_box *box)
{
    double x = -((double)box->v[4] + (double)box->v[0]);
    double y = -((double)box->v[5] + (double)box->v[1]);
    double z = -((double)box->v[6] + (double)box->v[2]);
    return x * y + y * z + z * x;
}

/** Box of a triangle's vertices; the unused floats are 0. */
static inline accel_box accel_box_of_triangle(const scene_triangle *t)
{
    accel_box box = {{0}};
    for (int axis = 0; axis < 3; axis++) {
        float a = t->v[0][axis], b = t->v[1][axis], c = t->v[2][axis];
        float low = a < b ? a : b, high = a > b ? a : b;
        low = low < c ? low : c;
        high = high > c ? high : c;
        box.v[axis] = low + 0.0f;
        box.v[axis + 4] = 0.0f - high;
    }
    return box;
}

/** The triangle's normal (v1-v0) x (v2-v0), in double, not normalised. */
static inline void accel_triangle_normal(const scene_triangle *t, double n[3])
{
    double e[3], f[3];
    for (int axis = 0; axis < 3; axis++) {
        e[axis] = (double)t->v[1][axis] - (double)t->v[0][axis];
        f[axis] = (double)t->v[2][axis] - (double)t->v[0][axis];
    }
    n[0] = e[1] * f[2] - e[2] * f[1];
    n[1] = e[2] * f[0] - e[0] * f[2];
    n[2] = e[0] * f[1] - e[1] * f[0];
}

/**
 * Whether a triangle is left out of every acceleration structure: its normal is zero or not finite.
 *
 * Where differences of coordinates have at most 26 bits (same sign and within a factor of 4 of each other, say) all
 * products are exact, and the normal is zero only if it is so exactly. Elsewhere rounding may call a sliver degenerate
 * whose height is some 2^-50 of its length, or keep a flat triangle: no test in float can tell those two apart.
 * Finite floats never overflow here: not finite means that a vertex is not.
 */
static inline int accel_triangle_is_degenerate(const scene_triangle *t)
{
    double n[3];
    accel_triangle_normal(t, n);
    double size = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    return !(size > 0.0 && size <= 0x1p1000);
}

#endif
