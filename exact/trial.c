#include "exact/trial.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/predicates.h"

/* The filter passes over a triangle only if an edge's plane lies this far off the ray, on the wrong side. */
static const double FILTER_ULP = TRIAL_EDGE_ULP + 1.0;

/* Bound on the rounding of a determinant of three vectors in double, relative to the product of their lengths. */
static const double DETERMINANT_ERROR = 0x1p-49;

/* Within this share of the farthest vertex's distance the origin may lie in the plane, and the filter keeps away. */
static const double FLAT = 0x1p-18;

/* A triangle as the filter sees it, in double, relative to the origin. */
typedef struct seen {
    double edge[3][3]; /* planes through the origin and the edges, turned so that a hit has no dot product below 0 */
    double sure[3];    /* per unit of length of a direction: dot products below minus this are misses, above this clear of the edge */
    bool known;        /* the filter may be used */
    bool none;         /* cannot be hit at all */
} seen;

struct trial_view {
    const scene_triangle *triangles;
    size_t count;
    float origin[3];
    bool cull;
    seen *seen;
};

/* A triangle that the ray hits, or whose border it passes closely. */
typedef struct candidate {
    uint32_t id;
    exact_hit hit;
    bool counts;      /* it is hit, from a side that counts */
    double border;    /* distance from the border [exact_border_ulp], or at least FILTER_ULP */
    double unit;      /* 2^-24 of the largest distance at hand */
    double slope;     /* change of t as the plane moves by that much */
    double allowance; /* what t may be off */
} candidate;

struct trial_ray {
    const trial_view *view;
    double direction[3];
    candidate *candidates; /* `room` with their hits initialised */
    size_t count, room, nearest; /* nearest == SIZE_MAX: none */
};

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double length(const double a[3]) { return sqrt(dot(a, a)); }

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* The vertices relative to the origin: the differences of floats, rounded to double. */
static void relative(const scene_triangle *t, const float origin[3], double out[3][3])
{
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            out[v][k] = (double)t->v[v][k] - (double)origin[k];
}

static bool is_finite(const scene_triangle *t)
{
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(t->v[v][k]))
                return false;
    return true;
}

/* Edges from the first vertex, and the normal. */
static void plane_of(double v[3][3], double e[3], double f[3], double normal[3])
{
    for (int k = 0; k < 3; k++) {
        e[k] = v[1][k] - v[0][k];
        f[k] = v[2][k] - v[0][k];
    }
    cross(e, f, normal);
}

/* Whether no ray hits the triangle; exact arithmetic is asked only where double precision leaves it open. */
static bool hit_by_none(const scene_triangle *t, double v[3][3])
{
    double e[3], f[3], normal[3];
    if (!is_finite(t))
        return true;
    plane_of(v, e, f, normal);
    return !(length(normal) > 0x1p-40 * length(e) * length(f)) && !exact_triangle_has_area(t->v[0], t->v[1], t->v[2]);
}

static seen see(const scene_triangle *t, const float origin[3])
{
    seen s = {0};
    double v[3][3], e[3], f[3], normal[3], size[3];
    relative(t, origin, v);
    s.none = hit_by_none(t, v);
    for (int i = 0; i < 3; i++)
        size[i] = length(v[i]);
    for (int i = 0; i < 3; i++) {
        const int from = (i + 1) % 3, to = (i + 2) % 3;
        cross(v[from], v[to], s.edge[i]);
        s.sure[i] = FILTER_ULP * 0x1p-23 * length(s.edge[i]) + DETERMINANT_ERROR * size[from] * size[to];
    }
    const double volume = dot(s.edge[0], v[0]);
    plane_of(v, e, f, normal);
    s.known = !s.none && fabs(volume) > FLAT * length(normal) * fmax(size[0], fmax(size[1], size[2])) &&
              fabs(volume) > DETERMINANT_ERROR * size[0] * size[1] * size[2];
    for (int i = 0; i < 3 && volume < 0; i++)
        for (int k = 0; k < 3; k++)
            s.edge[i][k] = -s.edge[i][k];
    return s;
}

