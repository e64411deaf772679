/* Machines next to a machine: each differs from it in one number, by one step. What a number is worth shows when they are timed.
 *
 * Steps: caches, tables and widths are halved and doubled; pipes take each other form; all other numbers go down and up by a
 * tenth, rounded, and at least by their unit (a cycle, half a cycle of throughput, a thread). Where a step leaves the field's
 * range there is no machine on that side.
 */
#ifndef SIM_NEIGHBOURS_H
#define SIM_NEIGHBOURS_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "sim/machine.h"

typedef struct sim_neighbour {
    size_t field;         /* that differs (sim_machine_field) */
    char value[24];       /* its value here, as a description writes it */
    sim_machine *machine; /* owned */
} sim_neighbour;

typedef struct sim_neighbours {
    sim_neighbour *list; /* by field, smaller values first */
    size_t count;
    size_t *stuck; /* fields that cannot change alone, for what holds between fields (sim_machine_check) */
    size_t stuck_count;
} sim_neighbours;

/**
 * @param model    fields that this model reads: "issue", "core"
 * @param classes  bit k: fields of cost class k
 * @param out      destroy with sim_neighbours_destroy, also after a failure
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_neighbours_create(const sim_machine *machine, const char *model, uint32_t classes, sim_neighbours *out, base_error *err);

/** Free what *n owns. */
void sim_neighbours_destroy(sim_neighbours *n);

#endif
