/* Streams: elements side by side in memory for those lanes whose mask bit is 1, the first for the lowest.
 *
 * A stream that starts at any element may cross a line of 64 bytes, so the machine has two ops: l moves the elements in the line
 * of the start, h, whose address is 64 bytes up, those in the next line; if the start is a line's, h moves nothing (ICC16).
 * The mask selects; lanes that an op moves no element for keep what they held. An event's mask says which lanes were moved.
 */
#ifndef LRBNI_OPS_PACK_H
#define LRBNI_OPS_PACK_H

#include "lrbni/ops/places.h"

/* Which lanes of the stream an op moves. */
typedef enum lrb_stream_part { LRB_STREAM_LOW, LRB_STREAM_HIGH, LRB_STREAM_WHOLE } lrb_stream_part;

/* The elements' places from the op's address, which for a high part is 64 bytes behind the stream's start. */
LRB_INLINE lrb_places lrb_stream_places(unsigned bytes, uint32_t k, lrb_stream_part part)
{
    return lrb_places_packed(bytes, k, part == LRB_STREAM_HIGH ? -64 : 0);
}

/* Either part moves what lies in the line of its own address. */
LRB_INLINE uint32_t lrb_stream_lanes(const lrb_places *p, uint32_t k, uint32_t address, lrb_stream_part part)
{
    return part == LRB_STREAM_WHOLE ? k : lrb_lanes_in_line(p, k, address, lrb_line_of(address));
}

/* Where a high part touches memory: the beginning of the line that its address lies in. */
LRB_INLINE uint32_t lrb_stream_address(uint32_t address, lrb_stream_part part)
{
    return part == LRB_STREAM_HIGH ? address & ~63u : address;
}

