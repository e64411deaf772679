#include "kernels/job_shadow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/light_samples.h"

/* A shadow ray starts above its surface by this share of the diagonal of the scene's bounds... */
static const double lift_relative = 1e-4;
/* ...and blockers are looked for this far from either end, as a share of the ray. */
static const float end_relative = 1e-5f;
/* As for primary rays (kernels/job.c); the guard is larger, because corners of the light are rounded more often
   (kernels/mft/lane_cull.h). */
static const float slack_relative = 0x1p-16f, guard_relative = 0x1p-19f;
/* The samples that are taken of a set if there are to be four: one in each row, column and quarter of the grid. */
static const uint32_t four_samples = 1u << 4 | 1u << 13 | 1u << 2 | 1u << 11;

static double diagonal_of(const kernel_job *job)
{
    const float *min = job->tree ? job->tree->nodes[0].min : job->kdtree->min;
    const float *max = job->tree ? job->tree->nodes[0].max : job->kdtree->max;
    double square = 0;
    for (int axis = 0; axis < 3 && job->record_count; axis++) {
        double extent = (double)max[axis] - (double)min[axis];
        square += extent * extent;
    }
    return sqrt(square);
}

static void fill_normal(job_light *l, const scene_light *light)
{
    double n[3], square = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = light->u[j] * light->v[k] - light->u[k] * light->v[j];
        square += n[i] * n[i];
    }
    for (int i = 0; i < 3; i++)
        l->normal[i] = (float)(n[i] / sqrt(square));
}

static void fill_light(kernel_job *job, const scene_light *light)
{
    job_light *l = &job->constants_host->light;
    scene_light scaled = *light;
    scene_light_scale(&scaled, job->params.light_scale);
    fill_normal(l, light);
    for (int axis = 0; axis < 3; axis++) {
        l->corner[axis] = (float)scaled.corner[axis];
        l->u[axis] = (float)scaled.u[axis];
        l->v[axis] = (float)scaled.v[axis];
        l->uv[axis] = l->u[axis] + l->v[axis];
        l->point[axis] = (float)light->point[axis];
    }
    l->lift = (float)(lift_relative * diagonal_of(job));
    l->nearest = end_relative;
    l->farthest = 1.0f - end_relative;
    l->slack = slack_relative;
    l->reach = 0.5f * slack_relative;
    l->guard = guard_relative;
    l->share = job->params.samples ? 1.0f / (float)job->params.samples : 0.0f;
    l->one = 1.0f;
    l->all_samples = 0xffff;
    l->untaken_samples = job->params.samples && job->params.samples < 16 ? 0xffffu & ~four_samples : 0;
    static const uint32_t fields[4] = {0x5555, 0x3333, 0x0f0f, 0x00ff};
    for (unsigned step = 0; step < 4; step++) {
        l->count_shift[step] = 1u << step;
        l->count_fields[step] = fields[step];
    }
}

static void fill_samples(kernel_job *job, const light_samples *sets, unsigned count)
{
    const job_light *l = &job->constants_host->light;
    memset(job->samples_host, 0, count * sizeof *job->samples_host);
    for (unsigned s = 0; s < count; s++)
        for (int j = 0; j < 16; j++) {
            job_sample_set *set = &job->samples_host[s];
            set->a[j] = sets[s].a[j];
            set->b[j] = sets[s].b[j];
            for (int axis = 0; axis < 3; axis++) {
                float along_u = set->a[j] * l->u[axis], along_v = set->b[j] * l->v[axis];
                set->delta[axis][j] = along_u + along_v;
            }
        }
}

static void fill_normals(kernel_job *job)
{
    for (size_t i = 0; i < job->record_count; i++) {
        const bvh_triangle *t = &job->records_host[i];
        double square = 0;
        for (int axis = 0; axis < 3; axis++)
            square += (double)t->normal[axis] * (double)t->normal[axis];
        for (int axis = 0; axis < 3; axis++)
            job->normals_host[t->id][axis] = (float)((double)t->normal[axis] / sqrt(square));
    }
}

/* Triangle ids are below it. */
static size_t id_limit(const kernel_job *job)
{
    size_t limit = 1;
    for (size_t i = 0; i < job->record_count; i++)
        limit = job->records_host[i].id >= limit ? (size_t)job->records_host[i].id + 1 : limit;
    return limit;
}

static bool create_normals(kernel_job *job)
{
    const size_t normals = id_limit(job), bytes = (normals * sizeof *job->normals_host + 63) / 64 * 64;
    job->normals.size = bytes;
    job->normals_host = aligned_alloc(64, job->normals.size);
    if (!job->normals_host)
        return false;
    memset(job->normals_host, 0, bytes);
    fill_normals(job);
    return true;
}

/* Normals and shadows: what hard shadows need as well. */
static bool create_frame(kernel_job *job)
{
    job->shadows.size = (size_t)job->tiles_x * job->tiles_y * sizeof *job->shadows_host;
    job->shadows_host = aligned_alloc(64, job->shadows.size);
    return job->shadows_host && create_normals(job);
}

static base_status create_shader(kernel_job *job, base_error *err)
{
    job->shades.size = (size_t)job->tiles_x * job->tiles_y * sizeof *job->shades_host;
    job->shades_host = aligned_alloc(64, job->shades.size);
    if (job->shades_host && create_normals(job))
        return BASE_OK;
    return base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for the shades of %ux%u pixels", job->width, job->height);
}

/* The limits of the filter are ours: the paper gives none. */
static void fill_filter(job_filter *f)
{
    memset(f, 0, sizeof *f);
    for (int i = 0; i < 16; i++)
        f->reciprocal[i] = 1.0f / (float)(i + 1);
    f->least_cosine = 0.95f;
    f->most_step = 0.02f;
    f->infinity = INFINITY;
    f->half = 0.5f;
    f->one = 1.0f;
    f->absolute = 0x7fffffffu;
}

