/* Intrinsics that read and write memory. Included by lanetrace/lrbni_intrinsics.h. */
#ifndef LANETRACE_INTRINSICS_MEMORY_H
#define LANETRACE_INTRINSICS_MEMORY_H

#include "lanetrace/intrinsics_base.h"

/* LANETRACE_LOAD_STORE(ps, ps, lrb_v16f): load_ps, store_ps and their masked forms; 64-byte aligned, as on the machine */
#define LANETRACE_LOAD_STORE(name, suffix, vector)                                                                  \
    static inline vector lanetrace_mm512_load_##name(const void *m)                                                 \
    {                                                                                                               \
        return lrb_load_##suffix(lanetrace_c(), lanetrace_at(m));                                                   \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_load_##name(vector src, unsigned k, const void *m)                    \
    {                                                                                                               \
        return lrb_mask_load_##suffix(lanetrace_c(), src, lanetrace_k(k), lanetrace_at(m));                         \
    }                                                                                                               \
    static inline void lanetrace_mm512_store_##name(void *m, vector v)                                              \
    {                                                                                                               \
        lrb_store_##suffix(lanetrace_c(), lanetrace_at(m), v);                                                      \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_store_##name(void *m, unsigned k, vector v)                             \
    {                                                                                                               \
        lrb_mask_store_##suffix(lanetrace_c(), lanetrace_at(m), lanetrace_k(k), v);                                 \
    }
LANETRACE_LOAD_STORE(ps, ps, lrb_v16f)
LANETRACE_LOAD_STORE(epi32, pi, lrb_v16i)
#undef LANETRACE_LOAD_STORE

static inline lrb_v16i lanetrace_mm512_load_si512(const void *m) { return lanetrace_mm512_load_epi32(m); }
static inline void lanetrace_mm512_store_si512(void *m, lrb_v16i v) { lanetrace_mm512_store_epi32(m, v); }

/* Hints about one cache line. */
static inline void lanetrace_mm_prefetch(const void *m, int hint)
{
    if (hint == _MM_HINT_T1 || hint == _MM_HINT_T2 || hint == _MM_HINT_ET1)
        lrb_prefetch2(lanetrace_c(), lanetrace_at(m));
    else
        lrb_prefetch1(lanetrace_c(), lanetrace_at(m));
}

static inline void lanetrace_mm_clevict(const void *m, int level)
{
    if (level == _MM_HINT_T1)
        lrb_evict2(lanetrace_c(), lanetrace_at(m));
    else
        lrb_evict1(lanetrace_c(), lanetrace_at(m));
}

#endif
