/* The core model and the slow one on the same tiles. */
#ifndef TESTS_SIM_CORE_PAIR_H
#define TESTS_SIM_CORE_PAIR_H

#include "tests/sim/slow_core.h"

enum { CORE_PAIR_TILES = 64 };

typedef struct core_pair {
    slow_core_tile tiles[CORE_PAIR_TILES]; /* with the slow simulator's regions, once it has run */
    size_t count;
    uint64_t regions[CORE_PAIR_TILES][SIM_MAX_REGIONS + 1]; /* the fast one's */
    sim_core_stats fast, slow;
    size_t next, of_thread[64]; /* while the fast one runs */
} core_pair;

/** Run both from cold caches; true if all numbers of the statistics and the regions of all tiles are equal. */
bool core_pair_run(core_pair *p, const sim_machine *machine);

/** Print the numbers that differ, as comments. */
void core_pair_print_differences(const core_pair *p);

#endif
