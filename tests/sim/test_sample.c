/* Sampling: draws without repetition, exact when all is drawn, and intervals that hold what they promise. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "lrbni/base/random.h"
#include "sim/sample.h"

enum { UNITS = 400 };

/* Sizes over more than a decade; values about proportional to them, with a few units that are not. */
typedef struct population {
    sim_variates of[UNITS]; /* the size, and in some populations a second variate */
    double value[UNITS], total;
    unsigned variates;
} population;

static population make_population(uint64_t seed, double noise, double outliers)
{
    population p = {.variates = 1};
    base_random random = {.state = seed};
    for (int i = 0; i < UNITS; i++) {
        double u = base_random_unit(&random);
        p.of[i].x[0] = 1000 * (0.1 + u * u * 3);
        p.value[i] = p.of[i].x[0] * 2.5 * (1 + noise * (base_random_unit(&random) + base_random_unit(&random) - 1));
        if (base_random_unit(&random) < outliers)
            p.value[i] *= 1.3;
        p.total += p.value[i];
    }
    return p;
}

/* Values that depend on a second quantity as much as on the size, which says nothing of it. */
static population make_population_of_two(uint64_t seed, double noise)
{
    population p = make_population(seed, 0, 0);
    base_random random = {.state = seed + 1};
    p.total = 0;
    p.variates = 2;
    for (int i = 0; i < UNITS; i++) {
        p.of[i].x[1] = 100 * base_random_unit(&random);
        p.value[i] = (0.9 * p.of[i].x[0] + 15 * p.of[i].x[1]) * (1 + noise * (base_random_unit(&random) + base_random_unit(&random) - 1));
        p.total += p.value[i];
    }
    return p;
}

static sim_sample *make_sample(const population *p, size_t units, uint64_t seed)
{
    sim_sample *s = NULL;
    assert_int_equal(sim_sample_create(p->of, units, p->variates, seed, &s, NULL), BASE_OK);
    return s;
}

/* Draw a round and tell its values. */
static size_t draw_round(sim_sample *s, const population *p)
{
    size_t units[SIM_SAMPLE_STRATA], count = sim_sample_draw(s, units);
    for (size_t i = 0; i < count; i++)
        sim_sample_add(s, units[i], p->value[units[i]]);
    return count;
}

static void draws__until_none_is_left__each_unit_once(void **state)
{
    (void)state;
    population p = make_population(1, 0.1, 0);
    for (size_t units = 1; units <= 41; units += 4) {
        sim_sample *s = make_sample(&p, units, 7);
        unsigned char seen[UNITS] = {0};
        size_t drawn[SIM_SAMPLE_STRATA], count, sum = 0;
        while ((count = sim_sample_draw(s, drawn)) != 0) {
            for (size_t i = 0; i < count; i++) {
                assert_true(drawn[i] < units && !seen[drawn[i]]);
                seen[drawn[i]] = 1;
            }
            sum += count;
        }
        assert_int_equal(sum, units);
        sim_sample_destroy(&s);
        assert_null(s);
    }
}

static void draws__same_seed__same_order(void **state)
{
    (void)state;
    population p = make_population(1, 0.1, 0);
    sim_sample *a = make_sample(&p, UNITS, 5), *b = make_sample(&p, UNITS, 5), *other = make_sample(&p, UNITS, 6);
    int differs = 0;
    for (int round = 0; round < 10; round++) {
        size_t x[SIM_SAMPLE_STRATA], y[SIM_SAMPLE_STRATA], z[SIM_SAMPLE_STRATA];
        assert_int_equal(sim_sample_draw(a, x), SIM_SAMPLE_STRATA);
        assert_int_equal(sim_sample_draw(b, y), SIM_SAMPLE_STRATA);
        assert_int_equal(sim_sample_draw(other, z), SIM_SAMPLE_STRATA);
        assert_memory_equal(x, y, sizeof x);
        differs += memcmp(x, z, sizeof x) != 0;
    }
    assert_true(differs > 0);
    sim_sample_destroy(&a), sim_sample_destroy(&b), sim_sample_destroy(&other);
}

