/* The same register as eight lanes of 64 bits. Bits 8 and up of a mask are not looked at. */
#ifndef LRBNI_HOST_AVX512_LANES64_H
#define LRBNI_HOST_AVX512_LANES64_H

#include "lrbni/host/avx512/lanes.h"

typedef struct lrb_f64x8 {
    __m512d v;
} lrb_f64x8;

typedef struct lrb_i64x8 {
    __m512i v;
} lrb_i64x8;

LANES_INLINE lrb_i64x8 lanes_bits_pd(lrb_f64x8 a) { return (lrb_i64x8){_mm512_castpd_si512(a.v)}; }
LANES_INLINE lrb_f64x8 lanes_bits_pq(lrb_i64x8 a) { return (lrb_f64x8){_mm512_castsi512_pd(a.v)}; }
LANES_INLINE lrb_i32x16 lanes_pi_from_pq(lrb_i64x8 a) { return (lrb_i32x16){a.v}; }
LANES_INLINE lrb_i64x8 lanes_pq_from_pi(lrb_i32x16 a) { return (lrb_i64x8){a.v}; }

LANES_INLINE lrb_i64x8 lanes_merge_pq(uint32_t k, lrb_i64x8 old, lrb_i64x8 new_lanes)
{
    return (lrb_i64x8){_mm512_mask_mov_epi64(old.v, (__mmask8)k, new_lanes.v)};
}

/* Lane 4g+j of the result is lane 4g + word j of the source; `words` holds two bits per j, lowest first. */
LANES_INLINE lrb_i64x8 lanes_swizzle_pq(lrb_i64x8 a, unsigned words)
{
    const long long w0 = words & 3, w1 = words >> 2 & 3, w2 = words >> 4 & 3, w3 = words >> 6 & 3;
    return (lrb_i64x8){_mm512_permutexvar_epi64(_mm512_setr_epi64(w0, w1, w2, w3, 4 + w0, 4 + w1, 4 + w2, 4 + w3), a.v)};
}

LANES_INLINE lrb_i64x8 lanes_load_pq(const void *m) { return (lrb_i64x8){_mm512_loadu_si512(m)}; }

LANES_INLINE lrb_i64x8 lanes_load_1to8_pq(const void *m)
{
    return (lrb_i64x8){_mm512_castpd_si512(_mm512_broadcastsd_pd(_mm_load_sd((const double *)m)))};
}

LANES_INLINE lrb_i64x8 lanes_load_4to8_pq(const void *m)
{
    return (lrb_i64x8){_mm512_broadcast_i64x4(_mm256_loadu_si256((const __m256i *)m))};
}

/* Reads the selected lanes only; the others come from `old`. */
LANES_INLINE lrb_i64x8 lanes_mask_load_pq(lrb_i64x8 old, uint32_t k, const void *m)
{
    return (lrb_i64x8){_mm512_mask_loadu_epi64(old.v, (__mmask8)k, m)};
}

LANES_INLINE void lanes_store_pq(void *m, lrb_i64x8 a) { _mm512_storeu_si512(m, a.v); }

/* Writes the selected lanes only. */
LANES_INLINE void lanes_mask_store_pq(void *m, uint32_t k, lrb_i64x8 a) { _mm512_mask_storeu_epi64(m, (__mmask8)k, a.v); }

#include "lrbni/host/double_memory.h"

#endif
