/* Heat maps: an ordered ramp, the scale, the legend. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reports/heat_map.h"

/* CIE L* of a colour, 0 to 100. */
static double lightness(report_color color)
{
    double y = (double)report_luminance(color);
    return y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y;
}

static int same(report_color color, const float *pixel)
{
    return color.r == pixel[0] && color.g == pixel[1] && color.b == pixel[2];
}

static void color__whole_ramp__rises_evenly_in_lightness(void **state)
{
    (void)state;
    enum { STEPS = 4096 };
    double before = lightness(report_heat_color(0)), start = before;
    double whole = lightness(report_heat_color(1)) - start;
    assert_true(start < 5 && start + whole > 95);
    for (int i = 1; i <= STEPS; i++) {
        double value = (double)i / STEPS;
        double now = lightness(report_heat_color(value));
        assert_true(now > before);
        assert_true(now - before < 2 * whole / STEPS);
        assert_true(fabs(now - start - value * whole) < 4); /* never far from a straight line */
        before = now;
    }
}

static void color__out_of_range__is_cut_and_nan_stands_out(void **state)
{
    (void)state;
    report_color low = report_heat_color(0), high = report_heat_color(1), none = report_heat_color((double)NAN);
    report_color below = report_heat_color(-3), above = report_heat_color((double)INFINITY);
    assert_memory_equal(&below, &low, sizeof low);
    assert_memory_equal(&above, &high, sizeof high);
    for (int i = 0; i <= 1000; i++) {
        report_color color = report_heat_color(i / 1000.0);
        float distance = fabsf(color.r - none.r) + fabsf(color.g - none.g) + fabsf(color.b - none.b);
        assert_true(distance > 0.1f);
        assert_true(color.r >= 0 && color.r <= 1 && color.g >= 0 && color.g <= 1 && color.b >= 0 && color.b <= 1);
    }
}

static void top__ranks__are_the_nearest(void **state)
{
    (void)state;
    double values[1000], top;
    for (int i = 0; i < 1000; i++)
        values[(i * 379) % 1000] = i + 1; /* a permutation of 1 to 1000 */
    assert_int_equal(report_heat_top(values, 1000, &top, NULL), BASE_OK);
    assert_true(top == 995);
    assert_int_equal(report_heat_top(values, 1, &top, NULL), BASE_OK);
    assert_true(top == values[0]);
    for (int i = 0; i < 200; i++)
        values[i] = i == 17 ? 5 : 0;
    assert_int_equal(report_heat_top(values, 200, &top, NULL), BASE_OK);
    assert_true(top == 5); /* the percentile is 0: the maximum */
    values[17] = 0;
    assert_int_equal(report_heat_top(values, 200, &top, NULL), BASE_OK);
    assert_true(top == 1);
    assert_int_equal(report_heat_top(values, 0, &top, NULL), BASE_OK);
    assert_true(top == 1);
}

static void top__values_that_are_not_finite__are_left_out(void **state)
{
    (void)state;
    const double values[] = {(double)NAN, 3, (double)INFINITY, 2, (double)NAN};
    double top;
    assert_int_equal(report_heat_top(values, 5, &top, NULL), BASE_OK);
    assert_true(top == 3);
}

static void map__chosen_top__colors_pixels_linearly(void **state)
{
    (void)state;
    enum { WIDTH = 300, HEIGHT = 2 };
    double *values = calloc(WIDTH * HEIGHT, sizeof *values);
    report_heat_options options = {.top = 1023, .label = "cycles"};
    report_image map;
    values[1] = 1023;
    values[2] = 4096;
    values[3] = 512;
    values[4] = (double)NAN;
    values[WIDTH] = 256; /* second row */
    assert_int_equal(report_heat_map_create(values, WIDTH, HEIGHT, &options, &map, NULL), BASE_OK);
    assert_int_equal(map.width, WIDTH);
    assert_true(map.height > HEIGHT + 20);
    assert_true(same(report_heat_color(0), report_image_pixel(&map, 0, 0)));
    assert_true(same(report_heat_color(1), report_image_pixel(&map, 1, 0)));
    assert_true(same(report_heat_color(1), report_image_pixel(&map, 2, 0)));
    assert_true(same(report_heat_color(512 / 1023.0), report_image_pixel(&map, 3, 0)));
    assert_true(same(report_heat_color((double)NAN), report_image_pixel(&map, 4, 0)));
    assert_true(same(report_heat_color(256 / 1023.0), report_image_pixel(&map, 0, 1)));
    report_image_destroy(&map);
    free(values);
}