/* A round takes a unit of each quarter of the sum of sizes. */
static void strata__by_size__about_equal_sums(void **state)
{
    (void)state;
    population p = make_population(2, 0.1, 0);
    sim_sample *s = make_sample(&p, UNITS, 5);
    double low[SIM_SAMPLE_STRATA], high[SIM_SAMPLE_STRATA] = {0};
    for (int h = 0; h < SIM_SAMPLE_STRATA; h++)
        low[h] = HUGE_VAL;
    size_t drawn[SIM_SAMPLE_STRATA];
    for (int round = 0; round < 20; round++) {
        assert_int_equal(sim_sample_draw(s, drawn), SIM_SAMPLE_STRATA);
        for (int h = 0; h < SIM_SAMPLE_STRATA; h++) {
            low[h] = fmin(low[h], p.of[drawn[h]].x[0]);
            high[h] = fmax(high[h], p.of[drawn[h]].x[0]);
        }
    }
    for (int h = 0; h + 1 < SIM_SAMPLE_STRATA; h++)
        assert_true(high[h] <= low[h + 1]);
    sim_sample_destroy(&s);
}

static void estimate__nothing_or_one_round__no_interval(void **state)
{
    (void)state;
    population p = make_population(3, 0.1, 0);
    sim_sample *s = make_sample(&p, UNITS, 5);
    assert_true(isinf(sim_sample_estimate(s).half_width_95));
    draw_round(s, &p);
    sim_estimate one = sim_sample_estimate(s);
    assert_true(isinf(one.half_width_95) && one.added == SIM_SAMPLE_STRATA && one.units == UNITS);
    assert_true(fabs(one.total / p.total - 1) < 0.2);
    draw_round(s, &p);
    assert_true(isfinite(sim_sample_estimate(s).half_width_95));
    sim_sample_destroy(&s);
}

static void estimate__all_drawn__the_total(void **state)
{
    (void)state;
    population p = make_population(4, 0.4, 0.1);
    for (size_t units = 1; units <= UNITS; units += 57) {
        double total = 0;
        for (size_t i = 0; i < units; i++)
            total += p.value[i];
        sim_sample *s = make_sample(&p, units, 9);
        while (draw_round(s, &p)) {
        }
        sim_estimate e = sim_sample_estimate(s);
        assert_true(fabs(e.total / total - 1) < 1e-12);
        assert_int_equal(e.added, units);
        sim_sample_destroy(&s);
    }
}

static void estimate__values_proportional_to_sizes__exact_at_once(void **state)
{
    (void)state;
    population p = make_population(5, 0, 0);
    sim_sample *s = make_sample(&p, UNITS, 5);
    draw_round(s, &p), draw_round(s, &p);
    sim_estimate e = sim_sample_estimate(s);
    assert_true(fabs(e.total / p.total - 1) < 1e-12);
    assert_true(e.half_width_95 < 1e-9 * p.total);
    sim_sample_destroy(&s);
}

static void estimate__values_of_two_variates__exact_and_both_are_told(void **state)
{
    (void)state;
    population p = make_population_of_two(5, 0);
    sim_sample *s = make_sample(&p, UNITS, 5);
    draw_round(s, &p), draw_round(s, &p);
    sim_estimate e = sim_sample_estimate(s);
    assert_true(fabs(e.total / p.total - 1) < 1e-9);
    assert_true(e.half_width_95 < 1e-6 * p.total);
    assert_true(fabs(e.worth[0] - 0.9) < 1e-6 && fabs(e.worth[1] - 15) < 1e-6);
    sim_sample_destroy(&s);
}

