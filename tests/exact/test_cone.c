#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "exact/predicates.h"
#include "tests/oracles/soup.h"

/* Small integers: every cross product and test below fits 64 bits, and every sampled direction is exact in float. */
enum { SIZE = 60, WEIGHTS = 64 };

typedef struct vector {
    int64_t c[3];
} vector;

static vector from_floats(const float a[3])
{
    return (vector){{(int64_t)a[0], (int64_t)a[1], (int64_t)a[2]}};
}

static vector negated(vector a)
{
    return (vector){{-a.c[0], -a.c[1], -a.c[2]}};
}

static vector cross(vector a, vector b)
{
    vector out;
    for (int k = 0; k < 3; k++)
        out.c[k] = a.c[(k + 1) % 3] * b.c[(k + 2) % 3] - a.c[(k + 2) % 3] * b.c[(k + 1) % 3];
    return out;
}

static int64_t dot(vector a, vector b)
{
    return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}

/* A cone with corners in convex position, in order around it, as a frustum's are; 0 if these corners are not that. */
static int frustum_like(base_random *random, float corner[4][3])
{
    float d0[3], dx[3], dy[3];
    vector c[4];
    soup_integer_point(random, SIZE / 2, d0);
    soup_integer_point(random, SIZE / 4, dx);
    soup_integer_point(random, SIZE / 4, dy);
    for (int k = 0; k < 3; k++) {
        corner[0][k] = d0[k];
        corner[1][k] = d0[k] + dx[k];
        corner[2][k] = d0[k] + dx[k] + dy[k];
        corner[3][k] = d0[k] + dy[k];
    }
    for (int i = 0; i < 4; i++)
        c[i] = from_floats(corner[i]);
    return dot(cross(c[0], c[1]), c[2]) != 0; /* d0, dx, dy independent: a pointed cone over a parallelogram */
}

/* Whether p lies in the closed cone whose corners run around it with the given orientation. */
static int cone_has(const vector *corner, int count, vector p)
{
    int64_t orientation = dot(cross(corner[0], corner[1]), corner[2]);
    for (int i = 0; i < count; i++) {
        int64_t side = dot(cross(corner[i], corner[(i + 1) % count]), p);
        if (orientation > 0 ? side < 0 : side > 0)
            return 0;
    }
    return 1;
}

/* Whether p lies between a and b in their plane (which it is known to be in). */
static int sector_has(vector a, vector b, vector p)
{
    vector n = cross(a, b);
    return dot(cross(a, p), n) >= 0 && dot(cross(p, b), n) >= 0;
}

/* Two pointed cones with inner points share more than the apex iff one has a corner of the other or two sides cross. */
static int cones_meet(const vector a[4], const vector b[3])
{
    for (int i = 0; i < 4; i++)
        if (cone_has(b, 3, a[i]))
            return 1;
    for (int i = 0; i < 3; i++)
        if (cone_has(a, 4, b[i]))
            return 1;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            vector a0 = a[i], a1 = a[(i + 1) % 4], b0 = b[j], b1 = b[(j + 1) % 3];
            vector line = cross(cross(a0, a1), cross(b0, b1));
            if (line.c[0] == 0 && line.c[1] == 0 && line.c[2] == 0)
                continue; /* sides in one plane: if they overlap, a corner lies in the other cone */
            if ((sector_has(a0, a1, line) && sector_has(b0, b1, line)) ||
                (sector_has(a0, a1, negated(line)) && sector_has(b0, b1, negated(line))))
                return 1;
        }
    return 0;
}

static void cone_triangle__random__as_spherical_polygons(void **state)
{
    base_random random = {1};
    const float org[3] = {0, 0, 0};
    unsigned meets = 0, misses = 0;
    (void)state;
    while (meets + misses < 20000) {
        float corner[4][3], v[3][3];
        vector a[4], b[3];
        if (!frustum_like(&random, corner))
            continue;
        for (int i = 0; i < 4; i++)
            a[i] = from_floats(corner[i]);
        for (int i = 0; i < 3; i++) {
            soup_integer_point(&random, SIZE, v[i]);
            b[i] = from_floats(v[i]);
        }
        int64_t volume = dot(cross(b[0], b[1]), b[2]);
        if (volume == 0)
            continue;
        int expected = cones_meet(a, b);
        assert_int_equal(exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 0), expected);
        assert_int_equal(exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 1),
                         expected && volume < 0);
        meets += expected != 0;
        misses += expected == 0;
    }
    assert_true(meets > 2000 && misses > 2000);
}

/* A direction that is a convex combination of the corners times WEIGHTS, exact because all are small integers. */
static void sample(base_random *random, float corner[4][3], float dir[3])
{
    int rest = WEIGHTS, weight[4] = {0};
    for (int i = 0; i < 3; i++) {
        weight[i] = (int)(base_random_bits(random) % (unsigned)(rest + 1));
        rest -= weight[i];
    }
    weight[3] = rest;
    unsigned shift = (unsigned)(base_random_bits(random) % 4);
    for (int k = 0; k < 3; k++) {
        dir[k] = 0.0f;
        for (unsigned i = 0; i < 4; i++)
            dir[k] += (float)weight[i] * corner[(i + shift) % 4][k];
    }
}

