/* The forms that a vector op comes in, made from its lane formula.
 *
 * lrb_X(c, a, b) on registers, lrb_X_s3(c, a, s) with a swizzled or memory operand, and lrb_mask_X / lrb_mask_X_s3(c, old, k,
 * ...), which keep `old` in the lanes whose bit in k is 0. A suffix, ps, pi, pd or pq, says what the lanes are.
 */
#ifndef LRBNI_OPS_FORMS_H
#define LRBNI_OPS_FORMS_H

#include "lrbni/ops/operand.h"

/* What goes with a suffix. */
#define LRB_VECTOR_ps lrb_v16f
#define LRB_VECTOR_pi lrb_v16i
#define LRB_VECTOR_pd lrb_v8d
#define LRB_VECTOR_pq lrb_v8q
#define LRB_S3_ps lrb_s3f
#define LRB_S3_pi lrb_s3i
#define LRB_S3_pd lrb_s3d
#define LRB_S3_pq lrb_s3q
#define LRB_EMIT_MASKED_ps lrb_emit_masked
#define LRB_EMIT_MASKED_pi lrb_emit_masked
#define LRB_EMIT_MASKED_pd lrb_emit_masked8
#define LRB_EMIT_MASKED_pq lrb_emit_masked8

/* LRB_UNARY(mov_ps, ps, b.lanes) */
#define LRB_UNARY(id, suffix, result)                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id##_s3(lrb_ctx *c, LRB_S3_##suffix b)                           \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = result};                                                        \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, 0, LRB_FROM(b), 0, 0, b.address));       \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id(lrb_ctx *c, LRB_VECTOR_##suffix b)                            \
    {                                                                                                     \
        return lrb_##id##_s3(c, lrb_reg_##suffix(b));                                                     \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, LRB_S3_##suffix b) \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};               \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, b.form, k, 0, LRB_FROM(b), LRB_FROM(old), b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, LRB_VECTOR_##suffix b) \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, old, k, lrb_reg_##suffix(b));                                        \
    }

/* LRB_BINARY(add_ps, ps, lanes_add_ps(a.lanes, b.lanes)); LRB_BINARY_OF where the lanes of the last source are others */
#define LRB_BINARY(id, suffix, result) LRB_BINARY_OF(id, suffix, suffix, result)
#define LRB_BINARY_OF(id, suffix, last, result)                                                                 \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix a, LRB_S3_##last b)    \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = result};                                                        \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id(lrb_ctx *c, LRB_VECTOR_##suffix a, LRB_VECTOR_##last b)     \
    {                                                                                                     \
        return lrb_##id##_s3(c, a, lrb_reg_##last(b));                                                  \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k,     \
                                                      LRB_VECTOR_##suffix a, LRB_S3_##last b)           \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};               \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), \
                                                 b.address));                                             \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, LRB_VECTOR_##suffix a, \
                                                 LRB_VECTOR_##last b)                                   \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, old, k, a, lrb_reg_##last(b));                                     \
    }

/* LRB_TERNARY(madd231_ps, ps, lanes_fmadd_ps(a, b, d)): the destination d is a source too; a masked form keeps d;
 * LRB_TERNARY_OF where the lanes of the last source are others */
#define LRB_TERNARY(id, suffix, result) LRB_TERNARY_OF(id, suffix, suffix, result)
#define LRB_TERNARY_OF(id, suffix, last, result)                                                                \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix d, LRB_VECTOR_##suffix a, LRB_S3_##last b) \
    {                                                                                                     \
        LRB_VECTOR_##suffix r = {.lanes = result};                                                        \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, LRB_FROM(d), b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id(lrb_ctx *c, LRB_VECTOR_##suffix d, LRB_VECTOR_##suffix a, LRB_VECTOR_##last b) \
    {                                                                                                     \
        return lrb_##id##_s3(c, d, a, lrb_reg_##last(b));                                               \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix d, lrb_k16 k, LRB_VECTOR_##suffix a, \
                                                      LRB_S3_##last b)                                  \
    {                                                                                                     \
        LRB_VECTOR_##suffix r = {.lanes = lanes_merge_##suffix(k.bits, d.lanes, result)};                 \
        LRB_SET_FROM(r, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(d), \
                                                 b.address));                                             \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##suffix d, lrb_k16 k, LRB_VECTOR_##suffix a, \
                                                 LRB_VECTOR_##last b)                                   \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, d, k, a, lrb_reg_##last(b));                                       \
    }

/* LRB_COMPARE(cmplt_pi, pi): a mask from lanes_cmplt_pi; bits that k leaves out are 0 */
#define LRB_COMPARE(id, suffix) LRB_MASK_RESULT(id, suffix, lanes_##id(a.lanes, b.lanes))
/* LRB_MASK_RESULT(cmplt_pi, pi, lanes_cmplt_pi(a.lanes, b.lanes)): the same from any formula */
#define LRB_MASK_RESULT(id, suffix, result)                                                                         \
    LRB_INLINE lrb_k16 lrb_##id##_s3(lrb_ctx *c, LRB_VECTOR_##suffix a, LRB_S3_##suffix b)                \
    {                                                                                                     \
        lrb_k16 r = {.bits = result};                                                                     \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_##id(lrb_ctx *c, LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b)                 \
    {                                                                                                     \
        return lrb_##id##_s3(c, a, lrb_reg_##suffix(b));                                                  \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_mask_##id##_s3(lrb_ctx *c, lrb_k16 k, LRB_VECTOR_##suffix a, LRB_S3_##suffix b) \
    {                                                                                                     \
        lrb_k16 r = {.bits = (result) & k.bits};                                                          \
        LRB_SET_FROM(r, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), 0, b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_mask_##id(lrb_ctx *c, lrb_k16 k, LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b) \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, k, a, lrb_reg_##suffix(b));                                          \
    }

#endif
