/* Hints to the caches and to the core: they change no register and no memory, fault at no address, and cost cycles alone. */
#ifndef LRBNI_OPS_HINTS_H
#define LRBNI_OPS_HINTS_H

#include "lrbni/ops/operand.h"

/* LRB_CACHE_HINT(prefetch1): lrb_prefetch1(c, m), about the cache line that holds m */
#define LRB_CACHE_HINT(id)                                                                                \
    LRB_INLINE void lrb_##id(lrb_ctx *c, lrb_mem m)                                                       \
    {                                                                                                     \
        lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, 0, m.address);        \
    }
LRB_CACHE_HINT(prefetch1)
LRB_CACHE_HINT(prefetch1_ex)
LRB_CACHE_HINT(prefetch1_nt)
LRB_CACHE_HINT(prefetch1_ex_nt)
LRB_CACHE_HINT(prefetch1_miss)
LRB_CACHE_HINT(prefetch2)
LRB_CACHE_HINT(prefetch2_ex)
LRB_CACHE_HINT(prefetch2_nt)
LRB_CACHE_HINT(prefetch2_ex_nt)
LRB_CACHE_HINT(evict1)
LRB_CACHE_HINT(evict2)
#undef LRB_CACHE_HINT

/** The thread stands aside for about as many cycles as a says, of which the low 32 bits count; others run. */
LRB_INLINE void lrb_delay(lrb_ctx *c, lrb_r64 a)
{
    lrb_emit(c, LRB_OP_delay, 0, 0xffff, LRB_FROM(a), 0, 0, 0, (uint32_t)a.value);
}

/** A filter of performance counters, set from a: no state that a kernel sees. */
LRB_INLINE void lrb_spflt(lrb_ctx *c, lrb_r64 a)
{
    lrb_emit(c, LRB_OP_spflt, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0);
}

#endif
