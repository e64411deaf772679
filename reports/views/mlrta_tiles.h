/* The view of how multi-level ray tracing splits the picture, by size of tiles; beside it what the kernel counted. MLRTA 4.2, Figure 7. */
#ifndef REPORTS_VIEWS_MLRTA_TILES_H
#define REPORTS_VIEWS_MLRTA_TILES_H

#include <stdint.h>

#include "reports/table.h"

enum { MLRTA_EDGES = 7 }; /* 4, 8 and so on to 256 pixels */

typedef struct mlrta_tile_counts {
    uint64_t searched, divergent, traced; /* with and without bounds; those whose packets start there */
} mlrta_tile_counts;

typedef struct mlrta_tiles_row {
    const char *scene;
    mlrta_tile_counts by_edge[MLRTA_EDGES]; /* as drawn */
    mlrta_tile_counts counted;              /* by the kernel, all sizes; `traced` is not among its counters */
} mlrta_tiles_row;

/** NULL if out of memory. */
report_table *mlrta_tiles_table(const mlrta_tiles_row *rows, size_t count, const char *caption);

#endif
