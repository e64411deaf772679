/* Sixteen lanes as two 32-byte halves: AVX2 and FMA. gcc 12 turns 64-byte vector types into scalar code. */
#ifndef LRBNI_HOST_AVX2_LANES_H
#define LRBNI_HOST_AVX2_LANES_H

#include <immintrin.h>
#include <stdint.h>

#include "lrbni/numeric.h"

#define LRB_BACKEND "avx2"

#define LANES_INLINE static inline __attribute__((always_inline))

typedef struct lrb_f32x16 {
    __m256 lo, hi;
} lrb_f32x16;

typedef struct lrb_i32x16 {
    __m256i lo, hi;
} lrb_i32x16;

LANES_INLINE lrb_f32x16 lanes_rcpres_ps(lrb_f32x16 a)
{
    const __m256 one = _mm256_set1_ps(1.0f);
    const __m256 keep = _mm256_castsi256_ps(_mm256_set1_epi32((int)LRB_ESTIMATE_BITS));
    return (lrb_f32x16){_mm256_and_ps(_mm256_div_ps(one, a.lo), keep), _mm256_and_ps(_mm256_div_ps(one, a.hi), keep)};
}

/* LANES_I2(add, _mm256_add_epi32) */
#define LANES_I2(name, intrinsic)                                                                  \
    LANES_INLINE lrb_i32x16 lanes_##name##_pi(lrb_i32x16 a, lrb_i32x16 b)                          \
    {                                                                                              \
        return (lrb_i32x16){intrinsic(a.lo, b.lo), intrinsic(a.hi, b.hi)};                         \
    }
LANES_I2(add, _mm256_add_epi32)
LANES_I2(sub, _mm256_sub_epi32)
LANES_I2(and, _mm256_and_si256)
LANES_I2(or, _mm256_or_si256)
LANES_I2(xor, _mm256_xor_si256)
#undef LANES_I2

LANES_INLINE uint32_t lanes_sign_bits(__m256 lo, __m256 hi)
{
    return (uint32_t)_mm256_movemask_ps(lo) | (uint32_t)_mm256_movemask_ps(hi) << 8;
}

LANES_INLINE uint32_t lanes_cmpeq_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return lanes_sign_bits(_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.lo, b.lo)),
                           _mm256_castsi256_ps(_mm256_cmpeq_epi32(a.hi, b.hi)));
}

LANES_INLINE uint32_t lanes_cmplt_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return lanes_sign_bits(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.lo, a.lo)),
                           _mm256_castsi256_ps(_mm256_cmpgt_epi32(b.hi, a.hi)));
}

LANES_INLINE uint32_t lanes_cmple_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pi(b, a) ^ 0xffffu; }

/* All ones in the lanes whose bit is set. */
LANES_INLINE lrb_i32x16 lanes_expand_mask(uint32_t k)
{
    const __m256i low_bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i high_bits = _mm256_slli_epi32(low_bits, 8);
    const __m256i all = _mm256_set1_epi32((int)k);
    return (lrb_i32x16){_mm256_cmpeq_epi32(_mm256_and_si256(all, low_bits), low_bits),
                        _mm256_cmpeq_epi32(_mm256_and_si256(all, high_bits), high_bits)};
}

LANES_INLINE lrb_i32x16 lanes_bits_ps(lrb_f32x16 a)
{
    return (lrb_i32x16){_mm256_castps_si256(a.lo), _mm256_castps_si256(a.hi)};
}

LANES_INLINE lrb_f32x16 lanes_bits_pi(lrb_i32x16 a)
{
    return (lrb_f32x16){_mm256_castsi256_ps(a.lo), _mm256_castsi256_ps(a.hi)};
}

LANES_INLINE lrb_f32x16 lanes_merge_ps(uint32_t k, lrb_f32x16 old, lrb_f32x16 new_lanes)
{
    lrb_f32x16 m = lanes_bits_pi(lanes_expand_mask(k));
    return (lrb_f32x16){_mm256_blendv_ps(old.lo, new_lanes.lo, m.lo), _mm256_blendv_ps(old.hi, new_lanes.hi, m.hi)};
}

