/* Suite mlrta-adaptive: samples by the complexity that tiles see (Reshetov, Soupikov and Hurley 2005, 4.2 and 5).
 *
 * A tile of 8x8 pixels gets 1/4, 1, 4 or 16 samples a pixel. Each rate is one run of mlrta-primary over the whole picture, with initial
 * tiles that are the smaller the fewer its rays; a picture whose tiles have different rates costs what its tiles do. The issue model
 * times each unit of work by itself, so that is a sum; what a unit does for several tiles is shared out among them. Complexity
 * is that of the entry point which is searched for the tile at one sample a pixel.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/picture.h"
#include "cli/suites/mlrta_runs.h"
#include "reports/heat_map.h"
#include "reports/views/mlrta_adaptive.h"

enum { TILE = 8, REFERENCE = 8, ONE_SAMPLE = 1, FOUR_SAMPLES = 2 }; /* edges in pixels, in samples; rates */
enum { PICTURES = 3 };

typedef char paths[PICTURES][SUITE_PATH_BYTES];
static const char *const captions[PICTURES] = {
    "As good as four samples in every pixel, with samples by complexity, the best steps.",
    "Complexity: nodes of the subtree that a tile of 8x8 pixels is traced from, on a scale of doublings.",
    "Samples of the first picture: the brighter, the more, from 1/4 to 16 a pixel.",
};

/* Initial tiles of 16, 16, 32 and 128 rays an edge; with one sample they are split into the tiles, with others as by default. */
static const unsigned its_of_rate[MLRTA_RATES] = {0, 0, 1, 3};

typedef struct measured {
    mlrta_adaptive_scene *scenes;
    size_t count;
    paths *pictures; /* by scene */
} measured;

/* One scene at work. */
typedef struct work {
    const suite *s;
    mlrta_adaptive_scene *to;
    report_image rate[MLRTA_RATES], reference; /* of the picture's size */
    double *complexity; /* by pixel */
} work;

static size_t tile_of(const suite *s, unsigned x, unsigned y) { return y / TILE * ((s->width + TILE - 1) / TILE) + x / TILE; }

