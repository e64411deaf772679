/* Intrinsics that are more or less than one op: constants, casts, swizzles, permutations, masks, reductions. Included by
 * lanetrace/lrbni_intrinsics.h. */
#ifndef LANETRACE_INTRINSICS_LANES_H
#define LANETRACE_INTRINSICS_LANES_H

#include "lanetrace/intrinsics_base.h"

/* A constant is a load from the constant pool; zero is a register's exclusive or with itself, which reads nothing. */
static inline lrb_v16f lanetrace_mm512_set1_ps(float a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_load_1to16_ps(c, lanetrace_constant(c, &a, sizeof a));
}

static inline lrb_v16i lanetrace_mm512_set1_epi32(int a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_load_1to16_pi(c, lanetrace_constant(c, &a, sizeof a));
}

static inline lrb_v16f lanetrace_mm512_set4_ps(float d, float b3, float b2, float b1)
{
    lrb_ctx *c = lanetrace_c();
    const float values[4] = {b1, b2, b3, d};
    return lrb_load_4to16_ps(c, lanetrace_constant(c, values, sizeof values));
}

static inline lrb_v16i lanetrace_mm512_set4_epi32(int d, int b3, int b2, int b1)
{
    lrb_ctx *c = lanetrace_c();
    const int values[4] = {b1, b2, b3, d};
    return lrb_load_4to16_pi(c, lanetrace_constant(c, values, sizeof values));
}

/* LANETRACE_SET(ps, float, v16f): set_ps, lane 15 first, and setr_ps, lane 0 first */
#define LANETRACE_SET(suffix, op_suffix, type, vector)                                                              \
    static inline vector lanetrace_mm512_setr_##suffix(type e0, type e1, type e2, type e3, type e4, type e5, type e6, \
                                                       type e7, type e8, type e9, type e10, type e11, type e12,     \
                                                       type e13, type e14, type e15)                                \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        const type values[16] = {e0, e1, e2, e3, e4, e5, e6, e7, e8, e9, e10, e11, e12, e13, e14, e15};              \
        return lrb_load_##op_suffix(c, lanetrace_constant(c, values, sizeof values));                               \
    }                                                                                                               \
    static inline vector lanetrace_mm512_set_##suffix(type e15, type e14, type e13, type e12, type e11, type e10,   \
                                                      type e9, type e8, type e7, type e6, type e5, type e4, type e3, \
                                                      type e2, type e1, type e0)                                    \
    {                                                                                                               \
        return lanetrace_mm512_setr_##suffix(e0, e1, e2, e3, e4, e5, e6, e7, e8, e9, e10, e11, e12, e13, e14, e15);  \
    }
LANETRACE_SET(ps, ps, float, lrb_v16f)
LANETRACE_SET(epi32, pi, int, lrb_v16i)
#undef LANETRACE_SET

/* A register of which nothing is known; here 0. No op. */
static inline lrb_v16i lanetrace_mm512_undefined_epi32(void)
{
    static const int32_t zeros[16];
    lrb_v16i v = {.lanes = lanes_load_pi(zeros)};
    LRB_SET_FROM(v, 0);
    return v;
}

static inline lrb_v16f lanetrace_mm512_undefined_ps(void) { return lanetrace_f_of_i(lanetrace_mm512_undefined_epi32()); }
static inline lrb_v8d lanetrace_mm512_undefined_pd(void) { return lanetrace_d_of_i(lanetrace_mm512_undefined_epi32()); }

static inline lrb_v16i lanetrace_mm512_setzero_epi32(void)
{
    lrb_v16i any = lanetrace_mm512_undefined_epi32();
    return lrb_xor_pi(lanetrace_c(), any, any);
}

static inline lrb_v16f lanetrace_mm512_setzero_ps(void) { return lanetrace_f_of_i(lanetrace_mm512_setzero_epi32()); }
static inline lrb_v8d lanetrace_mm512_setzero_pd(void) { return lanetrace_d_of_i(lanetrace_mm512_setzero_epi32()); }

