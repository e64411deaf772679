/* Ops and cycles, and where the cycles went: the part of all statistics that does not know what was run. */
#ifndef REPORTS_ACCOUNTS_H
#define REPORTS_ACCOUNTS_H

#include "lrbni/op_table.h"
#include "reports/table.h"
#include "sim/cycles.h"
#include "sim/issue.h"
#include "sim/machine.h"

enum { REPORT_RATIO_DECIMALS = 6 };

/* What a model has found. Points to what belongs to the caller. */
typedef struct report_accounts {
    const sim_machine *machine;
    const uint64_t *ops; /* LRB_OP_COUNT; markers are left out of all reports */
    uint64_t memory_operands, idle_lanes; /* as lrb_ctx has them */
    uint64_t cycles;
    const sim_issue_stats *issue; /* of the model issue; NULL: count */
    const char *const *phases;    /* names of phases 0, 1, ...; the others are named by their numbers */
    size_t phase_count;
} report_accounts;

/* Totals over the ops of a run. */
typedef struct report_op_totals {
    uint64_t total, vector, scalar, memory;
    double lane_utilisation; /* active lanes of vector ops / 16 per vector op */
} report_op_totals;

report_op_totals report_accounts_totals(const report_accounts *a);

/** A machine's `name` and `hash`; `ops`; `cycles` without what is divided by rays. New references, NULL if out of memory. */
struct json_t *report_machine_json(const sim_machine *machine);
struct json_t *report_ops_json(const report_accounts *a);
struct json_t *report_cycles_json(const report_accounts *a);

/** The buckets by name, those that are 0 left out but for the issues'; a new reference. */
struct json_t *report_stalls_json(const sim_cycles *cycles);

/**
 * Cycles by the field of the machine that they are charged to, issues of a class to its throughput.
 *
 * @param issued  issue cycles by class, LRB_CLASS_COUNT of them
 */
void report_cycles_by_field(const sim_machine *machine, const sim_cycles *cycles, const uint64_t *issued, uint64_t by_field[SIM_FIELDS]);

/** Share of the cycles that rests on each basis of the machine's numbers, summing to 1; all 0 for the model count. */
void report_basis_shares(const report_accounts *a, double share[SIM_BASIS_COUNT]);

/** The same numbers as rows `name, value` of a table of two columns, and notes below it. */
void report_accounts_rows(report_table *table, const report_accounts *a);

#endif
