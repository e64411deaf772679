/* Vectors of big integers. A float is an integer times a power of two, so floats that are brought to one common
   power of two are integers, and sums and products of them are exact. */
#ifndef EXACT_VECTOR_H
#define EXACT_VECTOR_H

#include <gmp.h>
#include <limits.h>

/* What exact_vector_exponent starts from, and its answer when everything is 0. */
#define EXACT_NO_EXPONENT INT_MAX

typedef struct exact_vector {
    mpz_t c[3];
} exact_vector;

/** Set up `count` zero vectors; free them with exact_vector_clear. Aborts, as GMP does, when memory runs out. */
void exact_vector_init(exact_vector *v, unsigned count);

/** Free what exact_vector_init set up. */
void exact_vector_clear(exact_vector *v, unsigned count);

/**
 * The smaller of `exponent` and the exponents of x's components as 24-bit integers times a power of two.
 *
 * @param exponent  EXACT_NO_EXPONENT to begin with
 * @param x         finite (asserted)
 */
int exact_vector_exponent(int exponent, const float x[3]);

/** out = x / 2^exponent, where `exponent` is at most that of every component that is not 0. */
void exact_vector_set(exact_vector *out, const float x[3], int exponent);

/** out = a - b; out may be a or b. */
void exact_vector_subtract(exact_vector *out, const exact_vector *a, const exact_vector *b);

/** out = -a; out may be a. */
void exact_vector_negate(exact_vector *out, const exact_vector *a);

/** out = a x b; out must be neither. */
void exact_vector_cross(exact_vector *out, const exact_vector *a, const exact_vector *b);

/** out = a . b. */
void exact_vector_dot(mpz_t out, const exact_vector *a, const exact_vector *b);

/** Whether all three components are 0. */
int exact_vector_is_zero(const exact_vector *a);

/** |a|, rounded to double with a relative error below 1e-15, times 2^-*exponent: |a| = result * 2^*exponent. */
double exact_vector_length(const exact_vector *a, long *exponent);

#endif
