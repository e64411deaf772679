/* Operands: addresses, memory operands and the last source S3. None of these is an op; they become part of one. */
#ifndef LRBNI_OPS_OPERAND_H
#define LRBNI_OPS_OPERAND_H

#include <assert.h>

#include "lrbni/ops/emit.h"

/** Address of byte `offset` of a segment, in a register since before the stream began. */
LRB_INLINE lrb_ptr lrb_segment_at(lrb_segment segment, uint32_t offset)
{
    lrb_ptr p = {.host = segment.host + offset, .address = segment.address + offset};
    LRB_SET_FROM(p, 0);
    return p;
}

/** A value in a general register since before the stream began, or an immediate. */
LRB_INLINE lrb_r64 lrb_imm(uint64_t value)
{
    lrb_r64 r = {.value = value};
    LRB_SET_FROM(r, 0);
    return r;
}

/** A mask in a mask register since before the stream began; k0 as a write-mask is lrb_mask(0xffff). */
LRB_INLINE lrb_k16 lrb_mask(uint32_t bits)
{
    lrb_k16 k = {.bits = bits & 0xffffu};
    LRB_SET_FROM(k, 0);
    return k;
}

/** Memory operand [base + displacement]. */
LRB_INLINE lrb_mem lrb_at(lrb_ptr base, int32_t displacement)
{
    lrb_mem m = {.host = base.host + displacement, .address = base.address + (uint32_t)displacement};
#if LRB_LEVEL == LRB_RECORD
    m.base_from = base.from;
    m.index_from = 0;
#endif
    return m;
}

/** Memory operand [base + index * scale + displacement], scale 1, 2, 4 or 8; for loads and stores, not for S3. */
LRB_INLINE lrb_mem lrb_at_index(lrb_ptr base, lrb_r64 index, unsigned scale, int32_t displacement)
{
    uint64_t offset = index.value * scale + (uint64_t)(int64_t)displacement;
    lrb_mem m = {.host = base.host + (ptrdiff_t)offset, .address = base.address + (uint32_t)offset};
    assert(scale == 1 || scale == 2 || scale == 4 || scale == 8);
#if LRB_LEVEL == LRB_RECORD
    m.base_from = base.from;
    m.index_from = index.from;
#endif
    return m;
}

#if LRB_LEVEL == LRB_RECORD
#define LRB_BASE_FROM(m) ((m).base_from)
#define LRB_INDEX_FROM(m) ((m).index_from)
#else
#define LRB_BASE_FROM(m) ((void)(m), 0u)
#define LRB_INDEX_FROM(m) ((void)(m), 0u)
#endif

/* A misaligned vector access faults on the machine (ISAM 2.1.1): the emulation stops at it. */
#define LRB_ASSERT_ALIGNED(m, bytes) assert((m).address % (bytes) == 0 && "misaligned vector access")

/** Whether an op that shares a value among each group of four lanes takes that form of S3 (ODB). */
LRB_INLINE bool lrb_is_group_form(unsigned form)
{
    return form == LRB_FORM_REGISTER || form == LRB_FORM_MEMORY || form == (LRB_FORM_MEMORY | LRB_FORM_16_BYTES);
}

/** Whether S3 of that form is a register as it is, or 64 bytes of memory: what permutes take. */
LRB_INLINE bool lrb_is_whole_form(unsigned form) { return form == LRB_FORM_REGISTER || form == LRB_FORM_MEMORY; }

/* Swizzles of a register source: the word that lane 0, 1, 2, 3 of each group of four takes, two bits each. Named as
   the ISA writes them, lane 3 first. */
typedef enum lrb_swizzle {
    LRB_DCBA = 0xe4, /* identity */
    LRB_CDAB = 0xb1, /* neighbours swapped */
    LRB_BADC = 0x4e, /* pairs swapped */
    LRB_AAAA = 0x00,
    LRB_BBBB = 0x55,
    LRB_CCCC = 0xaa,
    LRB_DDDD = 0xff,
    LRB_DACB = 0xc9 /* the rotation that cross products need: 1 2 0 3 */
} lrb_swizzle;

