#include "tests/kernels/accel/soup.h"

#include <stdio.h>
#include <stdlib.h>

#include "lrbni/base/random.h"

scene soup_create(const char *name, size_t count)
{
    scene s = {.triangle_count = count};
    snprintf(s.name, sizeof s.name, "%s", name);
    s.triangles = calloc(count ? count : 1, sizeof *s.triangles);
    if (!s.triangles)
        abort();
    return s;
}

void soup_free(scene *s)
{
    free(s->triangles);
    s->triangles = NULL;
}

/* A triangle with corners anywhere in a cube about a point. */
static scene_triangle triangle_about(base_random *r, const double center[3], double size)
{
    scene_triangle t;
    for (int corner = 0; corner < 3; corner++)
        for (int axis = 0; axis < 3; axis++)
            t.v[corner][axis] = (float)(center[axis] + base_random_range(r, -size, size));
    return t;
}

static void point_in_cube(base_random *r, double half, double point[3])
{
    for (int axis = 0; axis < 3; axis++)
        point[axis] = base_random_range(r, -half, half);
}

scene soup_random(uint64_t seed, size_t count, double size)
{
    scene s = soup_create("random", count);
    base_random r = {seed};
    for (size_t i = 0; i < count; i++) {
        double center[3];
        point_in_cube(&r, 1.0, center);
        s.triangles[i] = triangle_about(&r, center, size);
    }
    return s;
}

scene soup_clustered(uint64_t seed, size_t count)
{
    enum { CLUSTERS = 12 };
    scene s = soup_create("clustered", count);
    base_random r = {seed};
    double centers[CLUSTERS][3];
    for (int c = 0; c < CLUSTERS; c++)
        point_in_cube(&r, 10.0, centers[c]);
    for (size_t i = 0; i < count; i++) {
        double center[3];
        size_t cluster = base_random_bits(&r) % CLUSTERS;
        double radius = 1.0 / (double)(1u << cluster);
        point_in_cube(&r, radius, center);
        for (int axis = 0; axis < 3; axis++)
            center[axis] += centers[cluster][axis];
        s.triangles[i] = triangle_about(&r, center, i % 500 == 0 ? 10.0 : 0.02 * radius);
    }
    return s;
}

scene soup_identical(size_t count)
{
    scene s = soup_create("identical", count);
    for (size_t i = 0; i < count; i++)
        s.triangles[i] = (scene_triangle){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return s;
}

scene soup_collinear(size_t count)
{
    scene s = soup_create("collinear", count);
    for (size_t i = 0; i < count; i++) {
        float x = (float)i;
        s.triangles[i] = (scene_triangle){{{x, 0, 0}, {x + 0.75f, 0, 0}, {x, 0x1p-20f, 0}}};
    }
    return s;
}

scene soup_coplanar(uint64_t seed, size_t count)
{
    scene s = soup_random(seed, count, 0.1);
    for (size_t i = 0; i < count; i++)
        for (int corner = 0; corner < 3; corner++)
            s.triangles[i].v[corner][1] = 0.25f;
    return s;
}

scene soup_needles(uint64_t seed, size_t count)
{
    scene s = soup_create("needles", count);
    base_random r = {seed};
    for (size_t i = 0; i < count; i++) {
        double a[3], b[3];
        point_in_cube(&r, 1.0, a);
        point_in_cube(&r, 1.0, b);
        for (int axis = 0; axis < 3; axis++) {
            s.triangles[i].v[0][axis] = (float)a[axis];
            s.triangles[i].v[1][axis] = (float)b[axis];
            s.triangles[i].v[2][axis] = (float)(b[axis] + base_random_range(&r, 0.5e-6, 1e-6));
        }
    }
    return s;
}

scene soup_placed(uint64_t seed, size_t count, float scale, float offset)
{
    scene s = soup_random(seed, count, 0.1);
    for (size_t i = 0; i < count; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                s.triangles[i].v[corner][axis] = s.triangles[i].v[corner][axis] * scale + offset;
    return s;
}

scene soup_telescope(size_t copies)
{
    enum { SIZES = 161 };
    scene s = soup_create("telescope", SIZES * copies);
    float size = 0x1p80f;
    for (size_t k = 0; k < SIZES; k++, size *= 0.5f)
        for (size_t copy = 0; copy < copies; copy++)
            s.triangles[k * copies + copy] = (scene_triangle){{{size, 0, 0}, {1.5f * size, 0, 0}, {size, size, size}}};
    return s;
}

scene soup_degenerate(uint64_t seed, size_t count, size_t stride)
{
    scene s = soup_random(seed, count, 0.1);
    for (size_t i = 0; i < count; i += stride) {
        scene_triangle *t = &s.triangles[i];
        for (int axis = 0; axis < 3; axis++)
            switch (i / stride % 3) {
            case 0:
                t->v[1][axis] = t->v[2][axis] = t->v[0][axis];
                break;
            case 1:
                t->v[2][axis] = t->v[1][axis];
                break;
            default: /* integers: the corners lie exactly in line */
                t->v[0][axis] = (float)(axis - 1);
                t->v[1][axis] = (float)(3 * axis + 1);
                t->v[2][axis] = (float)(7 * axis + 5);
                break;
            }
    }
    return s;
}
