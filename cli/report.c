/* lanetrace report: the suites, measured; tables as text, CSV, JSON and HTML, with pictures. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/suite.h"

enum { KEY_OUT = 256, KEY_SCENE, KEY_SIZE, KEY_KERNEL, KEY_ERROR, KEY_CACHE, KEY_JOBS, KEY_MACHINE, KEY_SET, KEY_NO_PICTURES, KEY_LIST, DOC_BYTES = 4096 };

static const struct argp_option option_table[] = {
    {"list", KEY_LIST, NULL, 0, "name the suites, and do nothing else", 0},
    {"out", KEY_OUT, "DIR", 0, "where the files go; made if it is not there; default out", 1},
    {"scene", KEY_SCENE, "SCENE", 0, "builtin:NAME, or a .glb or .gltf file, instead of the suite's own scenes; repeatable", 1},
    {"size", KEY_SIZE, "WxH", 0, "image size in pixels; default: the suite's own", 1},
    {"kernel", KEY_KERNEL, "KERNEL", 0, "a kernel instead of all, in the suites that compare models; repeatable", 1},
    {"error", KEY_ERROR, "E", 0, "simulate as few tiles as bound the relative error of the cycles by E (95%), in the suites that "
                                 "take cycles of the core model", 2},
    {"machine", KEY_MACHINE, "M", 0, "a machine (see lanetrace machines), or a description's path; default larrabee", 2},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a field of the machine; repeatable", 2},
    {"cache", KEY_CACHE, "DIR", 0, "keep kd-trees in DIR: what was built once is read the next time", 2},
    {"jobs", KEY_JOBS, "N", 0, "host threads; default: the suite's own, mostly all", 2},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "tables only", 3},
    {0},
};

typedef struct arguments {
    base_error *err;
    const char *out, *size, *error, *cache, *jobs, *machine;
    bool no_pictures, list;
    command_list suites, scenes, sets, kernels;
} arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_LIST: a->list = true; return 0;
    case KEY_OUT: a->out = text; return 0;
    case KEY_SIZE: a->size = text; return 0;
    case KEY_ERROR: a->error = text; return 0;
    case KEY_CACHE: a->cache = text; return 0;
    case KEY_JOBS: a->jobs = text; return 0;
    case KEY_MACHINE: a->machine = text; return 0;
    case KEY_NO_PICTURES: a->no_pictures = true; return 0;
    case KEY_SCENE: return command_list_add(&a->scenes, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_KERNEL: return command_list_add(&a->kernels, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case KEY_SET: return command_list_add(&a->sets, text, a->err) == BASE_OK ? 0 : ENOMEM;
    case ARGP_KEY_ARG: return command_list_add(&a->suites, text, a->err) == BASE_OK ? 0 : ENOMEM;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void write_list(FILE *out)
{
    size_t count;
    const suite_info *const *suites = suite_list(&count);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "  %-16s %s\n", suites[i]->name, suites[i]->summary);
}

/* The suites are named in the help, so it is made when the program runs. */
static base_status parse_arguments(int argc, char **argv, arguments *a, base_error *err)
{
    static char doc[DOC_BYTES];
    FILE *out = fmemopen(doc, sizeof doc, "w");
    if (!out)
        return base_fail(err, BASE_ERR_NOMEM, "report", "out of memory");
    fputs("Measure the suites, or the first one if none is named, and write their tables to DIR as text, CSV, JSON and HTML, with "
          "pictures.\vSuites:\n", out);
    write_list(out);
    fclose(out);
    const struct argp argp = {option_table, parse, "[SUITE...]", doc, NULL, NULL, NULL};
    return command_parse(&argp, argc, argv, a, err);
}

static base_status check_suite(const arguments *a, const char *name, base_error *err)
{
    const suite_info *info = suite_find(name);
    if (!info)
        return base_fail(err, BASE_ERR_USAGE, name, "no such suite (see lanetrace report --list)");
    if (a->kernels.count && !(info->takes & SUITE_TAKES_KERNELS))
        return base_fail(err, BASE_ERR_USAGE, "--kernel", "suite %s compares kernels of its own", name);
    if (a->error && !(info->takes & SUITE_TAKES_ERROR))
        return base_fail(err, BASE_ERR_USAGE, "--error", "suite %s takes no cycles of sampled tiles", name);
    return BASE_OK;
}

static base_status check_suites(arguments *a, base_error *err)
{
    size_t count;
    base_status status = BASE_OK;
    const kernel_info *kernel;
    if (!a->suites.count)
        status = command_list_add(&a->suites, suite_list(&count)[0]->name, err);
    for (size_t i = 0; status == BASE_OK && i < a->suites.count; i++)
        status = check_suite(a, a->suites.items[i], err);
    for (size_t i = 0; status == BASE_OK && i < a->kernels.count; i++)
        status = command_kernel(a->kernels.items[i], &kernel, err);
    return status;
}

static base_status prepare(const arguments *a, suite_options *o, sim_machine **machine, base_error *err)
{
    unsigned long jobs = 0;
    base_status status = BASE_OK;
    *o = (suite_options){.out = a->out ? a->out : "out", .no_pictures = a->no_pictures, .machine_name = a->machine, .cache = a->cache,
                         .scenes = a->scenes, .sets = a->sets, .kernels = a->kernels};
    if (a->size)
        status = command_size(a->size, &o->width, &o->height, err);
    if (status == BASE_OK && a->error)
        status = command_real("--error", a->error, 0, 1, &o->error, err);
    if (status == BASE_OK && a->jobs)
        status = command_number("--jobs", a->jobs, 1, 1024, &jobs, err);
    o->jobs = (unsigned)jobs;
    if (status == BASE_OK)
        status = command_machine(a->machine ? a->machine : "larrabee", &a->sets, machine, err);
    o->machine = *machine;
    if (status == BASE_OK && mkdir(o->out, 0777) != 0 && errno != EEXIST)
        status = base_fail(err, BASE_ERR_INPUT, o->out, "cannot be made: %s", strerror(errno));
    return status;
}

static base_status run_suites(const arguments *a, const suite_options *o, base_error *err)
{
    base_status status = BASE_OK;
    for (size_t i = 0; status == BASE_OK && i < a->suites.count; i++) {
        if (i)
            putchar('\n');
        status = suite_run(suite_find(a->suites.items[i]), o, err);
    }
    return status;
}

int command_report(int argc, char **argv)
{
    base_error err = {0};
    arguments a = {.err = &err};
    suite_options options;
    sim_machine *machine = NULL;
    base_status status = parse_arguments(argc, argv, &a, &err);
    if (status == BASE_OK && a.list) {
        write_list(stdout);
    } else {
        if (status == BASE_OK)
            status = check_suites(&a, &err);
        if (status == BASE_OK)
            status = prepare(&a, &options, &machine, &err);
        if (status == BASE_OK)
            status = run_suites(&a, &options, &err);
    }
    sim_machine_destroy(&machine);
    command_list_free(&a.suites);
    command_list_free(&a.scenes);
    command_list_free(&a.sets);
    command_list_free(&a.kernels);
    return status == BASE_OK ? 0 : command_fail(&err);
}
