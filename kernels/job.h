/* A job: one kernel's work on one scene and image, laid out in simulated memory. Made once, read by all tiles.
 *
 * Tiles are 16x16 pixels, numbered row by row from the top left; a tile is 4x4 blocks of 4x4 pixels, numbered alike,
 * and the pixels of a block are numbered alike too. One block is one vector of rays.
 */
#ifndef KERNELS_JOB_H
#define KERNELS_JOB_H

#include <stdbool.h>
#include <stdint.h>

#include "kernels/accel/bvh.h"
#include "kernels/accel/kdtree.h"
#include "kernels/params.h"
#include "lrbni/base/status.h"
#include "lrbni/memory.h"
#include "scene/camera.h"
#include "scene/light.h"
#include "scene/scene.h"

#define JOB_TILE_PIXELS 16u /* edge of a tile */
#define JOB_MAX_SIZE 16384u /* edge of an image */

#define JOB_NO_HIT UINT32_MAX

/* The light and what shadow rays need besides (kernels/shadow16.h). Lengths are those of the scene. */
typedef struct job_light {
    float corner[3], u[3], v[3], uv[3]; /* of the parallelogram; uv = u + v */
    float normal[3];                    /* u x v as the scene gave them, at unit length: the light shines to this side */
    float point[3];                     /* of the light for shading and for hard shadows */
    float lift;                         /* a shadow ray starts this far above its surface */
    float nearest, farthest;            /* a hit blocks if its distance is between these; the light is at 1 */
    float slack, reach, guard;          /* as in job_constants, for directions of length 1 */
    float share;                        /* of a sample in the visibility */
    float one;
    uint32_t all_samples, untaken_samples;        /* bits of a set */
    uint32_t count_shift[4], count_fields[4];     /* for counting bits */
} job_light;

/* A set of 16 samples of the light, in lanes; 512 bytes. */
typedef struct job_sample_set {
    float delta[3][16];   /* by axis: a*u + b*v */
    float a[16], b[16];
    float pad[3][16];
} job_sample_set;

/* Shadows of a tile, by block and pixel. */
typedef struct job_shadow_tile {
    uint32_t occlusion[16][16]; /* bit j: sample j of the pixel's last set is blocked, or is not taken */
    float visibility[16][16];   /* the fraction of the light that is seen, by all sets */
} job_shadow_tile;

/* What the simple shader makes of a tile's hits, by block and pixel: the cosine between ray and surface; 0: no hit. */
typedef struct job_shade_tile {
    float shade[16][16];
} job_shade_tile;

/* What the filter of soft shadows reads and writes of 16 pixels side by side, a row of a tile: a line for each, 512 bytes. */
typedef struct job_row {
    float depth[16];      /* +infinity: no hit, or not in the image */
    float visibility[16]; /* the fraction of the light that is seen */
    float normal[3][16];  /* of unit length, on the viewer's side */
    float shading[16];    /* what the light's point would lend the surface if it were seen: a cosine; 0: no hit */
    float filtered[16];   /* visibility, as the filter leaves it; 1: no hit */
    float lit[16];        /* shading times visibility, filtered if the job has a filter */
} job_row;

/* Constants of shading and filter; 64-byte aligned vectors first. */
typedef struct job_filter {
    float reciprocal[16]; /* of 1..16 */
    float least_cosine, most_step; /* of neighbours that are mixed: between their normals; in depth, as a share of the smaller */
    float infinity, half, one;
    uint32_t absolute; /* 0x7fffffff: clears a sign */
    float pad[10];
} job_filter;

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
    job_light light;
    float half;
} job_constants;

/** Fill in the constants of a picture's rays; the light is 0. */
void job_constants_fill(job_constants *k, const scene_primary_rays *rays, unsigned width, unsigned height);

/* The root cell of a kd-tree as rays with one origin see it, and their directions: for kernels that traverse one. */
typedef struct job_cells {
    float cell[16]; /* min x y z less the origin, 0; minus (max x y z less the origin), minus the largest distance; 0 */
    float box[16];  /* min x y z less the origin, 0, max x y z less the origin, 0; 0 */
    float d00[16], dx[16], dy[16]; /* those of job_constants, an axis to each group of four lanes; the last group is 0 */
    float signs[16]; /* 1, but -1 in words 4 to 7 */
    float eighth, margin; /* what tells a distance from its rounding, and as a share of it keeps a hit inside a cell (kernels/mlrta/entry_end.h) */
    float plane_error;   /* of the normals of planes through two corner rays, at most */
    float alike;         /* cosine of the angle between surfaces that face alike, at least */
    uint32_t untraced, unblocked; /* occlusion bits of a pixel with no shadow ray, or with one that reaches the light */
    float pad[10];
} job_cells;

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
    unsigned unit_log2;             /* a unit of work is a square of 2^unit_log2 tiles an edge */
    lrb_segment nodes, records, constants, tiles, frame;
    lrb_segment lists, cells;       /* of a kd-tree; of cells the second are those of rays from the light */
    lrb_segment light_constants;    /* constants of rays from the light */
    unsigned sample_passes;         /* sets of samples that a pixel uses one after another; 0: no shadow rays */
    uint32_t sample_mask;           /* samples of a set that are taken */
    lrb_segment samples, normals, shadows; /* these and their host memory: only if there are shadow rays (normals: or a shader) */
    lrb_segment shades;             /* this: only if there is a shader */
    lrb_segment filter, rows;       /* these: only if there are soft shadows */
    bool filtered;                  /* there is a second pass, of a unit a tile, which filters them */
    job_constants *constants_host; /* the segments' host memory; owned */
    job_tile *tiles_host;
    job_frame_tile *frame_host;
    job_sample_set *samples_host;
    float (*normals_host)[4]; /* unit normals by triangle id, the fourth float 0 */
    job_shadow_tile *shadows_host;
    job_shade_tile *shades_host;
    job_filter *filter_host;
    job_row *rows_host; /* by row of pixels, from the one above the image, and in it from a tile to its left; edges have no hits */
    job_cells *cells_host; /* two */
    uint32_t (*complexity_host)[16]; /* of a kd-tree, by tile of the frame and block; kernel_job_complexity */
    job_constants *light_constants_host; /* NULL: there are no hard shadows */
    lrb_segment msaa_constants, sample_constants, msaa_tiles; /* these and their host memory: only of kernels with anti-aliasing */
    struct job_msaa_constants *msaa_constants_host; /* kernels/job_msaa.h */
    job_constants *sample_constants_host;           /* of the rays of samples */
    struct job_msaa_tile *msaa_tiles_host;
    bvh_triangle *msaa_records_host; /* the tree's, and behind them the same number of bvh_edges (kernels/accel/bvh_edges.h) */
    bvh_triangle *records_host; /* of the tree */
    const bvh *tree;            /* one of the two; not owned: must outlive the job */
    const kdtree *kdtree;
} kernel_job;

