/* The view of MFT Table 2: what shrinking the frusta of shadow rays saves, beside the published rows.
 *
 *   scene         variant    basis      triangle accesses  ...  intersection tests  additional tests  cycles  cycles of the frame
 *   creature-69k  No Shrink  measured   ...
 *                            published
 */
#ifndef REPORTS_VIEWS_MFT_TABLE2_H
#define REPORTS_VIEWS_MFT_TABLE2_H

#include "reports/views/mft_paper.h"

/* One variant on one scene; of a scene all MFT_SHRINKS follow each other in their order. */
typedef struct mft_shrink_row {
    const char *scene;
    size_t shrink;
    double value[MFT_METRICS]; /* of the shadow rays: the whole frame's less those of its primary rays alone */
    double additional, additional16; /* tests: frusta, and 16-lane computations for them */
    double frame;      /* cycles of the whole frame */
    double half_width; /* of `frame`, relative; 0: exact */
} mft_shrink_row;

/** All rows, the published ones beside the scene that stands in for the paper's, or after all. NULL if out of memory. */
report_table *mft_table2_counts(const mft_shrink_row *rows, size_t count, const char *caption);

/** Changes against no shrinking in percent, the published ones as printed. NULL if out of memory. */
report_table *mft_table2_changes(const mft_shrink_row *rows, size_t count, const char *caption);

/** Where a change is far from the published one, in words. NULL if out of memory. */
report_table *mft_table2_differences(const mft_shrink_row *rows, size_t count);

#endif
