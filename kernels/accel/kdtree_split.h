/* Where a cell of the kd-tree is cut: the three rules of Reshetov, Soupikov and Hurley 2005, section 3.1. */
#ifndef KERNELS_ACCEL_KDTREE_SPLIT_H
#define KERNELS_ACCEL_KDTREE_SPLIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/accel/kdtree_cell.h"
#include "lrbni/base/status.h"
#include "scene/scene.h"

/* What the rules need to know, the same for the whole tree. */
typedef struct kdtree_rules {
    const scene_triangle *triangles; /* of the scene */
    double traversal_cost; /* in triangle tests */
    double empty_share;    /* rule 1: of a cell's length; 1: off */
    bool covered_planes;   /* rule 2 */
    double min_half_area;  /* rule 3 */
    bool perfect_splits;
    double margin; /* of kdtree_cell_clip */
} kdtree_rules;

/* A cut, or none. */
typedef struct kdtree_split {
    int axis; /* -1: none */
    float plane;
    bool flat_above; /* the triangles in the plane go to the upper child */
    double cost;     /* area times triangles, summed over both children; not set by rule 1 */
} kdtree_split;

/* Sorted bounds of triangles along one axis, as integers in the order of the floats; grows as needed. */
typedef struct kdtree_bounds {
    uint32_t *low, *high, *flat; /* of all triangles, all, and those in a plane across the axis */
    uint32_t *spare[2];
    size_t flat_count, room;
} kdtree_bounds;

void kdtree_bounds_free(kdtree_bounds *bounds);

/** Make room for `count` triangles. Errors: BASE_ERR_NOMEM. */
base_status kdtree_bounds_reserve(kdtree_bounds *bounds, size_t count, base_error *err);

/** Fill in and sort one half, `low` with `flat` (side 0) or `high` (side 1), for which there is room; the halves may be done
    at the same time. */
void kdtree_bounds_sort(kdtree_bounds *bounds, int side, const kdtree_ref *refs, size_t count, int axis);

/**
 * Rule 1: cut off the largest empty space beside the triangles, if it is a larger share of the cell's length than allowed.
 * Of equal shares the lowest axis, and the lower face. All triangles are on the other side, those in the plane too.
 *
 * @param around  the box around all references
 */
kdtree_split kdtree_split_empty(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_cell *around);

/**
 * Rule 2: cut at an axis-aligned plane, in the cell or on its face, that triangles in it cover completely; of several at
 * the one of least cost, then of the lowest axis, then the lowest. Those triangles go to the child of smaller surface, of equal
 * ones to the lower: on a face that is a flat one.
 *
 * @param bounds  scratch
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_split_covered(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_ref *refs, size_t count,
                                 kdtree_bounds *bounds, kdtree_split *out, base_error *err);

/** Rule 3 on one axis: the plane of least cost inside the cell, of equal ones the lowest. `bounds` are sorted. */
kdtree_split kdtree_split_cheapest(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_bounds *bounds, size_t count,
                                   int axis);

/** The cheapest of three axes, of equal ones the lowest; none if not to split costs no more. */
kdtree_split kdtree_split_best(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_split axes[3], size_t count);

/** The cut at one plane, with its cost; the triangles in it are where rule 2 wants them. `bounds` are sorted. */
kdtree_split kdtree_split_at_plane(const kdtree_cell *cell, const kdtree_bounds *bounds, size_t count, int axis, float plane);

/** The box around references; of none (+inf, -inf). */
kdtree_cell kdtree_refs_around(const kdtree_ref *refs, size_t count);

/**
 * Whether the triangles that lie in a flat cell's plane cover its rectangle. False for a cell that is not flat along exactly
 * one axis. Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_cell_covered(const scene_triangle *triangles, const kdtree_cell *cell, const kdtree_ref *refs, size_t count,
                                bool *covered, base_error *err);

/**
 * Hand the references of a cell to its two children, in order.
 *
 * @param below, above  room for `count` references each
 * @param counts        out
 */
void kdtree_refs_divide(const kdtree_rules *rules, const kdtree_cell *cell, const kdtree_split *split, const kdtree_ref *refs,
                        size_t count, kdtree_ref *below, kdtree_ref *above, size_t counts[2]);

#endif
