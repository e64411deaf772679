/* Intrinsics that are more or less than one op: constants, casts, swizzles, compares by predicate, sums with carries, masks,
 * general registers. Included by lanetrace/lrbni_intrinsics.h. */
#ifndef LANETRACE_INTRINSICS_LANES_H
#define LANETRACE_INTRINSICS_LANES_H

#include "lanetrace/intrinsics_base.h"

/* A constant is a load from the constant pool; zero is a register's exclusive or with itself, which reads nothing. */

/* LANETRACE_SET1(ps, float, lrb_v16f, lrb_load_1to16_ps) */
#define LANETRACE_SET1(name, type, vector, result)                                                                  \
    static inline vector lanetrace_mm512_set1_##name(type a)                                                        \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_mem m = lanetrace_constant(c, &a, sizeof a);                                                            \
        return result;                                                                                              \
    }
LANETRACE_SET1(ps, float, lrb_v16f, lrb_load_1to16_ps(c, m))
LANETRACE_SET1(epi32, int, lrb_v16i, lrb_load_1to16_pi(c, m))
LANETRACE_SET1(pd, double, lrb_v8d, lrb_load_1to8_pd(c, m))
LANETRACE_SET1(epi64, int64_t, lrb_v16i, lrb_castpq_pi(lrb_load_1to8_pq(c, m)))
#undef LANETRACE_SET1

/* LANETRACE_SET4(ps, float, lrb_v16f, ...): four elements over and over, the last operand in lane 0 */
#define LANETRACE_SET4(name, type, vector, result)                                                                  \
    static inline vector lanetrace_mm512_set4_##name(type d, type third, type second, type first)                   \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        const type values[4] = {first, second, third, d};                                                           \
        lrb_mem m = lanetrace_constant(c, values, sizeof values);                                                   \
        return result;                                                                                              \
    }
LANETRACE_SET4(ps, float, lrb_v16f, lrb_load_4to16_ps(c, m))
LANETRACE_SET4(epi32, int, lrb_v16i, lrb_load_4to16_pi(c, m))
LANETRACE_SET4(pd, double, lrb_v8d, lrb_load_4to8_pd(c, m))
LANETRACE_SET4(epi64, int64_t, lrb_v16i, lrb_castpq_pi(lrb_load_4to8_pq(c, m)))
#undef LANETRACE_SET4

/* LANETRACE_SET16(ps, float, lrb_v16f, ...): setr_ps, lane 0 first, and set_ps, lane 15 first */
#define LANETRACE_SET16(name, type, vector, result)                                                                 \
    static inline vector lanetrace_mm512_setr_##name(type e0, type e1, type e2, type e3, type e4, type e5, type e6, \
                                                     type e7, type e8, type e9, type e10, type e11, type e12,       \
                                                     type e13, type e14, type e15)                                  \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        const type values[16] = {e0, e1, e2, e3, e4, e5, e6, e7, e8, e9, e10, e11, e12, e13, e14, e15};              \
        lrb_mem m = lanetrace_constant(c, values, sizeof values);                                                   \
        return result;                                                                                              \
    }                                                                                                               \
    static inline vector lanetrace_mm512_set_##name(type e15, type e14, type e13, type e12, type e11, type e10,     \
                                                    type e9, type e8, type e7, type e6, type e5, type e4, type e3,  \
                                                    type e2, type e1, type e0)                                      \
    {                                                                                                               \
        return lanetrace_mm512_setr_##name(e0, e1, e2, e3, e4, e5, e6, e7, e8, e9, e10, e11, e12, e13, e14, e15);   \
    }
LANETRACE_SET16(ps, float, lrb_v16f, lrb_load_ps(c, m))
LANETRACE_SET16(epi32, int, lrb_v16i, lrb_load_pi(c, m))
#undef LANETRACE_SET16

