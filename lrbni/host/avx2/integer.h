/* Integer lanes with AVX2: products, extremes, shifts, unsigned compare, permutes. */
#ifndef LRBNI_HOST_AVX2_INTEGER_H
#define LRBNI_HOST_AVX2_INTEGER_H

#include "lrbni/host/avx2/lanes.h"

/* LANES_I2(mull_pi, _mm256_mullo_epi32) */
#define LANES_I2(name, intrinsic)                                                                  \
    LANES_INLINE lrb_i32x16 lanes_##name(lrb_i32x16 a, lrb_i32x16 b)                               \
    {                                                                                              \
        return (lrb_i32x16){intrinsic(a.lo, b.lo), intrinsic(a.hi, b.hi)};                         \
    }
LANES_I2(mull_pi, _mm256_mullo_epi32)
LANES_I2(andn_pi, _mm256_andnot_si256)
LANES_I2(min_pi, _mm256_min_epi32)
LANES_I2(max_pi, _mm256_max_epi32)
LANES_I2(min_pu, _mm256_min_epu32)
LANES_I2(max_pu, _mm256_max_epu32)
/* Counts are unsigned; above 31 nothing is left but signs. */
LANES_I2(sllv_pi, _mm256_sllv_epi32)
LANES_I2(srlv_pi, _mm256_srlv_epi32)
LANES_I2(srav_pi, _mm256_srav_epi32)
#undef LANES_I2

/* LANES_HIGH(lanes_high_signed, _mm256_mul_epi32): the high halves of the products of even lanes, and of odd ones */
#define LANES_HIGH(name, multiply)                                                                 \
    LANES_INLINE __m256i name(__m256i a, __m256i b)                                                \
    {                                                                                              \
        __m256i even = multiply(a, b);                                                             \
        __m256i odd = multiply(_mm256_srli_epi64(a, 32), _mm256_srli_epi64(b, 32));                \
        return _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);                         \
    }
LANES_HIGH(lanes_high_signed, _mm256_mul_epi32)
LANES_HIGH(lanes_high_unsigned, _mm256_mul_epu32)
#undef LANES_HIGH

LANES_INLINE lrb_i32x16 lanes_mulh_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return (lrb_i32x16){lanes_high_signed(a.lo, b.lo), lanes_high_signed(a.hi, b.hi)};
}

LANES_INLINE lrb_i32x16 lanes_mulh_pu(lrb_i32x16 a, lrb_i32x16 b)
{
    return (lrb_i32x16){lanes_high_unsigned(a.lo, b.lo), lanes_high_unsigned(a.hi, b.hi)};
}

/* Signed compare of values whose range was moved to the signed one. */
LANES_INLINE uint32_t lanes_cmplt_pu(lrb_i32x16 a, lrb_i32x16 b)
{
    const __m256i top = _mm256_set1_epi32(INT32_MIN);
    lrb_i32x16 moved_a = {_mm256_xor_si256(a.lo, top), _mm256_xor_si256(a.hi, top)};
    lrb_i32x16 moved_b = {_mm256_xor_si256(b.lo, top), _mm256_xor_si256(b.hi, top)};
    return lanes_cmplt_pi(moved_a, moved_b);
}

/* Half of lanes_permd_pi: bit 3 of an index says which half of b. */
LANES_INLINE __m256i lanes_permute_half(__m256i index, lrb_i32x16 b)
{
    __m256 low = _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(b.lo, index));
    __m256 high = _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(b.hi, index));
    return _mm256_castps_si256(_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(index, 28))));
}

/* Lane a[i] mod 16 of b. */
LANES_INLINE lrb_i32x16 lanes_permd_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return (lrb_i32x16){lanes_permute_half(a.lo, b), lanes_permute_half(a.hi, b)};
}

/* Lanes n and up of b, then the first n of a; n in 0..15. There is no such instruction: through memory. */
LANES_INLINE lrb_i32x16 lanes_alignd_pi(lrb_i32x16 a, lrb_i32x16 b, unsigned n)
{
    int32_t both[32];
    lanes_store_pi(both, b);
    lanes_store_pi(both + 16, a);
    return lanes_load_pi(both + n);
}

#endif
