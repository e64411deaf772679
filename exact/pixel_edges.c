#include "exact/pixel_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_TRIANGLES = 4096, MOST_CORNERS = 3 + 5 }; /* of a surface in one pixel; of a triangle that five planes have cut */

#define NO_NEIGHBOUR UINT32_MAX

struct pixel_edges {
    const scene *scene;
    double origin[3], row[3][3]; /* rows: pixel x and y times depth, and depth, of a place relative to the eye */
    uint32_t *neighbour;         /* by half edge 3 * triangle + edge: the other half; NO_NEIGHBOUR: the surface ends */
    uint32_t *met;               /* by triangle: the last judgement that met it */
    uint32_t judgement;
    uint32_t surface[MOST_TRIANGLES];
    size_t surface_count;
};

/* A corner of a scene's triangle, for welding. */
typedef struct corner {
    const float *place;
    uint32_t number; /* 3 * triangle + vertex */
} corner;

typedef struct half {
    uint32_t low, high, number; /* welded vertices, the smaller first; number of the half edge */
    bool reversed;
} half;

static int compare_corners(const void *a, const void *b)
{
    const corner *x = a, *y = b;
    for (int axis = 0; axis < 3; axis++)
        if (x->place[axis] < y->place[axis] || x->place[axis] > y->place[axis])
            return x->place[axis] < y->place[axis] ? -1 : 1;
    return 0;
}

static int compare_halves(const void *a, const void *b)
{
    const half *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    return (x->high > y->high) - (x->high < y->high);
}

/* Number of the place of each corner. */
static void weld(const scene *s, corner *corners, uint32_t *place)
{
    uint32_t places = 0;
    for (size_t i = 0; i < 3 * s->triangle_count; i++)
        corners[i] = (corner){s->triangles[i / 3].v[i % 3], (uint32_t)i};
    qsort(corners, 3 * s->triangle_count, sizeof *corners, compare_corners);
    for (size_t i = 0; i < 3 * s->triangle_count; i++) {
        places += i > 0 && compare_corners(&corners[i - 1], &corners[i]) != 0;
        place[corners[i].number] = places;
    }
}

static bool has_area(const scene_triangle *t)
{
    double n = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        double a = ((double)t->v[1][i] - (double)t->v[0][i]) * ((double)t->v[2][j] - (double)t->v[0][j]);
        double b = ((double)t->v[1][j] - (double)t->v[0][j]) * ((double)t->v[2][i] - (double)t->v[0][i]);
        n += fabs(a - b);
    }
    return n > 0;
}

/* Half edges of triangles with an area; returns their number. */
static size_t fill_halves(const scene *s, const uint32_t *place, half *halves)
{
    size_t count = 0;
    for (size_t i = 0; i < s->triangle_count; i++)
        for (size_t edge = 0; has_area(&s->triangles[i]) && edge < 3; edge++) {
            const uint32_t from = place[3 * i + edge], to = place[3 * i + (edge + 1) % 3];
            halves[count++] = (half){from < to ? from : to, from < to ? to : from, (uint32_t)(3 * i + edge), from > to};
        }
    return count;
}

static void join_halves(pixel_edges *e, half *halves, size_t count, bool one_sided)
{
    qsort(halves, count, sizeof *halves, compare_halves);
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1; next < count && compare_halves(&halves[i], &halves[next]) == 0;)
            next++;
        if (next - i != 2 || (one_sided && halves[i].reversed == halves[i + 1].reversed))
            continue;
        e->neighbour[halves[i].number] = halves[i + 1].number;
        e->neighbour[halves[i + 1].number] = halves[i].number;
    }
}

/* Inverse of the matrix whose columns are dx, dy and d00. */
static void project(pixel_edges *e, const scene_primary_rays *rays)
{
    const float *column[3] = {rays->dx, rays->dy, rays->d00};
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++) {
            const float *a = column[(i + 1) % 3], *b = column[(i + 2) % 3];
            const int j = (axis + 1) % 3, k = (axis + 2) % 3;
            e->row[i][axis] = (double)a[j] * (double)b[k] - (double)a[k] * (double)b[j];
        }
    for (int axis = 0; axis < 3; axis++) {
        e->origin[axis] = (double)rays->origin[axis];
        determinant += e->row[0][axis] * (double)column[0][axis];
    }
    for (int i = 0; i < 9; i++)
        e->row[i / 3][i % 3] /= determinant;
}

