#include <assert.h>
#include <string.h>

#include "exact/predicates.h"
#include "exact/vector.h"

/* A face of a box has 4 vertices and each of at most 7 half-spaces adds one at most. */
enum { CORNERS = 4, MAX_VERTICES = 12, MAX_PLANES = 7 };

/* Vertices in order around the polygon. Only their directions matter, so each may be scaled by any positive number. */
typedef struct polygon {
    unsigned count;
    exact_vector vertex[MAX_VERTICES];
} polygon;

/* The points p with p.normal >= 0 for every normal: a cone whose apex is 0. */
typedef struct half_spaces {
    unsigned count;
    exact_vector normal[MAX_PLANES];
} half_spaces;

typedef struct cone {
    exact_vector corner[CORNERS];
    unsigned rank; /* dimension of the space that the corners span */
} cone;

static void vector_copy(exact_vector *out, const exact_vector *a)
{
    for (int k = 0; k < 3; k++)
        mpz_set(out->c[k], a->c[k]);
}

/* out = |to_dot| * from + |from_dot| * to, the point of the edge where the dot product is 0, up to scale. */
static void crossing(exact_vector *out, const exact_vector *from, const mpz_t from_dot, const exact_vector *to,
                     const mpz_t to_dot)
{
    mpz_t weight[2];
    mpz_init(weight[0]);
    mpz_init(weight[1]);
    mpz_abs(weight[0], to_dot);
    mpz_abs(weight[1], from_dot);
    for (int k = 0; k < 3; k++) {
        mpz_mul(out->c[k], from->c[k], weight[0]);
        mpz_addmul(out->c[k], to->c[k], weight[1]);
    }
    mpz_clear(weight[0]);
    mpz_clear(weight[1]);
}

/* out = the part of `in` with p.normal >= 0. */
static void polygon_clip(polygon *out, const polygon *in, const exact_vector *normal)
{
    mpz_t dot[2];
    mpz_init(dot[0]);
    mpz_init(dot[1]);
    out->count = 0;
    for (unsigned i = 0; i < in->count; i++) {
        const exact_vector *from = &in->vertex[i], *to = &in->vertex[(i + 1) % in->count];
        exact_vector_dot(dot[0], from, normal);
        exact_vector_dot(dot[1], to, normal);
        assert(out->count + 2 <= MAX_VERTICES);
        if (mpz_sgn(dot[0]) >= 0)
            vector_copy(&out->vertex[out->count++], from);
        if (mpz_sgn(dot[0]) * mpz_sgn(dot[1]) < 0)
            crossing(&out->vertex[out->count++], from, dot[0], to, dot[1]);
    }
    mpz_clear(dot[0]);
    mpz_clear(dot[1]);
}

/* Whether the polygon has a point other than the apex in all half-spaces. */
static int polygon_meets(const polygon *p, const half_spaces *planes)
{
    polygon buffer[2];
    int meets = 0;
    unsigned current = 0;
    for (int i = 0; i < 2; i++)
        exact_vector_init(buffer[i].vertex, MAX_VERTICES);
    polygon_clip(&buffer[0], p, &planes->normal[0]);
    for (unsigned i = 1; i < planes->count && buffer[current].count > 0; i++) {
        polygon_clip(&buffer[1 - current], &buffer[current], &planes->normal[i]);
        current = 1 - current;
    }
    for (unsigned i = 0; i < buffer[current].count; i++)
        meets |= !exact_vector_is_zero(&buffer[current].vertex[i]);
    for (int i = 0; i < 2; i++)
        exact_vector_clear(buffer[i].vertex, MAX_VERTICES);
    return meets;
}

