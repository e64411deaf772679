/* The memory of a core in time: two levels of cache, memory, and the lines on their way.
 *
 * Which lines are there is sim/cache.h's; this adds when they come. A line is asked for in the order of the accesses;
 * a level sends lines no closer to each other than its cycles_per_line, and each arrives its latency, less that of the first
 * level, after it was sent: as if the access had happened, and hit, then. An access to a line that is on its way waits
 * for it and asks for nothing. docs/machine-model.md has the rules in full.
 */
#ifndef SIM_HIERARCHY_H
#define SIM_HIERARCHY_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "sim/cache.h"
#include "sim/machine.h"

typedef enum sim_level { SIM_LEVEL_1, SIM_LEVEL_2, SIM_LEVEL_MEMORY } sim_level;

/* Lines on their way to a level. */
typedef struct sim_flight {
    unsigned count;
    uint64_t latest; /* arrival of the last one */
    struct {
        uint64_t line, arrival;
        sim_level from;
    } *lines; /* owned */
} sim_flight;

typedef struct sim_hierarchy_counts {
    uint64_t l1_accesses; /* of loads, stores and memory operands, by the line */
    uint64_t l1_waits;    /* of these: to a line that was on its way */
    uint64_t l1_misses;   /* of these: that asked for a line */
    uint64_t l2_accesses; /* lines that the first level asked for, prefetches included */
    uint64_t l2_misses;   /* of these: lines that came from memory */
    uint64_t prefetches;         /* that asked for a line */
    uint64_t dropped_prefetches; /* of lines that were there or on their way, or because there may be none */
    uint64_t memory_lines;       /* all lines that came from memory */
} sim_hierarchy_counts;

typedef struct sim_hierarchy {
    sim_cache *l1, *l2;
    uint32_t *known; /* owned; by sim_known_slot: place of a line that was in the first level, and not on its way, when it was last used */
    uint32_t known_count;
    uint64_t *lines, *used; /* of l1, at hand */
    unsigned known_shift;
    sim_flight to_l1, to_l2;
    uint64_t l2_free, memory_free; /* tenths of a cycle: when the level can send the next line */
    uint32_t l2_line_tenths, memory_line_tenths;
    uint32_t l2_extra, memory_extra; /* cycles beyond a hit in the first level */
    sim_hierarchy_counts counts;
} sim_hierarchy;

/* What became of an access. */
typedef struct sim_fetch {
    uint64_t arrival; /* of the line in the level it was asked for; 0: it is there */
    sim_level from;
    bool asked; /* a line was sent for */
} sim_fetch;

/**
 * Cold caches and an idle memory.
 *
 * @param lines  that can be on their way at once, at most
 *
 * Errors: BASE_ERR_NOMEM, those of sim_cache_create.
 */
base_status sim_hierarchy_create(const sim_machine *machine, unsigned lines, sim_hierarchy **out, base_error *err);

/** Free a hierarchy, which may be NULL, and set the pointer to NULL. */
void sim_hierarchy_destroy(sim_hierarchy **h);

/** Whether an access to a line would have to ask for it: neither in the first level nor on its way there. */
bool sim_hierarchy_would_miss(const sim_hierarchy *h, uint64_t line, uint64_t now);

/** The same for the second level. */
bool sim_hierarchy_would_miss_l2(const sim_hierarchy *h, uint64_t line, uint64_t now);

/** Where a line's place may be in h->known: for sim_hierarchy_hits. */
static inline uint32_t sim_known_slot(uint64_t line, unsigned known_shift)
{
    return (uint32_t)line * UINT32_C(0x9e3779b1) >> known_shift;
}

/**
 * Use a line if it is known to be in the first level and not on its way there. False: nothing was done, sim_hierarchy_access says
 * more. SIM_NO_LINE always hits: so ops that access nothing need no branch that a host would have to foresee.
 */
static inline bool sim_hierarchy_hits(sim_hierarchy *h, uint64_t line, uint32_t slot)
{
    const uint32_t place = h->known[slot];
    if (h->lines[place] != line)
        return false;
    h->used[place] = ++h->l1->uses;
    return true;
}

/** Load from or store to a line. Times never go back. h->counts.l1_accesses is the caller's. */
sim_fetch sim_hierarchy_access(sim_hierarchy *h, uint64_t line, uint64_t now);

/** Bring a line to the first level (level 1) or the second (2), for a prefetch that sim_hierarchy_would_miss. */
sim_fetch sim_hierarchy_prefetch(sim_hierarchy *h, uint64_t line, uint64_t now, sim_level level);

#endif
