/* The view of how tests of shadow rays differ between packets from the root and from entry points, by what a tile's search has found. */
#ifndef REPORTS_VIEWS_MLRTA_SHADOWS_H
#define REPORTS_VIEWS_MLRTA_SHADOWS_H

#include "reports/table.h"
#include "reports/views/mlrta_paper.h"

/* What the search for a tile's shadow rays has found. */
typedef enum mlrta_found {
    MLRTA_FOUND_NO_BOUNDS, /* it was not made: packets start at the root */
    MLRTA_FOUND_NOTHING,   /* nothing can be in the way of any of its rays */
    MLRTA_FOUND_ENTRY,     /* an entry point */
    MLRTA_FOUNDS
} mlrta_found;

/* Sums over tiles, of their shadow rays alone. */
typedef struct mlrta_shadow_tests {
    double tiles, packets;
    double cells[MLRTA_ALGORITHMS], tests[MLRTA_ALGORITHMS], hits[MLRTA_ALGORITHMS]; /* hits: tests that block a ray */
    double more; /* tiles in which entry points make tests that the root does not */
} mlrta_shadow_tests;

/* One scene. */
typedef struct mlrta_shadows {
    const char *scene;
    mlrta_shadow_tests found[MLRTA_FOUNDS];
} mlrta_shadows;

/** NULL if out of memory. */
report_table *mlrta_shadows_table(const mlrta_shadows *rows, size_t count, const char *caption);

#endif