/* A variate that follows from others adds nothing, and must not break the fit; nor must one that is 0 everywhere. */
static void estimate__variate_says_nothing_new__as_without_it(void **state)
{
    (void)state;
    population p = make_population(6, 0.2, 0);
    for (int kind = 0; kind < 3; kind++) {
        sim_sample *s = NULL, *plain = NULL;
        for (int i = 0; i < UNITS; i++) {
            p.of[i].x[1] = kind == 2 ? 1 + i % 7 : 0;
            p.of[i].x[2] = kind == 0 ? 0 : 3 * p.of[i].x[0] + 2 * p.of[i].x[1];
        }
        assert_int_equal(sim_sample_create(p.of, UNITS, 3, 5, &s, NULL), BASE_OK);
        assert_int_equal(sim_sample_create(p.of, UNITS, 2, 5, &plain, NULL), BASE_OK);
        for (int round = 0; round < 4; round++)
            draw_round(s, &p), draw_round(plain, &p);
        sim_estimate a = sim_sample_estimate(s), b = sim_sample_estimate(plain);
        assert_true(a.total == b.total && a.half_width_95 == b.half_width_95 && a.worth[2] == 0);
        assert_true((b.worth[1] != 0) == (kind == 2));
        sim_sample_destroy(&s), sim_sample_destroy(&plain);
    }
}

/* Four variates, and values that are made of them: found exactly, in the order of the variates, whatever these have in common. */
static void estimate__values_of_four_variates__exact_once_enough_are_known(void **state)
{
    (void)state;
    enum { FOUR = 4 };
    static const double worth[FOUR] = {0.9, 250, 15, -3};
    population p = make_population_of_two(8, 0);
    base_random random = {.state = 99};
    p.variates = FOUR;
    p.total = 0;
    for (int i = 0; i < UNITS; i++) {
        p.of[i].x[2] = p.of[i].x[0] / 20 + 100 * base_random_unit(&random);
        p.of[i].x[3] = p.of[i].x[1] + p.of[i].x[2] + base_random_unit(&random);
        p.value[i] = 0;
        for (int k = 0; k < FOUR; k++)
            p.value[i] += worth[k] * p.of[i].x[k];
        p.total += p.value[i];
    }
    sim_sample *s = make_sample(&p, UNITS, 5);
    draw_round(s, &p), draw_round(s, &p), draw_round(s, &p);
    assert_true(sim_sample_estimate(s).worth[2] != 0 && sim_sample_estimate(s).worth[3] == 0); /* of twelve units */
    draw_round(s, &p);
    sim_estimate e = sim_sample_estimate(s);
    assert_true(fabs(e.total / p.total - 1) < 1e-9 && e.half_width_95 < 1e-6 * p.total);
    for (int k = 0; k < FOUR; k++)
        assert_true(fabs(e.worth[k] / worth[k] - 1) < 1e-6);
    sim_sample_destroy(&s);
}

static void estimate__sizes_all_zero__no_division(void **state)
{
    (void)state;
    population p = {.variates = 2};
    sim_sample *s = make_sample(&p, UNITS, 5);
    draw_round(s, &p), draw_round(s, &p);
    sim_estimate e = sim_sample_estimate(s);
    assert_true(e.total == 0 && e.half_width_95 == 0);
    sim_sample_destroy(&s);
}

