/* What the intrinsics know of the calling thread: the context of its piece of work, and where its masks came from.
 *
 * Masks are plain integers in code that is written with intrinsics, so their origins are lost on the way. They are found again
 * by value: the eight newest masks that ops of this piece have made are kept, as many as there are mask registers, and a mask
 * operand is taken to be the newest of those with the same bits. A mask that none of them equals (a constant, or made by C's
 * own operators) was ready long ago.
 */
#ifndef LANETRACE_HERE_H
#define LANETRACE_HERE_H

#include <stdint.h>

#include "lrbni/ctx.h"

#define LANETRACE_MASKS 8u

typedef struct lanetrace_thread {
    lrb_ctx *ctx; /* NULL: no piece of work under way */
    uint32_t mask_bits[LANETRACE_MASKS], mask_from[LANETRACE_MASKS]; /* a ring */
    uint32_t masks_made; /* in this piece */
} lanetrace_thread;

/* The calling thread's; filled in by lanetrace_begin and cleared by lanetrace_end. */
extern _Thread_local lanetrace_thread lanetrace_here;

#endif
