/* What the calls of intrinsics that are written by hand have in common. */
#ifndef TESTS_LIBRARY_WRITTEN_CALLS_H
#define TESTS_LIBRARY_WRITTEN_CALLS_H

#include <limits.h>
#include <math.h>

#include "tests/library/intrinsic_call.h"

#define BITS(k) ((k).bits)

/* The constants' line. */
static inline lrb_mem pool(call_side *s, const void *value, size_t bytes)
{
    lrb_ptr p = lrb_segment_at(s->c->scratch, LRB_SCRATCH_BYTES - 64);
    memcpy(p.host, value, bytes);
    return lrb_at(p, 0);
}

/* What no op has made. */
static inline lrb_v16i nothing(void)
{
    static const int zeros[16];
    return (lrb_v16i){.lanes = lanes_load_pi(zeros), .from = 0};
}

static inline lrb_v16i zero(call_side *s) { return lrb_xor_pi(s->c, nothing(), nothing()); }

#endif