/* A run's picture at the suite's size: means of squares of pixels, or of a coarser one the pixel itself. */
static base_status resample(const suite *s, const run_result *run, report_image *out, base_error *err)
{
    report_image fine = {0};
    const unsigned samples = run->options.width > s->width ? run->options.width / s->width : 1;
    base_status status = picture_shaded(run, &fine, err);
    if (status == BASE_OK)
        status = report_image_create((int)s->width, (int)s->height, 3, out, err);
    for (unsigned i = 0; status == BASE_OK && i < s->width * s->height; i++) {
        const unsigned x = i % s->width, y = i / s->width;
        const unsigned x0 = (unsigned)((size_t)x * run->options.width / s->width), y0 = (unsigned)((size_t)y * run->options.height / s->height);
        double sum[3] = {0, 0, 0};
        for (unsigned k = 0; k < samples * samples; k++)
            for (int channel = 0; channel < 3; channel++)
                sum[channel] += (double)report_image_pixel(&fine, (int)(x0 + k % samples), (int)(y0 + k / samples))[channel];
        for (int channel = 0; channel < 3; channel++)
            report_image_pixel(out, (int)x, (int)y)[channel] = (float)(sum[channel] / (samples * samples));
    }
    report_image_destroy(&fine);
    return status;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median over a tile's pixels: of a tile whose rays have one octant they are all the same. */
static double median_of_tile(const work *w, unsigned x0, unsigned y0)
{
    double values[TILE * TILE];
    size_t count = 0;
    for (unsigned y = y0; y < y0 + TILE && y < w->s->height; y++)
        for (unsigned x = x0; x < x0 + TILE && x < w->s->width; x++)
            values[count++] = w->complexity[(size_t)y * w->s->width + x];
    qsort(values, count, sizeof *values, ascending);
    return values[count / 2];
}

static void take_complexity(work *w, const run_result *run)
{
    for (unsigned i = 0; i < w->s->width * w->s->height; i++)
        w->complexity[i] = kernel_job_complexity(run->job, i % w->s->width, i / w->s->width);
    for (unsigned y = 0; y < w->s->height; y += TILE)
        for (unsigned x = 0; x < w->s->width; x += TILE)
            w->to->tiles[tile_of(w->s, x, y)].complexity = median_of_tile(w, x, y);
}

/* Run with 2^rate / 2 samples an edge, and take what each unit of work cost. */
static base_status measure_rate(const suite_scene *on, work *w, int rate, base_error *err)
{
    run_options options = suite_run_options(w->s, kernel_find("mlrta-primary"), RUN_ISSUE);
    run_result run = {0};
    options.width = (w->s->width << rate) / 2;
    options.height = (w->s->height << rate) / 2;
    options.params.its = its_of_rate[rate];
    if (rate == ONE_SAMPLE) {
        options.params.sf = 0;  /* into four */
        options.params.mts = 1; /* of 8 rays an edge */
    }
    base_status status = run_kernel(on->scene, w->s->options->machine, &options, &run, err);
    for (unsigned y = 0; status == BASE_OK && y < options.height; y++)
        for (unsigned x = 0; x < options.width; x++) {
            mlrta_adaptive_tile *tile = &w->to->tiles[tile_of(w->s, 2 * x >> rate, 2 * y >> rate)];
            tile->rays[rate]++;
            tile->cycles[rate] += run_pixel_cycles(&run, x, y);
        }
    if (status == BASE_OK && rate == ONE_SAMPLE)
        take_complexity(w, &run);
    if (status == BASE_OK)
        status = resample(w->s, &run, &w->rate[rate], err);
    run_result_destroy(&run);
    return status;
}

static base_status make_reference(const suite_scene *on, work *w, base_error *err)
{
    run_options options = suite_run_options(w->s, kernel_find("mlrta-primary"), RUN_NATIVE);
    run_result run = {0};
    options.width = REFERENCE * w->s->width;
    options.height = REFERENCE * w->s->height;
    base_status status = run_kernel(on->scene, w->s->options->machine, &options, &run, err);
    if (status == BASE_OK)
        status = resample(w->s, &run, &w->reference, err);
    run_result_destroy(&run);
    return status;
}

static void judge(work *w)
{
    for (unsigned y = 0; y < w->s->height; y++)
        for (unsigned x = 0; x < w->s->width; x++)
            for (int rate = 0; rate < MLRTA_RATES; rate++)
                for (int channel = 0; channel < 3; channel++) {
                    const double difference = (double)report_image_pixel(&w->rate[rate], (int)x, (int)y)[channel] -
                                              (double)report_image_pixel(&w->reference, (int)x, (int)y)[channel];
                    w->to->tiles[tile_of(w->s, x, y)].error[rate] += difference * difference;
                }
}

/* Doublings of a number above 0, linear between powers of two: the same on every host. */
static double doublings(double value)
{
    int exponent;
    const double part = frexp(1 + value, &exponent); /* 1/2 <= part < 1 */
    return exponent - 1 + (2 * part - 1);
}

/* The picture with each tile's samples, or a quarter of it and the samples as colours. */
static base_status draw(const work *w, bool rates, report_image *out, base_error *err)
{
    base_status status = report_image_create((int)w->s->width, (int)w->s->height, 3, out, err);
    for (unsigned i = 0; status == BASE_OK && i < w->s->width * w->s->height; i++) {
        const int x = (int)(i % w->s->width), y = (int)(i / w->s->width);
        const int rate = w->to->rates[tile_of(w->s, (unsigned)x, (unsigned)y)];
        const report_color color = report_heat_color((rate + 1.0) / MLRTA_RATES);
        const float tint[3] = {color.r, color.g, color.b};
        for (int channel = 0; channel < 3; channel++) {
            const float seen = report_image_pixel(&w->rate[rate], x, y)[channel];
            report_image_pixel(out, x, y)[channel] = rates ? 0.25f * seen + 0.75f * tint[channel] : seen;
        }
    }
    return status;
}

static base_status draw_complexity(const work *w, report_image *out, base_error *err)
{
    const size_t pixels = (size_t)w->s->width * w->s->height;
    const report_heat_options options = {.label = "doublings of the nodes"};
    double *values = malloc(pixels * sizeof *values);
    if (!values)
        return base_fail(err, BASE_ERR_NOMEM, w->s->info->name, "out of memory");
    for (size_t i = 0; i < pixels; i++)
        values[i] = doublings(w->complexity[i]);
    base_status status = report_heat_map_create(values, (int)w->s->width, (int)w->s->height, &options, out, err);
    free(values);
    return status;
}

static base_status write_pictures(const suite_scene *on, const work *w, paths to, base_error *err)
{
    static const char *const rest[PICTURES] = {"-mlrta-adaptive.png", "-mlrta-complexity.png", "-mlrta-samples.png"};
    (void)mlrta_choose_samples(w->to, MLRTA_BY_STEPS, FOUR_SAMPLES);
    base_status status = BASE_OK;
    for (int i = 0; status == BASE_OK && i < PICTURES; i++) {
        report_image image = {0};
        suite_path(w->s, to[i], on->stem, rest[i]);
        status = i == 1 ? draw_complexity(w, &image, err) : draw(w, i == 2, &image, err);
        status = suite_write_picture(to[i], status, &image, err);
    }
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    work w = {.s = s, .to = &m->scenes[m->count], .complexity = calloc((size_t)s->width * s->height, sizeof *w.complexity)};
    *w.to = (mlrta_adaptive_scene){.name = on->name, .pixels = (double)s->width * s->height,
                                   .count = tile_of(s, s->width - 1, s->height - 1) + 1};
    w.to->tiles = calloc(w.to->count, sizeof *w.to->tiles);
    w.to->rates = calloc(w.to->count, 1);
    base_status status = w.complexity && w.to->tiles && w.to->rates ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    for (int rate = 0; status == BASE_OK && rate < MLRTA_RATES; rate++)
        status = measure_rate(on, &w, rate, err);
    if (status == BASE_OK)
        status = make_reference(on, &w, err);
    if (status == BASE_OK)
        judge(&w);
    if (status == BASE_OK && !s->options->no_pictures)
        status = write_pictures(on, &w, m->pictures[m->count], err);
    for (int rate = 0; rate < MLRTA_RATES; rate++)
        report_image_destroy(&w.rate[rate]);
    report_image_destroy(&w.reference);
    free(w.complexity);
    m->count++;
    return status;
}

static base_status add_figures(suite *s, const measured *m, base_error *err)
{
    base_status status = BASE_OK;
    report_page_add_heading(s->page, 1, "Pictures");
    for (size_t i = 0; status == BASE_OK && i < m->count; i++) {
        mlrta_adaptive_plot curves;
        report_figure figures[PICTURES];
        char suffix[40];
        for (int p = 0; p < PICTURES; p++)
            figures[p] = (report_figure){m->pictures[i][p], "rendered picture", captions[p]};
        report_page_add_heading(s->page, 2, s->scenes[i].name);
        status = report_page_add_pictures(s->page, figures, PICTURES, err);
        mlrta_adaptive_plot_of(&m->scenes[i], &curves);
        snprintf(suffix, sizeof suffix, "-%zu", i + 1);
        const report_plot plot = {curves.title, {"rays a pixel", true}, {"RMSE against 64 samples a pixel", true}, curves.series, MLRTA_ADAPTIVE_CURVES};
        if (status == BASE_OK)
            status = suite_add_plot(s, suffix, &plot, "The lower left is where one wants to be.", err);
    }
    return status;
}

static base_status check_size(const suite *s, base_error *err)
{
    if (s->width % 2 || s->height % 2 || s->width > JOB_MAX_SIZE / REFERENCE || s->height > JOB_MAX_SIZE / REFERENCE)
        return base_fail(err, BASE_ERR_USAGE, "--size", "%ux%u: suite %s needs even numbers up to %u", s->width, s->height, s->info->name,
                         JOB_MAX_SIZE / REFERENCE);
    return BASE_OK;
}

static base_status measure(suite *s, base_error *err)
{
    char caption[300];
    measured m = {.scenes = calloc(s->scene_count, sizeof *m.scenes), .pictures = calloc(s->scene_count, sizeof *m.pictures)};
    base_status status = m.scenes && m.pictures ? check_size(s, err) : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    snprintf(caption, sizeof caption, "%ux%u pixels, kernel mlrta-primary, machine %s, issue model; tiles of %dx%d pixels have 1/4, 1, 4 or 16 "
                                      "samples a pixel. Errors are of linear colours, 0 to 1, against 64 samples a pixel.",
             s->width, s->height, s->options->machine->name, TILE, TILE);
    report_page_add_heading(s->page, 1, "Table");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_adaptive_table(m.scenes, m.count, caption), err);
    if (status == BASE_OK && !s->options->no_pictures)
        status = add_figures(s, &m, err);
    for (size_t i = 0; m.scenes && i < s->scene_count; i++) {
        free(m.scenes[i].tiles);
        free(m.scenes[i].rates);
    }
    free(m.scenes);
    free(m.pictures);
    return status;
}

const suite_info suite_mlrta_adaptive = {
    .name = "mlrta-adaptive",
    .summary = "samples by the complexity that tiles see, against even samples at equal error (Reshetov and others 2005, 4.2)",
    .title = "MLRTA: adaptive sampling",
    .about = "The size of the subtree below a tile's entry point says how complex the tile's view is (Reshetov, Soupikov and Hurley 2005, 4.2). "
             "Tiles get samples by it; rays and cycles are compared with those of a picture of the same error whose pixels all have the same "
             "samples.",
    .scenes = mlrta_suite_scenes,
    .size = 512,
    .measure = measure,
};