base_status trial_view_create(const scene_triangle *triangles, size_t count, const float origin[3], bool cull, trial_view **out,
                              base_error *err)
{
    trial_view *view = calloc(1, sizeof *view);
    *out = view;
    if (view)
        view->seen = calloc(count ? count : 1, sizeof *view->seen);
    if (!view || !view->seen) {
        trial_view_destroy(out);
        return base_fail(err, BASE_ERR_NOMEM, "trial", "out of memory for %zu triangles", count);
    }
    view->triangles = triangles;
    view->count = count;
    view->cull = cull;
    memcpy(view->origin, origin, sizeof view->origin);
    for (size_t i = 0; i < count; i++)
        view->seen[i] = see(&triangles[i], origin);
    return BASE_OK;
}

void trial_view_destroy(trial_view **view)
{
    if (*view)
        free((*view)->seen);
    free(*view);
    *view = NULL;
}

base_status trial_ray_create(trial_ray **out, base_error *err)
{
    *out = calloc(1, sizeof **out);
    return *out ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, "trial", "out of memory");
}

void trial_ray_destroy(trial_ray **ray)
{
    if (*ray) {
        for (size_t i = 0; i < (*ray)->room; i++)
            exact_hit_clear(&(*ray)->candidates[i].hit);
        free((*ray)->candidates);
    }
    free(*ray);
    *ray = NULL;
}

static base_status make_room(trial_ray *ray, base_error *err)
{
    const size_t room = ray->room ? 2 * ray->room : 16;
    candidate *grown = realloc(ray->candidates, room * sizeof *grown);
    if (!grown)
        return base_fail(err, BASE_ERR_NOMEM, "trial", "out of memory for %zu triangles at a ray", room);
    ray->candidates = grown;
    for (; ray->room < room; ray->room++)
        exact_hit_init(&grown[ray->room].hit);
    return BASE_OK;
}

/*
 * How t answers to a plane that is moved. Rounding moves the plane by some 2^-24 of the distance of the vertex that it is
 * taken from and of the hit; along the ray that is the more the flatter the ray meets it. The estimate and two Newton steps
 * of a reciprocal come on top, another 4 units of t.
 */
static void set_allowance(candidate *c, const scene_triangle *t, const float origin[3], const float direction[3])
{
    double v[3][3], e[3], f[3], n[3], d[3], farthest = 0;
    relative(t, origin, v);
    for (int k = 0; k < 3; k++) {
        d[k] = (double)direction[k];
        farthest = fmax(farthest, length(v[k]));
    }
    plane_of(v, e, f, n);
    c->unit = 0x1p-24 * fmax(farthest, fabs(c->hit.t_double) * length(d));
    c->slope = c->unit * length(n) / fabs(dot(n, d));
    c->allowance = TRIAL_PLANE_ULP * c->slope + 0x1p-22 * fabs(c->hit.t_double);
}

/* Whether the ray starts within rounding of the triangle, so that it may be held to be hit or not. */
static bool at_start(const candidate *c) { return c->hit.facing != 0 && fabs(c->hit.t_double) <= c->allowance; }

/* Whether 'this triangle is hit' is true or excusable. */
static bool may_be_hit(const candidate *c) { return c->counts || c->border <= TRIAL_EDGE_ULP || at_start(c); }

/* Whether 'this triangle is hit' is true beyond excuse. */
static bool must_be_hit(const candidate *c) { return c->counts && c->border > TRIAL_EDGE_ULP && !at_start(c); }

/* Take up a triangle if there is anything to say about it. */
static base_status examine(trial_ray *ray, uint32_t id, const float direction[3], bool clear, base_error *err)
{
    const trial_view *view = ray->view;
    const scene_triangle *t = &view->triangles[id];
    base_status status = ray->count < ray->room ? BASE_OK : make_room(ray, err);
    if (status != BASE_OK)
        return status;
    candidate *c = &ray->candidates[ray->count];
    const bool hit = exact_ray_triangle(view->origin, direction, t->v[0], t->v[1], t->v[2], &c->hit);
    c->id = id;
    c->counts = hit && (!view->cull || c->hit.facing > 0);
    c->border = clear ? FILTER_ULP : exact_border_ulp(view->origin, direction, t->v[0], t->v[1], t->v[2]);
    c->unit = c->slope = c->allowance = 0;
    if (c->hit.facing != 0)
        set_allowance(c, t, view->origin, direction);
    if (!may_be_hit(c))
        return BASE_OK;
    if (c->counts && (ray->nearest == SIZE_MAX || exact_hit_compare_t(&c->hit, &ray->candidates[ray->nearest].hit) < 0))
        ray->nearest = ray->count;
    ray->count++;
    return BASE_OK;
}

