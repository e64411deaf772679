/* A suite of `lanetrace report`: what it measures, and what all suites share: options, scenes, files, the page.
 *
 * A suite is a file in cli/suites/ with a descriptor `const suite_info suite_NAME`, a line in cli/suites/suites.def and one in
 * cli/meson.build. Its `measure` runs what it needs over the scenes and adds tables, pictures and plots in the order in which they
 * are shown; the text, CSV, JSON and HTML files are written when it has succeeded.
 */
#ifndef CLI_SUITE_H
#define CLI_SUITE_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/command.h"
#include "cli/run.h"
#include "reports/html_page.h"
#include "reports/image.h"
#include "reports/plot.h"
#include "reports/table.h"
#include "scene/scene.h"

enum { SUITE_PATH_BYTES = 4096, SUITE_NAME_BYTES = 160 };

typedef struct suite suite;

/* Options that not every suite takes; bits of suite_info.takes. */
enum { SUITE_TAKES_KERNELS = 1, SUITE_TAKES_ERROR = 2 };

typedef struct suite_info {
    const char *name;          /* mft-primary: what the command line and the files call it */
    const char *summary;       /* a line for the list of suites */
    const char *title, *about; /* of the page: its heading, and a paragraph on what is compared with what */
    const char *const *scenes; /* names for scene_open, NULL at the end; NULL: the usual ones (scene_builtin_usual) */
    unsigned size;             /* default width and height in pixels */
    unsigned jobs;             /* default host threads; 0: all */
    unsigned takes;
    base_status (*measure)(suite *s, base_error *err);
} suite_info;

/** All suites, the default one first; *count entries. */
const suite_info *const *suite_list(size_t *count);

/** The suite of that name, or NULL. */
const suite_info *suite_find(const char *name);

/* What the command line says. What is NULL or 0 was not given. */
typedef struct suite_options {
    const char *out; /* directory, which exists */
    unsigned width, height, jobs;
    double error;
    bool no_pictures;
    const char *cache; /* folder that keeps kd-trees */
    const char *machine_name;
    const sim_machine *machine; /* with the sets in force */
    command_list scenes, sets, kernels;
} suite_options;

/* A scene of a suite. */
typedef struct suite_scene {
    char name[SUITE_NAME_BYTES];
    char stem[SUITE_NAME_BYTES + 16]; /* for file names: plain characters, numbered if an earlier scene has the same name */
    size_t triangles;
    scene *scene; /* NULL unless it is open */
} suite_scene;

/* A table of a suite, and the part of its CSV file's name that follows the suite's. */
typedef struct suite_table {
    const char *suffix;
    report_table *table;
} suite_table;

/* A suite at work. */
struct suite {
    const suite_info *info;
    const suite_options *options;
    unsigned width, height, jobs; /* in force */
    suite_scene *scenes;          /* those measured so far have a name */
    size_t scene_count;           /* of all, whether measured or not */
    suite_table *tables;
    size_t table_count;
    report_page *page;
};

/** Measure one suite, write its files, print its tables on stdout. Errors: any. A failed suite writes none of its tables. */
base_status suite_run(const suite_info *info, const suite_options *options, base_error *err);

/* The rest is for suites. */

/** Open all scenes that are not open yet, for as long as the suite is at work. Errors: those of scene_open. */
base_status suite_open_scenes(suite *s, base_error *err);

/** Called for each scene in turn, while it is open. */
typedef base_status suite_scene_fn(suite *s, const suite_scene *on, void *user, base_error *err);

/** Open the scenes one after the other; each is closed before the next. Errors: those of scene_open and of `measure`. */
base_status suite_each_scene(suite *s, suite_scene_fn *measure, void *user, base_error *err);

/** Options of a run as the suite's own options have them: size, jobs, a progress bar, the kernel's default parameters. */
run_options suite_run_options(const suite *s, const kernel_info *kernel, run_model model);

/** Show a table next, and write it to SUITE[suffix].csv. Takes the table, also when it fails. Errors: BASE_ERR_NOMEM. */
base_status suite_add_table(suite *s, const char *suffix, report_table *table, base_error *err);

/** Name of a file in the output directory: STEM and REST, both plain. */
void suite_path(const suite *s, char path[SUITE_PATH_BYTES], const char *stem, const char *rest);

/** Write a picture and free it; `made` is the status of its making, which a failure hands on. */
base_status suite_write_picture(const char *path, base_status made, report_image *image, base_error *err);

/** Draw SUITE[suffix].png and show it next. Without gnuplot the page, and a line on stderr, say that it is left out; with
 * --no-pictures nothing is drawn. Errors: those of report_plot_write but BASE_ERR_UNSUPPORTED. */
base_status suite_add_plot(suite *s, const char *suffix, const report_plot *plot, const char *caption, base_error *err);

#endif
