/* The subcommands, and what they share: parsing with argp, one way to print an error. */
#ifndef CLI_COMMAND_H
#define CLI_COMMAND_H

#include <argp.h>
#include <stdbool.h>

#include "kernels/kernel.h"
#include "lrbni/base/status.h"
#include "sim/machine.h"

/* Runs one subcommand: argv[0] is "lanetrace NAME". Returns the exit code. */
typedef int command_fn(int argc, char **argv);

command_fn command_run_kernel, command_report, command_regress, command_replay, command_sensitivity, command_kernels, command_scenes,
    command_machines, command_ops;

/** Print `lanetrace: error: WHAT: WHY` on stderr and return the exit code of the status. */
int command_fail(const base_error *err);

/**
 * Parse the arguments of a subcommand.
 *
 * @param argp   its parser returns 0, or a base_status after filling in *err (see command_parser_fail)
 * @param input  passed to the parser as state->input
 *
 * Returns BASE_OK or a failure with *err filled in: an unknown option, a missing value, or what the parser found.
 * --help and --usage print and exit with 0.
 */
base_status command_parse(const struct argp *argp, int argc, char **argv, void *input, base_error *err);

/** An unsigned number in [min, max]. Errors: BASE_ERR_USAGE naming the option. */
base_status command_number(const char *option, const char *text, unsigned long min, unsigned long max, unsigned long *out, base_error *err);

/** A finite number in [min, max]. Errors: BASE_ERR_USAGE naming the option. */
base_status command_real(const char *option, const char *text, double min, double max, double *out, base_error *err);

/** "1024x768". Errors: BASE_ERR_USAGE (no size, 0, beyond JOB_MAX_SIZE). */
base_status command_size(const char *text, unsigned *width, unsigned *height, base_error *err);

/* A list of option values, in order; the strings are argv's. */
typedef struct command_list {
    const char **items;
    size_t count;
} command_list;

/** Append to a list; free it with command_list_free. Errors: BASE_ERR_NOMEM. */
base_status command_list_add(command_list *list, const char *item, base_error *err);
void command_list_free(command_list *list);

/** Take the one argument of a command; `what` names it in the error. Errors: BASE_ERR_USAGE if there was one already. */
base_status command_only(const char **taken, const char *what, const char *text, base_error *err);

/** Load a machine and apply --set overrides. Errors: those of sim_machine_load, _set and _check. */
base_status command_machine(const char *name, const command_list *sets, sim_machine **out, base_error *err);

/** The kernel of that name. Errors: BASE_ERR_USAGE, with the names there are. */
base_status command_kernel(const char *name, const kernel_info **out, base_error *err);

#endif
