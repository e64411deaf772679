/* The reciprocal estimate and its refinement over every mantissa: how far they are from 1/x.
 *
 * Bounds. The estimate e is RN(1/x) with 12 of its 24 significant bits kept: e = (1 - c)/x with -2^-24 <= c < 2^-11.
 * One refinement computes f = RN(2 - e x) = (1 + c)(1 + r) with |r| <= 2^-24, then RN(e f) = e f (1 + s), |s| <= 2^-24:
 * the error is -c^2 + r + s and terms of 2^-35. After the first step |c'| < 2^-22 + 2^-23 + 2^-34 < 2^-21.4; after the
 * second, c'^2 < 2^-42 no longer counts: the last rounding is half a unit in the last place (ulp) of the result, and r
 * at most 2^-24 of it, that is one ulp where the result is close to a power of two from below. 1.5 ulp and 2^-17 for
 * the rest (2^-42 of a result is at most 2^-18 ulp) bound it. For results that are normal floats, and no overflow.
 */
#include <math.h>

#include "tests/lrbni/case.h"

static const double BOUND_ULP = 1.5 + 0x1p-17;

static const int exponents[] = {-125, -1, 0, 1, 100, 125}; /* of x: 1/x is a normal float for each */
enum { EXPONENTS = sizeof exponents / sizeof exponents[0] };

/* Sixteen consecutive floats from `first` bits, sign included. */
static void consecutive(uint32_t first, uint32_t out[16])
{
    for (uint32_t i = 0; i < 16; i++)
        out[i] = first + i;
}

static void rcpres__every_mantissa__within_2_to_minus_11(void **state)
{
    double worst = 0;
    for (int e = 0; e < EXPONENTS; e++)
        for (uint32_t mantissa = 0; mantissa < 1u << 23; mantissa += 16) {
            uint32_t x[16];
            float out[16];
            consecutive((uint32_t)(exponents[e] + 127) << 23 | mantissa | (e & 1u) << 31, x);
            lanes_store_ps(out, lrb_rcpres_ps(*state, case_ps(x)).lanes);
            for (int i = 0; i < 16; i++) {
                double error = fabs((double)out[i] * (double)lrb_bits_float(x[i]) - 1.0); /* exact: 36 bits */
                if (error > worst)
                    worst = error;
                if (!(error < 0x1p-11))
                    fail_msg("1/%08x: %08x is off by %g", x[i], lrb_float_bits(out[i]), error);
            }
        }
    printf("# rcpres: largest relative error 2^%.4f\n", log2(worst));
}

/* Distance of y from 1/x in units of y's last place; |error| of the double quotient is below 2^-29 of that. */
static double ulps(float y, uint32_t x)
{
    int exponent;
    frexp((double)y, &exponent);
    return fabs((double)y - 1.0 / (double)lrb_bits_float(x)) / ldexp(1.0, exponent - 24);
}

static void rcprefine__twice_from_every_mantissa__within_bound(void **state)
{
    double worst = 0, worst_once = 0;
    for (int e = 0; e < EXPONENTS; e++)
        for (uint32_t mantissa = 0; mantissa < 1u << 23; mantissa += 16) {
            uint32_t x[16];
            float once[16], twice[16];
            consecutive((uint32_t)(exponents[e] + 127) << 23 | mantissa | (e & 1u) << 31, x);
            lrb_v16f v = case_ps(x), y = lrb_rcprefine_ps(*state, lrb_rcpres_ps(*state, v), v);
            lanes_store_ps(once, y.lanes);
            lanes_store_ps(twice, lrb_rcprefine_ps(*state, y, v).lanes);
            for (int i = 0; i < 16; i++) {
                double error_once = ulps(once[i], x[i]), error = ulps(twice[i], x[i]);
                worst = error > worst ? error : worst;
                worst_once = error_once > worst_once ? error_once : worst_once;
                if (!(error <= BOUND_ULP))
                    fail_msg("1/%08x: %08x is off by %g ulp", x[i], lrb_float_bits(twice[i]), error);
            }
        }
    printf("# rcprefine: largest error %.4f ulp after one step, %.4f ulp after two (bound %.4f)\n", worst_once, worst, BOUND_ULP);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rcpres__every_mantissa__within_2_to_minus_11),
        cmocka_unit_test(rcprefine__twice_from_every_mantissa__within_bound),
    };
    return cmocka_run_group_tests_name("estimate " LRB_BACKEND, tests, case_setup, case_teardown);
}