#define LANETRACE_SET8(name, type, vector, result)                                                                  \
    static inline vector lanetrace_mm512_setr_##name(type e0, type e1, type e2, type e3, type e4, type e5, type e6, type e7) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        const type values[8] = {e0, e1, e2, e3, e4, e5, e6, e7};                                                    \
        lrb_mem m = lanetrace_constant(c, values, sizeof values);                                                   \
        return result;                                                                                              \
    }                                                                                                               \
    static inline vector lanetrace_mm512_set_##name(type e7, type e6, type e5, type e4, type e3, type e2, type e1, type e0) \
    {                                                                                                               \
        return lanetrace_mm512_setr_##name(e0, e1, e2, e3, e4, e5, e6, e7);                                         \
    }
LANETRACE_SET8(pd, double, lrb_v8d, lrb_load_pd(c, m))
LANETRACE_SET8(epi64, int64_t, lrb_v16i, lrb_castpq_pi(lrb_load_pq(c, m)))
#undef LANETRACE_SET8

/* A register of which nothing is known; here 0. No op. */
static inline lrb_v16i lanetrace_mm512_undefined_epi32(void)
{
    static const int32_t zeros[16];
    lrb_v16i v = {.lanes = lanes_load_pi(zeros)};
    LRB_SET_FROM(v, 0);
    return v;
}

static inline lrb_v16f lanetrace_mm512_undefined_ps(void) { return lrb_castpi_ps(lanetrace_mm512_undefined_epi32()); }
static inline lrb_v16f lanetrace_mm512_undefined(void) { return lanetrace_mm512_undefined_ps(); }
static inline lrb_v8d lanetrace_mm512_undefined_pd(void) { return lrb_castpq_pd(lrb_castpi_pq(lanetrace_mm512_undefined_epi32())); }

static inline lrb_v16i lanetrace_mm512_setzero_epi32(void)
{
    lrb_v16i any = lanetrace_mm512_undefined_epi32();
    return lrb_xor_pi(lanetrace_c(), any, any);
}

static inline lrb_v16i lanetrace_mm512_setzero_si512(void) { return lanetrace_mm512_setzero_epi32(); }
static inline lrb_v16f lanetrace_mm512_setzero_ps(void) { return lrb_castpi_ps(lanetrace_mm512_setzero_epi32()); }
static inline lrb_v16f lanetrace_mm512_setzero(void) { return lanetrace_mm512_setzero_ps(); }
static inline lrb_v8d lanetrace_mm512_setzero_pd(void) { return lrb_castpq_pd(lrb_castpi_pq(lanetrace_mm512_setzero_epi32())); }

/* Casts: no op. */
static inline lrb_v16i lanetrace_mm512_castps_si512(lrb_v16f a) { return lrb_castps_pi(a); }
static inline lrb_v8d lanetrace_mm512_castps_pd(lrb_v16f a) { return lrb_castpq_pd(lrb_castps_pq(a)); }
static inline lrb_v16f lanetrace_mm512_castpd_ps(lrb_v8d a) { return lrb_castpq_ps(lrb_castpd_pq(a)); }
static inline lrb_v16i lanetrace_mm512_castpd_si512(lrb_v8d a) { return lrb_castpq_pi(lrb_castpd_pq(a)); }
static inline lrb_v16f lanetrace_mm512_castsi512_ps(lrb_v16i a) { return lrb_castpi_ps(a); }
static inline lrb_v8d lanetrace_mm512_castsi512_pd(lrb_v16i a) { return lrb_castpq_pd(lrb_castpi_pq(a)); }

/* Absolute values: an and with a constant from memory. */
static inline lrb_s3i lanetrace_magnitude_pi(lrb_ctx *c)
{
    static const uint32_t bits = 0x7fffffff;
    return lrb_1to16_pi(lanetrace_constant(c, &bits, sizeof bits));
}

static inline lrb_s3q lanetrace_magnitude_pq(lrb_ctx *c)
{
    static const uint64_t bits = UINT64_C(0x7fffffffffffffff);
    return lrb_1to8_pq(lanetrace_constant(c, &bits, sizeof bits));
}

static inline lrb_v16f lanetrace_mm512_abs_ps(lrb_v16f a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_castpi_ps(lrb_and_pi_s3(c, lrb_castps_pi(a), lanetrace_magnitude_pi(c)));
}

