/* A job: one kernel's work on one scene and image, laid out in simulated memory. Made once, read by all tiles.
 *
 * Tiles are 16x16 pixels, numbered row by row from the top left; a tile is 4x4 blocks of 4x4 pixels, numbered alike,
 * and the pixels of a block are numbered alike too. One block is one vector of rays.
 */
#ifndef KERNELS_JOB_H
#define KERNELS_JOB_H

#include <stdint.h>

#include "kernels/accel/bvh.h"
#include "lrbni/base/status.h"
#include "lrbni/memory.h"
#include "scene/camera.h"
#include "scene/scene.h"

#define JOB_TILE_PIXELS 16u /* edge of a tile */
#define JOB_MAX_SIZE 16384u /* edge of an image */

#define JOB_NO_HIT UINT32_MAX

/* Parameters of the kernels, set with --param. */
typedef struct kernel_params {
    unsigned cull_backface; /* 1: triangles are hit from their front only */
    unsigned max_leaf;      /* triangles in a leaf of the BVH, at most */
    unsigned bins;          /* of the BVH builder, per axis */
} kernel_params;

/* One row of the table of parameters. */
typedef struct kernel_param_info {
    const char *name;
    unsigned min, max;
    const char *sentence;
    size_t offset; /* of the field in kernel_params */
} kernel_param_info;

/** The parameters that kernels take; *count rows. */
const kernel_param_info *kernel_param_list(size_t *count);

/** Set one parameter from `KEY=VALUE`. Errors: BASE_ERR_USAGE naming the parameter (unknown, not a number, range). */
base_status kernel_params_set(kernel_params *params, const char *assignment, base_error *err);

/* What the kernels read besides the tree: offsets are those of the simulated machine. 64-byte aligned vectors first. */
typedef struct job_constants {
    float origin_box[16];      /* x y z 0, four times: subtracted from a pair of boxes */
    float origin_triangle[16]; /* x y z 0, three times, then 0: subtracted from a triangle record with its normal */
    float block_x[16], block_y[16]; /* pixel offsets of the 16 blocks in a tile */
    float delta[3][16];        /* direction of pixel j of a block, less that of pixel 0, by axis */
    uint32_t absolute[16];     /* 0x7fffffff: clears signs */
    float infinity[16];
    float no_pixel[16];        /* -infinity: the hit distance of a pixel outside the image */
    float d00[3], dx[3], dy[3]; /* directions: pixel (0,0), a pixel to the right, a pixel down */
    float slack;               /* directions are widened by this much for box tests (kernels/slab16.h) */
    float reach;               /* a hit may lie t times this outside its triangle's bounds (kernels/triangle16.h) */
    float tiny, minus_tiny;    /* smallest magnitude of a direction whose reciprocal is formed */
    float guard;               /* factor of the rounding error of corner tests (kernels/mft/corner_cull.h) */
    uint32_t no_hit;
} job_constants;

/* One tile, 64 bytes. */
typedef struct job_tile {
    float x, y;          /* its first pixel */
    uint32_t blocks;     /* bit f: block f holds at least one pixel of the image */
    uint32_t zero;
    uint16_t pixels[16]; /* by block: bit j: pixel j is in the image */
    uint32_t pad[4];
} job_tile;

/* Results of a tile, 4096 bytes: nearest hits by block and pixel. Of pixels outside the image t is -infinity. */
typedef struct job_frame_tile {
    float t[16][16]; /* +infinity: no hit */
    float u[16][16], v[16][16];
    uint32_t id[16][16]; /* JOB_NO_HIT: no hit */
} job_frame_tile;

typedef struct kernel_job {
    kernel_params params;
    unsigned width, height;
    unsigned tiles_x, tiles_y;
    uint32_t root_link, root_count; /* of the tree's root node */
    uint32_t record_count;          /* 0: nothing to hit */
    lrb_segment nodes, records, constants, tiles, frame;
    job_constants *constants_host; /* the segments' host memory; owned */
    job_tile *tiles_host;
    job_frame_tile *frame_host;
    const bvh *tree; /* not owned: must outlive the job */
} kernel_job;

/**
 * Lay out a job.
 *
 * @param tree    owned by the caller, who keeps it as long as the job
 * @param out     free with kernel_job_destroy
 *
 * Errors: BASE_ERR_USAGE for an image size of 0 or beyond JOB_MAX_SIZE, BASE_ERR_INPUT if the simulated memory cannot
 * hold it, BASE_ERR_NOMEM.
 */
base_status kernel_job_create(const bvh *tree, const scene_camera *camera, unsigned width, unsigned height,
                              const kernel_params *params, kernel_job **out, base_error *err);

/** Free a job; sets the pointer to NULL. */
void kernel_job_destroy(kernel_job **job);

/** Number of tiles. */
static inline uint32_t kernel_job_tiles(const kernel_job *job) { return job->tiles_x * job->tiles_y; }

/* Where in the frame a pixel's result is. */
typedef struct job_pixel {
    uint32_t tile;
    unsigned block, pixel;
} job_pixel;

/** Place of image pixel (x, y). */
static inline job_pixel kernel_job_pixel(const kernel_job *job, unsigned x, unsigned y)
{
    return (job_pixel){
        .tile = y / JOB_TILE_PIXELS * job->tiles_x + x / JOB_TILE_PIXELS,
        .block = y % 16 / 4 * 4 + x % 16 / 4,
        .pixel = y % 4 * 4 + x % 4,
    };
}

/** Direction of the primary ray of image pixel (x, y), the bits that the kernels trace. */
void kernel_job_direction(const kernel_job *job, unsigned x, unsigned y, float direction[3]);

#endif
