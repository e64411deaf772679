#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "tests/oracles/hit_judge.h"

/* Seen from (x, y, 2) straight down: triangle 0 at t = 2, triangle 1 over it at t = 1, 2 the same seen from behind,
   3 coplanar with 1, 4 beside all of them, 5 behind the rays. */
static const scene_triangle TRIANGLES[] = {
    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},  {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}, {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}},
    {{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}},  {{{5, 0, 1}, {6, 0, 1}, {5, 1, 1}}}, {{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}}},
};
enum { TRIANGLE_COUNT = sizeof TRIANGLES / sizeof *TRIANGLES };

static const oracle_ray INSIDE = {{0.25f, 0.25f, 2}, {0, 0, -1}, 0, INFINITY};
static const oracle_hit NONE = {ORACLE_NO_HIT, (double)INFINITY, 0, 0};

static judge_verdict judge_with(judge_options options, oracle_ray ray, oracle_hit ours, oracle_hit embree)
{
    return hit_judge_ray(&options, TRIANGLES, TRIANGLE_COUNT, &ray, &ours, &embree);
}

static judge_verdict judge(oracle_ray ray, oracle_hit ours, oracle_hit embree)
{
    return judge_with(judge_options_default(), ray, ours, embree);
}

static oracle_hit at(uint32_t id, double t)
{
    return (oracle_hit){.id = id, .t = t};
}

static void judge__same_id__agree(void **state)
{
    (void)state;
    assert_int_equal(judge(INSIDE, at(1, 1.0), at(1, 1.0)), JUDGE_AGREE);
    assert_int_equal(judge(INSIDE, NONE, NONE), JUDGE_AGREE);
    assert_int_equal(judge(INSIDE, at(1, 1.0), at(1, 1.01)), JUDGE_AGREE); /* Embree's t is off, ours exact */
}

static void judge__same_id_wrong_t__ours_wrong(void **state)
{
    (void)state;
    assert_int_equal(judge(INSIDE, at(1, 1.01), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(1, (double)NAN), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(1, (double)INFINITY), at(1, 1.0)), JUDGE_OURS_WRONG);
}

static void judge__same_t_other_triangle__tie_if_it_is_hit(void **state)
{
    judge_options cull = judge_options_default();
    (void)state;
    cull.cull_backface = 1;
    assert_int_equal(judge(INSIDE, at(3, 1.0), at(1, 1.0)), JUDGE_TIE);
    assert_int_equal(judge(INSIDE, at(2, 1.0), at(1, 1.0)), JUDGE_TIE);
    assert_int_equal(judge_with(cull, INSIDE, at(2, 1.0), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(4, 1.0), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(0, 1.0), at(1, 1.0)), JUDGE_OURS_WRONG); /* t is not that of triangle 0 */
}

static void judge__exact_says_ours__embree_wrong(void **state)
{
    judge_options cull = judge_options_default();
    (void)state;
    cull.cull_backface = 1;
    assert_int_equal(judge(INSIDE, at(1, 1.0), at(0, 2.0)), JUDGE_EMBREE_WRONG);
    assert_int_equal(judge(INSIDE, at(1, 1.0), NONE), JUDGE_EMBREE_WRONG);
    assert_int_equal(judge(INSIDE, NONE, at(4, 1.0)), JUDGE_EMBREE_WRONG);
    assert_int_equal(judge(INSIDE, at(1, 1.0), at(4, 0.5)), JUDGE_EMBREE_WRONG);
    assert_int_equal(judge_with(cull, INSIDE, at(0, 2.0), at(2, 1.0)), JUDGE_EMBREE_WRONG);
}

