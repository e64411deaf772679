/* Builds the nodes and records of a bvh; bvh.c checks the options and adds the statistics. */
#ifndef KERNELS_ACCEL_BVH_BUILDER_H
#define KERNELS_ACCEL_BVH_BUILDER_H

#include "kernels/accel/bvh.h"

/**
 * Fill in nodes, records, their counts, degenerate_count, inner_count and depth.
 *
 * @param options  in range
 * @param tree     all zero; on failure it may own parts: the caller destroys it
 *
 * Errors: BASE_ERR_INPUT for more than SCENE_MAX_TRIANGLES triangles, BASE_ERR_NOMEM.
 */
base_status bvh_builder_run(const scene *s, const bvh_options *options, bvh *tree, base_error *err);

#endif
