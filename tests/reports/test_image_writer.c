/* Picture files, read back with OpenImageIO; and everything that can go wrong on the way. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "reports/image_writer.h"
#include "tests/base/files.h"
#include "tests/reports/picture_reader.h"

static int set_up(void **state)
{
    *state = files_make_directory();
    return 0;
}

static int tear_down(void **state)
{
    files_remove_directory(*state);
    return 0;
}

/* A picture with every 8-bit code in it, and with values outside 0..1. */
static report_image sample(int channels)
{
    report_image image;
    assert_int_equal(report_image_create(64, 8, channels, &image, NULL), BASE_OK);
    for (int i = 0; i < 64 * 8 * channels; i++)
        image.pixels[i] = (float)report_srgb_decode((i * 5 % 256) / 255.0);
    image.pixels[0] = 7.5f;
    image.pixels[channels] = -1;
    return image;
}

static picture read_back(const char *path)
{
    picture p;
    assert_true(picture_read(path, &p));
    return p;
}

static void png__rgb__holds_the_srgb_codes_from_the_top_left(void **state)
{
    char *path = files_path(*state, "a.png");
    report_image image = sample(3);
    report_srgb_encoder encoder;
    report_srgb_encoder_init(&encoder);
    assert_int_equal(report_image_write(path, &image, NULL), BASE_OK);
    picture p = read_back(path);
    assert_int_equal(p.width, 64);
    assert_int_equal(p.height, 8);
    assert_int_equal(p.channels, 3);
    assert_string_equal(p.types[0], "uint8");
    assert_string_equal(p.color_space, "sRGB");
    for (int i = 0; i < 64 * 8 * 3; i++)
        assert_true(p.samples[i] == report_srgb_encode(&encoder, image.pixels[i]));
    assert_true(p.samples[0] == 255 && p.samples[3] == 0);
    free(p.samples);
    report_image_destroy(&image);
    free(path);
}

static void png__grey_and_alpha__keep_their_channels(void **state)
{
    char *grey_path = files_path(*state, "grey.png"), *alpha_path = files_path(*state, "alpha.PNG");
    report_image grey = sample(1), alpha = sample(4);
    report_image_pixel(&alpha, 5, 5)[0] = 1; /* bright and nearly transparent: must not be multiplied */
    report_image_pixel(&alpha, 5, 5)[3] = 0.2f;
    assert_int_equal(report_image_write(grey_path, &grey, NULL), BASE_OK);
    assert_int_equal(report_image_write(alpha_path, &alpha, NULL), BASE_OK);
    picture p = read_back(grey_path);
    assert_int_equal(p.channels, 1);
    assert_true(p.samples[10] == 50);
    free(p.samples);
    p = read_back(alpha_path);
    assert_int_equal(p.channels, 4);
    assert_true(p.samples[(5 * 64 + 5) * 4 + 3] == 51);
    free(p.samples);
    report_image_destroy(&grey);
    report_image_destroy(&alpha);
    free(grey_path);
    free(alpha_path);
}

static void jpeg__smooth_picture__is_close(void **state)
{
    char *path = files_path(*state, "a.jpg");
    report_image image;
    assert_int_equal(report_image_create(64, 64, 3, &image, NULL), BASE_OK);
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++)
            for (int c = 0; c < 3; c++)
                report_image_pixel(&image, x, y)[c] = (float)report_srgb_decode((40 + 2 * y) / 255.0);
    assert_int_equal(report_image_write(path, &image, NULL), BASE_OK);
    picture p = read_back(path);
    assert_int_equal(p.channels, 3);
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++)
            assert_true(fabs(p.samples[(y * 64 + x) * 3] - (40 + 2 * y)) <= 4);
    free(p.samples);
    report_image_destroy(&image);
    free(path);
}

static void exr__all_channel_counts__keep_linear_floats_exactly(void **state)
{
    static const int counts[] = {1, 3, 4};
    char *path = files_path(*state, "a.exr");
    for (size_t k = 0; k < 3; k++) {
        report_image image = sample(counts[k]);
        assert_int_equal(report_image_write(path, &image, NULL), BASE_OK);
        picture p = read_back(path);
        assert_int_equal(p.channels, counts[k]);
        assert_string_equal(p.types[0], "float");
        for (int i = 0; i < 64 * 8 * counts[k]; i++)
            assert_true(p.samples[i] == (double)image.pixels[i]);
        free(p.samples);
        report_image_destroy(&image);
    }
    free(path);
}