/* Rows of pixels without hits: the window of the filter reaches a pixel to the left of the image and above it, two to the right and below. */
static bool create_rows(kernel_job *job)
{
    const size_t rows = job->tiles_y * JOB_TILE_PIXELS + 3, count = rows * (job->tiles_x + 2);
    job->filtered = job->params.filter;
    job->rows.size = count * sizeof *job->rows_host;
    job->filter_host = aligned_alloc(64, sizeof *job->filter_host);
    job->rows_host = aligned_alloc(64, job->rows.size);
    if (!job->filter_host || !job->rows_host)
        return false;
    fill_filter(job->filter_host);
    memset(job->rows_host, 0, job->rows.size);
    for (size_t i = 0; i < count; i++)
        for (int x = 0; x < 16; x++) {
            job->rows_host[i].depth[x] = INFINITY;
            job->rows_host[i].filtered[x] = 1.0f;
        }
    return true;
}

static base_status create_hard(kernel_job *job, base_error *err)
{
    if (create_frame(job))
        return BASE_OK;
    return base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for the shadows of %ux%u pixels", job->width, job->height);
}

base_status job_shadow_create(kernel_job *job, const scene_light *light, base_error *err)
{
    const unsigned samples = job->params.samples;
    if (light)
        fill_light(job, light);
    if (job->params.shader)
        return create_shader(job, err);
    if (samples == 0)
        return job->params.hard_shadows ? create_hard(job, err) : BASE_OK;
    base_status status = kernel_params_check_samples(samples, err);
    if (status != BASE_OK)
        return status;
    const unsigned sets = samples > 256 ? samples / 16 : 16;
    light_samples *points = calloc(sets, sizeof *points);
    job->sample_passes = samples > 16 ? samples / 16 : 1;
    job->sample_mask = samples < 16 ? four_samples : 0xffffu;
    job->samples.size = sets * sizeof *job->samples_host;
    job->samples_host = aligned_alloc(64, job->samples.size);
    if (create_frame(job) && create_rows(job) && points && job->samples_host) {
        light_samples_fill(job->params.net, job->params.assignment, sets, points);
        fill_samples(job, points, sets);
    } else {
        status = base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for the shadows of %ux%u pixels", job->width, job->height);
    }
    free(points);
    return status;
}

void job_shadow_destroy(kernel_job *job)
{
    free(job->samples_host);
    free(job->normals_host);
    free(job->shadows_host);
    free(job->shades_host);
    free(job->filter_host);
    free(job->rows_host);
}

unsigned job_shadow_set(const kernel_job *job, unsigned pixel, unsigned pass)
{
    return job->params.interleaved ? pixel ^ pass : pass;
}

/* a . b, as the kernels round it. */
static float dot(const float a[3], const float b[3])
{
    return fmaf(a[2], b[2], fmaf(a[1], b[1], a[0] * b[0]));
}

/* The lifted hit point of a pixel, and its surface's normal on the viewer's side; false without a hit. */
static bool lifted_hit_of(const kernel_job *job, unsigned x, unsigned y, float point[3], float n[3])
{
    const job_constants *k = job->constants_host;
    const job_pixel p = kernel_job_pixel(job, x, y);
    const job_frame_tile *tile = &job->frame_host[p.tile];
    const uint32_t id = tile->id[p.block][p.pixel];
    float d[3];
    if (id == JOB_NO_HIT)
        return false;
    kernel_job_direction(job, x, y, d);
    const float side = dot(job->normals_host[id], d) > 0.0f ? -1.0f : 1.0f;
    for (int axis = 0; axis < 3; axis++) {
        n[axis] = job->normals_host[id][axis] * side;
        point[axis] = fmaf(n[axis], k->light.lift, fmaf(d[axis], tile->t[p.block][p.pixel], k->origin_box[axis]));
    }
    return true;
}

/* Where shadow rays of a pixel start, and whether any of the light's corners is above the surface there. */
static bool start_of(const kernel_job *job, unsigned x, unsigned y, float org[3])
{
    const job_constants *k = job->constants_host;
    float n[3], corner[3], highest = -INFINITY;
    if (!lifted_hit_of(job, x, y, org, n))
        return false;
    for (int axis = 0; axis < 3; axis++)
        corner[axis] = k->light.corner[axis] - org[axis];
    if (!(dot(corner, k->light.normal) < 0.0f))
        return false;
    const float *along[3] = {k->light.u, k->light.uv, k->light.v};
    highest = dot(n, corner);
    for (int i = 0; i < 3; i++) {
        float other[3] = {corner[0] + along[i][0], corner[1] + along[i][1], corner[2] + along[i][2]};
        highest = fmaxf(highest, dot(n, other));
    }
    return highest > 0.0f;
}

bool job_shadow_ray_of(const kernel_job *job, unsigned x, unsigned y, unsigned pass, unsigned sample, job_shadow_ray *out)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    const job_sample_set *set = &job->samples_host[job_shadow_set(job, p.pixel, pass)];
    if (!start_of(job, x, y, out->org))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        float corner = job->constants_host->light.corner[axis] - out->org[axis];
        out->dir[axis] = corner + set->delta[axis][sample];
    }
    return true;
}

bool job_hard_shadow_ray_of(const kernel_job *job, unsigned x, unsigned y, job_shadow_ray *out)
{
    float end[3], n[3];
    if (!lifted_hit_of(job, x, y, end, n))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        out->org[axis] = job->constants_host->light.point[axis];
        out->dir[axis] = end[axis] - out->org[axis];
    }
    return dot(n, out->dir) < 0.0f;
}