/* Half-spaces of the cone over three corners; 0 if they lie in a plane. */
static int planes_of_triple(half_spaces *out, const exact_vector *c0, const exact_vector *c1, const exact_vector *c2)
{
    mpz_t det;
    int side;
    mpz_init(det);
    exact_vector_cross(&out->normal[0], c1, c2);
    exact_vector_cross(&out->normal[1], c2, c0);
    exact_vector_cross(&out->normal[2], c0, c1);
    exact_vector_dot(det, c0, &out->normal[0]);
    side = mpz_sgn(det);
    mpz_clear(det);
    out->count = 3;
    for (int i = 0; side < 0 && i < 3; i++)
        exact_vector_negate(&out->normal[i], &out->normal[i]);
    return side != 0;
}

/* Half-spaces of the flat cone over two corners: both sides of its plane, then its two borders; 0 if collinear. */
static int planes_of_pair(half_spaces *out, const exact_vector *c0, const exact_vector *c1)
{
    exact_vector_cross(&out->normal[0], c0, c1);
    exact_vector_negate(&out->normal[1], &out->normal[0]);
    exact_vector_cross(&out->normal[2], c1, &out->normal[0]);
    exact_vector_cross(&out->normal[3], &out->normal[0], c0);
    out->count = 4;
    return !exact_vector_is_zero(&out->normal[0]);
}

/* Half-spaces of one ray: p x c = 0 as six of them, and p.c >= 0; 0 if c is zero. */
static int planes_of_single(half_spaces *out, const exact_vector *c)
{
    exact_vector axis;
    exact_vector_init(&axis, 1);
    for (int k = 0; k < 3; k++) {
        mpz_set_si(axis.c[k], 1);
        exact_vector_cross(&out->normal[2 * k], &axis, c);
        exact_vector_negate(&out->normal[2 * k + 1], &out->normal[2 * k]);
        mpz_set_si(axis.c[k], 0);
    }
    exact_vector_clear(&axis, 1);
    vector_copy(&out->normal[6], c);
    out->count = 7;
    return !exact_vector_is_zero(c);
}

/* Half-spaces of the cone over the corners in `subset`, a bit mask; 0 if they are dependent. */
static int planes_of_subset(half_spaces *out, const cone *c, unsigned subset)
{
    const exact_vector *chosen[CORNERS];
    unsigned count = 0;
    for (unsigned i = 0; i < CORNERS; i++)
        if (subset >> i & 1)
            chosen[count++] = &c->corner[i];
    switch (count) {
    case 1:
        return planes_of_single(out, chosen[0]);
    case 2:
        return planes_of_pair(out, chosen[0], chosen[1]);
    case 3:
        return planes_of_triple(out, chosen[0], chosen[1], chosen[2]);
    default:
        return 0; /* four vectors of space are always dependent */
    }
}

static unsigned subset_size(unsigned subset)
{
    return (subset & 1) + (subset >> 1 & 1) + (subset >> 2 & 1) + (subset >> 3 & 1);
}

static void cone_init(cone *c, const float corner[4][3])
{
    half_spaces planes;
    int e = EXACT_NO_EXPONENT;
    for (int i = 0; i < CORNERS; i++)
        e = exact_vector_exponent(e, corner[i]);
    exact_vector_init(c->corner, CORNERS);
    for (int i = 0; i < CORNERS; i++)
        exact_vector_set(&c->corner[i], corner[i], e);
    c->rank = 0;
    exact_vector_init(planes.normal, MAX_PLANES);
    for (unsigned subset = 1; subset < 1u << CORNERS; subset++)
        if (subset_size(subset) > c->rank && planes_of_subset(&planes, c, subset))
            c->rank = subset_size(subset);
    exact_vector_clear(planes.normal, MAX_PLANES);
}

static void cone_clear(cone *c)
{
    exact_vector_clear(c->corner, CORNERS);
}

/* Whether the cone and any of the polygons share a point other than the apex. */
static int cone_meets(const cone *c, const polygon *polygons, unsigned count)
{
    half_spaces planes;
    int meets = 0;
    exact_vector_init(planes.normal, MAX_PLANES);
    for (unsigned subset = 1; subset < 1u << CORNERS && !meets; subset++) {
        if (subset_size(subset) != c->rank || !planes_of_subset(&planes, c, subset))
            continue;
        for (unsigned i = 0; i < count && !meets; i++)
            meets = polygon_meets(&polygons[i], &planes);
    }
    exact_vector_clear(planes.normal, MAX_PLANES);
    return meets;
}

