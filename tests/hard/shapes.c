#include "tests/hard/shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const shapes_place shapes_places[SHAPES_PLACES] = {{0, 1e-4}, {0, 1}, {0, 1e4}, {1e3, 1e-4}, {1e3, 1}, {1e3, 1e4}, {1e6, 1e-4},
                                                   {1e6, 1}, {1e6, 1e4}};

int shapes_place_is_fine(shapes_place p)
{
    return p.scale * 0x1p24 >= 0x1p16 * p.offset;
}

void shapes_point(base_random *r, double size, double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = base_random_range(r, -size, size);
}

void shapes_direction(base_random *r, double out[3])
{
    double square;
    do {
        shapes_point(r, 1, out);
        square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    } while (square > 1 || square < 1e-4);
    for (int k = 0; k < 3; k++)
        out[k] /= sqrt(square);
}

void shapes_put(shapes_place place, const double p[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)(place.scale * p[k] + place.offset);
}

void shapes_put_point(base_random *r, shapes_place place, double size, float out[3])
{
    double p[3];
    shapes_point(r, size, p);
    shapes_put(place, p, out);
}

void shapes_scaled(const double d[3], double length, float out[3])
{
    double is = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++)
        out[k] = (float)(d[k] * (length / is));
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

void shapes_frame(const double d[3], double right[3], double down[3])
{
    double other[3] = {0, 0, 0}, square = 0;
    other[fabs(d[0]) < 0.6 ? 0 : 1] = 1;
    cross(d, other, right);
    for (int k = 0; k < 3; k++)
        square += right[k] * right[k];
    for (int k = 0; k < 3; k++)
        right[k] /= sqrt(square);
    cross(d, right, down);
}

/* A random frame to turn shapes by: rows are unit vectors at right angles. */
static void random_frame(base_random *r, double m[3][3])
{
    shapes_direction(r, m[0]);
    shapes_frame(m[0], m[1], m[2]);
}

static shapes_mesh mesh_alloc(size_t vertices, size_t triangles)
{
    shapes_mesh m = {0};
    m.vertices = calloc(vertices, sizeof *m.vertices);
    m.triangles = calloc(triangles, sizeof *m.triangles);
    m.corner = calloc(triangles, sizeof *m.corner);
    if (!m.vertices || !m.triangles || !m.corner)
        abort();
    return m;
}

static uint32_t add_vertex(shapes_mesh *m, double frame[3][3], shapes_place place, const double p[3])
{
    double turned[3];
    for (int k = 0; k < 3; k++)
        turned[k] = frame[k][0] * p[0] + frame[k][1] * p[1] + frame[k][2] * p[2];
    shapes_put(place, turned, m->vertices[m->vertex_count]);
    return (uint32_t)m->vertex_count++;
}

static void add_triangle(shapes_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t corner[3] = {a, b, c};
    if (a == b || b == c || c == a)
        return;
    for (int i = 0; i < 3; i++)
        memcpy(m->triangles[m->triangle_count].v[i], m->vertices[corner[i]], sizeof(float[3]));
    memcpy(m->corner[m->triangle_count++], corner, sizeof corner);
}

shapes_mesh shapes_sphere(base_random *r, int rings, int sectors, double bumps, shapes_place place)
{
    const double pi = 3.14159265358979323846;
    shapes_mesh m = mesh_alloc((size_t)(rings + 1) * (size_t)sectors, 2 * (size_t)rings * (size_t)sectors);
    uint32_t *index = calloc((size_t)(rings + 1) * (size_t)sectors, sizeof *index);
    double frame[3][3];
    if (!index)
        abort();
    random_frame(r, frame);
    for (int i = 0; i <= rings; i++)
        for (int j = 0; j < sectors; j++) {
            double theta = pi * i / rings, phi = 2 * pi * j / sectors, radius = 1 + bumps * base_random_range(r, -1, 1);
            double p[3] = {radius * sin(theta) * cos(phi), radius * cos(theta), radius * sin(theta) * sin(phi)};
            int pole = i == 0 || i == rings;
            index[i * sectors + j] = pole && j > 0 ? index[i * sectors] : add_vertex(&m, frame, place, p);
        }
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < sectors; j++) {
            uint32_t a = index[i * sectors + j], b = index[i * sectors + (j + 1) % sectors];
            uint32_t c = index[(i + 1) * sectors + j], d = index[(i + 1) * sectors + (j + 1) % sectors];
            add_triangle(&m, a, b, c);
            add_triangle(&m, b, d, c);
        }
    free(index);
    return m;
}

/* The vertex of a box's surface grid at integer coordinates 0..n, made once. */
static uint32_t box_vertex(shapes_mesh *m, double frame[3][3], shapes_place place, int n, const int at[3], uint32_t *index)
{
    uint32_t *known = &index[(at[0] * (n + 1) + at[1]) * (n + 1) + at[2]];
    if (*known == 0) {
        double p[3] = {2.0 * at[0] / n - 1, 2.0 * at[1] / n - 1, 2.0 * at[2] / n - 1};
        *known = add_vertex(m, frame, place, p) + 1;
    }
    return *known - 1;
}

shapes_mesh shapes_box(base_random *r, int n, int turned, shapes_place place)
{
    size_t cells = (size_t)(n + 1) * (size_t)(n + 1) * (size_t)(n + 1);
    shapes_mesh m = mesh_alloc(cells, 12 * (size_t)n * (size_t)n);
    uint32_t *index = calloc(cells, sizeof *index);
    double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (!index)
        abort();
    if (turned)
        random_frame(r, frame);
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) {
                    uint32_t v[4];
                    for (int k = 0; k < 4; k++) {
                        int at[3];
                        at[axis] = side * n;
                        at[(axis + 1) % 3] = i + (k & 1);
                        at[(axis + 2) % 3] = j + (k >> 1);
                        v[k] = box_vertex(&m, frame, place, n, at, index);
                    }
                    add_triangle(&m, v[0], side ? v[1] : v[2], side ? v[2] : v[1]);
                    add_triangle(&m, v[3], side ? v[2] : v[1], side ? v[1] : v[2]);
                }
    free(index);
    return m;
}

void shapes_free(shapes_mesh *m)
{
    free(m->triangles);
    free(m->vertices);
    free(m->corner);
    *m = (shapes_mesh){0};
}

scene shapes_scene(const shapes_mesh *m)
{
    scene s = {.triangle_count = m->triangle_count, .triangles = m->triangles};
    snprintf(s.name, sizeof s.name, "closed surface");
    return s;
}
