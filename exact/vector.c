#include "exact/vector.h"

#include <assert.h>
#include <math.h>

enum { MANTISSA_BITS = 24 };

void exact_vector_init(exact_vector *v, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            mpz_init(v[i].c[k]);
}

void exact_vector_clear(exact_vector *v, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            mpz_clear(v[i].c[k]);
}

int exact_vector_exponent(int exponent, const float x[3])
{
    for (int k = 0; k < 3; k++) {
        int e;
        assert(isfinite(x[k]));
        if (x[k] == 0.0f)
            continue;
        frexpf(x[k], &e);
        if (e - MANTISSA_BITS < exponent)
            exponent = e - MANTISSA_BITS;
    }
    return exponent;
}

void exact_vector_set(exact_vector *out, const float x[3], int exponent)
{
    for (int k = 0; k < 3; k++) {
        int e;
        float fraction = frexpf(x[k], &e);
        mpz_set_si(out->c[k], (long)ldexpf(fraction, MANTISSA_BITS));
        if (x[k] != 0.0f) {
            assert(e - MANTISSA_BITS >= exponent);
            mpz_mul_2exp(out->c[k], out->c[k], (mp_bitcnt_t)(e - MANTISSA_BITS - exponent));
        }
    }
}

void exact_vector_subtract(exact_vector *out, const exact_vector *a, const exact_vector *b)
{
    for (int k = 0; k < 3; k++)
        mpz_sub(out->c[k], a->c[k], b->c[k]);
}

void exact_vector_negate(exact_vector *out, const exact_vector *a)
{
    for (int k = 0; k < 3; k++)
        mpz_neg(out->c[k], a->c[k]);
}

void exact_vector_cross(exact_vector *out, const exact_vector *a, const exact_vector *b)
{
    assert(out != a && out != b);
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mpz_mul(out->c[k], a->c[i], b->c[j]);
        mpz_submul(out->c[k], a->c[j], b->c[i]);
    }
}

void exact_vector_dot(mpz_t out, const exact_vector *a, const exact_vector *b)
{
    mpz_mul(out, a->c[0], b->c[0]);
    mpz_addmul(out, a->c[1], b->c[1]);
    mpz_addmul(out, a->c[2], b->c[2]);
}

int exact_vector_is_zero(const exact_vector *a)
{
    return mpz_sgn(a->c[0]) == 0 && mpz_sgn(a->c[1]) == 0 && mpz_sgn(a->c[2]) == 0;
}

double exact_vector_length(const exact_vector *a, long *exponent)
{
    mpz_t square;
    double fraction;
    mpz_init(square);
    exact_vector_dot(square, a, a);
    fraction = mpz_get_d_2exp(exponent, square);
    mpz_clear(square);
    if (*exponent % 2 != 0) {
        fraction *= 2.0;
        *exponent -= 1;
    }
    *exponent /= 2;
    return sqrt(fraction);
}
