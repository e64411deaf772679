#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "tests/oracles/embree_oracle.h"

static const scene_triangle STACK[] = {
    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},    /* front towards +z */
    {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}},    /* front towards -z */
    {{{0, 0, 1.5f}, {1, 0, 1.5f}, {0.5f, 0, 1.5f}}}, /* no area */
};

static oracle_hit cast(oracle_ray ray, int cull_backface)
{
    embree_oracle *oracle;
    base_error err;
    oracle_hit hit;
    if (embree_oracle_create(STACK, sizeof STACK / sizeof *STACK, cull_backface, 1, &oracle, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    assert_int_equal(embree_oracle_closest(oracle, &ray, 1, &hit, &err), BASE_OK);
    embree_oracle_destroy(&oracle);
    assert_null(oracle);
    return hit;
}

static void closest__two_planes__nearest_id_t_u_v(void **state)
{
    (void)state;
    oracle_hit hit = cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -2}, 0, INFINITY}, 0);
    assert_int_equal(hit.id, 1);
    /* Embree divides by a reciprocal, which it refines from what its host estimates. */
    assert_true(fabs(hit.t - 0.5) < 1e-6 && fabs(hit.u - 0.5) < 1e-6 && fabs(hit.v - 0.25) < 1e-6);
}

static void closest__culling__the_front_behind(void **state)
{
    (void)state;
    assert_int_equal(cast((oracle_ray){{0.25f, 0.5f, 2}, {0, 0, -2}, 0, INFINITY}, 1).id, 0);
    assert_int_equal(cast((oracle_ray){{0.25f, 0.5f, -1}, {0, 0, 1}, 0, INFINITY}, 1).id, 1);
    assert_int_equal(cast((oracle_ray){{0.25f, 0.5f, 0.5f}, {0, 0, -1}, 0, INFINITY}, 1).id, 0);
}

static void closest__nothing_there__no_hit(void **state)
{
    (void)state;
    oracle_hit hit = cast((oracle_ray){{0.75f, 0.75f, 2}, {0, 0, -1}, 0, INFINITY}, 0);
    assert_int_equal(hit.id, ORACLE_NO_HIT);
    assert_true(isinf(hit.t));
    assert_int_equal(cast((oracle_ray){{0.25f, 0.25f, 2}, {0, 0, -1}, 0, 0.5f}, 0).id, ORACLE_NO_HIT);
    assert_int_equal(cast((oracle_ray){{0.25f, 0.25f, 2}, {0, 0, -1}, 1.5f, INFINITY}, 0).id, 0);
    assert_int_equal(cast((oracle_ray){{0.25f, 0.25f, 2}, {0, 0, -1}, 0, INFINITY}, 0).id, 1);
}

/* What closest finds in a range, or does not, is what occludes it. */
static void occluded__two_planes__as_closest(void **state)
{
    static const oracle_ray rays[] = {
        {{0.25f, 0.5f, 2}, {0, 0, -2}, 0, INFINITY}, {{0.25f, 0.5f, 2}, {0, 0, -2}, 0, 0.5f},  {{0.25f, 0.5f, 2}, {0, 0, -2}, 0.5f, 1},
        {{0.25f, 0.5f, 2}, {0, 0, -2}, 0, 0.75f},    {{0.25f, 0.5f, 2}, {0, 0, -2}, 0.75f, 2}, {{0.75f, 0.75f, 2}, {0, 0, -1}, 0, 9},
        {{0.25f, 0.5f, -1}, {0, 0, 1}, 0, 1.5f},     {{0.25f, 0.5f, -1}, {0, 0, 1}, 0, 9},     {{0.25f, 0.5f, 0.5f}, {0, 0, 1}, 0, 9}};
    enum { RAYS = sizeof rays / sizeof *rays };
    (void)state;
    for (int cull = 0; cull < 2; cull++) {
        embree_oracle *oracle;
        oracle_hit hits[RAYS];
        unsigned char occluded[RAYS];
        int some = 0;
        assert_int_equal(embree_oracle_create(STACK, sizeof STACK / sizeof *STACK, cull, 1, &oracle, NULL), BASE_OK);
        assert_int_equal(embree_oracle_closest(oracle, rays, RAYS, hits, NULL), BASE_OK);
        assert_int_equal(embree_oracle_occluded(oracle, rays, RAYS, occluded, NULL), BASE_OK);
        for (int i = 0; i < RAYS; i++) {
            assert_int_equal(occluded[i], hits[i].id != ORACLE_NO_HIT);
            some += occluded[i];
        }
        assert_in_range(some, 1, RAYS - 1);
        embree_oracle_destroy(&oracle);
    }
}

static void create__no_triangles__no_hits(void **state)
{
    embree_oracle *oracle;
    base_error err;
    oracle_hit hit = {.id = 3};
    const oracle_ray ray = {{0, 0, 0}, {0, 0, 1}, 0, INFINITY};
    (void)state;
    assert_int_equal(embree_oracle_create(NULL, 0, 1, 2, &oracle, &err), BASE_OK);
    assert_int_equal(embree_oracle_closest(oracle, &ray, 1, &hit, &err), BASE_OK);
    assert_int_equal(hit.id, ORACLE_NO_HIT);
    embree_oracle_destroy(&oracle);
    embree_oracle_destroy(&oracle);
}

static void create__too_many_triangles__usage_error(void **state)
{
    embree_oracle *oracle;
    base_error err = {0};
    (void)state;
    assert_int_equal(embree_oracle_create(STACK, SCENE_MAX_TRIANGLES + 1, 0, 1, &oracle, &err), BASE_ERR_USAGE);
    assert_null(oracle);
    assert_string_equal(err.what, "triangles");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest__two_planes__nearest_id_t_u_v),
        cmocka_unit_test(closest__culling__the_front_behind),
        cmocka_unit_test(closest__nothing_there__no_hit),
        cmocka_unit_test(occluded__two_planes__as_closest),
        cmocka_unit_test(create__no_triangles__no_hits),
        cmocka_unit_test(create__too_many_triangles__usage_error),
    };
    return cmocka_run_group_tests_name("oracles/embree_oracle", tests, NULL, NULL);
}
