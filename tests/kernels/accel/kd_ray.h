/* Closest hits through a kd-tree for one ray in double: the reference traversal of tests and benchmarks. */
#ifndef TESTS_KERNELS_ACCEL_KD_RAY_H
#define TESTS_KERNELS_ACCEL_KD_RAY_H

#include "kernels/accel/kdtree.h"
#include "tests/kernels/accel/single_ray.h"

/* What a traversal has done; added to. */
typedef struct kd_ray_counts {
    size_t inner, leaves, tests;
} kd_ray_counts;

/**
 * Closest hit of a ray that starts anywhere. Cells are visited in their order along the ray, planes being widened by far more
 * than the rounding of double; nothing behind an earlier hit is looked at.
 */
single_hit kd_ray_closest(const kdtree *tree, const single_ray *r, kd_ray_counts *n);

#endif
