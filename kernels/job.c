#include "kernels/job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_msaa.h"
#include "kernels/job_shadow.h"

/* Relative widening of directions for box tests: 256 units in the last place (kernels/slab16.h says why). */
static const float slack_relative = 0x1p-16f;
/* Rounding error of a corner test, in units of |edge|_1 |direction|_inf (kernels/mft/corner_cull.h says why). */
static const float guard_relative = 0x1p-20f;

/* The root cell less the origin, in the float operation that kernels use for planes. */
static void fill_cells(const kernel_job *job, job_cells *k, const scene_primary_rays *rays)
{
    memset(k, 0, sizeof *k);
    for (int axis = 0; axis < 3; axis++) {
        k->box[axis] = k->cell[axis] = job->kdtree->min[axis] - rays->origin[axis];
        k->box[4 + axis] = job->kdtree->max[axis] - rays->origin[axis];
        k->cell[4 + axis] = -k->box[4 + axis];
        for (int lane = 4 * axis; lane < 4 * axis + 4; lane++) {
            k->d00[lane] = rays->d00[axis];
            k->dx[lane] = rays->dx[axis];
            k->dy[lane] = rays->dy[axis];
        }
    }
    k->cell[7] = -INFINITY;
    for (int i = 0; i < 16; i++)
        k->signs[i] = i / 4 == 1 ? -1.0f : 1.0f;
    k->eighth = 0.125f;
    k->alike = 0.9f;
    k->untraced = 0xffff;
    k->unblocked = 0xfffe;
    k->plane_error = 2.0f * job->constants_host->guard * (job->constants_host->guard / guard_relative);
    k->margin = 0x1p-14f;
}

/* Rays from the light's point to hit points: constants and cells of their own. No direction is longer than the way to the farthest
   corner of the scene, but for the lift of its end. */
static void fill_light_cells(const kernel_job *job)
{
    job_constants *k = job->light_constants_host;
    scene_primary_rays rays = {.d00 = {0}};
    double square = 0;
    *k = *job->constants_host;
    memcpy(rays.origin, k->light.point, sizeof rays.origin);
    for (int axis = 0; axis < 3 && job->record_count; axis++) {
        double low = (double)rays.origin[axis] - (double)job->kdtree->min[axis], high = (double)job->kdtree->max[axis] - (double)rays.origin[axis];
        double farthest = fmax(fabs(low), fabs(high)) + (double)k->light.lift;
        square += farthest * farthest;
    }
    for (int i = 0; i < 12; i++)
        k->origin_box[i] = k->origin_triangle[i] = i % 4 < 3 ? rays.origin[i % 4] : 0.0f;
    for (int i = 12; i < 15; i++)
        k->origin_box[i] = rays.origin[i % 4];
    k->slack = slack_relative * (float)sqrt(square);
    k->reach = 0.5f * k->slack;
    k->guard = guard_relative * (float)sqrt(square);
    fill_cells(job, &job->cells_host[1], &rays);
    job->cells_host[1].cell[7] = -1.0f;
}

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

void job_constants_fill(job_constants *k, const scene_primary_rays *rays, unsigned width, unsigned height)
{
    const unsigned tiles_x = (width + JOB_TILE_PIXELS - 1) / JOB_TILE_PIXELS, tiles_y = (height + JOB_TILE_PIXELS - 1) / JOB_TILE_PIXELS;
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
    direction_bounds(k, rays, (tiles_x + 1) * JOB_TILE_PIXELS, (tiles_y + 1) * JOB_TILE_PIXELS);
    memcpy(k->d00, rays->d00, sizeof k->d00);
    memcpy(k->dx, rays->dx, sizeof k->dx);
    memcpy(k->dy, rays->dy, sizeof k->dy);
    k->tiny = 1e-18f;
    k->minus_tiny = -1e-18f;
    k->no_hit = JOB_NO_HIT;
    k->half = 0.5f;
}

static uint32_t frame_tiles(const kernel_job *job) { return job->tiles_x * job->tiles_y; }

