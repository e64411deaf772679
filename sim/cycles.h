/* The words in which the models say where cycles went: kinds of operands, phases, regions. */
#ifndef SIM_CYCLES_H
#define SIM_CYCLES_H

#include <stdint.h>

#include "lrbni/cost_classes.h"

/* How a consumer reads an operand: which of the producer's latencies applies. */
typedef enum sim_consumer {
    SIM_CONSUMER_PLAIN,
    SIM_CONSUMER_SHUFFLE,
    SIM_CONSUMER_BRANCH,
    SIM_CONSUMER_ADDRESS,
    SIM_CONSUMER_MASK,
    SIM_CONSUMERS
} sim_consumer;

#define SIM_MAX_PHASES 16
#define SIM_MAX_REGIONS 16 /* of a tile */

/* Where cycles went: one thread's, a core's, or summed over threads. Buckets that a model does not have stay 0. */
typedef struct sim_cycles {
    uint64_t issued_one, issued_pair; /* cycles in which one op, or two, issued */
    uint64_t gap;                     /* cycles that a thread must let pass between issues */
    uint64_t operand[LRB_CLASS_COUNT][SIM_CONSUMERS]; /* waiting for a result of that class, by the waiting operand */
    uint64_t l2, memory;              /* waiting for the data of an op that missed the first level, by where it came from */
    uint64_t store_forward;           /* a load waiting for a store to the same words */
    uint64_t busy[LRB_CLASS_COUNT];   /* the op's class was still busy */
    uint64_t blocked;                 /* behind an op that blocks the thread */
    uint64_t delay;                   /* behind a delay */
    uint64_t mispredict, btb_miss;    /* behind a branch that was not predicted */
    uint64_t misses;                  /* the thread has as many misses under way as it may */
    uint64_t prefetches;              /* the core has as many prefetched lines under way as it may */
    uint64_t other_thread;            /* ready, but another thread issued; threads only */
    uint64_t no_work;                 /* no tile left */
} sim_cycles;

#endif
