/* Loads and stores whose elements do not lie side by side: broadcasts, streams, gathers. Nothing but the elements of the
 * selected lanes is read or written. */
#ifndef LRBNI_OPS_PLACES_H
#define LRBNI_OPS_PLACES_H

#include "lrbni/ops/control.h"

/* Where each lane's element lies, in bytes from the op's address. */
typedef struct lrb_places {
    int64_t at[16];
} lrb_places;

/* The elements of a register, side by side, as in memory. */
typedef struct lrb_elements {
    _Alignas(64) unsigned char bytes[64];
} lrb_elements;

/* The first `period` elements over and over: 16 for each lane its own. */
LRB_INLINE lrb_places lrb_places_repeated(unsigned bytes, unsigned period)
{
    lrb_places p;
    for (unsigned i = 0; i < 16; i++)
        p.at[i] = (int64_t)bytes * (i % period);
    return p;
}

/* A stream from `next` on: one element after the other for the lanes whose bit is set. */
LRB_INLINE lrb_places lrb_places_packed(unsigned bytes, uint32_t k, int64_t next)
{
    lrb_places p;
    for (unsigned i = 0; i < 16; i++) {
        p.at[i] = next;
        next += k >> i & 1 ? bytes : 0;
    }
    return p;
}

LRB_INLINE lrb_places lrb_places_indexed(lrb_v16i index, unsigned scale)
{
    int32_t number[16];
    lanes_store_pi(number, index.lanes);
    lrb_places p;
    for (unsigned i = 0; i < 16; i++)
        p.at[i] = (int64_t)number[i] * scale;
    return p;
}

LRB_INLINE uint32_t lrb_line_of(uint32_t address) { return address / 64; }

/* Of the lanes in k those whose element begins in that line of memory. */
LRB_INLINE uint32_t lrb_lanes_in_line(const lrb_places *p, uint32_t k, uint32_t address, uint32_t line)
{
    uint32_t lanes = 0;
    for (unsigned i = 0; i < 16; i++)
        lanes |= (uint32_t)(lrb_line_of(address + (uint32_t)p->at[i]) == line) << i;
    return lanes & k;
}

LRB_INLINE lrb_elements lrb_read_places(const lrb_places *p, uint32_t k, const unsigned char *host, unsigned bytes)
{
    lrb_elements e = {{0}};
    for (; k; k &= k - 1) {
        unsigned i = (unsigned)__builtin_ctz(k);
        memcpy(e.bytes + bytes * i, host + p->at[i], bytes);
    }
    return e;
}

/* From lane 0 upwards, so that of equal places the highest lane's element stays. */
LRB_INLINE void lrb_write_places(const lrb_places *p, uint32_t k, unsigned char *host, unsigned bytes, const lrb_elements *e)
{
    for (; k; k &= k - 1) {
        unsigned i = (unsigned)__builtin_ctz(k);
        memcpy(host + p->at[i], e->bytes + bytes * i, bytes);
    }
}

/* The elements of a register, converted as the state of the machine has it. */
LRB_INLINE lrb_elements lrb_down_elements_ps(lrb_ctx *c, lrb_f32x16 a, lrb_down_ps down)
{
    lrb_elements e = {0};
    lanes_down_in_mode_ps(e.bytes, down == LRB_DOWN_PS_none ? a : LRB_READ(c, ps, a), down, (lrb_rounding)LRB_STATE(c).rounding);
    return e;
}

#define LRB_DOWN_ELEMENTS(suffix, vector)                                                                   \
    LRB_INLINE lrb_elements lrb_down_elements_##suffix(lrb_ctx *c, lrb_##vector a, lrb_down_##suffix down)  \
    {                                                                                                       \
        lrb_elements e = {0};                                                                                    \
        (void)c;                                                                                            \
        lanes_down_##suffix(e.bytes, a, down);                                                              \
        return e;                                                                                           \
    }
LRB_DOWN_ELEMENTS(pi, i32x16)
LRB_DOWN_ELEMENTS(pd, f64x8)
LRB_DOWN_ELEMENTS(pq, i64x8)
#undef LRB_DOWN_ELEMENTS

/* The event's mask of the lanes that are moved, made from k. */
LRB_INLINE lrb_k16 lrb_moved(lrb_k16 k, uint32_t lanes)
{
    k.bits = lanes;
    return k;
}

/* The form of what touches some elements of a line: nothing, if it moves none. */
LRB_INLINE unsigned lrb_form_of_line(uint32_t lanes) { return lanes ? LRB_FORM_LINE : 0; }

/* The bits of a mask that belong to lanes. */
#define LRB_LANES_ps 0xffffu
#define LRB_LANES_pi 0xffffu
#define LRB_LANES_pd 0x00ffu
#define LRB_LANES_pq 0x00ffu

#endif