static void hdr__grey_and_alpha__become_rgb_within_its_precision(void **state)
{
    static const int counts[] = {1, 3, 4};
    char *path = files_path(*state, "a.hdr");
    for (size_t k = 0; k < 3; k++) {
        report_image image;
        assert_int_equal(report_image_create(16, 4, counts[k], &image, NULL), BASE_OK);
        for (int i = 0; i < 16 * 4 * counts[k]; i++)
            image.pixels[i] = 3.5f;
        assert_int_equal(report_image_write(path, &image, NULL), BASE_OK);
        picture p = read_back(path);
        assert_int_equal(p.channels, 3);
        assert_true(fabs(p.samples[7] - 3.5) < 0.03);
        free(p.samples);
        report_image_destroy(&image);
    }
    free(path);
}

static void write__other_formats__are_8_bit(void **state)
{
    static const char *const names[] = {"a.tif", "a.pgm", "a.bmp", "a.tga", "a.sgi", "a.ppm", "a.webp", "a.gif"};
    enum { COUNT = sizeof names / sizeof *names };
    report_image image = sample(1);
    for (size_t i = 0; i < COUNT; i++) {
        char *path = files_path(*state, names[i]);
        base_error err;
        if (report_image_write(path, &image, &err) != BASE_OK)
            fail_msg("%s: %s", err.what, err.why);
        picture p = read_back(path);
        assert_int_equal(p.width, 64);
        assert_int_equal(p.channels, i < 2 ? 1 : i == COUNT - 1 ? 4 : 3); /* gif is always read with alpha */
        assert_string_equal(p.types[0], "uint8");
        assert_true(fabs(p.samples[p.channels * 10] - 50) <= 8); /* webp and gif lose some */
        free(p.samples);
        free(path);
    }
    report_image_destroy(&image);
}

static void assert_same_bytes(const char *first, const char *second)
{
    size_t first_size, second_size;
    char *a = files_read(first, &first_size), *b = files_read(second, &second_size);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(first_size, second_size);
    assert_memory_equal(a, b, first_size);
    free(a);
    free(b);
}

/* Long enough apart for a clock of whole seconds to have moved on. */
static void write__a_second_later__gives_the_same_bytes(void **state)
{
    static const char *const endings[] = {"png", "jpg", "exr", "hdr",  "tif",  "bmp", "tga",
                                          "sgi", "ppm", "gif", "webp", "dpx", "rla"};
    enum { COUNT = sizeof endings / sizeof *endings };
    report_image image = sample(3);
    char *first[COUNT], *second[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        char name[16];
        snprintf(name, sizeof name, "first.%s", endings[i]);
        first[i] = files_path(*state, name);
        snprintf(name, sizeof name, "other.%s", endings[i]);
        second[i] = files_path(*state, name);
        assert_int_equal(report_image_write(first[i], &image, NULL), BASE_OK);
    }
    usleep(1100000);
    for (size_t i = 0; i < COUNT; i++) {
        assert_int_equal(report_image_write(second[i], &image, NULL), BASE_OK);
        assert_same_bytes(first[i], second[i]);
        free(first[i]);
        free(second[i]);
    }
    report_image_destroy(&image);
}

static void write__png_and_exr__name_no_host_user_or_time(void **state)
{
    static const char *const names[] = {"a.png", "a.exr", "a.tif"};
    report_image image = sample(3);
    char host[256] = "";
    assert_int_equal(gethostname(host, sizeof host - 1), 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *path = files_path(*state, names[i]);
        size_t size;
        assert_int_equal(report_image_write(path, &image, NULL), BASE_OK);
        char *bytes = files_read(path, &size);
        if (strlen(host) > 3)
            assert_null(memmem(bytes, size, host, strlen(host)));
        assert_null(memmem(bytes, size, "HostComputer", 12));
        assert_null(memmem(bytes, size, *state, strlen(*state)));
        assert_null(memmem(bytes, size, "/proc", 5));
        free(bytes);
        picture p = read_back(path);
        assert_true(!*p.date || strcmp(p.date, "1970:01:01 00:00:00") == 0);
        free(p.samples);
        free(path);
    }
    report_image_destroy(&image);
}

