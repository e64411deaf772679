#include "exact/predicates.h"

#include <assert.h>
#include <float.h>
#include <math.h>

#include "exact/vector.h"

/* A triangle as seen from a ray's origin: integers in units of 2^position_exponent and 2^dir_exponent. */
typedef struct view {
    int position_exponent, dir_exponent;
    exact_vector org, dir;
    exact_vector vertex[3]; /* relative to org */
} view;

static void view_init(view *w, const float org[3], const float dir[3], const float *const vertex[3])
{
    int e = exact_vector_exponent(EXACT_NO_EXPONENT, org);
    for (int i = 0; i < 3; i++)
        e = exact_vector_exponent(e, vertex[i]);
    w->position_exponent = e;
    w->dir_exponent = exact_vector_exponent(EXACT_NO_EXPONENT, dir);
    exact_vector_init(&w->org, 1);
    exact_vector_init(&w->dir, 1);
    exact_vector_init(w->vertex, 3);
    exact_vector_set(&w->org, org, e);
    exact_vector_set(&w->dir, dir, w->dir_exponent);
    for (int i = 0; i < 3; i++) {
        exact_vector_set(&w->vertex[i], vertex[i], e);
        exact_vector_subtract(&w->vertex[i], &w->vertex[i], &w->org);
    }
}

static void view_clear(view *w)
{
    exact_vector_clear(&w->org, 1);
    exact_vector_clear(&w->dir, 1);
    exact_vector_clear(w->vertex, 3);
}

/* Nearest double to q, ties to even: mpq_get_d truncates, so the answer is that or its neighbour away from 0. */
static double nearest_double(const mpq_t q)
{
    double low = mpq_get_d(q), high = nextafter(low, mpq_sgn(q) < 0 ? -HUGE_VAL : HUGE_VAL), result = low;
    mpq_t middle, other;
    int order;
    if (!isfinite(low) || !isfinite(high))
        return low;
    mpq_init(middle);
    mpq_init(other);
    mpq_set_d(middle, low);
    mpq_set_d(other, high);
    mpq_add(middle, middle, other);
    mpq_div_2exp(middle, middle, 1);
    order = mpq_cmp(q, middle) * (mpq_sgn(q) < 0 ? -1 : 1);
    if (order > 0)
        result = high;
    else if (order == 0) {
        int unused;
        double mantissa = ldexp(frexp(low, &unused), DBL_MANT_DIG);
        result = fmod(mantissa, 2.0) == 0.0 ? low : high;
    }
    mpq_clear(middle);
    mpq_clear(other);
    return result;
}

/* out = num / den * 2^exponent */
static void set_quotient(mpq_t out, const mpz_t num, const mpz_t den, int exponent)
{
    mpq_set_num(out, num);
    mpq_set_den(out, den);
    mpq_canonicalize(out);
    if (exponent >= 0)
        mpq_mul_2exp(out, out, (mp_bitcnt_t)exponent);
    else
        mpq_div_2exp(out, out, (mp_bitcnt_t)-exponent);
}

static double quotient_double(const mpz_t num, const mpz_t den)
{
    mpq_t q;
    double result;
    mpq_init(q);
    set_quotient(q, num, den, 0);
    result = nearest_double(q);
    mpq_clear(q);
    return result;
}

void exact_hit_init(exact_hit *hit)
{
    hit->hit = 0;
    hit->facing = 0;
    mpq_init(hit->t);
    hit->t_double = hit->u = hit->v = 0.0;
}

void exact_hit_clear(exact_hit *hit)
{
    mpq_clear(hit->t);
}

static void hit_set_none(exact_hit *hit)
{
    hit->hit = 0;
    hit->facing = 0;
    mpq_set_ui(hit->t, 0, 1);
    hit->t_double = hit->u = hit->v = 0.0;
}

/* Cramer's rule on org + t*dir = v0 + u*e1 + v*e2: each unknown is a determinant divided by det = -N.dir. */
static void solve(const view *w, mpz_t det, mpz_t t, mpz_t u, mpz_t v)
{
    exact_vector work[4];
    exact_vector *e1 = &work[0], *e2 = &work[1], *normal = &work[2], *turned = &work[3];
    const exact_vector *a = &w->vertex[0];
    exact_vector_init(work, 4);
    exact_vector_subtract(e1, &w->vertex[1], a);
    exact_vector_subtract(e2, &w->vertex[2], a);
    exact_vector_cross(normal, e1, e2);
    exact_vector_dot(det, normal, &w->dir);
    mpz_neg(det, det);
    exact_vector_dot(t, normal, a);
    mpz_neg(t, t);
    exact_vector_cross(turned, &w->dir, a); /* u = a . (e2 x dir) = e2 . (dir x a) */
    exact_vector_dot(u, e2, turned);
    exact_vector_dot(v, e1, turned); /* v = a . (dir x e1) = -e1 . (dir x a) */
    mpz_neg(v, v);
    exact_vector_clear(work, 4);
}

