/* Kernels on trial: what is found true of rays, and what is said of answers that are right, excusable, and broken on purpose. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "exact/trial.h"
#include "exact/predicates.h"
#include "tests/oracles/soup.h"

/* Seen from 0: a large triangle at z = 2, a copy of it, a larger one at z = 4, one off to the side, one without area. */
enum { FRONT, COPY, BEHIND, ASIDE, FLAT, TRIANGLES };
static const scene_triangle scene_of[TRIANGLES] = {
    {{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}},
    {{{-1, -1, 2}, {0, 1, 2}, {1, -1, 2}}},
    {{{-4, -4, 4}, {4, -4, 4}, {0, 4, 4}}},
    {{{5, 5, 2}, {6, 5, 2}, {5, 6, 2}}},
    {{{0, 0, 1}, {0, 0, 1}, {1, 1, 1}}},
};

typedef struct bench {
    trial_view *view;
    trial_ray *ray;
} bench;

static bench bench_create(const scene_triangle *triangles, size_t count, const float origin[3], bool cull)
{
    bench b = {0};
    base_error err = {0};
    assert_int_equal(trial_view_create(triangles, count, origin, cull, &b.view, &err), BASE_OK);
    assert_int_equal(trial_ray_create(&b.ray, &err), BASE_OK);
    return b;
}

static void bench_destroy(bench *b)
{
    trial_view_destroy(&b->view);
    trial_ray_destroy(&b->ray);
}

static void look(bench *b, float x, float y, float z)
{
    const float direction[3] = {x, y, z};
    base_error err = {0};
    assert_int_equal(trial_ray_find(b->ray, b->view, direction, &err), BASE_OK);
}

static trial_finding say(const bench *b, uint32_t id, float t)
{
    return trial_ray_answer(b->ray, &(trial_answer){.id = id, .t = t, .u = 0.25f, .v = 0.5f});
}

static const float zero[3] = {0, 0, 0};

static void answer__nearest__right_without_error(void **state)
{
    bench b = bench_create(scene_of, TRIANGLES, zero, false);
    (void)state;
    look(&b, 0, 0, 1);
    assert_int_equal(trial_ray_nearest(b.ray), FRONT);
    assert_true(trial_ray_distance(b.ray) == 2);
    assert_false(trial_ray_at_edge(b.ray));
    trial_finding f = say(&b, FRONT, 2);
    assert_int_equal(f.verdict, TRIAL_RIGHT);
    assert_true(f.t_ulp == 0 && f.plane_ulp == 0 && f.point_ulp == 0 && !f.leak);
    f = say(&b, FRONT, nextafterf(2, 3));
    assert_int_equal(f.verdict, TRIAL_RIGHT);
    assert_true(f.t_ulp == 1);
    bench_destroy(&b);
}

static void answer__nothing_or_what_is_behind__lost(void **state)
{
    bench b = bench_create(scene_of, TRIANGLES, zero, false);
    (void)state;
    look(&b, 0, 0, 1);
    trial_finding f = say(&b, TRIAL_NO_HIT, INFINITY);
    assert_int_equal(f.verdict, TRIAL_LOST);
    assert_true(f.leak);
    assert_int_equal(say(&b, BEHIND, 4).verdict, TRIAL_LOST);
    bench_destroy(&b);
}

static void answer__missed_triangle_bad_distance_or_order__wrong(void **state)
{
    bench b = bench_create(scene_of, TRIANGLES, zero, false);
    (void)state;
    look(&b, 0, 0, 1);
    assert_int_equal(say(&b, ASIDE, 2).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, FLAT, 1).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, TRIANGLES, 2).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, FRONT, 2.001f).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, FRONT, -2).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, FRONT, NAN).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, COPY, 2).verdict, TRIAL_WRONG); /* of two equals the first counts */
    look(&b, 0, 0, -1);
    assert_int_equal(trial_ray_nearest(b.ray), TRIAL_NO_HIT);
    assert_int_equal(say(&b, FRONT, 2).verdict, TRIAL_WRONG);
    assert_int_equal(say(&b, TRIAL_NO_HIT, INFINITY).verdict, TRIAL_RIGHT);
    bench_destroy(&b);
}

static void answer__ray_within_rounding_of_a_border__edge_and_no_more(void **state)
{
    bench b = bench_create(scene_of, 1, zero, false);
    const float off[] = {0, 2 * 0x1p-23f, -2 * 0x1p-23f, 6 * 0x1p-23f, -6 * 0x1p-23f};
    (void)state;
    for (int i = 0; i < 5; i++) {
        look(&b, 0, -0.5f + off[i], 1); /* the edge at y = -1, seen at 1.25 times the distance */
        const bool inside = off[i] >= 0, near_edge = i < 3;
        trial_finding hit = say(&b, FRONT, 2), none = say(&b, TRIAL_NO_HIT, INFINITY);
        assert_int_equal(trial_ray_at_edge(b.ray), near_edge);
        assert_int_equal(hit.verdict, inside ? TRIAL_RIGHT : near_edge ? TRIAL_EDGE : TRIAL_WRONG);
        assert_int_equal(none.verdict, !inside ? TRIAL_RIGHT : near_edge ? TRIAL_EDGE : TRIAL_LOST);
        assert_int_equal(none.leak, inside);
    }
    bench_destroy(&b);
}

