/* The view of MLRTA Tables 2 and 3: what a packet of the picture costs without and with entry points, measured and published.
 *
 *   scene      count            reading                    no MLRT  published  MLRT  published  reduction  published
 *   rooms-804  traversed cells  inner nodes                   ...
 *                               inner nodes and leaves
 *
 * The paper does not say which nodes and tests it counts, so each reading has a row, and the published value stands beside all.
 */
#ifndef REPORTS_VIEWS_MLRTA_COUNTS_H
#define REPORTS_VIEWS_MLRTA_COUNTS_H

#include "reports/table.h"
#include "reports/views/mlrta_paper.h"

/* What has been counted: totals of the picture. */
typedef struct mlrta_counts {
    double cells, inner;         /* nodes visited, by searches and packets: all, and the inner ones */
    double ep_cells, ep_inner;   /* those that searches visited */
    double tests, nearer, mailbox; /* 16-ray tests, those that gave a ray a nearer hit, those that the mailbox saved */
    double tiles, empty_tiles, divergent_tiles; /* searched, of those that can hit nothing; that have no bounds */
    double divergent_packets;
    double end_tests, ends; /* triangles tested whether they end a search, and that did */
} mlrta_counts;

/* A scene without and with entry points. */
typedef struct mlrta_row {
    const char *scene;
    double packets; /* 4x4 packets of primary rays that cover the picture: what counts are divided by */
    mlrta_counts counts[MLRTA_ALGORITHMS];
} mlrta_row;

/** Table 2 or 3, and the published rows of the scenes that none here stands in for. NULL if out of memory. */
report_table *mlrta_counts_table(unsigned number, const mlrta_row *rows, size_t count, const char *caption);

/** The counters behind it: tiles, divergent packets, ends, the searches' share. NULL if out of memory. */
report_table *mlrta_counts_units(const mlrta_row *rows, size_t count, const char *caption);

#endif
