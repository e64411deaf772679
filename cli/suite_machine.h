/* Machines that differ from a suite's in a few fields: a part of the core left out, in the words of a machine description. */
#ifndef CLI_SUITE_MACHINE_H
#define CLI_SUITE_MACHINE_H

#include "cli/suite.h"

enum { SUITE_CHANGED_BYTES = 300 };

typedef struct suite_change {
    const char *field; /* l2.latency; NULL ends a list */
    const char *value; /* NULL: that of l1.latency */
} suite_change;

/** A line from anywhere is there like one of the first level, whose banks remain. */
extern const suite_change suite_without_caches[];

/** One hardware thread. */
extern const suite_change suite_without_threads[];

/** Both. */
extern const suite_change suite_without_caches_and_threads[];

/** A branch costs its slot and no more. */
extern const suite_change suite_without_mispredictions[];

typedef struct suite_machine {
    sim_machine *machine; /* owned */
    char changed[SUITE_CHANGED_BYTES]; /* "l2.latency=3, ..."; "" for no changes */
} suite_machine;

/** The suite's machine with changes, NULL for none. Errors: those of command_machine. Destroy out->machine, also after a failure. */
base_status suite_machine_create(const suite *s, const suite_change *changes, suite_machine *out, base_error *err);

#endif
