/* The state of the core model, and the steps of an op that are shared by its files. Private to sim. */
#ifndef SIM_CORE_STATE_H
#define SIM_CORE_STATE_H

#include <stdbool.h>

#include "lrbni/memory.h"
#include "sim/branch.h"
#include "sim/core.h"
#include "sim/pipeline.h"
#include "sim/profile_charge.h"
#include "sim/slots.h"

/* Turns are blamed times that have a thread's place in the order of choice instead of the bucket. */
enum { CORE_TURN = 256 };
#define CORE_NEVER (UINT64_MAX - (CORE_TURN - 1))

enum { CORE_MAX_THREADS = 64 }; /* a machine has no more */
enum { CORE_SOURCES = 2 };
enum { CORE_OPS = 512, CORE_FORMS = UINT16_MAX + 1 };
_Static_assert((int)LRB_OP_COUNT <= CORE_OPS, "the counters have a place for every op");

/* The result of an op that waited for its line: as if the op had issued when that arrived. Kept longer than others. */
typedef struct core_late_result {
    uint32_t number; /* of the op */
    unsigned bucket; /* SIM_BUCKET_L2 or SIM_BUCKET_MEMORY */
    uint64_t arrival;
    const sim_op_price *price;
} core_late_result;

/* An op of a tile, made ready for the loop a block at a time: what does not depend on time is found once, and remembered with the
 * block (sim/core_blocks.c). 8 bytes: many blocks are to be near at hand. */
typedef struct core_op {
    uint8_t flags;  /* of the price, and CORE_MANY_SOURCES */
    uint8_t join;   /* core_join: the op before it */
    uint8_t access; /* its place in the thread's `access` */
    uint8_t pad;
    int8_t source[CORE_SOURCES];   /* results that it may have to wait for: places in `issued`, from its own on */
    uint8_t latency[CORE_SOURCES]; /* from there to when they are ready: a place in the core's `latency` */
} core_op;
_Static_assert(sizeof(core_op) == 8, "a power of two");

/* What an op accesses, a load or a store. */
typedef struct core_access {
    uint64_t line; /* SIM_NO_LINE: none */
    uint32_t slot; /* where its place may be known (sim/hierarchy.h) */
} core_access;

/* Whether an op may issue in V beside the one before it, if both are ready. */
typedef enum core_join { CORE_APART, CORE_JOINS, CORE_CONFLICTS /* but for its bank or its bytes */ } core_join;

enum { CORE_MANY_SOURCES = 128 }; /* a flag: more than CORE_SOURCES, or of too long ago for a block to know */
enum { CORE_BLOCK = 64 };
/* So many ops fit behind each other in `issued`: the youngest move to its beginning when the next block does not fit. */
#define CORE_ROOM(window) (2 * (size_t)(window) + CORE_BLOCK)
enum { CORE_READY = LRB_CLASS_COUNT }; /* a class of results that all are ready */
_Static_assert((CORE_READY + 1) * SIM_CONSUMERS <= 256, "latencies are numbered by bytes");

typedef struct core_blocks core_blocks;

/* A hardware thread. Times are cycles, or blamed times where the type says so. */
typedef struct core_thread {
    const core_op *op;  /* that issues next */
    sim_blamed now;     /* of the last issue, bucket 0 */
    sim_blamed unsettled_until; /* no late result and no store is ready later */
    sim_blamed late_until;  /* no late result is */
    sim_blamed *issued;  /* when ops did, bucket 0: the place of the next op, behind those of at least a window of ops */
    uint64_t cycles;    /* core cycles so far that belong to the thread's ops */
    sim_blamed start;   /* the next op issues later than this, unless it joins; kept where the op has effects or ends its tile */
    const core_op *block_end;
    uint32_t first;     /* number of the block's first op */
    uint32_t tile_first; /* number of the tile's first op */
    uint32_t scratch;   /* displacement of the thread's scratch memory */
    core_late_result *late;  /* by number of the op */
    sim_slots misses;
    sim_store_line stores[SIM_STORE_LINES];

    uint64_t phase_start, region_start; /* of these */
    uint32_t phase, region;
    uint64_t regions[SIM_MAX_REGIONS + 1]; /* of the tile */
    sim_whereabouts at;

    const lrb_event *block_events;  /* of the block's ops */
    const lrb_event *undecoded, *end; /* the tile's events behind the block; NULL: no tile */
    sim_blamed *issued_begin;       /* owned; CORE_ROOM(window) of them */
    uint8_t *producer;              /* owned; classes of the ops there, times SIM_CONSUMERS; CORE_READY: none, or of another tile */
    bool works;             /* it has been given a tile with ops in this run */
    core_op block[CORE_BLOCK];
    core_access access[CORE_BLOCK + 1]; /* the first one is none */
} core_thread;

struct sim_core {
    const sim_machine *machine;
    sim_op_price *price;
    uint32_t window, late_window; /* powers of two */
    sim_blamed latency[(LRB_CLASS_COUNT + 1) * SIM_CONSUMERS]; /* of each class to each kind of consumer; of CORE_READY 0 */
    uint64_t gap;
    sim_blamed blamed_gap; /* the gap, SIM_BUCKET_NONE */
    unsigned threads, line_bits, longest_latency;

