/* Vector loads that convert up, vector stores that convert down, and S3 operands that do; conversions.def lists the formats.
 * All must be aligned to the bytes that they touch, and touch no byte of a lane that is not selected. */
#ifndef LRBNI_OPS_LOAD_CONVERT_H
#define LRBNI_OPS_LOAD_CONVERT_H

#include "lrbni/ops/places.h"

/* LRB_LOAD_UP(load_up, ps, 16): lrb_load_up_ps(c, m, LRB_UP_PS_float16), lrb_mask_load_up_ps; with period 1 and 4 the
 * broadcasts lrb_load_up_1to16_ps, lrb_load_up_4to16_ps */
#define LRB_LOAD_UP(stem, suffix, period)                                                                 \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##stem##_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, lrb_mem m, \
                                                              lrb_up_##suffix up)                         \
    {                                                                                                     \
        const unsigned bytes = lrb_up_##suffix##_bytes(up);                                               \
        LRB_ASSERT_ALIGNED(m, (period) * bytes);                                                          \
        const lrb_places p = lrb_places_repeated(bytes, period);                                          \
        const lrb_elements e = lrb_read_places(&p, k.bits, m.host, bytes);                                \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, lanes_up_##suffix(e.bytes, up))}; \
        LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_load_up_##suffix, lrb_form_of_bytes((period) * bytes), k, LRB_BASE_FROM(m), \
                                        LRB_INDEX_FROM(m), LRB_FROM(old), m.address));                    \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m, lrb_up_##suffix up)       \
    {                                                                                                     \
        const unsigned bytes = lrb_up_##suffix##_bytes(up);                                               \
        LRB_ASSERT_ALIGNED(m, (period) * bytes);                                                          \
        const lrb_places p = lrb_places_repeated(bytes, period);                                          \
        lrb_elements e;                                                                                   \
        if ((period) != 16)                                                                               \
            e = lrb_read_places(&p, 0xffff, m.host, bytes);                                               \
        LRB_VECTOR_##suffix d = {.lanes = lanes_up_##suffix((period) == 16 ? m.host : e.bytes, up)};      \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_load_up_##suffix, lrb_form_of_bytes((period) * bytes), 0xffff, LRB_BASE_FROM(m), \
                                 LRB_INDEX_FROM(m), 0, 0, m.address));                                    \
        return d;                                                                                         \
    }
LRB_LOAD_UP(load_up, ps, 16)
LRB_LOAD_UP(load_up_1to16, ps, 1)
LRB_LOAD_UP(load_up_4to16, ps, 4)
LRB_LOAD_UP(load_up, pi, 16)
LRB_LOAD_UP(load_up_1to16, pi, 1)
LRB_LOAD_UP(load_up_4to16, pi, 4)
#undef LRB_LOAD_UP

/* LRB_STORE_DOWN(store_down, ps, 16): lrb_store_down_ps(c, m, a, LRB_DOWN_PS_float16), lrb_mask_store_down_ps; with 1 and 4 the
 * stores of the lowest lanes only */
#define LRB_STORE_DOWN(stem, suffix, count)                                                               \
    LRB_INLINE void lrb_mask_##stem##_##suffix(lrb_ctx *c, lrb_mem m, lrb_k16 k, LRB_VECTOR_##suffix a, lrb_down_##suffix down) \
    {                                                                                                     \
        const unsigned bytes = lrb_down_##suffix##_bytes(down);                                           \
        LRB_ASSERT_ALIGNED(m, (count) * bytes);                                                           \
        k.bits &= (1u << (count)) - 1;                                                                    \
        const lrb_elements e = lrb_down_elements_##suffix(c, a.lanes, down);                              \
        const lrb_places p = lrb_places_repeated(bytes, 16);                                              \
        lrb_write_places(&p, k.bits, m.host, bytes, &e);                                                  \
        lrb_emit_masked(c, LRB_OP_store_down_##suffix, lrb_form_of_bytes((count) * bytes), k, LRB_BASE_FROM(m), \
                        LRB_INDEX_FROM(m), LRB_FROM(a), m.address);                                       \
    }                                                                                                     \
    LRB_INLINE void lrb_##stem##_##suffix(lrb_ctx *c, lrb_mem m, LRB_VECTOR_##suffix a, lrb_down_##suffix down) \
    {                                                                                                     \
        lrb_mask_##stem##_##suffix(c, m, lrb_mask(0xffff), a, down);                                      \
    }
LRB_STORE_DOWN(store_down, ps, 16)
LRB_STORE_DOWN(store_down_1, ps, 1)
LRB_STORE_DOWN(store_down_4, ps, 4)
LRB_STORE_DOWN(store_down, pi, 16)
LRB_STORE_DOWN(store_down_1, pi, 1)
LRB_STORE_DOWN(store_down_4, pi, 4)
#undef LRB_STORE_DOWN

/* LRB_S3_UP(ps): lrb_from_ps(m, LRB_UP_PS_float16), the last source from memory, converted; of the formats that S3 has */
#define LRB_S3_UP(suffix)                                                                                 \
    LRB_INLINE LRB_S3_##suffix lrb_from_##suffix(lrb_mem m, lrb_up_##suffix up)                        \
    {                                                                                                     \
        const unsigned bytes = lrb_up_##suffix##_bytes(up);                                               \
        LRB_ASSERT_ALIGNED(m, 16 * bytes);                                                                \
        assert(lrb_up_##suffix##_in_s3(up) && "only loads convert from this format");                     \
        return lrb_s3_memory_##suffix(m, (LRB_S3_##suffix){.lanes = lanes_up_##suffix(m.host, up)}, lrb_form_of_bytes(16 * bytes)); \
    }
LRB_S3_UP(ps)
LRB_S3_UP(pi)
#undef LRB_S3_UP

#endif
