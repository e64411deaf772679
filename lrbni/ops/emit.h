/* What an op does besides its lanes: tell the context, as much as the level asks for. */
#ifndef LRBNI_OPS_EMIT_H
#define LRBNI_OPS_EMIT_H

#include <string.h>

#include "lrbni/types.h"

/* Distance back from event `id` to the event that made a source; 0 if that was long ago, or there is none. */
LRB_INLINE uint64_t lrb_distance(uint32_t id, uint32_t from)
{
    if (__builtin_constant_p(from) && from == 0)
        return 0;
    uint32_t distance = id - from;
    return distance < LRB_FAR ? distance : 0;
}

#if LRB_LEVEL == LRB_RECORD
/* Write one event into the batch, as two words; `place` counts all events of the tile. */
LRB_INLINE void lrb_put(lrb_ctx *c, uint32_t place, uint64_t low, uint64_t high)
{
    const uint64_t words[2] = {low, high};
    memcpy(&c->events[place % LRB_BATCH], words, sizeof words);
}

LRB_INLINE void lrb_flush_if_full(lrb_ctx *c, uint32_t places)
{
    if (__builtin_expect(places % LRB_BATCH == 0, 0))
        lrb_ctx_flush(c);
}
#endif

/* Tell the context of one op and return the event's id; sources are the ids of the events that made them. */
LRB_INLINE uint32_t lrb_emit(lrb_ctx *c, unsigned op, unsigned form, uint32_t mask, uint32_t s0, uint32_t s1, uint32_t s2,
                             uint32_t s3, uint32_t aux)
{
#if LRB_LEVEL == LRB_RECORD
    uint32_t id = c->next_event, place = id + c->markers;
    lrb_put(c, place, (op | form) | (uint64_t)mask << 16 | lrb_distance(id, s0) << 32 | lrb_distance(id, s1) << 48,
            lrb_distance(id, s2) | lrb_distance(id, s3) << 16 | (uint64_t)aux << 32);
    c->next_event = id + 1;
    lrb_flush_if_full(c, place + 1);
    return id;
#else
#if LRB_LEVEL == LRB_COUNT
    c->ops[op]++;
    c->memory_operands += form & LRB_FORM_MEMORY ? 1 : 0;
#else
    (void)c, (void)op;
#endif
    (void)form, (void)mask, (void)s0, (void)s1, (void)s2, (void)s3, (void)aux;
    return 0;
#endif
}

/* Put a marker into the stream: LRB_RECORD only. */
LRB_INLINE void lrb_mark(lrb_ctx *c, lrb_op_id marker, uint32_t number)
{
#if LRB_LEVEL == LRB_RECORD
    uint32_t place = c->next_event + c->markers;
    lrb_put(c, place, marker, (uint64_t)number << 32);
    c->markers++;
    lrb_flush_if_full(c, place + 1);
#else
    (void)c, (void)marker, (void)number;
#endif
}

/* The same for a vector op under a mask: the lanes that it leaves idle are counted. */
LRB_INLINE uint32_t lrb_emit_masked(lrb_ctx *c, unsigned op, unsigned form, lrb_k16 k, uint32_t s0, uint32_t s1, uint32_t s3,
                                    uint32_t aux)
{
#if LRB_LEVEL == LRB_COUNT
    c->idle_lanes += 16u - (unsigned)__builtin_popcount(k.bits);
#endif
    return lrb_emit(c, op, form, k.bits, s0, s1, LRB_FROM(k), s3, aux);
}

/* Events are written as two little-endian words: the layout of lrb_event on the hosts there are. */
#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "lrbni/ops/emit.h writes events on little-endian hosts only"
#endif
_Static_assert(sizeof(lrb_event) == 16, "an event is 16 bytes");

#endif
