/* The view of the parameters of multi-level ray tracing and of its tree: what each setting changes, with all others at their defaults. */
#ifndef REPORTS_VIEWS_MLRTA_PARAMS_H
#define REPORTS_VIEWS_MLRTA_PARAMS_H

#include "reports/views/mlrta_counts.h"

/* One setting on one scene; of a scene the defaults come first. */
typedef struct mlrta_params_row {
    const char *kind;    /* what is varied: "tiles" and so on */
    const char *setting; /* "sf=4 mts=8" */
    mlrta_row counted;   /* with the scene */
    double nodes;        /* of the tree */
} mlrta_params_row;

/** NULL if out of memory. */
report_table *mlrta_params_table(const mlrta_params_row *rows, size_t count, const char *caption);

#endif
