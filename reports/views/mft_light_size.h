/* The view of soft shadows by the size of the light (Figure 6 of Benthin and Wald 2009): packets against frusta.
 *
 *   scene     light scale  algorithm  triangle accesses  ...  cycles      per pixel  shadow rays  penumbra
 *   hall-60k  0.125        S-Packet   ...
 *                          S-Frusta
 */
#ifndef REPORTS_VIEWS_MFT_LIGHT_SIZE_H
#define REPORTS_VIEWS_MFT_LIGHT_SIZE_H

#include "reports/plot.h"
#include "reports/views/mft_table1.h"

/* Both algorithms on one scene under one light; of a scene they follow each other, the smallest light first. */
typedef struct mft_light_row {
    double scale;      /* of the light's edges */
    mft_row packet, frusta;
    double rays;       /* shadow rays */
    double penumbra;   /* pixels that see a part of the light, 0..1 of all */
} mft_light_row;

/** All runs. NULL if out of memory. */
report_table *mft_light_size_counts(const mft_light_row *rows, size_t count, const char *caption);

/** Packets / frusta by the light's size, and the published ones. NULL if out of memory. */
report_table *mft_light_size_reductions(const mft_light_row *rows, size_t count, const char *caption);

enum { MFT_LIGHT_NAME_BYTES = 200 };

/* Series of the plot: reductions of cycles and of AABB tests, by scene. */
typedef struct mft_light_series {
    report_series *series;
    size_t count;
    double *numbers;
    char (*names)[MFT_LIGHT_NAME_BYTES];
} mft_light_series;

/** Destroy with mft_light_series_destroy, also after a failure. Errors: BASE_ERR_NOMEM. */
base_status mft_light_series_create(const mft_light_row *rows, size_t count, size_t scales, mft_light_series *out, base_error *err);
void mft_light_series_destroy(mft_light_series *s);

#endif
