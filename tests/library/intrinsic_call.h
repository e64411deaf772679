/* An intrinsic and the ops that it stands for, called with the same operands: what the tests of all families share. */
#ifndef TESTS_LIBRARY_INTRINSIC_CALL_H
#define TESTS_LIBRARY_INTRINSIC_CALL_H

#include "lanetrace/lrbni_intrinsics.h"

#define CALL_NOINLINE __attribute__((noinline))

enum { CALL_WORDS = 256 }; /* 32-bit words of memory that calls may read and write */

/* One of the two: operands with their origins in a context, and the result. */
typedef struct call_side {
    lrb_ctx *c;
    lrb_v16f f[3];
    lrb_v16i i[3];
    lrb_v8d d[3];
    lrb_v8q q[3];
    lrb_v16i index;     /* -60..60 */
    lrb_k16 k[2];
    __mmask16 out;      /* a mask that a call gives beside its result */
    lrb_ptr p;          /* memory, 64-byte aligned */
    uint32_t *memory;   /* the same */
    uint32_t lanes[16]; /* the result: a vector, or a mask or scalar in the first words */
    uint32_t from;
    uint32_t noted_out;
    bool has_from; /* a mask that left the intrinsic as an integer has none */
} call_side;

typedef struct call_pair {
    const char *name;
    void (*intrinsic)(call_side *s), (*ops)(call_side *s);
} call_pair;

/** Note a result. */
void note_f(call_side *s, lrb_v16f v);
void note_i(call_side *s, lrb_v16i v);
void note_d(call_side *s, lrb_v8d v);
void note_q(call_side *s, lrb_v8q v);
void note_k(call_side *s, lrb_k16 k);
void note_bits(call_side *s, uint64_t bits);

/** And a mask beside it. */
void note_out(call_side *s, uint32_t bits);

#endif
