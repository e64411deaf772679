#include "tests/oracles/brute_force.h"

#include <assert.h>
#include <math.h>

#include "lrbni/base/parallel.h"

enum { RAYS_PER_PIECE = 16 };

typedef struct vector {
    double x, y, z;
} vector;

typedef struct search {
    const scene_triangle *triangles;
    size_t triangle_count;
    const oracle_ray *rays;
    size_t ray_count;
    int cull_backface;
    oracle_hit *hits;
} search;

static vector from_floats(const float f[3])
{
    return (vector){(double)f[0], (double)f[1], (double)f[2]};
}

static vector subtract(vector a, vector b)
{
    return (vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static vector cross(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Whether the ray meets the triangle at any t; fills in t, u and v. */
static int intersect(const scene_triangle *triangle, vector org, vector dir, int cull_backface, oracle_hit *hit)
{
    vector v0 = from_floats(triangle->v[0]);
    vector e1 = subtract(from_floats(triangle->v[1]), v0), e2 = subtract(from_floats(triangle->v[2]), v0);
    vector p = cross(dir, e2), s = subtract(org, v0), q = cross(s, e1);
    double det = dot(e1, p);
    if (!(det > 0.0 || (det < 0.0 && !cull_backface)))
        return 0;
    hit->u = dot(s, p) / det;
    hit->v = dot(dir, q) / det;
    hit->t = dot(e2, q) / det;
    return hit->u >= 0.0 && hit->v >= 0.0 && hit->u + hit->v <= 1.0;
}

static oracle_hit closest(const search *s, const oracle_ray *ray)
{
    oracle_hit best = {.id = ORACLE_NO_HIT, .t = (double)INFINITY};
    vector org = from_floats(ray->org), dir = from_floats(ray->dir);
    for (size_t i = 0; i < s->triangle_count; i++) {
        oracle_hit hit = {.id = (uint32_t)i};
        if (intersect(&s->triangles[i], org, dir, s->cull_backface, &hit) && hit.t > (double)ray->tmin &&
            hit.t < (double)ray->tmax && hit.t < best.t)
            best = hit;
    }
    return best;
}

static void search_piece(void *user, size_t piece, unsigned worker)
{
    const search *s = user;
    size_t end = (piece + 1) * RAYS_PER_PIECE;
    (void)worker;
    if (end > s->ray_count)
        end = s->ray_count;
    for (size_t i = piece * RAYS_PER_PIECE; i < end; i++)
        s->hits[i] = closest(s, &s->rays[i]);
}

void brute_force_closest(const scene_triangle *triangles, size_t triangle_count, const oracle_ray *rays,
                         size_t ray_count, int cull_backface, unsigned jobs, oracle_hit *hits)
{
    search s = {triangles, triangle_count, rays, ray_count, cull_backface, hits};
    assert(triangle_count < ORACLE_NO_HIT);
    base_parallel_for(jobs, (ray_count + RAYS_PER_PIECE - 1) / RAYS_PER_PIECE, search_piece, &s);
}
