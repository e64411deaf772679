#include "cli/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_msaa.h"
#include "kernels/visibility_filter.h"
#include "reports/heat_map.h"
#include "reports/image_writer.h"

static const float background = 0.75f, ambient = 0.15f, headlight = 0.25f;

static void normalise(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int axis = 0; axis < 3; axis++)
        v[axis] = length > 0 ? v[axis] / length : 0;
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Lambert's law at a hit, for the light's point as far as it is seen and for a weaker light at the camera. */
static double brightness(const run_result *r, uint32_t id, double t, const double direction[3], double visibility)
{
    const scene_triangle *tri = &r->scene->triangles[id];
    double n[3], e[3], f[3], to_light[3], view[3] = {direction[0], direction[1], direction[2]};
    for (int axis = 0; axis < 3; axis++) {
        e[axis] = (double)tri->v[1][axis] - (double)tri->v[0][axis];
        f[axis] = (double)tri->v[2][axis] - (double)tri->v[0][axis];
        to_light[axis] = r->scene->light.point[axis] - (r->camera->position[axis] + t * direction[axis]);
    }
    n[0] = e[1] * f[2] - e[2] * f[1];
    n[1] = e[2] * f[0] - e[0] * f[2];
    n[2] = e[0] * f[1] - e[1] * f[0];
    normalise(n);
    normalise(to_light);
    normalise(view);
    double facing = dot(n, view) < 0 ? 1 : -1; /* the side that is seen is the side that is lit */
    double direct = visibility * fmax(0, facing * dot(n, to_light));
    return (double)ambient + (double)headlight * fabs(dot(n, view)) + (1.0 - (double)ambient - (double)headlight) * direct;
}

/* The fraction of the light that a pixel's hit sees, as it was traced; 1 for kernels without shadows. */
static float visibility(const kernel_job *job, job_pixel p)
{
    return job->shadows_host ? job->shadows_host[p.tile].visibility[p.block][p.pixel] : 1.0f;
}

float *picture_visibility(const run_result *r, bool filtered, base_error *err)
{
    const kernel_job *job = r->job;
    const size_t pixels = (size_t)job->width * job->height;
    float *seen = malloc(pixels * sizeof *seen);
    if (!seen) {
        base_fail(err, BASE_ERR_NOMEM, "image", "out of memory for %zu pixels", pixels);
        return NULL;
    }
    for (size_t i = 0; i < pixels; i++)
        seen[i] = visibility(job, kernel_job_pixel(job, (unsigned)(i % job->width), (unsigned)(i / job->width)));
    if (filtered && job->sample_passes > 0)
        visibility_filter(job, seen);
    return seen;
}

/* What is seen along a direction: added to a pixel. */
static void add_shade(const run_result *r, uint32_t id, float t, const float direction[3], float seen, float share, float pixel[3])
{
    double light = 0, d[3];
    for (int axis = 0; axis < 3; axis++)
        d[axis] = (double)direction[axis];
    if (id != JOB_NO_HIT)
        light = brightness(r, id, (double)t, d, (double)seen);
    for (int channel = 0; channel < 3; channel++)
        pixel[channel] += share * (id == JOB_NO_HIT ? background
                                                    : (float)light * r->scene->materials[r->scene->triangle_material[id]].base_color[channel]);
}

static void shade(const run_result *r, unsigned x, unsigned y, float seen, float pixel[3])
{
    const job_pixel p = kernel_job_pixel(r->job, x, y);
    const job_frame_tile *tile = &r->job->frame_host[p.tile];
    float direction[3];
    unsigned row = 0;
    const job_frame_tile *samples = job_msaa_samples(r->job, x, y, &row);
    for (unsigned j = 0; samples && j < 16; j++) {
        job_msaa_direction(r->job, x, y, j, direction);
        add_shade(r, samples->id[row][j], samples->t[row][j], direction, seen, 1.0f / 16, pixel);
    }
    kernel_job_direction(r->job, x, y, direction);
    if (!samples)
        add_shade(r, tile->id[p.block][p.pixel], tile->t[p.block][p.pixel], direction, seen, 1, pixel);
}