static void judge__exact_says_embree__ours_wrong(void **state)
{
    judge_options cull = judge_options_default();
    (void)state;
    cull.cull_backface = 1;
    assert_int_equal(judge(INSIDE, at(0, 2.0), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, NONE, at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(4, 0.5), at(1, 1.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(5, 0.5), NONE), JUDGE_OURS_WRONG); /* behind the ray */
    assert_int_equal(judge_with(cull, INSIDE, at(2, 1.0), at(0, 2.0)), JUDGE_OURS_WRONG);
    assert_int_equal(judge(INSIDE, at(TRIANGLE_COUNT, 1.0), at(1, 1.0)), JUDGE_OURS_WRONG);
}

/* Beside the edge x = 0 of triangle 0 at distance x from height 2: a unit of the margin is 2^-22 there. */
static void judge__at_an_edge__excused_within_four_ulp(void **state)
{
    static const scene_triangle one[] = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    const judge_options options = judge_options_default();
    static const struct {
        float x;
        int near;
    } cases[] = {{0x1p-22f, 1}, {3 * 0x1p-22f, 1}, {5 * 0x1p-22f, 0}, {0.125f, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const judge_verdict excused = cases[i].near ? JUDGE_NEAR_EDGE : JUDGE_OURS_WRONG;
        const oracle_ray inside = {{cases[i].x, 0.25f, 2}, {0, 0, -1}, 0, INFINITY};
        const oracle_ray outside = {{-cases[i].x, 0.25f, 2}, {0, 0, -1}, 0, INFINITY};
        const oracle_hit hit = at(0, 2.0);
        assert_int_equal(hit_judge_ray(&options, one, 1, &inside, &NONE, &hit), excused);
        assert_int_equal(hit_judge_ray(&options, one, 1, &outside, &hit, &NONE), excused);
        assert_int_equal(hit_judge_ray(&options, one, 1, &inside, &hit, &NONE), JUDGE_EMBREE_WRONG);
        assert_int_equal(hit_judge_ray(&options, one, 1, &outside, &NONE, &hit), JUDGE_EMBREE_WRONG);
    }
}

/* On the line of the edge x = 0, but far beyond its end: no excuse. */
static void judge__near_the_line_beyond_the_edge__ours_wrong(void **state)
{
    const oracle_ray ray = {{0, 3, 2}, {0, 0, -1}, 0, INFINITY};
    (void)state;
    assert_int_equal(judge(ray, at(0, 2.0), NONE), JUDGE_OURS_WRONG);
}

static void judge__end_of_range__tie(void **state)
{
    const oracle_ray ends = {{0.25f, 0.25f, 2}, {0, 0, -1}, 0, 1}, before = {{0.25f, 0.25f, 2}, {0, 0, -1}, 0, 0.5f};
    const oracle_ray starts = {{0.25f, 0.25f, 2}, {0, 0, -1}, 1, INFINITY};
    (void)state;
    assert_int_equal(judge(ends, at(1, 1.0), NONE), JUDGE_TIE);
    assert_int_equal(judge(starts, at(1, 1.0), at(0, 2.0)), JUDGE_TIE);
    assert_int_equal(judge(before, at(1, 1.0), NONE), JUDGE_OURS_WRONG);
}

/* t at grazing incidence: a float test's rounding is amplified, and the judge allows that and no more. */
static void judge__grazing_t__allowed_by_conditioning(void **state)
{
    const oracle_ray grazing = {{-1.5f, 0.25f, 0x1p-12f}, {1, 0, -0x1p-13f}, 0, INFINITY};
    (void)state;
    assert_int_equal(judge(grazing, at(0, 2.0), at(0, 2.001)), JUDGE_AGREE);
    assert_int_equal(judge(grazing, at(0, 2.002), at(0, 2.0)), JUDGE_AGREE);
    assert_int_equal(judge(grazing, at(0, 2.2), at(0, 2.0)), JUDGE_OURS_WRONG);
}

static void judge_rays__mixed__counts_and_first_wrong(void **state)
{
    enum { RAYS = 20000 };
    static const struct {
        oracle_hit ours, embree;
        judge_verdict verdict;
    } kinds[] = {{{1, 1, 0, 0}, {1, 1, 0, 0}, JUDGE_AGREE},
                 {{3, 1, 0, 0}, {1, 1, 0, 0}, JUDGE_TIE},
                 {{1, 1, 0, 0}, {0, 2, 0, 0}, JUDGE_EMBREE_WRONG},
                 {{0, 2, 0, 0}, {1, 1, 0, 0}, JUDGE_OURS_WRONG}};
    const judge_options options = judge_options_default();
    oracle_ray *rays = calloc(RAYS, sizeof *rays);
    oracle_hit *ours = calloc(RAYS, sizeof *ours), *embree = calloc(RAYS, sizeof *embree);
    judge_verdict *verdicts = calloc(RAYS, sizeof *verdicts);
    (void)state;
    assert_true(rays && ours && embree && verdicts);
    for (int i = 0; i < RAYS; i++) {
        int kind = i % 1000 == 777 && i > 5000 ? 3 : i % 3;
        rays[i] = INSIDE;
        ours[i] = kinds[kind].ours;
        embree[i] = kinds[kind].embree;
    }
    for (unsigned jobs = 1; jobs <= 2; jobs++) {
        judge_summary s = hit_judge_rays(&options, TRIANGLES, TRIANGLE_COUNT, rays, ours, embree, RAYS, jobs, verdicts);
        assert_int_equal(s.count[JUDGE_OURS_WRONG], 15);
        assert_int_equal(s.first_wrong, 5777);
        assert_int_equal(s.count[JUDGE_AGREE] + s.count[JUDGE_TIE] + s.count[JUDGE_EMBREE_WRONG], RAYS - 15);
        assert_int_equal(s.count[JUDGE_NEAR_EDGE], 0);
        for (int i = 0; i < 3; i++)
            assert_int_equal(verdicts[i], kinds[i].verdict);
        assert_int_equal(verdicts[5777], JUDGE_OURS_WRONG);
    }
    judge_summary none = hit_judge_rays(&options, TRIANGLES, TRIANGLE_COUNT, rays, ours, embree, 0, 2, NULL);
    assert_true(none.first_wrong == SIZE_MAX);
    free(rays);
    free(ours);
    free(embree);
    free(verdicts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(judge__same_id__agree),
        cmocka_unit_test(judge__same_id_wrong_t__ours_wrong),
        cmocka_unit_test(judge__same_t_other_triangle__tie_if_it_is_hit),
        cmocka_unit_test(judge__exact_says_ours__embree_wrong),
        cmocka_unit_test(judge__exact_says_embree__ours_wrong),
        cmocka_unit_test(judge__at_an_edge__excused_within_four_ulp),
        cmocka_unit_test(judge__near_the_line_beyond_the_edge__ours_wrong),
        cmocka_unit_test(judge__end_of_range__tie),
        cmocka_unit_test(judge__grazing_t__allowed_by_conditioning),
        cmocka_unit_test(judge_rays__mixed__counts_and_first_wrong),
    };
    return cmocka_run_group_tests_name("oracles/hit_judge", tests, NULL, NULL);
}
