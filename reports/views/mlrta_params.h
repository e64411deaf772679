/* The view of the parameters of multi-level ray tracing and of its tree: what each setting changes, with all others at their defaults. */
#ifndef REPORTS_VIEWS_MLRTA_PARAMS_H
#define REPORTS_VIEWS_MLRTA_PARAMS_H

#include "lrbni/base/status.h"
#include "reports/plot.h"
#include "reports/views/mlrta_counts.h"

/* One setting on one scene; of a scene the defaults come first. */
typedef struct mlrta_params_row {
    const char *kind;    /* what is varied: "tiles" and so on */
    const char *setting; /* "sf=4 mts=8" */
    mlrta_row counted;   /* with the scene, the same pointer in all rows of one */
    double cycles[MLRTA_ALGORITHMS];
    double nodes;        /* of the tree */
    unsigned parts, least; /* into which a tile is split, and the edge in pixels from which it is not: in the plot; 0: not in it */
} mlrta_params_row;

/** NULL if out of memory. */
report_table *mlrta_params_table(const mlrta_params_row *rows, size_t count, const char *caption);

/** Geometric means over the scenes of what the settings change: rows[scene * settings + setting], the defaults first. NULL if out of memory. */
report_table *mlrta_params_means(const mlrta_params_row *rows, size_t scenes, size_t settings, const char *caption);

enum { MLRTA_PARAMS_POINTS = 8 }; /* of a curve, at most */

/* One curve of the plot. */
typedef struct mlrta_params_curve {
    char name[200];
    const char *scene;
    unsigned parts;
    double least[MLRTA_PARAMS_POINTS], reduction[MLRTA_PARAMS_POINTS];
    size_t count;
} mlrta_params_curve;

/* The plot: reductions of the traversed cells by the edge from which tiles are not split, a curve a scene and split factor. */
typedef struct mlrta_params_plot {
    mlrta_params_curve *curves;
    report_series *series;
    size_t count;
} mlrta_params_plot;

/** Destroy it also after a failure. Errors: BASE_ERR_NOMEM. */
base_status mlrta_params_plot_create(const mlrta_params_row *rows, size_t count, mlrta_params_plot *out, base_error *err);

void mlrta_params_plot_destroy(mlrta_params_plot *plot);

#endif
