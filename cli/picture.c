#include "cli/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

base_status picture_lit(const run_result *r, const float *seen, report_image *out, base_error *err)
{
    const unsigned width = r->options.width, height = r->options.height;
    base_status status = report_image_create((int)width, (int)height, 3, out, err);
    for (unsigned y = 0; status == BASE_OK && y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            job_pixel p = kernel_job_pixel(r->job, x, y);
            const job_frame_tile *tile = &r->job->frame_host[p.tile];
            uint32_t id = tile->id[p.block][p.pixel];
            float *pixel = report_image_pixel(out, (int)x, (int)y), direction[3];
            double light = 0, d[3];
            kernel_job_direction(r->job, x, y, direction);
            for (int axis = 0; axis < 3; axis++)
                d[axis] = (double)direction[axis];
            if (id != JOB_NO_HIT)
                light = brightness(r, id, (double)tile->t[p.block][p.pixel], d, (double)seen[(size_t)y * width + x]);
            for (int channel = 0; channel < 3; channel++)
                pixel[channel] = id == JOB_NO_HIT ? background
                                                  : (float)light * r->scene->materials[r->scene->triangle_material[id]].base_color[channel];
        }
    return status;
}

base_status picture_shaded(const run_result *r, report_image *out, base_error *err)
{
    float *seen = picture_visibility(r, true, err);
    base_status status = seen ? picture_lit(r, seen, out, err) : BASE_ERR_NOMEM;
    free(seen);
    return status;
}

/* What a pixel's results are made of: a plane each. */
enum { AOV_FLOATS = 4, AOV_UINTS = 2 };

static void fill_planes(const run_result *r, float *const planes[AOV_FLOATS], uint32_t *const numbers[AOV_UINTS])
{
    const size_t width = r->options.width, pixels = width * r->options.height;
    for (size_t i = 0; i < pixels; i++) {
        const unsigned x = (unsigned)(i % width), y = (unsigned)(i / width);
        const job_pixel p = kernel_job_pixel(r->job, x, y);
        const job_frame_tile *tile = &r->job->frame_host[p.tile];
        planes[0][i] = tile->t[p.block][p.pixel];
        planes[1][i] = tile->u[p.block][p.pixel];
        planes[2][i] = tile->v[p.block][p.pixel];
        planes[3][i] = visibility(r->job, p);
        numbers[0][i] = tile->id[p.block][p.pixel];
        numbers[1][i] = kernel_job_complexity(r->job, x, y);
    }
}

base_status picture_write_aov(const run_result *r, const char *path, base_error *err)
{
    const size_t pixels = (size_t)r->options.width * r->options.height;
    float *floats = malloc(AOV_FLOATS * pixels * sizeof *floats);
    uint32_t *uints = malloc(AOV_UINTS * pixels * sizeof *uints);
    base_status status = BASE_ERR_NOMEM;
    if (floats && uints) {
        float *planes[AOV_FLOATS] = {floats, floats + pixels, floats + 2 * pixels, floats + 3 * pixels};
        uint32_t *numbers[AOV_UINTS] = {uints, uints + pixels};
        report_channel channels[AOV_FLOATS + AOV_UINTS] = {
            {"Z", REPORT_CHANNEL_FLOAT, planes[0]},
            {"prim", REPORT_CHANNEL_UINT, numbers[0]},
            {"U", REPORT_CHANNEL_FLOAT, planes[1]},
            {"V", REPORT_CHANNEL_FLOAT, planes[2]},
        };
        int count = 4;
        if (r->job->shadows_host)
            channels[count++] = (report_channel){"visibility", REPORT_CHANNEL_FLOAT, planes[3]};
        if (r->options.kernel->counters >> KERNEL_ep_cells & 1)
            channels[count++] = (report_channel){"complexity", REPORT_CHANNEL_UINT, numbers[1]};
        fill_planes(r, planes, numbers);
        status = report_aov_write(path, (int)r->options.width, (int)r->options.height, channels, count, err);
    } else {
        base_fail(err, status, path, "out of memory for %zu pixels", pixels);
    }
    free(floats);
    free(uints);
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
