/* Intrinsics that read and write memory. Included by lanetrace/lrbni_intrinsics.h. */
#ifndef LANETRACE_INTRINSICS_MEMORY_H
#define LANETRACE_INTRINSICS_MEMORY_H

#include "lanetrace/intrinsics_base.h"

/* The conversions of the enumerations. */
static inline lrb_up_ps lanetrace_up_ps(lanetrace_upconv_ps conv)
{
    static const unsigned char up[] = {LRB_UP_PS_none, LRB_UP_PS_float16, LRB_UP_PS_uint8, LRB_UP_PS_sint8, LRB_UP_PS_uint16, LRB_UP_PS_sint16};
    assert((unsigned)conv < sizeof up && "not a _MM_UPCONV_PS_ENUM");
    return (lrb_up_ps)up[conv];
}

static inline lrb_up_pi lanetrace_up_pi(lanetrace_upconv_epi32 conv)
{
    static const unsigned char up[] = {LRB_UP_PI_none, LRB_UP_PI_uint8, LRB_UP_PI_sint8, LRB_UP_PI_uint16, LRB_UP_PI_sint16};
    assert((unsigned)conv < sizeof up && "not a _MM_UPCONV_EPI32_ENUM");
    return (lrb_up_pi)up[conv];
}

static inline lrb_down_ps lanetrace_down_ps(lanetrace_downconv_ps conv)
{
    static const unsigned char down[] = {LRB_DOWN_PS_none,  LRB_DOWN_PS_float16, LRB_DOWN_PS_uint8,
                                         LRB_DOWN_PS_sint8, LRB_DOWN_PS_uint16,  LRB_DOWN_PS_sint16};
    assert((unsigned)conv < sizeof down && "not a _MM_DOWNCONV_PS_ENUM");
    return (lrb_down_ps)down[conv];
}

static inline lrb_down_pi lanetrace_down_pi(lanetrace_downconv_epi32 conv)
{
    static const unsigned char down[] = {LRB_DOWN_PI_none, LRB_DOWN_PI_uint8, LRB_DOWN_PI_sint8, LRB_DOWN_PI_uint16, LRB_DOWN_PI_sint16};
    assert((unsigned)conv < sizeof down && "not a _MM_DOWNCONV_EPI32_ENUM");
    return (lrb_down_pi)down[conv];
}

static inline lrb_up_pd lanetrace_up_pd(lanetrace_upconv_pd conv) { return (void)conv, LRB_UP_PD_none; }
static inline lrb_up_pq lanetrace_up_pq(lanetrace_upconv_epi64 conv) { return (void)conv, LRB_UP_PQ_none; }
static inline lrb_down_pd lanetrace_down_pd(lanetrace_downconv_pd conv) { return (void)conv, LRB_DOWN_PD_none; }
static inline lrb_down_pq lanetrace_down_pq(lanetrace_downconv_epi64 conv) { return (void)conv, LRB_DOWN_PQ_none; }

/* What follows is made for ps, epi32, pd and epi64: the name's suffix, the op's, the intrinsic's vector, and the casts from it to the
 * op's and back. */
#define LANETRACE_EACH(form)                                          \
    form(ps, ps, lrb_v16f, , )                                        \
    form(epi32, pi, lrb_v16i, , )                                     \
    form(pd, pd, lrb_v8d, , )                                         \
    form(epi64, pq, lrb_v16i, lrb_castpi_pq, lrb_castpq_pi)

