/* lanetrace report: the papers' tables, measured, beside the papers' values; text, CSV, JSON, HTML and pictures. */
#include <ctype.h>
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/command.h"
#include "cli/picture.h"
#include "cli/run.h"
#include "cli/version.h"
#include "lrbni/base/parallel.h"
#include "reports/heat_map.h"
#include "reports/html_page.h"
#include "reports/image_writer.h"
#include "lrbni/base/output_file.h"
#include "reports/views/packet_frusta.h"
#include "scene/builtin.h"
#include "sim/count.h"

enum { KEY_OUT = 256, KEY_SCENE, KEY_SIZE, KEY_JOBS, KEY_MACHINE, KEY_SET, KEY_NO_PICTURES, PATH_BYTES = 4096, STEM_BYTES = 160 };

static const char suite_name[] = "mft-primary";

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "DIR", 0, "where the files go; made if it is not there; default out", 0},
    {"scene", KEY_SCENE, "SCENE", 0, "take this scene instead of the three small built-in ones; repeatable", 0},
    {"size", KEY_SIZE, "WxH", 0, "image size in pixels; default 1024x1024, as the paper's", 0},
    {"machine", KEY_MACHINE, "M", 0, "a machine (see lanetrace machines), or a description's path; default larrabee", 0},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a field of the machine; repeatable", 0},
    {"jobs", KEY_JOBS, "N", 0, "host threads; default: all", 0},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "tables only", 0},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *out, *size, *jobs, *machine;
    bool no_pictures;
    command_list suites, scenes, sets;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_OUT: a->out = text; return 0;
    case KEY_SIZE: a->size = text; return 0;
    case KEY_JOBS: a->jobs = text; return 0;
    case KEY_MACHINE: a->machine = text; return 0;
    case KEY_NO_PICTURES: a->no_pictures = true; return 0;
    case KEY_SCENE: return command_list_add(&a->scenes, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_SET: return command_list_add(&a->sets, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case ARGP_KEY_ARG: return command_list_add(&a->suites, text, a->err) == BASE_OK ? 0 : ENOMEM;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    option_table, parse, "[SUITE...]",
    "Measure the suites (all, if none is named) and write their tables to DIR as text, CSV, JSON and HTML, with pictures.\v"
    "Suites: mft-primary: packets against multi-frusta tracing for primary rays (Benthin and Wald 2009, Table 1).",
    NULL, NULL, NULL,
};

/* A scene of the suite: its row, and the pictures that go with it. */
typedef struct entry {
    char name[STEM_BYTES], stem[STEM_BYTES + 16];
    packet_frusta_row row;
    char picture[PATH_BYTES], packet_heat[PATH_BYTES], frusta_heat[PATH_BYTES];
} entry;

typedef struct suite {
    const arguments *arguments;
    const char *out;
    unsigned width, height, jobs;
    sim_machine *machine;
    entry *entries;
    size_t count;
} suite;

static packet_frusta_side side_of(const run_result *r)
{
    const uint64_t *n = r->counts.n;
    return (packet_frusta_side){
        .rays = n[KERNEL_rays],
        .tri_accesses = n[KERNEL_tri_accesses],
        .tri_after_culling = n[KERNEL_tri_after_culling],
        .aabb_tests = n[KERNEL_aabb_tests],
        .isect_tests = n[KERNEL_isect_tests],
        .count_cycles = (sim_count_half_cycles(r->machine, r->ops) + 1) / 2,
        .issue_cycles = r->cycles,
    };
}

static base_status run_side(const suite *s, const scene *input, const char *kernel, run_result *result, base_error *err)
{
    run_options options = {.width = s->width, .height = s->height, .model = RUN_ISSUE, .jobs = s->jobs, .progress = true};
    options.kernel = kernel_find(kernel);
    options.params = options.kernel->defaults;
    options.params.cull_backface = 1; /* as the paper (MFT 5) */
    return run_kernel(input, s->machine, &options, result, err);
}

/* A file name in the output directory. */
static void path_in(const suite *s, char *path, const char *stem, const char *rest)
{
    snprintf(path, PATH_BYTES, "%.3800s/%.200s%.60s", s->out, stem, rest);
}

static base_status write_picture(const char *path, base_status made, report_image *image, base_error *err)
{
    base_status status = made == BASE_OK ? report_image_write(path, image, err) : made;
    report_image_destroy(image);
    return status;
}

/* The rendered picture, and both heat maps on one scale: the packets', which are the dearer. */
static base_status write_pictures(const suite *s, entry *e, const run_result *packet, const run_result *frusta, base_error *err)
{
    report_image image = {0};
    double top = 0;
    path_in(s, e->picture, e->stem, ".png");
    path_in(s, e->packet_heat, e->stem, "-packet16-primary-cycles.png");
    path_in(s, e->frusta_heat, e->stem, "-mft-primary-cycles.png");
    base_status status = write_picture(e->picture, picture_shaded(frusta, &image, err), &image, err);
    if (status == BASE_OK)
        status = picture_heat_top(packet, KERNEL_COUNTER_COUNT, &top, err);
    if (status == BASE_OK)
        status = write_picture(e->packet_heat, picture_heat_map(packet, KERNEL_COUNTER_COUNT, top, &image, err), &image, err);
    if (status == BASE_OK)
        status = write_picture(e->frusta_heat, picture_heat_map(frusta, KERNEL_COUNTER_COUNT, top, &image, err), &image, err);
    return status;
}

/* A stem for file names: the scene's name in plain characters, numbered if an earlier scene has the same. */
static void name_entry(suite *s, entry *e, const char *name)
{
    size_t same = 0;
    snprintf(e->name, sizeof e->name, "%s", name);
    for (const entry *other = s->entries; other < e; other++)
        same += strcmp(other->name, e->name) == 0;
    snprintf(e->stem, sizeof e->stem, "%s", name);
    for (char *c = e->stem; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '-' && *c != '_')
            *c = '_';
    if (same)
        snprintf(e->stem + strlen(e->stem), 16, "-%zu", same + 1);
}

static base_status measure(suite *s, const char *scene_name, base_error *err)
{
    scene *input = NULL;
    run_result packet = {0}, frusta = {0};
    entry *e = &s->entries[s->count];
    base_status status = scene_open(scene_name, &input, err);
    if (status == BASE_OK)
        status = run_side(s, input, "packet16-primary", &packet, err);
    if (status == BASE_OK)
        status = run_side(s, input, "mft-primary", &frusta, err);
    if (status == BASE_OK) {
        name_entry(s, e, input->name);
        e->row = (packet_frusta_row){e->name, input->triangle_count, side_of(&packet), side_of(&frusta)};
        if (!s->arguments->no_pictures)
            status = write_pictures(s, e, &packet, &frusta, err);
        s->count++;
    }
    run_result_destroy(&packet);
    run_result_destroy(&frusta);
    scene_destroy(&input);
    return status;
}

/* Write one file through a function that takes a stream. */
typedef base_status write_fn(const void *what, FILE *out, base_error *err);

static base_status write_file(const suite *s, const char *rest, write_fn *write, const void *what, base_error *err)
{
    char path[PATH_BYTES];
    base_output out;
    path_in(s, path, suite_name, rest);
    base_status status = base_output_begin(path, false, &out, err);
    if (status != BASE_OK)
        return status;
    status = write(what, out.stream, err);
    if (status != BASE_OK) {
        base_output_abort(&out);
        return status;
    }
    return base_output_commit(&out, err);
}

typedef struct two_tables {
    report_table *counts, *reductions;
} two_tables;

static base_status write_text(const void *what, FILE *out, base_error *err)
{
    const two_tables *t = what;
    base_status status = report_table_write_text(t->counts, out, err);
    fputc('\n', out);
    return status == BASE_OK ? report_table_write_text(t->reductions, out, err) : status;
}

static base_status write_csv(const void *what, FILE *out, base_error *err) { return report_table_write_csv(what, out, err); }

static base_status write_json(const void *what, FILE *out, base_error *err)
{
    const two_tables *t = what;
    json_t *both = json_pack("{s:s, s:[o, o]}", "suite", suite_name, "tables", report_table_json(t->counts), report_table_json(t->reductions));
    base_status status = report_json_write(both, out, err);
    json_decref(both);
    return status;
}

static base_status write_page(const void *what, FILE *out, base_error *err)
{
    return report_page_write((report_page *)(uintptr_t)what, out, err);
}

static base_status add_pictures(const suite *s, report_page *page, base_error *err)
{
    report_page_add_heading(page, 1, "Pictures");
    report_page_add_paragraph(page, "Left: the scene as the rays hit it, lit by a point at its light's centre, without shadows. Then simulated "
                                    "cycles per pixel (issue model) of packets and of frusta, on the scale of the packets.");
    for (size_t i = 0; i < s->count; i++) {
        const entry *e = &s->entries[i];
        const report_figure figures[] = {
            {e->picture, "rendered picture", "rendered picture"},
            {e->packet_heat, "heat map of simulated cycles, packets", "packet16-primary: cycles per pixel"},
            {e->frusta_heat, "heat map of simulated cycles, frusta", "mft-primary: cycles per pixel"},
        };
        char heading[STEM_BYTES + 40];
        snprintf(heading, sizeof heading, "%s (%llu triangles)", e->name, (unsigned long long)e->row.triangles);
        report_page_add_heading(page, 2, heading);
        base_status status = report_page_add_pictures(page, figures, 3, err);
        if (status != BASE_OK)
            return status;
    }
    return BASE_OK;
}

static base_status write_html(const suite *s, const two_tables *t, const char *caption, base_error *err)
{
    report_page *page = report_page_create("lanetrace: packets against multi-frusta tracing");
    report_page_add_paragraph(page, "Primary rays of Benthin and Wald's multi-frusta tracing (2009) against packets of 4x4 rays, on a simulated "
                                    "16-lane machine. Counts, ops and cycles are functions of scene, image size, kernel and machine alone: "
                                    "every host gives the same digits.");
    report_page_add_paragraph(page, caption);
    report_page_add_code(page, "lanetrace report mft-primary");
    report_page_add_heading(page, 1, "Tables");
    base_status status = report_page_add_table(page, t->counts, err);
    if (status == BASE_OK)
        status = report_page_add_table(page, t->reductions, err);
    if (status == BASE_OK && !s->arguments->no_pictures)
        status = add_pictures(s, page, err);
    report_page_add_heading(page, 1, "Made by");
    report_page_add_paragraph(page, VERSION_LINE);
    if (status == BASE_OK)
        status = write_file(s, ".html", write_page, page, err);
    report_page_destroy(&page);
    return status;
}

static base_status write_suite(const suite *s, base_error *err)
{
    char caption[400];
    snprintf(caption, sizeof caption, "%ux%u pixels, machine %s, back faces culled as in the paper; packets through a BVH of at most %u "
             "triangles a leaf, frusta of at most %u.", s->width, s->height, s->machine->name,
             kernel_find("packet16-primary")->defaults.max_leaf, kernel_find("mft-primary")->defaults.max_leaf);
    packet_frusta_row *rows = calloc(s->count, sizeof *rows);
    if (!rows)
        return base_fail(err, BASE_ERR_NOMEM, "report", "out of memory");
    for (size_t i = 0; i < s->count; i++)
        rows[i] = s->entries[i].row;
    two_tables t = {packet_frusta_counts(rows, s->count, caption), packet_frusta_reductions(rows, s->count, caption)};
    base_status status = write_file(s, ".txt", write_text, &t, err);
    if (status == BASE_OK)
        status = write_file(s, ".csv", write_csv, t.counts, err);
    if (status == BASE_OK)
        status = write_file(s, "-reductions.csv", write_csv, t.reductions, err);
    if (status == BASE_OK)
        status = write_file(s, ".json", write_json, &t, err);
    if (status == BASE_OK)
        status = write_html(s, &t, caption, err);
    if (status == BASE_OK)
        status = write_text(&t, stdout, err);
    report_table_destroy(&t.counts);
    report_table_destroy(&t.reductions);
    free(rows);
    return status;
}

static base_status prepare(const arguments *a, suite *s, base_error *err)
{
    unsigned long jobs = base_parallel_jobs();
    base_status status = BASE_OK;
    for (size_t i = 0; i < a->suites.count; i++)
        if (strcmp(a->suites.items[i], suite_name) != 0)
            return base_fail(err, BASE_ERR_USAGE, a->suites.items[i], "no such suite (there is %s)", suite_name);
    s->width = s->height = 1024;
    if (a->size)
        status = command_size(a->size, &s->width, &s->height, err);
    if (status == BASE_OK && a->jobs)
        status = command_number("--jobs", a->jobs, 1, 1024, &jobs, err);
    s->jobs = (unsigned)jobs;
    s->out = a->out ? a->out : "out";
    if (status == BASE_OK)
        status = command_machine(a->machine ? a->machine : "larrabee", &a->sets, &s->machine, err);
    if (status == BASE_OK && mkdir(s->out, 0777) != 0 && errno != EEXIST)
        status = base_fail(err, BASE_ERR_INPUT, s->out, "cannot be made: %s", strerror(errno));
    return status;
}

static base_status measure_all(const arguments *a, suite *s, base_error *err)
{
    size_t count = a->scenes.count;
    const char *const *scenes = count ? a->scenes.items : scene_builtin_usual(&count);
    base_status status = BASE_OK;
    s->entries = calloc(count, sizeof *s->entries);
    if (!s->entries)
        return base_fail(err, BASE_ERR_NOMEM, "report", "out of memory");
    for (size_t i = 0; status == BASE_OK && i < count; i++)
        status = measure(s, scenes[i], err);
    return status;
}

int command_report(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    suite s = {.arguments = &a};
    base_status status = command_parse(&argp, argc, argv, &a, &err);
    if (status == BASE_OK)
        status = prepare(&a, &s, &err);
    if (status == BASE_OK)
        status = measure_all(&a, &s, &err);
    if (status == BASE_OK)
        status = write_suite(&s, &err);
    free(s.entries);
    sim_machine_destroy(&s.machine);
    command_list_free(&a.suites);
    command_list_free(&a.scenes);
    command_list_free(&a.sets);
    return status == BASE_OK ? 0 : command_fail(&err);
}
