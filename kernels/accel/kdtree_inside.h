/* Which closed components a point lies in: the parity of a line's crossings, and their signs, found through the kd-tree. */
#ifndef KERNELS_ACCEL_KDTREE_INSIDE_H
#define KERNELS_ACCEL_KDTREE_INSIDE_H

#include <stddef.h>
#include <stdint.h>

#include "kernels/accel/kdtree.h"

/* Components of a point, and scratch; grows as needed, zero at first. */
typedef struct kdtree_inside {
    uint32_t *inside; /* members, as of kdtree_set: 2 * number, ascending, + KDTREE_OUTWARD if it winds around the point outwards */
    size_t inside_count;
    uint32_t *unsure; /* numbers, ascending: the line passes so close to their edges, or the point to them, that rounding would decide */
    size_t unsure_count;
    uint64_t *crossed; /* component and record of each crossing; the pointers above lie behind it */
    size_t crossed_count, room;
} kdtree_inside;

void kdtree_inside_free(kdtree_inside *inside);

/**
 * Follow the line from a point along an axis to the end of the scene. A point is inside a component that the line crosses an odd
 * number of times, or that is oriented and winds around it: more crossings leave through a back than enter through a front, or fewer.
 *
 * Crossings are decided by signs of double expressions that are larger than their rounding errors, or not at all.
 *
 * @param up  the direction: 1 towards larger coordinates
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_inside_find(const kdtree *tree, const double point[3], int axis, int up, kdtree_inside *out, base_error *err);

#endif