static void fill_tiles(kernel_job *job)
{
    for (uint32_t tile = 0; tile < frame_tiles(job); tile++) {
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

static base_status map_tree(kernel_job *job, lrb_memory *memory, base_error *err)
{
    const kdtree *k = job->kdtree;
    base_status status;
    if (!k) {
        status = lrb_memory_map(memory, "BVH nodes", job->tree->nodes, job->tree->node_count * sizeof *job->tree->nodes, &job->nodes, err);
    } else {
        status = lrb_memory_map(memory, "kd-tree nodes", k->nodes, k->node_count * sizeof *k->nodes, &job->nodes, err);
        if (status == BASE_OK)
            status = lrb_memory_map(memory, "kd-tree lists", k->lists, k->list_count * sizeof *k->lists, &job->lists, err);
        if (status == BASE_OK)
            status = lrb_memory_map(memory, "kd-tree cells", job->cells_host, 2 * sizeof *job->cells_host, &job->cells, err);
        if (status == BASE_OK && job->light_constants_host)
            status = lrb_memory_map(memory, "light constants", job->light_constants_host, sizeof *job->light_constants_host,
                                    &job->light_constants, err);
    }
    if (status == BASE_OK)
        status = lrb_memory_map(memory, "triangle records", job->records_host,
                                job->record_count * sizeof *job->records_host * (job->params.msaa ? 2 : 1), &job->records, err);
    return status;
}

static base_status map_msaa(kernel_job *job, lrb_memory *memory, base_error *err)
{
    base_status status = lrb_memory_map(memory, "anti-aliasing constants", job->msaa_constants_host, sizeof *job->msaa_constants_host,
                                        &job->msaa_constants, err);
    if (status == BASE_OK)
        status = lrb_memory_map(memory, "sample constants", job->sample_constants_host, sizeof *job->sample_constants_host,
                                &job->sample_constants, err);
    if (status == BASE_OK)
        status = lrb_memory_map(memory, "samples", job->msaa_tiles_host, job->msaa_tiles.size, &job->msaa_tiles, err);
    return status;
}

static base_status map_shader(kernel_job *job, lrb_memory *memory, base_error *err)
{
    base_status status = lrb_memory_map(memory, "normals", job->normals_host, job->normals.size, &job->normals, err);
    if (status == BASE_OK)
        status = lrb_memory_map(memory, "shades", job->shades_host, job->shades.size, &job->shades, err);
    return status;
}

static base_status map_segments(kernel_job *job, base_error *err)
{
    lrb_memory memory = lrb_memory_empty();
    base_status status = lrb_memory_map(&memory, "constants", job->constants_host, sizeof *job->constants_host, &job->constants, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "tiles", job->tiles_host, frame_tiles(job) * sizeof *job->tiles_host, &job->tiles, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "frame", job->frame_host, frame_tiles(job) * sizeof *job->frame_host, &job->frame, err);
    if (status == BASE_OK)
        status = map_tree(job, &memory, err);
    if (status == BASE_OK && job->params.msaa)
        status = map_msaa(job, &memory, err);
    if (status == BASE_OK && job->shades_host)
        status = map_shader(job, &memory, err);
    if (status != BASE_OK || !job->shadows_host)
        return status;
    if (job->samples_host)
        status = lrb_memory_map(&memory, "light samples", job->samples_host, job->samples.size, &job->samples, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "normals", job->normals_host, job->normals.size, &job->normals, err);
    if (status == BASE_OK)
        status = lrb_memory_map(&memory, "shadows", job->shadows_host, job->shadows.size, &job->shadows, err);
    if (status == BASE_OK && job->rows_host)
        status = lrb_memory_map(&memory, "filter constants", job->filter_host, sizeof *job->filter_host, &job->filter, err);
    if (status == BASE_OK && job->rows_host)
        status = lrb_memory_map(&memory, "pixel rows", job->rows_host, job->rows.size, &job->rows, err);
    return status;
}

/* The tree's part of a job. */
static void take_tree(kernel_job *job, const bvh *tree, const kdtree *kd)
{
    job->tree = tree;
    job->kdtree = kd;
    job->records_host = tree ? tree->records : kd->records;
    job->record_count = (uint32_t)(tree ? tree->record_count : kd->record_count);
    if (tree) {
        job->root_link = tree->nodes[0].link;
        job->root_count = tree->nodes[0].count;
    }
}

static base_status create(const bvh *tree, const kdtree *kd, unsigned unit_log2, const scene_camera *camera, const scene_light *light,
                          unsigned width, unsigned height, const kernel_params *params, kernel_job **out, base_error *err)
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
        job->unit_log2 = unit_log2;
        take_tree(job, tree, kd);
        job->constants_host = aligned_alloc(64, (sizeof *job->constants_host + 63) / 64 * 64);
        job->tiles_host = aligned_alloc(64, frame_tiles(job) * sizeof *job->tiles_host);
        job->frame_host = aligned_alloc(64, frame_tiles(job) * sizeof *job->frame_host);
        job->complexity_host = kd ? calloc(frame_tiles(job), sizeof *job->complexity_host) : NULL;
        job->cells_host = kd ? aligned_alloc(64, 2 * sizeof *job->cells_host) : NULL;
        job->light_constants_host = kd && params->hard_shadows ? aligned_alloc(64, (sizeof *job->constants_host + 63) / 64 * 64) : NULL;
    }
    if (!job || !job->constants_host || !job->tiles_host || !job->frame_host || (kd && (!job->cells_host || !job->complexity_host)) ||
        (kd && params->hard_shadows && !job->light_constants_host)) {
        kernel_job_destroy(&job);
        return base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for %ux%u pixels", width, height);
    }
    scene_primary_rays rays = scene_camera_rays(camera, width, height);
    job_constants_fill(job->constants_host, &rays, width, height);
    fill_tiles(job);
    if (kd)
        fill_cells(job, job->cells_host, &rays);
    base_status status = job_shadow_create(job, light, err);
    if (status == BASE_OK && job->light_constants_host)
        fill_light_cells(job);
    if (status == BASE_OK)
        status = job_msaa_create(job, camera, err);
    if (status == BASE_OK)
        status = map_segments(job, err);
    if (status != BASE_OK)
        kernel_job_destroy(&job);
    *out = job;
    return status;
}

base_status kernel_job_create(const bvh *tree, const scene_camera *camera, const scene_light *light, unsigned width, unsigned height,
                              const kernel_params *params, kernel_job **out, base_error *err)
{
    return create(tree, NULL, 0, camera, light, width, height, params, out, err);
}

base_status kernel_job_create_kdtree(const kdtree *tree, const scene_camera *camera, const scene_light *light, unsigned width,
                                     unsigned height, const kernel_params *params, kernel_job **out, base_error *err)
{
    return create(NULL, tree, params->its, camera, light, width, height, params, out, err);
}

void kernel_job_destroy(kernel_job **job)
{
    if (*job) {
        free((*job)->constants_host);
        free((*job)->tiles_host);
        free((*job)->frame_host);
        free((*job)->cells_host);
        free((*job)->complexity_host);
        free((*job)->light_constants_host);
        job_shadow_destroy(*job);
        job_msaa_destroy(*job);
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
