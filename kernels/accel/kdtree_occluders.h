/* Empty occluders: which empty leaves lie inside closed components of the mesh (Reshetov, Soupikov and Hurley 2005, 1.1, 4.1). */
#ifndef KERNELS_ACCEL_KDTREE_OCCLUDERS_H
#define KERNELS_ACCEL_KDTREE_OCCLUDERS_H

#include "kernels/accel/kdtree.h"

/**
 * Fill in the components, the sets, and the sets' numbers in the empty leaves of a built tree.
 *
 * No surface passes through an empty leaf, so that one point of it stands for all. Where rounding cannot decide for any of
 * several points, and in leaves without volume, the set is the empty one.
 *
 * @param seek  false: all components count as open
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status kdtree_occluders_find(const scene *s, bool seek, unsigned jobs, kdtree *tree, base_error *err);

#endif
