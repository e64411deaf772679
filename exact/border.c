#include <math.h>

#include "exact/predicates.h"
#include "exact/vector.h"

static const double UNIT = 0x1p-23;

/* Sine of the angle between two vectors from the length of their cross product or the size of their dot product. */
static double quotient(double numerator, long exponent, const exact_vector *a, const exact_vector *b)
{
    long a_exponent, b_exponent;
    double length = exact_vector_length(a, &a_exponent);
    length *= exact_vector_length(b, &b_exponent);
    return ldexp(numerator / length, (int)(exponent - a_exponent - b_exponent));
}

/* Sign of the determinant (a x b).c */
static int side_of(exact_vector *work, mpz_t dot, const exact_vector *a, const exact_vector *b, const exact_vector *c)
{
    exact_vector_cross(work, a, b);
    exact_vector_dot(dot, work, c);
    return mpz_sgn(dot);
}

/* Sine of the angle between the ray and a point; 1 if they lie in opposite half-spaces or the point is the origin. */
static double point_sine(exact_vector *work, mpz_t dot, const exact_vector *dir, const exact_vector *point)
{
    long exponent;
    exact_vector_dot(dot, dir, point);
    if (mpz_sgn(dot) <= 0)
        return 1.0;
    exact_vector_cross(work, dir, point);
    double length = exact_vector_length(work, &exponent);
    return length == 0.0 ? 0.0 : quotient(length, exponent, dir, point);
}

/* Sine of the angle between the ray and the segment from a to b. */
static double segment_sine(exact_vector work[2], mpz_t dot, const exact_vector *dir, const exact_vector *a, const exact_vector *b)
{
    exact_vector *normal = &work[0];
    exact_vector_cross(normal, a, b);
    if (!exact_vector_is_zero(normal) && side_of(&work[1], dot, normal, a, dir) > 0 && side_of(&work[1], dot, normal, b, dir) < 0) {
        long exponent;
        exact_vector_dot(dot, normal, dir);
        const double size = fabs(mpz_get_d_2exp(&exponent, dot));
        return size == 0.0 ? 0.0 : quotient(size, exponent, normal, dir);
    }
    return fmin(point_sine(normal, dot, dir, a), point_sine(normal, dot, dir, b));
}

double exact_border_ulp(const float org[3], const float dir[3], const float v0[3], const float v1[3], const float v2[3])
{
    const float *const vertex[3] = {v0, v1, v2};
    exact_vector v[6]; /* the vertices, the direction, two to work with; all relative to the origin */
    mpz_t dot;
    double sine = 1.0;
    int exponent = exact_vector_exponent(EXACT_NO_EXPONENT, org);
    exact_vector_init(v, 6);
    mpz_init(dot);
    for (int i = 0; i < 3; i++)
        exponent = exact_vector_exponent(exponent, vertex[i]);
    exact_vector_set(&v[3], org, exponent);
    for (int i = 0; i < 3; i++) {
        exact_vector_set(&v[i], vertex[i], exponent);
        exact_vector_subtract(&v[i], &v[i], &v[3]);
    }
    exact_vector_set(&v[3], dir, exact_vector_exponent(EXACT_NO_EXPONENT, dir));
    for (int i = 0; i < 3 && !exact_vector_is_zero(&v[3]); i++)
        sine = fmin(sine, segment_sine(&v[4], dot, &v[3], &v[i], &v[(i + 1) % 3]));
    mpz_clear(dot);
    exact_vector_clear(v, 6);
    return sine / UNIT;
}
