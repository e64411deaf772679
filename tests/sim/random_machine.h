/* Random machine descriptions: every field that the timing models read, within its limits. */
#ifndef TESTS_SIM_RANDOM_MACHINE_H
#define TESTS_SIM_RANDOM_MACHINE_H

#include "lrbni/base/random.h"
#include "lrbni/base/status.h"
#include "sim/machine.h"

/**
 * A built-in machine with the issue gap and all fields of the cost classes drawn anew; passes sim_machine_check.
 *
 * @param random  its state decides the machine; most latencies are a few cycles, some reach the limit of 1000
 * @param out     owned by the caller
 *
 * Errors: those of sim_machine_load, sim_machine_set and sim_machine_check, none of which is expected.
 */
base_status random_machine(base_random *random, sim_machine **out, base_error *err);

/** The same with the fields of branches, caches, memory and threads drawn as well: small caches, short latencies. */
base_status random_core_machine(base_random *random, sim_machine **out, base_error *err);

/** Print what the core model reads of a machine. */
void random_core_machine_print(const sim_machine *machine);

/** Print what the issue model reads of a machine, a comment line (# ...) per cost class. */
void random_machine_print(const sim_machine *machine);

#endif
