/* Pictures in memory: the sRGB curve, tone mapping, drawing, the font. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "reports/bitmap_font.h"
#include "reports/image.h"

static void assert_close(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g and %.17g differ by more than %g", a, b, tolerance);
}

static void create__bad_sizes__are_usage_errors(void **state)
{
    (void)state;
    static const int sizes[][3] = {{0, 1, 3}, {1, 0, 3}, {-1, 5, 3}, {40000, 1, 3}, {1, 40000, 1}, {4, 4, 2},
                                   {4, 4, 5}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        report_image image;
        base_error err;
        assert_int_equal(report_image_create(sizes[i][0], sizes[i][1], sizes[i][2], &image, &err), BASE_ERR_USAGE);
        assert_null(image.pixels);
        report_image_destroy(&image);
    }
}

static void srgb_decode__whole_scale__agrees_with_pow(void **state)
{
    (void)state;
    double before = -1;
    for (int i = 0; i <= 4096; i++) {
        double code = i / 4096.0;
        double expected = code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
        double value = report_srgb_decode(code);
        assert_close(value, expected, 4e-16 * (1 + 4 * expected));
        assert_true(value > before);
        before = value;
    }
    assert_true(report_srgb_decode(0) == 0 && report_srgb_decode(1) == 1);
    assert_true(report_srgb_decode(-1) == 0 && report_srgb_decode(2) == 1 && report_srgb_decode((double)NAN) == 0);
}

static void srgb_encode__every_code__comes_back(void **state)
{
    (void)state;
    report_srgb_encoder encoder;
    report_srgb_encoder_init(&encoder);
    for (int code = 0; code < 256; code++)
        assert_int_equal(report_srgb_encode(&encoder, (float)report_srgb_decode(code / 255.0)), code);
}

static void srgb_encode__around_each_threshold__changes_there(void **state)
{
    (void)state;
    report_srgb_encoder encoder;
    report_srgb_encoder_init(&encoder);
    for (int i = 0; i < 255; i++) {
        float at = (float)encoder.thresholds[i];
        if ((double)at < encoder.thresholds[i])
            at = nextafterf(at, 2);
        assert_int_equal(report_srgb_encode(&encoder, at), i + 1);
        assert_int_equal(report_srgb_encode(&encoder, nextafterf(at, 0)), i);
        double exact = at <= 0.0031308f ? 12.92 * (double)at : 1.055 * pow((double)at, 1 / 2.4) - 0.055;
        assert_close(exact * 255, i + 0.5, 2e-4); /* the standard's two pieces do not quite meet */
    }
}

static void srgb_encode__odd_values__are_cut(void **state)
{
    (void)state;
    report_srgb_encoder encoder;
    report_srgb_encoder_init(&encoder);
    assert_int_equal(report_srgb_encode(&encoder, NAN), 0);
    assert_int_equal(report_srgb_encode(&encoder, -INFINITY), 0);
    assert_int_equal(report_srgb_encode(&encoder, -0.5f), 0);
    assert_int_equal(report_srgb_encode(&encoder, 1), 255);
    assert_int_equal(report_srgb_encode(&encoder, INFINITY), 255);
}

static void tone_map__white_point__maps_to_one_and_keeps_hue(void **state)
{
    (void)state;
    report_image image;
    assert_int_equal(report_image_create(3, 1, 4, &image, NULL), BASE_OK);
    static const float source[12] = {2, 2, 2, 0.5f, 1, 0.5f, 0.25f, 1, 0, 0, 0, 1};
    memcpy(image.pixels, source, sizeof source);
    report_image_tone_map(&image, 2, 4);
    assert_close((double)image.pixels[0], 1, 1e-6); /* 2 * 2 is the white point */
    assert_true(image.pixels[3] == 0.5f);
    assert_close((double)(image.pixels[5] / image.pixels[4]), 0.5, 1e-6);
    assert_close((double)(image.pixels[6] / image.pixels[4]), 0.25, 1e-6);
    assert_true(image.pixels[8] == 0 && image.pixels[9] == 0);
    report_image_tone_map(&image, 0.5f, 0);
    assert_close((double)image.pixels[0], 0.5, 1e-6);
    report_image_destroy(&image);
}

static void fill__across_the_edges__touches_only_the_inside(void **state)
{
    (void)state;
    report_image image;
    assert_int_equal(report_image_create(4, 3, 3, &image, NULL), BASE_OK);
    report_image_fill(&image, 2, -5, 100, 7, (report_color){1, 0.5f, 0.25f});
    report_image_fill(&image, 2147483647, 0, 2147483647, 5, (report_color){9, 9, 9});
    report_image_fill(&image, -10, 0, 3, 5, (report_color){9, 9, 9});
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 4; x++)
            assert_true(report_image_pixel(&image, x, y)[1] == (x >= 2 && y < 2 ? 0.5f : 0));
    report_image_destroy(&image);
}

