/* Integer arithmetic, logic, shifts and bit-fields. The lane formulas are in ops.def, the usual forms of an op in forms.h. */
#ifndef LRBNI_OPS_INTEGER_H
#define LRBNI_OPS_INTEGER_H

#include "lrbni/ops/forms.h"

LRB_BINARY(subr_pi, pi, lanes_sub_pi(b.lanes, a.lanes))
LRB_BINARY(mull_pi, pi, lanes_mull_pi(a.lanes, b.lanes))
LRB_BINARY(mulh_pi, pi, lanes_mulh_pi(a.lanes, b.lanes))
LRB_BINARY(mulh_pu, pi, lanes_mulh_pu(a.lanes, b.lanes))
LRB_BINARY(clampz_pi, pi, lanes_clampz_pi(a.lanes, b.lanes))
LRB_BINARY(min_pi, pi, lanes_min_pi(a.lanes, b.lanes))
LRB_BINARY(max_pi, pi, lanes_max_pi(a.lanes, b.lanes))
LRB_BINARY(min_pu, pi, lanes_min_pu(a.lanes, b.lanes))
LRB_BINARY(max_pu, pi, lanes_max_pu(a.lanes, b.lanes))
LRB_TERNARY(madd231_pi, pi, lanes_madd231_pi(d.lanes, a.lanes, b.lanes))

/* S3 of this op is a register as it is, 64 bytes of memory or {4to16} (ODB). */
LRB_BINARY(madd233_pi, pi, (assert(lrb_is_group_form(b.form)), lanes_madd233_pi(a.lanes, b.lanes)))

LRB_BINARY(andn_pi, pi, lanes_andn_pi(a.lanes, b.lanes))
LRB_BINARY(and_pq, pq, lanes_and_pq(a.lanes, b.lanes))
LRB_BINARY(or_pq, pq, lanes_or_pq(a.lanes, b.lanes))
LRB_BINARY(xor_pq, pq, lanes_xor_pq(a.lanes, b.lanes))
LRB_BINARY(andn_pq, pq, lanes_andn_pq(a.lanes, b.lanes))

LRB_BINARY(sll_pi, pi, lanes_sll_pi(a.lanes, b.lanes))
LRB_BINARY(srl_pi, pi, lanes_srl_pi(a.lanes, b.lanes))
LRB_BINARY(sra_pi, pi, lanes_sra_pi(a.lanes, b.lanes))
LRB_BINARY(sllv_pi, pi, lanes_sllv_pi(a.lanes, b.lanes))
LRB_BINARY(srlv_pi, pi, lanes_srlv_pi(a.lanes, b.lanes))
LRB_BINARY(srav_pi, pi, lanes_srav_pi(a.lanes, b.lanes))
LRB_BINARY(bitinterleave11_pi, pi, lanes_bitinterleave11_pi(a.lanes, b.lanes))
LRB_BINARY(bitinterleave21_pi, pi, lanes_bitinterleave21_pi(a.lanes, b.lanes))

/* LRB_UNARY_IMMEDIATE(slli_pi, pi, LRB_N, LRB_N_VALUES, valid, lanes_slli_pi(b.lanes, n)): the forms of an op with immediates */
#define LRB_UNARY_IMMEDIATE(id, suffix, parameters, values, valid, result)                                \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id##_s3(lrb_ctx *c, LRB_S3_##suffix b parameters)                \
    {                                                                                                     \
        assert(valid);                                                                                    \
        LRB_VECTOR_##suffix d = {.lanes = result};                                                        \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, 0, LRB_FROM(b), 0, 0, b.address));       \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id(lrb_ctx *c, LRB_VECTOR_##suffix b parameters)                 \
    {                                                                                                     \
        return lrb_##id##_s3(c, lrb_reg_##suffix(b) values);                                              \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k,     \
                                                      LRB_S3_##suffix b parameters)                       \
    {                                                                                                     \
        assert(valid);                                                                                    \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};               \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, b.form, k, 0, LRB_FROM(b), LRB_FROM(old), b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k,          \
                                                 LRB_VECTOR_##suffix b parameters)                        \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, old, k, lrb_reg_##suffix(b) values);                                 \
    }
#define LRB_N , unsigned n
#define LRB_N_VALUES , n
#define LRB_FIELD , unsigned n, unsigned low, unsigned high
#define LRB_FIELD_VALUES , n, low, high
#define LRB_FIELD_WITHIN(width) (n < (width) && low <= high && high < (width))
LRB_UNARY_IMMEDIATE(slli_pi, pi, LRB_N, LRB_N_VALUES, n < 256, lanes_slli_pi(b.lanes, n))
LRB_UNARY_IMMEDIATE(srli_pi, pi, LRB_N, LRB_N_VALUES, n < 256, lanes_srli_pi(b.lanes, n))
LRB_UNARY_IMMEDIATE(srai_pi, pi, LRB_N, LRB_N_VALUES, n < 256, lanes_srai_pi(b.lanes, n))
LRB_UNARY_IMMEDIATE(rotatefield_pi, pi, LRB_FIELD, LRB_FIELD_VALUES, LRB_FIELD_WITHIN(32),
                    lanes_rotatefield_pi(b.lanes, n, low, high))

/** Bits low to high of d become those of b rotated left by n: vinsertfield v0, v1, n, low, high (ABR, figures 15 and 16). */
LRB_INLINE lrb_v16i lrb_insertfield_pi_s3(lrb_ctx *c, lrb_v16i d, lrb_s3i b LRB_FIELD)
{
    assert(LRB_FIELD_WITHIN(32));
    lrb_v16i r = {.lanes = lanes_insertfield_pi(d.lanes, b.lanes, n, low, high)};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_insertfield_pi, b.form, 0xffff, 0, LRB_FROM(b), 0, LRB_FROM(d), b.address));
    return r;
}

LRB_INLINE lrb_v16i lrb_insertfield_pi(lrb_ctx *c, lrb_v16i d, lrb_v16i b LRB_FIELD)
{
    return lrb_insertfield_pi_s3(c, d, lrb_reg_pi(b) LRB_FIELD_VALUES);
}

LRB_INLINE lrb_v16i lrb_mask_insertfield_pi_s3(lrb_ctx *c, lrb_v16i d, lrb_k16 k, lrb_s3i b LRB_FIELD)
{
    assert(LRB_FIELD_WITHIN(32));
    lrb_v16i r = {.lanes = lanes_merge_pi(k.bits, d.lanes, lanes_insertfield_pi(d.lanes, b.lanes, n, low, high))};
    LRB_SET_FROM(r, lrb_emit_masked(c, LRB_OP_insertfield_pi, b.form, k, 0, LRB_FROM(b), LRB_FROM(d), b.address));
    return r;
}

LRB_INLINE lrb_v16i lrb_mask_insertfield_pi(lrb_ctx *c, lrb_v16i d, lrb_k16 k, lrb_v16i b LRB_FIELD)
{
    return lrb_mask_insertfield_pi_s3(c, d, k, lrb_reg_pi(b) LRB_FIELD_VALUES);
}

#endif
