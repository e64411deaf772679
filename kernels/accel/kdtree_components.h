/* Connected components of a mesh, and which of them are closed. */
#ifndef KERNELS_ACCEL_KDTREE_COMPONENTS_H
#define KERNELS_ACCEL_KDTREE_COMPONENTS_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "scene/scene.h"

/**
 * Find the closed components: triangles joined by edges between equal positions, every edge used an even number of times.
 * A ray crosses such a component an even number of times from far to far, whatever way its triangles face and wherever it
 * intersects itself, so parity tells inside from outside. One is oriented if every edge is used as often one way as the other: then
 * the number of times that it winds around a point does not depend on the line along which crossings are counted.
 *
 * Triangles with two equal corners, or with a corner that is not finite, join nothing.
 *
 * @param component  out, one per triangle: 2 * number of its closed component, in the order of their first triangles,
 *                   + KDTREE_ORIENTED; KDTREE_OPEN if it is open
 * @param count      out: number of closed components
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_components_find(const scene *s, uint32_t *component, size_t *count, base_error *err);

#endif
