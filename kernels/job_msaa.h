/* The anti-aliasing part of a job: what marks pixels that silhouettes cross, and the 16 samples of each (Benthin and Wald 2009, 6.1).
 *
 * The samples of a pixel are the pixels of a picture four times as wide and as high, a block of which is one pixel of ours: their
 * rays are those of that picture, bit for bit.
 */
#ifndef KERNELS_JOB_MSAA_H
#define KERNELS_JOB_MSAA_H

#include <stdbool.h>

#include "kernels/job.h"

/* What marking reads besides: 64-byte aligned vectors first. A group is four lanes. */
typedef struct job_msaa_constants {
    float dx[16], dy[16];     /* directions of job_constants, x y z 0 in each group */
    float image_x[16], image_y[16], depth[16]; /* likewise: dot products with a place relative to the eye: pixel x and y times depth, and depth */
    float cell[3][16];        /* by axis: what takes the first corner of a block's frustum to its three others, numbered as rays */
    float pixel_x[16], pixel_y[16]; /* of the pixels of a block */
    uint32_t lane[16];        /* 0 to 15 */
    float cell_first[3];      /* from a block's first ray to the first corner of its frustum */
    float reach;              /* half the width of a pixel's cell, in pixels */
    float minus_tolerance;    /* rounding of a volume, as a share of the sum of its products' magnitudes; negative */
    float samples_edge;       /* 4: samples of a pixel, in either direction */
    float further;            /* 2: pixels beside a ray up to which the surface that it has hit is followed */
    float pad[9];
} job_msaa_constants;

/* Results of a tile. */
typedef struct job_msaa_tile {
    float limit[16][16]; /* by block and pixel: the surface in the pixel's middle is no farther near the pixel; +infinity: there is none */
    float edge[16][16];  /* distance of the nearest silhouette in the pixel, at most; +infinity: none */
    uint32_t marked[16]; /* by block: bit j: pixel j is marked */
    job_frame_tile samples[16]; /* nearest hits of the marked pixels' samples; those pixels by block and pixel, 16 to a frame */
} job_msaa_tile;

/**
 * Lay out the anti-aliasing part if params.msaa is set; replaces the job's records by a copy with the edges behind it. Maps no
 * segment.
 *
 * @param job   with its tree; owns what is allocated, also after a failure
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status job_msaa_create(kernel_job *job, const scene_camera *camera, base_error *err);

/** Free what job_msaa_create has allocated. */
void job_msaa_destroy(kernel_job *job);

/** Whether image pixel (x, y) is marked. */
bool job_msaa_marked(const kernel_job *job, unsigned x, unsigned y);

/** Nearest hits of a pixel's samples: row *slot of the frame. NULL if it has none: it is not marked, or was not traced again. */
const job_frame_tile *job_msaa_samples(const kernel_job *job, unsigned x, unsigned y, unsigned *slot);

/** Direction of sample 0..15 of image pixel (x, y), the bits that the kernel traces. */
void job_msaa_direction(const kernel_job *job, unsigned x, unsigned y, unsigned sample, float direction[3]);

#endif
