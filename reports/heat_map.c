#include "reports/heat_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "reports/bitmap_font.h"
#include "reports/text.h"

enum {
    RAMP_STEPS = 1024, /* colours of a picture; finer than 8 bits can show */
    LEGEND_TEXT_BYTES = 160,
    SIZE_OF_LARGE_TEXT = 400 /* pixels of width for each further pixel of the font's dots */
};

/* Colours at equal steps, sRGB codes. Laid out in OKLCh: hue from violet (275 degrees) through red to yellow (105),
   chroma as large as the sRGB gamut allows below a smooth bound, and the lightness for which L* is 2 to 97 in equal
   steps. */
static const uint8_t ramp_points[][3] = {
    {5, 1, 43},    {31, 2, 77},   {56, 3, 93},   {83, 5, 104},  {112, 7, 109},  {141, 10, 109},
    {170, 14, 104}, {200, 18, 94}, {231, 21, 75}, {249, 58, 50}, {252, 98, 38},  {253, 130, 44},
    {253, 158, 61}, {253, 183, 84}, {252, 206, 113}, {247, 229, 164}, {249, 248, 222},
};

static const report_color no_value = {0.09f, 0.13f, 0.17f};
static const report_color paper = {1, 1, 1};
static const report_color ink = {0.01f, 0.01f, 0.01f};

