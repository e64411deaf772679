/* Part of a kd-tree below one cell, built depth first by one thread. */
#ifndef KERNELS_ACCEL_KDTREE_SUBTREE_H
#define KERNELS_ACCEL_KDTREE_SUBTREE_H

#include "kernels/accel/kdtree.h"
#include "kernels/accel/kdtree_split.h"

/* A cell and its triangles, to be divided. */
typedef struct kdtree_span {
    kdtree_ref *refs;
    size_t count;
    kdtree_cell cell;
    unsigned depth; /* edges from the root of the whole tree */
} kdtree_span;

/* What is below a cell. Links of nodes and lists count from this subtree's first pair and first entry. */
typedef struct kdtree_subtree {
    kdtree_node root;
    kdtree_node *pairs; /* two nodes each; owned */
    uint32_t *ids;      /* of triangles, list after list; owned */
    size_t pair_count, pair_room;
    size_t id_count, id_room;
} kdtree_subtree;

/* Memory of one thread, kept from subtree to subtree. Zero at first. */
typedef struct kdtree_worker {
    kdtree_bounds bounds;
    kdtree_ref *stack; /* references of the cells that wait */
    size_t stack_room;
    kdtree_ref *halves[2]; /* of the cell that is being divided */
    size_t half_room;
} kdtree_worker;

void kdtree_worker_free(kdtree_worker *worker);

/**
 * Where a cell is cut; axis -1: it is a leaf.
 *
 * @param bounds  scratch
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_span_split(const kdtree_rules *rules, unsigned max_depth, const kdtree_span *span, kdtree_bounds *bounds,
                              kdtree_split *out, base_error *err);

/**
 * Build all that is below a cell.
 *
 * @param out  zeroed by the caller, who frees its arrays, after a failure too
 *
 * Errors: BASE_ERR_NOMEM, BASE_ERR_INPUT for more than 4 GiB of nodes or lists.
 */
base_status kdtree_subtree_build(const kdtree_rules *rules, unsigned max_depth, const kdtree_span *span, kdtree_worker *worker,
                                 kdtree_subtree *out, base_error *err);

#endif