/* Corners that need not be in convex position, with coincident, collinear, opposite and zero ones among them. */
static void any_corners(base_random *random, float corner[4][3])
{
    for (int i = 0; i < 4; i++) {
        unsigned kind = (unsigned)(base_random_bits(random) % 8);
        soup_integer_point(random, SIZE / 8, corner[i]);
        for (int k = 0; k < 3; k++) {
            if (kind == 0 && i > 0)
                corner[i][k] = corner[i - 1][k];
            else if (kind == 1 && i > 1)
                corner[i][k] = corner[0][k] + corner[1][k];
            else if (kind == 2)
                corner[i][k] = 0.0f;
            else if (kind == 3 && i > 0)
                corner[i][k] = -corner[0][k];
        }
    }
}

static void cone_triangle__sampled_ray_hits__meets(void **state)
{
    base_random random = {2};
    unsigned hits = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 3000; i++) {
        float corner[4][3], org[3], v[3][3], dir[3];
        any_corners(&random, corner);
        soup_integer_point(&random, 4, org);
        for (int j = 0; j < 3; j++)
            soup_integer_point(&random, 8, v[j]);
        int meets = exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 0);
        int front = exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 1);
        for (int n = 0; n < 20; n++) {
            if (n < 4)
                memcpy(dir, corner[n], sizeof dir);
            else
                sample(&random, corner, dir);
            if (!exact_ray_triangle(org, dir, v[0], v[1], v[2], &hit))
                continue;
            hits++;
            assert_true(meets);
            assert_int_equal(front, hit.facing > 0); /* all rays from one origin see the same side */
        }
    }
    assert_true(hits > 2000);
    exact_hit_clear(&hit);
}

static void cone_box__sampled_ray_hits__meets(void **state)
{
    base_random random = {3};
    unsigned hits = 0, misses = 0;
    (void)state;
    for (int i = 0; i < 3000; i++) {
        float corner[4][3], org[3], lo[3], hi[3], dir[3];
        any_corners(&random, corner);
        soup_integer_point(&random, 8, org);
        soup_integer_point(&random, 8, lo);
        for (int k = 0; k < 3; k++)
            hi[k] = lo[k] + (float)(base_random_bits(&random) % 8);
        int meets = exact_cone_box(org, (const float(*)[3])corner, lo, hi);
        misses += !meets;
        for (int n = 0; n < 20; n++) {
            if (n < 4)
                memcpy(dir, corner[n], sizeof dir);
            else
                sample(&random, corner, dir);
            if (exact_ray_box(org, dir, lo, hi)) {
                hits++;
                assert_true(meets);
            }
        }
    }
    assert_true(hits > 2000 && misses > 1000);
}

/* A cone of four equal corners is one ray: both tests must then say what the ray tests say, touching cases included. */
static void cone__four_equal_corners__as_the_ray(void **state)
{
    base_random random = {4};
    unsigned triangle_hits = 0, box_hits = 0;
    exact_hit hit;
    (void)state;
    exact_hit_init(&hit);
    for (int i = 0; i < 10000; i++) {
        float corner[4][3], org[3], v[3][3], lo[3], hi[3];
        soup_integer_point(&random, 3, corner[0]);
        for (int n = 1; n < 4; n++)
            memcpy(corner[n], corner[0], sizeof corner[0]);
        soup_integer_point(&random, 3, org);
        for (int j = 0; j < 3; j++)
            soup_integer_point(&random, 4, v[j]);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(v[0][k], v[1][k]);
            hi[k] = fmaxf(v[0][k], v[1][k]);
        }
        int expected = exact_ray_triangle(org, corner[0], v[0], v[1], v[2], &hit);
        assert_int_equal(exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 0), expected);
        assert_int_equal(exact_cone_triangle(org, (const float(*)[3])corner, v[0], v[1], v[2], 1),
                         expected && hit.facing > 0);
        triangle_hits += expected != 0;
        expected = exact_ray_box(org, corner[0], lo, hi);
        assert_int_equal(exact_cone_box(org, (const float(*)[3])corner, lo, hi), expected);
        box_hits += expected != 0;
    }
    assert_true(triangle_hits > 200 && box_hits > 1000);
    exact_hit_clear(&hit);
}

/* The frustum |x| <= -z, |y| <= -z. */
static const float FRUSTUM[4][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}};

static int meets(float ax, float ay, float az, float bx, float by, float bz, float cx, float cy, float cz)
{
    const float org[3] = {0, 0, 0}, a[3] = {ax, ay, az}, b[3] = {bx, by, bz}, c[3] = {cx, cy, cz};
    return exact_cone_triangle(org, FRUSTUM, a, b, c, 0);
}