base_status picture_lit(const run_result *r, const float *seen, report_image *out, base_error *err)
{
    const unsigned width = r->options.width, height = r->options.height;
    base_status status = report_image_create((int)width, (int)height, 3, out, err);
    for (unsigned y = 0; status == BASE_OK && y < height; y++)
        for (unsigned x = 0; x < width; x++)
            shade(r, x, y, seen[(size_t)y * width + x], report_image_pixel(out, (int)x, (int)y));
    return status;
}

base_status picture_shaded(const run_result *r, report_image *out, base_error *err)
{
    float *seen = picture_visibility(r, true, err);
    base_status status = seen ? picture_lit(r, seen, out, err) : BASE_ERR_NOMEM;
    free(seen);
    return status;
}

base_status picture_write_aov(const run_result *r, const char *path, base_error *err)
{
    const size_t width = r->options.width, pixels = width * r->options.height;
    const bool shadows = r->job->shadows_host != NULL, msaa = r->job->params.msaa;
    float *planes = malloc(4 * pixels * sizeof *planes);
    uint32_t *prim = malloc(2 * pixels * sizeof *prim);
    base_status status = BASE_ERR_NOMEM;
    if (planes && prim) {
        float *z = planes, *u = planes + pixels, *v = planes + 2 * pixels, *seen = planes + 3 * pixels;
        uint32_t *marked = prim + pixels;
        for (size_t i = 0; i < pixels; i++) {
            job_pixel p = kernel_job_pixel(r->job, (unsigned)(i % width), (unsigned)(i / width));
            const job_frame_tile *tile = &r->job->frame_host[p.tile];
            z[i] = tile->t[p.block][p.pixel];
            u[i] = tile->u[p.block][p.pixel];
            v[i] = tile->v[p.block][p.pixel];
            prim[i] = tile->id[p.block][p.pixel];
            seen[i] = visibility(r->job, p);
            marked[i] = msaa && job_msaa_marked(r->job, (unsigned)(i % width), (unsigned)(i / width));
        }
        const report_channel extra = msaa ? (report_channel){"marked", REPORT_CHANNEL_UINT, marked}
                                          : (report_channel){"visibility", REPORT_CHANNEL_FLOAT, seen};
        const report_channel channels[] = {
            {"Z", REPORT_CHANNEL_FLOAT, z},
            {"prim", REPORT_CHANNEL_UINT, prim},
            {"U", REPORT_CHANNEL_FLOAT, u},
            {"V", REPORT_CHANNEL_FLOAT, v},
            extra,
        };
        status = report_aov_write(path, (int)width, (int)r->options.height, channels, shadows || msaa ? 5 : 4, err);
    } else {
        base_fail(err, status, path, "out of memory for %zu pixels", pixels);
    }
    free(planes);
    free(prim);
    return status;
}

/* One value a pixel; NULL if out of memory. */
static double *heat_values(const run_result *r, kernel_counter counter, base_error *err)
{
    const size_t width = r->options.width, pixels = width * r->options.height;
    double *values = malloc(pixels * sizeof *values);
    if (!values) {
        base_fail(err, BASE_ERR_NOMEM, "heat map", "out of memory for %zu pixels", pixels);
        return NULL;
    }
    for (size_t i = 0; i < pixels; i++) {
        unsigned x = (unsigned)(i % width), y = (unsigned)(i / width);
        values[i] = counter == KERNEL_COUNTER_COUNT ? run_pixel_cycles(r, x, y) : run_pixel_count(r, counter, x, y);
    }
    return values;
}

base_status picture_heat_top(const run_result *r, kernel_counter counter, double *top, base_error *err)
{
    double *values = heat_values(r, counter, err);
    if (!values)
        return BASE_ERR_NOMEM;
    base_status status = report_heat_top(values, (size_t)r->options.width * r->options.height, top, err);
    free(values);
    return status;
}

base_status picture_heat_map(const run_result *r, kernel_counter counter, double top, report_image *out, base_error *err)
{
    char label[96] = "simulated cycles per pixel";
    double *values = heat_values(r, counter, err);
    if (!values)
        return BASE_ERR_NOMEM;
    if (counter != KERNEL_COUNTER_COUNT)
        snprintf(label, sizeof label, "%s per pixel", kernel_counter_table[counter].name);
    report_heat_options options = {.top = top, .label = label};
    base_status status = report_heat_map_create(values, (int)r->options.width, (int)r->options.height, &options, out, err);
    free(values);
    return status;
}
