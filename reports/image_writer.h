/* Picture files out, in every format that OpenImageIO writes well (not JPEG 2000). OpenImageIO brings some 250 shared
   libraries and a third of a second of start-up, so it is reached through a module that is loaded when the first
   picture is written. */
#ifndef REPORTS_IMAGE_WRITER_H
#define REPORTS_IMAGE_WRITER_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "reports/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The module, lanetrace-image.so, is looked for in this order; the first that exists is taken:
 *   1. the directory in the environment variable LANETRACE_MODULE_PATH; if that is set, nowhere else
 *   2. the directory of the running program
 *   3. ../reports from there (a build tree)
 *   4. ../LIBDIR/lanetrace from there (an installed tree, also when moved)
 *   5. PREFIX/LIBDIR/lanetrace as configured
 * It stays loaded until the program ends. */

/**
 * Write a picture. The format follows from the name's extension. exr, hdr, rgbe and pfm files keep the linear floats
 * (hdr in its own shared-exponent form, hdr and pfm without alpha); all others get 8-bit sRGB codes, linear alpha,
 * values cut to 0..1, NaN as 0. Grey stays grey in exr, png, jpg, tif and pgm files and becomes RGB in others.
 *
 * Equal images and names give equal bytes: no date, no host name, no user is written. The date is fixed to
 * 1970:01:01 00:00:00 in formats in which OpenImageIO insists on one (exr, tif). Another version of OpenImageIO may
 * well write other bytes for the same pixels.
 *
 * Errors: BASE_ERR_INPUT naming the file (extension missing or unknown to OpenImageIO, a format that cannot hold
 * such a picture, no such directory, not writable), BASE_ERR_UNSUPPORTED (module missing, or built without option
 * 'images'), BASE_ERR_IO (disk full), BASE_ERR_NOMEM. A failure leaves an old file as it was.
 */
base_status report_image_write(const char *path, const report_image *image, base_error *err);

typedef enum report_channel_kind {
    REPORT_CHANNEL_FLOAT = 0, /* float: stored as such, infinities included */
    REPORT_CHANNEL_UINT       /* uint32_t */
} report_channel_kind;

typedef struct report_channel {
    const char *name; /* as in the file: "Z", "prim"; unique, not empty */
    report_channel_kind kind;
    const void *data; /* height * width values of that kind, rows from the top */
} report_channel;

/**
 * Write per-pixel results as an OpenEXR file with one float32 or uint32 channel each, compressed without loss.
 * OpenEXR keeps channels in its own order; readers find them by name.
 *
 * @param path  must end in .exr
 *
 * Errors: as report_image_write; BASE_ERR_USAGE for no channels, equal or empty names, a side out of range.
 */
base_status report_aov_write(const char *path, int width, int height, const report_channel *channels,
                             size_t channel_count, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