/* What double precision knows of a ray and a triangle. */
typedef enum sight { MISSES, HITS_CLEAR_OF_EDGES, OPEN } sight;

static sight sight_of(const seen *s, const double d[3], double size)
{
    if (s->none)
        return MISSES;
    if (!s->known)
        return OPEN;
    const double a = dot(s->edge[0], d), b = dot(s->edge[1], d), c = dot(s->edge[2], d);
    if (a < -s->sure[0] * size || b < -s->sure[1] * size || c < -s->sure[2] * size)
        return MISSES;
    return a > s->sure[0] * size && b > s->sure[1] * size && c > s->sure[2] * size ? HITS_CLEAR_OF_EDGES : OPEN;
}

base_status trial_ray_find(trial_ray *ray, const trial_view *view, const float direction[3], base_error *err)
{
    const double d[3] = {(double)direction[0], (double)direction[1], (double)direction[2]}, size = length(d);
    base_status status = BASE_OK;
    ray->view = view;
    memcpy(ray->direction, d, sizeof d);
    ray->count = 0;
    ray->nearest = SIZE_MAX;
    for (size_t i = 0; status == BASE_OK && i < view->count; i++) {
        const sight known = sight_of(&view->seen[i], d, size);
        if (known != MISSES)
            status = examine(ray, (uint32_t)i, direction, known == HITS_CLEAR_OF_EDGES, err);
    }
    return status;
}

uint32_t trial_ray_nearest(const trial_ray *ray)
{
    return ray->nearest == SIZE_MAX ? TRIAL_NO_HIT : ray->candidates[ray->nearest].id;
}

double trial_ray_distance(const trial_ray *ray)
{
    return ray->nearest == SIZE_MAX ? (double)INFINITY : ray->candidates[ray->nearest].hit.t_double;
}

bool trial_ray_at_edge(const trial_ray *ray)
{
    for (size_t i = 0; i < ray->count; i++)
        if (ray->candidates[i].border <= TRIAL_EDGE_ULP)
            return true;
    return false;
}

static const candidate *candidate_of(const trial_ray *ray, uint32_t id)
{
    for (size_t i = 0; i < ray->count; i++)
        if (ray->candidates[i].id == id)
            return &ray->candidates[i];
    return NULL;
}

/* Whether something is hit beyond excuse, and for certain nearer than `found`, which may be NULL for nothing found. */
static bool something_lost(const trial_ray *ray, const candidate *found)
{
    for (size_t i = 0; i < ray->count; i++) {
        const candidate *c = &ray->candidates[i];
        if (c != found && must_be_hit(c) &&
            (!found || c->hit.t_double + c->allowance < found->hit.t_double - found->allowance))
            return true;
    }
    return false;
}

/* Whether two triangles are one, or one and its opposite: then their distances are equal in floats as well. */
static bool same_triangle(const scene_triangle *a, const scene_triangle *b)
{
    enum { POINT = sizeof a->v[0] };
    return memcmp(a->v[0], b->v[0], POINT) == 0 &&
           ((memcmp(a->v[1], b->v[1], POINT) == 0 && memcmp(a->v[2], b->v[2], POINT) == 0) ||
            (memcmp(a->v[1], b->v[2], POINT) == 0 && memcmp(a->v[2], b->v[1], POINT) == 0));
}

