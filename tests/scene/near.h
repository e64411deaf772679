/* cmocka 1.1.5 compares floats only. Include after cmocka.h. */
#ifndef TESTS_SCENE_NEAR_H
#define TESTS_SCENE_NEAR_H

#include <math.h>

/* Fails unless |actual - expected| <= tolerance; a NaN is near to nothing. */
#define assert_near(actual, expected, tolerance) check_near((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

static inline void check_near(double actual, double expected, double tolerance, const char *what, const char *file, int line)
{
    if (!(fabs(actual - expected) <= tolerance)) {
        print_error("%s is %.17g instead of %.17g\n", what, actual, expected);
        _fail(file, line);
    }
}

#endif
