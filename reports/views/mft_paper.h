/* Tables 1 and 2 of Benthin and Wald 2009 (reports/papers/mft_table1.csv, mft_table2.csv), row by row, as the views of them need it. */
#ifndef REPORTS_VIEWS_MFT_PAPER_H
#define REPORTS_VIEWS_MFT_PAPER_H

#include <stddef.h>

#include "reports/paper.h"
#include "reports/table.h"

typedef enum mft_metric { MFT_TRIS, MFT_CULLED, MFT_AABB, MFT_ISECT, MFT_CYCLES, MFT_METRICS } mft_metric;

/** Names of the metrics in the tables: "triangle accesses" and so on. */
extern const char *const mft_metric_names[MFT_METRICS];

/* Rows of a scene. */
typedef enum mft_algorithm { MFT_P_PACKET, MFT_P_FRUSTA, MFT_S_PACKET, MFT_S_FRUSTA, MFT_ALGORITHMS } mft_algorithm;

/** "P-Packet" and so on. */
extern const char *const mft_algorithm_names[MFT_ALGORITHMS];

enum { MFT_SCENES = 4, MFT_DOUBT_BYTES = 120 };

extern const report_paper_scene mft_scenes[MFT_SCENES];

/** Number of the scene that the named one stands in for, or MFT_SCENES. */
size_t mft_scene_of(const char *builtin);

/** Pixels of the paper's pictures. */
extern const double mft_paper_pixels;

/* A row of the table. */
typedef struct mft_paper_row {
    double value[MFT_METRICS];
    char doubt[MFT_DOUBT_BYTES]; /* metrics whose reading is inferred or uncertain: "uncertain: cycles"; "" for none */
} mft_paper_row;

mft_paper_row mft_paper_row_of(size_t scene, mft_algorithm algorithm);

/* How frusta of shadow rays shrink, in the order of the kernel's parameter. */
enum { MFT_SHRINKS = 4 };

/** "No Shrink" and so on, the paper's names. */
extern const char *const mft_shrink_names[MFT_SHRINKS];

/** A row of Table 2, which is of the first scene only, has no cycles, and leaves the primary rays out. */
mft_paper_row mft_paper_shrink_row(size_t shrink);

/** Its additional tests; NaN where it has none. */
double mft_paper_additional_tests(size_t shrink);

/** The change against no shrinking as it is printed, in percent; NaN where none is. */
double mft_paper_shrink_change(size_t shrink, mft_metric metric);

/** The row's value of one more metric of the file: "cycles_with_shading". NaN if it has none. */
double mft_paper_value(size_t scene, mft_algorithm algorithm, const char *metric);

#endif
