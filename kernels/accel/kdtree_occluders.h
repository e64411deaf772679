/* Empty occluders: which empty leaves lie inside closed components of the mesh (Reshetov, Soupikov and Hurley 2005, 1.1, 4.1). */
#ifndef KERNELS_ACCEL_KDTREE_OCCLUDERS_H
#define KERNELS_ACCEL_KDTREE_OCCLUDERS_H

#include "kernels/accel/kdtree.h"

/** Components of a built tree that lie in none and no sets but the empty one. Errors: BASE_ERR_NOMEM. */
base_status kdtree_occluders_none(kdtree *tree, base_error *err);

#endif
