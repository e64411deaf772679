/* The same register as eight lanes of 64 bits, in two halves. Bits 8 and up of a mask are not looked at. */
#ifndef LRBNI_HOST_AVX2_LANES64_H
#define LRBNI_HOST_AVX2_LANES64_H

#include "lrbni/host/avx2/lanes.h"

typedef struct lrb_f64x8 {
    __m256d lo, hi;
} lrb_f64x8;

typedef struct lrb_i64x8 {
    __m256i lo, hi;
} lrb_i64x8;

LANES_INLINE lrb_i64x8 lanes_bits_pd(lrb_f64x8 a) { return (lrb_i64x8){_mm256_castpd_si256(a.lo), _mm256_castpd_si256(a.hi)}; }
LANES_INLINE lrb_f64x8 lanes_bits_pq(lrb_i64x8 a) { return (lrb_f64x8){_mm256_castsi256_pd(a.lo), _mm256_castsi256_pd(a.hi)}; }
LANES_INLINE lrb_i32x16 lanes_pi_from_pq(lrb_i64x8 a) { return (lrb_i32x16){a.lo, a.hi}; }
LANES_INLINE lrb_i64x8 lanes_pq_from_pi(lrb_i32x16 a) { return (lrb_i64x8){a.lo, a.hi}; }

/* All ones in the lanes whose bit is set. */
LANES_INLINE lrb_i64x8 lanes_expand_mask_pq(uint32_t k)
{
    const __m256i low_bits = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i high_bits = _mm256_slli_epi64(low_bits, 4);
    const __m256i all = _mm256_set1_epi64x((long long)k);
    return (lrb_i64x8){_mm256_cmpeq_epi64(_mm256_and_si256(all, low_bits), low_bits),
                       _mm256_cmpeq_epi64(_mm256_and_si256(all, high_bits), high_bits)};
}

LANES_INLINE lrb_i64x8 lanes_merge_pq(uint32_t k, lrb_i64x8 old, lrb_i64x8 new_lanes)
{
    lrb_i64x8 m = lanes_expand_mask_pq(k);
    return (lrb_i64x8){_mm256_blendv_epi8(old.lo, new_lanes.lo, m.lo), _mm256_blendv_epi8(old.hi, new_lanes.hi, m.hi)};
}

/* Lane 4g+j of the result is lane 4g + word j of the source; `words` holds two bits per j, lowest first. */
LANES_INLINE lrb_i64x8 lanes_swizzle_pq(lrb_i64x8 a, unsigned words)
{
    const int w0 = (int)(2 * (words & 3)), w1 = (int)(2 * (words >> 2 & 3));
    const int w2 = (int)(2 * (words >> 4 & 3)), w3 = (int)(2 * (words >> 6 & 3));
    const __m256i index = _mm256_setr_epi32(w0, w0 + 1, w1, w1 + 1, w2, w2 + 1, w3, w3 + 1);
    return (lrb_i64x8){_mm256_permutevar8x32_epi32(a.lo, index), _mm256_permutevar8x32_epi32(a.hi, index)};
}

LANES_INLINE lrb_i64x8 lanes_load_pq(const void *m) { return lanes_pq_from_pi(lanes_load_pi(m)); }

LANES_INLINE lrb_i64x8 lanes_load_1to8_pq(const void *m)
{
    __m256i all = _mm256_castpd_si256(_mm256_broadcast_sd((const double *)m));
    return (lrb_i64x8){all, all};
}

LANES_INLINE lrb_i64x8 lanes_load_4to8_pq(const void *m)
{
    __m256i all = _mm256_loadu_si256((const __m256i *)m);
    return (lrb_i64x8){all, all};
}

/* Reads the selected lanes only; the others come from `old`. */
LANES_INLINE lrb_i64x8 lanes_mask_load_pq(lrb_i64x8 old, uint32_t k, const void *m)
{
    const long long *word = (const long long *)m;
    lrb_i64x8 lanes = lanes_expand_mask_pq(k);
    lrb_i64x8 read = {_mm256_maskload_epi64(word, lanes.lo), _mm256_maskload_epi64(word + 4, lanes.hi)};
    return lanes_merge_pq(k, old, read);
}

LANES_INLINE void lanes_store_pq(void *m, lrb_i64x8 a) { lanes_store_pi(m, lanes_pi_from_pq(a)); }

/* Writes the selected lanes only. */
LANES_INLINE void lanes_mask_store_pq(void *m, uint32_t k, lrb_i64x8 a)
{
    long long *word = (long long *)m;
    lrb_i64x8 lanes = lanes_expand_mask_pq(k);
    _mm256_maskstore_epi64(word, lanes.lo, a.lo);
    _mm256_maskstore_epi64(word + 4, lanes.hi, a.hi);
}

#include "lrbni/host/double_memory.h"

#endif