    /* The turn of a thread is the cycle in which its next op can issue, times CORE_TURN; CORE_NEVER: it has none. There are two
       copies one after the other, so that those of the threads after any one lie in a row. */
    uint64_t turn[2 * CORE_MAX_THREADS];
    uint8_t why[CORE_MAX_THREADS]; /* the bucket to blame for each thread's turn */
    uint64_t now;      /* cycle in which the core issued last */
    unsigned last;     /* thread that issued last */
    unsigned working;  /* threads that have an op to issue */
    core_thread *thread;
    sim_blamed class_free[LRB_CLASS_COUNT];
    sim_hierarchy *memory;
    sim_predictor *predictor;
    core_blocks *blocks;
    sim_slots prefetches; /* count 0: there may be none */

    uint64_t *forms;         /* events, by phase and op field; SIM_MAX_PHASES x CORE_FORMS */
    uint64_t idle_accesses;  /* loads and stores under a mask of no lanes */
    uint64_t op_waited[CORE_OPS];
    uint64_t joins[CORE_OPS]; /* ops that joined another's cycle */
    uint64_t core_waited[SIM_BUCKETS], thread_waited[SIM_BUCKETS];
    uint64_t began; /* the run */
    uint64_t runs_of_threads; /* runs of all threads that had work */
    sim_profile *profile;   /* or NULL; not owned */
    sim_observer *observer; /* or NULL */
    void *observer_user;
    uint64_t told; /* cycle of the op that the observer was told of last */
    sim_core_stats stats;
};

/** Set when a thread's next op can issue; the cycles from `from` until then belong to the bucket to blame. */
static inline void core_set_turn(sim_core *s, unsigned t, sim_blamed ready, uint64_t from)
{
    const unsigned bucket = ready & 0xff;
    s->turn[t] = s->turn[t + s->threads] = sim_without_bucket(ready);
    s->why[t] = (uint8_t)bucket;
    s->thread_waited[bucket] += sim_time_of(ready) - from;
}

/** Number of the thread's next op. */
static inline uint32_t core_number(const core_thread *h) { return h->first + (uint32_t)(h->op - h->block); }

/** Event of the thread's next op. */
static inline const lrb_event *core_event_of(const core_thread *h) { return h->block_events + (h->op - h->block); }

/** Price of the thread's next op. */
static inline const sim_op_price *core_price_of(const sim_core *s, const core_thread *h) { return &s->price[core_event_of(h)->op]; }

/** Whether an access or a hint is under a mask of no lanes; an S3 in memory is read whatever the mask. */
static inline bool core_moves_nothing(const lrb_event *e)
{
    return e->mask == 0 && !(e->op & LRB_FORM_MEMORY);
}

/** Line of an event's address, scratch at the thread's own place. */
static inline uint64_t core_line_of(const sim_core *s, const core_thread *h, const lrb_event *e)
{
    uint64_t address = e->aux;
    return (address + (address >= LRB_SCRATCH_ADDRESS ? h->scratch : 0)) >> s->line_bits;
}

/** A late result or a store is ready then. */
static inline void core_unsettle(core_thread *h, sim_blamed until)
{
    h->unsettled_until = until > h->unsettled_until ? until : h->unsettled_until;
}

/** No blocks yet, of ops that wait for none from `far` ops before on; NULL if the host is out of memory. free() them. */
core_blocks *core_blocks_create(unsigned far);

/** Forget all blocks: prices have changed. */
void core_blocks_forget(sim_core *s);

/** Put the ops of all blocks into s->forms; until then those of known blocks are not there. */
void core_blocks_settle(sim_core *s);

/** Make the thread's next block ready, whose first event is an op. */
void core_blocks_next(sim_core *s, core_thread *h);

/** A tile has none of the ops of the one before: make its first block ready. False: it has no op at all. */
bool core_begin_tile(sim_core *s, core_thread *h, const lrb_event *events, size_t count);

/** All ops of the tile have issued: its cycles belong to its last phase and region. */
void core_end_tile(sim_core *s, core_thread *h);

/** What core_find_op does where the block ends. */
bool core_pass_markers(sim_core *s, core_thread *h);

/** Go on to the thread's next op; false: the tile has none left. */
static inline bool core_find_op(sim_core *s, core_thread *h)
{
    return h->op < h->block_end || core_pass_markers(s, h);
}

/** The data of the op that issues comes later than from the first level. */
void core_delay_result(sim_core *s, core_thread *h, const sim_op_price *p, sim_fetch fetch);

/** A branch issues. */
void core_take_branch(sim_core *s, core_thread *h, const lrb_event *e);

/** A prefetch, an eviction or a delay issues. */
void core_take_hint(sim_core *s, core_thread *h, const lrb_event *e);

/** An op of a lasting class issues: the class is busy for all threads, and the thread perhaps blocked. */
void core_outlast(sim_core *s, core_thread *h, const sim_op_price *p);

/** Tell the profile and the observer of the op that issues: first in its cycle, or beside the op before it. */
void core_tell_op(sim_core *s, core_thread *h, const lrb_event *e, bool joined);

/** Tell the observer of an event. */
void core_tell(sim_core *s, const core_thread *h, const lrb_event *e);

#endif
