/* What every tree must satisfy, checked from its bytes alone; a failure ends the running cmocka case. */
#ifndef TESTS_KERNELS_ACCEL_BVH_CHECK_H
#define TESTS_KERNELS_ACCEL_BVH_CHECK_H

#include <stdint.h>

#include "kernels/accel/bvh.h"

/**
 * Check the structure of a tree: alignment, order of pairs and records, links in range and used once, boxes equal
 * bit for bit to the unions below them, leaves of 1..max_leaf ascending ids, records equal to the scene's triangles,
 * every triangle in one leaf unless it is degenerate, counts, depth and cost.
 */
void bvh_check(const scene *s, const bvh *tree, const bvh_options *options);

/** Hash of nodes and records. */
uint64_t bvh_check_hash(const bvh *tree);

#endif