/**
 * Lay out a job.
 *
 * @param tree    owned by the caller, who keeps it as long as the job
 * @param light   of the scene, not scaled; NULL only for a kernel that uses none
 * @param out     free with kernel_job_destroy
 *
 * Errors: BASE_ERR_USAGE for an image size of 0 or beyond JOB_MAX_SIZE, BASE_ERR_INPUT if the simulated memory cannot
 * hold it, BASE_ERR_NOMEM.
 */
base_status kernel_job_create(const bvh *tree, const scene_camera *camera, const scene_light *light, unsigned width, unsigned height,
                              const kernel_params *params, kernel_job **out, base_error *err);

/** The same on a kd-tree, whose empty occluders are marked as the camera asks for it (kdtree_mark_occluders). */
base_status kernel_job_create_kdtree(const kdtree *tree, const scene_camera *camera, const scene_light *light, unsigned width,
                                     unsigned height, const kernel_params *params, kernel_job **out, base_error *err);

/** Free a job; sets the pointer to NULL. */
void kernel_job_destroy(kernel_job **job);

/** Number of units of work of the first pass: tiles, or squares of them, in any order. */
static inline uint32_t kernel_job_first_pass(const kernel_job *job)
{
    const unsigned edge = 1u << job->unit_log2;
    return (job->tiles_x + edge - 1) / edge * ((job->tiles_y + edge - 1) / edge);
}

/** Number of units of work, what a kernel's tile function is called for. Those beyond the first pass are a second one: unit i more
 * works on tile i, any order again, once the first pass is done. */
static inline uint32_t kernel_job_tiles(const kernel_job *job)
{
    return kernel_job_first_pass(job) + (job->filtered ? job->tiles_x * job->tiles_y : 0);
}

/** Bytes from a row of pixels to the next one. */
static inline uint32_t kernel_job_row_bytes(const kernel_job *job)
{
    return (job->tiles_x + 2) * (uint32_t)sizeof(job_row);
}

/** Where the rows of a tile begin in the segment of rows. */
static inline uint32_t kernel_job_row_offset(const kernel_job *job, uint32_t tile)
{
    const uint32_t y = tile / job->tiles_x * JOB_TILE_PIXELS + 1, x = tile % job->tiles_x + 1;
    return y * kernel_job_row_bytes(job) + x * (uint32_t)sizeof(job_row);
}

/** The row of 16 pixels that image pixel (x, y) is in; it is number x mod 16 there. Only of a job with soft shadows. */
static inline const job_row *kernel_job_row(const kernel_job *job, unsigned x, unsigned y)
{
    return &job->rows_host[(size_t)(y + 1) * (job->tiles_x + 2) + x / JOB_TILE_PIXELS + 1];
}

/* Where in the frame a pixel's result is, and which unit of work makes it. */
typedef struct job_pixel {
    uint32_t tile;
    unsigned block, pixel;
    uint32_t unit;
    unsigned region; /* sixteenth of the unit, numbered as blocks of a tile: of a unit of one tile, the block */
} job_pixel;

/** Place of image pixel (x, y). */
static inline job_pixel kernel_job_pixel(const kernel_job *job, unsigned x, unsigned y)
{
    const unsigned edge = JOB_TILE_PIXELS << job->unit_log2, units_x = (job->width + edge - 1) / edge;
    return (job_pixel){
        .tile = y / JOB_TILE_PIXELS * job->tiles_x + x / JOB_TILE_PIXELS,
        .block = y % 16 / 4 * 4 + x % 16 / 4,
        .pixel = y % 4 * 4 + x % 4,
        .unit = y / edge * units_x + x / edge,
        .region = y % edge / (edge / 4) * 4 + x % edge / (edge / 4),
    };
}

/**
 * The complexity of what the packet of image pixel (x, y) saw (Reshetov, Soupikov and Hurley 2005, 4.2): nodes of the subtree that it was
 * traced from, 1 for a leaf, 0 if its tile could hit nothing. Known once the pixel is traced, of kernels that search entry
 * points; of others 0. A look-up in kdtree.sizes, made by the host and charged to no machine.
 */
static inline uint32_t kernel_job_complexity(const kernel_job *job, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    return job->complexity_host ? job->complexity_host[p.tile][p.block] : 0;
}

/** Direction of the primary ray of image pixel (x, y), the bits that the kernels trace. */
void kernel_job_direction(const kernel_job *job, unsigned x, unsigned y, float direction[3]);

#endif