/* out = the points relative to org, as integers. */
static void polygon_set(polygon *out, const float org[3], const float (*point)[3], unsigned count)
{
    exact_vector apex;
    int e = exact_vector_exponent(EXACT_NO_EXPONENT, org);
    for (unsigned i = 0; i < count; i++)
        e = exact_vector_exponent(e, point[i]);
    exact_vector_init(&apex, 1);
    exact_vector_set(&apex, org, e);
    for (unsigned i = 0; i < count; i++) {
        exact_vector_set(&out->vertex[i], point[i], e);
        exact_vector_subtract(&out->vertex[i], &out->vertex[i], &apex);
    }
    out->count = count;
    exact_vector_clear(&apex, 1);
}

/* Sign of N.(org - v0): 1 if org sees the front, -1 the back, 0 if it lies in the plane. */
static int side_seen(const polygon *triangle)
{
    exact_vector normal;
    mpz_t volume;
    int side;
    exact_vector_init(&normal, 1);
    mpz_init(volume);
    exact_vector_cross(&normal, &triangle->vertex[0], &triangle->vertex[1]);
    exact_vector_dot(volume, &normal, &triangle->vertex[2]);
    side = -mpz_sgn(volume); /* N.v0 = det(v0, v1, v2) for vertices relative to org */
    mpz_clear(volume);
    exact_vector_clear(&normal, 1);
    return side;
}

int exact_cone_triangle(const float org[3], const float corner[4][3], const float v0[3], const float v1[3],
                        const float v2[3], int cull_backface)
{
    float point[3][3];
    polygon triangle;
    int side, meets = 0;
    memcpy(point[0], v0, sizeof point[0]);
    memcpy(point[1], v1, sizeof point[1]);
    memcpy(point[2], v2, sizeof point[2]);
    exact_vector_init(triangle.vertex, MAX_VERTICES);
    polygon_set(&triangle, org, (const float(*)[3])point, 3);
    side = side_seen(&triangle);
    /* From a point of its plane a triangle is met edge on (det = 0) or at t = 0, and neither is a hit. */
    if (side > 0 || (side < 0 && !cull_backface)) {
        cone c;
        cone_init(&c, corner);
        meets = cone_meets(&c, &triangle, 1);
        cone_clear(&c);
    }
    exact_vector_clear(triangle.vertex, MAX_VERTICES);
    return meets;
}

/* The face of a box on the side `high` of `axis`, its vertices in order around it. */
static void face_points(float point[4][3], const float lo[3], const float hi[3], int axis, int high)
{
    int i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (int n = 0; n < 4; n++) {
        point[n][axis] = high ? hi[axis] : lo[axis];
        point[n][i] = n == 1 || n == 2 ? hi[i] : lo[i];
        point[n][j] = n >= 2 ? hi[j] : lo[j];
    }
}

int exact_cone_box(const float org[3], const float corner[4][3], const float lo[3], const float hi[3])
{
    polygon face[6];
    cone c;
    int inside = 1, meets;
    for (int k = 0; k < 3; k++) {
        if (!(lo[k] <= hi[k]))
            return 0;
        inside &= lo[k] <= org[k] && org[k] <= hi[k];
    }
    if (inside)
        return 1; /* at t = 0 */
    for (int i = 0; i < 6; i++) {
        float point[4][3];
        face_points(point, lo, hi, i / 2, i % 2);
        exact_vector_init(face[i].vertex, MAX_VERTICES);
        polygon_set(&face[i], org, (const float(*)[3])point, 4);
    }
    cone_init(&c, corner);
    meets = cone_meets(&c, face, 6);
    cone_clear(&c);
    for (int i = 0; i < 6; i++)
        exact_vector_clear(face[i].vertex, MAX_VERTICES);
    return meets;
}