static inline lrb_v16f lanetrace_mm512_mask_abs_ps(lrb_v16f src, unsigned k, lrb_v16f a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_castpi_ps(lrb_mask_and_pi_s3(c, lrb_castps_pi(src), lanetrace_k(k), lrb_castps_pi(a), lanetrace_magnitude_pi(c)));
}

static inline lrb_v8d lanetrace_mm512_abs_pd(lrb_v8d a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_castpq_pd(lrb_and_pq_s3(c, lrb_castpd_pq(a), lanetrace_magnitude_pq(c)));
}

static inline lrb_v8d lanetrace_mm512_mask_abs_pd(lrb_v8d src, unsigned k, lrb_v8d a)
{
    lrb_ctx *c = lanetrace_c();
    return lrb_castpq_pd(lrb_mask_and_pq_s3(c, lrb_castpd_pq(src), lanetrace_k(k), lrb_castpd_pq(a), lanetrace_magnitude_pq(c)));
}

/* The words of a swizzle. */
static inline lrb_swizzle lanetrace_swizzle(lanetrace_swizzle_enum s)
{
    static const unsigned char words[] = {LRB_DCBA, LRB_DCBA, LRB_CDAB, LRB_BADC, LRB_AAAA, LRB_BBBB, LRB_CCCC, LRB_DDDD, LRB_DACB};
    assert((unsigned)s < sizeof words && "not a _MM_SWIZZLE_ENUM");
    return (lrb_swizzle)words[s];
}

/* LANETRACE_SWIZZLE(ps, ps, lrb_v16f, , ): swizzle_ps, mask_swizzle_ps: a move of its own, which a compiler may fold into the op
 * that reads it. */
