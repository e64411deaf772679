#include "sim/sample.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "lrbni/base/random.h"

typedef struct stratum {
    size_t first, count; /* of the order */
    size_t drawn;        /* the first so many of the order are */
} stratum;

struct sim_sample {
    size_t units;
    double *size, *value; /* by unit */
    size_t *order;        /* units, stratum by stratum; within a stratum in the order of draws */
    stratum strata[SIM_SAMPLE_STRATA];
    double total_size;
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
    s->value = calloc(s->units, sizeof *s->value);
    s->order = calloc(s->units, sizeof *s->order);
    if (!sorted || !s->size || !s->value || !s->order) {
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
    for (size_t h = 0; h < SIM_SAMPLE_STRATA; h++)
        shuffle(s->order + s->strata[h].first, s->strata[h].count, &random);
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
        free((*sample)->value);
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

void sim_sample_add(sim_sample *s, size_t unit, double size, double value)
{
    s->size[unit] = size;
    s->value[unit] = value;
}

/* Value less b times size of the i-th draw of a stratum. */
static double residual(const sim_sample *s, const stratum *h, size_t i, double b)
{
    size_t unit = s->order[h->first + i];
    return s->value[unit] - b * s->size[unit];
}

/* A stratum's share of the variance of the total; a stratum that is drawn whole has none. */
static double variance_of(const sim_sample *s, const stratum *h, double b)
{
    double mean = 0, squares = 0, n = (double)h->drawn, units = (double)h->count;
    if (h->drawn == h->count)
        return 0;
    for (size_t i = 0; i < h->drawn; i++)
        mean += residual(s, h, i, b) / n;
    for (size_t i = 0; i < h->drawn; i++) {
        double off = residual(s, h, i, b) - mean;
        squares += off * off;
    }
    return units * units * (1 - n / units) / n * squares / (n - 1);
}

/* The ratio of values to sizes over the strata. */
static double combined_ratio(const sim_sample *s)
{
    double values = 0, sizes = 0;
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++) {
        const stratum *h = &s->strata[k];
        for (size_t i = 0; i < h->drawn; i++) {
            double weight = (double)h->count / (double)h->drawn;
            values += weight * s->value[s->order[h->first + i]];
            sizes += weight * s->size[s->order[h->first + i]];
        }
    }
    return sizes > 0 ? values / sizes : 0;
}

sim_estimate sim_sample_estimate(const sim_sample *s)
{
    double variance = 0, b = combined_ratio(s);
    sim_estimate e = {.total = b * s->total_size, .units = s->units};
    double weighted = 0; /* sum of squared shares over their degrees of freedom */
    for (size_t k = 0; k < SIM_SAMPLE_STRATA; k++) {
        const stratum *h = &s->strata[k];
        e.drawn += h->drawn;
        double share = h->drawn > 1 || h->drawn == h->count ? variance_of(s, h, b) : HUGE_VAL;
        variance += share;
        if (share > 0)
            weighted += share * share / (double)(h->drawn > 1 ? h->drawn - 1 : 1);
    }
    if (variance > 0)
        e.half_width_95 = isinf(variance) ? HUGE_VAL : sim_student_95((size_t)(variance * variance / weighted)) * sqrt(variance);
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
