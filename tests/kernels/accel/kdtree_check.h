/* What every kd-tree must satisfy, checked from its bytes alone; a failure ends the running cmocka case. */
#ifndef TESTS_KERNELS_ACCEL_KDTREE_CHECK_H
#define TESTS_KERNELS_ACCEL_KDTREE_CHECK_H

#include <stdint.h>

#include "kernels/accel/kdtree.h"

/* A leaf as a walk over the tree meets it. */
typedef struct kdtree_leaf {
    const kdtree_node *node;
    float min[3], max[3]; /* its cell */
    unsigned depth;
} kdtree_leaf;

typedef void kdtree_leaf_fn(void *user, const kdtree *tree, const kdtree_leaf *leaf);

/** Call fn for every leaf, in the order of the lists. */
void kdtree_each_leaf(const kdtree *tree, kdtree_leaf_fn *fn, void *user);

/** Id of entry i of a leaf's list. */
uint32_t kdtree_leaf_id(const kdtree *tree, const kdtree_node *leaf, size_t i);

/**
 * Check the structure of a tree: alignment, order of pairs and lists, links in range and used once, planes within their
 * cells, ids ascending within a list, records equal to the scene's triangles and in the order of the lists, every triangle
 * in some list unless it is degenerate, the root's box, flags, sizes, sets, counts, depth and cost.
 */
void kdtree_check(const scene *s, const kdtree *tree, const kdtree_options *options);

/** Hash of all arrays and counts. */
uint64_t kdtree_check_hash(const kdtree *tree);

#endif
