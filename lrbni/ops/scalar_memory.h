/* Loads and stores of general registers, at any address. */
#ifndef LRBNI_OPS_SCALAR_MEMORY_H
#define LRBNI_OPS_SCALAR_MEMORY_H

#include "lrbni/ops/operand.h"

/* LRB_SCALAR_LOAD(load16, uint16_t): lrb_load16(c, m), extended by zeros, or by the sign if the type has one */
#define LRB_SCALAR_LOAD(id, type)                                                                         \
    LRB_INLINE lrb_r64 lrb_##id(lrb_ctx *c, lrb_mem m)                                                    \
    {                                                                                                     \
        type word;                                                                                        \
        memcpy(&word, m.host, sizeof word);                                                               \
        lrb_r64 r = {.value = (uint64_t)(int64_t)word};                                                   \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, sizeof word == 8 ? LRB_FORM_8_BYTES : 0, 0xffff, LRB_BASE_FROM(m), \
                                 LRB_INDEX_FROM(m), 0, 0, m.address));                                    \
        return r;                                                                                         \
    }
LRB_SCALAR_LOAD(load8, uint8_t)
LRB_SCALAR_LOAD(load16, uint16_t)
LRB_SCALAR_LOAD(load32, uint32_t)
LRB_SCALAR_LOAD(load64, uint64_t)
LRB_SCALAR_LOAD(load8s, int8_t)
LRB_SCALAR_LOAD(load16s, int16_t)
LRB_SCALAR_LOAD(load32s, int32_t)
#undef LRB_SCALAR_LOAD

/* LRB_SCALAR_STORE(store16, uint16_t): lrb_store16(c, m, a), the low bits of a */
#define LRB_SCALAR_STORE(id, type)                                                                        \
    LRB_INLINE void lrb_##id(lrb_ctx *c, lrb_mem m, lrb_r64 a)                                            \
    {                                                                                                     \
        type word = (type)a.value;                                                                        \
        memcpy(m.host, &word, sizeof word);                                                               \
        lrb_emit(c, LRB_OP_##id, sizeof word == 8 ? LRB_FORM_8_BYTES : 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, \
                 LRB_FROM(a), m.address);                                                                 \
    }
LRB_SCALAR_STORE(store8, uint8_t)
LRB_SCALAR_STORE(store16, uint16_t)
LRB_SCALAR_STORE(store32, uint32_t)
LRB_SCALAR_STORE(store64, uint64_t)
#undef LRB_SCALAR_STORE

#endif
