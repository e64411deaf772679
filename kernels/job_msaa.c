#include "kernels/job_msaa.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/accel/bvh_edges.h"

/* The outermost samples are 3/8 of a pixel from its middle; the rest is for the rounding of projected vertices, which is below
   1/200 of a pixel in a picture of JOB_MAX_SIZE. */
static const float cell_reach = 0.375f + 1.0f / 64;

/* A volume that lies within so much of its products' magnitudes of 0 may have either sign: three roundings and those of the edge
   plane, 6 units of 2^-24, and the vertex's own. */
static const float volume_tolerance = 0x1p-20f;

/* The inverse of the matrix whose columns are dx, dy, d00: its rows give pixel x and y times depth, and depth. */
static void fill_projection(job_msaa_constants *k, const scene_primary_rays *rays)
{
    const float *column[3] = {rays->dx, rays->dy, rays->d00};
    float *row[3] = {k->image_x, k->image_y, k->depth};
    double cross[3][3], determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++) {
            const float *a = column[(i + 1) % 3], *b = column[(i + 2) % 3];
            const int j = (axis + 1) % 3, l = (axis + 2) % 3;
            cross[i][axis] = (double)a[j] * (double)b[l] - (double)a[l] * (double)b[j];
        }
    for (int axis = 0; axis < 3; axis++)
        determinant += cross[0][axis] * (double)column[0][axis];
    for (int i = 0; i < 3; i++)
        for (int lane = 0; lane < 16; lane++)
            row[i][lane] = lane % 4 < 3 ? (float)(cross[i][lane % 4] / determinant) : 0.0f;
}

static void fill_constants(job_msaa_constants *k, const scene_primary_rays *rays)
{
    memset(k, 0, sizeof *k);
    for (uint32_t i = 0; i < 16; i++) {
        k->dx[i] = i % 4 < 3 ? rays->dx[i % 4] : 0.0f;
        k->dy[i] = i % 4 < 3 ? rays->dy[i % 4] : 0.0f;
        k->pixel_x[i] = (float)(i % 4);
        k->pixel_y[i] = (float)(i / 4);
        k->lane[i] = i;
    }
    const float edge = (3.0f + 2.0f * cell_reach) / 3.0f;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 16; i++) {
            float right = edge * (float)(i % 4) * rays->dx[axis], down = edge * (float)(i / 4) * rays->dy[axis];
            k->cell[axis][i] = right + down;
        }
        float right = cell_reach * rays->dx[axis], down = cell_reach * rays->dy[axis];
        k->cell_first[axis] = -(right + down);
    }
    fill_projection(k, rays);
    k->reach = cell_reach;
    k->minus_tolerance = -volume_tolerance;
    k->samples_edge = 4.0f;
    k->further = 2.0f;
}

static base_status no_memory(const kernel_job *job, base_error *err)
{
    return base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for the samples of %ux%u pixels", job->width, job->height);
}

base_status job_msaa_create(kernel_job *job, const scene_camera *camera, base_error *err)
{
    const size_t count = job->record_count;
    if (!job->params.msaa)
        return BASE_OK;
    const scene_primary_rays rays = scene_camera_rays(camera, job->width, job->height);
    const scene_primary_rays sample_rays = scene_camera_rays(camera, 4 * job->width, 4 * job->height);
    job->msaa_tiles.size = (size_t)job->tiles_x * job->tiles_y * sizeof *job->msaa_tiles_host;
    job->msaa_constants_host = aligned_alloc(64, sizeof *job->msaa_constants_host);
    job->sample_constants_host = aligned_alloc(64, (sizeof *job->sample_constants_host + 63) / 64 * 64);
    job->msaa_records_host = aligned_alloc(64, 2 * (count ? count : 1) * sizeof *job->msaa_records_host);
    job->msaa_tiles_host = aligned_alloc(64, job->msaa_tiles.size);
    if (!job->msaa_constants_host || !job->sample_constants_host || !job->msaa_records_host || !job->msaa_tiles_host)
        return no_memory(job, err);
    fill_constants(job->msaa_constants_host, &rays);
    job_constants_fill(job->sample_constants_host, &sample_rays, 4 * job->width, 4 * job->height);
    memcpy(job->msaa_records_host, job->tree->records, count * sizeof *job->msaa_records_host);
    job->records_host = job->msaa_records_host;
    return bvh_edges_fill(job->tree, job->params.cull_backface, (bvh_edges *)(void *)(job->msaa_records_host + count), err);
}

void job_msaa_destroy(kernel_job *job)
{
    free(job->msaa_constants_host);
    free(job->sample_constants_host);
    free(job->msaa_records_host);
    free(job->msaa_tiles_host);
}

bool job_msaa_marked(const kernel_job *job, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    return job->msaa_tiles_host[p.tile].marked[p.block] >> p.pixel & 1;
}

const job_frame_tile *job_msaa_samples(const kernel_job *job, unsigned x, unsigned y, unsigned *slot)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    const job_msaa_tile *tile = job->params.msaa ? &job->msaa_tiles_host[p.tile] : NULL;
    unsigned before = 0;
    if (!tile || !job->params.retrace || !job_msaa_marked(job, x, y))
        return NULL;
    for (unsigned block = 0; block < p.block; block++)
        before += (unsigned)__builtin_popcount(tile->marked[block]);
    before += (unsigned)__builtin_popcount(tile->marked[p.block] & ((1u << p.pixel) - 1));
    *slot = before % 16;
    return &tile->samples[before / 16];
}

void job_msaa_direction(const kernel_job *job, unsigned x, unsigned y, unsigned sample, float direction[3])
{
    const job_constants *k = job->sample_constants_host;
    for (int axis = 0; axis < 3; axis++) {
        float right = fmaf((float)(4 * x), k->dx[axis], k->d00[axis]);
        float corner = fmaf((float)(4 * y), k->dy[axis], right);
        direction[axis] = corner + k->delta[axis][sample];
    }
}
