#include "sim/sample.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/random.h"

typedef struct stratum {
    size_t first, count; /* of the order */
    size_t drawn, added; /* the first so many of the order are */
} stratum;

struct sim_sample {
    size_t units;
    unsigned variates;
    sim_variates *of; /* by unit */
    double *value;    /* by unit */
    size_t *stratum_of;   /* by unit */
    size_t *order;        /* units, stratum by stratum; within a stratum in the order of draws */
    stratum strata[SIM_SAMPLE_STRATA];
    sim_variates total;
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
        double limit = s->total.x[0] * (double)(h + 1) / SIM_SAMPLE_STRATA;
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

static void take_variates(sim_sample *s, const sim_variates *of, sized_unit *sorted)
{
    for (size_t i = 0; i < s->units; i++) {
        s->of[i] = of[i];
        for (unsigned k = 0; k < s->variates; k++)
            s->total.x[k] += of[i].x[k];
        sorted[i] = (sized_unit){of[i].x[0], i};
    }
}

static base_status lay_out(sim_sample *s, const sim_variates *of, uint64_t seed, base_error *err)
{
    sized_unit *sorted = calloc(s->units, sizeof *sorted);
    s->of = calloc(s->units, sizeof *s->of);
    s->value = calloc(s->units, sizeof *s->value);
    s->stratum_of = calloc(s->units, sizeof *s->stratum_of);
    s->order = calloc(s->units, sizeof *s->order);
    if (!sorted || !s->of || !s->value || !s->stratum_of || !s->order) {
        free(sorted);
        return base_fail(err, BASE_ERR_NOMEM, "sample", "out of memory for %zu units", s->units);
    }
    take_variates(s, of, sorted);
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

base_status sim_sample_create(const sim_variates *of, size_t units, unsigned variates, uint64_t seed, sim_sample **out, base_error *err)
{
    assert(units > 0 && variates > 0 && variates <= SIM_SAMPLE_VARIATES);
    *out = NULL;
    sim_sample *s = calloc(1, sizeof *s);
    if (!s)
        return base_fail(err, BASE_ERR_NOMEM, "sample", "out of memory");
    s->units = units;
    s->variates = variates;
    base_status status = lay_out(s, of, seed, err);
    if (status != BASE_OK)
        sim_sample_destroy(&s);
    *out = s;
    return status;
}

void sim_sample_destroy(sim_sample **sample)
{
    if (*sample) {
        free((*sample)->of);
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

size_t sim_sample_largest(const sim_sample *s)
{
    size_t largest = 0;
    for (const stratum *h = s->strata; h < s->strata + SIM_SAMPLE_STRATA; h++)
        largest = h->count > largest ? h->count : largest;
    return largest;
}

void sim_sample_add(sim_sample *s, size_t unit, double value)
{
    stratum *h = &s->strata[s->stratum_of[unit]];
    assert(s->order[h->first + h->added] == unit);
    s->value[unit] = value;
    h->added++;
}

/* Least squares, after Gram and Schmidt: each variate less what those before it say of it, so that one adds nothing to what is known by others. */
typedef struct fit {
    unsigned count;                                           /* of the variates that are used */
    unsigned variate[SIM_SAMPLE_VARIATES];                    /* these */
    double of_earlier[SIM_SAMPLE_VARIATES][SIM_SAMPLE_VARIATES]; /* by place: how much of each earlier one is taken off it */
    double norm[SIM_SAMPLE_VARIATES];                         /* weighted sum of squares of what is left of it */
    double worth[SIM_SAMPLE_VARIATES];                        /* of what is left of it */
} fit;

/* How much a unit weighs in the fit; one of no size says nothing. */
static double weight_of(const sim_sample *s, const stratum *h, size_t unit)
{
    const double size = s->of[unit].x[0];
    return size > 0 ? (double)h->count / (double)h->added / size : 0;
}

/* What is left of each of the first `count` variates that are used. */
static void left_of(const fit *f, unsigned count, const sim_variates *of, double left[SIM_SAMPLE_VARIATES])
{
    for (unsigned k = 0; k < count; k++) {
        left[k] = of->x[f->variate[k]];
        for (unsigned j = 0; j < k; j++)
            left[k] -= f->of_earlier[k][j] * left[j];
    }
}

/* Weighted sums over the units that are known: of the last of `count` variates, by what is left of it, times what is left of each, itself
 * and all, and times the values. Returns the sum of its own squares as it is. */
static double sums_of(const sim_sample *s, const fit *f, unsigned count, double products[SIM_SAMPLE_VARIATES], double *values)
{
    double whole = 0, left[SIM_SAMPLE_VARIATES];
    *values = 0;
    for (unsigned k = 0; k < count; k++)
        products[k] = 0;
    for (const stratum *h = s->strata; h < s->strata + SIM_SAMPLE_STRATA; h++)
        for (size_t i = 0; i < h->added; i++) {
            const size_t unit = s->order[h->first + i];
            const double w = weight_of(s, h, unit), x = s->of[unit].x[f->variate[count - 1]];
            left_of(f, count, &s->of[unit], left);
            whole += w * x * x;
            *values += w * left[count - 1] * s->value[unit];
            for (unsigned k = 0; k < count; k++)
                products[k] += w * left[count - 1] * left[k];
        }
    return whole;
}

/* Use one more variate, unless it follows from those that are used. */
static void take_in(const sim_sample *s, fit *f, unsigned variate)
{
    const unsigned k = f->count;
    double products[SIM_SAMPLE_VARIATES], values;
    f->variate[k] = variate;
    memset(f->of_earlier[k], 0, sizeof f->of_earlier[k]);
    const double whole = sums_of(s, f, k + 1, products, &values);
    for (unsigned j = 0; j < k; j++)
        f->of_earlier[k][j] = products[j] / f->norm[j];
    sums_of(s, f, k + 1, products, &values);
    if (products[k] <= 1e-6 * whole)
        return;
    f->norm[k] = products[k];
    f->worth[k] = values / products[k];
    f->count++;
}

static fit least_squares(const sim_sample *s)
{
    enum { UNITS_EACH = 4 }; /* that are known for each variate that is used */
    fit f = {.count = 0};
    size_t units = 0;
    for (const stratum *h = s->strata; h < s->strata + SIM_SAMPLE_STRATA; h++)
        units += h->added;
    for (unsigned k = 0; k < s->variates && (k == 0 || units >= (size_t)UNITS_EACH * (f.count + 1)); k++)
        take_in(s, &f, k);
    return f;
}

/* What the fit makes of variates. */
static double fitted(const fit *f, const sim_variates *of)
{
    double left[SIM_SAMPLE_VARIATES], sum = 0;
    left_of(f, f->count, of, left);
    for (unsigned k = 0; k < f->count; k++)
        sum += f->worth[k] * left[k];
    return sum;
}

/* By how much the i-th unit of a stratum is off the fit, as if the fit had not known it: it is drawn towards the unit by its leverage
 * (J. G. MacKinnon, H. White, "Some heteroskedasticity-consistent covariance matrix estimators", 1985: HC3). No more than four times,
 * where a unit has nearly all the leverage. */
static double residual(const sim_sample *s, const stratum *h, size_t i, const fit *f)
{
    const size_t unit = s->order[h->first + i];
    double left[SIM_SAMPLE_VARIATES], leverage = 0;
    left_of(f, f->count, &s->of[unit], left);
    for (unsigned k = 0; k < f->count; k++)
        leverage += weight_of(s, h, unit) * left[k] * left[k] / f->norm[k];
    const double off = s->value[unit] - fitted(f, &s->of[unit]);
    return off / (leverage < 0.75 ? 1 - leverage : 0.25);
}

/* A stratum's share of the variance of the total; infinite if of several units less than two are known. Were the variates not all that a value
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
    double variance = 0, weighted = 0, units = 0; /* weighted: sum of squared shares over their degrees of freedom */
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++) {
        const stratum *h = &s->strata[k];
        const double share = variance_of(s, h, f);
        variance += share;
        units += (double)h->added;
        if (share > 0)
            weighted += share * share / (double)h->added;
    }
    if (variance == 0 || isinf(variance))
        return variance;
    const double freedom = variance * variance / weighted * (1 - (double)f->count / units);
    return sim_student_95(freedom > 1 ? (size_t)(freedom + 1e-9) : 1) * sqrt(variance);
}

sim_estimate sim_sample_estimate(const sim_sample *s)
{
    const fit f = least_squares(s);
    sim_estimate e = {.total = fitted(&f, &s->total), .half_width_95 = half_width(s, &f), .units = s->units};
    for (unsigned k = 0; k < f.count; k++) {
        sim_variates one = {{0}};
        one.x[f.variate[k]] = 1;
        e.worth[f.variate[k]] = fitted(&f, &one);
    }
    for (const stratum *h = s->strata; h < s->strata + SIM_SAMPLE_STRATA; h++)
        e.added += h->added;
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
