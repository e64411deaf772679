/* What Reshetov, Soupikov and Hurley published (2005; reports/papers/mlrta_*.csv), as the views of it need it. */
#ifndef REPORTS_VIEWS_MLRTA_PAPER_H
#define REPORTS_VIEWS_MLRTA_PAPER_H

#include <stddef.h>

#include "reports/paper.h"

enum { MLRTA_SCENES = 4 };

extern const report_paper_scene mlrta_scenes[MLRTA_SCENES];

/** Number of the scene that the named one stands in for, or MLRTA_SCENES. */
size_t mlrta_scene_of(const char *builtin);

/* The two algorithms that Tables 2 and 3 compare: packets from the tree's root, and from entry points. */
typedef enum mlrta_algorithm { MLRTA_WITHOUT, MLRTA_WITH, MLRTA_ALGORITHMS } mlrta_algorithm;

/** Pixels of the paper's pictures. */
extern const double mlrta_paper_pixels;

/** A value of Table 2 or 3, a packet of the picture. NaN if the paper has none. */
double mlrta_paper_count(unsigned table, size_t scene, mlrta_algorithm algorithm, const char *metric);

/** A value that the text gives. NaN if there is none. */
double mlrta_paper_text(const char *scene, const char *algorithm, const char *metric);

#endif
