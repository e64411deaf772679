/* The core model: the hardware threads of a core, which share its two pipes, its caches and its branch predictor.
 *
 * What it adds to the issue model (docs/machine-model.md has the rules in full): threads that take turns, two levels of
 * cache and memory with lines on their way, limits to these, prefetches, evictions, mispredicted branches, bank conflicts.
 * A thread takes the next tile when it runs dry, in simulated time; caches, predictor and lines on their way live on from
 * tile to tile and from run to run.
 *
 * Every cycle of every thread and every cycle of the core is in exactly one bucket: the buckets sum to the total.
 */
#ifndef SIM_CORE_H
#define SIM_CORE_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "lrbni/op_table.h"
#include "sim/cycles.h"
#include "sim/hierarchy.h"
#include "sim/machine.h"
#include "sim/observer.h"
#include "sim/profile.h"
#include "sim/warm.h"

/* All members are plain sums, so that the stats of cores add up. */
typedef struct sim_core_stats {
    uint64_t cycles;              /* of all cores, from the first cycle to the last in which any of them issued */
    sim_cycles core;         /* sums to cycles */
    sim_cycles threads;      /* sums to cycles x threads */
    uint64_t issued_by_class[LRB_CLASS_COUNT]; /* issue cycles, by the class of the first op */
    uint64_t phase[SIM_MAX_PHASES];            /* core cycles by phase of the op that began them or was waited for; 15: 15 and beyond */
    uint64_t phase_vector_ops[SIM_MAX_PHASES]; /* vector ops of the phase */
    uint64_t phase_idle_lanes[SIM_MAX_PHASES]; /* lanes that their masks switched off */
    uint64_t ops[LRB_OP_COUNT];       /* ops issued; markers too, which take no cycle */
    uint64_t op_issues[LRB_OP_COUNT]; /* cycles in which it issued, alone or first */
    uint64_t op_cycles[LRB_OP_COUNT]; /* core cycles that began with this op, or in which it was waited for */
    uint64_t memory_operands;     /* ops whose last source was in memory; loads and stores apart */
    uint64_t branches, mispredicted, btb_misses;
    uint64_t bank_conflicts;      /* ops that did not join another's cycle for its bank or its bytes */
    sim_hierarchy_counts memory;
} sim_core_stats;

/* Where tiles come from and go to. */
typedef struct sim_core_feed {
    /** The next tile for a thread, valid until the same thread is given another one; *events NULL: there is none left. */
    base_status (*next)(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err);
    /** The tile of a thread has been simulated: core cycles by region of the tile; the last one: by none. May be NULL. */
    void (*done)(void *user, unsigned thread, const uint64_t regions[SIM_MAX_REGIONS + 1]);
    void *user;
} sim_core_feed;

typedef struct sim_core sim_core;

/**
 * A core with cold caches.
 *
 * @param machine  checked (sim_machine_check); read while the core lives; owned by the caller
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_core_create(const sim_machine *machine, sim_core **out, base_error *err);

/** Free a core; sets the pointer to NULL. */
void sim_core_destroy(sim_core **core);

/** Charge the core's cycles to a profile, not NULL, as well; it must outlive the core. */
void sim_core_set_profile(sim_core *core, sim_profile *profile);

/** Tell `observer`, not NULL, of all events from now on. Cycles are counted through all runs, the first is 1. */
void sim_core_observe(sim_core *core, sim_observer *observer, void *user);

/**
 * Simulate all tiles that the feed gives. Events must have ids of ops.
 *
 * Errors: those of feed->next; the core is then of no further use.
 */
base_status sim_core_run(sim_core *core, const sim_core_feed *feed, base_error *err);

/** Make the core's caches hold what these hold, between runs; the contents are of its machine. */
void sim_core_fill(sim_core *core, const sim_contents *contents);

/** The sums over all runs. */
sim_core_stats sim_core_get(const sim_core *core);

/** Cycle of the core in which it issued last, counted through all runs; for feeds, which are asked in that cycle. */
uint64_t sim_core_cycle(const sim_core *core);

/** Put the cycles up to `cycles` after a core ran dry into its stats, and those of its threads: other cores still worked. */
void sim_core_stats_idle(sim_core_stats *stats, const sim_machine *machine, uint64_t cycles);

/** Add `from` to `to`. */
void sim_core_stats_add(sim_core_stats *to, const sim_core_stats *from);

#endif
