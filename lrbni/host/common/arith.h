/* Arithmetic that no host has an instruction for: lane by lane, in integers. Included by the back ends' arith.h. */
#ifndef LRBNI_HOST_COMMON_ARITH_H
#define LRBNI_HOST_COMMON_ARITH_H

#include "lrbni/exact.h"

/* Arithmetic in a state that is not the default one. LANES_EXACT(ps, f32x16, uint32_t, 16) */
#define LANES_EXACT(suffix, type, word, count)                                                                     \
    static __attribute__((cold, noinline, unused)) lrb_##type lanes_exact_##suffix(lrb_control control, lrb_exact_op op, \
                                                                                  lrb_##type x, lrb_##type y, lrb_##type z) \
    {                                                                                                              \
        word r[count], sources[3][count];                                                                          \
        lanes_store_##suffix(sources[0], x);                                                                       \
        lanes_store_##suffix(sources[1], y);                                                                       \
        lanes_store_##suffix(sources[2], z);                                                                       \
        lrb_exact_##suffix(control, op, r, sources[0], sources[1], sources[2]);                                    \
        return lanes_load_##suffix(r);                                                                             \
    }                                                                                                              \
    /* Subnormal lanes as zeros of their sign. */                                                                  \
    static __attribute__((cold, noinline, unused)) lrb_##type lanes_flushed_##suffix(lrb_##type x)                 \
    {                                                                                                              \
        word lanes[count];                                                                                         \
        lanes_store_##suffix(lanes, x);                                                                            \
        for (int i = 0; i < count; i++)                                                                            \
            lanes[i] = lrb_flushed_##suffix(lanes[i]);                                                             \
        return lanes_load_##suffix(lanes);                                                                         \
    }
LANES_EXACT(ps, f32x16, uint32_t, 16)
LANES_EXACT(pd, f64x8, uint64_t, 8)
#undef LANES_EXACT

static inline lrb_f32x16 lanes_clampz_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    uint32_t x[16], y[16];
    lanes_store_ps(x, a);
    lanes_store_ps(y, b);
    for (int i = 0; i < 16; i++)
        x[i] = lrb_clampz(x[i], y[i]);
    return lanes_load_ps(x);
}

#endif