int exact_ray_triangle(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                       const float v2[3], exact_hit *out)
{
    view w;
    mpz_t det, t, u, v, rest;
    view_init(&w, org, dir, (const float *const[3]){v0, v1, v2});
    mpz_inits(det, t, u, v, rest, NULL);
    hit_set_none(out);
    solve(&w, det, t, u, v);
    out->facing = mpz_sgn(det);
    if (out->facing != 0) {
        set_quotient(out->t, t, det, w.position_exponent - w.dir_exponent);
        out->t_double = nearest_double(out->t);
        out->u = quotient_double(u, det);
        out->v = quotient_double(v, det);
        mpz_sub(rest, det, u);
        mpz_sub(rest, rest, v);
        out->hit = mpz_sgn(t) == out->facing && mpz_sgn(u) * out->facing >= 0 && mpz_sgn(v) * out->facing >= 0 &&
                   mpz_sgn(rest) * out->facing >= 0;
    }
    mpz_clears(det, t, u, v, rest, NULL);
    view_clear(&w);
    return out->hit;
}

int exact_triangle_has_area(const float v0[3], const float v1[3], const float v2[3])
{
    view w;
    exact_vector work[3];
    view_init(&w, v0, v0, (const float *const[3]){v0, v1, v2});
    exact_vector_init(work, 3);
    exact_vector_subtract(&work[0], &w.vertex[1], &w.vertex[0]);
    exact_vector_subtract(&work[1], &w.vertex[2], &w.vertex[0]);
    exact_vector_cross(&work[2], &work[0], &work[1]);
    int area = !exact_vector_is_zero(&work[2]);
    exact_vector_clear(work, 3);
    view_clear(&w);
    return area;
}

int exact_hit_compare_t(const exact_hit *a, const exact_hit *b)
{
    assert(a->facing != 0 && b->facing != 0);
    int order = mpq_cmp(a->t, b->t);
    return (order > 0) - (order < 0);
}

int exact_hit_compare_value(const exact_hit *hit, double value)
{
    mpq_t other;
    int order;
    assert(hit->facing != 0 && !isnan(value));
    if (isinf(value))
        return value > 0.0 ? -1 : 1;
    mpq_init(other);
    mpq_set_d(other, value);
    order = mpq_cmp(hit->t, other);
    mpq_clear(other);
    return (order > 0) - (order < 0);
}

static double largest_coordinate(const float x[3], double largest)
{
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fabs((double)x[k]));
    return largest;
}

/* 2^-23 * max(1, M / min(|a|,|b|)); a and b are not 0, or else their cross product would be. */
static double margin_unit(const view *w, int from, int to, double magnitude)
{
    long exponent;
    double a = exact_vector_length(&w->vertex[from], &exponent);
    a = ldexp(a, (int)exponent + w->position_exponent);
    double b = exact_vector_length(&w->vertex[to], &exponent);
    b = ldexp(b, (int)exponent + w->position_exponent);
    return 0x1p-23 * fmax(1.0, magnitude / fmin(a, b));
}

/* Signed sine of the angle between the ray and the plane of one edge, in units of margin_unit; 0 without a plane. */
static double edge_margin(const view *w, int from, int to, double magnitude)
{
    exact_vector normal;
    mpz_t dot;
    double result = 0.0;
    exact_vector_init(&normal, 1);
    mpz_init(dot);
    exact_vector_cross(&normal, &w->vertex[from], &w->vertex[to]);
    exact_vector_dot(dot, &normal, &w->dir);
    if (mpz_sgn(dot) != 0) {
        long dot_exponent, normal_exponent, dir_exponent;
        double sine = mpz_get_d_2exp(&dot_exponent, dot);
        sine /= exact_vector_length(&normal, &normal_exponent) * exact_vector_length(&w->dir, &dir_exponent);
        sine = ldexp(sine, (int)(dot_exponent - normal_exponent - dir_exponent));
        result = sine / margin_unit(w, from, to, magnitude);
    }
    mpz_clear(dot);
    exact_vector_clear(&normal, 1);
    return result;
}

