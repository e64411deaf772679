/* The view of MFT Table 1 with the cycles of the core model: every row measured, beside the row published.
 *
 *   scene      algorithm             triangle accesses  after culling  AABB tests  intersection tests  cycles      per pixel
 *   hall-60k   P-Packet, measured    ...
 *              P-Packet, published
 */
#ifndef REPORTS_VIEWS_MFT_TABLE1_H
#define REPORTS_VIEWS_MFT_TABLE1_H

#include "reports/views/mft_paper.h"

/* Phases of the kernels, with those of a filter last. */
enum { MFT_PHASES = 6 };

/** "set-up" and so on. */
extern const char *const mft_phase_names[MFT_PHASES];

/* One algorithm on one scene; of a scene the algorithms follow each other in their order, packets before frusta. */
typedef struct mft_row {
    const char *scene;
    mft_algorithm algorithm;
    double pixels;
    double value[MFT_METRICS]; /* cycles without those of the filter */
    double phase[MFT_PHASES];  /* cycles of each, the filter's too */
    double memory;     /* the part of the cycles that waited for lines from beyond the first level of cache, 0..1 */
    double half_width; /* of the cycles, relative; 0: exact */
} mft_row;

/** All rows, and the published rows of the scenes that they stand in for and of those that they do not. NULL if out of memory. */
report_table *mft_table1_counts(const mft_row *rows, size_t count, const char *caption);

/** Cycles by phase, shading and the filter apart. NULL if out of memory. */
report_table *mft_table1_phases(const mft_row *rows, size_t count, const char *caption);

/** Packets / frusta. NULL if out of memory. */
report_table *mft_table1_reductions(const mft_row *rows, size_t count, const char *caption);

/** What differs much from the published reductions of AABB tests and cycles, in words. NULL if out of memory. */
report_table *mft_table1_differences(const mft_row *rows, size_t count);

#endif