#define LANETRACE_SWIZZLE(suffix, op_suffix, vector, to_op, back)                                                   \
    static inline vector lanetrace_mm512_swizzle_##suffix(vector v, lanetrace_swizzle_enum s)                       \
    {                                                                                                               \
        return back(lrb_mov_##op_suffix##_s3(lanetrace_c(), lrb_swizzle_##op_suffix(to_op(v), lanetrace_swizzle(s)))); \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_swizzle_##suffix(vector src, unsigned k, vector v, lanetrace_swizzle_enum s) \
    {                                                                                                               \
        return back(lrb_mask_mov_##op_suffix##_s3(lanetrace_c(), to_op(src), lanetrace_k(k),                        \
                                                  lrb_swizzle_##op_suffix(to_op(v), lanetrace_swizzle(s))));        \
    }
LANETRACE_SWIZZLE(ps, ps, lrb_v16f, , )
LANETRACE_SWIZZLE(epi32, pi, lrb_v16i, , )
LANETRACE_SWIZZLE(pd, pd, lrb_v8d, , )
LANETRACE_SWIZZLE(epi64, pq, lrb_v16i, lrb_castpi_pq, lrb_castpq_pi)
#undef LANETRACE_SWIZZLE

static inline lrb_v16i lanetrace_mm512_permute4f128_epi32(lrb_v16i a, int n)
{
    return lrb_castps_pi(lrb_permf32x4_ps(lanetrace_c(), lrb_castpi_ps(a), (unsigned)n & 0xff));
}

static inline lrb_v16i lanetrace_mm512_mask_permute4f128_epi32(lrb_v16i src, unsigned k, lrb_v16i a, int n)
{
    return lrb_castps_pi(lrb_mask_permf32x4_ps(lanetrace_c(), lrb_castpi_ps(src), lanetrace_k(k), lrb_castpi_ps(a), (unsigned)n & 0xff));
}

/* The only integer multiply-add has its destination as the addend; under a mask that keeps a factor a move follows. */
static inline lrb_v16i lanetrace_mm512_fmadd_epi32(lrb_v16i a, lrb_v16i b, lrb_v16i addend)
{
    return lrb_madd231_pi(lanetrace_c(), addend, a, b);
}

static inline lrb_v16i lanetrace_mm512_mask_fmadd_epi32(lrb_v16i a, unsigned k, lrb_v16i b, lrb_v16i addend)
{
    lrb_k16 mask = lanetrace_k(k);
    lrb_v16i sum = lrb_mask_madd231_pi(lanetrace_c(), addend, mask, a, b);
    return lrb_mask_mov_pi(lanetrace_c(), a, mask, sum);
}

static inline lrb_v16i lanetrace_mm512_mask3_fmadd_epi32(lrb_v16i a, lrb_v16i b, lrb_v16i addend, unsigned k)
{
    return lrb_mask_madd231_pi(lanetrace_c(), addend, lanetrace_k(k), a, b);
}

/* LANETRACE_CARRY_IN(adc): adc_epi32(v2, k2, v3, &carries) and mask_adc_epi32(v2, k1, k2, v3, &carries) */
#define LANETRACE_CARRY_IN(stem)                                                                                    \
    static inline lrb_v16i lanetrace_mm512_##stem##_epi32(lrb_v16i a, unsigned in, lrb_v16i b, __mmask16 *carries)  \
    {                                                                                                               \
        lrb_k16 out;                                                                                                \
        lrb_v16i r = lrb_##stem##_pi(lanetrace_c(), a, lanetrace_k(in), b, &out);                                   \
        *carries = (__mmask16)lanetrace_made(out);                                                                  \
        return r;                                                                                                   \
    }                                                                                                               \
    static inline lrb_v16i lanetrace_mm512_mask_##stem##_epi32(lrb_v16i a, unsigned k, unsigned in, lrb_v16i b, __mmask16 *carries) \
    {                                                                                                               \
        lrb_k16 out, mask = lanetrace_k(k);                                                                         \
        lrb_v16i r = lrb_mask_##stem##_pi(lanetrace_c(), a, mask, lanetrace_k(in), b, &out);                        \
        *carries = (__mmask16)lanetrace_made(out);                                                                  \
        return r;                                                                                                   \
    }
LANETRACE_CARRY_IN(adc)
LANETRACE_CARRY_IN(sbb)
LANETRACE_CARRY_IN(sbbr)
#undef LANETRACE_CARRY_IN

/* LANETRACE_CARRY_OUT(addsetc): addsetc_epi32(v2, v3, &carries) and mask_addsetc_epi32(v2, k, k_old, v3, &carries) */
#define LANETRACE_CARRY_OUT(stem)                                                                                   \
    static inline lrb_v16i lanetrace_mm512_##stem##_epi32(lrb_v16i a, lrb_v16i b, __mmask16 *carries)               \
    {                                                                                                               \
        lrb_k16 out;                                                                                                \
        lrb_v16i r = lrb_##stem##_pi(lanetrace_c(), a, b, &out);                                                    \
        *carries = (__mmask16)lanetrace_made(out);                                                                  \
        return r;                                                                                                   \
    }                                                                                                               \
    static inline lrb_v16i lanetrace_mm512_mask_##stem##_epi32(lrb_v16i a, unsigned k, unsigned old, lrb_v16i b, __mmask16 *carries) \
    {                                                                                                               \
        lrb_k16 out, mask = lanetrace_k(k);                                                                         \
        lrb_v16i r = lrb_mask_##stem##_pi(lanetrace_c(), a, mask, lanetrace_k(old), b, &out);                       \
        *carries = (__mmask16)lanetrace_made(out);                                                                  \
        return r;                                                                                                   \
    }
LANETRACE_CARRY_OUT(addsetc)
LANETRACE_CARRY_OUT(subsetb)
LANETRACE_CARRY_OUT(subrsetb)
#undef LANETRACE_CARRY_OUT

/* LANETRACE_SIGNS(ps, ps, lrb_v16f): addsets_ps(v2, v3, &signs), mask_addsets_ps(src, k, v2, v3, &signs) */
#define LANETRACE_SIGNS(name, suffix, vector)                                                                       \
    static inline vector lanetrace_mm512_addsets_##name(vector a, vector b, __mmask16 *signs)                       \
    {                                                                                                               \
        lrb_k16 out;                                                                                                \
        vector r = lrb_addsets_##suffix(lanetrace_c(), a, b, &out);                                                 \
        *signs = (__mmask16)lanetrace_made(out);                                                                    \
        return r;                                                                                                   \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_addsets_##name(vector src, unsigned k, vector a, vector b, __mmask16 *signs) \
    {                                                                                                               \
        lrb_k16 out;                                                                                                \
        vector r = lrb_mask_addsets_##suffix(lanetrace_c(), src, lanetrace_k(k), a, b, &out);                       \
        *signs = (__mmask16)lanetrace_made(out);                                                                    \
        return r;                                                                                                   \
    }
LANETRACE_SIGNS(ps, ps, lrb_v16f)
LANETRACE_SIGNS(epi32, pi, lrb_v16i)
#undef LANETRACE_SIGNS

/* Compares by predicate: those that the ISA has, and for floats > and >= by swapping. An unmasked compare leaves the event of one
 * under a mask of ones that no op made. */
#define LANETRACE_CMP_CASE(number, name, first, second)          \
    case number:                                                 \
    case number | 16: /* quiet or signalling: no flag is kept */ \
        return lrb_mask_##name(c, k, first, second);
#define LANETRACE_CMP_FLOAT(suffix)                              \
    LANETRACE_CMP_CASE(0, cmpeq_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(1, cmplt_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(2, cmple_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(3, cmpunord_##suffix, a, b)               \
    LANETRACE_CMP_CASE(4, cmpneq_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(5, cmpnlt_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(6, cmpnle_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(7, cmpord_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(9, cmpnle_##suffix, b, a)                 \
    LANETRACE_CMP_CASE(10, cmpnlt_##suffix, b, a)                \
    LANETRACE_CMP_CASE(13, cmple_##suffix, b, a)                 \
    LANETRACE_CMP_CASE(14, cmplt_##suffix, b, a)
#define LANETRACE_CMP_INTEGER(suffix)                            \
    LANETRACE_CMP_CASE(0, cmpeq_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(1, cmplt_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(2, cmple_##suffix, a, b)                  \
    LANETRACE_CMP_CASE(4, cmpneq_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(5, cmpnlt_##suffix, a, b)                 \
    LANETRACE_CMP_CASE(6, cmpnle_##suffix, a, b)
#define LANETRACE_CMP(name, cases, suffix, vector, mask)                                                            \
    static inline lrb_k16 lanetrace_cmp_##suffix(lrb_ctx *c, lrb_k16 k, vector a, vector b, int predicate)          \
    {                                                                                                               \
        switch (predicate) {                                                                                        \
            cases(suffix)                                                                                           \
        }                                                                                                           \
        assert(0 && "a predicate that the ISA has not");                                                            \
        return lrb_mask(0);                                                                                         \
    }                                                                                                               \
    static inline mask lanetrace_mm512_cmp_##name(vector a, vector b, int predicate)                                \
    {                                                                                                               \
        return (mask)lanetrace_made(lanetrace_cmp_##suffix(lanetrace_c(), lrb_mask(0xffff), a, b, predicate));      \
    }                                                                                                               \
    static inline mask lanetrace_mm512_mask_cmp_##name(unsigned k1, vector a, vector b, int predicate)              \
    {                                                                                                               \
        return (mask)lanetrace_made(lanetrace_cmp_##suffix(lanetrace_c(), lanetrace_k(k1), a, b, predicate));       \
    }
LANETRACE_CMP(ps_mask, LANETRACE_CMP_FLOAT, ps, lrb_v16f, __mmask16)
LANETRACE_CMP(pd_mask, LANETRACE_CMP_FLOAT, pd, lrb_v8d, __mmask8)
LANETRACE_CMP(epi32_mask, LANETRACE_CMP_INTEGER, pi, lrb_v16i, __mmask16)
LANETRACE_CMP(epu32_mask, LANETRACE_CMP_INTEGER, pu, lrb_v16i, __mmask16)
#undef LANETRACE_CMP
#undef LANETRACE_CMP_FLOAT
#undef LANETRACE_CMP_INTEGER
#undef LANETRACE_CMP_CASE

/* LANETRACE_CMP_ROUND(ps, lrb_v16f, __mmask16): the same with an operand that suppresses exceptions, of which there are none */
#define LANETRACE_CMP_ROUND(suffix, vector, mask)                                                                   \
    static inline mask lanetrace_mm512_cmp_round_##suffix##_mask(vector a, vector b, int predicate, int sae)        \
    {                                                                                                               \
        (void)sae;                                                                                                  \
        return lanetrace_mm512_cmp_##suffix##_mask(a, b, predicate);                                                \
    }                                                                                                               \
    static inline mask lanetrace_mm512_mask_cmp_round_##suffix##_mask(unsigned k1, vector a, vector b, int predicate, int sae) \
    {                                                                                                               \
        (void)sae;                                                                                                  \
        return lanetrace_mm512_mask_cmp_##suffix##_mask(k1, a, b, predicate);                                       \
    }
LANETRACE_CMP_ROUND(ps, lrb_v16f, __mmask16)
LANETRACE_CMP_ROUND(pd, lrb_v8d, __mmask8)
#undef LANETRACE_CMP_ROUND

/* Masks and C's integers. The flags of kortest become a value by branching on them. */
static inline __mmask16 lanetrace_mm512_int2mask(int a) { return (__mmask16)lanetrace_made(lrb_kmov_kr(lanetrace_c(), lrb_imm((unsigned)a))); }
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

static inline int64_t lanetrace_mm512_kconcathi_64(unsigned k1, unsigned k2)
{
    lrb_k16 a = lanetrace_k(k1), b = lanetrace_k(k2);
    return (int64_t)lrb_kconcath(lanetrace_c(), a, b).value;
}

static inline int64_t lanetrace_mm512_kconcatlo_64(unsigned k1, unsigned k2)
{
    lrb_k16 a = lanetrace_k(k1), b = lanetrace_k(k2);
    return (int64_t)lrb_kconcatl(lanetrace_c(), a, b).value;
}

static inline __mmask16 lanetrace_mm512_kextract_64(int64_t a, int n)
{
    return (__mmask16)lanetrace_made(lrb_kextract(lanetrace_c(), lrb_imm((uint64_t)a), (unsigned)n));
}

/* General registers. */
static inline unsigned lanetrace_mm_countbits_32(uint32_t a) { return (unsigned)lrb_popcnt(lanetrace_c(), lrb_imm(a)).value; }
static inline uint64_t lanetrace_mm_countbits_64(uint64_t a) { return lrb_popcnt(lanetrace_c(), lrb_imm(a)).value; }
static inline void lanetrace_mm_delay_32(uint32_t a) { lrb_delay(lanetrace_c(), lrb_imm(a)); }
static inline void lanetrace_mm_delay_64(uint64_t a) { lrb_delay(lanetrace_c(), lrb_imm(a)); }
static inline void lanetrace_mm_spflt_32(uint32_t a) { lrb_spflt(lanetrace_c(), lrb_imm(a)); }
static inline void lanetrace_mm_spflt_64(uint64_t a) { lrb_spflt(lanetrace_c(), lrb_imm(a)); }

/* Zeros from bit a up. The op counts in 64 bits: a 1 above the 32 ends the count there. */
static inline int lanetrace_mm_tzcnti_32(int a, uint32_t x)
{
    uint64_t zeros = lrb_tzcnti(lanetrace_c(), lrb_imm((uint64_t)(int64_t)a), lrb_imm((UINT64_C(1) << 32) | x)).value;
    return zeros < 32 ? (int)zeros : 32;
}

static inline int64_t lanetrace_mm_tzcnti_64(int64_t a, uint64_t x)
{
    return (int64_t)lrb_tzcnti(lanetrace_c(), lrb_imm((uint64_t)a), lrb_imm(x)).value;
}

#endif