/* Casts: no op. */
static inline lrb_v16i lanetrace_mm512_castps_si512(lrb_v16f a) { return lanetrace_i_of_f(a); }
static inline lrb_v16f lanetrace_mm512_castsi512_ps(lrb_v16i a) { return lanetrace_f_of_i(a); }
static inline lrb_v8d lanetrace_mm512_castsi512_pd(lrb_v16i a) { return lanetrace_d_of_i(a); }
static inline lrb_v16i lanetrace_mm512_castpd_si512(lrb_v8d a) { return lanetrace_i_of_d(a); }
static inline lrb_v8d lanetrace_mm512_castps_pd(lrb_v16f a) { return lanetrace_d_of_i(lanetrace_i_of_f(a)); }
static inline lrb_v16f lanetrace_mm512_castpd_ps(lrb_v8d a) { return lanetrace_f_of_i(lanetrace_i_of_d(a)); }

/* The words of a swizzle. */
static inline lrb_swizzle lanetrace_swizzle(lanetrace_swizzle_enum s)
{
    static const unsigned char words[] = {LRB_DCBA, LRB_DCBA, LRB_CDAB, LRB_BADC, LRB_AAAA, LRB_BBBB, LRB_CCCC, LRB_DDDD, LRB_DACB};
    assert((unsigned)s < sizeof words && "not a _MM_SWIZZLE_ENUM");
    return (lrb_swizzle)words[s];
}

/* LANETRACE_SWIZZLE(ps, ps, lrb_v16f): swizzle_ps, mask_swizzle_ps: a move of its own, which a compiler may fold into the op that
 * reads it. */
