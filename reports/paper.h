/* Values published in the papers, from the tables in reports/papers/, each with how sure its reading is. */
#ifndef REPORTS_PAPER_H
#define REPORTS_PAPER_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct report_paper_value {
    const char *table; /* file that it stands in, without .csv: mft_table1 */
    const char *scene, *algorithm, *metric;
    double value; /* NaN: lost */
    const char *unit; /* thousand, million, x, ... */
    const char *source;
    const char *status; /* ok, ocr_fixed, inferred, uncertain, lost */
    const char *note;
} report_paper_value;

/** All values, in the order of the files; *count of them. */
const report_paper_value *report_paper_list(size_t *count);

/** One entry, or NULL. */
const report_paper_value *report_paper_entry(const char *table, const char *scene, const char *algorithm, const char *metric);

/** One value, in units of one (thousands and millions multiplied out); NaN if there is none, or it is lost. */
double report_paper_find(const char *table, const char *scene, const char *algorithm, const char *metric);

/* A scene of a paper, and the built-in scene that stands in for it. */
typedef struct report_paper_scene {
    const char *name; /* in the paper's table */
    const char *builtin;
} report_paper_scene;

/** Number of the scene that the named built-in one stands in for, or `count`. */
size_t report_paper_scene_of(const report_paper_scene *scenes, size_t count, const char *builtin);

#ifdef __cplusplus
}
#endif
#endif
