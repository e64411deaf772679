#include "sim/sample.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "lrbni/base/random.h"

typedef struct stratum {
    size_t first, count; /* of the order */
    size_t drawn, added; /* the first so many of the order are */
} stratum;

struct sim_sample {
    size_t units;
    double *size, *second, *value; /* by unit */
    size_t *stratum_of;   /* by unit */
    size_t *order;        /* units, stratum by stratum; within a stratum in the order of draws */
    stratum strata[SIM_SAMPLE_STRATA];
    double total_size, total_second;
};

/* A unit on its way into order. */
typedef struct sized_unit {
    double size;
    size_t unit;
} sized_unit;

static int by_size(const void *a, const void *b)
{
    const sized_unit *x = a, *y = b;
    if (x->size != y->size)
        return x->size < y->size ? -1 : 1;
    return x->unit < y->unit ? -1 : x->unit > y->unit;
}

/* Cut the ordered units where the running sum of sizes passes a quarter, a half, ...; each stratum gets at least one. */
static void cut_strata(sim_sample *s, const sized_unit *sorted)
{
    double sum = 0;
    size_t at = 0;
    for (size_t h = 0; h < SIM_SAMPLE_STRATA; h++) {
        size_t left = SIM_SAMPLE_STRATA - 1 - h;
        double limit = s->total_size * (double)(h + 1) / SIM_SAMPLE_STRATA;
        s->strata[h].first = at;
        while (at < s->units && (left == 0 || (s->units - at > left && (at == s->strata[h].first || sum + sorted[at].size <= limit))))
            sum += sorted[at++].size;
        s->strata[h].count = at - s->strata[h].first;
    }
}

static void shuffle(size_t *order, size_t count, base_random *random)
{
    for (size_t i = count; i > 1; i--) {
        size_t j = (size_t)(base_random_unit(random) * (double)i);
        size_t held = order[i - 1];
        order[i - 1] = order[j];
        order[j] = held;
    }
}

static base_status lay_out(sim_sample *s, const double *size, uint64_t seed, base_error *err)
{
    sized_unit *sorted = calloc(s->units, sizeof *sorted);
    s->size = calloc(s->units, sizeof *s->size);
    s->second = calloc(s->units, sizeof *s->second);
    s->value = calloc(s->units, sizeof *s->value);
    s->stratum_of = calloc(s->units, sizeof *s->stratum_of);
    s->order = calloc(s->units, sizeof *s->order);
    if (!sorted || !s->size || !s->second || !s->value || !s->stratum_of || !s->order) {
        free(sorted);
        return base_fail(err, BASE_ERR_NOMEM, "sample", "out of memory for %zu units", s->units);
    }
    for (size_t i = 0; i < s->units; i++) {
        s->size[i] = size[i];
        s->total_size += size[i];
        sorted[i] = (sized_unit){size[i], i};
    }
    qsort(sorted, s->units, sizeof *sorted, by_size);
    for (size_t i = 0; i < s->units; i++)
        s->order[i] = sorted[i].unit;
    cut_strata(s, sorted);
    free(sorted);
    base_random random = {.state = seed};
    for (size_t h = 0; h < SIM_SAMPLE_STRATA; h++) {
        shuffle(s->order + s->strata[h].first, s->strata[h].count, &random);
        for (size_t i = 0; i < s->strata[h].count; i++)
            s->stratum_of[s->order[s->strata[h].first + i]] = h;
    }
    return BASE_OK;
}

base_status sim_sample_create(const double *size, size_t units, uint64_t seed, sim_sample **out, base_error *err)
{
    assert(units > 0);
    *out = NULL;
    sim_sample *s = calloc(1, sizeof *s);
    if (!s)
        return base_fail(err, BASE_ERR_NOMEM, "sample", "out of memory");
    s->units = units;
    base_status status = lay_out(s, size, seed, err);
    if (status != BASE_OK)
        sim_sample_destroy(&s);
    *out = s;
    return status;
}

void sim_sample_destroy(sim_sample **sample)
{
    if (*sample) {
        free((*sample)->size);
        free((*sample)->second);
        free((*sample)->value);
        free((*sample)->stratum_of);
        free((*sample)->order);
        free(*sample);
    }
    *sample = NULL;
}

size_t sim_sample_draw(sim_sample *s, size_t units[SIM_SAMPLE_STRATA])
{
    size_t count = 0;
    for (size_t h = 0; h < SIM_SAMPLE_STRATA; h++)
        if (s->strata[h].drawn < s->strata[h].count)
            units[count++] = s->order[s->strata[h].first + s->strata[h].drawn++];
    return count;
}

void sim_sample_set_second(sim_sample *s, const double *second)
{
    s->total_second = 0;
    for (size_t i = 0; i < s->units; i++)
        s->total_second += s->second[i] = second[i];
}