/* load_ps, store_ps and their masked forms; 64-byte aligned, as on the machine */
#define LANETRACE_LOAD_STORE(name, suffix, vector, to_op, back)                                                     \
    static inline vector lanetrace_mm512_load_##name(const void *m)                                                 \
    {                                                                                                               \
        return back(lrb_load_##suffix(lanetrace_c(), lanetrace_at(m)));                                             \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_load_##name(vector src, unsigned k, const void *m)                    \
    {                                                                                                               \
        return back(lrb_mask_load_##suffix(lanetrace_c(), to_op(src), lanetrace_k(k), lanetrace_at(m)));            \
    }                                                                                                               \
    static inline void lanetrace_mm512_store_##name(void *m, vector v)                                              \
    {                                                                                                               \
        lrb_store_##suffix(lanetrace_c(), lanetrace_at(m), to_op(v));                                               \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_store_##name(void *m, unsigned k, vector v)                             \
    {                                                                                                               \
        lrb_mask_store_##suffix(lanetrace_c(), lanetrace_at(m), lanetrace_k(k), to_op(v));                          \
    }
LANETRACE_EACH(LANETRACE_LOAD_STORE)
#undef LANETRACE_LOAD_STORE

static inline lrb_v16i lanetrace_mm512_load_si512(const void *m) { return lanetrace_mm512_load_epi32(m); }
static inline void lanetrace_mm512_store_si512(void *m, lrb_v16i v) { lanetrace_mm512_store_epi32(m, v); }
static inline void lanetrace_mm512_storenr_ps(void *m, lrb_v16f v) { lrb_storenr_ps(lanetrace_c(), lanetrace_at(m), v); }
static inline void lanetrace_mm512_storenr_pd(void *m, lrb_v8d v) { lrb_storenr_pd(lanetrace_c(), lanetrace_at(m), v); }
static inline void lanetrace_mm512_storenrngo_ps(void *m, lrb_v16f v) { lrb_storenrngo_ps(lanetrace_c(), lanetrace_at(m), v); }
static inline void lanetrace_mm512_storenrngo_pd(void *m, lrb_v8d v) { lrb_storenrngo_pd(lanetrace_c(), lanetrace_at(m), v); }

/* extload_ps: with conversion and broadcast. Of the non-temporal loads only whole, plain ones are ops of their own. */
#define LANETRACE_EXTLOAD_32(name, suffix, vector, conversion)                                                      \
    static inline vector lanetrace_mm512_extload_##name(const void *m, conversion conv, lanetrace_broadcast32 bc, int hint) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_mem at = lanetrace_at(m);                                                                               \
        if (bc == _MM_BROADCAST_1X16)                                                                               \
            return conv ? lrb_load_up_1to16_##suffix(c, at, lanetrace_up_##suffix(conv)) : lrb_load_1to16_##suffix(c, at); \
        if (bc == _MM_BROADCAST_4X16)                                                                               \
            return conv ? lrb_load_up_4to16_##suffix(c, at, lanetrace_up_##suffix(conv)) : lrb_load_4to16_##suffix(c, at); \
        if (conv)                                                                                                   \
            return lrb_load_up_##suffix(c, at, lanetrace_up_##suffix(conv));                                        \
        return hint == _MM_HINT_NT ? lrb_load_nt_##suffix(c, at) : lrb_load_##suffix(c, at);                        \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_extload_##name(vector src, unsigned k1, const void *m, conversion conv, \
                                                             lanetrace_broadcast32 bc, int hint)                    \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_k16 k = lanetrace_k(k1);                                                                                \
        lrb_mem at = lanetrace_at(m);                                                                               \
        if (bc == _MM_BROADCAST_1X16)                                                                               \
            return conv ? lrb_mask_load_up_1to16_##suffix(c, src, k, at, lanetrace_up_##suffix(conv))               \
                        : lrb_mask_load_1to16_##suffix(c, src, k, at);                                              \
        if (bc == _MM_BROADCAST_4X16)                                                                               \
            return conv ? lrb_mask_load_up_4to16_##suffix(c, src, k, at, lanetrace_up_##suffix(conv))               \
                        : lrb_mask_load_4to16_##suffix(c, src, k, at);                                              \
        if (conv)                                                                                                   \
            return lrb_mask_load_up_##suffix(c, src, k, at, lanetrace_up_##suffix(conv));                           \
        return hint == _MM_HINT_NT ? lrb_mask_load_nt_##suffix(c, src, k, at) : lrb_mask_load_##suffix(c, src, k, at); \
    }
LANETRACE_EXTLOAD_32(ps, ps, lrb_v16f, lanetrace_upconv_ps)
LANETRACE_EXTLOAD_32(epi32, pi, lrb_v16i, lanetrace_upconv_epi32)
#undef LANETRACE_EXTLOAD_32

#define LANETRACE_EXTLOAD_64(name, suffix, vector, to_op, back, conversion)                                         \
    static inline vector lanetrace_mm512_extload_##name(const void *m, conversion conv, lanetrace_broadcast64 bc, int hint) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_mem at = lanetrace_at(m);                                                                               \
        (void)conv;                                                                                                 \
        return back(bc == _MM_BROADCAST_1X8   ? lrb_load_1to8_##suffix(c, at)                                       \
                    : bc == _MM_BROADCAST_4X8 ? lrb_load_4to8_##suffix(c, at)                                       \
                    : hint == _MM_HINT_NT     ? lrb_load_nt_##suffix(c, at)                                         \
                                              : lrb_load_##suffix(c, at));                                          \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_extload_##name(vector src, unsigned k1, const void *m, conversion conv, \
                                                             lanetrace_broadcast64 bc, int hint)                    \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_k16 k = lanetrace_k(k1);                                                                                \
        lrb_mem at = lanetrace_at(m);                                                                               \
        (void)conv;                                                                                                 \
        return back(bc == _MM_BROADCAST_1X8   ? lrb_mask_load_1to8_##suffix(c, to_op(src), k, at)                   \
                    : bc == _MM_BROADCAST_4X8 ? lrb_mask_load_4to8_##suffix(c, to_op(src), k, at)                   \
                    : hint == _MM_HINT_NT     ? lrb_mask_load_nt_##suffix(c, to_op(src), k, at)                     \
                                              : lrb_mask_load_##suffix(c, to_op(src), k, at));                      \
    }
LANETRACE_EXTLOAD_64(pd, pd, lrb_v8d, , , lanetrace_upconv_pd)
LANETRACE_EXTLOAD_64(epi64, pq, lrb_v16i, lrb_castpi_pq, lrb_castpq_pi, lanetrace_upconv_epi64)
#undef LANETRACE_EXTLOAD_64

/* extstore_ps; LANETRACE_DOWN_ps(...) is the store that converts, which doubles and 64-bit integers have not */
#define LANETRACE_DOWN_ps(c, at, v, conv) lrb_store_down_ps(c, at, v, lanetrace_down_ps(conv))
#define LANETRACE_DOWN_pi(c, at, v, conv) lrb_store_down_pi(c, at, v, lanetrace_down_pi(conv))
#define LANETRACE_DOWN_pd(c, at, v, conv) ((void)(conv))
#define LANETRACE_DOWN_pq(c, at, v, conv) ((void)(conv))
#define LANETRACE_MASK_DOWN_ps(c, at, k, v, conv) lrb_mask_store_down_ps(c, at, k, v, lanetrace_down_ps(conv))
#define LANETRACE_MASK_DOWN_pi(c, at, k, v, conv) lrb_mask_store_down_pi(c, at, k, v, lanetrace_down_pi(conv))
#define LANETRACE_MASK_DOWN_pd(c, at, k, v, conv) ((void)(conv))
#define LANETRACE_MASK_DOWN_pq(c, at, k, v, conv) ((void)(conv))
#define LANETRACE_EXTSTORE(name, suffix, vector, to_op, back)                                                       \
    static inline void lanetrace_mm512_extstore_##name(void *m, vector v, lanetrace_downconv_##name conv, int hint) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_mem at = lanetrace_at(m);                                                                               \
        if (conv)                                                                                                   \
            LANETRACE_DOWN_##suffix(c, at, v, conv);                                                                \
        else if (hint == _MM_HINT_NT)                                                                               \
            lrb_store_nt_##suffix(c, at, to_op(v));                                                                 \
        else                                                                                                        \
            lrb_store_##suffix(c, at, to_op(v));                                                                    \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_extstore_##name(void *m, unsigned k1, vector v, lanetrace_downconv_##name conv, int hint) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        lrb_k16 k = lanetrace_k(k1);                                                                                \
        lrb_mem at = lanetrace_at(m);                                                                               \
        if (conv)                                                                                                   \
            LANETRACE_MASK_DOWN_##suffix(c, at, k, v, conv);                                                        \
        else if (hint == _MM_HINT_NT)                                                                               \
            lrb_mask_store_nt_##suffix(c, at, k, to_op(v));                                                         \
        else                                                                                                        \
            lrb_mask_store_##suffix(c, at, k, to_op(v));                                                            \
    }
LANETRACE_EACH(LANETRACE_EXTSTORE)
#undef LANETRACE_EXTSTORE

/* Streams: lo the part in the line of the address, hi the part in the next, whose address is given 64 bytes up. The op that counts is the
 * one that converts where there is a conversion. */
#define LANETRACE_STREAM_OP_ps(stem, conv, way) ((conv) ? LRB_OP_##stem##_##way##_ps : LRB_OP_##stem##_ps)
#define LANETRACE_STREAM_OP_pi(stem, conv, way) ((conv) ? LRB_OP_##stem##_##way##_pi : LRB_OP_##stem##_pi)
#define LANETRACE_STREAM_OP_pd(stem, conv, way) LRB_OP_##stem##_pd
#define LANETRACE_STREAM_OP_pq(stem, conv, way) LRB_OP_##stem##_pq
#define LANETRACE_STREAM(part, letter, PART, name, suffix, vector, to_op, back)                                     \
    static inline vector lanetrace_mm512_mask_extloadunpack##part##_##name(vector src, unsigned k, const void *m,   \
                                                                           lanetrace_upconv_##name conv, int hint)  \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        return back(lrb_unpack_##suffix(lanetrace_c(), LANETRACE_STREAM_OP_##suffix(loadunpack##letter, conv, up), LRB_STREAM_##PART, \
                                        to_op(src), lanetrace_k(k), lanetrace_at(m), lanetrace_up_##suffix(conv))); \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_loadunpack##part##_##name(vector src, unsigned k, const void *m)      \
    {                                                                                                               \
        return back(lrb_loadunpack##letter##_##suffix(lanetrace_c(), to_op(src), lanetrace_k(k), lanetrace_at(m))); \
    }                                                                                                               \
    static inline vector lanetrace_mm512_extloadunpack##part##_##name(vector src, const void *m, lanetrace_upconv_##name conv, int hint) \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        return back(lrb_unpack_##suffix(lanetrace_c(), LANETRACE_STREAM_OP_##suffix(loadunpack##letter, conv, up), LRB_STREAM_##PART, \
                                        to_op(src), lrb_mask(LRB_LANES_##suffix), lanetrace_at(m), lanetrace_up_##suffix(conv))); \
    }                                                                                                               \
    static inline vector lanetrace_mm512_loadunpack##part##_##name(vector src, const void *m)                       \
    {                                                                                                               \
        return back(lrb_loadunpack##letter##_##suffix(lanetrace_c(), to_op(src), lrb_mask(LRB_LANES_##suffix), lanetrace_at(m))); \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_extpackstore##part##_##name(void *m, unsigned k, vector v, lanetrace_downconv_##name conv, int hint) \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        lrb_pack_##suffix(lanetrace_c(), LANETRACE_STREAM_OP_##suffix(packstore##letter, conv, down), LRB_STREAM_##PART, lanetrace_at(m), \
                          lanetrace_k(k), to_op(v), lanetrace_down_##suffix(conv));                                 \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_packstore##part##_##name(void *m, unsigned k, vector v)                 \
    {                                                                                                               \
        lrb_packstore##letter##_##suffix(lanetrace_c(), lanetrace_at(m), lanetrace_k(k), to_op(v));                 \
    }                                                                                                               \
    static inline void lanetrace_mm512_extpackstore##part##_##name(void *m, vector v, lanetrace_downconv_##name conv, int hint) \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        lrb_pack_##suffix(lanetrace_c(), LANETRACE_STREAM_OP_##suffix(packstore##letter, conv, down), LRB_STREAM_##PART, lanetrace_at(m), \
                          lrb_mask(LRB_LANES_##suffix), to_op(v), lanetrace_down_##suffix(conv));                   \
    }                                                                                                               \
    static inline void lanetrace_mm512_packstore##part##_##name(void *m, vector v)                                  \
    {                                                                                                               \
        lrb_packstore##letter##_##suffix(lanetrace_c(), lanetrace_at(m), lrb_mask(LRB_LANES_##suffix), to_op(v));   \
    }
#define LANETRACE_STREAM_LO(...) LANETRACE_STREAM(lo, l, LOW, __VA_ARGS__)
#define LANETRACE_STREAM_HI(...) LANETRACE_STREAM(hi, h, HIGH, __VA_ARGS__)
LANETRACE_EACH(LANETRACE_STREAM_LO)
LANETRACE_EACH(LANETRACE_STREAM_HI)
#undef LANETRACE_STREAM_LO
#undef LANETRACE_STREAM_HI
#undef LANETRACE_STREAM

/* The base of a gather's next execution: as it is for data, and for the caches such that the lowest lane of k has its address. The lanes
 * that this execution completes lie in the same line, so theirs follow. */
static inline lrb_mem lanetrace_gather_base(const void *base, lrb_v16i index, unsigned scale, uint32_t k)
{
    int32_t lanes[16];
    lanes_store_pi(lanes, index.lanes);
    int64_t offset = k ? (int64_t)lanes[__builtin_ctz(k)] * scale : 0;
    lrb_mem m = lrb_at(lanetrace_pointer((const unsigned char *)base + offset), 0);
    m.host -= offset;
    m.address -= (uint32_t)offset;
    return m;
}

/* The jump back of the loops. */
LRB_INLINE bool lanetrace_again(lrb_ctx *c, lrb_k16 k) { return lrb_jnz(c, lrb_kortest(c, k, k)); }

/* i32gather_ps and so on; of eight lanes (i32logather_pd) the low eight indices are taken */
#define LANETRACE_GATHER(prefix, name, suffix, vector, to_op, back)                                                 \
    static inline vector lanetrace_gather_##name(vector src, lrb_k16 k, lrb_v16i index, const void *base, lanetrace_upconv_##name conv, int scale) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        LRB_VECTOR_##suffix d = to_op(src);                                                                         \
        k.bits &= LRB_LANES_##suffix;                                                                               \
        do                                                                                                          \
            d = lrb_gatherd_up_##suffix(c, d, &k, lanetrace_gather_base(base, index, (unsigned)scale, k.bits), index, (unsigned)scale, \
                                        lanetrace_up_##suffix(conv));                                               \
        while (lanetrace_again(c, k));                                                                              \
        return back(d);                                                                                             \
    }                                                                                                               \
    static inline vector lanetrace_nothing_##name(void) { return back((LRB_VECTOR_##suffix){.lanes = lanes_load_##suffix(lanetrace_zeros)}); } \
    static inline vector lanetrace_mm512_##prefix##gather_##name(lrb_v16i index, const void *base, int scale)       \
    {                                                                                                               \
        return lanetrace_gather_##name(lanetrace_nothing_##name(), lrb_mask(0xffff), index, base, (lanetrace_upconv_##name)0, scale); \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_##prefix##gather_##name(vector src, unsigned k, lrb_v16i index, const void *base, int scale) \
    {                                                                                                               \
        return lanetrace_gather_##name(src, lanetrace_k(k), index, base, (lanetrace_upconv_##name)0, scale);        \
    }                                                                                                               \
    static inline vector lanetrace_mm512_##prefix##extgather_##name(lrb_v16i index, const void *base, lanetrace_upconv_##name conv, \
                                                                    int scale, int hint)                            \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        return lanetrace_gather_##name(lanetrace_nothing_##name(), lrb_mask(0xffff), index, base, conv, scale);     \
    }                                                                                                               \
    static inline vector lanetrace_mm512_mask_##prefix##extgather_##name(vector src, unsigned k, lrb_v16i index, const void *base, \
                                                                         lanetrace_upconv_##name conv, int scale, int hint) \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        return lanetrace_gather_##name(src, lanetrace_k(k), index, base, conv, scale);                              \
    }
static const int32_t lanetrace_zeros[16];
LANETRACE_GATHER(i32, ps, ps, lrb_v16f, , )
LANETRACE_GATHER(i32, epi32, pi, lrb_v16i, , )
LANETRACE_GATHER(i32lo, pd, pd, lrb_v8d, , )
LANETRACE_GATHER(i32lo, epi64, pq, lrb_v16i, lrb_castpi_pq, lrb_castpq_pi)
#undef LANETRACE_GATHER

#define LANETRACE_SCATTER(prefix, name, suffix, vector, to_op)                                                      \
    static inline void lanetrace_scatter_##name(void *base, lrb_k16 k, lrb_v16i index, vector v, lanetrace_downconv_##name conv, int scale) \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        k.bits &= LRB_LANES_##suffix;                                                                               \
        do                                                                                                          \
            lrb_scatterd_down_##suffix(c, lanetrace_gather_base(base, index, (unsigned)scale, k.bits), &k, index, (unsigned)scale, \
                                       to_op(v), lanetrace_down_##suffix(conv));                                    \
        while (lanetrace_again(c, k));                                                                              \
    }                                                                                                               \
    static inline void lanetrace_mm512_##prefix##scatter_##name(void *base, lrb_v16i index, vector v, int scale)    \
    {                                                                                                               \
        lanetrace_scatter_##name(base, lrb_mask(0xffff), index, v, (lanetrace_downconv_##name)0, scale);            \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_##prefix##scatter_##name(void *base, unsigned k, lrb_v16i index, vector v, int scale) \
    {                                                                                                               \
        lanetrace_scatter_##name(base, lanetrace_k(k), index, v, (lanetrace_downconv_##name)0, scale);              \
    }                                                                                                               \
    static inline void lanetrace_mm512_##prefix##extscatter_##name(void *base, lrb_v16i index, vector v, lanetrace_downconv_##name conv, \
                                                                   int scale, int hint)                             \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        lanetrace_scatter_##name(base, lrb_mask(0xffff), index, v, conv, scale);                                    \
    }                                                                                                               \
    static inline void lanetrace_mm512_mask_##prefix##extscatter_##name(void *base, unsigned k, lrb_v16i index, vector v, \
                                                                        lanetrace_downconv_##name conv, int scale, int hint) \
    {                                                                                                               \
        (void)hint;                                                                                                 \
        lanetrace_scatter_##name(base, lanetrace_k(k), index, v, conv, scale);                                      \
    }