report_color report_heat_color(double value)
{
    const int last = (int)(sizeof ramp_points / sizeof *ramp_points) - 1;
    if (isnan(value))
        return no_value;
    double place = value <= 0 ? 0 : value >= 1 ? last : value * last;
    int below = place >= last ? last - 1 : (int)place;
    double part = place - below;
    float linear[3];
    for (int c = 0; c < 3; c++) {
        double code = ramp_points[below][c] * (1 - part) + ramp_points[below + 1][c] * part;
        linear[c] = (float)report_srgb_decode(code / 255);
    }
    return (report_color){linear[0], linear[1], linear[2]};
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

base_status report_heat_top(const double *values, size_t count, double *top, base_error *err)
{
    double *sorted = malloc((count ? count : 1) * sizeof *sorted);
    size_t finite = 0;
    if (!sorted)
        return base_fail(err, BASE_ERR_NOMEM, "heat map", "out of memory");
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            sorted[finite++] = values[i];
    qsort(sorted, finite, sizeof *sorted, compare_doubles);
    *top = 1;
    if (finite) {
        size_t above = finite / 200; /* nearest rank: one value in 200 lies beyond it */
        double percentile = sorted[finite - 1 - above];
        double most = sorted[finite - 1];
        *top = percentile > 0 ? percentile : most > 0 ? most : 1;
    }
    free(sorted);
    return BASE_OK;
}

/* Sizes and texts of the legend: a bar, then the numbers, then the label. All in pixels. */
typedef struct legend {
    char zero[8], top[LEGEND_TEXT_BYTES], caption[LEGEND_TEXT_BYTES];
    int scale;  /* of the font */
    int margin; /* around everything */
    int bar_height, line_height;
    int width_needed, height;
} legend;

/* A legend's number: whole if it is whole or large, else three significant digits or so. */
static void format_value(char *text, size_t size, double value, const char *suffix)
{
    char number[REPORT_NUMBER_BYTES];
    int decimals = value == trunc(value) || value >= 1000 ? 0 : value >= 100 ? 1 : value >= 1 ? 2 : 4;
    report_format_real(number, value, decimals, true);
    snprintf(text, size, "%.*s%s", LEGEND_TEXT_BYTES - 16, number, suffix);
}

static void legend_measure(legend *l, int scale)
{
    int gap = 2 * REPORT_GLYPH_ADVANCE * scale;
    int numbers = report_font_width(l->zero, scale) + gap + report_font_width(l->top, scale);
    int caption = report_font_width(l->caption, scale);
    l->scale = scale;
    l->margin = 4 * scale;
    l->bar_height = 8 * scale;
    l->line_height = (REPORT_GLYPH_HEIGHT + 2) * scale;
    l->width_needed = (numbers > caption ? numbers : caption) + 2 * l->margin;
    l->height = l->bar_height + l->line_height * (*l->caption ? 2 : 1) + 2 * l->margin;
}

static void legend_init(legend *l, double top, double most, const char *label, int map_width)
{
    char most_text[LEGEND_TEXT_BYTES];
    *l = (legend){.zero = "0"};
    format_value(l->top, sizeof l->top, top, most > top ? "+" : "");
    format_value(most_text, sizeof most_text, most, "");
    if (label && most > top)
        snprintf(l->caption, sizeof l->caption, "%.60s, max %.80s", label, most_text);
    else if (label)
        snprintf(l->caption, sizeof l->caption, "%.100s", label);
    else if (most > top)
        snprintf(l->caption, sizeof l->caption, "max %.100s", most_text);
    /* Two pixels a dot are easy to read, so that is tried on small pictures too. */
    int scale = map_width / SIZE_OF_LARGE_TEXT > 2 ? map_width / SIZE_OF_LARGE_TEXT : 2;
    do
        legend_measure(l, scale);
    while (l->width_needed > map_width && scale-- > 1);
}

static void legend_draw(const legend *l, report_image *image, int y, int width)
{
    int left = l->margin, right = width - l->margin;
    int text_y = y + l->margin + l->bar_height + 3 * l->scale;
    for (int x = left; x < right; x++) {
        double value = right - left > 1 ? (double)(x - left) / (right - left - 1) : 0;
        report_image_fill(image, x, y + l->margin, 1, l->bar_height, report_heat_color(value));
    }
    report_font_draw(image, left, text_y, l->scale, l->zero, ink);
    report_font_draw(image, right - report_font_width(l->top, l->scale), text_y, l->scale, l->top, ink);
    int caption_x = left + (right - left - report_font_width(l->caption, l->scale)) / 2;
    report_font_draw(image, caption_x, text_y + l->line_height, l->scale, l->caption, ink);
}

static void map_draw(const double *values, int width, int height, double top, report_image *image)
{
    report_color ramp[RAMP_STEPS];
    for (int i = 0; i < RAMP_STEPS; i++)
        ramp[i] = report_heat_color((double)i / (RAMP_STEPS - 1));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double value = values[(size_t)y * (size_t)width + (size_t)x];
            double part = value / top;
            report_color color = no_value;
            if (isfinite(value))
                color = ramp[part >= 1 ? RAMP_STEPS - 1 : part <= 0 ? 0 : (int)(part * (RAMP_STEPS - 1) + 0.5)];
            float *pixel = report_image_pixel(image, x, y);
            pixel[0] = color.r;
            pixel[1] = color.g;
            pixel[2] = color.b;
        }
}

base_status report_heat_map_create(const double *values, int width, int height, const report_heat_options *options,
                                   report_image *out, base_error *err)
{
    *out = (report_image){0};
    if (width < 1 || height < 1 || width > REPORT_IMAGE_MAX_SIDE || height > REPORT_IMAGE_MAX_SIDE)
        return base_fail(err, BASE_ERR_USAGE, "heat map", "%d x %d pixels: each side must be 1 to %d", width, height,
                         (int)REPORT_IMAGE_MAX_SIDE);
    size_t count = (size_t)width * (size_t)height;
    double top = options ? options->top : 0, most = 0;
    base_status status = isfinite(top) && top > 0 ? BASE_OK : report_heat_top(values, count, &top, err);
    if (status != BASE_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]) && values[i] > most)
            most = values[i];
    legend l;
    legend_init(&l, top, most, options ? options->label : NULL, width);
    int full_width = l.width_needed > width ? l.width_needed : width;
    status = report_image_create(full_width, height + l.height, 3, out, err);
    if (status != BASE_OK)
        return status;
    report_image_fill(out, 0, 0, full_width, height + l.height, paper);
    map_draw(values, width, height, top, out);
    legend_draw(&l, out, height, full_width);
    return BASE_OK;
}