static void answer__back_face__counts_unless_culled(void **state)
{
    (void)state;
    for (int cull = 0; cull < 2; cull++) {
        bench b = bench_create(&scene_of[FRONT], 1, zero, cull);
        look(&b, 0, 0, 1); /* its normal points along the ray */
        assert_int_equal(say(&b, 0, 2).verdict, cull ? TRIAL_WRONG : TRIAL_RIGHT);
        assert_int_equal(say(&b, TRIAL_NO_HIT, INFINITY).verdict, cull ? TRIAL_RIGHT : TRIAL_LOST);
        bench_destroy(&b);
    }
}

/* Two planes nearer to each other than floats can tell; and two that they can. */
static void answer__planes_close_together__tie_within_rounding_only(void **state)
{
    static const float gaps[] = {0x1p-22f, 0x1p-12f};
    (void)state;
    for (int i = 0; i < 2; i++) {
        scene_triangle two[2] = {scene_of[FRONT], scene_of[FRONT]};
        for (int v = 0; v < 3; v++)
            two[1].v[v][2] += gaps[i];
        bench b = bench_create(two, 2, zero, false);
        look(&b, 0, 0, 1);
        assert_int_equal(trial_ray_nearest(b.ray), 0);
        assert_int_equal(say(&b, 1, two[1].v[0][2]).verdict, i == 0 ? TRIAL_TIE : TRIAL_LOST);
        bench_destroy(&b);
    }
}

/* A camera in the plane of a triangle, or within rounding of it: it may be hit at the very start, or not. */
static void answer__origin_within_rounding_of_the_plane__edge(void **state)
{
    scene_triangle t = {{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}};
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        const float origin[3] = {0, 0, (float)side * 0x1p-30f};
        bench b = bench_create(&t, 1, origin, false);
        look(&b, 0.125f, 0.125f, -1);
        assert_int_equal(trial_ray_nearest(b.ray), side > 0 ? 0 : TRIAL_NO_HIT);
        assert_int_equal(say(&b, TRIAL_NO_HIT, INFINITY).verdict, side > 0 ? TRIAL_EDGE : TRIAL_RIGHT);
        assert_int_equal(say(&b, 0, 0x1p-30f).verdict, side > 0 ? TRIAL_RIGHT : TRIAL_EDGE);
        assert_int_equal(say(&b, 0, 0.5f).verdict, TRIAL_WRONG);
        bench_destroy(&b);
    }
}

/* The filter loses nothing: the nearest triangle is that of trying all exactly, at every size and distance. */
static void find__random_triangles__as_all_tried_exactly(void **state)
{
    enum { COUNT = 40, RAYS = 300 };
    static const float places[][2] = {{1, 0}, {1e-4f, 0}, {1e4f, 1e3f}, {1, 1e6f}, {1e-3f, 1e3f}};
    base_random r = {2};
    exact_hit hit, best;
    unsigned hits = 0;
    (void)state;
    exact_hit_init(&hit);
    exact_hit_init(&best);
    for (size_t place = 0; place < sizeof places / sizeof *places; place++)
        for (int cull = 0; cull < 2; cull++) {
            scene_triangle t[COUNT];
            float origin[3];
            soup_triangles(&r, 0.7, t, COUNT);
            soup_point(&r, 1, origin);
            for (int k = 0; k < 3; k++)
                origin[k] = origin[k] * places[place][0] + places[place][1];
            for (int i = 0; i < 9 * COUNT; i++)
                t[i / 9].v[i / 3 % 3][i % 3] = t[i / 9].v[i / 3 % 3][i % 3] * places[place][0] + places[place][1];
            bench b = bench_create(t, COUNT, origin, cull);
            for (int i = 0; i < RAYS; i++) {
                float d[3];
                uint32_t nearest = TRIAL_NO_HIT;
                soup_point(&r, 1, d);
                for (int k = 0; k < 3 && i % 2; k++) /* at a vertex */
                    d[k] = t[i % COUNT].v[i % 3][k] - origin[k];
                if (d[0] == 0 && d[1] == 0 && d[2] == 0)
                    continue;
                for (uint32_t n = 0; n < COUNT; n++)
                    if (exact_ray_triangle(origin, d, t[n].v[0], t[n].v[1], t[n].v[2], &hit) && (!cull || hit.facing > 0) &&
                        (nearest == TRIAL_NO_HIT || exact_hit_compare_t(&hit, &best) < 0)) {
                        nearest = n;
                        exact_ray_triangle(origin, d, t[n].v[0], t[n].v[1], t[n].v[2], &best);
                    }
                look(&b, d[0], d[1], d[2]);
                assert_int_equal(trial_ray_nearest(b.ray), nearest);
                hits += nearest != TRIAL_NO_HIT;
            }
            bench_destroy(&b);
        }
    exact_hit_clear(&hit);
    exact_hit_clear(&best);
    assert_true(hits > 1000);
}

