/* Oracle O1: closest hits by trying every triangle, in double precision. No acceleration structure to go wrong. */
#ifndef TESTS_ORACLES_BRUTE_FORCE_H
#define TESTS_ORACLES_BRUTE_FORCE_H

#include <stddef.h>

#include "scene/scene.h"
#include "tests/oracles/ray.h"

/**
 * Closest hit of each ray, by the rules of docs/kernels.md: edges belong to the triangle, the smaller t wins, on equal
 * t the smaller id. Triangles parallel to the ray, and those without area, are not hit.
 *
 * @param triangles      triangle_count, below ORACLE_NO_HIT (asserted); the index is the id
 * @param rays           ray_count; a ray with a NaN hits nothing
 * @param cull_backface  1: only triangles with N.dir < 0 are hit
 * @param jobs           host threads; the result does not depend on it
 * @param hits           out, ray_count
 *
 * Source: Moeller and Trumbore 1997, in double. Not exact: a ray within some 2^-50 of an edge may go either way.
 */
void brute_force_closest(const scene_triangle *triangles, size_t triangle_count, const oracle_ray *rays,
                         size_t ray_count, int cull_backface, unsigned jobs, oracle_hit *hits);

#endif
