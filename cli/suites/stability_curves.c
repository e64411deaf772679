#include "cli/suites/stability_curves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/suites/stability_scene.h"

enum { MAX_POINTS = 16, QUANTITIES = 5 };

/* What is known of a kernel at a point of a curve. */
enum { MEDIAN_T, MOST_T, WORST_T, WORST_PLANE, SCENE_T };
static const char *const quantity_names[QUANTITIES] = {"median error of t", "99th percentile", "worst error of t",
                                                       "worst plane [2^-24]", "rounding of the scene"};

/* A curve: scenes that depend on one number. */
typedef struct curve {
    const char *suffix, *title, *caption, *axis;
    double points[MAX_POINTS]; /* the number's values; 0 ends them */
    bool absolute;             /* distances in the scene as it was before rounding are worth a series */
    void (*build)(stability_scene *s, double x);
} curve;

static void look(stability_scene *s) { stability_look_anywhere(s, s->width, s->height); }

static void build_distance(stability_scene *s, double x)
{
    s->place = (stability_place){.offset = x, .scale = 1};
    look(s);
    stability_soup(s, 100, 0.8);
}

static void build_size(stability_scene *s, double x)
{
    s->place = (stability_place){.scale = x};
    look(s);
    stability_soup(s, 100, 0.8);
}

/* Triangles as long as a quarter of the image, along rows of rays, and 1/x of that high. */
static void build_aspect(stability_scene *s, double x)
{
    s->place = (stability_place){.scale = 1};
    look(s);
    stability_aim(s);
    for (int i = 0; i < 120; i++) {
        const double row = stability_random_below(s, s->height), from = stability_random_below(s, s->width), t = base_random_range(&s->random, 0.5, 3);
        double v[3][3], length = 0;
        stability_along(s, from, row, t, v[0]);
        stability_along(s, from + s->width / 4.0, row, t * base_random_range(&s->random, 0.8, 1.25), v[1]);
        for (int k = 0; k < 3; k++)
            length += (v[1][k] - v[0][k]) * (v[1][k] - v[0][k]);
        memcpy(v[2], v[1], sizeof v[2]);
        for (int k = 0; k < 3; k++) {
            v[1][k] -= 0.5 * sqrt(length) / x * s->camera.up[k];
            v[2][k] += 0.5 * sqrt(length) / x * s->camera.up[k];
        }
        stability_add_placed(s, v);
    }
}

static const curve curves[] = {
    {"-distance", "Accuracy against distance from the origin",
     "Random triangles about 1 in size, the camera among them, all moved along the diagonal. A camera's own distances keep all their digits: "
     "vertices are brought to it before anything else. What is lost is lost when the scene is rounded to float.",
     "distance from the origin [sizes of the scene]", {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}, true, build_distance},
    {"-size", "Accuracy against size", "The same triangles about the origin, scaled.", "size of the scene",
     {1e-18, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6, 1e8}, false, build_size},
    {"-aspect", "Accuracy against the shape of triangles", "Triangles along rows of rays, thinner and thinner.", "length over height of the triangles",
     {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}, false, build_aspect},
};

/* A curve as it is measured: results by kernel, quantity and point. */
typedef struct measured_curve {
    suite *suite;
    const stability_kernels *kernels;
    const curve *curve;
    size_t points;
    report_table *table;
    double y[STABILITY_MAX_KERNELS][QUANTITIES][MAX_POINTS];
} measured_curve;

/* The rays of one point. */
typedef struct point {
    size_t kernels, rays;
    const stability_scene *scene;
    stability_tally *tallies; /* by worker and kernel */
    double *t_ulp;            /* by kernel and ray; infinite: no hit that is right */
    double *scene_ulp;        /* by ray */
} point;

static double ulp_of(double t)
{
    int exponent;
    frexp(t, &exponent);
    return ldexp(1, exponent - 24);
}

/* Distance of the triangle's plane along the ray, before the scene was rounded. */
static double ideal_distance(const stability_scene *s, uint32_t id, const float d[3])
{
    double (*v)[3] = s->ideal[id], e[3], f[3], to_plane = 0, speed = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = v[1][k] - v[0][k];
        f[k] = v[2][k] - v[0][k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double n = e[i] * f[j] - e[j] * f[i];
        to_plane += n * (v[0][k] - s->camera.position[k]);
        speed += n * (double)d[k];
    }
    return to_plane / speed;
}