enum { AOV_WIDTH = 17, AOV_HEIGHT = 5, AOV_PIXELS = AOV_WIDTH * AOV_HEIGHT };

static void aov__floats_and_integers__keep_type_and_bits(void **state)
{
    char *path = files_path(*state, "a.exr");
    float z[AOV_PIXELS], u[AOV_PIXELS], v[AOV_PIXELS];
    uint32_t prim[AOV_PIXELS];
    for (int i = 0; i < AOV_PIXELS; i++) {
        z[i] = i % 7 ? 1.0f / (float)(i + 1) : INFINITY;
        prim[i] = i % 7 ? 0x01000001u * (uint32_t)i + 1 : 0xffffffffu; /* more than 24 bits: no float holds these */
        u[i] = (float)i * 1e-3f;
        v[i] = -0.0f;
    }
    const report_channel channels[] = {
        {"Z", REPORT_CHANNEL_FLOAT, z},
        {"prim", REPORT_CHANNEL_UINT, prim},
        {"U", REPORT_CHANNEL_FLOAT, u},
        {"V", REPORT_CHANNEL_FLOAT, v},
    };
    assert_int_equal(report_aov_write(path, AOV_WIDTH, AOV_HEIGHT, channels, 4, NULL), BASE_OK);
    picture p = read_back(path);
    assert_int_equal(p.width, AOV_WIDTH);
    assert_int_equal(p.height, AOV_HEIGHT);
    assert_int_equal(p.channels, 4);
    int iz = picture_channel(&p, "Z"), ip = picture_channel(&p, "prim");
    int iu = picture_channel(&p, "U"), iv = picture_channel(&p, "V");
    assert_true(iz >= 0 && ip >= 0 && iu >= 0 && iv >= 0);
    assert_string_equal(p.types[iz], "float");
    assert_string_equal(p.types[ip], "uint");
    assert_string_equal(p.types[iu], "float");
    assert_string_equal(p.types[iv], "float");
    for (int i = 0; i < AOV_PIXELS; i++) {
        assert_true(p.samples[i * 4 + iz] == (double)z[i]);
        assert_true(p.samples[i * 4 + ip] == (double)prim[i]);
        assert_true(p.samples[i * 4 + iu] == (double)u[i]);
        assert_true(p.samples[i * 4 + iv] == 0 && signbit(p.samples[i * 4 + iv]));
    }
    free(p.samples);
    free(path);
}

static void aov__written_twice__gives_the_same_bytes(void **state)
{
    char *first = files_path(*state, "a.exr"), *second = files_path(*state, "b.exr");
    float data[AOV_PIXELS] = {1};
    const report_channel channel = {"visibility", REPORT_CHANNEL_FLOAT, data};
    assert_int_equal(report_aov_write(first, AOV_WIDTH, AOV_HEIGHT, &channel, 1, NULL), BASE_OK);
    usleep(1100000);
    assert_int_equal(report_aov_write(second, AOV_WIDTH, AOV_HEIGHT, &channel, 1, NULL), BASE_OK);
    assert_same_bytes(first, second);
    free(first);
    free(second);
}

