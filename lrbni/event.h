/* One event: what an op tells the simulator. 16 bytes.
 *
 * An event names the events that made its operands as distances back in the stream of its tile, so a stream can be
 * cut, stored and timed without renaming. Distances count ops; markers make nothing and are not counted. 0 stands for
 * 'ready long ago': no such operand, or made at least LRB_FAR ops ago, which no latency outlasts. Four sources, not three:
 * a masked multiply-add reads its destination, two operands and a mask. Where a source is an address it says so by the
 * op's shape or form.
 */
#ifndef LRBNI_EVENT_H
#define LRBNI_EVENT_H

#include <stdint.h>

#define LRB_FAR 65536u /* distances are below this */

/* The op field: the id, and how the last source (S3) was given. */
#define LRB_EVENT_ID 0x0fffu
#define LRB_FORM_REGISTER 0x0000u
#define LRB_FORM_SWIZZLE 0x1000u /* a register, its lanes swizzled within groups of four */
#define LRB_FORM_MEMORY 0x2000u  /* memory: source 1 is the address register */
/* Vector loads and S3 in memory: how many bytes are read, whatever the mask; none of these: the words of the mask. */
#define LRB_FORM_BYTES 0xd000u
#define LRB_FORM_4_BYTES 0x4000u  /* {1to16} of 32-bit elements */
#define LRB_FORM_8_BYTES 0x5000u  /* {1to8} */
#define LRB_FORM_16_BYTES 0xc000u /* {4to16}; 16 elements of 8 bits */
#define LRB_FORM_32_BYTES 0xd000u /* {4to8}; 16 elements of 16 bits */

/** Bytes that a vector access of that form touches, from its address on; 0: the 32-bit words of its mask. */
static inline uint32_t lrb_form_bytes(unsigned form)
{
    switch (form & LRB_FORM_BYTES) {
    case LRB_FORM_4_BYTES:
        return 4;
    case LRB_FORM_8_BYTES:
        return 8;
    case LRB_FORM_16_BYTES:
        return 16;
    case LRB_FORM_32_BYTES:
        return 32;
    default:
        return 0;
    }
}

typedef struct lrb_event {
    uint16_t op;     /* id and form */
    uint16_t mask;   /* 32-bit words of the vector that are written, 0xffff if unmasked: two a lane of an 8-wide op; of a
                        branch: 1 if taken */
    uint16_t src[4]; /* 0: first source or address base; 1: S3, second source, or address index; 2: mask; 3: old
                        destination or stored data */
    uint32_t aux;    /* memory: simulated address; delay: its cycles; branch: site; marker: its number; otherwise 0 */
} lrb_event;

/* Receives a tile's events in order, in batches; `events` is valid during the call only. */
typedef void lrb_event_sink(void *user, const lrb_event *events, uint32_t count);

#endif
