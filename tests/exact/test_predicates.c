#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>

#include "exact/predicates.h"
#include "tests/oracles/soup.h"

/* The unit triangle in the plane z = 0, front towards +z, and a ray straight down at (x, y). */
static const float UNIT[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

static int hit_unit(float x, float y, exact_hit *hit)
{
    const float org[3] = {x, y, 2}, dir[3] = {0, 0, -1};
    return exact_ray_triangle(org, dir, UNIT[0], UNIT[1], UNIT[2], hit);
}

static void assert_same(double a, double b)
{
    if (!(a == b))
        fail_msg("%.17g is not %.17g", a, b);
}

static void ray_triangle__inside__t_u_v_and_front(void **state)
{
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_true(hit_unit(0.25f, 0.5f, &hit));
    assert_int_equal(hit.facing, 1);
    assert_same(hit.t_double, 2.0);
    assert_same(hit.u, 0.25);
    assert_same(hit.v, 0.5);
    assert_int_equal(mpq_cmp_ui(hit.t, 2, 1), 0);
    exact_hit_clear(&hit);
}

static void ray_triangle__on_border__hit(void **state)
{
    static const float on[][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5f, 0}, {0, 0.5f}, {0.5f, 0.5f}, {0.75f, 0.25f}};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (size_t i = 0; i < sizeof on / sizeof *on; i++)
        assert_true(hit_unit(on[i][0], on[i][1], &hit));
    exact_hit_clear(&hit);
}

static void ray_triangle__one_ulp_outside__miss(void **state)
{
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_false(hit_unit(-0x1p-149f, 0.5f, &hit));
    assert_false(hit_unit(0.5f, -0x1p-149f, &hit));
    assert_false(hit_unit(nextafterf(0.5f, 1.0f), 0.5f, &hit));
    assert_false(hit_unit(0.5f, nextafterf(0.5f, 1.0f), &hit));
    assert_false(hit_unit(1.0f, 0x1p-149f, &hit));
    assert_int_equal(hit.facing, 1);
    exact_hit_clear(&hit);
}

