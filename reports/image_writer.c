#include "reports/image_writer.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "reports/image_module_loader.h"
#include "lrbni/base/output_file.h"

enum { MAX_EXTENSION_BYTES = 15 };

/* Lower-case extension of a path; false if it has none or an impossibly long one. */
static bool extension_of(const char *path, char extension[MAX_EXTENSION_BYTES + 1])
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    size_t length = dot ? strlen(dot + 1) : 0;
    if (length == 0 || length > MAX_EXTENSION_BYTES)
        return false;
    for (size_t i = 0; i <= length; i++) {
        char c = dot[1 + i];
        extension[i] = (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
    return true;
}

static bool is_one_of(const char *extension, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(extension, *list) == 0)
            return true;
    return false;
}

/* Load the module, encode, and let the bytes replace the file. */
static base_status encode_to_file(const char *path, const report_image_job *job, base_error *err)
{
    report_image_encode_fn *encode;
    base_output output;
    unsigned char *bytes = NULL;
    size_t size = 0;
    /* The file first: a name that cannot be written is found before the work and without the module. */
    base_status status = base_output_begin(path, false, &output, err);
    if (status != BASE_OK)
        return status;
    status = report_image_module_load(&encode, err);
    if (status == BASE_OK)
        status = encode(job, &bytes, &size, err);
    if (status != BASE_OK) {
        base_output_abort(&output);
        return status;
    }
    fwrite(bytes, 1, size, output.stream);
    free(bytes);
    return base_output_commit(&output, err);
}

/* How a picture's channels go into a file: how many, and of what. */
typedef struct pixel_plan {
    int channels;
    bool linear;
    bool wide; /* grey in the image, RGB in the file */
} pixel_plan;

static pixel_plan plan_pixels(const char *extension, const report_image *image)
{
    static const char *const float_formats[] = {"exr", "hdr", "rgbe", "pfm", NULL};
    static const char *const grey_formats[] = {"exr", "png", "jpg", "jpeg", "tif", "tiff", "pgm", NULL};
    pixel_plan plan = {.channels = image->channels};
    plan.linear = is_one_of(extension, float_formats);
    plan.wide = image->channels == 1 && !is_one_of(extension, grey_formats);
    if (plan.wide || (image->channels == 4 && plan.linear && strcmp(extension, "exr") != 0))
        plan.channels = 3;
    return plan;
}

static void pack_floats(const report_image *image, const pixel_plan *plan, float *out)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < plan->channels; c++)
            *out++ = image->pixels[i * (size_t)image->channels + (plan->wide ? 0 : (size_t)c)];
}

/* 8 bits of alpha: linear, rounded to nearest. */
static uint8_t encode_alpha(float alpha)
{
    return alpha >= 1 ? 255 : alpha > 0 ? (uint8_t)(alpha * 255 + 0.5f) : 0;
}

static void pack_bytes(const report_image *image, const pixel_plan *plan, uint8_t *out)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    report_srgb_encoder encoder;
    report_srgb_encoder_init(&encoder);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < plan->channels; c++) {
            float sample = image->pixels[i * (size_t)image->channels + (plan->wide ? 0 : (size_t)c)];
            *out++ = c == 3 ? encode_alpha(sample) : report_srgb_encode(&encoder, sample);
        }
}

