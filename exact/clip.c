#include "exact/clip.h"

enum { MOST = 10 };

typedef struct polygon {
    mpq_t p[MOST][3];
    int count;
} polygon;

static void polygon_init(polygon *it)
{
    it->count = 0;
    for (int i = 0; i < MOST; i++)
        for (int k = 0; k < 3; k++)
            mpq_init(it->p[i][k]);
}

static void polygon_clear(polygon *it)
{
    for (int i = 0; i < MOST; i++)
        for (int k = 0; k < 3; k++)
            mpq_clear(it->p[i][k]);
}

/* The point of a b at the plane, where their distances from it have unlike signs. */
static void append_cut(polygon *out, mpq_t a[3], mpq_t b[3], const mpq_t da, const mpq_t db)
{
    mpq_t t, part;
    mpq_inits(t, part, NULL);
    mpq_sub(t, da, db);
    mpq_div(t, da, t);
    for (int k = 0; k < 3; k++) {
        mpq_sub(part, b[k], a[k]);
        mpq_mul(part, part, t);
        mpq_add(out->p[out->count][k], a[k], part);
    }
    out->count++;
    mpq_clears(t, part, NULL);
}

/* Distance from a plane across an axis, above 0 on the side that is kept. */
static void distance(mpq_t d, const mpq_t at, const mpq_t plane, int side)
{
    if (side == 0)
        mpq_sub(d, at, plane);
    else
        mpq_sub(d, plane, at);
}

static void cut(polygon *in, int axis, double at, int side, polygon *out)
{
    mpq_t plane, da, db;
    mpq_inits(plane, da, db, NULL);
    mpq_set_d(plane, at);
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        mpq_t *a = in->p[i], *b = in->p[(i + 1) % in->count];
        distance(da, a[axis], plane, side);
        distance(db, b[axis], plane, side);
        if (mpq_sgn(da) >= 0) {
            for (int k = 0; k < 3; k++)
                mpq_set(out->p[out->count][k], a[k]);
            out->count++;
        }
        if (mpq_sgn(da) * mpq_sgn(db) < 0)
            append_cut(out, a, b, da, db);
    }
    mpq_clears(plane, da, db, NULL);
}

static void twice_area(polygon *in, int axis, mpq_t area)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_si(area, 0, 1);
    for (int i = 0; i < in->count; i++) {
        mpq_t *p = in->p[i], *q = in->p[(i + 1) % in->count];
        mpq_mul(a, p[u], q[v]);
        mpq_mul(b, p[v], q[u]);
        mpq_sub(a, a, b);
        mpq_add(area, area, a);
    }
    mpq_abs(area, area);
    mpq_clears(a, b, NULL);
}

int exact_clip(const float v[3][3], const double min[3], const double max[3], int axis, mpq_t area)
{
    polygon polygons[2];
    int from = 0;
    polygon_init(&polygons[0]);
    polygon_init(&polygons[1]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            mpq_set_d(polygons[0].p[i][k], (double)v[i][k]);
    polygons[0].count = 3;
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            cut(&polygons[from], k, side == 0 ? min[k] : max[k], side, &polygons[from ^ 1]);
            from ^= 1;
        }
    twice_area(&polygons[from], axis, area);
    int count = polygons[from].count;
    polygon_clear(&polygons[0]);
    polygon_clear(&polygons[1]);
    return count;
}