static void beside__grey_and_color__are_placed_with_a_gap(void **state)
{
    (void)state;
    report_image left, right, both;
    assert_int_equal(report_image_create(2, 3, 1, &left, NULL), BASE_OK);
    assert_int_equal(report_image_create(1, 1, 4, &right, NULL), BASE_OK);
    report_image_pixel(&left, 1, 2)[0] = 0.75f;
    report_image_pixel(&right, 0, 0)[2] = 0.5f;
    assert_int_equal(report_image_beside(&left, &right, 2, &both, NULL), BASE_OK);
    assert_int_equal(both.width, 5);
    assert_int_equal(both.height, 3);
    assert_int_equal(both.channels, 3);
    for (int c = 0; c < 3; c++)
        assert_true(report_image_pixel(&both, 1, 2)[c] == 0.75f);
    assert_true(report_image_pixel(&both, 4, 0)[2] == 0.5f && report_image_pixel(&both, 4, 0)[0] == 0);
    assert_true(report_image_pixel(&both, 3, 0)[0] == 0.2f && report_image_pixel(&both, 4, 1)[0] == 0.2f);
    report_image_destroy(&both);
    assert_int_equal(report_image_beside(&left, &right, -1, &both, NULL), BASE_ERR_USAGE);
    assert_int_equal(report_image_beside(&left, &right, 32768, &both, NULL), BASE_ERR_USAGE);
    report_image_destroy(&left);
    report_image_destroy(&right);
}

/* The ink of a character at scale 1 as 35 bits. */
static uint64_t ink_of(char character)
{
    report_image image;
    char text[2] = {character, '\0'};
    uint64_t bits = 0;
    assert_int_equal(report_image_create(REPORT_GLYPH_WIDTH, REPORT_GLYPH_HEIGHT, 1, &image, NULL), BASE_OK);
    report_font_draw(&image, 0, 0, 1, text, (report_color){1, 1, 1});
    for (int i = 0; i < REPORT_GLYPH_WIDTH * REPORT_GLYPH_HEIGHT; i++)
        bits = bits << 1 | (image.pixels[i] > 0);
    report_image_destroy(&image);
    return bits;
}

static void font__all_glyphs__differ_from_each_other(void **state)
{
    (void)state;
    static const char all[] = "0123456789 .,:+-_%/()=<>abcdefghijklmnopqrstuvwxyz";
    for (size_t i = 0; i + 1 < sizeof all; i++) {
        assert_true(report_font_has(all[i]));
        assert_int_not_equal(ink_of(all[i]), ink_of('?'));
        for (size_t k = 0; k < i; k++)
            assert_int_not_equal(ink_of(all[i]), ink_of(all[k]));
    }
    assert_true(report_font_has('Q'));
    assert_int_equal(ink_of('Q'), ink_of('q'));
    assert_false(report_font_has('?'));
}

static void font__scaled_text__covers_its_width_and_no_more(void **state)
{
    (void)state;
    report_image image;
    int width = report_font_width("88", 3);
    assert_int_equal(width, 3 * 11);
    assert_int_equal(report_font_width("", 3), 0);
    assert_int_equal(report_image_create(60, 40, 1, &image, NULL), BASE_OK);
    report_font_draw(&image, 5, 7, 3, "88", (report_color){1, 1, 1});
    int left = 60, right = -1, top = 40, bottom = -1;
    for (int y = 0; y < 40; y++)
        for (int x = 0; x < 60; x++)
            if (*report_image_pixel(&image, x, y) > 0) {
                left = x < left ? x : left;
                right = x > right ? x : right;
                top = y < top ? y : top;
                bottom = y > bottom ? y : bottom;
            }
    assert_int_equal(left, 5);
    assert_int_equal(right, 5 + width - 1);
    assert_int_equal(top, 7);
    assert_int_equal(bottom, 7 + 21 - 1);
    report_image_destroy(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create__bad_sizes__are_usage_errors),
        cmocka_unit_test(srgb_decode__whole_scale__agrees_with_pow),
        cmocka_unit_test(srgb_encode__every_code__comes_back),
        cmocka_unit_test(srgb_encode__around_each_threshold__changes_there),
        cmocka_unit_test(srgb_encode__odd_values__are_cut),
        cmocka_unit_test(tone_map__white_point__maps_to_one_and_keeps_hue),
        cmocka_unit_test(fill__across_the_edges__touches_only_the_inside),
        cmocka_unit_test(beside__grey_and_color__are_placed_with_a_gap),
        cmocka_unit_test(font__all_glyphs__differ_from_each_other),
        cmocka_unit_test(font__scaled_text__covers_its_width_and_no_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
