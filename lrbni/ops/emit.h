/* What an op does besides its lanes: tell the context, as much as the level asks for. */
#ifndef LRBNI_OPS_EMIT_H
#define LRBNI_OPS_EMIT_H

#include <string.h>

#include "lrbni/types.h"

/* Distance back from event `id` to the event that made a source; 0 if that was long ago, or there is none. */
LRB_INLINE uint16_t lrb_distance(uint32_t id, uint32_t from)
{
    if (__builtin_constant_p(from) && from == 0)
        return 0;
    uint32_t distance = id - from;
    return distance < LRB_FAR ? (uint16_t)distance : 0;
}

#if LRB_LEVEL == LRB_RECORD
/* An event has been written at the end of the batch. */
LRB_INLINE void lrb_put(lrb_ctx *c, lrb_event *e)
{
    c->free_event = e + 1;
    if (__builtin_expect(e + 1 == c->events_end, 0))
        lrb_ctx_flush(c);
}
#endif

/* Put a marker into the stream: LRB_RECORD only. */
LRB_INLINE void lrb_mark(lrb_ctx *c, lrb_op_id marker, uint32_t number)
{
#if LRB_LEVEL == LRB_RECORD
    lrb_event *e = c->free_event;
    *e = (lrb_event){.op = (uint16_t)marker, .aux = number};
    lrb_put(c, e);
#else
    (void)c, (void)marker, (void)number;
#endif
}

/* A source that is too far back for the event of the next op has a marker of its own. */
LRB_INLINE void lrb_mark_far(lrb_ctx *c, uint32_t source, uint32_t from)
{
#if LRB_LEVEL == LRB_RECORD && defined(LRB_ANNOTATED)
    if (from && c->next_event - from >= LRB_FAR)
        lrb_mark(c, LRB_OP_far, (c->next_event - from) << 2 | source);
#else
    (void)c, (void)source, (void)from;
#endif
}

/* Tell the context of one op and return the event's id; sources are the ids of the events that made them. */
LRB_INLINE uint32_t lrb_emit(lrb_ctx *c, unsigned op, unsigned form, uint32_t mask, uint32_t s0, uint32_t s1, uint32_t s2,
                             uint32_t s3, uint32_t aux)
{
#if LRB_LEVEL == LRB_RECORD
    lrb_mark_far(c, 0, s0), lrb_mark_far(c, 1, s1), lrb_mark_far(c, 2, s2), lrb_mark_far(c, 3, s3);
    lrb_event *e = c->free_event;
    uint32_t id = c->next_event;
    *e = (lrb_event){.op = (uint16_t)(op | form), .mask = (uint16_t)mask, .aux = aux,
                     .src = {lrb_distance(id, s0), lrb_distance(id, s1), lrb_distance(id, s2), lrb_distance(id, s3)}};
    c->next_event = id + 1;
    lrb_put(c, e);
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

/* lrb_emit for a vector op under a mask: the lanes that it leaves idle are counted. */
LRB_INLINE uint32_t lrb_emit_masked(lrb_ctx *c, unsigned op, unsigned form, lrb_k16 k, uint32_t s0, uint32_t s1, uint32_t s3,
                                    uint32_t aux)
{
#if LRB_LEVEL == LRB_COUNT
    c->idle_lanes += 16u - (unsigned)__builtin_popcount(k.bits);
#endif
    return lrb_emit(c, op, form, k.bits, s0, s1, LRB_FROM(k), s3, aux);
}

/* The 32-bit words that a mask of 8 lanes of 64 bits selects: each bit twice. */
LRB_INLINE uint32_t lrb_words_of_mask8(uint32_t bits)
{
    bits &= 0xff;
    bits = (bits | bits << 4) & 0x0f0fu;
    bits = (bits | bits << 2) & 0x3333u;
    bits = (bits | bits << 1) & 0x5555u;
    return bits * 3;
}

/* lrb_emit_masked for an op of 8 lanes. */
LRB_INLINE uint32_t lrb_emit_masked8(lrb_ctx *c, unsigned op, unsigned form, lrb_k16 k, uint32_t s0, uint32_t s1, uint32_t s3,
                                     uint32_t aux)
{
    k.bits = lrb_words_of_mask8(k.bits);
    return lrb_emit_masked(c, op, form, k, s0, s1, s3, aux);
}

/* Hashes of streams, which are to be equal everywhere, go over the bytes of events: the layout on the hosts there are. */
#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "events are known on little-endian hosts only"
#endif
_Static_assert(sizeof(lrb_event) == 16, "an event is 16 bytes");

#endif
