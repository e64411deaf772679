#include "tests/kernels/filter_oracle.h"

#include <math.h>
#include <stdbool.h>

static const float least_cosine = 0.95f, most_depth_step = 0.02f;

/* a . b, as the kernels round it. */
static float dot(const float a[3], const float b[3]) { return fmaf(a[2], b[2], fmaf(a[1], b[1], a[0] * b[0])); }

/* What the filter knows of a pixel. */
typedef struct surface {
    bool hit;
    float depth, visibility, normal[3]; /* on the viewer's side */
} surface;

static surface surface_at(const kernel_job *job, unsigned x, unsigned y)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    const job_frame_tile *tile = &job->frame_host[p.tile];
    const uint32_t id = tile->id[p.block][p.pixel];
    surface s = {.hit = id != JOB_NO_HIT, .depth = tile->t[p.block][p.pixel]};
    float d[3];
    if (!s.hit)
        return s;
    s.visibility = job->shadows_host[p.tile].visibility[p.block][p.pixel];
    kernel_job_direction(job, x, y, d);
    const float *n = job->normals_host[id];
    const float side = dot(n, d) > 0.0f ? -1.0f : 1.0f;
    for (int axis = 0; axis < 3; axis++)
        s.normal[axis] = side * n[axis];
    return s;
}

static bool compatible(const surface *a, const surface *b)
{
    return b->hit && dot(a->normal, b->normal) >= least_cosine && fabsf(a->depth - b->depth) <= most_depth_step * fminf(a->depth, b->depth);
}

static float filtered(const kernel_job *job, unsigned x, unsigned y)
{
    const surface own = surface_at(job, x, y);
    float sum = own.visibility;
    int count = 1;
    for (int dy = -1; own.hit && dy <= 2; dy++)
        for (int dx = -1; dx <= 2; dx++) {
            const long other_x = (long)x + dx, other_y = (long)y + dy;
            if ((dx == 0 && dy == 0) || other_x < 0 || other_y < 0 || other_x >= (long)job->width || other_y >= (long)job->height)
                continue;
            const surface other = surface_at(job, (unsigned)other_x, (unsigned)other_y);
            if (!compatible(&own, &other))
                continue;
            sum += other.visibility;
            count++;
        }
    return own.hit ? sum / (float)count : 1.0f;
}

void filter_oracle(const kernel_job *job, float *out)
{
    for (unsigned y = 0; y < job->height; y++)
        for (unsigned x = 0; x < job->width; x++)
            out[(size_t)y * job->width + x] = filtered(job, x, y);
}
