/* What registers a run's kernel needs, and what spills would cost (sim/registers.h). Of runs with options.registers. */
#ifndef CLI_REGISTERS_REPORT_H
#define CLI_REGISTERS_REPORT_H

#include <jansson.h>

#include "cli/run.h"
#include "reports/table.h"

/** By file and phase: `max` and `mean` pressure, `stores` and `reloads`; and `spill_cycles`. A new reference. */
json_t *registers_json(const run_result *result);

/** The same for people; NULL if out of memory. */
report_table *registers_table(const run_result *result);

/**
 * Cycles that the spills would take if nothing waited for them, at their classes' throughput: a vector is stored and loaded, a
 * mask goes through a general register. A run of RUN_CORE has the spills among its events, and what they really take among its cycles;
 * other runs have not.
 */
double registers_spill_cycles(const run_result *result);

#endif
