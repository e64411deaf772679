#include "tests/kernels/accel/single_ray.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void test_triangle(const single_ray *r, const float v[3][3], uint32_t id, single_hit *h)
{
    double e1[3], e2[3], s[3], p[3], q[3];
    for (int a = 0; a < 3; a++) {
        e1[a] = (double)v[1][a] - (double)v[0][a];
        e2[a] = (double)v[2][a] - (double)v[0][a];
        s[a] = r->o[a] - (double)v[0][a];
    }
    cross(r->d, e2, p);
    cross(s, e1, q);
    double det = dot(e1, p);
    double u = dot(s, p) / det, w = dot(r->d, q) / det, t = dot(e2, q) / det;
    if (det != 0.0 && u >= 0.0 && w >= 0.0 && u + w <= 1.0 && t > 0.0 && (t < h->t || (t == h->t && id < h->id)))
        *h = (single_hit){t, id};
}

void single_ray_record(const single_ray *r, const bvh_triangle *record, single_hit *h)
{
    float v[3][3];
    memcpy(v[0], record->v0, sizeof v[0]);
    memcpy(v[1], record->v1, sizeof v[1]);
    memcpy(v[2], record->v2, sizeof v[2]);
    test_triangle(r, (const float(*)[3])v, record->id, h);
}

single_hit single_ray_brute_force(const scene *s, const single_ray *r)
{
    single_hit h = {HUGE_VAL, SINGLE_NO_HIT};
    for (size_t i = 0; i < s->triangle_count; i++)
        test_triangle(r, (const float(*)[3])s->triangles[i].v, (uint32_t)i, &h);
    return h;
}
