/* What an op does besides its lanes: tell the context, as much as the level asks for. */
#ifndef LRBNI_OPS_EMIT_H
#define LRBNI_OPS_EMIT_H

#include <string.h>

#include "lrbni/types.h"

/* Put a marker into the stream: LRB_RECORD only. */
LRB_INLINE void lrb_mark(lrb_ctx *c, lrb_op_id marker, uint32_t number)
{
#if LRB_LEVEL == LRB_RECORD
    lrb_put_marker(c, marker, number);
#else
    (void)c, (void)marker, (void)number;
#endif
}

#if LRB_LEVEL == LRB_TOUCH
/* What an op does to memory; known when the op is compiled. */
LRB_INLINE lrb_access lrb_access_of(unsigned op)
{
    static const uint8_t access[LRB_SHAPE_COUNT] = {
#define SHAPE(name, access, reads, sentence) LRB_ACCESS_##access,
#include "lrbni/shapes.def"
    };
    static const uint8_t shape[LRB_OP_COUNT] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) LRB_SHAPE_##shape,
#include "lrbni/ops.def"
    };
    return (lrb_access)access[shape[op]];
}

/* Tell the caches of an op that accesses memory, or gives a hint about it. */
LRB_INLINE void lrb_touch(lrb_ctx *c, unsigned op, unsigned form, uint32_t mask, uint32_t aux)
{
    const uint64_t what = (uint64_t)mask << 48 | (uint64_t)(op | form) << 32 | aux;
    const uint32_t line = aux >> c->line_bits;
    if (!(form & LRB_FORM_MEMORY) && lrb_access_of(op) == LRB_ACCESS_HINT)
        lrb_put_hint(c, what);
    else if (!(form & LRB_FORM_MEMORY) && (lrb_access_of(op) == LRB_ACCESS_NONE || !mask))
        return; /* without a lane nothing is accessed */
    else if (c->latest[line & c->set_mask] != line)
        lrb_put_touch(c, what);
}
#endif

/* Tell the context of one op and return the event's id; sources are the ids of the events that made them. */
LRB_INLINE uint32_t lrb_emit(lrb_ctx *c, unsigned op, unsigned form, uint32_t mask, uint32_t s0, uint32_t s1, uint32_t s2,
                             uint32_t s3, uint32_t aux)
{
#if LRB_LEVEL == LRB_RECORD
    const uint64_t what = (uint64_t)mask << 48 | (uint64_t)(op | form) << 32 | aux;
#ifdef LRB_ANNOTATED
    return lrb_put_far(c, what, s0, s1, s2, s3);
#else
    return lrb_put(c, what, s0, s1, s2, s3);
#endif
#else
#if LRB_LEVEL == LRB_COUNT || LRB_LEVEL == LRB_TOUCH
    c->ops[op]++;
    c->memory_operands += form & LRB_FORM_MEMORY ? 1 : 0;
#else
    (void)c, (void)op;
#endif
#if LRB_LEVEL == LRB_TOUCH
    lrb_touch(c, op, form, mask, aux);
#endif
    (void)form, (void)mask, (void)s0, (void)s1, (void)s2, (void)s3, (void)aux;
    return 0;
#endif
}

/* lrb_emit for a vector op under a mask: the lanes that it leaves idle are counted. */
LRB_INLINE uint32_t lrb_emit_masked(lrb_ctx *c, unsigned op, unsigned form, lrb_k16 k, uint32_t s0, uint32_t s1, uint32_t s3,
                                    uint32_t aux)
{
#if LRB_LEVEL == LRB_COUNT || LRB_LEVEL == LRB_TOUCH
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
