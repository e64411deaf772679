/* Sixteen lanes as one 64-byte register: AVX-512F. */
#ifndef LRBNI_HOST_AVX512_LANES_H
#define LRBNI_HOST_AVX512_LANES_H

#include <immintrin.h>
#include <stdint.h>

#include "lrbni/numeric.h"

#define LRB_BACKEND "avx512"

#define LANES_INLINE static inline __attribute__((always_inline))

typedef struct lrb_f32x16 {
    __m512 v;
} lrb_f32x16;

typedef struct lrb_i32x16 {
    __m512i v;
} lrb_i32x16;

LANES_INLINE lrb_f32x16 lanes_rcpres_ps(lrb_f32x16 a)
{
    __m512i exact = _mm512_castps_si512(_mm512_div_ps(_mm512_set1_ps(1.0f), a.v));
    return (lrb_f32x16){_mm512_castsi512_ps(_mm512_and_si512(exact, _mm512_set1_epi32((int)LRB_ESTIMATE_BITS)))};
}

/* LANES_I2(add, _mm512_add_epi32) */
#define LANES_I2(name, intrinsic)                                                                  \
    LANES_INLINE lrb_i32x16 lanes_##name##_pi(lrb_i32x16 a, lrb_i32x16 b)                          \
    {                                                                                              \
        return (lrb_i32x16){intrinsic(a.v, b.v)};                                                  \
    }
LANES_I2(add, _mm512_add_epi32)
LANES_I2(sub, _mm512_sub_epi32)
LANES_I2(and, _mm512_and_si512)
LANES_I2(or, _mm512_or_si512)
LANES_I2(xor, _mm512_xor_si512)
#undef LANES_I2

LANES_INLINE uint32_t lanes_cmpeq_pi(lrb_i32x16 a, lrb_i32x16 b) { return _mm512_cmpeq_epi32_mask(a.v, b.v); }
LANES_INLINE uint32_t lanes_cmplt_pi(lrb_i32x16 a, lrb_i32x16 b) { return _mm512_cmplt_epi32_mask(a.v, b.v); }
LANES_INLINE uint32_t lanes_cmple_pi(lrb_i32x16 a, lrb_i32x16 b) { return _mm512_cmple_epi32_mask(a.v, b.v); }

LANES_INLINE lrb_i32x16 lanes_bits_ps(lrb_f32x16 a) { return (lrb_i32x16){_mm512_castps_si512(a.v)}; }
LANES_INLINE lrb_f32x16 lanes_bits_pi(lrb_i32x16 a) { return (lrb_f32x16){_mm512_castsi512_ps(a.v)}; }

LANES_INLINE lrb_f32x16 lanes_merge_ps(uint32_t k, lrb_f32x16 old, lrb_f32x16 new_lanes)
{
    return (lrb_f32x16){_mm512_mask_mov_ps(old.v, (__mmask16)k, new_lanes.v)};
}

LANES_INLINE lrb_i32x16 lanes_merge_pi(uint32_t k, lrb_i32x16 old, lrb_i32x16 new_lanes)
{
    return (lrb_i32x16){_mm512_mask_mov_epi32(old.v, (__mmask16)k, new_lanes.v)};
}

LANES_INLINE lrb_f32x16 lanes_shuf128x32_ps(lrb_f32x16 a, unsigned blocks, unsigned words)
{
    const int w0 = (int)(words & 3), w1 = (int)(words >> 2 & 3), w2 = (int)(words >> 4 & 3), w3 = (int)(words >> 6 & 3);
    const int b0 = (int)(4 * (blocks & 3)), b1 = (int)(4 * (blocks >> 2 & 3));
    const int b2 = (int)(4 * (blocks >> 4 & 3)), b3 = (int)(4 * (blocks >> 6 & 3));
    const __m512i index = _mm512_setr_epi32(b0 + w0, b0 + w1, b0 + w2, b0 + w3, b1 + w0, b1 + w1, b1 + w2, b1 + w3,
                                            b2 + w0, b2 + w1, b2 + w2, b2 + w3, b3 + w0, b3 + w1, b3 + w2, b3 + w3);
    return (lrb_f32x16){_mm512_permutexvar_ps(index, a.v)};
}

LANES_INLINE lrb_f32x16 lanes_swizzle_ps(lrb_f32x16 a, unsigned words)
{
    return lanes_shuf128x32_ps(a, 0xe4, words); /* blocks 3 2 1 0: each in its place */
}

LANES_INLINE lrb_i32x16 lanes_load_pi(const void *m) { return (lrb_i32x16){_mm512_loadu_si512(m)}; }

LANES_INLINE lrb_i32x16 lanes_load_1to16_pi(const void *m)
{
    return (lrb_i32x16){_mm512_castps_si512(_mm512_broadcastss_ps(_mm_load_ss((const float *)m)))};
}

LANES_INLINE lrb_i32x16 lanes_load_4to16_pi(const void *m)
{
    return (lrb_i32x16){_mm512_broadcast_i32x4(_mm_loadu_si128((const __m128i *)m))};
}

/* Reads the selected lanes only; the others come from `old`. */
LANES_INLINE lrb_i32x16 lanes_mask_load_pi(lrb_i32x16 old, uint32_t k, const void *m)
{
    return (lrb_i32x16){_mm512_mask_loadu_epi32(old.v, (__mmask16)k, m)};
}

LANES_INLINE void lanes_store_pi(void *m, lrb_i32x16 a) { _mm512_storeu_si512(m, a.v); }

/* Writes the selected lanes only. */
LANES_INLINE void lanes_mask_store_pi(void *m, uint32_t k, lrb_i32x16 a) { _mm512_mask_storeu_epi32(m, (__mmask16)k, a.v); }

#include "lrbni/host/float_memory.h"

#endif