/* LRB_STREAMS(ps): what all ops on streams of that suffix do; `op` is the row that it counts as. */
#define LRB_STREAMS(suffix)                                                                               \
    LRB_INLINE LRB_VECTOR_##suffix lrb_unpack_##suffix(lrb_ctx *c, lrb_op_id op, lrb_stream_part part, LRB_VECTOR_##suffix old, \
                                                       lrb_k16 k, lrb_mem m, lrb_up_##suffix up)          \
    {                                                                                                     \
        const unsigned bytes = lrb_up_##suffix##_bytes(up);                                               \
        LRB_ASSERT_ALIGNED(m, bytes);                                                                     \
        const lrb_places p = lrb_stream_places(bytes, k.bits & LRB_LANES_##suffix, part);                 \
        const uint32_t lanes = lrb_stream_lanes(&p, k.bits & LRB_LANES_##suffix, m.address, part);        \
        const lrb_elements e = lrb_read_places(&p, lanes, m.host, bytes);                                 \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(lanes, old.lanes, lanes_up_##suffix(e.bytes, up))}; \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, op, lrb_form_of_line(lanes), lrb_moved(k, lanes), LRB_BASE_FROM(m), \
                                                 LRB_INDEX_FROM(m), LRB_FROM(old), lrb_stream_address(m.address, part))); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE void lrb_pack_##suffix(lrb_ctx *c, lrb_op_id op, lrb_stream_part part, lrb_mem m, lrb_k16 k, \
                                      LRB_VECTOR_##suffix a, lrb_down_##suffix down)                      \
    {                                                                                                     \
        const unsigned bytes = lrb_down_##suffix##_bytes(down);                                           \
        LRB_ASSERT_ALIGNED(m, bytes);                                                                     \
        const lrb_places p = lrb_stream_places(bytes, k.bits & LRB_LANES_##suffix, part);                 \
        const uint32_t lanes = lrb_stream_lanes(&p, k.bits & LRB_LANES_##suffix, m.address, part);        \
        const lrb_elements e = lrb_down_elements_##suffix(c, a.lanes, down);                              \
        lrb_write_places(&p, lanes, m.host, bytes, &e);                                                   \
        LRB_EMIT_MASKED_##suffix(c, op, lrb_form_of_line(lanes), lrb_moved(k, lanes), LRB_BASE_FROM(m), LRB_INDEX_FROM(m), \
                                 LRB_FROM(a), lrb_stream_address(m.address, part));                       \
    }
LRB_STREAMS(ps)
LRB_STREAMS(pi)
LRB_STREAMS(pd)
LRB_STREAMS(pq)
#undef LRB_STREAMS

/* LRB_UNPACK(loadunpackl, ps, LOW, LRB_UP_PS_none): lrb_loadunpackl_ps(c, old, k, m) */
#define LRB_UNPACK(stem, suffix, part, none)                                                              \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##stem##_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, lrb_mem m) \
    {                                                                                                     \
        return lrb_unpack_##suffix(c, LRB_OP_##stem##_##suffix, LRB_STREAM_##part, old, k, m, none);      \
    }
/* LRB_PACK(packstorel, ps, LOW, LRB_DOWN_PS_none): lrb_packstorel_ps(c, m, k, a) */
#define LRB_PACK(stem, suffix, part, none)                                                                \
    LRB_INLINE void lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, LRB_VECTOR_##suffix a)        \
    {                                                                                                     \
        lrb_pack_##suffix(c, LRB_OP_##stem##_##suffix, LRB_STREAM_##part, m, k, a, none);                 \
    }
#define LRB_PLAIN_STREAMS(suffix, TYPE)                                                                   \
    LRB_UNPACK(loadunpackl, suffix, LOW, LRB_UP_##TYPE##_none)                                            \
    LRB_UNPACK(loadunpackh, suffix, HIGH, LRB_UP_##TYPE##_none)                                           \
    LRB_UNPACK(expand, suffix, WHOLE, LRB_UP_##TYPE##_none)                                               \
    LRB_PACK(packstorel, suffix, LOW, LRB_DOWN_##TYPE##_none)                                             \
    LRB_PACK(packstoreh, suffix, HIGH, LRB_DOWN_##TYPE##_none)                                            \
    LRB_PACK(compress, suffix, WHOLE, LRB_DOWN_##TYPE##_none)
LRB_PLAIN_STREAMS(ps, PS)
LRB_PLAIN_STREAMS(pi, PI)
LRB_PLAIN_STREAMS(pd, PD)
LRB_PLAIN_STREAMS(pq, PQ)
#undef LRB_PLAIN_STREAMS
#undef LRB_UNPACK
#undef LRB_PACK

/* LRB_UNPACK_UP(loadunpackl_up, ps, LOW): lrb_loadunpackl_up_ps(c, old, k, m, LRB_UP_PS_float16) */
#define LRB_UNPACK_UP(stem, suffix, part)                                                                 \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##stem##_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, lrb_mem m, \
                                                         lrb_up_##suffix up)                              \
    {                                                                                                     \
        return lrb_unpack_##suffix(c, LRB_OP_##stem##_##suffix, LRB_STREAM_##part, old, k, m, up);        \
    }
LRB_UNPACK_UP(loadunpackl_up, ps, LOW)
LRB_UNPACK_UP(loadunpackh_up, ps, HIGH)
LRB_UNPACK_UP(loadunpackl_up, pi, LOW)
LRB_UNPACK_UP(loadunpackh_up, pi, HIGH)
#undef LRB_UNPACK_UP

/* LRB_PACK_DOWN(packstorel_down, ps, LOW): lrb_packstorel_down_ps(c, m, k, a, LRB_DOWN_PS_float16) */
#define LRB_PACK_DOWN(stem, suffix, part)                                                                 \
    LRB_INLINE void lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, LRB_VECTOR_##suffix a, lrb_down_##suffix down) \
    {                                                                                                     \
        lrb_pack_##suffix(c, LRB_OP_##stem##_##suffix, LRB_STREAM_##part, m, k, a, down);                 \
    }
LRB_PACK_DOWN(packstorel_down, ps, LOW)
LRB_PACK_DOWN(packstoreh_down, ps, HIGH)
LRB_PACK_DOWN(packstorel_down, pi, LOW)
LRB_PACK_DOWN(packstoreh_down, pi, HIGH)
#undef LRB_PACK_DOWN

#endif
