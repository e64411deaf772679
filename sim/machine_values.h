/* Steps of building a machine that the file reader shares with machine.c. Private to sim. */
#ifndef SIM_MACHINE_VALUES_H
#define SIM_MACHINE_VALUES_H

#include "sim/machine.h"

/* A machine whose description is compiled in. The table is made by machines/embed.py at build time. */
typedef struct sim_builtin_machine {
    const char *label; /* the file's name: "larrabee.ini" */
    const char *text;
    size_t size;
} sim_builtin_machine;

extern const size_t sim_builtin_count;
extern const char *const sim_builtin_names[];
extern const sim_builtin_machine sim_builtin_machines[];

/** Make defaults and typed members follow the given values. */
void sim_machine_refresh(sim_machine *machine);

/**
 * Number of the first field that contradicts another one, or SIM_FIELDS.
 *
 * @param why  receives the reason
 */
size_t sim_machine_flaw(const sim_machine *machine, char why[SIM_MACHINE_TEXT_SIZE]);

#endif
