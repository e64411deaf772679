#include "cli/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job_msaa.h"
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

/* A hit, as light falls on it. */
typedef struct surface {
    double normal[3], view[3];
    double facing; /* 1 or -1: the side that is seen is the side that is lit */
} surface;

static surface surface_of(const run_result *r, uint32_t id, const double direction[3])
{
    const scene_triangle *tri = &r->scene->triangles[id];
    surface s = {.view = {direction[0], direction[1], direction[2]}};
    double e[3], f[3];
    for (int axis = 0; axis < 3; axis++) {
        e[axis] = (double)tri->v[1][axis] - (double)tri->v[0][axis];
        f[axis] = (double)tri->v[2][axis] - (double)tri->v[0][axis];
    }
    s.normal[0] = e[1] * f[2] - e[2] * f[1];
    s.normal[1] = e[2] * f[0] - e[0] * f[2];
    s.normal[2] = e[0] * f[1] - e[1] * f[0];
    normalise(s.normal);
    normalise(s.view);
    s.facing = dot(s.normal, s.view) < 0 ? 1 : -1;
    return s;
}

/* Lambert's law for the light's point, of kernels that shade nothing themselves. */
static double lambert(const run_result *r, const surface *s, double t, const double direction[3])
{
    double to_light[3];
    for (int axis = 0; axis < 3; axis++)
        to_light[axis] = r->scene->light.point[axis] - (r->camera->position[axis] + t * direction[axis]);
    normalise(to_light);
    return fmax(0, s->facing * dot(s->normal, to_light));
}

/* What the light lends a pixel's hit, and a weaker light at the camera; of kernels with a shader, what that made of it. `seen`: of the
   light, by pixel; NULL: as the kernel lit it. */
static double brightness(const run_result *r, unsigned x, unsigned y, const float *seen)
{
    const job_pixel p = kernel_job_pixel(r->job, x, y);
    const job_frame_tile *tile = &r->job->frame_host[p.tile];
    const job_row *row = r->job->rows_host ? kernel_job_row(r->job, x, y) : NULL;
    float direction[3];
    if (r->job->shades_host)
        return (double)r->job->shades_host[p.tile].shade[p.block][p.pixel];
    kernel_job_direction(r->job, x, y, direction);
    const double d[3] = {(double)direction[0], (double)direction[1], (double)direction[2]};
    const surface s = surface_of(r, tile->id[p.block][p.pixel], d);
    const double part = seen ? (double)seen[(size_t)y * r->options.width + x] : 1.0;
    double direct = row ? (double)row->shading[x % 16] * part : lambert(r, &s, (double)tile->t[p.block][p.pixel], d) * part;
    if (row && !seen)
        direct = (double)row->lit[x % 16];
    return (double)ambient + (double)headlight * fabs(dot(s.normal, s.view)) + (1.0 - (double)ambient - (double)headlight) * direct;
}

/* The fraction of the light that a pixel's hit sees: 1 for kernels without shadows. */
static float visibility(const kernel_job *job, unsigned x, unsigned y, bool filtered)
{
    const job_pixel p = kernel_job_pixel(job, x, y);
    if (filtered && job->filtered)
        return kernel_job_row(job, x, y)->filtered[x % 16];
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
        seen[i] = visibility(job, (unsigned)(i % job->width), (unsigned)(i / job->width), filtered);
    return seen;
}

/* Add a share of a triangle's colour in so much light, or of the background. */
static void add_color(const run_result *r, uint32_t id, double light, float share, float pixel[3])
{
    for (int channel = 0; channel < 3; channel++)
        pixel[channel] += share * (id == JOB_NO_HIT ? background
                                                    : (float)light * r->scene->materials[r->scene->triangle_material[id]].base_color[channel]);
}

/* A pixel whose samples were traced is their mean, lit as pixels of kernels without shadows are. */
static void add_samples(const run_result *r, unsigned x, unsigned y, const job_frame_tile *samples, unsigned row, float pixel[3])
{
    for (unsigned j = 0; j < 16; j++) {
        const uint32_t id = samples->id[row][j];
        float direction[3];
        double light = 0;
        job_msaa_direction(r->job, x, y, j, direction);
        if (id != JOB_NO_HIT) {
            const double d[3] = {(double)direction[0], (double)direction[1], (double)direction[2]};
            const surface s = surface_of(r, id, d);
            light = (double)ambient + (double)headlight * fabs(dot(s.normal, s.view)) +
                    (1.0 - (double)ambient - (double)headlight) * lambert(r, &s, (double)samples->t[row][j], d);
        }
        add_color(r, id, light, 1.0f / 16, pixel);
    }
}

base_status picture_lit(const run_result *r, const float *seen, report_image *out, base_error *err)
{
    const unsigned width = r->options.width, height = r->options.height;
    base_status status = report_image_create((int)width, (int)height, 3, out, err);
    for (unsigned y = 0; status == BASE_OK && y < height; y++)
        for (unsigned x = 0; x < width; x++) {
            const job_pixel p = kernel_job_pixel(r->job, x, y);
            const uint32_t id = r->job->frame_host[p.tile].id[p.block][p.pixel];
            float *pixel = report_image_pixel(out, (int)x, (int)y);
            unsigned row = 0;
            const job_frame_tile *samples = job_msaa_samples(r->job, x, y, &row);
            if (samples)
                add_samples(r, x, y, samples, row, pixel);
            else
                add_color(r, id, id != JOB_NO_HIT ? brightness(r, x, y, seen) : 0, 1, pixel);
        }
    return status;
}

base_status picture_shaded(const run_result *r, report_image *out, base_error *err)
{
    float *seen = r->job->rows_host ? NULL : picture_visibility(r, true, err);
    base_status status = seen || r->job->rows_host ? picture_lit(r, seen, out, err) : BASE_ERR_NOMEM;
    free(seen);
    return status;
}

/* What a pixel's results are made of: a plane each. */
enum { AOV_FLOATS = 4, AOV_UINTS = 3 };

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
        planes[3][i] = visibility(r->job, x, y, false);
        numbers[0][i] = tile->id[p.block][p.pixel];
        numbers[1][i] = kernel_job_complexity(r->job, x, y);
        numbers[2][i] = r->job->params.msaa && job_msaa_marked(r->job, x, y);
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
        uint32_t *numbers[AOV_UINTS] = {uints, uints + pixels, uints + 2 * pixels};
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
        if (r->job->params.msaa)
            channels[count++] = (report_channel){"marked", REPORT_CHANNEL_UINT, numbers[2]};
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
