/* Pictures in memory: linear light, 32-bit floats. */
#ifndef REPORTS_IMAGE_H
#define REPORTS_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Rows from the top, pixels from the left, channels interleaved: sample c of (x, y) is
   pixels[((size_t)y * width + x) * channels + c]. 1 is black to white, but any value may be stored. */
typedef struct report_image {
    int width, height;
    int channels; /* 1 (grey), 3 (RGB) or 4 (RGBA; alpha is coverage, not premultiplied) */
    float *pixels; /* owned */
} report_image;

/** A linear RGB colour. */
typedef struct report_color {
    float r, g, b;
} report_color;

enum { REPORT_IMAGE_MAX_SIDE = 32768 };

/**
 * Make a black (and transparent) image. Errors: BASE_ERR_USAGE for a side outside 1..REPORT_IMAGE_MAX_SIDE or other
 * numbers of channels than 1, 3 and 4; BASE_ERR_NOMEM. On failure *out is zeroed.
 */
base_status report_image_create(int width, int height, int channels, report_image *out, base_error *err);

/** Free the pixels and zero the struct; safe on a zeroed one. */
void report_image_destroy(report_image *image);

/** The first sample of a pixel inside the image. */
static inline float *report_image_pixel(const report_image *image, int x, int y)
{
    return image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
}

/** Fill the part of a rectangle that lies inside the image. Grey images take the luminance; alpha becomes 1. */
void report_image_fill(report_image *image, int x, int y, int width, int height, report_color color);

/** Copy `from` with its top left at (x, y), cut at the edges. Grey becomes RGB as needed; the reverse is luminance. */
void report_image_copy(report_image *image, int x, int y, const report_image *from);

/**
 * Two pictures side by side on a middle grey ground, tops aligned, `gap` pixels between them; RGB.
 * Errors: as report_image_create.
 */
base_status report_image_beside(const report_image *left, const report_image *right, int gap, report_image *out,
                                base_error *err);

/**
 * Bring scene values into 0..1 in place: multiply by `exposure`, then compress with the extended curve of Reinhard et
 * al. (2002, "Photographic tone reproduction for digital images", eq. 4) on the luminance, so that luminance `white`
 * maps to 1. white <= 0: no curve. Alpha is left alone; samples above 1 are cut only by the 8-bit conversion.
 */
void report_image_tone_map(report_image *image, float exposure, float white);

/** Luminance of a linear RGB colour (BT.709 weights). */
float report_luminance(report_color color);

/**
 * The sRGB transfer curve (IEC 61966-2-1) without the C library's pow, so that equal pixels give equal bytes on every
 * host. Decoding takes a code value 0..1; encoding gives the 8-bit code whose decoded value is nearest on the
 * encoded scale; NaN and what is below 0 become 0, what is above 1 becomes 255.
 */
double report_srgb_decode(double code);

/* Code boundaries for the encoder: thresholds[i] is the least linear value whose code is i + 1. */
typedef struct report_srgb_encoder {
    double thresholds[255];
} report_srgb_encoder;

void report_srgb_encoder_init(report_srgb_encoder *encoder);
uint8_t report_srgb_encode(const report_srgb_encoder *encoder, float linear);

#ifdef __cplusplus
}
#endif
#endif
