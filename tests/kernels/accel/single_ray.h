/* Rays in double against single triangles: the reference of the tests of acceleration structures. */
#ifndef TESTS_KERNELS_ACCEL_SINGLE_RAY_H
#define TESTS_KERNELS_ACCEL_SINGLE_RAY_H

#include <stdint.h>

#include "kernels/accel/bvh.h"
#include "scene/scene.h"

#define SINGLE_NO_HIT UINT32_MAX

typedef struct single_ray {
    double o[3], d[3];
} single_ray;

typedef struct single_hit {
    double t; /* HUGE_VAL: none */
    uint32_t id;
} single_hit;

/** Shorten *h if the triangle of a record is hit nearer, or as near with a smaller id: Moeller and Trumbore in double,
    both faces. */
void single_ray_record(const single_ray *r, const bvh_triangle *record, single_hit *h);

/** Closest hit among all triangles of a scene. */
single_hit single_ray_brute_force(const scene *s, const single_ray *r);

#endif
