#include "kernels/job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_shadow.h"

/* Relative widening of directions for box tests: 256 units in the last place (kernels/slab16.h says why). */
static const float slack_relative = 0x1p-16f;
/* Rounding error of a corner test, in units of |edge|_1 |direction|_inf (kernels/mft/corner_cull.h says why). */
static const float guard_relative = 0x1p-20f;

/* The order of operations that the kernels use for delta; monotone in the pixel, so extremes lie at the corners. */
static void fill_deltas(job_constants *k, const scene_primary_rays *rays)
{
    for (int axis = 0; axis < 3; axis++)
        for (int j = 0; j < 16; j++) {
            float right = (float)(j & 3) * rays->dx[axis];
            float down = (float)(j >> 2) * rays->dy[axis];
            k->delta[axis][j] = right + down;
        }
}

static void direction_bounds(job_constants *k, const scene_primary_rays *rays, unsigned width, unsigned height)
{
    double length = 0, largest = 0;
    for (int corner = 0; corner < 4; corner++) {
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            double d = (double)rays->d00[axis] + (corner & 1 ? width : 0) * (double)rays->dx[axis] +
                       (corner & 2 ? height : 0) * (double)rays->dy[axis];
            square += d * d;
            largest = fmax(largest, fabs(d));
        }
        length = fmax(length, sqrt(square));
    }
    k->slack = slack_relative * (float)length;
    k->reach = 0.5f * k->slack; /* the other half is for the rounding of the box tests */
    k->guard = guard_relative * (float)largest;
}

static void fill_constants(kernel_job *job, const scene_primary_rays *rays)
{
    job_constants *k = job->constants_host;
    memset(k, 0, sizeof *k);
    for (int i = 0; i < 16; i++) {
        int axis = i & 3;
        k->origin_box[i] = axis < 3 ? rays->origin[axis] : 0.0f;
        k->origin_triangle[i] = axis < 3 && i < 12 ? rays->origin[axis] : 0.0f;
        k->block_x[i] = (float)(4 * (i & 3));
        k->block_y[i] = (float)(4 * (i >> 2));
        k->absolute[i] = 0x7fffffffu;
        k->infinity[i] = INFINITY;
        k->no_pixel[i] = -INFINITY;
    }
    fill_deltas(k, rays);
    direction_bounds(k, rays, (job->tiles_x + 1) * JOB_TILE_PIXELS, (job->tiles_y + 1) * JOB_TILE_PIXELS);
    memcpy(k->d00, rays->d00, sizeof k->d00);
    memcpy(k->dx, rays->dx, sizeof k->dx);
    memcpy(k->dy, rays->dy, sizeof k->dy);
    k->tiny = 1e-18f;
    k->minus_tiny = -1e-18f;
    k->no_hit = JOB_NO_HIT;
}

static void fill_tiles(kernel_job *job)
{
    for (uint32_t tile = 0; tile < kernel_job_tiles(job); tile++) {
        job_tile *t = &job->tiles_host[tile];
        unsigned x0 = tile % job->tiles_x * JOB_TILE_PIXELS, y0 = tile / job->tiles_x * JOB_TILE_PIXELS;
        memset(t, 0, sizeof *t);
        t->x = (float)x0;
        t->y = (float)y0;
        for (unsigned i = 0; i < 256; i++) {
            unsigned block = i / 16, j = i % 16;
            unsigned x = x0 + 4 * (block & 3) + (j & 3), y = y0 + 4 * (block >> 2) + (j >> 2);
            if (x < job->width && y < job->height)
                t->pixels[block] |= (uint16_t)(1u << j);
        }
        for (unsigned block = 0; block < 16; block++)
            t->blocks |= (t->pixels[block] ? 1u : 0u) << block;
    }
}

static base_status map_segments(kernel_job *job, base_error *err)
{
    lrb_memory memory = lrb_memory_empty();
    base_status status = lrb_memory_map(&memory, "constants", job->constants_host, sizeof *job->constants_host, &job->constants, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "tiles", job->tiles_host, kernel_job_tiles(job) * sizeof *job->tiles_host, &job->tiles, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "frame", job->frame_host, kernel_job_tiles(job) * sizeof *job->frame_host, &job->frame, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "BVH nodes", job->tree->nodes, job->tree->node_count * sizeof *job->tree->nodes,
                                &job->nodes, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "triangle records", job->tree->records,
                                job->tree->record_count * sizeof *job->tree->records, &job->records, err);
    if (status != BASE_OK || job->sample_passes == 0)
        return status;
    status = lrb_memory_map(&memory, "light samples", job->samples_host, job->samples.size, &job->samples, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "normals", job->normals_host, job->normals.size, &job->normals, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "shadows", job->shadows_host, job->shadows.size, &job->shadows, err);
    return status;
}

base_status kernel_job_create(const bvh *tree, const scene_camera *camera, const scene_light *light, unsigned width, unsigned height,
                              const kernel_params *params, kernel_job **out, base_error *err)
{
    if (width < 1 || height < 1 || width > JOB_MAX_SIZE || height > JOB_MAX_SIZE)
        return base_fail(err, BASE_ERR_USAGE, "--size", "%ux%u: width and height must be in 1..%u", width, height, JOB_MAX_SIZE);
    kernel_job *job = calloc(1, sizeof *job);
    if (job) {
        job->params = *params;
        job->width = width;
        job->height = height;
        job->tiles_x = (width + JOB_TILE_PIXELS - 1) / JOB_TILE_PIXELS;
        job->tiles_y = (height + JOB_TILE_PIXELS - 1) / JOB_TILE_PIXELS;
        job->tree = tree;
        job->root_link = tree->nodes[0].link;
        job->root_count = tree->nodes[0].count;
        job->record_count = (uint32_t)tree->record_count;
        job->constants_host = aligned_alloc(64, (sizeof *job->constants_host + 63) / 64 * 64);
        job->tiles_host = aligned_alloc(64, kernel_job_tiles(job) * sizeof *job->tiles_host);
        job->frame_host = aligned_alloc(64, kernel_job_tiles(job) * sizeof *job->frame_host);
    }
    if (!job || !job->constants_host || !job->tiles_host || !job->frame_host) {
        kernel_job_destroy(&job);
        return base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for %ux%u pixels", width, height);
    }
    scene_primary_rays rays = scene_camera_rays(camera, width, height);
    fill_constants(job, &rays);
    fill_tiles(job);
    base_status status = job_shadow_create(job, light, err);
    if (status == BASE_OK)
        status = map_segments(job, err);
    if (status != BASE_OK)
        kernel_job_destroy(&job);
    *out = job;
    return status;
}

void kernel_job_destroy(kernel_job **job)
{
    if (*job) {
        free((*job)->constants_host);
        free((*job)->tiles_host);
        free((*job)->frame_host);
        job_shadow_destroy(*job);
        free(*job);
    }
    *job = NULL;
}

void kernel_job_direction(const kernel_job *job, unsigned x, unsigned y, float direction[3])
{
    const job_constants *k = job->constants_host;
    job_pixel p = kernel_job_pixel(job, x, y);
    const job_tile *tile = &job->tiles_host[p.tile];
    for (int axis = 0; axis < 3; axis++) {
        float right = fmaf(tile->x + k->block_x[p.block], k->dx[axis], k->d00[axis]);
        float corner = fmaf(tile->y + k->block_y[p.block], k->dy[axis], right);
        direction[axis] = corner + k->delta[axis][p.pixel];
    }
}
