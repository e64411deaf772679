/* A run's statistics: as JSON (schema lanetrace-stats-1, docs/interface.md) and as a table. */
#ifndef CLI_STATS_H
#define CLI_STATS_H

#include <jansson.h>

#include "cli/run.h"
#include "reports/table.h"

/**
 * The statistics of a run.
 *
 * @param load_seconds  host time spent loading the scene
 * @param with_host     0 leaves out `host` and `build`: what remains is equal on every host
 *
 * Returns a new reference, NULL if out of memory.
 */
json_t *stats_json(const run_result *result, double load_seconds, int with_host);

/** The same numbers for people; NULL if out of memory. */
report_table *stats_table(const run_result *result, double load_seconds);

enum { STATS_TITLE_SIZE = 384 };

/** What was run, where and how, in a line. */
void stats_title(const run_result *result, char *title, size_t size);

/** Where the cycles of the run went; of RUN_ISSUE or RUN_CORE. */
sim_cycles stats_cycles(const run_result *result);

/** Cycles of the run by the field of the machine that they are charged to, issues of a class to its throughput; of RUN_ISSUE or RUN_CORE. */
void stats_cycles_by_field(const run_result *result, uint64_t cycles[SIM_FIELDS]);

/** Share of the issue model's cycles that rests on each basis of the machine's numbers, summing to 1. */
void stats_basis_shares(const run_result *result, double share[SIM_BASIS_COUNT]);

#endif
