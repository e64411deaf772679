/* Integer lanes with AVX-512: products, extremes, shifts, unsigned compare, permutes. */
#ifndef LRBNI_HOST_AVX512_INTEGER_H
#define LRBNI_HOST_AVX512_INTEGER_H

#include "lrbni/host/avx512/lanes.h"

/* LANES_I2(mull_pi, _mm512_mullo_epi32) */
#define LANES_I2(name, intrinsic)                                                                  \
    LANES_INLINE lrb_i32x16 lanes_##name(lrb_i32x16 a, lrb_i32x16 b)                               \
    {                                                                                              \
        return (lrb_i32x16){intrinsic(a.v, b.v)};                                                  \
    }
LANES_I2(mull_pi, _mm512_mullo_epi32)
LANES_I2(andn_pi, _mm512_andnot_si512)
LANES_I2(min_pi, _mm512_min_epi32)
LANES_I2(max_pi, _mm512_max_epi32)
LANES_I2(min_pu, _mm512_min_epu32)
LANES_I2(max_pu, _mm512_max_epu32)
/* Counts are unsigned; above 31 nothing is left but signs. */
LANES_I2(sllv_pi, _mm512_sllv_epi32)
LANES_I2(srlv_pi, _mm512_srlv_epi32)
LANES_I2(srav_pi, _mm512_srav_epi32)
/* Lane a[i] mod 16 of b. */
LANES_I2(permd_pi, _mm512_permutexvar_epi32)
#undef LANES_I2

/* LANES_HIGH(mulh_pi, _mm512_mul_epi32): the high halves of the products of even lanes, and of odd ones */
#define LANES_HIGH(name, multiply)                                                                 \
    LANES_INLINE lrb_i32x16 lanes_##name(lrb_i32x16 a, lrb_i32x16 b)                               \
    {                                                                                              \
        __m512i even = multiply(a.v, b.v);                                                         \
        __m512i odd = multiply(_mm512_srli_epi64(a.v, 32), _mm512_srli_epi64(b.v, 32));            \
        return (lrb_i32x16){_mm512_mask_mov_epi32(_mm512_srli_epi64(even, 32), 0xaaaa, odd)};      \
    }
LANES_HIGH(mulh_pi, _mm512_mul_epi32)
LANES_HIGH(mulh_pu, _mm512_mul_epu32)
#undef LANES_HIGH

LANES_INLINE uint32_t lanes_cmplt_pu(lrb_i32x16 a, lrb_i32x16 b) { return _mm512_cmplt_epu32_mask(a.v, b.v); }

/* Lanes n and up of b, then the first n of a; n in 0..15. */
LANES_INLINE lrb_i32x16 lanes_alignd_pi(lrb_i32x16 a, lrb_i32x16 b, unsigned n)
{
    const __m512i from = _mm512_add_epi32(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
                                          _mm512_set1_epi32((int)n));
    return (lrb_i32x16){_mm512_permutex2var_epi32(b.v, from, a.v)};
}

#endif
