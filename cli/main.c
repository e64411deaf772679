/* lanetrace: runs ray-tracing kernels on a simulated 16-lane machine and reports what they did. */
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/version.h"

static const struct subcommand {
    const char *name, *usage, *summary;
    command_fn *run;
} subcommands[] = {
    {"run-kernel", "KERNEL --scene SCENE", "one kernel, one scene: statistics and pictures", command_run_kernel},
    {"report", "[SUITE...] [--out DIR]", "the papers' tables, measured, beside the papers' values", command_report},
    {"regress", "[SUITE...] [--update]", "counts, ops and cycles against the stored baselines", command_regress},
    {"replay", "TRACE [--machine M]...", "time a recorded trace on other machines, or export it", command_replay},
    {"sensitivity", "KERNEL|TRACE [--scene SCENE]", "what each number of a machine is worth in cycles", command_sensitivity},
    {"kernels", "[--json]", "the kernels there are", command_kernels},
    {"scenes", "[--json]", "the built-in scenes there are", command_scenes},
    {"machines", "[NAME] [--json]", "the machine descriptions there are, and their numbers", command_machines},
    {"ops", "[--machine M] [--json]", "the ops of the vector ISA, and what they cost", command_ops},
};
enum { SUBCOMMANDS = sizeof subcommands / sizeof *subcommands };

static void print_help(void)
{
    printf("Usage: lanetrace SUBCOMMAND [ARGUMENTS]\n"
           "Ray-tracing kernels on a simulated Larrabee-style machine: counts, simulated cycles, pictures.\n\n");
    for (int i = 0; i < SUBCOMMANDS; i++)
        printf("  %-11s %-28s %s\n", subcommands[i].name, subcommands[i].usage, subcommands[i].summary);
    printf("\n'lanetrace SUBCOMMAND --help' tells more; 'lanetrace --version' tells version, compiler and back end.\n"
           "Exit codes: 0 success, 1 a comparison found differences, 2 wrong usage or input, 3 the host failed.\n");
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "--help";
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        print_help();
        return argc > 1 ? 0 : 2;
    }
    if (strcmp(name, "--version") == 0) {
        printf("%s\n", VERSION_LINE);
        return 0;
    }
    for (int i = 0; i < SUBCOMMANDS; i++) {
        if (strcmp(name, subcommands[i].name) != 0)
            continue;
        char full_name[64];
        snprintf(full_name, sizeof full_name, "lanetrace %s", name);
        argv[1] = full_name;
        return subcommands[i].run(argc - 1, argv + 1);
    }
    base_error err;
    base_fail(&err, BASE_ERR_USAGE, name, "no such subcommand (see lanetrace --help)");
    return command_fail(&err);
}