LANETRACE_SCATTER(i32, ps, ps, lrb_v16f, )
LANETRACE_SCATTER(i32, epi32, pi, lrb_v16i, )
LANETRACE_SCATTER(i32lo, pd, pd, lrb_v8d, )
LANETRACE_SCATTER(i32lo, epi64, pq, lrb_v16i, lrb_castpi_pq)
#undef LANETRACE_SCATTER

/* LANETRACE_GATHER_PREFETCH(gather): the lines that a gather will touch, to the first level, or with _MM_HINT_T1 to the second */
#define LANETRACE_GATHER_PREFETCH(stem)                                                                             \
    static inline void lanetrace_prefetch_##stem(lrb_v16i index, lrb_k16 k, const void *base, int scale, int hint)  \
    {                                                                                                               \
        lrb_ctx *c = lanetrace_c();                                                                                 \
        do {                                                                                                        \
            lrb_mem m = lanetrace_gather_base(base, index, (unsigned)scale, k.bits);                                \
            if (hint == _MM_HINT_T1)                                                                                \
                lrb_##stem##pf2d(c, &k, m, index, (unsigned)scale);                                                 \
            else                                                                                                    \
                lrb_##stem##pfd(c, &k, m, index, (unsigned)scale);                                                  \
        } while (lanetrace_again(c, k));                                                                            \
    }
