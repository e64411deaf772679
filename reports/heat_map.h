/* Heat maps: one number a pixel, shown as colour, with a legend. */
#ifndef REPORTS_HEAT_MAP_H
#define REPORTS_HEAT_MAP_H

#include "lrbni/base/status.h"
#include "reports/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Colour of a value in [0, 1], linear RGB: from near black over violet, red and orange to a pale yellow. Lightness
 * (CIE L*) rises evenly, so that the order of values can be seen without colour vision and in grey print. Values
 * outside are taken as 0 or 1; NaN is a middle grey-blue that the ramp does not contain.
 */
report_color report_heat_color(double value);

/**
 * The value that gets the last colour unless the caller chooses one: the 99.5th percentile (nearest rank) of the
 * finite values, so that a few extreme pixels do not darken the rest; the maximum if that percentile is not above
 * 0; 1 if nothing is.
 *
 * @param values  `count` numbers >= 0; NaN and infinite ones are left out
 * Errors: BASE_ERR_NOMEM.
 */
base_status report_heat_top(const double *values, size_t count, double *top, base_error *err);

typedef struct report_heat_options {
    double top;        /* value of the last colour; <= 0: report_heat_top. Pictures to be compared need the same. */
    const char *label; /* what the numbers are, as in "cycles per pixel"; NULL for none */
} report_heat_options;

/**
 * Make a picture of numbers: colours are linear from 0 to `top`, with a legend bar below that names 0 and the top
 * (with a + behind it if larger values exist, which all get the last colour), the label and the maximum.
 *
 * @param values   height * width numbers >= 0, rows from the top; one that is not finite is drawn as "no value"
 * @param options  NULL for the defaults
 * @param out      RGB, owned by the caller; the map is its top left width x height part. Higher by the legend, and
 *                 wider if the legend's text needs it.
 * Errors: as report_image_create.
 */
base_status report_heat_map_create(const double *values, int width, int height, const report_heat_options *options,
                                   report_image *out, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