/* LRB_S3_REGISTER(f, lrb_v16f, ps): lrb_reg_ps, lrb_swizzle_ps */
#define LRB_S3_REGISTER(type, vector, suffix)                                                      \
    /** S3 from a register as it is. */                                                            \
    LRB_INLINE lrb_s3##type lrb_reg_##suffix(vector v)                                             \
    {                                                                                              \
        lrb_s3##type s = {.lanes = v.lanes, .form = LRB_FORM_REGISTER};                            \
        LRB_SET_FROM(s, LRB_FROM(v));                                                              \
        return s;                                                                                  \
    }                                                                                              \
    /** S3 from a register, its lanes swizzled within each group of four. */                       \
    LRB_INLINE lrb_s3##type lrb_swizzle_##suffix(vector v, lrb_swizzle words)                      \
    {                                                                                              \
        lrb_s3##type s = {.lanes = lanes_swizzle_##suffix(v.lanes, words), .form = LRB_FORM_SWIZZLE}; \
        LRB_SET_FROM(s, LRB_FROM(v));                                                              \
        return s;                                                                                  \
    }
LRB_S3_REGISTER(f, lrb_v16f, ps)
LRB_S3_REGISTER(i, lrb_v16i, pi)
LRB_S3_REGISTER(d, lrb_v8d, pd)
LRB_S3_REGISTER(q, lrb_v8q, pq)
#undef LRB_S3_REGISTER

/* LRB_S3_MEMORY(f, ps, 1to16, 4, 4to16, 16): lrb_full_ps (64 bytes), lrb_1to16_ps (4 bytes to all lanes), lrb_4to16_ps (16
 * bytes, four lanes over and over) */
#define LRB_S3_MEMORY(type, suffix, one, one_bytes, four, four_bytes)                              \
    LRB_INLINE lrb_s3##type lrb_s3_memory_##suffix(lrb_mem m, lrb_s3##type s, unsigned form)       \
    {                                                                                              \
        s.address = m.address;                                                                     \
        s.form = (uint16_t)(LRB_FORM_MEMORY | form);                                               \
        assert(LRB_INDEX_FROM(m) == 0 && "S3 takes no index register");                            \
        LRB_SET_FROM(s, LRB_BASE_FROM(m));                                                         \
        return s;                                                                                  \
    }                                                                                              \
    /** S3 from 64 bytes of memory. */                                                             \
    LRB_INLINE lrb_s3##type lrb_full_##suffix(lrb_mem m)                                           \
    {                                                                                              \
        LRB_ASSERT_ALIGNED(m, 64);                                                                 \
        return lrb_s3_memory_##suffix(m, (lrb_s3##type){.lanes = lanes_load_##suffix(m.host)}, 0); \
    }                                                                                              \
    /** S3 from one element of memory, broadcast to all lanes. */                                  \
    LRB_INLINE lrb_s3##type lrb_##one##_##suffix(lrb_mem m)                                        \
    {                                                                                              \
        LRB_ASSERT_ALIGNED(m, one_bytes);                                                          \
        return lrb_s3_memory_##suffix(m, (lrb_s3##type){.lanes = lanes_load_##one##_##suffix(m.host)}, LRB_FORM_##one_bytes##_BYTES); \
    }                                                                                              \
    /** S3 from four elements of memory, repeated. */                                              \
    LRB_INLINE lrb_s3##type lrb_##four##_##suffix(lrb_mem m)                                       \
    {                                                                                              \
        LRB_ASSERT_ALIGNED(m, four_bytes);                                                         \
        return lrb_s3_memory_##suffix(m, (lrb_s3##type){.lanes = lanes_load_##four##_##suffix(m.host)}, LRB_FORM_##four_bytes##_BYTES); \
    }
LRB_S3_MEMORY(f, ps, 1to16, 4, 4to16, 16)
LRB_S3_MEMORY(i, pi, 1to16, 4, 4to16, 16)
LRB_S3_MEMORY(d, pd, 1to8, 8, 4to8, 32)
LRB_S3_MEMORY(q, pq, 1to8, 8, 4to8, 32)
#undef LRB_S3_MEMORY

#endif
