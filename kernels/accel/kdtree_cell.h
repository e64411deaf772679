/* Cells of the kd-tree, and the part of a triangle in one. Used by its builder. */
#ifndef KERNELS_ACCEL_KDTREE_CELL_H
#define KERNELS_ACCEL_KDTREE_CELL_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/scene.h"

/* A box, closed, in the scene's units; flat where min = max. */
typedef struct kdtree_cell {
    float min[3], max[3];
} kdtree_cell;

/* A triangle in a cell: the box of the part of it that lies there. */
typedef struct kdtree_ref {
    kdtree_cell box;
    uint32_t id;
} kdtree_ref;

static inline double kdtree_cell_length(const kdtree_cell *cell, int axis)
{
    return (double)cell->max[axis] - (double)cell->min[axis];
}

/** Half the surface area; of a flat cell the area of its rectangle. */
static inline double kdtree_cell_half_area(const kdtree_cell *cell)
{
    double x = kdtree_cell_length(cell, 0), y = kdtree_cell_length(cell, 1), z = kdtree_cell_length(cell, 2);
    return x * y + y * z + z * x;
}

/** The cell below (side 0) or above (side 1) a plane. */
static inline kdtree_cell kdtree_cell_half(const kdtree_cell *cell, int axis, float plane, int side)
{
    kdtree_cell half = *cell;
    if (side == 0)
        half.max[axis] = plane;
    else
        half.min[axis] = plane;
    return half;
}

/**
 * Rounding bound of kdtree_cell_clip for a scene in this cell: 2^-44 of the largest coordinate. Its six cuts err by less
 * than 2^-47 of it.
 */
double kdtree_cell_margin(const kdtree_cell *scene_cell);

/**
 * Shrink a reference to the part of its triangle in a cell.
 *
 * The box stays a box around that part whatever is rounded: bounds that are vertices are exact, bounds that are cuts of
 * edges and faces lie outside by at most 2 margins and a rounding to float, and never outside the cell.
 *
 * @param ref  its box already lies in the cell
 *
 * Returns false if no point of the triangle lies in the cell.
 */
bool kdtree_cell_clip(const kdtree_cell *cell, const scene_triangle *triangle, double margin, kdtree_ref *ref);

#endif
