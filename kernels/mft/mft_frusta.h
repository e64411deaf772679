/* A group of 16 frusta of 16 rays with one origin, lane = frustum, as kernels/mft/group_primary.h traces it. */
#ifndef KERNELS_MFT_MFT_FRUSTA_H
#define KERNELS_MFT_MFT_FRUSTA_H

#include "kernels/slab16.h"

typedef struct mft_group {
    lrb_ptr constants, scratch; /* constants: job_constants of the rays */
    lrb_ptr frame;     /* nearest hits by frustum and ray: a job_frame_tile */
    lrb_ptr limits;    /* by frustum and ray: how far it has to be traced; the frame's distances, or more */
    int32_t first;     /* place in scratch of the directions of the frusta's first rays, by axis */
    lrb_v16f origin;   /* for triangle records */
    lrb_v16f delta[3]; /* of the 16 rays of a frustum */
    bool cull, blocks; /* blocks: the frusta are the tile's blocks of pixels */
    bool packets; /* a constant: boxes are tested against the rays */
    kernel_counts *n;
    const void *user;  /* of the two functions, which may be NULL: a triangle is left in the frusta of m after culling, ... */
    void (*survivor)(lrb_ctx *c, const slab16 *s, const struct mft_group *g, lrb_ptr record, lrb_v16f edges, lrb_k16 m);
    /* ... and rays m of frustum f, of directions d, now have it as their nearest hit */
    void (*nearer)(lrb_ctx *c, const struct mft_group *g, lrb_ptr record, lrb_r64 f, const lrb_v16f d[3], lrb_k16 m);
} mft_group;

#endif