static void map__legend__is_a_bar_over_dark_text_on_white(void **state)
{
    (void)state;
    enum { SIDE = 256 };
    double *values = calloc(SIDE * SIDE, sizeof *values);
    report_image map;
    for (int i = 0; i < SIDE * SIDE; i++)
        values[i] = i;
    assert_int_equal(report_heat_map_create(values, SIDE, SIDE, NULL, &map, NULL), BASE_OK);
    int y = SIDE + 8 + 8; /* margin of 4 dots and half the bar, at two pixels a dot */
    assert_true(same(report_heat_color(0), report_image_pixel(&map, 8, y)));
    assert_true(same(report_heat_color(1), report_image_pixel(&map, SIDE - 9, y)));
    assert_true(report_image_pixel(&map, 7, y)[0] == 1 && report_image_pixel(&map, SIDE - 8, y)[2] == 1);
    int dark = 0;
    for (int row = SIDE + 8 + 16; row < map.height; row++)
        for (int x = 0; x < map.width; x++) {
            float red = report_image_pixel(&map, x, row)[0];
            assert_true(red == 1 || red < 0.02f);
            dark += red < 0.02f;
        }
    assert_in_range(dark, 200, 4000);
    report_image_destroy(&map);
    free(values);
}

static void map__narrow_picture__grows_for_its_legend(void **state)
{
    (void)state;
    const double values[2] = {1, 123456789};
    report_heat_options options = {.label = "operations per pixel", .top = 1};
    report_image map;
    assert_int_equal(report_heat_map_create(values, 1, 2, &options, &map, NULL), BASE_OK);
    assert_true(map.width > 100);
    assert_true(same(report_heat_color(1), report_image_pixel(&map, 0, 0)));
    assert_true(report_image_pixel(&map, 1, 0)[0] == 1);
    report_image_destroy(&map);
}

static void map__same_values__give_the_same_bytes(void **state)
{
    (void)state;
    double values[64 * 64];
    report_image first, second;
    for (int i = 0; i < 64 * 64; i++)
        values[i] = (i * 7919) % 1000;
    assert_int_equal(report_heat_map_create(values, 64, 64, NULL, &first, NULL), BASE_OK);
    assert_int_equal(report_heat_map_create(values, 64, 64, NULL, &second, NULL), BASE_OK);
    assert_memory_equal(first.pixels, second.pixels,
                        (size_t)first.width * (size_t)first.height * 3 * sizeof *first.pixels);
    report_image_destroy(&first);
    report_image_destroy(&second);
}

static void map__bad_size__is_a_usage_error(void **state)
{
    (void)state;
    const double value = 0;
    report_image map;
    base_error err;
    assert_int_equal(report_heat_map_create(&value, 0, 1, NULL, &map, &err), BASE_ERR_USAGE);
    assert_null(map.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(color__whole_ramp__rises_evenly_in_lightness),
        cmocka_unit_test(color__out_of_range__is_cut_and_nan_stands_out),
        cmocka_unit_test(top__ranks__are_the_nearest),
        cmocka_unit_test(top__values_that_are_not_finite__are_left_out),
        cmocka_unit_test(map__chosen_top__colors_pixels_linearly),
        cmocka_unit_test(map__legend__is_a_bar_over_dark_text_on_white),
        cmocka_unit_test(map__narrow_picture__grows_for_its_legend),
        cmocka_unit_test(map__same_values__give_the_same_bytes),
        cmocka_unit_test(map__bad_size__is_a_usage_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
