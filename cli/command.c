#include "cli/command.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/job.h"

int command_fail(const base_error *err)
{
    fprintf(stderr, "lanetrace: error: %s: %s\n", err->what, err->why);
    return base_exit_code(err->status);
}

/* A subcommand's own parser and input, and where the parsing stands: argp itself does not tell which word it could not
   make sense of. */
typedef struct parse_state {
    argp_parser_t parser;
    void *input;
    int next; /* index of the first word after those parsed so far */
} parse_state;

static error_t parse_and_note(int key, char *text, struct argp_state *state)
{
    parse_state *p = state->input;
    if (key != ARGP_KEY_ERROR && key != ARGP_KEY_FINI)
        p->next = state->next;
    state->input = p->input;
    error_t result = p->parser(key, text, state);
    state->input = p;
    return result;
}

base_status command_parse(const struct argp *argp, int argc, char **argv, void *input, base_error *err)
{
    parse_state p = {.parser = argp->parser, .input = input};
    struct argp noting = *argp;
    noting.parser = parse_and_note;
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-?") == 0) {
            argp_help(argp, stdout, ARGP_HELP_STD_HELP & ~ARGP_HELP_BUG_ADDR, argv[0]);
            exit(0);
        }
    err->status = BASE_OK;
    error_t result = argp_parse(&noting, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP | ARGP_IN_ORDER, NULL, &p);
    if (err->status != BASE_OK)
        return err->status;
    if (result != 0) {
        int word = p.next < 1 ? 1 : p.next < argc ? p.next : argc - 1;
        return base_fail(err, BASE_ERR_USAGE, argv[word], "not an option of '%s', or without its value (see %s --help)", argv[0], argv[0]);
    }
    return BASE_OK;
}

base_status command_number(const char *option, const char *text, unsigned long min, unsigned long max, unsigned long *out, base_error *err)
{
    char *end;
    errno = 0;
    *out = strtoul(text, &end, 10);
    if (*text < '0' || *text > '9' || *end || errno || *out < min || *out > max)
        return base_fail(err, BASE_ERR_USAGE, option, "'%s' is not a whole number in %lu..%lu", text, min, max);
    return BASE_OK;
}

base_status command_real(const char *option, const char *text, double min, double max, double *out, base_error *err)
{
    char *end;
    *out = strtod(text, &end);
    if (end == text || *end || !isfinite(*out) || *out < min || *out > max)
        return base_fail(err, BASE_ERR_USAGE, option, "'%s' is not a number in %g..%g", text, min, max);
    return BASE_OK;
}

base_status command_size(const char *text, unsigned *width, unsigned *height, base_error *err)
{
    unsigned long w, h;
    char *end = NULL;
    errno = 0;
    w = strtoul(text, &end, 10);
    bool good = *text >= '0' && *text <= '9' && *end == 'x' && end[1] >= '0' && end[1] <= '9';
    h = good ? strtoul(end + 1, &end, 10) : 0;
    if (!good || *end)
        return base_fail(err, BASE_ERR_USAGE, "--size", "'%s' is not WIDTHxHEIGHT", text);
    if (errno || w < 1 || h < 1 || w > JOB_MAX_SIZE || h > JOB_MAX_SIZE)
        return base_fail(err, BASE_ERR_USAGE, "--size", "%s: width and height must be in 1..%u", text, JOB_MAX_SIZE);
    *width = (unsigned)w;
    *height = (unsigned)h;
    return BASE_OK;
}

base_status command_list_add(command_list *list, const char *item, base_error *err)
{
    const char **items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items)
        return base_fail(err, BASE_ERR_NOMEM, "command line", "out of memory");
    list->items = items;
    list->items[list->count++] = item;
    return BASE_OK;
}

base_status command_only(const char **taken, const char *what, const char *text, base_error *err)
{
    if (*taken)
        return base_fail(err, BASE_ERR_USAGE, text, "one %s at a time: '%s' was given already", what, *taken);
    *taken = text;
    return BASE_OK;
}

void command_list_free(command_list *list)
{
    free(list->items);
    *list = (command_list){0};
}

base_status command_machine(const char *name, const command_list *sets, sim_machine **out, base_error *err)
{
    base_status status = sim_machine_load(name, out, err);
    for (size_t i = 0; status == BASE_OK && i < sets->count; i++)
        status = sim_machine_set(*out, sets->items[i], err);
    if (status == BASE_OK)
        status = sim_machine_check(*out, err);
    if (status != BASE_OK)
        sim_machine_destroy(out);
    return status;
}

base_status command_kernel(const char *name, const kernel_info **out, base_error *err)
{
    char names[256] = "";
    size_t count, length = 0;
    const kernel_info *kernels = kernel_list(&count);
    *out = kernel_find(name);
    if (*out)
        return BASE_OK;
    for (size_t i = 0; i < count && length < sizeof names; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", i ? ", " : "", kernels[i].name);
    return base_fail(err, BASE_ERR_USAGE, name, "no such kernel (there are %s)", names);
}
