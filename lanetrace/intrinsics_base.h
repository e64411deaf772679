/* What the intrinsics are made of: types, the context of the thread, masks and memory operands. Included by
 * lanetrace/lrbni_intrinsics.h, which says what the rules are. */
#ifndef LANETRACE_INTRINSICS_BASE_H
#define LANETRACE_INTRINSICS_BASE_H

#ifndef LRB_LEVEL
#define LRB_LEVEL 2
#endif
#if LRB_LEVEL > 2
#error "LRB_LEVEL is 0, 1 or 2: a session does not take the accesses to memory alone"
#endif
#ifndef LRB_SOURCE
#define LRB_SOURCE 1
#endif
#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h> /* before the names of its types and functions are taken over */
#else
typedef unsigned char __mmask8;
typedef unsigned short __mmask16;
typedef enum { _MM_MANT_NORM_1_2, _MM_MANT_NORM_p5_2, _MM_MANT_NORM_p5_1, _MM_MANT_NORM_p75_1p5 } _MM_MANTISSA_NORM_ENUM;
typedef enum { _MM_MANT_SIGN_src, _MM_MANT_SIGN_zero, _MM_MANT_SIGN_nan } _MM_MANTISSA_SIGN_ENUM;
enum {
    _MM_FROUND_TO_NEAREST_INT,
    _MM_FROUND_TO_NEG_INF,
    _MM_FROUND_TO_POS_INF,
    _MM_FROUND_TO_ZERO,
    _MM_FROUND_CUR_DIRECTION,
    _MM_FROUND_NO_EXC = 8
};
enum { _MM_CMPINT_EQ, _MM_CMPINT_LT, _MM_CMPINT_LE, _MM_CMPINT_NE = 4, _MM_CMPINT_NLT, _MM_CMPINT_NLE };
enum { _MM_HINT_NTA, _MM_HINT_T2, _MM_HINT_T1, _MM_HINT_T0, _MM_HINT_ET1 = 6, _MM_HINT_ET0 };
#endif

#include "lanetrace/here.h"
#include "lanetrace/session.h"
#include "lrbni/lrbni.h"

/* The context of the calling thread's piece of work. */
LRB_INLINE lrb_ctx *lanetrace_c(void)
{
    assert(lanetrace_here.ctx && "intrinsics run between lanetrace_begin and lanetrace_end");
    return lanetrace_here.ctx;
}

/* A mask operand, with the origin of the newest mask of the same bits (lanetrace/here.h). */
static inline lrb_k16 lanetrace_k(unsigned bits)
{
    lrb_k16 k = lrb_mask(bits);
#if LRB_LEVEL == LRB_RECORD
    const lanetrace_thread *t = &lanetrace_here;
    uint32_t kept = t->masks_made < LANETRACE_MASKS ? t->masks_made : LANETRACE_MASKS;
    for (uint32_t back = 1; back <= kept; back++) {
        uint32_t place = (t->masks_made - back) % LANETRACE_MASKS;
        if (t->mask_bits[place] == k.bits) {
            k.from = t->mask_from[place];
            break;
        }
    }
#endif
    return k;
}

/* A mask result: its bits, and a place in the list of the newest. */
static inline unsigned lanetrace_made(lrb_k16 k)
{
#if LRB_LEVEL == LRB_RECORD
    lanetrace_thread *t = &lanetrace_here;
    t->mask_bits[t->masks_made % LANETRACE_MASKS] = k.bits;
    t->mask_from[t->masks_made % LANETRACE_MASKS] = k.from;
    t->masks_made++;
#endif
    return k.bits;
}

/* A pointer, and what lies there as a memory operand. Its register was ready long ago: pointers are C's own. */
LRB_INLINE lrb_ptr lanetrace_pointer(const void *host)
{
    lrb_ptr p = {.host = (unsigned char *)(uintptr_t)host, .address = lanetrace_address(host)};
    LRB_SET_FROM(p, 0);
    return p;
}

LRB_INLINE lrb_mem lanetrace_at(const void *host) { return lrb_at(lanetrace_pointer(host), 0); }

/* A value in a general register, made by C's own operators. */
LRB_INLINE lrb_r64 lanetrace_r(uint64_t value) { return lrb_imm(value); }

/* The mode of a rounding operand; the current direction is to nearest even. */
LRB_INLINE lrb_rounding lanetrace_rounding(int rounding)
{
    return rounding & _MM_FROUND_CUR_DIRECTION ? LRB_RN : (lrb_rounding)(rounding & 3);
}

/* Constants lie in the last line of the thread's scratch: the pool that a compiler would make. `bytes` at most 64. */
LRB_INLINE lrb_mem lanetrace_constant(lrb_ctx *c, const void *value, size_t bytes)
{
    lrb_ptr p = lrb_segment_at(c->scratch, LRB_SCRATCH_BYTES - 64);
    memcpy(p.host, value, bytes);
    return lrb_at(p, 0);
}