/* Sign of det(a, b, c), on which side of the plane the origin lies: the sign of every edge's dot on the inside. */
static int view_side(const view *w)
{
    exact_vector normal;
    mpz_t volume;
    int side;
    exact_vector_init(&normal, 1);
    mpz_init(volume);
    exact_vector_cross(&normal, &w->vertex[0], &w->vertex[1]);
    exact_vector_dot(volume, &normal, &w->vertex[2]);
    side = mpz_sgn(volume);
    mpz_clear(volume);
    exact_vector_clear(&normal, 1);
    return side;
}

void exact_edge_margins_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                            const float v2[3], double margin[3])
{
    const float *const vertex[3] = {v0, v1, v2};
    view w;
    view_init(&w, org, dir, vertex);
    int side = view_side(&w);
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3;
        double magnitude = largest_coordinate(org, 0.0);
        magnitude = largest_coordinate(vertex[i], magnitude);
        magnitude = largest_coordinate(vertex[next], magnitude);
        margin[i] = edge_margin(&w, i, next, magnitude);
        margin[i] = side == 0 ? -fabs(margin[i]) : margin[i] * side;
    }
    view_clear(&w);
}

double exact_edge_distance_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3],
                               const float v2[3])
{
    double margin[3];
    exact_edge_margins_ulp(org, dir, v0, v1, v2, margin);
    return fmin(fabs(margin[0]), fmin(fabs(margin[1]), fabs(margin[2])));
}

void exact_interval_init(exact_interval *interval)
{
    interval->empty = 1;
    interval->unbounded = 0;
    mpq_inits(interval->entry, interval->exit, NULL);
    interval->entry_double = interval->exit_double = 0.0;
}

void exact_interval_clear(exact_interval *interval)
{
    mpq_clears(interval->entry, interval->exit, NULL);
}

static void interval_set_empty(exact_interval *interval)
{
    interval->empty = 1;
    interval->unbounded = 0;
    mpq_set_ui(interval->entry, 0, 1);
    mpq_set_ui(interval->exit, 0, 1);
    interval->entry_double = interval->exit_double = 0.0;
}

/* out = (plane - org) / dir, all floats. */
static void plane_parameter(mpq_t out, float plane, float org, float dir)
{
    mpq_t divisor;
    mpq_init(divisor);
    mpq_set_d(out, (double)plane);
    mpq_set_d(divisor, (double)org);
    mpq_sub(out, out, divisor);
    mpq_set_d(divisor, (double)dir);
    mpq_div(out, out, divisor);
    mpq_clear(divisor);
}

/* Narrow out to the stretch between the two planes of one axis. */
static void clip_to_slab(exact_interval *out, float org, float dir, float lo, float hi)
{
    mpq_t near, far;
    assert(isfinite(org) && isfinite(dir) && isfinite(lo) && isfinite(hi));
    if (dir == 0.0f) {
        if (org < lo || org > hi)
            out->empty = 1;
        return;
    }
    mpq_inits(near, far, NULL);
    plane_parameter(near, dir > 0.0f ? lo : hi, org, dir);
    plane_parameter(far, dir > 0.0f ? hi : lo, org, dir);
    if (mpq_cmp(near, out->entry) > 0)
        mpq_set(out->entry, near);
    if (out->unbounded || mpq_cmp(far, out->exit) < 0)
        mpq_set(out->exit, far);
    out->unbounded = 0;
    if (mpq_cmp(out->entry, out->exit) > 0)
        out->empty = 1;
    mpq_clears(near, far, NULL);
}

void exact_box_interval(const float org[3], const float dir[3], const float lo[3], const float hi[3],
                        exact_interval *out)
{
    interval_set_empty(out);
    for (int k = 0; k < 3; k++)
        if (!(lo[k] <= hi[k]))
            return;
    out->empty = 0;
    out->unbounded = 1;
    for (int k = 0; k < 3 && !out->empty; k++)
        clip_to_slab(out, org[k], dir[k], lo[k], hi[k]);
    if (out->empty) {
        interval_set_empty(out);
        return;
    }
    out->entry_double = nearest_double(out->entry);
    out->exit_double = out->unbounded ? (double)INFINITY : nearest_double(out->exit);
}

int exact_ray_box(const float org[3], const float dir[3], const float lo[3], const float hi[3])
{
    exact_interval interval;
    exact_interval_init(&interval);
    exact_box_interval(org, dir, lo, hi, &interval);
    int meets = !interval.empty;
    exact_interval_clear(&interval);
    return meets;
}
