/* Vector loads and stores, plain. They must be aligned to the bytes that they touch (ISAM 2.1.1), and touch no byte of a lane
 * that is not selected. load_convert.h has those that convert, pack.h streams, gather.h gathers. */
#ifndef LRBNI_OPS_LOAD_STORE_H
#define LRBNI_OPS_LOAD_STORE_H

#include "lrbni/ops/places.h"

/* LRB_LOADS(load, ps): lrb_load_ps, lrb_mask_load_ps */
#define LRB_LOADS(stem, suffix)                                                                           \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m)                           \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        LRB_VECTOR_##suffix d = {.lanes = lanes_load_##suffix(m.host)};                                   \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##stem##_##suffix, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, 0, m.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##stem##_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, lrb_mem m) \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        LRB_VECTOR_##suffix d = {.lanes = lanes_mask_load_##suffix(old.lanes, k.bits, m.host)};           \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##stem##_##suffix, 0, k, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), \
                                                 LRB_FROM(old), m.address));                              \
        return d;                                                                                         \
    }

/* LRB_BROADCAST(1to16, ps, 1, 4): lrb_load_1to16_ps, lrb_mask_load_1to16_ps; a masked one reads what its lanes need */
#define LRB_BROADCAST(name, suffix, period, size)                                                        \
    LRB_INLINE LRB_VECTOR_##suffix lrb_load_##name##_##suffix(lrb_ctx *c, lrb_mem m)                      \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, (period) * (size));                                                        \
        LRB_VECTOR_##suffix d = {.lanes = lanes_load_##name##_##suffix(m.host)};                          \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_load_##suffix, lrb_form_of_bytes((period) * (size)), 0xffff, LRB_BASE_FROM(m), \
                                 LRB_INDEX_FROM(m), 0, 0, m.address));                                    \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_load_##name##_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, lrb_mem m) \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, (period) * (size));                                                        \
        const lrb_places p = lrb_places_repeated(size, period);                                          \
        const lrb_elements e = lrb_read_places(&p, k.bits & LRB_LANES_##suffix, m.host, size);           \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, lanes_load_##suffix(e.bytes))}; \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_load_##suffix, lrb_form_of_bytes((period) * (size)), k, \
                                                 LRB_BASE_FROM(m), LRB_INDEX_FROM(m), LRB_FROM(old), m.address)); \
        return d;                                                                                         \
    }

/* LRB_STORES(store, ps): lrb_store_ps, lrb_mask_store_ps */
#define LRB_STORES(stem, suffix)                                                                          \
    LRB_INLINE void lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m, LRB_VECTOR_##suffix a)                   \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lanes_store_##suffix(m.host, a.lanes);                                                            \
        lrb_emit(c, LRB_OP_##stem##_##suffix, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, LRB_FROM(a), m.address); \
    }                                                                                                     \
    LRB_INLINE void lrb_mask_##stem##_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, LRB_VECTOR_##suffix a)   \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lanes_mask_store_##suffix(m.host, k.bits, a.lanes);                                               \
        LRB_EMIT_MASKED_##suffix(c, LRB_OP_##stem##_##suffix, 0, k, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), LRB_FROM(a), m.address); \
    }

/* LRB_STORE_FIRST(1, ps, 4): lrb_store_1_ps, lrb_mask_store_1_ps, the lowest lanes only (MIC.H: subsets of 1 and 4) */
#define LRB_STORE_FIRST(count, suffix, size)                                                             \
    LRB_INLINE void lrb_mask_store_##count##_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, LRB_VECTOR_##suffix a) \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, (count) * (size));                                                         \
        k.bits &= (1u << (count)) - 1;                                                                    \
        lanes_mask_store_##suffix(m.host, k.bits, a.lanes);                                               \
        LRB_EMIT_MASKED_##suffix(c, LRB_OP_store_##suffix, lrb_form_of_bytes((count) * (size)), k, LRB_BASE_FROM(m), \
                                 LRB_INDEX_FROM(m), LRB_FROM(a), m.address);                              \
    }                                                                                                     \
    LRB_INLINE void lrb_store_##count##_##suffix(lrb_ctx *c, lrb_mem m, LRB_VECTOR_##suffix a)            \
    {                                                                                                     \
        lrb_mask_store_##count##_##suffix(c, m, lrb_mask(0xffff), a);                                     \
    }

/* LRB_LINE_STORE(storenr_ps, ps): 64 bytes, without a mask */
#define LRB_LINE_STORE(id, suffix)                                                                        \
    LRB_INLINE void lrb_##id(lrb_ctx *c, lrb_mem m, LRB_VECTOR_##suffix a)                                \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lanes_store_##suffix(m.host, a.lanes);                                                            \
        lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, LRB_FROM(a), m.address); \
    }

#define LRB_VECTOR_MEMORY(suffix, one, four, size)                                                       \
    LRB_LOADS(load, suffix)                                                                               \
    LRB_LOADS(load_nt, suffix)                                                                            \
    LRB_BROADCAST(one, suffix, 1, size)                                                                  \
    LRB_BROADCAST(four, suffix, 4, size)                                                                 \
    LRB_STORES(store, suffix)                                                                             \
    LRB_STORES(store_nt, suffix)                                                                          \
    LRB_STORE_FIRST(1, suffix, size)                                                                     \
    LRB_STORE_FIRST(4, suffix, size)
LRB_VECTOR_MEMORY(ps, 1to16, 4to16, 4)
LRB_VECTOR_MEMORY(pi, 1to16, 4to16, 4)
LRB_VECTOR_MEMORY(pd, 1to8, 4to8, 8)
LRB_VECTOR_MEMORY(pq, 1to8, 4to8, 8)
LRB_LINE_STORE(storenr_ps, ps)
LRB_LINE_STORE(storenr_pd, pd)
LRB_LINE_STORE(storenrngo_ps, ps)
LRB_LINE_STORE(storenrngo_pd, pd)
#undef LRB_LOADS
#undef LRB_BROADCAST
#undef LRB_STORES
#undef LRB_STORE_FIRST
#undef LRB_LINE_STORE
#undef LRB_VECTOR_MEMORY

#endif