#define LANETRACE_SWIZZLE(suffix, op_suffix, vector)                                                                \
    static inline vector lanetrace_mm512_swizzle_##suffix(vector v, lanetrace_swizzle_enum s)                       \
    {                                                                                                               \
        return lrb_mov_##op_suffix##_s3(lanetrace_c(), lrb_swizzle_##op_suffix(v, lanetrace_swizzle(s)));           \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_swizzle_##suffix(vector src, unsigned k, vector v, lanetrace_swizzle_enum s) \
    {                                                                                                               \
        return lrb_mask_mov_##op_suffix##_s3(lanetrace_c(), src, lanetrace_k(k), lrb_swizzle_##op_suffix(v, lanetrace_swizzle(s))); \
    }
LANETRACE_SWIZZLE(ps, ps, lrb_v16f)
LANETRACE_SWIZZLE(epi32, pi, lrb_v16i)
#undef LANETRACE_SWIZZLE

/* Blocks of 128 bits, and words within them; two bits a choice, lowest first. */
static inline lrb_v16f lanetrace_mm512_permute4f128_ps(lrb_v16f a, int blocks)
{
    return lrb_shuf128x32_ps(lanetrace_c(), a, (unsigned)blocks, LRB_DCBA);
}

static inline lrb_v16f lanetrace_mm512_mask_permute4f128_ps(lrb_v16f src, unsigned k, lrb_v16f a, int blocks)
{
    return lrb_mask_shuf128x32_ps(lanetrace_c(), src, lanetrace_k(k), a, (unsigned)blocks, LRB_DCBA);
}

static inline lrb_v16i lanetrace_mm512_permute4f128_epi32(lrb_v16i a, int blocks)
{
    return lanetrace_i_of_f(lanetrace_mm512_permute4f128_ps(lanetrace_f_of_i(a), blocks));
}

static inline lrb_v16i lanetrace_mm512_mask_permute4f128_epi32(lrb_v16i src, unsigned k, lrb_v16i a, int blocks)
{
    return lanetrace_i_of_f(lanetrace_mm512_mask_permute4f128_ps(lanetrace_f_of_i(src), k, lanetrace_f_of_i(a), blocks));
}

static inline lrb_v16i lanetrace_mm512_shuffle_epi32(lrb_v16i a, int words)
{
    return lanetrace_i_of_f(lrb_shuf128x32_ps(lanetrace_c(), lanetrace_f_of_i(a), LRB_DCBA, (unsigned)words));
}

static inline lrb_v16i lanetrace_mm512_mask_shuffle_epi32(lrb_v16i src, unsigned k, lrb_v16i a, int words)
{
    return lanetrace_i_of_f(lrb_mask_shuf128x32_ps(lanetrace_c(), lanetrace_f_of_i(src), lanetrace_k(k), lanetrace_f_of_i(a), LRB_DCBA,
                                                   (unsigned)words));
}

/* Masks and C's integers. The flags of kortest become a value by branching on them. */
static inline __mmask16 lanetrace_mm512_int2mask(int a) { return (__mmask16)lanetrace_made(lrb_kmov_kr(lanetrace_c(), lanetrace_r((unsigned)a))); }
static inline int lanetrace_mm512_mask2int(unsigned k) { return (int)lrb_kmov_rk(lanetrace_c(), lanetrace_k(k)).value; }
static inline int lanetrace_mm512_kortestz(unsigned k1, unsigned k2)
{
    lrb_k16 a = lanetrace_k(k1), b = lanetrace_k(k2);
    return lrb_kortest(lanetrace_c(), a, b).zero;
}

static inline int lanetrace_mm512_kortestc(unsigned k1, unsigned k2)
{
    lrb_k16 a = lanetrace_k(k1), b = lanetrace_k(k2);
    return lrb_kortest(lanetrace_c(), a, b).carry;
}

/* LANETRACE_CMP_FLOAT(ps, lrb_v16f): cmp_ps_mask, mask_cmp_ps_mask, for the predicates that the ISA has, and for > and >= by swapping.
 * An unmasked compare leaves the event of one under a mask of ones that no op made. */
#define LANETRACE_CMP_CASE(number, name, first, second)          \
    case number:                                                 \
    case number | 16: /* quiet or signalling: no flag is kept */ \
        return lrb_mask_##name(c, k, first, second)
#define LANETRACE_CMP_FLOAT(suffix, vector)                                                                         \
    static inline lrb_k16 lanetrace_cmp_##suffix(lrb_ctx *c, lrb_k16 k, vector a, vector b, int predicate)          \
    {                                                                                                               \
        switch (predicate) {                                                                                        \
            LANETRACE_CMP_CASE(0, cmpeq_##suffix, a, b);                                                            \
            LANETRACE_CMP_CASE(1, cmplt_##suffix, a, b);                                                            \
            LANETRACE_CMP_CASE(2, cmple_##suffix, a, b);                                                            \
            LANETRACE_CMP_CASE(3, cmpunord_##suffix, a, b);                                                         \
            LANETRACE_CMP_CASE(4, cmpneq_##suffix, a, b);                                                           \
            LANETRACE_CMP_CASE(5, cmpnlt_##suffix, a, b);                                                           \
            LANETRACE_CMP_CASE(6, cmpnle_##suffix, a, b);                                                           \
            LANETRACE_CMP_CASE(7, cmpord_##suffix, a, b);                                                           \
            LANETRACE_CMP_CASE(9, cmpnle_##suffix, b, a);                                                           \
            LANETRACE_CMP_CASE(10, cmpnlt_##suffix, b, a);                                                          \
            LANETRACE_CMP_CASE(13, cmple_##suffix, b, a);                                                           \
            LANETRACE_CMP_CASE(14, cmplt_##suffix, b, a);                                                           \
        }                                                                                                           \
        assert(0 && "a predicate that the ISA has not");                                                            \
        return lrb_mask(0);                                                                                         \
    }
LANETRACE_CMP_FLOAT(ps, lrb_v16f)
#undef LANETRACE_CMP_FLOAT
#undef LANETRACE_CMP_CASE

/* LANETRACE_CMP(ps_mask, ps, lrb_v16f, __mmask16) */
#define LANETRACE_CMP(name, suffix, vector, mask)                                                                   \
    static inline mask lanetrace_mm512_cmp_##name(vector a, vector b, int predicate)                                \
    {                                                                                                               \
        return (mask)lanetrace_made(lanetrace_cmp_##suffix(lanetrace_c(), lrb_mask(0xffff), a, b, predicate));      \
    }                                                                                                               \
    static inline mask lanetrace_mm512_mask_cmp_##name(unsigned k1, vector a, vector b, int predicate)              \
    {                                                                                                               \
        return (mask)lanetrace_made(lanetrace_cmp_##suffix(lanetrace_c(), lanetrace_k(k1), a, b, predicate));       \
    }
LANETRACE_CMP(ps_mask, ps, lrb_v16f, __mmask16)
#undef LANETRACE_CMP

/* Reductions, in the order of Intel's compiler (golden case 69): halves, quarters, then pairs and neighbours within a quarter. The
 * result leaves the vector unit through memory. */
static inline lrb_v16i lanetrace_blocks_pi(lrb_ctx *c, lrb_v16i v, unsigned blocks)
{
    return lanetrace_i_of_f(lrb_shuf128x32_ps(c, lanetrace_f_of_i(v), blocks, LRB_DCBA));
}

static inline lrb_v16f lanetrace_blocks_ps(lrb_ctx *c, lrb_v16f v, unsigned blocks) { return lrb_shuf128x32_ps(c, v, blocks, LRB_DCBA); }

static inline uint32_t lanetrace_lane_0_pi(lrb_ctx *c, lrb_v16i v)
{
    lrb_mem m = lrb_at(lrb_segment_at(c->scratch, LRB_SCRATCH_BYTES - 128), 0); /* the line below the constants */
    lrb_mask_store_pi(c, m, lrb_mask(1), v);
    return (uint32_t)lrb_load32(c, m).value;
}

static inline float lanetrace_lane_0_ps(lrb_ctx *c, lrb_v16f v) { return lrb_bits_float(lanetrace_lane_0_pi(c, lanetrace_i_of_f(v))); }

/* LANETRACE_REDUCE(add_ps, add_ps, ps, float, lrb_v16f, set1_ps(0.0f)): reduce_add_ps; mask_reduce_add_ps puts the neutral value
 * where the mask has 0 */
#define LANETRACE_REDUCE(name, op, suffix, type, vector, neutral)                                                   \
    static inline type lanetrace_mm512_reduce_##name(vector v)                                                      \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        vector other = lanetrace_blocks_##suffix(c, v, 0x4e);                                                       \
        v = lrb_##op(c, v, other);                                                                                  \
        other = lanetrace_blocks_##suffix(c, v, 0xb1);                                                              \
        v = lrb_##op(c, v, other);                                                                                  \
        v = lrb_##op##_s3(c, v, lrb_swizzle_##suffix(v, LRB_BADC));                                                 \
        v = lrb_##op##_s3(c, v, lrb_swizzle_##suffix(v, LRB_CDAB));                                                 \
        return (type)lanetrace_lane_0_##suffix(c, v);                                                               \
    }                                                                                                               \
    static inline type lanetrace_mm512_mask_reduce_##name(unsigned k, vector v)                                     \
    {                                                                                                               \
        vector others = lanetrace_mm512_##neutral;                                                                  \
        return lanetrace_mm512_reduce_##name(lrb_mask_mov_##suffix(lanetrace_c(), others, lanetrace_k(k), v));      \
    }
LANETRACE_REDUCE(add_ps, add_ps, ps, float, lrb_v16f, setzero_ps())
LANETRACE_REDUCE(mul_ps, mul_ps, ps, float, lrb_v16f, set1_ps(1.0f))
LANETRACE_REDUCE(min_ps, min_ps, ps, float, lrb_v16f, set1_ps(__builtin_inff()))
LANETRACE_REDUCE(max_ps, max_ps, ps, float, lrb_v16f, set1_ps(-__builtin_inff()))
LANETRACE_REDUCE(add_epi32, add_pi, pi, int, lrb_v16i, setzero_epi32())
LANETRACE_REDUCE(and_epi32, and_pi, pi, int, lrb_v16i, set1_epi32(-1))
LANETRACE_REDUCE(or_epi32, or_pi, pi, int, lrb_v16i, setzero_epi32())
#undef LANETRACE_REDUCE

#endif
