#include "cli/suite.h"

#include <ctype.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/version.h"
#include "lrbni/base/output_file.h"
#include "lrbni/base/parallel.h"
#include "reports/image_writer.h"
#include "scene/builtin.h"

#define SUITE(name) extern const suite_info suite_##name;
#include "cli/suites/suites.def"
#undef SUITE

const suite_info *const *suite_list(size_t *count)
{
#define SUITE(name) &suite_##name,
    static const suite_info *const suites[] = {
#include "cli/suites/suites.def"
    };
#undef SUITE
    *count = sizeof suites / sizeof *suites;
    return suites;
}

const suite_info *suite_find(const char *name)
{
    size_t count;
    const suite_info *const *suites = suite_list(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(suites[i]->name, name) == 0)
            return suites[i];
    return NULL;
}

static size_t default_scenes(const suite *s)
{
    size_t count = 0;
    if (!s->info->scenes)
        (void)scene_builtin_usual(&count);
    else
        while (s->info->scenes[count])
            count++;
    return count;
}

/* What scene_open takes for scene number i. */
static const char *scene_argument(const suite *s, size_t i)
{
    size_t count;
    if (s->options->scenes.count)
        return s->options->scenes.items[i];
    return s->info->scenes ? s->info->scenes[i] : scene_builtin_usual(&count)[i];
}

static void name_scene(const suite *s, suite_scene *on, const char *name)
{
    size_t same = 0;
    snprintf(on->name, sizeof on->name, "%s", name);
    for (const suite_scene *other = s->scenes; other < on; other++)
        same += strcmp(other->name, on->name) == 0;
    snprintf(on->stem, SUITE_NAME_BYTES, "%s", name);
    for (char *c = on->stem; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '-' && *c != '_')
            *c = '_';
    if (same)
        snprintf(on->stem + strlen(on->stem), 16, "-%zu", same + 1);
}

static base_status open_scene(suite *s, size_t i, base_error *err)
{
    suite_scene *on = &s->scenes[i];
    if (on->scene)
        return BASE_OK;
    base_status status = scene_open(scene_argument(s, i), &on->scene, err);
    if (status == BASE_OK) {
        name_scene(s, on, on->scene->name);
        on->triangles = on->scene->triangle_count;
    }
    return status;
}

base_status suite_open_scenes(suite *s, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < s->scene_count; i++)
        status = open_scene(s, i, err);
    return status;
}

base_status suite_each_scene(suite *s, suite_scene_fn *measure, void *user, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < s->scene_count; i++) {
        status = open_scene(s, i, err);
        if (status == BASE_OK)
            status = measure(s, &s->scenes[i], user, err);
        scene_destroy(&s->scenes[i].scene);
    }
    return status;
}

run_options suite_run_options(const suite *s, const kernel_info *kernel, run_model model)
{
    return (run_options){.kernel = kernel, .params = kernel->defaults, .width = s->width, .height = s->height, .model = model,
                         .error = model == RUN_CORE ? s->options->error : 0, .jobs = s->jobs, .cache = s->options->cache, .progress = true};
}

base_status suite_add_table(suite *s, const char *suffix, report_table *table, base_error *err)
{
    suite_table *tables = realloc(s->tables, (s->table_count + 1) * sizeof *tables);
    if (!tables) {
        report_table_destroy(&table);
        return base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    }
    s->tables = tables;
    tables[s->table_count++] = (suite_table){suffix, table};
    return report_page_add_table(s->page, table, err);
}

void suite_path(const suite *s, char path[SUITE_PATH_BYTES], const char *stem, const char *rest)
{
    snprintf(path, SUITE_PATH_BYTES, "%.3800s/%.200s%.60s", s->options->out, stem, rest);
}

base_status suite_write_picture(const char *path, base_status made, report_image *image, base_error *err)
{
    base_status status = made == BASE_OK ? report_image_write(path, image, err) : made;
    report_image_destroy(image);
    return status;
}

base_status suite_add_plot(suite *s, const char *suffix, const report_plot *plot, const char *caption, base_error *err)
{
    char path[SUITE_PATH_BYTES], rest[64];
    if (s->options->no_pictures)
        return BASE_OK;
    snprintf(rest, sizeof rest, "%.50s.png", suffix);
    suite_path(s, path, s->info->name, rest);
    base_status status = report_plot_write(path, plot, err);
    if (status == BASE_ERR_UNSUPPORTED) {
        char words[SUITE_PATH_BYTES + 300];
        snprintf(words, sizeof words, "The plot '%s' is left out: there was no gnuplot to draw it.", plot->title);
        report_page_add_paragraph(s->page, words);
        fprintf(stderr, "lanetrace: note: %s: left out, there is no gnuplot (Debian package gnuplot-nox)\n", path);
        return BASE_OK;
    }
    if (status != BASE_OK)
        return status;
    return report_page_add_pictures(s->page, &(report_figure){path, plot->title, caption}, 1, err);
}

