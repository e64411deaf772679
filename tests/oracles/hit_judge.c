#include "tests/oracles/hit_judge.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>

#include "lrbni/base/parallel.h"
#include "exact/predicates.h"

enum { RAYS_PER_PIECE = 4096 };

/* Rounding errors that a float intersection test may add up in t, in units of 2^-24 (see t_allowance). */
static const double T_ROUNDINGS = 16.0;

typedef struct docket {
    const judge_options *options;
    const scene_triangle *triangles;
    size_t triangle_count;
    const oracle_ray *rays;
    const oracle_hit *ours, *embree;
    size_t ray_count;
    judge_verdict *verdicts;
    atomic_size_t first_wrong;
    atomic_uint_fast64_t count[JUDGE_VERDICTS];
} docket;

/* A triangle that one side reported, and the truth about it. */
typedef struct witness {
    exact_hit exact;
    int named;       /* there is such a triangle */
    int counts;      /* it is hit, from a side that counts and inside the ray's range */
    int at_end;      /* t is within the tolerance of an end of the range, so it may be claimed either way */
    double t;        /* exact.t_double */
    double margin;   /* of the nearest border: inside positive, outside negative [edge units] */
} witness;

judge_options judge_options_default(void)
{
    return (judge_options){.t_relative = 1e-5, .edge_ulp = 4.0, .cull_backface = 0};
}

const char *judge_verdict_name(judge_verdict verdict)
{
    static const char *const names[JUDGE_VERDICTS] = {"agree", "tie", "Embree wrong", "near edge", "ours wrong"};
    return verdict < JUDGE_VERDICTS ? names[verdict] : "none";
}

static int same_t(double a, double b, double relative)
{
    return isfinite(a) && isfinite(b) && fabs(a - b) <= relative * fmax(fabs(a), fabs(b));
}

/* out = to - from; returns its length. */
static double difference(double out[3], const float to[3], const float from[3])
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        out[k] = (double)to[k] - (double)from[k];
        square += out[k] * out[k];
    }
    return sqrt(square);
}

/*
 * How far a float test's t may lie from the truth, beyond the relative tolerance: t is the quotient of
 * e2.((o-v0) x e1) by e1.(d x e2); each of the two carries some roundings relative to the product of the lengths of
 * its factors, which at grazing incidence is much larger than the result.
 */
static double t_allowance(const oracle_ray *ray, const scene_triangle *triangle, double t)
{
    static const float zero[3];
    double e1[3], e2[3], s[3], d[3], det = 0.0;
    double area = difference(e1, triangle->v[1], triangle->v[0]) * difference(e2, triangle->v[2], triangle->v[0]);
    double distance = difference(s, ray->org, triangle->v[0]), speed = difference(d, ray->dir, zero);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        det += d[k] * (e1[i] * e2[j] - e1[j] * e2[i]);
    }
    return T_ROUNDINGS * 0x1p-24 * area * (distance + fabs(t) * speed) / fabs(det);
}

static void witness_call(witness *w, const judge_options *options, const scene_triangle *triangles,
                         const oracle_ray *ray, uint32_t id)
{
    double margin[3], low = (double)ray->tmin, high = (double)ray->tmax;
    w->named = id != ORACLE_NO_HIT;
    w->counts = w->at_end = 0;
    w->t = (double)INFINITY;
    w->margin = -(double)INFINITY;
    exact_hit_init(&w->exact);
    if (!w->named)
        return;
    const scene_triangle *triangle = &triangles[id];
    exact_ray_triangle(ray->org, ray->dir, triangle->v[0], triangle->v[1], triangle->v[2], &w->exact);
    exact_edge_margins_ulp(ray->org, ray->dir, triangle->v[0], triangle->v[1], triangle->v[2], margin);
    w->margin = fmin(margin[0], fmin(margin[1], margin[2]));
    if (w->exact.facing == 0)
        return;
    w->t = w->exact.t_double;
    w->at_end = (low > 0.0 && same_t(w->t, low, options->t_relative)) || same_t(w->t, high, options->t_relative);
    w->counts = w->exact.hit && (!options->cull_backface || w->exact.facing > 0) &&
                exact_hit_compare_value(&w->exact, low) > 0 && exact_hit_compare_value(&w->exact, high) < 0;
}

/* Whether the ray passes close enough to the triangle's border that float arithmetic may claim either. */
static int near_border(const judge_options *options, const witness *w)
{
    return fabs(w->margin) <= options->edge_ulp;
}

/* Whether 'the ray hits this triangle' is true or excusable. */
static int claim_stands(const judge_options *options, const witness *w)
{
    return w->counts || w->at_end || near_border(options, w);
}

