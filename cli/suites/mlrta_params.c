/* Suite mlrta-params: what each parameter of multi-level ray tracing and each rule of its tree changes, one by one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/suites/mlrta_runs.h"
#include "reports/views/mlrta_params.h"

/* One row of every scene. A setting is a list of assignments, a blank between them. */
typedef struct setting {
    const char *kind, *assignments;
} setting;

static const char split_kind[] = "splitting"; /* these are in the plot, with the defaults */

static const setting settings[] = {
    {"nothing", ""},
    {"initial tile", "its=16"},
    {"initial tile", "its=32"},
    {"initial tile", "its=64"},
    {"initial tile", "its=256"},
    {split_kind, "sf=16 mts=4"},
    {split_kind, "sf=16 mts=8"},
    {split_kind, "sf=16 mts=128"},
    {split_kind, "sf=4 mts=4"},
    {split_kind, "sf=4 mts=8"},
    {split_kind, "sf=4 mts=16"},
    {split_kind, "sf=4 mts=32"},
    {split_kind, "sf=4 mts=64"},
    {"search", "ends=0"},
    {"search", "empty_occluders=1"},
    {"packets", "divergent=xp"},
    {"packets", "divergent_packets=rays"},
    {"packets", "mailbox=0"},
    {"rules of the tree", "empty_percent=100"},
    {"rules of the tree", "empty_percent=30"},
    {"rules of the tree", "covered_planes=0"},
    {"rules of the tree", "perfect_splits=0"},
    {"rules of the tree", "min_area=0"},
    {"rules of the tree", "min_area=1000"},
    {"rules of the tree", "min_area=10000"},
    {"rules of the tree", "empty_percent=100 covered_planes=0 min_area=0"},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

/* Rooms with aligned walls, columns and arches, and fine detail: trees that are built in seconds. */
static const char *const scenes[] = {"builtin:rooms-804", "builtin:atrium-76k", "builtin:conference-282k", NULL};

typedef struct measured {
    mlrta_params_row *rows;
    size_t count;
} measured;

static bool takes(const kernel_info *kernel, const char *assignment)
{
    size_t count;
    const kernel_param_info *list = kernel_param_list(&count);
    const size_t length = strcspn(assignment, "=");
    for (size_t i = 0; i < count; i++)
        if (strlen(list[i].name) == length && strncmp(list[i].name, assignment, length) == 0)
            return kernel->params >> i & 1;
    return false;
}

/* Those of the assignments that the kernel takes; whether there was one. */
static base_status assign(const kernel_info *kernel, const char *assignments, kernel_params *params, bool *changed, base_error *err)
{
    char words[100], *rest = words, *word;
    base_status status = BASE_OK;
    snprintf(words, sizeof words, "%s", assignments);
    *params = kernel->defaults;
    *changed = false;
    while (status == BASE_OK && (word = strtok_r(rest, " ", &rest)))
        if (takes(kernel, word)) {
            *changed = true;
            status = kernel_params_set(params, kernel->params, word, err);
        }
    return status;
}

/* Count and time both algorithms; one that knows none of the parameters does what it does by default. */
static base_status measure_setting(const suite *s, const suite_scene *on, const setting *set, const mlrta_params_row *defaults,
                                   mlrta_params_row *row, base_error *err)
{
    base_status status = BASE_OK;
    *row = (mlrta_params_row){.kind = set->kind, .setting = *set->assignments ? set->assignments : "defaults",
                              .counted = {.scene = on->name, .packets = mlrta_packets(s)}};
    for (int a = 0; status == BASE_OK && a < MLRTA_ALGORITHMS; a++) {
        run_options options = suite_run_options(s, kernel_find(mlrta_primary_kernels[a]), RUN_ISSUE);
        run_result result = {0};
        bool changed;
        status = assign(options.kernel, set->assignments, &options.params, &changed, err);
        if (status == BASE_OK && !changed && row != defaults) {
            row->counted.counts[a] = defaults->counted.counts[a];
            row->cycles[a] = defaults->cycles[a];
            continue;
        }
        if (status == BASE_OK)
            status = run_kernel(on->scene, s->options->machine, &options, &result, err);
        if (status == BASE_OK) {
            row->counted.counts[a] = mlrta_counts_of(&result);
            row->cycles[a] = (double)result.cycles;
            if (a == MLRTA_WITH && (row == defaults || strcmp(set->kind, split_kind) == 0)) {
                row->parts = 4u << 2 * options.params.sf;
                row->least = 4u << options.params.mts;
            }
            row->nodes = (double)(result.kdtree->inner_count + result.kdtree->leaf_count);
        }
        run_result_destroy(&result);
    }
    return status;
}

static base_status measure_scene(suite *s, const suite_scene *on, void *user, base_error *err)
{
    measured *m = user;
    const mlrta_params_row *defaults = &m->rows[m->count];
    base_status status = BASE_OK;
    for (int i = 0; status == BASE_OK && i < SETTINGS; i++)
        status = measure_setting(s, on, &settings[i], defaults, &m->rows[m->count++], err);
    return status;
}

static base_status add_plot(suite *s, const measured *m, base_error *err)
{
    mlrta_params_plot curves;
    base_status status = mlrta_params_plot_create(m->rows, m->count, &curves, err);
    const report_plot plot = {"What splitting tiles saves", {"tiles of this edge are not split (pixels)", true},
                              {"traversed cells, no MLRT / MLRT", false}, curves.series, curves.count};
    if (status == BASE_OK)
        status = suite_add_plot(s, "-splitting", &plot, "Reduction of the traversed cells, inner nodes and leaves, by the smallest tile that "
                                                        "has an entry point of its own; initial tiles of 128x128 pixels.", err);
    mlrta_params_plot_destroy(&curves);
    return status;
}

static base_status measure(suite *s, base_error *err)
{
    char caption[320];
    measured m = {.rows = calloc(s->scene_count * SETTINGS, sizeof *m.rows)};
    base_status status = m.rows ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    snprintf(caption, sizeof caption, "%ux%u pixels, primary rays, cycles of the issue model, machine %s; no MLRT is kernel %s, MLRT is %s. What "
                                      "a setting does not name is as it is by default (its=128 sf=16 mts=32).",
             s->width, s->height, s->options->machine->name, mlrta_primary_kernels[MLRTA_WITHOUT], mlrta_primary_kernels[MLRTA_WITH]);
    if (status == BASE_OK)
        status = suite_each_scene(s, measure_scene, &m, err);
    report_page_add_heading(s->page, 1, "Tables");
    if (status == BASE_OK)
        status = suite_add_table(s, "", mlrta_params_table(m.rows, m.count, caption), err);
    if (status == BASE_OK)
        status = suite_add_table(s, "-means", mlrta_params_means(m.rows, s->scene_count, SETTINGS, caption), err);
    report_page_add_heading(s->page, 1, "Plot");
    if (status == BASE_OK)
        status = add_plot(s, &m, err);
    free(m.rows);
    return status;
}

const suite_info suite_mlrta_params = {
    .name = "mlrta-params",
    .summary = "parameters of multi-level ray tracing and rules of its kd-tree, each changed by itself",
    .title = "MLRTA: parameters",
    .about = "Initial tile size, split factor and minimal tile size of multi-level ray tracing (Reshetov, Soupikov and Hurley 2005, 4.2), "
             "what its searches and packets may do, and the rules by which its kd-tree is built (3.1), each changed by itself.",
    .scenes = scenes,
    .size = 1024,
    .measure = measure,
};