LANETRACE_GATHER_PREFETCH(gather)
LANETRACE_GATHER_PREFETCH(scatter)
#undef LANETRACE_GATHER_PREFETCH

static inline void lanetrace_mm512_prefetch_i32gather_ps(lrb_v16i index, const void *base, int scale, int hint)
{
    lanetrace_prefetch_gather(index, lrb_mask(0xffff), base, scale, hint);
}

static inline void lanetrace_mm512_mask_prefetch_i32gather_ps(lrb_v16i index, unsigned k, const void *base, int scale, int hint)
{
    lanetrace_prefetch_gather(index, lanetrace_k(k), base, scale, hint);
}

static inline void lanetrace_mm512_prefetch_i32extgather_ps(lrb_v16i index, const void *base, lanetrace_upconv_ps conv, int scale, int hint)
{
    (void)conv;
    lanetrace_prefetch_gather(index, lrb_mask(0xffff), base, scale, hint);
}

static inline void lanetrace_mm512_mask_prefetch_i32extgather_ps(lrb_v16i index, unsigned k, const void *base, lanetrace_upconv_ps conv,
                                                                 int scale, int hint)
{
    (void)conv;
    lanetrace_prefetch_gather(index, lanetrace_k(k), base, scale, hint);
}

static inline void lanetrace_mm512_prefetch_i32scatter_ps(const void *base, lrb_v16i index, int scale, int hint)
{
    lanetrace_prefetch_scatter(index, lrb_mask(0xffff), base, scale, hint);
}

