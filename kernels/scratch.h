/* Where the tracing kernels keep what registers cannot hold: offsets in the scratch of a hardware thread.
 *
 * Larrabee has no path from a lane to all lanes but through memory: a vector is stored here, and its words come back as
 * {1to16} operands.
 */
#ifndef KERNELS_SCRATCH_H
#define KERNELS_SCRATCH_H

#include "kernels/accel/bvh.h"

enum {
    SCRATCH_BOXES = 0,      /* 64 bytes: a pair of boxes relative to the origin */
    SCRATCH_EDGES = 64,     /* 64: edge planes of a triangle (kernels/triangle16.h) */
    SCRATCH_PLANE = 128,    /* 64: distance of a triangle's plane */
    SCRATCH_GUARD = 192,    /* 64: rounding bounds of the edge planes */
    SCRATCH_MINUS_GUARD = 256, /* 64: the same, negative */
    SCRATCH_CORNERS = 320,  /* 3 x 64: directions of the first rays of the 16 blocks, by axis */
    SCRATCH_OTHER_CORNERS = 512, /* 3 x 3 x 64: those of their other corner rays, by corner and axis */
    SCRATCH_LOW = 1088,     /* 64: a triangle's bounds relative to the origin: smallest x y z ... */
    SCRATCH_HIGH = 1152,    /* 64: ... and largest */
    SCRATCH_STACK = 1216,   /* traversal stack: 8 bytes an entry, one per level at most */
    SCRATCH_STACK_ENTRY = 8,
    SCRATCH_END = SCRATCH_STACK + SCRATCH_STACK_ENTRY * (BVH_MAX_DEPTH + 1)
};

#endif
