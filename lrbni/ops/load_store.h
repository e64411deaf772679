/* Vector and scalar loads and stores. Vector accesses must be aligned to the bytes they touch (ISAM 2.1.1). */
#ifndef LRBNI_OPS_LOAD_STORE_H
#define LRBNI_OPS_LOAD_STORE_H

#include "lrbni/ops/operand.h"

#define LRB_LOAD_FORM(value, c, id, m, form) \
    LRB_SET_FROM(value, lrb_emit(c, LRB_OP_##id, form, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, 0, (m).address))

/* LRB_VECTOR_MEMORY(f, ps): loads of 64 bytes, {1to16}, {4to16}; masked loads and stores touch the selected lanes only */
#define LRB_VECTOR_MEMORY(type, suffix)                                                                   \
    LRB_INLINE lrb_v16##type lrb_load_##suffix(lrb_ctx *c, lrb_mem m)                                     \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lrb_v16##type d = {.lanes = lanes_load_##suffix(m.host)};                                         \
        LRB_LOAD_FORM(d, c, load_##suffix, m, 0);                                                         \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_load_1to16_##suffix(lrb_ctx *c, lrb_mem m)                               \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 4);                                                                         \
        lrb_v16##type d = {.lanes = lanes_load_1to16_##suffix(m.host)};                                   \
        LRB_LOAD_FORM(d, c, load_##suffix, m, LRB_FORM_4_BYTES);                                          \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_load_4to16_##suffix(lrb_ctx *c, lrb_mem m)                               \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 16);                                                                        \
        lrb_v16##type d = {.lanes = lanes_load_4to16_##suffix(m.host)};                                   \
        LRB_LOAD_FORM(d, c, load_##suffix, m, LRB_FORM_16_BYTES);                                          \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_mask_load_##suffix(lrb_ctx *c, lrb_v16##type old, lrb_k16 k, lrb_mem m)  \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lrb_v16##type d = {.lanes = lanes_mask_load_##suffix(old.lanes, k.bits, m.host)};                 \
        LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_load_##suffix, 0, k, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), \
                                        LRB_FROM(old), m.address));                                       \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE void lrb_store_##suffix(lrb_ctx *c, lrb_mem m, lrb_v16##type a)                            \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lanes_store_##suffix(m.host, a.lanes);                                                            \
        lrb_emit(c, LRB_OP_store_##suffix, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, LRB_FROM(a), m.address); \
    }                                                                                                     \
    LRB_INLINE void lrb_mask_store_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, lrb_v16##type a)            \
    {                                                                                                     \
        LRB_ASSERT_ALIGNED(m, 64);                                                                        \
        lanes_mask_store_##suffix(m.host, k.bits, a.lanes);                                               \
        lrb_emit_masked(c, LRB_OP_store_##suffix, 0, k, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), LRB_FROM(a), m.address); \
    }
LRB_VECTOR_MEMORY(f, ps)
LRB_VECTOR_MEMORY(i, pi)
#undef LRB_VECTOR_MEMORY

/** 32 bits of memory into a general register, zero-extended. */
LRB_INLINE lrb_r64 lrb_load32(lrb_ctx *c, lrb_mem m)
{
    uint32_t word;
    memcpy(&word, m.host, sizeof word);
    lrb_r64 r = {.value = word};
    LRB_LOAD_FORM(r, c, load32, m, 0);
    return r;
}

/** 16 bits of memory into a general register, zero-extended. */
LRB_INLINE lrb_r64 lrb_load16(lrb_ctx *c, lrb_mem m)
{
    uint16_t word;
    memcpy(&word, m.host, sizeof word);
    lrb_r64 r = {.value = word};
    LRB_LOAD_FORM(r, c, load16, m, 0);
    return r;
}

/** The low 32 bits of a general register into memory. */
LRB_INLINE void lrb_store32(lrb_ctx *c, lrb_mem m, lrb_r64 a)
{
    uint32_t word = (uint32_t)a.value;
    memcpy(m.host, &word, sizeof word);
    lrb_emit(c, LRB_OP_store32, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, LRB_FROM(a), m.address);
}
#undef LRB_LOAD_FORM

#endif