base_status pixel_edges_create(const scene *s, const scene_camera *camera, unsigned width, unsigned height, bool one_sided,
                               pixel_edges **out, base_error *err)
{
    const size_t count = 3 * s->triangle_count + 1;
    const scene_primary_rays rays = scene_camera_rays(camera, width, height);
    pixel_edges *e = calloc(1, sizeof *e);
    corner *corners = calloc(count, sizeof *corners);
    uint32_t *place = calloc(count, sizeof *place);
    half *halves = calloc(count, sizeof *halves);
    if (e) {
        e->scene = s;
        e->neighbour = malloc(count * sizeof *e->neighbour);
        e->met = calloc(s->triangle_count + 1, sizeof *e->met);
    }
    const bool ok = e && corners && place && halves && e->neighbour && e->met;
    if (ok) {
        memset(e->neighbour, 0xff, count * sizeof *e->neighbour);
        weld(s, corners, place);
        join_halves(e, halves, fill_halves(s, place, halves), one_sided);
        project(e, &rays);
    } else {
        pixel_edges_destroy(&e);
    }
    free(corners);
    free(place);
    free(halves);
    *out = e;
    return ok ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->name, "out of memory for the edges of %zu triangles", s->triangle_count);
}

void pixel_edges_destroy(pixel_edges **e)
{
    if (*e) {
        free((*e)->neighbour);
        free((*e)->met);
    }
    free(*e);
    *e = NULL;
}

/* A vertex relative to the eye. */
static void relative(const pixel_edges *e, uint32_t number, double out[3])
{
    for (int axis = 0; axis < 3; axis++)
        out[axis] = (double)e->scene->triangles[number / 3].v[number % 3][axis] - e->origin[axis];
}

static int side(const double a[3], const double b[3], const double c[3])
{
    double det = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        det += (a[j] * b[k] - a[k] * b[j]) * c[axis];
    }
    return (det > 0) - (det < 0);
}

/* Whether the surface ends, or turns away from the eye, at a half edge. */
static bool is_silhouette(const pixel_edges *e, uint32_t number)
{
    const uint32_t other = e->neighbour[number];
    double a[3], b[3], own[3], opposite[3];
    if (other == NO_NEIGHBOUR)
        return true;
    relative(e, number, a);
    relative(e, number / 3 * 3 + (number + 1) % 3, b);
    relative(e, number / 3 * 3 + (number + 2) % 3, own);
    relative(e, other / 3 * 3 + (other + 2) % 3, opposite);
    return side(a, b, own) * side(a, b, opposite) >= 0;
}

/* Pixel x and y times depth, and depth. */
static void in_image(const pixel_edges *e, uint32_t number, double out[3])
{
    double place[3];
    relative(e, number, place);
    for (int i = 0; i < 3; i++)
        out[i] = e->row[i][0] * place[0] + e->row[i][1] * place[1] + e->row[i][2] * place[2];
}

/* How far p is inside side 0..3 of a square around (x, y), or (4) in front of the eye. */
static double inside(const double p[3], int plane, const double middle[2], double reach)
{
    if (plane == 4)
        return p[2];
    const double along = p[plane / 2] - middle[plane / 2] * p[2];
    return (plane % 2 ? -along : along) + reach * p[2];
}

/* Cut a polygon by a plane; returns its new number of corners. */
static int cut(double p[MOST_CORNERS][3], int count, int plane, const double middle[2], double reach)
{
    double kept[MOST_CORNERS][3];
    int n = 0;
    for (int i = 0; i < count; i++) {
        const double *a = p[i], *b = p[(i + 1) % count];
        const double u = inside(a, plane, middle, reach), v = inside(b, plane, middle, reach);
        const bool crosses = (u >= 0) != (v >= 0);
        if (u >= 0 && n < MOST_CORNERS)
            memcpy(kept[n++], a, sizeof kept[0]);
        if (crosses && n < MOST_CORNERS) {
            for (int k = 0; k < 3; k++)
                kept[n][k] = a[k] + u / (u - v) * (b[k] - a[k]);
            n++;
        }
    }
    memcpy(p, kept, (size_t)n * sizeof kept[0]);
    return n;
}

