/* The view of MLRTA Table 1: pictures and rays a second, of the simulated core at its clock and as published. */
#ifndef REPORTS_VIEWS_MLRTA_SPEEDS_H
#define REPORTS_VIEWS_MLRTA_SPEEDS_H

#include "reports/table.h"
#include "reports/views/mlrta_paper.h"

/* One kernel on one scene, on the core model: with no shader, and with the simple one. */
typedef struct mlrta_speed {
    const char *scene, *kernel;
    double pixels, clock_hz;
    double cycles;     /* with no shader; so are the parts below */
    double shaded;     /* with the simple shader */
    double entry;      /* the part of the cycles that entry-point searches took, 0..1 */
    double memory;     /* the part that waited for lines from beyond the first level of cache */
    double half_width; /* of either cycles, relative, the larger one; 0: exact */
} mlrta_speed;

/** All rows, each scene's published ones below it, then those of the other scenes. NULL if out of memory. */
report_table *mlrta_speeds_table(const mlrta_speed *rows, size_t count, const char *caption);

#endif
