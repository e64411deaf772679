/* The work behind kdtree_build: options are checked, out is zeroed. */
#ifndef KERNELS_ACCEL_KDTREE_BUILDER_H
#define KERNELS_ACCEL_KDTREE_BUILDER_H

#include "kernels/accel/kdtree.h"

/**
 * Fill in the root's box, nodes, lists, records and degenerate_count.
 *
 * @param tree  zeroed; on failure it holds what kdtree_destroy frees
 *
 * Errors: those of kdtree_build but BASE_ERR_USAGE.
 */
base_status kdtree_builder_run(const scene *s, const kdtree_options *options, kdtree *tree, base_error *err);

#endif