static void cone_triangle__hand_cases__closed_and_in_front(void **state)
{
    (void)state;
    assert_true(meets(-9, -9, -1, 9, -9, -1, 0, 9, -1));    /* encloses the frustum */
    assert_true(meets(0, 0, -1, 0.125f, 0, -1, 0, 0.125f, -1)); /* enclosed by it */
    assert_true(meets(1, 0, -1, 2, -1, -1, 2, 1, -1));      /* a vertex touches a side */
    assert_false(meets(0x1.000002p0f, 0, -1, 2, -1, -1, 2, 1, -1)); /* one ulp beside it */
    assert_true(meets(1, -1, -1, 1, 1, -1, 2, 0, -1));      /* an edge lies in a side */
    assert_true(meets(2, 0, -1, 0, 2, -1, 2, 2, -1));       /* an edge touches the edge between two sides */
    assert_false(meets(-9, -9, 1, 9, -9, 1, 0, 9, 1));      /* behind */
    assert_true(meets(-1, 1, -4, 1, 1, -4, 0, 1, 4));       /* reaches from before to behind the origin, inside */
    assert_false(meets(-1, 9, -4, 1, 9, -4, 0, 9, 4));      /* the same, beside the frustum */
    assert_false(meets(-1, 0, -1, 1, 0, -1, 0, 0, -2));     /* seen edge on */
    assert_false(meets(-1, -1, 0, 1, -1, 0, 0, 1, 0));      /* contains the origin: t = 0 */
    assert_false(meets(0, 0, -1, 0, 0, -2, 0, 0, -3));      /* no area */
}

static void cone_box__hand_cases__closed(void **state)
{
    static const struct {
        float lo[3], hi[3];
        int meets;
    } cases[] = {
        {{-1, -1, -1}, {1, 1, 1}, 1},                          /* the origin inside */
        {{0, 0, 0}, {1, 1, 1}, 1},                             /* the origin at its corner, all else behind */
        {{0x1p-149f, 0, 0}, {1, 1, 1}, 0},                     /* a hair off */
        {{-1, -1, 1}, {1, 1, 2}, 0},                           /* behind */
        {{-9, -9, -2}, {9, 9, -1}, 1},                         /* wider than the frustum */
        {{-0.25f, -0.25f, -2}, {0.25f, 0.25f, -1}, 1},         /* inside it */
        {{2, -1, -2}, {3, 1, -1}, 1},                          /* touches a side at z = -2 */
        {{0x1.000002p1f, -1, -2}, {3, 1, -1}, 0},              /* one ulp beside it */
        {{2, 2, -2}, {3, 3, -2}, 1},                           /* flat, a corner touches the corner ray */
        {{5, 5, -5}, {5, 5, -5}, 1},                           /* a point on the corner ray */
        {{5, 5, -4}, {5, 5, -4}, 0},                           /* a point beside it */
        {{1, 1, 1}, {0, 2, 2}, 0},                             /* empty */
        {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0},
    };
    const float org[3] = {0, 0, 0};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(exact_cone_box(org, FRUSTUM, cases[i].lo, cases[i].hi), cases[i].meets);
}

/* The cone meets a box iff it meets one of the box's 12 triangles, but for flat views and the origin inside. */
static void cone_box__random__as_its_triangles(void **state)
{
    base_random random = {5};
    unsigned hits = 0, misses = 0;
    (void)state;
    for (int i = 0; i < 3000; i++) {
        float corner[4][3], lo[3], hi[3], vertex[8][3], org[3];
        int expected = 0;
        if (!frustum_like(&random, corner))
            continue;
        for (int k = 0; k < 3; k++) {
            lo[k] = (float)base_random_range(&random, -4.0, 4.0);
            hi[k] = lo[k] + (float)base_random_range(&random, 0.125, 6.0);
            org[k] = (float)base_random_range(&random, -4.0, 4.0);
        }
        if (exact_ray_box(org, (const float[3]){0, 0, 0}, lo, hi))
            continue;
        for (int n = 0; n < 8; n++)
            for (int k = 0; k < 3; k++)
                vertex[n][k] = n >> k & 1 ? hi[k] : lo[k];
        static const int triangles[12][3] = {{0, 2, 4}, {2, 6, 4}, {1, 5, 3}, {3, 5, 7}, {0, 4, 1}, {1, 4, 5},
                                             {2, 3, 6}, {3, 7, 6}, {0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}};
        for (int n = 0; n < 12; n++)
            expected |= exact_cone_triangle(org, (const float(*)[3])corner, vertex[triangles[n][0]],
                                            vertex[triangles[n][1]], vertex[triangles[n][2]], 0);
        assert_int_equal(exact_cone_box(org, (const float(*)[3])corner, lo, hi), expected);
        hits += expected != 0;
        misses += expected == 0;
    }
    assert_true(hits > 300 && misses > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cone_triangle__hand_cases__closed_and_in_front),
        cmocka_unit_test(cone_triangle__random__as_spherical_polygons),
        cmocka_unit_test(cone_triangle__sampled_ray_hits__meets),
        cmocka_unit_test(cone_box__hand_cases__closed),
        cmocka_unit_test(cone_box__sampled_ray_hits__meets),
        cmocka_unit_test(cone_box__random__as_its_triangles),
        cmocka_unit_test(cone__four_equal_corners__as_the_ray),
    };
    return cmocka_run_group_tests_name("oracles/exact_cone", tests, NULL, NULL);
}
