/* The memory and the branch predictor of the slow core: lists that are searched from end to end, times of last use instead of
 * orders. Written from docs/machine-model.md alone. */
#ifndef TESTS_SIM_SLOW_MEMORY_H
#define TESTS_SIM_SLOW_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

#include "sim/core.h"
#include "sim/machine.h"

/* A place of a cache or of the branch target buffer. */
typedef struct slow_entry {
    bool valid;
    uint64_t what, last_use;
    unsigned counter; /* of a branch */
} slow_entry;

typedef struct slow_table {
    unsigned sets, ways;
    slow_entry *entries;
    uint64_t uses;
} slow_table;

/* A line that was asked for. */
typedef struct slow_line {
    uint64_t line, arrival;
    int level;  /* to which it is on its way: 1 or 2 */
    int source; /* 2 or 3: memory */
} slow_line;

typedef struct slow_memory {
    const sim_machine *machine;
    slow_table level[3]; /* 1 and 2 */
    slow_table branches;
    slow_line *lines; /* all that were asked for and have perhaps not arrived */
    unsigned line_count, line_room;
    uint64_t sent[4]; /* by source: tenths of the cycle in which its last line was sent; SLOW_NONE: none yet */
    sim_hierarchy_counts *counts;
} slow_memory;

/* What an access found. */
typedef struct slow_access {
    bool asked;
    uint64_t arrival; /* 0: the line is there */
    int source;
} slow_access;

/** False if the host is out of memory; slow_memory_free is allowed then too. */
bool slow_memory_init(slow_memory *m, const sim_machine *machine, sim_hierarchy_counts *counts);
void slow_memory_free(slow_memory *m);

/** Would an access to a level have to ask for the line? */
bool slow_memory_must_ask(slow_memory *m, int level, uint64_t line, uint64_t cycle);

/** A load or store. */
slow_access slow_memory_access(slow_memory *m, uint64_t line, uint64_t cycle);

/** A prefetch to a level that must ask for the line; gives its arrival. */
uint64_t slow_memory_prefetch(slow_memory *m, int level, uint64_t line, uint64_t cycle);

/** Take a line out of a level. */
void slow_memory_evict(slow_memory *m, int level, uint64_t line);

/** Predict a branch: 0 right, 1 mispredicted, 2 missed the buffer. */
int slow_memory_branch(slow_memory *m, uint32_t site, bool taken);

#endif