/* The claims of ours that are false, weighed. */
static judge_verdict weigh(const judge_options *options, const witness *mine, const witness *theirs,
                           const oracle_hit *ours)
{
    int false_hit = mine->named && !mine->counts;
    int false_miss = theirs->counts;
    if (false_miss && mine->counts)
        false_miss = exact_hit_compare_t(&theirs->exact, &mine->exact) < 0;
    else if (false_miss && mine->named)
        false_miss = theirs->t < ours->t; /* behind a hit that is not there, nothing was claimed about theirs */
    if (!false_hit && !false_miss)
        return JUDGE_EMBREE_WRONG;
    if (mine->counts && theirs->counts && same_t(mine->t, theirs->t, options->t_relative))
        return JUDGE_TIE;
    if ((!false_hit || mine->at_end) && (!false_miss || theirs->at_end))
        return JUDGE_TIE;
    if (false_hit && !claim_stands(options, mine))
        return JUDGE_OURS_WRONG;
    if (false_miss && !theirs->at_end && !near_border(options, theirs))
        return JUDGE_OURS_WRONG;
    return JUDGE_NEAR_EDGE;
}

/* Whether our t is that of the triangle within rounding. */
static int t_is_right(const judge_options *options, const scene_triangle *triangle, const oracle_ray *ray,
                      const oracle_hit *ours, const exact_hit *exact)
{
    if (exact->facing == 0)
        return 0;
    double allowed = options->t_relative * fabs(exact->t_double) + t_allowance(ray, triangle, exact->t_double);
    return fabs(ours->t - exact->t_double) <= allowed;
}

/* Verdict on a difference, in the id or in t. */
static judge_verdict judge_difference(const judge_options *options, const scene_triangle *triangles,
                                      const oracle_ray *ray, const oracle_hit *ours, const oracle_hit *embree)
{
    witness mine, theirs;
    judge_verdict verdict;
    witness_call(&mine, options, triangles, ray, ours->id);
    witness_call(&theirs, options, triangles, ray, embree->id);
    if ((mine.counts || ours->id == embree->id) &&
        !t_is_right(options, &triangles[ours->id], ray, ours, &mine.exact))
        verdict = JUDGE_OURS_WRONG;
    else if (ours->id == embree->id)
        verdict = JUDGE_AGREE;
    else if (mine.named && theirs.named && same_t(ours->t, embree->t, options->t_relative) &&
             claim_stands(options, &mine))
        verdict = JUDGE_TIE;
    else
        verdict = weigh(options, &mine, &theirs, ours);
    exact_hit_clear(&mine.exact);
    exact_hit_clear(&theirs.exact);
    return verdict;
}

judge_verdict hit_judge_ray(const judge_options *options, const scene_triangle *triangles, size_t triangle_count,
                            const oracle_ray *ray, const oracle_hit *ours, const oracle_hit *embree)
{
    assert(embree->id == ORACLE_NO_HIT || embree->id < triangle_count);
    if (ours->id == embree->id && (ours->id == ORACLE_NO_HIT || same_t(ours->t, embree->t, options->t_relative)))
        return JUDGE_AGREE;
    if (ours->id != ORACLE_NO_HIT && (ours->id >= triangle_count || isnan(ours->t)))
        return JUDGE_OURS_WRONG;
    return judge_difference(options, triangles, ray, ours, embree);
}

static void judge_piece(void *user, size_t piece, unsigned worker)
{
    docket *d = user;
    uint64_t count[JUDGE_VERDICTS] = {0};
    size_t end = (piece + 1) * RAYS_PER_PIECE, wrong = SIZE_MAX, seen;
    (void)worker;
    if (end > d->ray_count)
        end = d->ray_count;
    for (size_t i = piece * RAYS_PER_PIECE; i < end; i++) {
        judge_verdict verdict = hit_judge_ray(d->options, d->triangles, d->triangle_count, &d->rays[i], &d->ours[i],
                                              &d->embree[i]);
        count[verdict]++;
        if (verdict == JUDGE_OURS_WRONG && wrong == SIZE_MAX)
            wrong = i;
        if (d->verdicts)
            d->verdicts[i] = verdict;
    }
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        atomic_fetch_add(&d->count[v], count[v]);
    seen = atomic_load(&d->first_wrong);
    while (wrong < seen && !atomic_compare_exchange_weak(&d->first_wrong, &seen, wrong))
        ;
}

judge_summary hit_judge_rays(const judge_options *options, const scene_triangle *triangles, size_t triangle_count,
                             const oracle_ray *rays, const oracle_hit *ours, const oracle_hit *embree,
                             size_t ray_count, unsigned jobs, judge_verdict *verdicts)
{
    docket d = {.options = options, .triangles = triangles, .triangle_count = triangle_count, .rays = rays,
                .ours = ours, .embree = embree, .ray_count = ray_count, .verdicts = verdicts};
    judge_summary summary;
    atomic_init(&d.first_wrong, SIZE_MAX);
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        atomic_init(&d.count[v], 0);
    base_parallel_for(jobs, (ray_count + RAYS_PER_PIECE - 1) / RAYS_PER_PIECE, judge_piece, &d);
    for (int v = 0; v < JUDGE_VERDICTS; v++)
        summary.count[v] = atomic_load(&d.count[v]);
    summary.first_wrong = atomic_load(&d.first_wrong);
    return summary;
}
