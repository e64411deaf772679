/* Plots of numbers, drawn by gnuplot: points and lines on linear or logarithmic axes. */
#ifndef REPORTS_PLOT_H
#define REPORTS_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct report_axis {
    const char *label; /* with its unit */
    bool logarithmic;
} report_axis;

/* How the points of a series are joined, in their order. */
typedef enum report_line {
    REPORT_LINE_NONE,
    REPORT_LINE_POINTS, /* a line from point to point */
    REPORT_LINE_ALONE   /* the line without the points */
} report_line;

/* Points that belong together: one colour and one symbol, a line in the legend. */
typedef struct report_series {
    const char *name;
    const double *x, *y;       /* `count` of each; a point that is not finite, or not above 0 on a logarithmic axis, is left out */
    const char *const *labels; /* a text beside each point, entries may be NULL; NULL: none */
    size_t count;
    report_line line; /* a point that is left out parts it */
} report_series;

typedef struct report_plot {
    const char *title;
    report_axis x, y;
    const report_series *series;
    size_t series_count;
} report_plot;

/**
 * Write the plot as gnuplot's commands, data included; the picture goes to gnuplot's stdout. A pure function of the plot,
 * the same under every locale. Texts are cleaned as report_text_clean does and taken literally.
 *
 * Errors: BASE_ERR_NOMEM. Whether the stream took the bytes is for its owner to check.
 */
base_status report_plot_write_script(const report_plot *plot, FILE *out, base_error *err);

/**
 * Draw the plot to a PNG file of 960x640 pixels, with the gnuplot that PATH names.
 *
 * Errors: BASE_ERR_UNSUPPORTED (there is no gnuplot), BASE_ERR_INPUT naming the file (not writable), BASE_ERR_IO (disk full, or
 * gnuplot failed: its own words), BASE_ERR_NOMEM. A failure leaves an old file as it was.
 */
base_status report_plot_write(const char *path, const report_plot *plot, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