static void take_ray(void *user, size_t kernel, size_t pixel, unsigned worker, const trial_ray *ray, const trial_finding *finding)
{
    const point *p = user;
    const bool right = finding->verdict == TRIAL_RIGHT && trial_ray_nearest(ray) != TRIAL_NO_HIT;
    const double t = trial_ray_distance(ray);
    stability_tally_ray(&p->tallies[worker * p->kernels + kernel], ray, finding, 0);
    p->t_ulp[kernel * p->rays + pixel] = right ? finding->t_ulp : (double)INFINITY;
    if (kernel == 0)
        p->scene_ulp[pixel] =
            isfinite(t) ? fabs(ideal_distance(p->scene, trial_ray_nearest(ray), p->scene->directions[pixel]) - t) / ulp_of(t) : (double)INFINITY;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sort; the value that a share of the finite ones do not exceed, NaN without any. */
static double quantile(double *values, size_t count, double share)
{
    size_t finite = 0;
    qsort(values, count, sizeof *values, ascending);
    while (finite < count && isfinite(values[finite]))
        finite++;
    return finite ? values[(size_t)(share * (double)(finite - 1))] : (double)NAN;
}

static void add_row(measured_curve *c, size_t kernel, size_t x, const stability_tally *tally)
{
    const uint64_t integers[] = {tally->tries, tally->hits, tally->verdicts[TRIAL_LOST], tally->verdicts[TRIAL_WRONG], tally->at_edge,
                                 tally->verdicts[TRIAL_EDGE]};
    report_table_begin_row(c->table);
    report_table_add_text(c->table, c->kernels->list[kernel]->name);
    report_table_add_real(c->table, log10(c->curve->points[x]));
    for (size_t i = 0; i < sizeof integers / sizeof *integers; i++)
        report_table_add_integer(c->table, (int64_t)integers[i]);
    for (int i = 0; i < QUANTITIES - !c->curve->absolute; i++)
        report_table_add_real(c->table, c->y[kernel][i][x]);
}

static base_status try_point(measured_curve *c, stability_scene *scene_of_point, size_t x, base_error *err)
{
    const suite *s = c->suite;
    const size_t kernels = c->kernels->count, rays = (size_t)s->width * s->height;
    point p = {kernels, rays, scene_of_point, calloc(s->jobs * kernels, sizeof *p.tallies), calloc(kernels * rays, sizeof *p.t_ulp),
               calloc(rays, sizeof *p.scene_ulp)};
    const scene made = {.triangle_count = scene_of_point->count, .triangles = scene_of_point->triangles, .camera_count = 1,
                        .cameras = &scene_of_point->camera};
    const stability_input input = {&made, &scene_of_point->camera, s->options->machine, c->kernels, s->width, s->height, false, s->jobs};
    base_status status = p.tallies && p.t_ulp && p.scene_ulp ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
    if (status == BASE_OK)
        status = stability_try(&input, take_ray, NULL, &p, err);
    for (size_t k = 0; status == BASE_OK && k < kernels; k++) {
        double(*y)[MAX_POINTS] = c->y[k];
        for (unsigned i = 1; i < s->jobs; i++)
            stability_tally_add(&p.tallies[k], &p.tallies[i * kernels + k]);
        y[MEDIAN_T][x] = quantile(&p.t_ulp[k * rays], rays, 0.5);
        y[MOST_T][x] = quantile(&p.t_ulp[k * rays], rays, 0.99);
        y[WORST_T][x] = p.tallies[k].t_ulp;
        y[WORST_PLANE][x] = p.tallies[k].plane_ulp;
        y[SCENE_T][x] = quantile(p.scene_ulp, rays, 0.5);
        add_row(c, k, x, &p.tallies[k]);
    }
    free(p.tallies);
    free(p.t_ulp);
    free(p.scene_ulp);
    return status;
}

static base_status try_points(measured_curve *c, base_error *err)
{
    base_status status = BASE_OK;
    for (c->points = 0; status == BASE_OK && c->points < MAX_POINTS && c->curve->points[c->points] > 0; c->points++) {
        stability_scene s = {.machine = c->suite->options->machine, .frame = stability_frame_of(0), .random = {1}, .width = c->suite->width,
                             .height = c->suite->height, .err = err};
        c->curve->build(&s, c->curve->points[c->points]);
        stability_aim(&s);
        status = s.status == BASE_OK ? try_point(c, &s, c->points, err) : s.status;
        stability_scene_clear(&s);
    }
    return status;
}

/* Kernels whose numbers are the same share a series. */
static size_t first_like(const measured_curve *c, size_t kernel)
{
    size_t first = 0;
    while (memcmp(c->y[first], c->y[kernel], sizeof c->y[first]) != 0)
        first++;
    return first;
}

static void series_name(const measured_curve *c, size_t kernel, int quantity, char *name, size_t bytes)
{
    size_t length = 0, unlike = 0;
    for (size_t k = 0; k < c->kernels->count; k++)
        unlike += first_like(c, k) != 0;
    for (size_t k = 0; unlike && k < c->kernels->count && length < bytes; k++)
        if (first_like(c, k) == kernel)
            length += (size_t)snprintf(name + length, bytes - length, "%s%s", length ? ", " : "", c->kernels->list[k]->name);
    if (length < bytes)
        snprintf(name + length, bytes - length, "%s%s", length ? ": " : "", quantity_names[quantity]);
}

static base_status add_plot(const measured_curve *c, base_error *err)
{
    enum { MAX_SERIES = STABILITY_MAX_KERNELS * QUANTITIES, NAME_BYTES = 300 };
    report_series *series = calloc(MAX_SERIES, sizeof *series);
    char(*names)[NAME_BYTES] = calloc(MAX_SERIES, sizeof *names);
    size_t count = 0;
    base_status status = series && names ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
    for (size_t k = 0; status == BASE_OK && k < c->kernels->count; k++)
        for (int q = 0; q < QUANTITIES && first_like(c, k) == k; q++) {
            if (q == SCENE_T && (k > 0 || !c->curve->absolute))
                continue;
            series_name(c, k, q, names[count], NAME_BYTES);
            series[count] = (report_series){.name = q == SCENE_T ? quantity_names[q] : names[count], .x = c->curve->points, .y = c->y[k][q],
                                            .count = c->points, .line = true};
            count++;
        }
    const report_plot plot = {c->curve->title, {c->curve->axis, true}, {"error [ulp of t]", true}, series, count};
    if (status == BASE_OK)
        status = suite_add_plot(c->suite, c->curve->suffix, &plot, c->curve->caption, err);
    free(series);
    free(names);
    return status;
}

static report_table *curve_table(const curve *of)
{
    static const report_column columns[] = {
        {.name = "kernel"},
        {.name = "x", .unit = "log10", .kind = REPORT_REAL},
        {.name = "tries", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "hits", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "lost", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "wrong", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "at an edge", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "decided otherwise", .unit = "rays", .kind = REPORT_INTEGER},
        {.name = "median t", .unit = "ulp", .kind = REPORT_REAL, .decimals = 2},
        {.name = "99% t", .unit = "ulp", .kind = REPORT_REAL, .decimals = 2},
        {.name = "worst t", .unit = "ulp", .kind = REPORT_REAL, .decimals = 1},
        {.name = "worst plane", .unit = "2^-24", .kind = REPORT_REAL, .decimals = 2},
        {.name = "rounded scene", .unit = "ulp", .kind = REPORT_REAL, .decimals = 1},
    };
    report_table *t = report_table_create(of->title);
    char caption[600];
    snprintf(caption, sizeof caption, "%s x: %s.", of->caption, of->axis);
    report_table_set_caption(t, caption);
    for (size_t i = 0; i < sizeof columns / sizeof *columns - !of->absolute; i++)
        report_table_add_column(t, &columns[i]);
    return t;
}

base_status stability_add_curves(suite *s, const stability_kernels *kernels, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < sizeof curves / sizeof *curves; i++) {
        measured_curve *c = calloc(1, sizeof *c);
        if (!c)
            return base_fail(err, BASE_ERR_NOMEM, "stability", "out of memory");
        c->suite = s;
        c->kernels = kernels;
        c->curve = &curves[i];
        c->table = curve_table(c->curve);
        status = try_points(c, err);
        if (status == BASE_OK)
            status = suite_add_table(s, c->curve->suffix, c->table, err);
        else
            report_table_destroy(&c->table);
        if (status == BASE_OK)
            status = add_plot(c, err);
        free(c);
    }
    return status;
}
