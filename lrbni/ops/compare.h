/* Compares: a mask from two vectors; lanes whose bit in the write-mask is 0 give 0. */
#ifndef LRBNI_OPS_COMPARE_H
#define LRBNI_OPS_COMPARE_H

#include "lrbni/ops/operand.h"

/* LRB_COMPARE(cmplt_ps, f, ps): lrb_cmplt_ps, lrb_cmplt_ps_s3, lrb_mask_cmplt_ps, lrb_mask_cmplt_ps_s3 */
#define LRB_COMPARE(id, type, suffix)                                                                     \
    LRB_INLINE lrb_k16 lrb_##id##_s3(lrb_ctx *c, lrb_v16##type a, lrb_s3##type b)                         \
    {                                                                                                     \
        lrb_k16 r = {.bits = lanes_##id(a.lanes, b.lanes)};                                               \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_##id(lrb_ctx *c, lrb_v16##type a, lrb_v16##type b)                             \
    {                                                                                                     \
        return lrb_##id##_s3(c, a, lrb_reg_##suffix(b));                                                  \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_mask_##id##_s3(lrb_ctx *c, lrb_k16 k, lrb_v16##type a, lrb_s3##type b)         \
    {                                                                                                     \
        lrb_k16 r = {.bits = lanes_##id(a.lanes, b.lanes) & k.bits};                                      \
        LRB_SET_FROM(r, lrb_emit_masked(c, LRB_OP_##id, b.form, k, LRB_FROM(a), LRB_FROM(b), 0, b.address)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_k16 lrb_mask_##id(lrb_ctx *c, lrb_k16 k, lrb_v16##type a, lrb_v16##type b)             \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, k, a, lrb_reg_##suffix(b));                                          \
    }
LRB_COMPARE(cmpeq_ps, f, ps)
LRB_COMPARE(cmplt_ps, f, ps)
LRB_COMPARE(cmple_ps, f, ps)
LRB_COMPARE(cmpunord_ps, f, ps)
LRB_COMPARE(cmpneq_ps, f, ps)
LRB_COMPARE(cmpnlt_ps, f, ps)
LRB_COMPARE(cmpnle_ps, f, ps)
LRB_COMPARE(cmpord_ps, f, ps)
LRB_COMPARE(cmpeq_pi, i, pi)
LRB_COMPARE(cmplt_pi, i, pi)
LRB_COMPARE(cmple_pi, i, pi)
#undef LRB_COMPARE

#endif