static trial_verdict verdict_on_hit(const trial_ray *ray, const candidate *found, const trial_answer *answer)
{
    const scene_triangle *triangles = ray->view->triangles;
    const candidate *nearest = ray->nearest == SIZE_MAX ? NULL : &ray->candidates[ray->nearest];
    if (found->hit.facing != 0 && !(fabs((double)answer->t - found->hit.t_double) <= found->allowance))
        return TRIAL_WRONG;
    if (something_lost(ray, found))
        return TRIAL_LOST;
    if (found == nearest)
        return TRIAL_RIGHT;
    if (!found->counts || !nearest || found->hit.t_double - found->allowance > nearest->hit.t_double + nearest->allowance)
        return TRIAL_EDGE;
    return same_triangle(&triangles[found->id], &triangles[nearest->id]) ? TRIAL_WRONG : TRIAL_TIE;
}

/* Length of what the weights' errors move the point by, at right angles to the ray. */
static double point_off_ray(const scene_triangle *t, double u_error, double v_error, const double d[3])
{
    double off[3], across[3];
    for (int k = 0; k < 3; k++)
        off[k] = u_error * ((double)t->v[1][k] - (double)t->v[0][k]) + v_error * ((double)t->v[2][k] - (double)t->v[0][k]);
    cross(off, d, across);
    return length(across) / length(d);
}

static void measure_errors(trial_finding *finding, const trial_ray *ray, const candidate *found, const trial_answer *answer)
{
    int exponent;
    const double error = fabs((double)answer->t - found->hit.t_double);
    frexp(found->hit.t_double, &exponent);
    finding->t_ulp = ldexp(error, FLT_MANT_DIG - (exponent < FLT_MIN_EXP ? FLT_MIN_EXP : exponent));
    finding->plane_ulp = found->slope > 0 ? error / found->slope : 0;
    finding->point_ulp = point_off_ray(&ray->view->triangles[found->id], (double)answer->u - found->hit.u, (double)answer->v - found->hit.v,
                                       ray->direction) / found->unit;
}

trial_finding trial_ray_answer(const trial_ray *ray, const trial_answer *answer)
{
    trial_finding finding = {.verdict = TRIAL_RIGHT};
    if (answer->id == TRIAL_NO_HIT) {
        finding.leak = ray->nearest != SIZE_MAX;
        finding.verdict = something_lost(ray, NULL) ? TRIAL_LOST : finding.leak ? TRIAL_EDGE : TRIAL_RIGHT;
        return finding;
    }
    const candidate *found = candidate_of(ray, answer->id);
    if (!found || !(answer->t > 0.0f && isfinite(answer->t))) {
        finding.verdict = TRIAL_WRONG;
        return finding;
    }
    finding.verdict = verdict_on_hit(ray, found, answer);
    if (finding.verdict == TRIAL_RIGHT || finding.verdict == TRIAL_TIE)
        measure_errors(&finding, ray, found, answer);
    return finding;
}

bool trial_ray_blocked(const trial_ray *ray, trial_span span)
{
    for (size_t i = 0; i < ray->count; i++) {
        const candidate *c = &ray->candidates[i];
        if (c->counts && c->hit.t_double > (double)span.nearest && c->hit.t_double < (double)span.farthest)
            return true;
    }
    return false;
}

/* Whether a triangle's distance is within the span beyond excuse, and whether it may be held to be. */
static bool must_be_within(const candidate *c, trial_span span)
{
    return c->hit.t_double - c->allowance > (double)span.nearest && c->hit.t_double + c->allowance < (double)span.farthest;
}

static bool may_be_within(const candidate *c, trial_span span)
{
    return c->hit.facing == 0 ||
           (c->hit.t_double + c->allowance > (double)span.nearest && c->hit.t_double - c->allowance < (double)span.farthest);
}

trial_finding trial_ray_answer_blocked(const trial_ray *ray, trial_span span, bool answer)
{
    const bool blocked = trial_ray_blocked(ray, span);
    bool must = false, may = false;
    for (size_t i = 0; i < ray->count; i++) {
        const candidate *c = &ray->candidates[i];
        must |= must_be_hit(c) && must_be_within(c, span);
        may |= may_be_within(c, span);
    }
    trial_finding finding = {.verdict = answer == blocked ? TRIAL_RIGHT : TRIAL_EDGE, .leak = blocked && !answer};
    if (answer && !may)
        finding.verdict = TRIAL_WRONG;
    if (!answer && must)
        finding.verdict = TRIAL_LOST;
    return finding;
}