static void aov__bad_arguments__are_refused(void **state)
{
    char *path = files_path(*state, "a.exr"), *png = files_path(*state, "a.png");
    float data[1] = {0};
    const report_channel twice[] = {{"Z", REPORT_CHANNEL_FLOAT, data}, {"Z", REPORT_CHANNEL_FLOAT, data}};
    const report_channel nameless = {"", REPORT_CHANNEL_FLOAT, data};
    base_error err;
    assert_int_equal(report_aov_write(png, 1, 1, twice, 1, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, png);
    assert_int_equal(report_aov_write(path, 1, 1, twice, 2, &err), BASE_ERR_USAGE);
    assert_int_equal(report_aov_write(path, 1, 1, &nameless, 1, &err), BASE_ERR_USAGE);
    assert_int_equal(report_aov_write(path, 1, 1, twice, 0, &err), BASE_ERR_USAGE);
    assert_int_equal(report_aov_write(path, 0, 1, twice, 1, &err), BASE_ERR_USAGE);
    assert_int_equal(files_count(*state), 0);
    free(path);
    free(png);
}

static void write__unknown_or_missing_extension__is_an_input_error(void **state)
{
    static const char *const names[] = {"a.nope", "a", ".png/", "a.", "a.null", "a.term", "a.jp2",
                                        "a.verylongextension"};
    report_image image = sample(3);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *path = files_path(*state, names[i]);
        base_error err;
        assert_int_equal(report_image_write(path, &image, &err), BASE_ERR_INPUT);
        assert_string_equal(err.what, path);
        assert_int_equal(base_exit_code(err.status), 2);
        free(path);
    }
    assert_int_equal(files_count(*state), 0);
    report_image_destroy(&image);
}

static void write__failure__keeps_the_old_file(void **state)
{
    char *path = files_path(*state, "a.nope");
    report_image image = sample(3);
    files_write(path, "old");
    assert_int_equal(report_image_write(path, &image, NULL), BASE_ERR_INPUT);
    char *text = files_read(path, NULL);
    assert_string_equal(text, "old");
    assert_int_equal(files_count(*state), 1);
    free(text);
    report_image_destroy(&image);
    free(path);
}

static void write__no_such_directory__is_an_input_error(void **state)
{
    char *path = files_path(*state, "none/a.png");
    report_image image = sample(3);
    base_error err;
    assert_int_equal(report_image_write(path, &image, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, path);
    report_image_destroy(&image);
    free(path);
}

static void write__full_device__is_an_io_error(void **state)
{
    char *path = files_path(*state, "full.png");
    report_image image = sample(3);
    base_error err;
    assert_int_equal(symlink("/dev/full", path), 0);
    assert_int_equal(report_image_write(path, &image, &err), BASE_ERR_IO);
    assert_string_equal(err.what, path);
    assert_int_equal(base_exit_code(err.status), 3);
    report_image_destroy(&image);
    free(path);
}

static void write__module_missing_or_wrong__is_unsupported(void **state)
{
    char *path = files_path(*state, "a.png"), *module = files_path(*state, "lanetrace-image.so");
    char *old = strdup(getenv("LANETRACE_MODULE_PATH"));
    report_image image = sample(3);
    base_error err;
    assert_int_equal(setenv("LANETRACE_MODULE_PATH", *state, 1), 0);
    assert_int_equal(report_image_write(path, &image, &err), BASE_ERR_UNSUPPORTED);
    assert_string_equal(err.what, "lanetrace-image.so");
    files_write(module, "no shared object");
    assert_int_equal(report_image_write(path, &image, &err), BASE_ERR_UNSUPPORTED);
    assert_string_equal(err.what, module);
    assert_int_equal(setenv("LANETRACE_MODULE_PATH", old, 1), 0);
    assert_int_equal(files_count(*state), 1);
    assert_int_equal(report_image_write(path, &image, &err), BASE_OK);
    report_image_destroy(&image);
    free(old);
    free(path);
    free(module);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(png__rgb__holds_the_srgb_codes_from_the_top_left),
        CASE(png__grey_and_alpha__keep_their_channels),
        CASE(jpeg__smooth_picture__is_close),
        CASE(exr__all_channel_counts__keep_linear_floats_exactly),
        CASE(hdr__grey_and_alpha__become_rgb_within_its_precision),
        CASE(write__other_formats__are_8_bit),
        CASE(write__a_second_later__gives_the_same_bytes),
        CASE(write__png_and_exr__name_no_host_user_or_time),
        CASE(aov__floats_and_integers__keep_type_and_bits),
        CASE(aov__written_twice__gives_the_same_bytes),
        CASE(aov__bad_arguments__are_refused),
        CASE(write__unknown_or_missing_extension__is_an_input_error),
        CASE(write__failure__keeps_the_old_file),
        CASE(write__no_such_directory__is_an_input_error),
        CASE(write__full_device__is_an_io_error),
        CASE(write__module_missing_or_wrong__is_unsupported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
