/* Where the marking of silhouettes keeps what registers cannot hold: offsets in the scratch of a hardware thread, behind those of the
 * tracing kernels. What is kept by edge is in all words of the edge's group, as the edge planes are (kernels/scratch.h); what is kept
 * by vertex likewise, the first vertex once more behind the third.
 */
#ifndef KERNELS_MFT_SILHOUETTES_SCRATCH_H
#define KERNELS_MFT_SILHOUETTES_SCRATCH_H

#include "kernels/scratch.h"
#include "lrbni/memory.h"

enum {
    SCRATCH_FIRST_RAYS = (SCRATCH_END + 63) / 64 * 64, /* 3 x 64: directions of the first rays of the 16 blocks, by axis */
    SCRATCH_EXTENT = SCRATCH_FIRST_RAYS + 192,  /* 64: how much a volume changes by a pixel; last group: the same of N.d */
    SCRATCH_CELL = SCRATCH_EXTENT + 64,         /* 64: how much it changes from a pixel's middle to its cell's corner, with rounding */
    SCRATCH_DISTANCE = SCRATCH_CELL + 64,       /* 64: magnitude of the plane's distance */
    SCRATCH_IMAGE_X = SCRATCH_DISTANCE + 64,    /* 3 x 64: pixel x and y times depth, and depth, of the vertices */
    SCRATCH_IMAGE_Y = SCRATCH_IMAGE_X + 64,
    SCRATCH_DEPTH = SCRATCH_IMAGE_Y + 64,
    SCRATCH_NEAREST_END = SCRATCH_DEPTH + 64,   /* 64: smaller depth of an edge's two ends */
    SCRATCH_LEFT = SCRATCH_NEAREST_END + 64,    /* 4: marked pixels that have not been traced, ... */
    SCRATCH_NEXT = SCRATCH_LEFT + 4,            /* 4: ... the number of the next of them, ... */
    SCRATCH_COUNT = SCRATCH_LEFT + 8,           /* 4: ... and of all: general registers are scarce while rays are traced, ... */
    SCRATCH_EDGE = SCRATCH_LEFT + 12,           /* 4: ... and while edges are tested: the edge under test, ... */
    SCRATCH_EDGES_LEFT = SCRATCH_LEFT + 16,     /* 4: ... and the mask of a triangle's silhouettes */
    SCRATCH_MARKED_X = SCRATCH_LEFT + 64,       /* 17 x 64: the marked pixels' x, times 4 ... */
    SCRATCH_MARKED_Y = SCRATCH_MARKED_X + 1088, /* 17 x 64: ... and y */
    SCRATCH_ROWS = SCRATCH_MARKED_Y + 1088,     /* 18 rows of 16 pixels, with one above and one below the tile, and 64 bytes before and behind each */
    SCRATCH_ROW = 128,
    SCRATCH_ROWS_END = SCRATCH_ROWS + 18 * SCRATCH_ROW + 64
};

_Static_assert((int)SCRATCH_ROWS_END <= (int)LRB_SCRATCH_BYTES - 128, "the last two lines belong to the library's intrinsics");

#endif
