/* Between the image writer and the loadable module that knows OpenImageIO: pixels in, the bytes of a file out. */
#ifndef REPORTS_IMAGE_MODULE_H
#define REPORTS_IMAGE_MODULE_H

#include <stddef.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum report_sample {
    REPORT_SAMPLE_U8 = 0, /* sRGB code, or linear alpha */
    REPORT_SAMPLE_FLOAT,
    REPORT_SAMPLE_UINT
} report_sample;

typedef struct report_image_job {
    const char *name;      /* the final file name: its extension chooses the format, errors name it */
    const char *extension; /* part of `name` behind the last dot */
    int width, height;
    int channel_count;
    const char *const *channel_names;
    const report_sample *channel_samples;
    const void *pixels;   /* packed: each pixel's samples one behind the other, each of its own size */
    int linear;           /* whether colours are linear light, else sRGB codes */
} report_image_job;

/**
 * Encode a picture into memory.
 *
 * @param bytes  out, owned by the caller: free()
 * @param size   out, number of bytes
 * Errors: BASE_ERR_INPUT naming job->name (format unknown, or it cannot hold this), BASE_ERR_NOMEM, BASE_ERR_IO.
 */
typedef base_status report_image_encode_fn(const report_image_job *job, unsigned char **bytes, size_t *size,
                                           base_error *err);

#define REPORT_IMAGE_MODULE_FILE "lanetrace-image.so"

/* Carries a number that rises when the struct or the function changes, so that an old module is not called. */
#define REPORT_IMAGE_ENCODE_SYMBOL "lanetrace_image_encode_1"

#ifdef __cplusplus
}
#endif
#endif
