/* The view of speed against error of soft shadows (Figure 5 of Benthin and Wald 2009, and beyond): ways to sample the light, the error
 * of the visibility against many samples, and cycles.
 *
 *   scene     samples  interleaved  filter  cycles     per pixel  inside penumbrae: RMSE  bias  worst  outside: RMSE ...
 *   hall-60k  4        no           no
 */
#ifndef REPORTS_VIEWS_MFT_QUALITY_H
#define REPORTS_VIEWS_MFT_QUALITY_H

#include <stdbool.h>

#include "reports/plot.h"
#include "reports/table.h"

/* Error of a visibility, 0..1, over some pixels. */
typedef struct mft_error {
    double rmse, bias, worst; /* NaN, NaN, 0 if there are no pixels */
    size_t pixels;
} mft_error;

/* Where a pixel is: the reference sees a part of the light, or all of it or nothing. */
typedef enum mft_region { MFT_INSIDE, MFT_OUTSIDE, MFT_REGIONS } mft_region;

/** Errors against a reference of the pixels with mask != 0, by region. */
void mft_errors_of(const float *seen, const float *reference, const unsigned char *mask, size_t pixels, mft_error out[MFT_REGIONS]);

/* Ways to sample: numbers of samples, each first without interleaving, then with it, and each of these first without the filter, then with it.
   The most samples are all the sets that are interleaved, so the last two ways, MFT_QUALITY_FULL and the same filtered, stand for four. */
enum { MFT_QUALITY_SAMPLES = 4, MFT_QUALITY_FULL = 4 * (MFT_QUALITY_SAMPLES - 1), MFT_QUALITY_WAYS = MFT_QUALITY_FULL + 2 };
extern const unsigned mft_quality_samples[MFT_QUALITY_SAMPLES]; /* 4, 16, 64, 256 */

/* One way on one scene; of a scene all MFT_QUALITY_WAYS follow each other in their order. */
typedef struct mft_quality_row {
    const char *scene;
    unsigned samples;
    bool interleaved, filtered; /* of the most samples: `interleaved` is false */
    double rays, cycles, cycles_per_pixel; /* of the frame, without the filter */
    mft_error error[MFT_REGIONS]; /* against the reference */
} mft_quality_row;

/** All rows. NULL if out of memory. */
report_table *mft_quality_errors(const mft_quality_row *rows, size_t count, const char *caption);

/* 16 samples in one of four ways against 256 on one scene, in a picture of one size. */
typedef struct mft_figure5_row {
    const char *scene;
    unsigned width, height;
    bool interleaved, filtered;
    double rays; /* shadow rays, as a part of those of 256 samples */
    mft_error error[MFT_REGIONS]; /* against 256 samples, not filtered */
} mft_figure5_row;

/** Figure 5. NULL if out of memory. */
report_table *mft_quality_figure5(const mft_figure5_row *rows, size_t count, const char *caption);

/* Series of a scene's plot: cycles per pixel and RMSE inside penumbrae, in four ways. */
typedef struct mft_quality_points {
    report_series series[4];
    double x[4][MFT_QUALITY_SAMPLES], y[4][MFT_QUALITY_SAMPLES];
    char title[200];
} mft_quality_points;

/** @param rows  the scene's MFT_QUALITY_WAYS */
void mft_quality_points_of(const mft_quality_row *rows, mft_quality_points *out);

#endif
