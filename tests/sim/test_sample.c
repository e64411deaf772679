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
    double size[UNITS], second[UNITS], value[UNITS], total;
} population;

static population make_population(uint64_t seed, double noise, double outliers)
{
    population p = {.total = 0};
    base_random random = {.state = seed};
    for (int i = 0; i < UNITS; i++) {
        double u = base_random_unit(&random);
        p.size[i] = 1000 * (0.1 + u * u * 3);
        p.value[i] = p.size[i] * 2.5 * (1 + noise * (base_random_unit(&random) + base_random_unit(&random) - 1));
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
    for (int i = 0; i < UNITS; i++) {
        p.second[i] = 100 * base_random_unit(&random);
        p.value[i] = (0.9 * p.size[i] + 15 * p.second[i]) * (1 + noise * (base_random_unit(&random) + base_random_unit(&random) - 1));
        p.total += p.value[i];
    }
    return p;
}

static sim_sample *make_sample(const population *p, size_t units, uint64_t seed)
{
    sim_sample *s = NULL;
    assert_int_equal(sim_sample_create(p->size, units, seed, &s, NULL), BASE_OK);
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
            low[h] = fmin(low[h], p.size[drawn[h]]);
            high[h] = fmax(high[h], p.size[drawn[h]]);
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

static void estimate__values_of_both_quantities__exact_and_both_are_told(void **state)
{
    (void)state;
    population p = make_population_of_two(5, 0);
    sim_sample *s = make_sample(&p, UNITS, 5);
    sim_sample_set_second(s, p.second);
    draw_round(s, &p), draw_round(s, &p);
    sim_estimate e = sim_sample_estimate(s);
    assert_true(fabs(e.total / p.total - 1) < 1e-9);
    assert_true(e.half_width_95 < 1e-6 * p.total);
    assert_true(fabs(e.per_size - 0.9) < 1e-6 && fabs(e.per_second - 15) < 1e-6);
    sim_sample_destroy(&s);
}

/* A second quantity that follows the first one adds nothing, and must not break the fit; nor must one that is 0 everywhere. */
static void estimate__second_says_nothing_new__that_of_the_size(void **state)
{
    (void)state;
    population p = make_population(6, 0.2, 0);
    for (int nothing = 0; nothing < 2; nothing++) {
        sim_sample *s = make_sample(&p, UNITS, 5), *plain = make_sample(&p, UNITS, 5);
        for (int i = 0; i < UNITS; i++)
            p.second[i] = nothing ? 0 : 3 * p.size[i];
        sim_sample_set_second(s, p.second);
        for (int round = 0; round < 4; round++)
            draw_round(s, &p), draw_round(plain, &p);
        sim_estimate a = sim_sample_estimate(s), b = sim_sample_estimate(plain);
        assert_true(a.total == b.total && a.half_width_95 == b.half_width_95 && a.per_second == 0);
        sim_sample_destroy(&s), sim_sample_destroy(&plain);
    }
}

static void estimate__sizes_all_zero__no_division(void **state)
{
    (void)state;
    population p = {.total = 0};
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

/* With the second quantity known the interval is a fraction of what it is without. Of 12 units, small ones with as much of z as large
 * ones, it holds the total a little less often than promised: known, and bounded here. */
static void interval__second_quantity__narrow_and_holds_the_total(void **state)
{
    (void)state;
    population p = make_population_of_two(7, 0.05);
    int holds = 0;
    double with = 0, without = 0, bias = 0;
    for (uint64_t seed = 0; seed < 2000; seed++) {
        sim_sample *s = make_sample(&p, UNITS, seed * 7919);
        for (int round = 0; round < 3; round++)
            draw_round(s, &p);
        without += sim_sample_estimate(s).half_width_95 / p.total / 2000;
        sim_sample_set_second(s, p.second);
        sim_estimate e = sim_sample_estimate(s);
        with += e.half_width_95 / p.total / 2000;
        bias += (e.total / p.total - 1) / 2000;
        holds += fabs(e.total - p.total) <= e.half_width_95;
        sim_sample_destroy(&s);
    }
    print_message("# second quantity: %.2f%% of the intervals hold the total, half-width %.2f%%, without it %.2f%%, bias %.3f%%\n",
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
        cmocka_unit_test(estimate__values_of_both_quantities__exact_and_both_are_told),
        cmocka_unit_test(estimate__second_says_nothing_new__that_of_the_size),
        cmocka_unit_test(estimate__sizes_all_zero__no_division),
        cmocka_unit_test(interval__many_samples__holds_the_total),
        cmocka_unit_test(interval__second_quantity__narrow_and_holds_the_total),
        cmocka_unit_test(student__few_and_many_degrees__as_tabulated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
