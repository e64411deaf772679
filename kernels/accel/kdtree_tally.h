/* What can be told from a kd-tree's nodes and lists: sizes, counts, expected cost; and whether they are a tree at all. */
#ifndef KERNELS_ACCEL_KDTREE_TALLY_H
#define KERNELS_ACCEL_KDTREE_TALLY_H

#include "kernels/accel/kdtree.h"

/**
 * Walk over a tree from the root, check every link, plane, flag and entry, and fill in `sizes`, all counts but
 * `degenerate_count`, `depth` and `sah_cost`.
 *
 * Pairs and lists must lie in depth-first order, so that the walk meets each once and ends; records are first named in
 * their order. Costs are summed in the order of the walk.
 *
 * @param tree     with root box, nodes, lists, records and sets; `sizes` is NULL
 * @param options  max_depth and traversal_cost
 * @param what     named by errors
 *
 * Errors: BASE_ERR_INPUT telling what is wrong, BASE_ERR_NOMEM.
 */
base_status kdtree_tally(kdtree *tree, const kdtree_options *options, const char *what, base_error *err);

#endif
