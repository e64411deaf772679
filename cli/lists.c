/* lanetrace kernels, scenes, machines: what there is. */
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "lrbni/op_table.h"
#include "reports/table.h"
#include "scene/builtin.h"

/* The JSON form is the table's; the text form one line each. */
typedef struct list_arguments {
    base_error *err;
    bool json;
    const char *name;  /* machines: one of them, in full */
    bool takes_name;
} list_arguments;

static const struct argp_option option_table[] = {
    {"json", 'j', NULL, 0, "as JSON, with everything that is known", 0},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    list_arguments *a = state->input;
    switch (key) {
    case 'j':
        a->json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (a->takes_name && !a->name) {
            a->name = text;
            return 0;
        }
        base_fail(a->err, BASE_ERR_USAGE, text, "an argument too many");
        return EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static base_status parse_list(int argc, char **argv, const char *usage, const char *doc, list_arguments *a)
{
    const struct argp argp = {option_table, parse, usage, doc, NULL, NULL, NULL};
    return command_parse(&argp, argc, argv, a, a->err);
}

/* Write a table in the form asked for, and free it. */
static int write_list(report_table *table, bool json, base_error *err)
{
    base_status status = json ? report_table_write_json(table, stdout, err) : report_table_write_text(table, stdout, err);
    report_table_destroy(&table);
    if (status == BASE_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = base_fail(err, BASE_ERR_IO, "stdout", "cannot be written");
    return status == BASE_OK ? 0 : command_fail(err);
}

static void add_columns(report_table *table, const char *const *names)
{
    for (; *names; names++)
        report_table_add_column(table, &(report_column){.name = *names});
}

int command_kernels(int argc, char **argv)
{
    base_error err = {0};
    list_arguments a = {.err = &err};
    if (parse_list(argc, argv, NULL, "The kernels there are, and the parameters that they take.", &a) != BASE_OK)
        return command_fail(&err);
    size_t count, params;
    const kernel_info *kernels = kernel_list(&count);
    const kernel_param_info *param = kernel_param_list(&params);
    report_table *t = report_table_create("Kernels");
    add_columns(t, (const char *const[]){"name", "what it is", "source", "parameters", NULL});
    for (size_t i = 0; i < count; i++) {
        char text[256];
        size_t length = 0;
        for (size_t j = 0; j < params; j++) {
            unsigned value = kernel_param_get(&kernels[i].defaults, &param[j]);
            if (!(kernels[i].params >> j & 1))
                continue;
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%s=", length ? " " : "", param[j].name);
            length += param[j].values ? (size_t)snprintf(text + length, sizeof text - length, "%s", param[j].values[value])
                                      : (size_t)snprintf(text + length, sizeof text - length, "%u", value);
        }
        report_table_begin_row(t);
        report_table_add_text(t, kernels[i].name);
        report_table_add_text(t, kernels[i].summary);
        report_table_add_text(t, kernels[i].paper);
        report_table_add_text(t, text);
    }
    for (size_t j = 0; j < params; j++) {
        char text[256];
        size_t length = (size_t)snprintf(text, sizeof text, "%s, ", param[j].name);
        if (param[j].values)
            for (unsigned v = param[j].min; v <= param[j].max; v++)
                length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", param[j].values[v],
                                           v + 2 < param[j].max + 1 ? ", " : v < param[j].max ? " or " : "");
        else
            length += (size_t)snprintf(text + length, sizeof text - length, "%u to %u", param[j].min, param[j].max);
        snprintf(text + length, sizeof text - length, ": %s.", param[j].sentence);
        report_table_add_note(t, text);
    }
    return write_list(t, a.json, &err);
}

int command_scenes(int argc, char **argv)
{
    base_error err = {0};
    list_arguments a = {.err = &err};
    if (parse_list(argc, argv, NULL, "The built-in scenes there are.", &a) != BASE_OK)
        return command_fail(&err);
    size_t count;
    const scene_builtin *scenes = scene_builtin_list(&count);
    report_table *t = report_table_create("Built-in scenes");
    report_table_add_column(t, &(report_column){.name = "name"});
    report_table_add_column(t, &(report_column){.name = "triangles", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "stands for"});
    report_table_add_column(t, &(report_column){.name = "what it is"});
    for (size_t i = 0; i < count; i++) {
        char name[64];
        snprintf(name, sizeof name, "builtin:%s", scenes[i].name);
        report_table_begin_row(t);
        report_table_add_text(t, name);
        report_table_add_integer(t, (int64_t)scenes[i].triangle_count);
        report_table_add_text(t, scenes[i].stands_for);
        report_table_add_text(t, scenes[i].summary);
    }
    report_table_add_note(t, "Made by code from a fixed seed. A scene has the published scene's number of triangles, rounded as the paper "
                             "prints it (dragon-7m: those of the scan, where the paper prints 7M), and differs from it in everything "
                             "else.");
    return write_list(t, a.json, &err);
}

static report_table *machines_table(base_error *err)
{
    size_t count;
    const char *const *names = sim_machine_names(&count);
    report_table *t = report_table_create("Machines");
    add_columns(t, (const char *const[]){"name", "what it is", NULL});
    for (size_t i = 0; i < count; i++) {
        sim_machine *m;
        if (sim_machine_load(names[i], &m, err) != BASE_OK) {
            report_table_destroy(&t);
            return NULL;
        }
        report_table_begin_row(t);
        report_table_add_text(t, m->name);
        report_table_add_text(t, m->description);
        sim_machine_destroy(&m);
    }
    report_table_add_note(t, "'lanetrace machines NAME' prints a machine's numbers with their bases and sources.");
    return t;
}

static report_table *machine_table(const char *name, base_error *err)
{
    sim_machine *m;
    if (sim_machine_load(name, &m, err) != BASE_OK)
        return NULL;
    report_table *t = report_table_create(m->description);
    add_columns(t, (const char *const[]){"field", "value", "unit", "basis", "used by", "source", NULL});
    for (size_t n = 0; n < SIM_FIELDS; n++) {
        sim_field_view view;
        char field[64];
        if (!sim_machine_field(m, n, &view))
            continue;
        snprintf(field, sizeof field, "%s.%s", view.section, view.key);
        report_table_begin_row(t);
        report_table_add_text(t, strcmp(view.section, "machine") == 0 ? view.key : field);
        report_table_add_text(t, view.value);
        report_table_add_text(t, view.unit);
        report_table_add_text(t, view.given ? sim_basis_name(view.basis) : "default");
        report_table_add_text(t, view.used_by);
        report_table_add_text(t, view.source);
    }
    sim_machine_destroy(&m);
    return t;
}

int command_machines(int argc, char **argv)
{
    base_error err = {0};
    list_arguments a = {.err = &err, .takes_name = true};
    if (parse_list(argc, argv, "[NAME]", "The machine descriptions there are; with NAME, or the path of a description, all its numbers.", &a) != BASE_OK)
        return command_fail(&err);
    report_table *t = a.name ? machine_table(a.name, &err) : machines_table(&err);
    return t ? write_list(t, a.json, &err) : command_fail(&err);
}
