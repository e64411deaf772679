/* Closest hits and occlusion by Embree 3: an independent ray tracer that is fast enough for whole pictures of large scenes.
 *
 * Embree works in float, so it is not always right: hit_judge.h decides where it disagrees. Its robust mode is used.
 * Embree's manual recommends to flush denormals to zero while it runs; that is not done, the host's floating-point
 * modes stay as they are.
 */
#ifndef TESTS_ORACLES_EMBREE_ORACLE_H
#define TESTS_ORACLES_EMBREE_ORACLE_H

#include <stddef.h>

#include "lrbni/base/status.h"
#include "scene/scene.h"
#include "tests/oracles/ray.h"

typedef struct embree_oracle embree_oracle;

/**
 * Build Embree's tree over an array of triangles.
 *
 * @param triangles       triangle_count, at most SCENE_MAX_TRIANGLES; copied. The index is the id
 * @param cull_backface   1: only triangles with N.dir < 0 (evaluated in double) are hit
 * @param jobs            host threads for the building and for embree_oracle_closest, at least 1
 * @param out             owned by the caller: free with embree_oracle_destroy; NULL on failure
 *
 * Errors: BASE_ERR_USAGE for too many triangles, BASE_ERR_NOMEM, BASE_ERR_UNSUPPORTED for any other failure of Embree
 * (its words are passed on).
 */
base_status embree_oracle_create(const scene_triangle *triangles, size_t triangle_count, int cull_backface,
                                 unsigned jobs, embree_oracle **out, base_error *err);

/** Free an oracle; sets the pointer to NULL. NULL contents are fine. */
void embree_oracle_destroy(embree_oracle **oracle);

/**
 * Closest hit of each ray. Which of several triangles at the same t is reported is Embree's choice.
 *
 * @param rays  ray_count, finite but for tmax
 * @param hits  out, ray_count; t, u and v are Embree's floats
 *
 * Errors: BASE_ERR_UNSUPPORTED with Embree's words.
 */
base_status embree_oracle_closest(const embree_oracle *oracle, const oracle_ray *rays, size_t ray_count,
                                  oracle_hit *hits, base_error *err);

/**
 * Whether anything is hit in each ray's range, by rtcOccluded1.
 *
 * @param occluded  out, ray_count: 1 or 0
 *
 * Errors: BASE_ERR_UNSUPPORTED with Embree's words.
 */
base_status embree_oracle_occluded(const embree_oracle *oracle, const oracle_ray *rays, size_t ray_count, unsigned char *occluded,
                                   base_error *err);

#endif
