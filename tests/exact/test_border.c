/* The distance of rays from the borders of triangles, as angles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "exact/predicates.h"
#include "tests/oracles/soup.h"

static const float origin[3] = {0, 0, 0};

/* The triangle in the plane z = 1 that lies right of x = 0, above y = 0 and below x + y = 1. */
static double border_of(float x, float y)
{
    const float dir[3] = {x, y, 1}, v0[3] = {0, 0, 1}, v1[3] = {1, 0, 1}, v2[3] = {0, 1, 1};
    return exact_border_ulp(origin, dir, v0, v1, v2) * 0x1p-23;
}

static void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= 1e-12))
        fail_msg("%.17g is not %.17g", a, b);
}

static void border__on_edges_and_vertices__zero(void **state)
{
    (void)state;
    assert_true(border_of(0, 0) == 0 && border_of(1, 0) == 0 && border_of(0, 1) == 0);
    assert_true(border_of(0.5f, 0.5f) == 0 && border_of(0.25f, 0) == 0 && border_of(0, 0.75f) == 0);
}

static void border__inside_and_outside__angle_to_the_nearest_edge(void **state)
{
    (void)state;
    assert_near(border_of(0.25f, 0.125f), 0.125 / sqrt(1 + 0.0625 + 0.015625));
    assert_near(border_of(0.25f, -0.125f), 0.125 / sqrt(1 + 0.0625 + 0.015625));
}

/* On the line of an edge, but beyond its end: the edge's plane is 0 away, the edge is not. */
static void border__beyond_the_end_of_an_edge__angle_to_the_vertex(void **state)
{
    (void)state;
    assert_near(border_of(-0.5f, 0), 0.5 / sqrt(1.25));
    assert_near(border_of(3, 0), 2 / (sqrt(10) * sqrt(2)));
    assert_near(border_of(-0.5f, -0.5f), sqrt(0.5) / sqrt(1.5));
}

static void border__away_from_the_triangle__largest(void **state)
{
    const float away[3] = {0, 0, -1}, none[3] = {0, 0, 0}, v0[3] = {0, 0, 1}, v1[3] = {1, 0, 1}, v2[3] = {0, 1, 1};
    (void)state;
    assert_true(exact_border_ulp(origin, away, v0, v1, v2) == 0x1p23);
    assert_true(exact_border_ulp(origin, none, v0, v1, v2) == 0x1p23);
}

/* Inside a triangle the border is where the nearest edge's plane is. */
static void border__rays_that_hit__least_of_the_margins(void **state)
{
    base_random r = {1};
    unsigned hits = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 20000; i++) {
        float v[3][3], dir[3];
        double margin[3];
        for (int k = 0; k < 3; k++)
            soup_point(&r, 1, v[k]);
        soup_point(&r, 1, dir);
        if (!exact_ray_triangle(origin, dir, v[0], v[1], v[2], &hit))
            continue;
        exact_edge_margins_ulp(origin, dir, v[0], v[1], v[2], margin);
        hits++;
        double least = (double)INFINITY, border = exact_border_ulp(origin, dir, v[0], v[1], v[2]);
        for (int k = 0; k < 3; k++) { /* the margins' unit grows where a vertex is near and another coordinate large */
            double a = 0, b = 0, most = 0;
            for (int j = 0; j < 3; j++) {
                a += (double)v[k][j] * (double)v[k][j];
                b += (double)v[(k + 1) % 3][j] * (double)v[(k + 1) % 3][j];
                most = fmax(most, fmax(fabs((double)v[k][j]), fabs((double)v[(k + 1) % 3][j])));
            }
            least = fmin(least, margin[k] * fmax(1, most / sqrt(fmin(a, b))));
        }
        if (!(border >= least * (1 - 1e-9)))
            fail_msg("border %g, least margin %g", border, least);
        if (least < 0x1p20 && !(border <= least * (1 + 1e-9))) /* beyond, a vertex behind may be the nearest */
            fail_msg("border %g, least margin %g", border, least);
    }
    exact_hit_clear(&hit);
    assert_true(hits > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(border__on_edges_and_vertices__zero),
        cmocka_unit_test(border__inside_and_outside__angle_to_the_nearest_edge),
        cmocka_unit_test(border__beyond_the_end_of_an_edge__angle_to_the_vertex),
        cmocka_unit_test(border__away_from_the_triangle__largest),
        cmocka_unit_test(border__rays_that_hit__least_of_the_margins),
    };
    return cmocka_run_group_tests_name("exact border", tests, NULL, NULL);
}
