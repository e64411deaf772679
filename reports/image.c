#include "reports/image.h"

#include <stdlib.h>

base_status report_image_create(int width, int height, int channels, report_image *out, base_error *err)
{
    *out = (report_image){0};
    if (width < 1 || height < 1 || width > REPORT_IMAGE_MAX_SIDE || height > REPORT_IMAGE_MAX_SIDE)
        return base_fail(err, BASE_ERR_USAGE, "image", "%d x %d pixels: each side must be 1 to %d", width, height,
                         (int)REPORT_IMAGE_MAX_SIDE);
    if (channels != 1 && channels != 3 && channels != 4)
        return base_fail(err, BASE_ERR_USAGE, "image", "%d channels: must be 1, 3 or 4", channels);
    float *pixels = calloc((size_t)width * (size_t)height, (size_t)channels * sizeof *pixels);
    if (!pixels)
        return base_fail(err, BASE_ERR_NOMEM, "image", "no memory for %d x %d pixels", width, height);
    *out = (report_image){.width = width, .height = height, .channels = channels, .pixels = pixels};
    return BASE_OK;
}

void report_image_destroy(report_image *image)
{
    free(image->pixels);
    *image = (report_image){0};
}

float report_luminance(report_color color)
{
    return 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b;
}

static report_color get_color(const report_image *image, const float *pixel)
{
    if (image->channels == 1)
        return (report_color){pixel[0], pixel[0], pixel[0]};
    return (report_color){pixel[0], pixel[1], pixel[2]};
}

static void put_color(const report_image *image, float *pixel, report_color color, float alpha)
{
    if (image->channels == 1) {
        pixel[0] = report_luminance(color);
        return;
    }
    pixel[0] = color.r;
    pixel[1] = color.g;
    pixel[2] = color.b;
    if (image->channels == 4)
        pixel[3] = alpha;
}

/* Ends of a span cut to [0, limit); 64 bits, so that no caller's numbers overflow. */
static void cut(int start, int length, int limit, int *first, int *end)
{
    int64_t stop = (int64_t)start + length;
    *first = start < 0 ? 0 : start;
    *end = stop > limit ? limit : stop < 0 ? 0 : (int)stop;
}

void report_image_fill(report_image *image, int x, int y, int width, int height, report_color color)
{
    int left, right, top, bottom;
    cut(x, width, image->width, &left, &right);
    cut(y, height, image->height, &top, &bottom);
    for (int j = top; j < bottom; j++)
        for (int i = left; i < right; i++)
            put_color(image, report_image_pixel(image, i, j), color, 1);
}

void report_image_copy(report_image *image, int x, int y, const report_image *from)
{
    int left, right, top, bottom;
    cut(x, from->width, image->width, &left, &right);
    cut(y, from->height, image->height, &top, &bottom);
    for (int j = top; j < bottom; j++)
        for (int i = left; i < right; i++) {
            const float *source = report_image_pixel(from, i - x, j - y);
            float *target = report_image_pixel(image, i, j);
            if (image->channels == 1 && from->channels == 1)
                *target = *source; /* not by way of the luminance, whose weights round */
            else
                put_color(image, target, get_color(from, source), from->channels == 4 ? source[3] : 1);
        }
}

base_status report_image_beside(const report_image *left, const report_image *right, int gap, report_image *out,
                                base_error *err)
{
    int64_t width = (int64_t)left->width + gap + right->width;
    int height = left->height > right->height ? left->height : right->height;
    if (gap < 0 || width > REPORT_IMAGE_MAX_SIDE)
        return base_fail(err, BASE_ERR_USAGE, "image", "two pictures with a gap of %d do not fit in %d pixels", gap,
                         (int)REPORT_IMAGE_MAX_SIDE);
    base_status status = report_image_create((int)width, height, 3, out, err);
    if (status != BASE_OK)
        return status;
    report_image_fill(out, 0, 0, (int)width, height, (report_color){0.2f, 0.2f, 0.2f});
    report_image_copy(out, 0, 0, left);
    report_image_copy(out, left->width + gap, 0, right);
    return BASE_OK;
}

void report_image_tone_map(report_image *image, float exposure, float white)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    int colors = image->channels == 4 ? 3 : image->channels;
    float inverse_white2 = white > 0 ? 1 / (white * white) : 0;
    for (size_t i = 0; i < count; i++) {
        float *pixel = image->pixels + i * (size_t)image->channels;
        for (int c = 0; c < colors; c++)
            pixel[c] *= exposure;
        float luminance = colors == 1 ? pixel[0] : report_luminance(get_color(image, pixel));
        if (!(white > 0 && luminance > 0))
            continue;
        float scale = (1 + luminance * inverse_white2) / (1 + luminance);
        for (int c = 0; c < colors; c++)
            pixel[c] *= scale;
    }
}

/* Fifth root of a number in (0, 1] by Newton's method: only operations that IEEE 754 fixes to the last bit. */
static double fifth_root(double a)
{
    double root = 1;
    for (int i = 0; i < 100; i++) {
        double root4 = root * root * root * root;
        double next = root - (root4 * root - a) / (5 * root4);
        if (next >= root) /* from above, the steps only stop shrinking at the last bits */
            return root;
        root = next;
    }
    return root;
}

double report_srgb_decode(double code)
{
    if (!(code > 0))
        return 0;
    if (code <= 0.04045)
        return code / 12.92;
    if (code >= 1)
        return 1;
    double base = (code + 0.055) / 1.055;
    return base * base * fifth_root(base * base); /* base to the power 2.4 */
}

void report_srgb_encoder_init(report_srgb_encoder *encoder)
{
    for (int i = 0; i < 255; i++)
        encoder->thresholds[i] = report_srgb_decode((i + 0.5) / 255);
}

uint8_t report_srgb_encode(const report_srgb_encoder *encoder, float linear)
{
    int low = 0, high = 255; /* the code lies in low..high; NaN fails every comparison and ends at 0 */
    while (low < high) {
        int middle = (low + high) / 2;
        if ((double)linear >= encoder->thresholds[middle])
            low = middle + 1;
        else
            high = middle;
    }
    return (uint8_t)low;
}
