/* The view of adaptive sampling by complexity (Reshetov, Soupikov and Hurley 2005, 4.2 and 5): what a picture of one error costs with the
 * same samples in every pixel, with samples by the complexity that its tiles see, and with the best choice that there is.
 */
#ifndef REPORTS_VIEWS_MLRTA_ADAPTIVE_H
#define REPORTS_VIEWS_MLRTA_ADAPTIVE_H

#include "reports/plot.h"
#include "reports/table.h"

/* Samples a pixel that a tile may have. */
enum { MLRTA_RATES = 4 };
extern const double mlrta_rate_samples[MLRTA_RATES]; /* 1/4, 1, 4, 16 */

/* A tile of the picture; the arrays by rate. */
typedef struct mlrta_adaptive_tile {
    double complexity; /* nodes of the subtree that its rays see */
    double rays[MLRTA_RATES], cycles[MLRTA_RATES];
    double error[MLRTA_RATES]; /* squared differences from the reference, summed over pixels and channels */
} mlrta_adaptive_tile;

typedef struct mlrta_adaptive_scene {
    const char *name;
    double pixels;
    mlrta_adaptive_tile *tiles; /* the caller's, as is ... */
    unsigned char *rates;       /* ... room for a rate of each */
    size_t count;
} mlrta_adaptive_scene;

/* How tiles get their rates. */
typedef enum mlrta_way {
    MLRTA_EVENLY,
    MLRTA_BY_ROOT,  /* samples in proportion to the square root of the complexity: the cheapest if n nodes and s samples leave a squared error
                       in proportion to n / s */
    MLRTA_BY_STEPS, /* the best three complexities at which to go from one rate to the next, found with the reference at hand: what the
                       measure could do at most */
    MLRTA_BY_ERROR, /* by the tiles' errors themselves, which nobody knows beforehand */
    MLRTA_WAYS
} mlrta_way;

/* A picture whose tiles have been given samples. */
typedef struct mlrta_sampling {
    double rays, cycles; /* a pixel */
    double rmse;         /* of a channel */
    double by_chance;    /* the RMSE to expect if as many tiles had each rate, but which of them by chance */
    double share[MLRTA_RATES]; /* of the tiles, by rate */
} mlrta_sampling;

/** Choose the rates that cost the fewest rays of a way, for an error no larger than with `rate` everywhere; they stay in scene->rates. */
mlrta_sampling mlrta_choose_samples(const mlrta_adaptive_scene *scene, mlrta_way way, int rate);

/** For each scene, one and four samples a pixel against what is as good in other ways. NULL if out of memory. */
report_table *mlrta_adaptive_table(const mlrta_adaptive_scene *scenes, size_t count, const char *caption);

enum { MLRTA_ADAPTIVE_POINTS = 32, MLRTA_ADAPTIVE_CURVES = 3 };

/* Error against rays of one scene, evenly, by the root of the complexity, by error. */
typedef struct mlrta_adaptive_plot {
    char title[200];
    double rays[MLRTA_ADAPTIVE_CURVES][MLRTA_ADAPTIVE_POINTS], rmse[MLRTA_ADAPTIVE_CURVES][MLRTA_ADAPTIVE_POINTS];
    report_series series[MLRTA_ADAPTIVE_CURVES];
} mlrta_adaptive_plot;

void mlrta_adaptive_plot_of(const mlrta_adaptive_scene *scene, mlrta_adaptive_plot *out);

#endif
