/* A machine's prices of every op in every form, ready for the loops of the timing models. Private to sim. */
#ifndef SIM_OP_PRICE_H
#define SIM_OP_PRICE_H

#include "lrbni/base/status.h"
#include "lrbni/op_table.h"
#include "sim/cycles.h"
#include "sim/machine.h"

/*
 * Buckets of waiting cycles. A time and the bucket that is to blame for it travel in one number, time << 8 | bucket:
 * the largest of several is the latest, and says whom to blame; of equal times the last bucket in this list.
 */
enum {
    SIM_BUCKET_OPERAND = 0, /* + class * SIM_CONSUMERS + consumer */
    SIM_BUCKET_L2 = LRB_CLASS_COUNT * SIM_CONSUMERS, /* data that came from the second level */
    SIM_BUCKET_MEMORY, /* ... from memory */
    SIM_BUCKET_STORE,
    SIM_BUCKET_BUSY, /* + class */
    SIM_BUCKET_BLOCKED = SIM_BUCKET_BUSY + LRB_CLASS_COUNT,
    SIM_BUCKET_DELAY,
    SIM_BUCKET_MISPREDICT,
    SIM_BUCKET_BTB_MISS,
    SIM_BUCKET_MISSES,     /* the thread has as many misses under way as it may */
    SIM_BUCKET_PREFETCHES, /* the core has as many prefetched lines under way as it may */
    SIM_BUCKET_NONE,
    SIM_BUCKETS
};
_Static_assert(SIM_BUCKETS <= 255, "a bucket is 8 bits, and 255 is later than all of them");
_Static_assert((int)LRB_CLASS_COUNT <= 32, "a set of classes is 32 bits");

typedef uint64_t sim_blamed;

static inline sim_blamed sim_blame(uint64_t time, unsigned bucket) { return time << 8 | bucket; }
static inline uint64_t sim_time_of(sim_blamed t) { return t >> 8; }
static inline sim_blamed sim_without_bucket(sim_blamed t) { return t & ~UINT64_C(0xff); }
static inline sim_blamed sim_end_of_cycle(sim_blamed t) { return t | 0xff; }

/* When a result is ready for each kind of consumer. */
typedef struct sim_result {
    sim_blamed ready[SIM_CONSUMERS];
} sim_result;

enum { SIM_MAX_SOURCES = 4 };

/* Flags of a price. LASTING: busy for several cycles, or blocking: rare, and kept out of the common path. */
enum {
    SIM_PRICE_MARKER = 1,
    SIM_PRICE_READS = 2,
    SIM_PRICE_STORE = 4,
    SIM_PRICE_LASTING = 8,
    SIM_PRICE_BRANCH = 16,
    SIM_PRICE_HINT = 32,
    SIM_PRICE_TOLD = 64 /* a profile or an observer is told of it */
};

/* The price of an op in one form; 64 bytes. */
typedef struct sim_op_price {
    sim_result latency;
    uint8_t consumer[SIM_MAX_SOURCES]; /* sim_consumer of each source */
    uint32_t partners; /* set of classes: ops of these may join this one in V; empty if it cannot issue in U beside another */
    uint32_t words;    /* of its line that it touches, from its address on; 0: those of the mask */
    uint8_t class_id;
    uint8_t flags;     /* SIM_PRICE_... */
    uint16_t lanes;    /* all ones for a vector op */
    uint16_t busy;     /* cycles for which the class is busy, from the op's issue on */
    uint16_t blocking; /* cycles for which the thread is blocked; 0: not at all */
    uint8_t bytes;     /* that it loads or stores */
    uint8_t word_shift; /* 15: `words` begins at the address; 0: at the line's first word */
    uint8_t pad[2];
} sim_op_price;
_Static_assert(sizeof(sim_op_price) == 64, "a power of two");

/**
 * Prices by the whole op field of an event, UINT16_MAX + 1 of them, most of which are never touched; free() them.
 *
 * Returns NULL if the host is out of memory.
 */
sim_op_price *sim_op_prices(const sim_machine *machine);

/** The longest time for which an op whose data is in the first-level cache can hold up a later one. */
uint32_t sim_longest_latency(const sim_machine *machine);

#endif