base_status report_image_write(const char *path, const report_image *image, base_error *err)
{
    static const char *const grey_names[] = {"Y"};
    static const char *const color_names[] = {"R", "G", "B", "A"};
    char extension[MAX_EXTENSION_BYTES + 1];
    if (!extension_of(path, extension))
        return base_fail(err, BASE_ERR_INPUT, path, "needs an extension that names a picture format, such as .png");
    pixel_plan plan = plan_pixels(extension, image);
    size_t samples = (size_t)image->width * (size_t)image->height * (size_t)plan.channels;
    void *packed = malloc(samples * (plan.linear ? sizeof(float) : 1));
    if (!packed)
        return base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
    if (plan.linear)
        pack_floats(image, &plan, packed);
    else
        pack_bytes(image, &plan, packed);
    report_sample kinds[4];
    for (int c = 0; c < 4; c++)
        kinds[c] = plan.linear ? REPORT_SAMPLE_FLOAT : REPORT_SAMPLE_U8;
    report_image_job job = {
        .name = path,
        .extension = extension,
        .width = image->width,
        .height = image->height,
        .channel_count = plan.channels,
        .channel_names = plan.channels == 1 ? grey_names : color_names,
        .channel_samples = kinds,
        .pixels = packed,
        .linear = plan.linear,
    };
    base_status status = encode_to_file(path, &job, err);
    free(packed);
    return status;
}

static base_status check_channels(int width, int height, const report_channel *channels, size_t count, base_error *err)
{
    if (width < 1 || height < 1 || width > REPORT_IMAGE_MAX_SIDE || height > REPORT_IMAGE_MAX_SIDE)
        return base_fail(err, BASE_ERR_USAGE, "per-pixel results", "%d x %d pixels: each side must be 1 to %d", width,
                         height, (int)REPORT_IMAGE_MAX_SIDE);
    if (count < 1 || count > 1000)
        return base_fail(err, BASE_ERR_USAGE, "per-pixel results", "%zu channels: must be 1 to 1000", count);
    for (size_t i = 0; i < count; i++) {
        if (!*channels[i].name)
            return base_fail(err, BASE_ERR_USAGE, "per-pixel results", "channel %zu has no name", i);
        for (size_t k = 0; k < i; k++)
            if (strcmp(channels[i].name, channels[k].name) == 0)
                return base_fail(err, BASE_ERR_USAGE, "per-pixel results", "two channels are called '%s'",
                                 channels[i].name);
    }
    return BASE_OK;
}

/* One pixel behind the other; float and uint32_t samples are 4 bytes alike. */
static void pack_channels(const report_channel *channels, size_t channel_count, size_t pixel_count, unsigned char *out)
{
    for (size_t c = 0; c < channel_count; c++) {
        const unsigned char *data = channels[c].data;
        for (size_t i = 0; i < pixel_count; i++)
            memcpy(out + (i * channel_count + c) * 4, data + i * 4, 4);
    }
}

base_status report_aov_write(const char *path, int width, int height, const report_channel *channels,
                             size_t channel_count, base_error *err)
{
    char extension[MAX_EXTENSION_BYTES + 1];
    if (!extension_of(path, extension) || strcmp(extension, "exr") != 0)
        return base_fail(err, BASE_ERR_INPUT, path, "per-pixel results are OpenEXR files: the name must end in .exr");
    base_status status = check_channels(width, height, channels, channel_count, err);
    if (status != BASE_OK)
        return status;
    size_t pixel_count = (size_t)width * (size_t)height;
    unsigned char *packed = malloc(pixel_count * channel_count * 4);
    const char **names = malloc(channel_count * sizeof *names);
    report_sample *samples = malloc(channel_count * sizeof *samples);
    if (packed && names && samples) {
        pack_channels(channels, channel_count, pixel_count, packed);
        for (size_t c = 0; c < channel_count; c++) {
            names[c] = channels[c].name;
            samples[c] = channels[c].kind == REPORT_CHANNEL_UINT ? REPORT_SAMPLE_UINT : REPORT_SAMPLE_FLOAT;
        }
        report_image_job job = {
            .name = path,
            .extension = extension,
            .width = width,
            .height = height,
            .channel_count = (int)channel_count,
            .channel_names = names,
            .channel_samples = samples,
            .pixels = packed,
            .linear = true,
        };
        status = encode_to_file(path, &job, err);
    } else {
        status = base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
    }
    free(packed);
    free(names);
    free(samples);
    return status;
}
