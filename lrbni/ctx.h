/* The context of a kernel's ops: one stream of accounting, one block of scratch memory. */
#ifndef LRBNI_CTX_H
#define LRBNI_CTX_H

#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/control.h"
#include "lrbni/event.h"
#include "lrbni/memory.h"
#include "lrbni/op_table.h"

/* How much a kernel's ops account for; chosen when the kernel is compiled (LRB_LEVEL), the same source for all. */
#define LRB_NATIVE 0 /* nothing: the host runs the lanes alone */
#define LRB_COUNT 1  /* a histogram of ops, and the idle lanes */
#define LRB_RECORD 2 /* events with dependences */
#define LRB_TOUCH 3  /* the histogram, and what caches see of a kernel: events of accesses and hints, without dependences (lrb_ctx_set_lines) */
#define LRB_LEVELS 4

#define LRB_BATCH 1024u /* events handed to the sink at a time */
#define LRB_TOUCH_SETS 64u

typedef struct lrb_ctx {
    lrb_control control; /* what float ops look at in kernels that define LRB_CONTROL (lrbni/ops/rounding.h) */

    /* LRB_COUNT and LRB_TOUCH */
    uint64_t ops[LRB_OP_COUNT];
    uint64_t memory_operands; /* ops whose last source was in memory; loads and stores apart */
    uint64_t idle_lanes;      /* lanes switched off by masks, summed over vector ops */

    /* LRB_RECORD, and from free_event on LRB_TOUCH */
    uint32_t next_event; /* id of the next op's event; ids of a tile start at LRB_FAR; fewer than 2^32 ops a tile */
    uint32_t line;       /* LRB_ANNOTATED (lrbni/annotate.h): source and line of the last op; 0: none yet */
    lrb_event *free_event; /* where in the batch the next event goes; markers have a place there, but no id */
    lrb_event *events_end; /* behind the last place of the batch */
    lrb_event_sink *sink;
    void *sink_user;
    lrb_event *events; /* LRB_BATCH of them, owned */

    /* LRB_TOUCH */
    uint32_t line_bits, set_mask;
    uint32_t latest[LRB_TOUCH_SETS]; /* by set: the line that was accessed last; UINT32_MAX: none is known */

    lrb_segment scratch; /* LRB_SCRATCH_BYTES, owned: what the kernel keeps in memory of its own */
} lrb_ctx;

/**
 * A context; free it with lrb_ctx_destroy.
 *
 * @param sink  receives the events of kernels at LRB_RECORD or LRB_TOUCH; NULL drops them
 * @param user  passed to the sink
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status lrb_ctx_create(lrb_event_sink *sink, void *user, lrb_ctx **out, base_error *err);

/** Free a context; sets the pointer to NULL. NULL contents are fine. */
void lrb_ctx_destroy(lrb_ctx **c);

/**
 * Tell what first-level cache a kernel at LRB_TOUCH is for: of accesses to the line of a set that was accessed last, with no hint since, no
 * events are made. They hit, and leave a cache that replaces what was not used for longest as it is.
 *
 * @param line_bytes  a power of two, at least 2; a new context has lines of 2 bytes
 * @param sets        a power of two; a new context has 1
 */
void lrb_ctx_set_lines(lrb_ctx *c, unsigned line_bytes, uint64_t sets);

/** Begin a tile: event ids start again, and float ops are in their default state. */
void lrb_ctx_begin(lrb_ctx *c);

/** End a tile: hand the events that are still here to the sink. */
void lrb_ctx_end(lrb_ctx *c);

/* What ops of kernels at LRB_RECORD call. In place, this would make a kernel's code two to four times as long, which compilers
 * take five times as long for and the core model's time does not gain from (docs/performance.md). */

/**
 * Put an op's event into the stream.
 *
 * @param what  the event's mask, op and aux, from the highest bits down: 16, 16 and 32
 * @param s0    to s3: the ids of the events that made the sources; 0: none
 *
 * Returns the event's id.
 */
uint32_t lrb_put(lrb_ctx *c, uint64_t what, uint32_t s0, uint32_t s1, uint32_t s2, uint32_t s3);

/** Put the event of an access to memory into the stream of a kernel at LRB_TOUCH, if caches would see it; `what` as of lrb_put. */
void lrb_put_touch(lrb_ctx *c, uint64_t what);

/** Put the event of a hint about memory into the stream of a kernel at LRB_TOUCH. */
void lrb_put_hint(lrb_ctx *c, uint64_t what);

/** lrb_put, with a marker before it for each source that is too far back for the event (lrbni/annotate.h). */
uint32_t lrb_put_far(lrb_ctx *c, uint64_t what, uint32_t s0, uint32_t s1, uint32_t s2, uint32_t s3);

/** What follows is written in that source and line (LRB_SITE): a marker, if that is news (lrbni/annotate.h). */
void lrb_at_line(lrb_ctx *c, uint32_t site);

/** Put a marker into the stream. */
void lrb_put_marker(lrb_ctx *c, lrb_op_id marker, uint32_t number);

#endif
