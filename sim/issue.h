/* The issue model: U and V pipes, operand latencies, one thread, every access an L1 hit, branches predicted.
 *
 * What it models, tile by tile, from an empty pipeline (docs/machine-model.md has the rules in full):
 * - in order; at most two ops a cycle: an op that may issue in V joins the op before it, which issued in U, if nothing
 *   holds it up (a jump's flags may come from that op, if latency_to_branch is 0); nothing joins an op that blocks;
 * - operands: an op waits for each source until the producer's latency for that kind of consumer has passed (ordinary,
 *   swizzled or stored vector, jump, address; sim/machine_fields.def);
 * - loads wait for stores to the same 32-bit words. The table has one line for each remainder of the line number by 64;
 *   a store to another line of that place replaces it. A store to a line that is still under way joins it: the words
 *   of both are ready when the later of the two is;
 * - classes with a throughput of a cycle or more issue no closer than that, rounded up to whole cycles; two ops of such
 *   a class never share a cycle; blocking ops stop the thread;
 * - consecutive issue cycles are at least issue_gap apart; what passes beyond that is put down to the reason that ends
 *   last, of equal ones to the last of operand (by class, then consumer), store, busy, blocked.
 * What it leaves out: caches, other threads, mispredictions, instruction fetch, bank conflicts: those are the core model.
 *
 * Every cycle of a tile is in exactly one bucket: the buckets sum to the total.
 */
#ifndef SIM_ISSUE_H
#define SIM_ISSUE_H

#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "lrbni/op_table.h"
#include "sim/cycles.h"
#include "sim/machine.h"
#include "sim/observer.h"
#include "sim/profile.h"

/* Where the cycles went; plain sums, so that stats of tiles add up. */
typedef struct sim_issue_stats {
    uint64_t cycles;
    uint64_t issued_one, issued_pair; /* cycles in which one op, or two, issued */
    uint64_t gap;                     /* cycles that the thread must let pass between issues */
    uint64_t blocked;                 /* behind an op that blocks the thread */
    uint64_t busy[LRB_CLASS_COUNT];   /* the op's class was still busy */
    uint64_t operand[LRB_CLASS_COUNT][SIM_CONSUMERS]; /* waiting for a result of that class, by the waiting operand */
    uint64_t store_forward;           /* a load waiting for a store to the same words */
    uint64_t issued_by_class[LRB_CLASS_COUNT]; /* issue cycles, by the class of the first op: sums to issued_one + issued_pair */
    uint64_t phase[SIM_MAX_PHASES];   /* cycles by phase of the op that began them or was waited for; 15: 15 and beyond */
    uint64_t phase_vector_ops[SIM_MAX_PHASES]; /* vector ops of the phase */
    uint64_t phase_idle_lanes[SIM_MAX_PHASES]; /* lanes that their masks switched off */
    uint64_t ops[LRB_OP_COUNT];       /* ops issued; markers too, which take no cycle */
    uint64_t op_issues[LRB_OP_COUNT]; /* cycles in which it issued, alone or first */
    uint64_t op_cycles[LRB_OP_COUNT]; /* cycles that began with this op, or in which it was waited for */
    uint64_t memory_operands;         /* ops whose last source was in memory; loads and stores apart */
} sim_issue_stats;

typedef struct sim_issue sim_issue;

/**
 * A simulator for one stream at a time.
 *
 * @param machine  read while the simulator lives; owned by the caller
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status sim_issue_create(const sim_machine *machine, sim_issue **out, base_error *err);

/** Free a simulator; sets the pointer to NULL. */
void sim_issue_destroy(sim_issue **s);

/** Charge cycles to a profile as well, which must outlive the simulator or the next call; NULL: no more. Not within a tile. */
void sim_issue_set_profile(sim_issue *s, sim_profile *profile);

/** Begin a tile: an empty pipeline, phase 0, region 'whole tile'. */
void sim_issue_begin(sim_issue *s);

/** Time the next events of the tile. Has the signature of lrb_event_sink; `s` is the sim_issue. Ids must be those of ops. */
void sim_issue_events(void *s, const lrb_event *events, uint32_t count);

/** Tell `observer` of all events from now on; NULL: nobody. Cycles are those of the tile, the first is 1; the thread is 0. */
void sim_issue_observe(sim_issue *s, sim_observer *observer, void *user);

/**
 * End the tile: its cycles, from the first issue to the last, are added to the stats.
 *
 * @param regions  out, SIM_MAX_REGIONS + 1 entries: cycles spent for each region of the tile; the last entry: those
 *                 given to no region
 */
void sim_issue_end(sim_issue *s, uint64_t regions[SIM_MAX_REGIONS + 1]);

/** The sums over all tiles that have ended. */
const sim_issue_stats *sim_issue_get(const sim_issue *s);

/** Add `from` to `to`. */
void sim_issue_stats_add(sim_issue_stats *to, const sim_issue_stats *from);

#endif