void sim_sample_add(sim_sample *s, size_t unit, double value)
{
    stratum *h = &s->strata[s->stratum_of[unit]];
    assert(s->order[h->first + h->added] == unit);
    s->value[unit] = value;
    h->added++;
}

/* The least squares: y = b x + c z, and the inverse of the matrix of their normal equations, for leverages. */
typedef struct fit {
    double b, c;
    double xx, xz, zz; /* of the inverse */
    bool both;         /* false: c is 0, there is too little to tell x and z apart */
} fit;

/* How much a unit weighs in the fit; one of no size says nothing. */
static double weight_of(const sim_sample *s, const stratum *h, size_t unit)
{
    return s->size[unit] > 0 ? (double)h->count / (double)h->added / s->size[unit] : 0;
}

static fit least_squares(const sim_sample *s)
{
    enum { FEWEST = 6 };
    double xx = 0, xz = 0, zz = 0, xy = 0, zy = 0;
    size_t units = 0;
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++) {
        const stratum *h = &s->strata[k];
        units += h->added;
        for (size_t i = 0; i < h->added; i++) {
            const size_t unit = s->order[h->first + i];
            const double w = weight_of(s, h, unit), x = s->size[unit], z = s->second[unit], y = s->value[unit];
            xx += w * x * x, xz += w * x * z, zz += w * z * z;
            xy += w * x * y, zy += w * z * y;
        }
    }
    const double determinant = xx * zz - xz * xz;
    if (units < FEWEST || determinant <= 1e-6 * xx * zz)
        return (fit){.b = xx > 0 ? xy / xx : 0, .xx = xx > 0 ? 1 / xx : 0};
    return (fit){.b = (zz * xy - xz * zy) / determinant, .c = (xx * zy - xz * xy) / determinant, .both = true,
                 .xx = zz / determinant, .xz = -xz / determinant, .zz = xx / determinant};
}

/* By how much the i-th unit of a stratum is off the fit, as if the fit had not known it: it is drawn towards the unit by its leverage
 * (J. G. MacKinnon, H. White, "Some heteroskedasticity-consistent covariance matrix estimators", 1985: HC3). No more than four times,
 * where a unit has nearly all the leverage. */
static double residual(const sim_sample *s, const stratum *h, size_t i, const fit *f)
{
    const size_t unit = s->order[h->first + i];
    const double x = s->size[unit], z = f->both ? s->second[unit] : 0;
    const double leverage = weight_of(s, h, unit) * (f->xx * x * x + 2 * f->xz * x * z + f->zz * z * z);
    const double off = s->value[unit] - f->b * x - f->c * z;
    return off / (leverage < 0.75 ? 1 - leverage : 0.25);
}

/* A stratum's share of the variance of the total; infinite if of several units less than two are known. Were x and z not all that a value
 * depends on, residuals of a stratum had a mean of their own; it is left in: that only widens the interval. */
static double variance_of(const sim_sample *s, const stratum *h, const fit *f)
{
    double squares = 0, n = (double)h->added, units = (double)h->count;
    if (h->count == 0)
        return 0;
    if (h->added < 2 && h->added < h->count)
        return HUGE_VAL;
    for (size_t i = 0; i < h->added; i++) {
        double off = residual(s, h, i, f);
        squares += off * off;
    }
    return units * units / n * squares / n;
}

/* Student's interval for the variance that the strata have together. */
static double half_width(const sim_sample *s, const fit *f)
{
    double variance = 0, weighted = 0; /* the latter: sum of squared shares over their degrees of freedom */
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++) {
        const stratum *h = &s->strata[k];
        const double share = variance_of(s, h, f);
        variance += share;
        if (share > 0)
            weighted += share * share / (double)h->added;
    }
    if (variance == 0 || isinf(variance))
        return variance;
    const double freedom = variance * variance / weighted - (f->both ? 2 : 1);
    return sim_student_95(freedom > 1 ? (size_t)(freedom + 1e-9) : 1) * sqrt(variance);
}

sim_estimate sim_sample_estimate(const sim_sample *s)
{
    const fit f = least_squares(s);
    sim_estimate e = {.total = f.b * s->total_size + f.c * s->total_second, .half_width_95 = half_width(s, &f),
                      .units = s->units, .per_size = f.b, .per_second = f.c};
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++)
        e.added += s->strata[k].added;
    return e;
}

double sim_student_95(size_t freedom)
{
    static const double exact[] = {HUGE_VAL, 12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622};
    const double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, f = (double)freedom;
    if (freedom < sizeof exact / sizeof exact[0])
        return exact[freedom];
    /* M. Abramowitz, I. Stegun, "Handbook of Mathematical Functions", 1964, 26.7.5 */
    return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f) + (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * f * f * f);
}
