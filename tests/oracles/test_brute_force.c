#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/oracles/brute_force.h"
#include "exact/predicates.h"
#include "tests/oracles/soup.h"

/* Planes z = 0 (front towards +z), z = 1 twice, the second time with opposite winding, and one without area. */
static const scene_triangle STACK[] = {
    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
    {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}},
    {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
    {{{0, 0, 1.5f}, {1, 0, 1.5f}, {0.5f, 0, 1.5f}}},
};

static oracle_hit cast(oracle_ray ray, int cull_backface)
{
    oracle_hit hit;
    brute_force_closest(STACK, sizeof STACK / sizeof *STACK, &ray, 1, cull_backface, 1, &hit);
    return hit;
}

static void assert_hit(oracle_hit hit, uint32_t id, double t)
{
    assert_int_equal(hit.id, id);
    assert_true(hit.t == t);
}

static void closest__equal_t__smaller_id(void **state)
{
    (void)state;
    oracle_hit hit = cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -2}, 0, INFINITY}, 0);
    assert_hit(hit, 1, 0.5);
    assert_true(hit.u == 0.5 && hit.v == 0.25);
}

static void closest__culling__first_front(void **state)
{
    (void)state;
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -2}, 0, INFINITY}, 1), 2, 0.5);
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, -1}, {0, 0, 1}, 0, INFINITY}, 1), 1, 2.0);
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, -1}, {0, 0, 1}, 0, INFINITY}, 0), 0, 1.0);
}

static void closest__range__open_at_both_ends(void **state)
{
    (void)state;
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -1}, 1, INFINITY}, 0), 0, 2.0);
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -1}, 1, 2}, 0), ORACLE_NO_HIT, (double)INFINITY);
    assert_hit(cast((oracle_ray){{0.25f, 0.5f, 0}, {0, 0, -1}, 0, INFINITY}, 0), ORACLE_NO_HIT, (double)INFINITY);
}

static void closest__border_beside_and_nan__closed_triangles(void **state)
{
    (void)state;
    assert_hit(cast((oracle_ray){{0, 0, 2}, {0, 0, -1}, 0, INFINITY}, 0), 1, 1.0);
    assert_hit(cast((oracle_ray){{0.5f, 0.5f, 2}, {0, 0, -1}, 0, INFINITY}, 0), 1, 1.0);
    assert_hit(cast((oracle_ray){{0.75f, 0.5f, 2}, {0, 0, -1}, 0, INFINITY}, 0), ORACLE_NO_HIT, (double)INFINITY);
    assert_hit(cast((oracle_ray){{0.25f, 0.25f, 2}, {0, NAN, -1}, 0, INFINITY}, 0), ORACLE_NO_HIT, (double)INFINITY);
    assert_hit(cast((oracle_ray){{0.25f, 0.25f, 2}, {0, 0, 0}, 0, INFINITY}, 0), ORACLE_NO_HIT, (double)INFINITY);
}

static void closest__no_triangles_or_rays__nothing(void **state)
{
    oracle_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, INFINITY};
    oracle_hit hit = {.id = 7};
    (void)state;
    brute_force_closest(STACK, 1, &ray, 0, 0, 2, &hit);
    assert_int_equal(hit.id, 7);
    brute_force_closest(STACK, 0, &ray, 1, 0, 2, &hit);
    assert_int_equal(hit.id, ORACLE_NO_HIT);
}

enum { TRIANGLES = 200, RAYS = 1000 };

typedef struct soup {
    scene_triangle triangles[TRIANGLES];
    oracle_ray rays[RAYS];
    oracle_hit hits[RAYS], again[RAYS];
} soup;

static int create_soup(void **state)
{
    base_random random = {7};
    soup *s = calloc(1, sizeof *s);
    if (!s)
        return -1;
    soup_triangles(&random, 0.5, s->triangles, TRIANGLES);
    soup_rays(&random, s->rays, RAYS);
    *state = s;
    return 0;
}

static int destroy_soup(void **state)
{
    free(*state);
    return 0;
}

/* Exact closest hit over all triangles; ids of hits must agree as no ray of this soup comes within 2^-50 of an edge. */
static uint32_t exact_closest(const soup *s, const oracle_ray *ray, int cull_backface, double *t)
{
    exact_hit hit, best;
    uint32_t id = ORACLE_NO_HIT;
    exact_hit_init(&hit);
    exact_hit_init(&best);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const scene_triangle *x = &s->triangles[i];
        if (exact_ray_triangle(ray->org, ray->dir, x->v[0], x->v[1], x->v[2], &hit) &&
            (!cull_backface || hit.facing > 0) && (id == ORACLE_NO_HIT || exact_hit_compare_t(&hit, &best) < 0)) {
            id = i;
            exact_ray_triangle(ray->org, ray->dir, x->v[0], x->v[1], x->v[2], &best);
        }
    }
    *t = best.t_double;
    exact_hit_clear(&hit);
    exact_hit_clear(&best);
    return id;
}

static void closest__random_soup__as_exact(void **state)
{
    soup *s = *state;
    for (int cull = 0; cull < 2; cull++) {
        unsigned hits = 0;
        brute_force_closest(s->triangles, TRIANGLES, s->rays, RAYS, cull, 2, s->hits);
        for (int i = 0; i < RAYS; i++) {
            double t;
            assert_int_equal(s->hits[i].id, exact_closest(s, &s->rays[i], cull, &t));
            if (s->hits[i].id != ORACLE_NO_HIT) {
                assert_true(fabs(s->hits[i].t - t) <= 1e-12 * t);
                hits++;
            }
        }
        assert_in_range(hits, RAYS / 4, RAYS - 1);
    }
}

static void closest__any_jobs__same_bytes(void **state)
{
    soup *s = *state;
    brute_force_closest(s->triangles, TRIANGLES, s->rays, RAYS, 0, 1, s->hits);
    brute_force_closest(s->triangles, TRIANGLES, s->rays, RAYS, 0, 3, s->again);
    for (int i = 0; i < RAYS; i++) {
        assert_int_equal(s->hits[i].id, s->again[i].id);
        assert_memory_equal(&s->hits[i].t, &s->again[i].t, 3 * sizeof(double));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest__equal_t__smaller_id),
        cmocka_unit_test(closest__culling__first_front),
        cmocka_unit_test(closest__range__open_at_both_ends),
        cmocka_unit_test(closest__border_beside_and_nan__closed_triangles),
        cmocka_unit_test(closest__no_triangles_or_rays__nothing),
        cmocka_unit_test_setup_teardown(closest__random_soup__as_exact, create_soup, destroy_soup),
        cmocka_unit_test_setup_teardown(closest__any_jobs__same_bytes, create_soup, destroy_soup),
    };
    return cmocka_run_group_tests_name("oracles/brute_force", tests, NULL, NULL);
}