/* Enumerations of the Knights Corner intrinsics that <immintrin.h> has not; the values are our own. */
typedef enum lanetrace_swizzle_enum {
    _MM_SWIZ_REG_NONE,
    _MM_SWIZ_REG_DCBA,
    _MM_SWIZ_REG_CDAB,
    _MM_SWIZ_REG_BADC,
    _MM_SWIZ_REG_AAAA,
    _MM_SWIZ_REG_BBBB,
    _MM_SWIZ_REG_CCCC,
    _MM_SWIZ_REG_DDDD,
    _MM_SWIZ_REG_DACB
} lanetrace_swizzle_enum;
#define _MM_SWIZZLE_ENUM lanetrace_swizzle_enum

typedef enum lanetrace_broadcast32 { _MM_BROADCAST32_NONE, _MM_BROADCAST_1X16, _MM_BROADCAST_4X16 } lanetrace_broadcast32;
typedef enum lanetrace_broadcast64 { _MM_BROADCAST64_NONE, _MM_BROADCAST_1X8, _MM_BROADCAST_4X8 } lanetrace_broadcast64;
#define _MM_BROADCAST32_ENUM lanetrace_broadcast32
#define _MM_BROADCAST64_ENUM lanetrace_broadcast64

typedef enum lanetrace_upconv_ps {
    _MM_UPCONV_PS_NONE,
    _MM_UPCONV_PS_FLOAT16,
    _MM_UPCONV_PS_UINT8,
    _MM_UPCONV_PS_SINT8,
    _MM_UPCONV_PS_UINT16,
    _MM_UPCONV_PS_SINT16
} lanetrace_upconv_ps;
typedef enum lanetrace_upconv_epi32 {
    _MM_UPCONV_EPI32_NONE,
    _MM_UPCONV_EPI32_UINT8,
    _MM_UPCONV_EPI32_SINT8,
    _MM_UPCONV_EPI32_UINT16,
    _MM_UPCONV_EPI32_SINT16
} lanetrace_upconv_epi32;
typedef enum lanetrace_upconv_pd { _MM_UPCONV_PD_NONE } lanetrace_upconv_pd;
typedef enum lanetrace_upconv_epi64 { _MM_UPCONV_EPI64_NONE } lanetrace_upconv_epi64;
#define _MM_UPCONV_PS_ENUM lanetrace_upconv_ps
#define _MM_UPCONV_EPI32_ENUM lanetrace_upconv_epi32
#define _MM_UPCONV_PD_ENUM lanetrace_upconv_pd
#define _MM_UPCONV_EPI64_ENUM lanetrace_upconv_epi64

typedef enum lanetrace_downconv_ps {
    _MM_DOWNCONV_PS_NONE,
    _MM_DOWNCONV_PS_FLOAT16,
    _MM_DOWNCONV_PS_UINT8,
    _MM_DOWNCONV_PS_SINT8,
    _MM_DOWNCONV_PS_UINT16,
    _MM_DOWNCONV_PS_SINT16
} lanetrace_downconv_ps;
typedef enum lanetrace_downconv_epi32 {
    _MM_DOWNCONV_EPI32_NONE,
    _MM_DOWNCONV_EPI32_UINT8,
    _MM_DOWNCONV_EPI32_SINT8,
    _MM_DOWNCONV_EPI32_UINT16,
    _MM_DOWNCONV_EPI32_SINT16
} lanetrace_downconv_epi32;
typedef enum lanetrace_downconv_pd { _MM_DOWNCONV_PD_NONE } lanetrace_downconv_pd;
typedef enum lanetrace_downconv_epi64 { _MM_DOWNCONV_EPI64_NONE } lanetrace_downconv_epi64;
#define _MM_DOWNCONV_PS_ENUM lanetrace_downconv_ps
#define _MM_DOWNCONV_EPI32_ENUM lanetrace_downconv_epi32
#define _MM_DOWNCONV_PD_ENUM lanetrace_downconv_pd
#define _MM_DOWNCONV_EPI64_ENUM lanetrace_downconv_epi64

typedef enum lanetrace_expadj { /* fixed-point bits: the exponent's adjustment */
    _MM_EXPADJ_NONE = 0,
    _MM_EXPADJ_4 = 4,
    _MM_EXPADJ_5 = 5,
    _MM_EXPADJ_8 = 8,
    _MM_EXPADJ_16 = 16,
    _MM_EXPADJ_24 = 24,
    _MM_EXPADJ_31 = 31,
    _MM_EXPADJ_32 = 32
} lanetrace_expadj;
#define _MM_EXPADJ_ENUM lanetrace_expadj

/* Hints that <immintrin.h> has not; non-temporal accesses are accounted for like others. */
enum { _MM_HINT_NONE = 0, _MM_HINT_NT = 1 };

#endif