/* Of 2000 samples each, the share whose interval holds the total: 95% is promised; 2000 trials are good for +-1%. */
static void interval__many_samples__holds_the_total(void **state)
{
    (void)state;
    static const struct {
        double noise, outliers;
        int rounds, least_percent;
    } cases[] = {{0.05, 0, 3, 94}, {0.3, 0, 3, 94}, {0.3, 0, 12, 94}, {0.1, 0.1, 15, 94}, {0.1, 0.3, 15, 94}};
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        population p = make_population(100 + n, cases[n].noise, cases[n].outliers);
        int holds = 0;
        double bias = 0;
        for (uint64_t seed = 0; seed < 2000; seed++) {
            sim_sample *s = make_sample(&p, UNITS, seed * 7919);
            for (int round = 0; round < cases[n].rounds; round++)
                draw_round(s, &p);
            sim_estimate e = sim_sample_estimate(s);
            holds += fabs(e.total - p.total) <= e.half_width_95;
            bias += (e.total / p.total - 1) / 2000;
            sim_sample_destroy(&s);
        }
        print_message("# noise %.2f, outliers %.2f, %d rounds: %.2f%% of the intervals hold the total, bias %.3f%%\n", cases[n].noise,
                      cases[n].outliers, cases[n].rounds, holds / 20.0, 100 * bias);
        assert_true(holds >= 20 * cases[n].least_percent);
        assert_true(fabs(bias) < 0.002);
    }
}

/* With the second variate the interval is a fraction of what it is without. Of 12 units, small ones with as much of it as large
 * ones, it holds the total a little less often than promised: known, and bounded here. */
static void interval__second_variate__narrow_and_holds_the_total(void **state)
{
    (void)state;
    population p = make_population_of_two(7, 0.05), plain = p;
    int holds = 0;
    double with = 0, without = 0, bias = 0;
    plain.variates = 1;
    for (uint64_t seed = 0; seed < 2000; seed++) {
        sim_sample *s = make_sample(&p, UNITS, seed * 7919), *sizes = make_sample(&plain, UNITS, seed * 7919);
        for (int round = 0; round < 3; round++)
            draw_round(s, &p), draw_round(sizes, &plain);
        without += sim_sample_estimate(sizes).half_width_95 / p.total / 2000;
        sim_estimate e = sim_sample_estimate(s);
        with += e.half_width_95 / p.total / 2000;
        bias += (e.total / p.total - 1) / 2000;
        holds += fabs(e.total - p.total) <= e.half_width_95;
        sim_sample_destroy(&s), sim_sample_destroy(&sizes);
    }
    print_message("# second variate: %.2f%% of the intervals hold the total, half-width %.2f%%, without it %.2f%%, bias %.3f%%\n",
                  holds / 20.0, 100 * with, 100 * without, 100 * bias);
    assert_true(holds >= 20 * 93 && holds <= 20 * 99);
    assert_true(with < without / 4);
    assert_true(fabs(bias) < 0.0005);
}

static void student__few_and_many_degrees__as_tabulated(void **state)
{
    (void)state;
    static const struct {
        size_t freedom;
        double expected;
    } rows[] = {{1, 12.706}, {2, 4.303}, {9, 2.262}, {10, 2.228}, {12, 2.179}, {20, 2.086}, {30, 2.042}, {60, 2.000}, {120, 1.980}};
    assert_true(isinf(sim_student_95(0)));
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_true(fabs(sim_student_95(rows[i].freedom) - rows[i].expected) < 0.0011);
    assert_true(fabs(sim_student_95(1000000) - 1.95997) < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws__until_none_is_left__each_unit_once),
        cmocka_unit_test(draws__same_seed__same_order),
        cmocka_unit_test(strata__by_size__about_equal_sums),
        cmocka_unit_test(estimate__nothing_or_one_round__no_interval),
        cmocka_unit_test(estimate__all_drawn__the_total),
        cmocka_unit_test(estimate__values_proportional_to_sizes__exact_at_once),
        cmocka_unit_test(estimate__values_of_two_variates__exact_and_both_are_told),
        cmocka_unit_test(estimate__variate_says_nothing_new__as_without_it),
        cmocka_unit_test(estimate__values_of_four_variates__exact_once_enough_are_known),
        cmocka_unit_test(estimate__sizes_all_zero__no_division),
        cmocka_unit_test(interval__many_samples__holds_the_total),
        cmocka_unit_test(interval__second_variate__narrow_and_holds_the_total),
        cmocka_unit_test(student__few_and_many_degrees__as_tabulated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