static inline void lanetrace_mm512_mask_prefetch_i32scatter_ps(const void *base, unsigned k, lrb_v16i index, int scale, int hint)
{
    lanetrace_prefetch_scatter(index, lanetrace_k(k), base, scale, hint);
}

static inline void lanetrace_mm512_prefetch_i32extscatter_ps(const void *base, lrb_v16i index, lanetrace_upconv_ps conv, int scale, int hint)
{
    (void)conv;
    lanetrace_prefetch_scatter(index, lrb_mask(0xffff), base, scale, hint);
}

static inline void lanetrace_mm512_mask_prefetch_i32extscatter_ps(const void *base, unsigned k, lrb_v16i index, lanetrace_upconv_ps conv,
                                                                  int scale, int hint)
{
    (void)conv;
    lanetrace_prefetch_scatter(index, lanetrace_k(k), base, scale, hint);
}

/* Hints about one cache line. */
static inline void lanetrace_mm_prefetch(const void *m, int hint)
{
    lrb_ctx *c = lanetrace_c();
    lrb_mem at = lanetrace_at(m);
    switch (hint) {
    case _MM_HINT_T1:
    case _MM_HINT_T2:
        lrb_prefetch2(c, at);
        break;
    case _MM_HINT_ET0:
        lrb_prefetch1_ex(c, at);
        break;
    case _MM_HINT_ET1:
        lrb_prefetch2_ex(c, at);
        break;
    case _MM_HINT_NTA:
        lrb_prefetch1_nt(c, at);
        break;
    default:
        lrb_prefetch1(c, at);
    }
}

static inline void lanetrace_mm_clevict(const void *m, int level)
{
    if (level == _MM_HINT_T1)
        lrb_evict2(lanetrace_c(), lanetrace_at(m));
    else
        lrb_evict1(lanetrace_c(), lanetrace_at(m));
}

#undef LANETRACE_EACH

#endif