static void ray_triangle__from_below__back(void **state)
{
    const float org[3] = {0.25f, 0.25f, -3}, dir[3] = {0, 0, 0.5f};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_true(exact_ray_triangle(org, dir, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_int_equal(hit.facing, -1);
    assert_same(hit.t_double, 6.0);
    exact_hit_clear(&hit);
}

static void ray_triangle__behind_or_at_origin__miss(void **state)
{
    const float above[3] = {0.25f, 0.25f, 1}, on[3] = {0.25f, 0.25f, 0}, up[3] = {0, 0, 1};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_false(exact_ray_triangle(above, up, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_same(hit.t_double, -1.0);
    assert_false(exact_ray_triangle(on, up, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_same(hit.t_double, 0.0);
    exact_hit_clear(&hit);
}

static void ray_triangle__in_plane_or_degenerate__parallel(void **state)
{
    const float org[3] = {-1, 0.25f, 0}, along[3] = {1, 0, 0}, down[3] = {0, 0, -1}, zero[3] = {0, 0, 0};
    const float above[3] = {0.5f, 0, 1}, half[3] = {0.5f, 0, 0};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_false(exact_ray_triangle(org, along, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_int_equal(hit.facing, 0);
    assert_false(exact_ray_triangle(above, down, UNIT[0], half, UNIT[1], &hit));
    assert_int_equal(hit.facing, 0);
    assert_false(exact_ray_triangle(above, down, UNIT[0], UNIT[1], UNIT[1], &hit));
    assert_int_equal(hit.facing, 0);
    assert_false(exact_ray_triangle(above, zero, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_int_equal(hit.facing, 0);
    exact_hit_clear(&hit);
}

/* 1/3 is no float: t of plane z = 0 from z = 1 with dz = -3 is a third, rounded to nearest. */
static void ray_triangle__t_of_a_third__rounded_to_nearest(void **state)
{
    const float org[3] = {0.25f, 0.25f, 1}, dir[3] = {0, 0, -3};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_true(exact_ray_triangle(org, dir, UNIT[0], UNIT[1], UNIT[2], &hit));
    assert_int_equal(mpq_cmp_ui(hit.t, 1, 3), 0);
    assert_same(hit.t_double, 1.0 / 3.0);
    assert_int_equal(exact_hit_compare_value(&hit, 1.0 / 3.0), 1);
    assert_int_equal(exact_hit_compare_value(&hit, (double)(1.0f / 3.0f)), -1);
    assert_int_equal(exact_hit_compare_value(&hit, (double)INFINITY), -1);
    assert_int_equal(exact_hit_compare_value(&hit, -(double)INFINITY), 1);
    exact_hit_clear(&hit);
}

static void ray_triangle__extreme_magnitudes__exact(void **state)
{
    const float tiny = 0x1p-149f, huge = 0x1p127f;
    const float v[3][3] = {{-tiny, -tiny, -huge}, {tiny, -tiny, -huge}, {-tiny, 2 * tiny, -huge}};
    const float org[3] = {0, 0, huge}, dir[3] = {0, 0, -tiny};
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    assert_true(exact_ray_triangle(org, dir, v[0], v[1], v[2], &hit));
    assert_same(hit.t_double, 0x1p277);
    assert_same(hit.u, 0.5);
    assert_same(hit.v, 1.0 / 3.0);
    exact_hit_clear(&hit);
}

static void compare_t__equal_and_next__ordered(void **state)
{
    const float org[3] = {0.25f, 0.25f, 1}, dir[3] = {0, 0, -1}, turned[3] = {1, 1, 0};
    float low[3][3];
    exact_hit a, b;
    (void)state;
    exact_hit_init(&a);
    exact_hit_init(&b);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            low[i][k] = k == 2 ? -0x1p-149f : UNIT[i][k];
    exact_ray_triangle(org, dir, UNIT[0], UNIT[1], UNIT[2], &a);
    exact_ray_triangle(org, dir, low[0], low[1], low[2], &b);
    assert_same(a.t_double, b.t_double);
    assert_int_equal(exact_hit_compare_t(&a, &b), -1);
    assert_int_equal(exact_hit_compare_t(&b, &a), 1);
    exact_ray_triangle(org, dir, UNIT[1], turned, UNIT[2], &b);
    assert_int_equal(exact_hit_compare_t(&a, &b), 0);
    exact_hit_clear(&a);
    exact_hit_clear(&b);
}

/* Moeller and Trumbore in long double; the smallest of u, v, 1-u-v, |det| and t, relative, says how sure it is. */
typedef struct approximate_hit {
    int hit, facing;
    long double t, u, v, sureness;
} approximate_hit;

static void cross_long(const long double a[3], const long double b[3], long double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static long double dot_long(const long double a[3], const long double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static approximate_hit approximate(const oracle_ray *ray, const scene_triangle *triangle)
{
    long double e1[3], e2[3], s[3], d[3], p[3], q[3], det, size;
    approximate_hit hit;
    for (int k = 0; k < 3; k++) {
        e1[k] = (long double)triangle->v[1][k] - (long double)triangle->v[0][k];
        e2[k] = (long double)triangle->v[2][k] - (long double)triangle->v[0][k];
        s[k] = (long double)ray->org[k] - (long double)triangle->v[0][k];
        d[k] = (long double)ray->dir[k];
    }
    cross_long(d, e2, p);
    cross_long(s, e1, q);
    det = dot_long(e1, p);
    size = sqrtl(dot_long(d, d) * dot_long(e1, e1) * dot_long(e2, e2));
    hit.facing = det > 0 ? 1 : -1;
    hit.t = dot_long(e2, q) / det;
    hit.u = dot_long(s, p) / det;
    hit.v = dot_long(d, q) / det;
    hit.hit = hit.t > 0 && hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1;
    hit.sureness = fminl(fabsl(hit.u), fminl(fabsl(hit.v), fabsl(1 - hit.u - hit.v)));
    hit.sureness = fminl(hit.sureness, fabsl(hit.t)) * fabsl(det) / size;
    return hit;
}

/* Rays aimed at points near the border of triangles, so that both answers occur. */
static void random_case(base_random *random, oracle_ray *ray, scene_triangle *triangle)
{
    soup_triangles(random, 1.0, triangle, 1);
    soup_point(random, 4.0, ray->org);
    double a = base_random_range(random, -0.5, 1.5), b = base_random_range(random, -0.5, 1.5);
    for (int k = 0; k < 3; k++) {
        double v0 = (double)triangle->v[0][k];
        double point = v0 + a * ((double)triangle->v[1][k] - v0) + b * ((double)triangle->v[2][k] - v0);
        ray->dir[k] = (float)(point - (double)ray->org[k]);
    }
}

static void ray_triangle__random__as_long_double(void **state)
{
    base_random random = {1};
    unsigned hits = 0, misses = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 50000; i++) {
        oracle_ray ray;
        scene_triangle triangle;
        random_case(&random, &ray, &triangle);
        approximate_hit other = approximate(&ray, &triangle);
        if (other.sureness < 1e-12L)
            continue;
        exact_ray_triangle(ray.org, ray.dir, triangle.v[0], triangle.v[1], triangle.v[2], &hit);
        assert_int_equal(hit.hit, other.hit);
        assert_int_equal(hit.facing, other.facing);
        long double tolerance = 1e-16L / other.sureness + 0x1p-52L;
        assert_true(fabsl((long double)hit.t_double - other.t) <= tolerance * (1 + fabsl(other.t)));
        assert_true(fabsl((long double)hit.u - other.u) <= tolerance * (1 + fabsl(other.u)));
        assert_true(fabsl((long double)hit.v - other.v) <= tolerance * (1 + fabsl(other.v)));
        hits += hit.hit != 0;
        misses += hit.hit == 0;
    }
    assert_true(hits > 5000 && misses > 5000);
    exact_hit_clear(&hit);
}

/* Turning the vertices moves nothing, swapping two turns the facing: algebra that holds exactly. */
static void ray_triangle__vertices_permuted__same_hit(void **state)
{
    base_random random = {2};
    exact_hit a, b, c;
    (void)state;
    exact_hit_init(&a);
    exact_hit_init(&b);
    exact_hit_init(&c);
    for (int i = 0; i < 5000; i++) {
        oracle_ray ray;
        scene_triangle s;
        random_case(&random, &ray, &s);
        exact_ray_triangle(ray.org, ray.dir, s.v[0], s.v[1], s.v[2], &a);
        exact_ray_triangle(ray.org, ray.dir, s.v[1], s.v[2], s.v[0], &b);
        exact_ray_triangle(ray.org, ray.dir, s.v[0], s.v[2], s.v[1], &c);
        assert_int_equal(a.hit, b.hit);
        assert_int_equal(a.hit, c.hit);
        assert_int_equal(a.facing, b.facing);
        assert_int_equal(a.facing, -c.facing);
        assert_true(a.facing != 0);
        assert_int_equal(exact_hit_compare_t(&a, &b), 0);
        assert_int_equal(exact_hit_compare_t(&a, &c), 0);
        assert_same(a.u, c.v);
        assert_same(a.v, c.u);
    }
    exact_hit_clear(&a);
    exact_hit_clear(&b);
    exact_hit_clear(&c);
}

/* Seen from height 2 above x = -h, the plane of the edge x = 0 is passed at the angle whose sine is h/sqrt(4+h*h). */
static void edge_margins__beside_an_edge__sine_in_ulp(void **state)
{
    const float dir[3] = {0, 0, -1};
    double margin[3];
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        const float org[3] = {0.125f * (float)sign, 0.25f, 2};
        const double sine = 0.125 * sign / sqrt(4.0 + 0.125 * 0.125);
        exact_edge_margins_ulp(org, dir, UNIT[0], UNIT[1], UNIT[2], margin);
        assert_true(fabs(margin[2] * 0x1p-23 - sine) < 1e-15); /* M = 2 < |a|: the unit is 2^-23 */
        assert_true(fabs(exact_edge_distance_ulp(org, dir, UNIT[0], UNIT[1], UNIT[2]) * 0x1p-23 - fabs(sine)) < 1e-15);
    }
}

static void edge_margins__far_from_world_origin__larger_unit(void **state)
{
    const float far = 1048576.0f, dir[3] = {0, 0, -1};
    const float v[3][3] = {{far, 0, 0}, {far + 1, 0, 0}, {far, 1, 0}}, org[3] = {far + 0.125f, 0.25f, 2};
    const double sine = 0.125 / sqrt(4.0 + 0.125 * 0.125);
    double margin[3], nearer = sqrt(4.0 + 0.125 * 0.125 + 0.25 * 0.25); /* |a| of (far, 0, 0) */
    (void)state;
    exact_edge_margins_ulp(org, dir, v[0], v[1], v[2], margin);
    assert_true(fabs(margin[2] * 0x1p-23 * 1048576.125 / nearer / sine - 1.0) < 1e-14);
}

static void edge_margins__random__signs_say_hit(void **state)
{
    base_random random = {3};
    unsigned hits = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 20000; i++) {
        oracle_ray ray;
        scene_triangle s;
        double margin[3];
        random_case(&random, &ray, &s);
        if (i % 4 == 0)
            for (int k = 0; k < 3; k++)
                ray.dir[k] = s.v[i / 4 % 3][k] - ray.org[k]; /* at a vertex, as far as floats can */
        exact_ray_triangle(ray.org, ray.dir, s.v[0], s.v[1], s.v[2], &hit);
        exact_edge_margins_ulp(ray.org, ray.dir, s.v[0], s.v[1], s.v[2], margin);
        assert_int_equal(hit.hit, margin[0] >= 0.0 && margin[1] >= 0.0 && margin[2] >= 0.0);
        hits += hit.hit != 0;
        if (i % 4 == 0)
            assert_true(exact_edge_distance_ulp(ray.org, ray.dir, s.v[0], s.v[1], s.v[2]) < 2.0);
    }
    assert_true(hits > 1000);
    exact_hit_clear(&hit);
}

static void edge_margins__degenerate_views__no_division(void **state)
{
    const float on_edge_line[3] = {2, 0, 0}, in_plane[3] = {-1, 0.25f, 0}, along[3] = {1, 0, 0}, zero[3] = {0, 0, 0};
    const float above[3] = {0.25f, 0.25f, 1}, down[3] = {0, 0, -1};
    double margin[3];
    (void)state;
    assert_same(exact_edge_distance_ulp(on_edge_line, down, UNIT[0], UNIT[1], UNIT[2]), 0.0);
    assert_same(exact_edge_distance_ulp(above, zero, UNIT[0], UNIT[1], UNIT[2]), 0.0);
    assert_same(exact_edge_distance_ulp(UNIT[0], down, UNIT[0], UNIT[1], UNIT[2]), 0.0);
    exact_edge_margins_ulp(in_plane, along, UNIT[0], UNIT[1], UNIT[2], margin);
    for (int i = 0; i < 3; i++)
        assert_same(margin[i], 0.0);
    exact_edge_margins_ulp(in_plane, down, UNIT[0], UNIT[1], UNIT[2], margin);
    for (int i = 0; i < 3; i++)
        assert_true(margin[i] < -1e6);
}

static const float BOX_LO[3] = {-1, -2, -3}, BOX_HI[3] = {1, 2, 3};

static void box__hand_cases__closed(void **state)
{
    static const struct {
        float org[3], dir[3];
        int meets;
        double entry, exit;
    } cases[] = {
        {{-3, 0, 0}, {1, 0, 0}, 1, 2, 4},                        /* through the middle */
        {{-3, 0, 0}, {-1, 0, 0}, 0, 0, 0},                       /* away */
        {{0, 0, 0}, {0.5f, 0, 0}, 1, 0, 2},                      /* from inside */
        {{-3, 2, 3}, {1, 0, 0}, 1, 2, 4},                        /* along an edge */
        {{-3, 2, 0}, {1, 0, -0.0f}, 1, 2, 4},                    /* in a face, the other components +0 and -0 */
        {{-3, 0x1.000002p1f, 0}, {1, 0, 0}, 0, 0, 0},            /* one ulp beside that face */
        {{1, 0, 0}, {1, 0, 0}, 1, 0, 0},                         /* on a face, leaving */
        {{0x1.000002p0f, 0, 0}, {1, 0, 0}, 0, 0, 0},             /* just outside, leaving */
        {{-2, -3, -4}, {1, 1, 1}, 1, 1, 3},                      /* at a corner and through */
        {{-3, 2, 0}, {2, 2, 0}, 0, 0, 0},                        /* past an edge */
        {{-2, 1, 0}, {1, 1, 0}, 1, 1, 1},                        /* touching an edge: entry = exit */
        {{0, 0, 0}, {0, 0, 0}, 1, 0, (double)INFINITY},          /* no direction, inside */
        {{2, 0, 0}, {0, 0, 0}, 0, 0, 0},                         /* no direction, outside */
        {{-3, 0, 0}, {0x1p-149f, 0, 0}, 1, 0x1p150, 0x1p151},    /* denormal direction */
    };
    exact_interval interval;
    (void)state;
    exact_interval_init(&interval);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        exact_box_interval(cases[i].org, cases[i].dir, BOX_LO, BOX_HI, &interval);
        assert_int_equal(!interval.empty, cases[i].meets);
        assert_int_equal(exact_ray_box(cases[i].org, cases[i].dir, BOX_LO, BOX_HI), cases[i].meets);
        assert_same(interval.entry_double, cases[i].entry);
        assert_same(interval.exit_double, cases[i].exit);
        assert_int_equal(interval.unbounded, cases[i].meets && isinf(cases[i].exit));
    }
    exact_interval_clear(&interval);
}

static void box__empty_or_flat__as_its_points(void **state)
{
    const float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    const float flat_lo[3] = {0, -1, -1}, flat_hi[3] = {0, 1, 1}, point[3] = {0.5f, 0.25f, 0.125f};
    const float org[3] = {-1, 0, 0}, dir[3] = {1, 0, 0}, at_point[3] = {1.5f, 0.25f, 0.125f};
    const float in_plane[3] = {0, 0, -2}, up[3] = {0, 0, 1};
    (void)state;
    assert_false(exact_ray_box(org, dir, lo, hi));
    assert_true(exact_ray_box(org, dir, flat_lo, flat_hi));
    assert_true(exact_ray_box(in_plane, up, flat_lo, flat_hi));
    assert_true(exact_ray_box(org, at_point, point, point));
    assert_false(exact_ray_box(org, dir, point, point));
    assert_true(exact_ray_box(point, dir, point, point));
}

/* The points at entry and at exit lie in the box, points just before and after do not. */
static void box_interval__random__ends_are_on_the_border(void **state)
{
    base_random random = {4};
    unsigned meets = 0;
    exact_interval interval;
    mpq_t t, x, y;
    (void)state;
    exact_interval_init(&interval);
    mpq_inits(t, x, y, NULL);
    for (int i = 0; i < 20000; i++) {
        float org[3], dir[3];
        int inside[6] = {1, 1, 1, 1, 1, 1};
        soup_integer_point(&random, 6, org);
        soup_integer_point(&random, 5, dir);
        exact_box_interval(org, dir, BOX_LO, BOX_HI, &interval);
        for (int n = 0; n < 6; n++) { /* entry, exit, their middle, before entry, after exit, t = n/7 */
            mpq_set(t, n == 0 || n == 3 ? interval.entry : interval.exit);
            if (n == 2) {
                mpq_add(t, t, interval.entry);
                mpq_div_2exp(t, t, 1);
            }
            mpq_set_ui(x, 1, 1000000);
            if (n == 3)
                mpq_sub(t, t, x);
            if (n == 4)
                mpq_add(t, t, x);
            if (n == 5)
                mpq_set_ui(t, base_random_bits(&random) % 64, 7);
            mpq_canonicalize(t);
            inside[n] = mpq_sgn(t) >= 0;
            for (int k = 0; k < 3; k++) {
                mpq_set_d(x, (double)dir[k]);
                mpq_mul(x, x, t);
                mpq_set_d(y, (double)org[k]);
                mpq_add(x, x, y);
                inside[n] &= mpq_cmp_si(x, (long)BOX_LO[k], 1) >= 0 && mpq_cmp_si(x, (long)BOX_HI[k], 1) <= 0;
            }
        }
        if (interval.empty)
            assert_false(inside[5]);
        else if (!interval.unbounded)
            assert_true(inside[0] && inside[1] && inside[2] && !inside[3] && !inside[4]);
        meets += !interval.empty;
    }
    assert_true(meets > 2000 && meets < 18000);
    mpq_clears(t, x, y, NULL);
    exact_interval_clear(&interval);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ray_triangle__inside__t_u_v_and_front),
        cmocka_unit_test(ray_triangle__on_border__hit),
        cmocka_unit_test(ray_triangle__one_ulp_outside__miss),
        cmocka_unit_test(ray_triangle__from_below__back),
        cmocka_unit_test(ray_triangle__behind_or_at_origin__miss),
        cmocka_unit_test(ray_triangle__in_plane_or_degenerate__parallel),
        cmocka_unit_test(ray_triangle__t_of_a_third__rounded_to_nearest),
        cmocka_unit_test(ray_triangle__extreme_magnitudes__exact),
        cmocka_unit_test(compare_t__equal_and_next__ordered),
        cmocka_unit_test(ray_triangle__random__as_long_double),
        cmocka_unit_test(ray_triangle__vertices_permuted__same_hit),
        cmocka_unit_test(edge_margins__beside_an_edge__sine_in_ulp),
        cmocka_unit_test(edge_margins__far_from_world_origin__larger_unit),
        cmocka_unit_test(edge_margins__random__signs_say_hit),
        cmocka_unit_test(edge_margins__degenerate_views__no_division),
        cmocka_unit_test(box__hand_cases__closed),
        cmocka_unit_test(box__empty_or_flat__as_its_points),
        cmocka_unit_test(box_interval__random__ends_are_on_the_border),
    };
    return cmocka_run_group_tests_name("oracles/exact", tests, NULL, NULL);
}
