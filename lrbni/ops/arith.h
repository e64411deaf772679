/* Arithmetic, logic and moves between vector registers.
 *
 * Each op comes in four forms: lrb_X(c, a, b) on registers, lrb_X_s3(c, a, s) with a swizzled or memory operand, and
 * lrb_mask_X / lrb_mask_X_s3(c, old, k, ...), which keep `old` in the lanes whose bit in k is 0. The lane formulas are
 * in ops.def.
 */
#ifndef LRBNI_OPS_ARITH_H
#define LRBNI_OPS_ARITH_H

#include "lrbni/ops/operand.h"

/* LRB_BINARY(add_ps, f, ps, lanes_add_ps(a.lanes, b.lanes)): lrb_add_ps, lrb_add_ps_s3, lrb_mask_add_ps, lrb_mask_add_ps_s3 */
#define LRB_BINARY(id, type, suffix, result)                                                              \
    LRB_INLINE lrb_v16##type lrb_##id##_s3(lrb_ctx *c, lrb_v16##type a, lrb_s3##type b)                   \
    {                                                                                                     \
        lrb_v16##type d = {.lanes = result};                                                              \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_##id(lrb_ctx *c, lrb_v16##type a, lrb_v16##type b)                       \
    {                                                                                                     \
        return lrb_##id##_s3(c, a, lrb_reg_##suffix(b));                                                  \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_mask_##id##_s3(lrb_ctx *c, lrb_v16##type old, lrb_k16 k, lrb_v16##type a, lrb_s3##type b) \
    {                                                                                                     \
        lrb_v16##type d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};                     \
        LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_mask_##id(lrb_ctx *c, lrb_v16##type old, lrb_k16 k, lrb_v16##type a, lrb_v16##type b) \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, old, k, a, lrb_reg_##suffix(b));                                     \
    }
LRB_BINARY(add_ps, f, ps, lanes_add_ps(a.lanes, b.lanes))
LRB_BINARY(sub_ps, f, ps, lanes_sub_ps(a.lanes, b.lanes))
LRB_BINARY(subr_ps, f, ps, lanes_sub_ps(b.lanes, a.lanes))
LRB_BINARY(mul_ps, f, ps, lanes_mul_ps(a.lanes, b.lanes))
LRB_BINARY(min_ps, f, ps, lanes_min_ps(a.lanes, b.lanes))
LRB_BINARY(max_ps, f, ps, lanes_max_ps(a.lanes, b.lanes))
LRB_BINARY(add_pi, i, pi, lanes_add_pi(a.lanes, b.lanes))
LRB_BINARY(sub_pi, i, pi, lanes_sub_pi(a.lanes, b.lanes))
LRB_BINARY(and_pi, i, pi, lanes_and_pi(a.lanes, b.lanes))
LRB_BINARY(or_pi, i, pi, lanes_or_pi(a.lanes, b.lanes))
LRB_BINARY(xor_pi, i, pi, lanes_xor_pi(a.lanes, b.lanes))

/* One Newton step towards 1/b from the estimate a. */
LRB_INLINE lrb_f32x16 lanes_rcprefine_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    static const float two = 2.0f;
    return lanes_mul_ps(a, lanes_fnmadd_ps(a, b, lanes_load_1to16_ps(&two)));
}
LRB_BINARY(rcprefine_ps, f, ps, lanes_rcprefine_ps(a.lanes, b.lanes))
#undef LRB_BINARY

/* LRB_TERNARY(madd231_ps, lanes_fmadd_ps(a, b, d)): the destination d is a source too; a masked form keeps d */
#define LRB_TERNARY(id, result)                                                                           \
    LRB_INLINE lrb_v16f lrb_##id##_s3(lrb_ctx *c, lrb_v16f d, lrb_v16f a, lrb_s3f b)                      \
    {                                                                                                     \
        lrb_v16f r = {.lanes = result};                                                                   \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, LRB_FROM(d), b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16f lrb_##id(lrb_ctx *c, lrb_v16f d, lrb_v16f a, lrb_v16f b)                          \
    {                                                                                                     \
        return lrb_##id##_s3(c, d, a, lrb_reg_ps(b));                                                     \
    }                                                                                                     \
    LRB_INLINE lrb_v16f lrb_mask_##id##_s3(lrb_ctx *c, lrb_v16f d, lrb_k16 k, lrb_v16f a, lrb_s3f b)      \
    {                                                                                                     \
        lrb_v16f r = {.lanes = lanes_merge_ps(k.bits, d.lanes, result)};                                  \
        LRB_SET_FROM(r, lrb_emit_masked(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(d), b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16f lrb_mask_##id(lrb_ctx *c, lrb_v16f d, lrb_k16 k, lrb_v16f a, lrb_v16f b)          \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, d, k, a, lrb_reg_ps(b));                                             \
    }
LRB_TERNARY(madd132_ps, lanes_fmadd_ps(d.lanes, b.lanes, a.lanes))
LRB_TERNARY(madd213_ps, lanes_fmadd_ps(a.lanes, d.lanes, b.lanes))
LRB_TERNARY(madd231_ps, lanes_fmadd_ps(a.lanes, b.lanes, d.lanes))
LRB_TERNARY(msub231_ps, lanes_fmsub_ps(a.lanes, b.lanes, d.lanes))
LRB_TERNARY(msubr231_ps, lanes_fnmadd_ps(a.lanes, b.lanes, d.lanes))
#undef LRB_TERNARY

/* LRB_UNARY(rcpres_ps, f, ps, lanes_rcpres_ps(b.lanes)) */
#define LRB_UNARY(id, type, suffix, result)                                                               \
    LRB_INLINE lrb_v16##type lrb_##id##_s3(lrb_ctx *c, lrb_s3##type b)                                    \
    {                                                                                                     \
        lrb_v16##type d = {.lanes = result};                                                              \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, 0, LRB_FROM(b), 0, 0, b.address));       \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_##id(lrb_ctx *c, lrb_v16##type b)                                        \
    {                                                                                                     \
        return lrb_##id##_s3(c, lrb_reg_##suffix(b));                                                     \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_mask_##id##_s3(lrb_ctx *c, lrb_v16##type old, lrb_k16 k, lrb_s3##type b) \
    {                                                                                                     \
        lrb_v16##type d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};                     \
        LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_##id, b.form, k, 0, LRB_FROM(b), LRB_FROM(old), b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16##type lrb_mask_##id(lrb_ctx *c, lrb_v16##type old, lrb_k16 k, lrb_v16##type b)     \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, old, k, lrb_reg_##suffix(b));                                        \
    }
LRB_UNARY(rcpres_ps, f, ps, lanes_rcpres_ps(b.lanes))
LRB_UNARY(mov_ps, f, ps, b.lanes)
LRB_UNARY(mov_pi, i, pi, b.lanes)
#undef LRB_UNARY

/** Block B(g) of the source, its words in the order W, becomes block g: two bits a choice, lowest first (0xe4: as is). */
LRB_INLINE lrb_v16f lrb_shuf128x32_ps(lrb_ctx *c, lrb_v16f a, unsigned blocks, unsigned words)
{
    lrb_v16f d = {.lanes = lanes_shuf128x32_ps(a.lanes, blocks, words)};
    LRB_SET_FROM(d, lrb_emit(c, LRB_OP_shuf128x32_ps, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return d;
}

LRB_INLINE lrb_v16f lrb_mask_shuf128x32_ps(lrb_ctx *c, lrb_v16f old, lrb_k16 k, lrb_v16f a, unsigned blocks, unsigned words)
{
    lrb_v16f d = {.lanes = lanes_merge_ps(k.bits, old.lanes, lanes_shuf128x32_ps(a.lanes, blocks, words))};
    LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_shuf128x32_ps, 0, k, LRB_FROM(a), 0, LRB_FROM(old), 0));
    return d;
}

/** The same register seen as integers, or as floats: no op. */
LRB_INLINE lrb_v16i lrb_castps_pi(lrb_v16f a)
{
    lrb_v16i r = {.lanes = lanes_bits_ps(a.lanes)};
    LRB_SET_FROM(r, LRB_FROM(a));
    return r;
}

LRB_INLINE lrb_v16f lrb_castpi_ps(lrb_v16i a)
{
    lrb_v16f r = {.lanes = lanes_bits_pi(a.lanes)};
    LRB_SET_FROM(r, LRB_FROM(a));
    return r;
}

#endif