static bool meets_pixel(const pixel_edges *e, uint32_t triangle, const double middle[2])
{
    double p[MOST_CORNERS][3];
    int count = 3;
    for (uint32_t i = 0; i < 3; i++)
        in_image(e, 3 * triangle + i, p[i]);
    for (int plane = 0; plane < 5 && count > 0; plane++)
        count = cut(p, count, plane, middle, 0.5);
    return count > 0;
}

/* Smallest depth of a half edge between the outermost samples, which are 3/8 from the middle; +infinity: it is not there. */
static double edge_depth(const pixel_edges *e, uint32_t number, const double middle[2])
{
    double a[3], b[3], first = 0, last = 1;
    in_image(e, number, a);
    in_image(e, number / 3 * 3 + (number + 1) % 3, b);
    for (int plane = 0; plane < 5; plane++) {
        const double u = inside(a, plane, middle, 0.375), v = inside(b, plane, middle, 0.375);
        if (u < 0 && v < 0)
            return (double)INFINITY;
        if (u < 0)
            first = fmax(first, u / (u - v));
        else if (v < 0)
            last = fmin(last, u / (u - v));
    }
    return first <= last ? fmin(a[2] + first * (b[2] - a[2]), a[2] + last * (b[2] - a[2])) : (double)INFINITY;
}

/* Add the triangles of a surface that meet the pixel, from this one on. */
static void spread(pixel_edges *e, uint32_t triangle, const double middle[2])
{
    size_t next = e->surface_count;
    if (e->met[triangle] == e->judgement || e->surface_count == MOST_TRIANGLES)
        return;
    e->met[triangle] = e->judgement;
    e->surface[e->surface_count++] = triangle;
    for (; next < e->surface_count; next++)
        for (uint32_t edge = 0; edge < 3; edge++) {
            const uint32_t number = 3 * e->surface[next] + edge, other = e->neighbour[number];
            if (other == NO_NEIGHBOUR || e->met[other / 3] == e->judgement || e->surface_count == MOST_TRIANGLES ||
                is_silhouette(e, number) || !meets_pixel(e, other / 3, middle))
                continue;
            e->met[other / 3] = e->judgement;
            e->surface[e->surface_count++] = other / 3;
        }
}

pixel_kind pixel_edges_judge(pixel_edges *e, unsigned x, unsigned y, const uint32_t id[16], const float t[16])
{
    const double middle[2] = {x, y};
    double farthest = 0;
    bool one = true;
    int first = 0;
    e->judgement++;
    e->surface_count = 0;
    while (first < 15 && id[first] == PIXEL_EDGES_NO_HIT)
        first++;
    if (id[first] != PIXEL_EDGES_NO_HIT)
        spread(e, id[first], middle);
    for (int j = 0; j < 16; j++) {
        const bool hit = id[j] != PIXEL_EDGES_NO_HIT;
        one = one && hit == (id[first] != PIXEL_EDGES_NO_HIT) && (!hit || e->met[id[j]] == e->judgement);
        farthest = fmax(farthest, (double)t[j]);
    }
    if (one)
        return PIXEL_SMOOTH;
    for (int j = 0; j < 16; j++)
        if (id[j] != PIXEL_EDGES_NO_HIT)
            spread(e, id[j], middle);
    for (size_t i = 0; i < e->surface_count; i++)
        for (uint32_t edge = 0; edge < 3; edge++) {
            const uint32_t number = 3 * e->surface[i] + edge;
            if (is_silhouette(e, number) && edge_depth(e, number, middle) <= farthest * (1 + 1e-5))
                return PIXEL_EDGE;
        }
    return PIXEL_INTERSECTION;
}
