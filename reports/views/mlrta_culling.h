/* The view of how entry-point searches cull cells: inverse against direct frustum culling and corner rays, MLRTA 3.3 and 5, Figure 2. */
#ifndef REPORTS_VIEWS_MLRTA_CULLING_H
#define REPORTS_VIEWS_MLRTA_CULLING_H

#include "reports/views/mlrta_counts.h"

/* One way of culling on one scene with one size of tiles; those of a scene and size follow each other, the inverse one first. */
typedef struct mlrta_culling_row {
    const char *scene, *tiles, *culling;
    double packets;
    mlrta_counts counts;
    size_t hits, lost; /* pixels that packets from the root hit something in; those of them with another nearest hit here, or none */
} mlrta_culling_row;

/** NULL if out of memory. */
report_table *mlrta_culling_table(const mlrta_culling_row *rows, size_t count, const char *caption);

#endif
