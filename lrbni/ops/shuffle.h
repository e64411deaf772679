/* Moves of lanes across the vector. The lane formulas are in ops.def. */
#ifndef LRBNI_OPS_SHUFFLE_H
#define LRBNI_OPS_SHUFFLE_H

#include "lrbni/ops/integer.h"

/* LRB_SHUF128X32(ps): block B(g) of the source, its words in the order W, becomes block g: two bits a choice, lowest first (0xe4: as
 * is). */
#define LRB_SHUF128X32(suffix)                                                                            \
    LRB_INLINE LRB_VECTOR_##suffix lrb_shuf128x32_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix a, unsigned blocks, unsigned words) \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_shuf128x32_##suffix(a.lanes, blocks, words)};             \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_shuf128x32_##suffix, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));     \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_shuf128x32_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, \
                                                                LRB_VECTOR_##suffix a, unsigned blocks, unsigned words) \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, lanes_shuf128x32_##suffix(a.lanes, blocks, words))}; \
        LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_shuf128x32_##suffix, 0, k, LRB_FROM(a), 0, LRB_FROM(old), 0)); \
        return d;                                                                                         \
    }
LRB_SHUF128X32(ps)
LRB_SHUF128X32(pi)
#undef LRB_SHUF128X32

/* S3 of the permutes of Knights Corner is a register as it is, or 64 bytes of memory (ODB). */
LRB_UNARY_IMMEDIATE(pshufd_pi, pi, LRB_N, LRB_N_VALUES, n < 256 && lrb_is_whole_form(b.form), lanes_swizzle_pi(b.lanes, n))
LRB_UNARY_IMMEDIATE(permf32x4_ps, ps, LRB_N, LRB_N_VALUES, n < 256 && lrb_is_whole_form(b.form), lanes_shuf128x32_ps(b.lanes, n, 0xe4))

LRB_BINARY(permd_pi, pi, (assert(lrb_is_whole_form(b.form)), lanes_permd_pi(a.lanes, b.lanes)))

/** Lanes n and up of b, then the first n of a. */
LRB_INLINE lrb_v16i lrb_alignd_pi_s3(lrb_ctx *c, lrb_v16i a, lrb_s3i b, unsigned n)
{
    assert(n < 16 && lrb_is_whole_form(b.form));
    lrb_v16i d = {.lanes = lanes_alignd_pi(a.lanes, b.lanes, n)};
    LRB_SET_FROM(d, lrb_emit(c, LRB_OP_alignd_pi, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address));
    return d;
}

LRB_INLINE lrb_v16i lrb_alignd_pi(lrb_ctx *c, lrb_v16i a, lrb_v16i b, unsigned n)
{
    return lrb_alignd_pi_s3(c, a, lrb_reg_pi(b), n);
}

LRB_INLINE lrb_v16i lrb_mask_alignd_pi_s3(lrb_ctx *c, lrb_v16i old, lrb_k16 k, lrb_v16i a, lrb_s3i b, unsigned n)
{
    assert(n < 16 && lrb_is_whole_form(b.form));
    lrb_v16i d = {.lanes = lanes_merge_pi(k.bits, old.lanes, lanes_alignd_pi(a.lanes, b.lanes, n))};
    LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_alignd_pi, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), b.address));
    return d;
}

LRB_INLINE lrb_v16i lrb_mask_alignd_pi(lrb_ctx *c, lrb_v16i old, lrb_k16 k, lrb_v16i a, lrb_v16i b, unsigned n)
{
    return lrb_mask_alignd_pi_s3(c, old, k, a, lrb_reg_pi(b), n);
}

#endif