/* Write one file through a function that takes a stream. */
typedef base_status write_fn(const void *what, FILE *out, base_error *err);

static base_status write_file(const suite *s, const char *rest, write_fn *write, const void *what, base_error *err)
{
    char path[SUITE_PATH_BYTES];
    base_output out;
    suite_path(s, path, s->info->name, rest);
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

static base_status write_text(const void *what, FILE *out, base_error *err)
{
    const suite *s = what;
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < s->table_count; i++) {
        if (i)
            fputc('\n', out);
        status = report_table_write_text(s->tables[i].table, out, err);
    }
    return status;
}

static base_status write_csv(const void *what, FILE *out, base_error *err) { return report_table_write_csv(what, out, err); }

static base_status write_json(const void *what, FILE *out, base_error *err)
{
    const suite *s = what;
    json_t *tables = json_array();
    for (size_t i = 0; i < s->table_count; i++)
        json_array_append_new(tables, report_table_json(s->tables[i].table));
    const bool whole = json_array_size(tables) == s->table_count;
    json_t *all = json_pack("{s:s, s:o}", "suite", s->info->name, "tables", tables);
    base_status status = whole ? report_json_write(all, out, err) : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
    json_decref(all);
    return status;
}

static base_status write_page(const void *what, FILE *out, base_error *err) { return report_page_write(((const suite *)what)->page, out, err); }

static void put_list(FILE *out, const char *option, const command_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        fprintf(out, " %s '%s'", option, list->items[i]);
}

/* The command that measures the same, but for where the files go. */
static void add_command(const suite *s)
{
    char *text = NULL;
    size_t size = 0;
    const suite_options *o = s->options;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    fprintf(out, "lanetrace report %s", s->info->name);
    put_list(out, "--scene", &o->scenes);
    put_list(out, "--kernel", &o->kernels);
    if (o->width)
        fprintf(out, " --size %ux%u", o->width, o->height);
    if (o->error > 0)
        fprintf(out, " --error %g", o->error);
    if (o->machine_name)
        fprintf(out, " --machine '%s'", o->machine_name);
    put_list(out, "--set", &o->sets);
    fclose(out);
    report_page_add_code(s->page, text ? text : "");
    free(text);
}

static base_status write_files(const suite *s, base_error *err)
{
    base_status status = write_file(s, ".txt", write_text, s, err);
    for (size_t i = 0; status == BASE_OK && i < s->table_count; i++) {
        char rest[64];
        snprintf(rest, sizeof rest, "%.50s.csv", s->tables[i].suffix);
        status = write_file(s, rest, write_csv, s->tables[i].table, err);
    }
    if (status == BASE_OK)
        status = write_file(s, ".json", write_json, s, err);
    if (status == BASE_OK)
        status = write_file(s, ".html", write_page, s, err);
    return status == BASE_OK ? write_text(s, stdout, err) : status;
}

static base_status create(suite *s, base_error *err)
{
    char title[200];
    const suite_options *o = s->options;
    s->width = o->width ? o->width : s->info->size;
    s->height = o->width ? o->height : s->info->size;
    s->jobs = o->jobs ? o->jobs : s->info->jobs ? s->info->jobs : base_parallel_jobs();
    s->scene_count = o->scenes.count ? o->scenes.count : default_scenes(s);
    s->scenes = calloc(s->scene_count, sizeof *s->scenes);
    snprintf(title, sizeof title, "lanetrace: %s", s->info->title);
    s->page = report_page_create(title);
    report_page_add_paragraph(s->page, s->info->about);
    return s->scenes ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, s->info->name, "out of memory");
}

base_status suite_run(const suite_info *info, const suite_options *options, base_error *err)
{
    suite s = {.info = info, .options = options};
    base_status status = create(&s, err);
    if (status == BASE_OK)
        status = info->measure(&s, err);
    if (status == BASE_OK) {
        report_page_add_heading(s.page, 1, "Made by");
        add_command(&s);
        report_page_add_paragraph(s.page, VERSION_LINE);
        status = write_files(&s, err);
    }
    for (size_t i = 0; i < s.table_count; i++)
        report_table_destroy(&s.tables[i].table);
    for (size_t i = 0; s.scenes && i < s.scene_count; i++)
        scene_destroy(&s.scenes[i].scene);
    free(s.tables);
    free(s.scenes);
    report_page_destroy(&s.page);
    return status;
}