LANES_INLINE lrb_i32x16 lanes_merge_pi(uint32_t k, lrb_i32x16 old, lrb_i32x16 new_lanes)
{
    return lanes_bits_ps(lanes_merge_ps(k, lanes_bits_pi(old), lanes_bits_pi(new_lanes)));
}

LANES_INLINE lrb_f32x16 lanes_swizzle_ps(lrb_f32x16 a, unsigned words)
{
    const __m256i index = _mm256_setr_epi32((int)(words & 3), (int)(words >> 2 & 3), (int)(words >> 4 & 3), (int)(words >> 6 & 3),
                                            (int)(words & 3), (int)(words >> 2 & 3), (int)(words >> 4 & 3), (int)(words >> 6 & 3));
    return (lrb_f32x16){_mm256_permutevar_ps(a.lo, index), _mm256_permutevar_ps(a.hi, index)};
}

/* The two blocks of one half of the result, from the four blocks of the source. */
LANES_INLINE __m256 lanes_two_blocks(lrb_f32x16 a, unsigned first, unsigned second)
{
    const int f = (int)(4 * (first & 1)), s = (int)(4 * (second & 1));
    const __m256i index = _mm256_setr_epi32(f, f + 1, f + 2, f + 3, s, s + 1, s + 2, s + 3);
    const int f_high = first & 2 ? -1 : 0, s_high = second & 2 ? -1 : 0;
    const __m256i from_high = _mm256_setr_epi32(f_high, f_high, f_high, f_high, s_high, s_high, s_high, s_high);
    return _mm256_blendv_ps(_mm256_permutevar8x32_ps(a.lo, index), _mm256_permutevar8x32_ps(a.hi, index),
                            _mm256_castsi256_ps(from_high));
}

LANES_INLINE lrb_f32x16 lanes_shuf128x32_ps(lrb_f32x16 a, unsigned blocks, unsigned words)
{
    lrb_f32x16 moved = {lanes_two_blocks(a, blocks & 3, blocks >> 2 & 3), lanes_two_blocks(a, blocks >> 4 & 3, blocks >> 6 & 3)};
    return lanes_swizzle_ps(moved, words);
}

LANES_INLINE lrb_i32x16 lanes_load_pi(const void *m)
{
    const __m256i *half = (const __m256i *)m;
    return (lrb_i32x16){_mm256_loadu_si256(half), _mm256_loadu_si256(half + 1)};
}

LANES_INLINE lrb_i32x16 lanes_load_1to16_pi(const void *m)
{
    __m256i all = _mm256_castps_si256(_mm256_broadcast_ss((const float *)m));
    return (lrb_i32x16){all, all};
}

LANES_INLINE lrb_i32x16 lanes_load_4to16_pi(const void *m)
{
    __m256i all = _mm256_castps_si256(_mm256_broadcast_ps((const __m128 *)m));
    return (lrb_i32x16){all, all};
}

/* Reads the selected lanes only; the others come from `old`. */
LANES_INLINE lrb_i32x16 lanes_mask_load_pi(lrb_i32x16 old, uint32_t k, const void *m)
{
    const int *word = (const int *)m;
    lrb_i32x16 lanes = lanes_expand_mask(k);
    lrb_i32x16 read = {_mm256_maskload_epi32(word, lanes.lo), _mm256_maskload_epi32(word + 8, lanes.hi)};
    return lanes_merge_pi(k, old, read);
}

LANES_INLINE void lanes_store_pi(void *m, lrb_i32x16 a)
{
    __m256i *half = (__m256i *)m;
    _mm256_storeu_si256(half, a.lo);
    _mm256_storeu_si256(half + 1, a.hi);
}

/* Writes the selected lanes only. */
LANES_INLINE void lanes_mask_store_pi(void *m, uint32_t k, lrb_i32x16 a)
{
    int *word = (int *)m;
    lrb_i32x16 lanes = lanes_expand_mask(k);
    _mm256_maskstore_epi32(word, lanes.lo, a.lo);
    _mm256_maskstore_epi32(word + 8, lanes.hi, a.hi);
}

#include "lrbni/host/float_memory.h"

#endif
