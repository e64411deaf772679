/* Pictures of a run: shaded, per-pixel results, heat maps. Made on the host from the frame, charged to no machine. */
#ifndef CLI_PICTURE_H
#define CLI_PICTURE_H

#include "cli/run.h"
#include "reports/image.h"

/**
 * The scene as the run's rays hit it: base colours, lit as kernels with soft shadows lit it, else by Lambert's law for a point light at the
 * light's centre times the visibility of hard shadows; and a little light from the camera so that nothing is black; what is missed is a
 * pale grey. A pixel whose samples were traced is their mean.
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status picture_shaded(const run_result *result, report_image *out, base_error *err);

/** picture_shaded with other visibilities: by pixel, row by row from the top left; NULL: as the kernel lit it, which had soft shadows. */
base_status picture_lit(const run_result *result, const float *seen, report_image *out, base_error *err);

/**
 * The fraction of the light that the hit of each pixel sees, row by row from the top left; 1 for kernels without shadows.
 *
 * @param filtered  as the filter of soft shadows leaves it (kernels/visibility_filter.c), if the kernel had one, not as it was traced
 * @return for free(); NULL with BASE_ERR_NOMEM in *err
 */
float *picture_visibility(const run_result *result, bool filtered, base_error *err);

/** Write Z, prim, U, V and, of kernels with shadows, visibility, with entry points, complexity, of those that mark pixels, marked (docs/interface.md) as an EXR file. */
base_status picture_write_aov(const run_result *result, const char *path, base_error *err);

/**
 * A heat map of simulated cycles per pixel, or of a counter per pixel.
 *
 * @param counter  KERNEL_COUNTER_COUNT for cycles
 * @param top      value of the last colour; 0: chosen (reports/heat_map.h)
 */
base_status picture_heat_map(const run_result *result, kernel_counter counter, double top, report_image *out, base_error *err);

/** The value that picture_heat_map would choose for `top`. */
base_status picture_heat_top(const run_result *result, kernel_counter counter, double *top, base_error *err);

#endif
