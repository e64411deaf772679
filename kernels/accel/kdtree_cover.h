/* Whether triangles in one plane cover a rectangle of it: the union of their areas, not the sum. */
#ifndef KERNELS_ACCEL_KDTREE_COVER_H
#define KERNELS_ACCEL_KDTREE_COVER_H

#include <stdbool.h>
#include <stddef.h>

#include "lrbni/base/status.h"

typedef struct kdtree_rectangle {
    double min[2], max[2];
} kdtree_rectangle;

typedef struct kdtree_flat_triangle {
    double v[3][2];
} kdtree_flat_triangle;

/**
 * Whether the triangles leave at most 10^-6 of the rectangle's area uncovered.
 *
 * The rectangle is halved until few triangles meet a part, or one covers it; what the few leave of a part is computed by
 * cutting them out of it. Parts that would need more than a fixed number of pieces count as uncovered.
 *
 * @param rectangle  of positive area
 * @param covered    out
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_cover(const kdtree_rectangle *rectangle, const kdtree_flat_triangle *triangles, size_t count, bool *covered,
                         base_error *err);

#endif
