/* The view of adaptive anti-aliasing (6.1 and Figure 7 of Benthin and Wald 2009): what is marked, what that costs, and what error
 * is left in the picture.
 *
 *   scene     marked  recall  precision  marking by blocks  cycles: primary rays  marking  samples  adaptive  16 everywhere  ...
 *   hall-60k  12.0
 */
#ifndef REPORTS_VIEWS_MFT_MSAA_H
#define REPORTS_VIEWS_MFT_MSAA_H

#include <stddef.h>

#include "reports/table.h"

/* Ways to make the picture: one ray a pixel, 16 for marked pixels, 16 for all. */
typedef enum mft_msaa_way { MFT_MSAA_NONE, MFT_MSAA_ADAPTIVE, MFT_MSAA_FULL, MFT_MSAA_WAYS } mft_msaa_way;

/** "1 ray a pixel" and so on. */
extern const char *const mft_msaa_way_names[MFT_MSAA_WAYS];

/* One scene. */
typedef struct mft_msaa_row {
    const char *scene;
    double pixels, marked, marked_by_blocks;  /* of the frame */
    double edges, edges_marked;               /* pixels whose 16 samples a silhouette separates, and those of them that are marked */
    double intersections;                     /* pixels whose samples are of surfaces that run through each other */
    double precise;                           /* marked pixels whose samples are not of one smooth surface */
    double silhouettes, edge_tests;
    double cycles[MFT_MSAA_WAYS], rays[MFT_MSAA_WAYS], rmse[MFT_MSAA_WAYS]; /* error of the picture against 64 samples */
    double marking_cycles;                    /* of a frame that is marked and not traced again */
    double half_width[MFT_MSAA_WAYS];         /* of the cycles, relative; 0: exact */
} mft_msaa_row;

/** Root of the mean square of the differences of `count` values. */
double mft_msaa_rmse(const float *values, const float *reference, size_t count);

/** What is marked, beside the published share. NULL if out of memory. */
report_table *mft_msaa_marked(const mft_msaa_row *rows, size_t count, const char *caption);

/** Where the cycles go. NULL if out of memory. */
report_table *mft_msaa_cycles(const mft_msaa_row *rows, size_t count, const char *caption);

/** Error against cycles in the three ways. NULL if out of memory. */
report_table *mft_msaa_errors(const mft_msaa_row *rows, size_t count, const char *caption);

#endif
