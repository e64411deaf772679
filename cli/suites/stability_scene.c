#include "cli/suites/stability_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/run.h"

stability_frame stability_frame_of(unsigned number)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    stability_frame f;
    for (int k = 0; k < 3; k++) {
        f.axis[k] = orders[number / 8 % 6][k];
        f.sign[k] = number >> k & 1 ? -1 : 1;
    }
    return f;
}

void stability_scene_clear(stability_scene *s)
{
    free(s->triangles);
    free(s->ideal);
    free(s->directions);
}

static void turned(const stability_frame *f, const double p[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = f->sign[k] * p[f->axis[k]];
}

/* Whether right-handed becomes left-handed. */
static bool is_mirror(const stability_frame *f)
{
    const bool odd = f->axis[1] != (f->axis[0] + 1) % 3;
    return (f->sign[0] * f->sign[1] * f->sign[2] < 0) != odd;
}

/* In double: the one expression for vertices and cameras, so that a camera on a vertex is on it after rounding too. */
static void placed(const stability_scene *s, const double p[3], double out[3])
{
    turned(&s->frame, p, out);
    for (int k = 0; k < 3; k++)
        out[k] = s->place.scale * out[k] + s->place.offset;
}

void stability_look(stability_scene *s, const double eye[3], const double target[3], double yfov, unsigned width, unsigned height)
{
    static const double up[3] = {0, 1, 0};
    const scene_camera c = scene_camera_look_at("stability", eye, target, up, yfov);
    s->camera = c;
    s->width = width;
    s->height = height;
    placed(s, eye, s->camera.position);
    turned(&s->frame, c.forward, s->camera.forward);
    turned(&s->frame, c.right, s->camera.right);
    turned(&s->frame, c.up, s->camera.up);
    if (is_mirror(&s->frame)) /* a mirrored camera, upside down, is an unmirrored one */
        for (int k = 0; k < 3; k++)
            s->camera.up[k] = -s->camera.up[k];
}

void stability_light(stability_scene *s, const double point[3]) { placed(s, point, s->light); }

static bool make_room(stability_scene *s)
{
    if (s->status != BASE_OK)
        return false;
    if (s->count < s->room)
        return true;
    const size_t room = s->room ? 2 * s->room : 64;
    scene_triangle *triangles = realloc(s->triangles, room * sizeof *triangles);
    if (triangles)
        s->triangles = triangles;
    double(*ideal)[3][3] = realloc(s->ideal, room * sizeof *ideal);
    if (ideal)
        s->ideal = ideal;
    if (!triangles || !ideal) {
        s->status = base_fail(s->err, BASE_ERR_NOMEM, "stability", "out of memory for %zu triangles", room);
        return false;
    }
    s->room = room;
    return true;
}

void stability_add_placed(stability_scene *s, double vertex[3][3])
{
    if (!make_room(s))
        return;
    memcpy(s->ideal[s->count], vertex, sizeof s->ideal[0]);
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            s->triangles[s->count].v[v][k] = (float)vertex[v][k];
    s->count++;
}

void stability_add(stability_scene *s, const double a[3], const double b[3], const double c[3])
{
    double vertex[3][3];
    placed(s, a, vertex[0]);
    placed(s, b, vertex[1]);
    placed(s, c, vertex[2]);
    stability_add_placed(s, vertex);
}

/* A kernel is run for them, on a scene of no matter what: the rays of its job are those of all kernels. */
void stability_aim(stability_scene *s)
{
    scene_triangle any = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    scene one = {.triangle_count = 1, .triangles = &any, .camera_count = 1, .cameras = &s->camera};
    run_result run = {0};
    size_t count;
    const kernel_info *kernel = kernel_list(&count);
    const run_options options = {.kernel = kernel, .params = kernel->defaults, .width = s->width, .height = s->height, .model = RUN_NATIVE, .jobs = 1};
    free(s->directions);
    s->directions = calloc((size_t)s->width * s->height, sizeof *s->directions);
    if (s->status == BASE_OK && !s->directions)
        s->status = base_fail(s->err, BASE_ERR_NOMEM, "stability", "out of memory for %ux%u rays", s->width, s->height);
    if (s->status == BASE_OK)
        s->status = run_kernel(&one, s->machine, &options, &run, s->err);
    for (unsigned i = 0; s->status == BASE_OK && i < s->width * s->height; i++)
        kernel_job_direction(run.job, i % s->width, i / s->width, s->directions[i]);
    run_result_destroy(&run);
}

void stability_along(const stability_scene *s, double x, double y, double t, double out[3])
{
    const unsigned x0 = (unsigned)fmin(fmax(x, 0), s->width - 2), y0 = (unsigned)fmin(fmax(y, 0), s->height - 2);
    const double right = x - x0, down = y - y0;
    for (int k = 0; k < 3 && s->status == BASE_OK; k++) {
        const double first = (double)s->directions[y0 * s->width + x0][k];
        const double d = first + right * ((double)s->directions[y0 * s->width + x0 + 1][k] - first) +
                         down * ((double)s->directions[(y0 + 1) * s->width + x0][k] - first);
        out[k] = (double)(float)s->camera.position[k] + t * s->place.scale * d;
    }
}

void stability_add_about(stability_scene *s, double x, double y, double reach, double t)
{
    double centre[3], right[3], down[3], v[3][3];
    stability_along(s, x, y, t, centre);
    stability_along(s, x + 1, y, t, right);
    stability_along(s, x, y + 1, t, down);
    static const double corner[3][2] = {{-1, -0.8}, {1.1, -0.7}, {0.1, 1.2}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            v[i][k] = centre[k] + reach * (corner[i][0] * (right[k] - centre[k]) + corner[i][1] * (down[k] - centre[k]));
    stability_add_placed(s, v);
}

void stability_random_point(stability_scene *s, double size, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = base_random_range(&s->random, -size, size);
}

void stability_random_direction(stability_scene *s, double out[3])
{
    double square;
    do {
        stability_random_point(s, 1, out);
        square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    } while (square > 1 || square < 1e-4);
    for (int k = 0; k < 3; k++)
        out[k] /= sqrt(square);
}

unsigned stability_random_below(stability_scene *s, unsigned limit) { return (unsigned)(base_random_bits(&s->random) % limit); }

void stability_soup(stability_scene *s, unsigned count, double size)
{
    for (unsigned i = 0; i < count; i++) {
        double v[3][3];
        stability_random_point(s, 1, v[0]);
        for (int j = 1; j < 3; j++) {
            stability_random_point(s, size, v[j]);
            for (int k = 0; k < 3; k++)
                v[j][k] += v[0][k];
        }
        stability_add(s, v[0], v[1], v[2]);
    }
}

void stability_box(stability_scene *s, const double low[3], const double high[3])
{
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corner[4][3];
        for (int i = 0; i < 4; i++) {
            corner[i][axis] = side % 2 ? high[axis] : low[axis];
            corner[i][u] = i & 1 ? high[u] : low[u];
            corner[i][v] = i >> 1 ? high[v] : low[v];
        }
        stability_add(s, corner[0], corner[side % 2 ? 1 : 2], corner[side % 2 ? 2 : 1]);
        stability_add(s, corner[3], corner[side % 2 ? 2 : 1], corner[side % 2 ? 1 : 2]);
    }
}

void stability_look_anywhere(stability_scene *s, unsigned width, unsigned height)
{
    double eye[3], target[3];
    stability_random_point(s, 1.5, eye);
    stability_random_point(s, 0.7, target);
    stability_look(s, eye, target, base_random_range(&s->random, 0.3, 1.8), width, height);
}