static void find__vertices_not_finite__never_hit(void **state)
{
    scene_triangle t = scene_of[FRONT];
    t.v[1][0] = INFINITY;
    bench b = bench_create(&t, 1, zero, false);
    (void)state;
    look(&b, 0, 0, 1);
    assert_int_equal(trial_ray_nearest(b.ray), TRIAL_NO_HIT);
    assert_int_equal(say(&b, 0, 2).verdict, TRIAL_WRONG);
    bench_destroy(&b);
}

/* A triangle blocks between 1 and 3 only; at an edge, and where the span ends within rounding, either answer is excusable. */
static void answer_blocked__by_what_is_within_the_span__lost_wrong_or_edge(void **state)
{
    const trial_span span = {1, 3}, before = {1, 1.5f}, ends_at_it = {1, 2}, starts_at_it = {2, 3}, behind = {2.5f, 3};
    bench b = bench_create(scene_of, TRIANGLES, zero, false);
    (void)state;
    look(&b, 0, 0, 1);
    assert_true(trial_ray_blocked(b.ray, span));
    assert_int_equal(trial_ray_answer_blocked(b.ray, span, true).verdict, TRIAL_RIGHT);
    trial_finding f = trial_ray_answer_blocked(b.ray, span, false);
    assert_int_equal(f.verdict, TRIAL_LOST);
    assert_true(f.leak);
    const trial_span outside[] = {before, behind};
    for (int i = 0; i < 2; i++) {
        assert_false(trial_ray_blocked(b.ray, outside[i]));
        assert_int_equal(trial_ray_answer_blocked(b.ray, outside[i], true).verdict, TRIAL_WRONG);
        assert_int_equal(trial_ray_answer_blocked(b.ray, outside[i], false).verdict, TRIAL_RIGHT);
    }
    const trial_span at_end[] = {ends_at_it, starts_at_it};
    for (int i = 0; i < 2; i++) {
        assert_false(trial_ray_blocked(b.ray, at_end[i]));
        assert_int_equal(trial_ray_answer_blocked(b.ray, at_end[i], true).verdict, TRIAL_EDGE);
        assert_int_equal(trial_ray_answer_blocked(b.ray, at_end[i], false).verdict, TRIAL_RIGHT);
    }
    look(&b, 0, -0.5f, 1); /* in the lower edge of the first two */
    assert_int_equal(trial_ray_answer_blocked(b.ray, span, true).verdict, TRIAL_RIGHT);
    f = trial_ray_answer_blocked(b.ray, span, false);
    assert_int_equal(f.verdict, TRIAL_EDGE);
    assert_true(f.leak);
    bench_destroy(&b);
}

/* From behind nothing blocks if only fronts count. */
static void answer_blocked__culled__by_fronts_only(void **state)
{
    const trial_span span = {1, 3};
    (void)state;
    for (int cull = 0; cull < 2; cull++) {
        bench b = bench_create(&scene_of[FRONT], 1, zero, cull), other = bench_create(&scene_of[COPY], 1, zero, cull);
        look(&b, 0, 0, 1);
        look(&other, 0, 0, 1);
        assert_int_equal(trial_ray_blocked(b.ray, span) + trial_ray_blocked(other.ray, span), 2 - cull);
        bench_destroy(&b);
        bench_destroy(&other);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answer__nearest__right_without_error),
        cmocka_unit_test(answer__nothing_or_what_is_behind__lost),
        cmocka_unit_test(answer__missed_triangle_bad_distance_or_order__wrong),
        cmocka_unit_test(answer__ray_within_rounding_of_a_border__edge_and_no_more),
        cmocka_unit_test(answer__back_face__counts_unless_culled),
        cmocka_unit_test(answer__planes_close_together__tie_within_rounding_only),
        cmocka_unit_test(answer__origin_within_rounding_of_the_plane__edge),
        cmocka_unit_test(find__random_triangles__as_all_tried_exactly),
        cmocka_unit_test(find__vertices_not_finite__never_hit),
        cmocka_unit_test(answer_blocked__by_what_is_within_the_span__lost_wrong_or_edge),
        cmocka_unit_test(answer_blocked__culled__by_fronts_only),
    };
    return cmocka_run_group_tests_name("exact trial", tests, NULL, NULL);
}
