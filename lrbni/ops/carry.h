/* Integer sums that leave a mask beside the lanes: carries, borrows, signs. Both results are of one event.
 *
 * lrb_adc_pi(c, d, in, b, &out) is v = v + b + k with k = the carries; lrb_mask_adc_pi(c, d, k, in, b, &out) keeps d's lane and
 * in's bit where the bit of the write-mask k is 0. Forms with _s3 take b from S3. `out` may be where `in` came from.
 */
#ifndef LRBNI_OPS_CARRY_H
#define LRBNI_OPS_CARRY_H

#include "lrbni/ops/forms.h"

/* What a masked op leaves of a mask: bits of `old` where the bit of k is 0. */
LRB_INLINE uint32_t lrb_merge_bits(uint32_t k, uint32_t old, uint32_t bits) { return (bits & k) | (old & ~k); }

/* The forms of an op that adds carries in, and of one that only tells them; `result` gives the lanes and sets `bits`. Under a mask both
 * read `in`, whose bits they may have to keep. */
#define LRB_CARRY_UNMASKED(id, parameter, value, from, result)                                             \
    LRB_INLINE lrb_v16i lrb_##id##_s3(lrb_ctx *c, lrb_v16i d parameter, lrb_s3i b, lrb_k16 *out)          \
    {                                                                                                     \
        uint32_t bits;                                                                                    \
        lrb_v16i r = {.lanes = result};                                                                   \
        uint32_t event = lrb_emit(c, LRB_OP_##id, b.form, 0xffff, from, LRB_FROM(b), 0, LRB_FROM(d), b.address); \
        *out = (lrb_k16){.bits = bits};                                                                   \
        LRB_SET_FROM(*out, event);                                                                        \
        LRB_SET_FROM(r, event);                                                                           \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16i lrb_##id(lrb_ctx *c, lrb_v16i d parameter, lrb_v16i b, lrb_k16 *out)              \
    {                                                                                                     \
        return lrb_##id##_s3(c, d value, lrb_reg_pi(b), out);                                             \
    }
#define LRB_CARRY_MASKED(id, result)                                                                       \
    LRB_INLINE lrb_v16i lrb_mask_##id##_s3(lrb_ctx *c, lrb_v16i d, lrb_k16 k, lrb_k16 in, lrb_s3i b, lrb_k16 *out) \
    {                                                                                                     \
        uint32_t bits;                                                                                    \
        lrb_v16i r = {.lanes = lanes_merge_pi(k.bits, d.lanes, result)};                                  \
        uint32_t event = lrb_emit_masked(c, LRB_OP_##id, b.form, k, LRB_FROM(in), LRB_FROM(b), LRB_FROM(d), b.address); \
        *out = (lrb_k16){.bits = lrb_merge_bits(k.bits, in.bits, bits)};                                  \
        LRB_SET_FROM(*out, event);                                                                        \
        LRB_SET_FROM(r, event);                                                                           \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE lrb_v16i lrb_mask_##id(lrb_ctx *c, lrb_v16i d, lrb_k16 k, lrb_k16 in, lrb_v16i b, lrb_k16 *out) \
    {                                                                                                     \
        return lrb_mask_##id##_s3(c, d, k, in, lrb_reg_pi(b), out);                                       \
    }
#define LRB_CARRY_IN(id, result)                                                   \
    LRB_CARRY_UNMASKED(id, LRB_IN, LRB_IN_VALUE, LRB_FROM(in), result)             \
    LRB_CARRY_MASKED(id, result)
#define LRB_CARRY_OUT(id, result)                                                  \
    LRB_CARRY_UNMASKED(id, , , 0, result)                                          \
    LRB_CARRY_MASKED(id, result)
#define LRB_IN , lrb_k16 in
#define LRB_IN_VALUE , in
LRB_CARRY_IN(adc_pi, lanes_adc_pi(d.lanes, b.lanes, in.bits, &bits))
LRB_CARRY_IN(sbb_pi, lanes_sbb_pi(d.lanes, b.lanes, in.bits, &bits))
LRB_CARRY_IN(sbbr_pi, lanes_sbb_pi(b.lanes, d.lanes, in.bits, &bits))
LRB_CARRY_OUT(addsetc_pi, lanes_adc_pi(d.lanes, b.lanes, 0, &bits))
LRB_CARRY_OUT(subsetb_pi, lanes_sbb_pi(d.lanes, b.lanes, 0, &bits))
LRB_CARRY_OUT(subrsetb_pi, lanes_sbb_pi(b.lanes, d.lanes, 0, &bits))
#undef LRB_CARRY_IN
#undef LRB_CARRY_OUT
#undef LRB_CARRY_UNMASKED
#undef LRB_CARRY_MASKED
#undef LRB_IN
#undef LRB_IN_VALUE

/** The sum and, as a mask, its signs: 0 where the bit of k is 0, since k is the mask that receives them. */
LRB_INLINE lrb_v16i lrb_addsets_pi_s3(lrb_ctx *c, lrb_v16i a, lrb_s3i b, lrb_k16 *signs)
{
    uint32_t bits;
    lrb_v16i d = {.lanes = lanes_addsets_pi(a.lanes, b.lanes, &bits)};
    uint32_t event = lrb_emit(c, LRB_OP_addsets_pi, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address);
    *signs = (lrb_k16){.bits = bits};
    LRB_SET_FROM(*signs, event);
    LRB_SET_FROM(d, event);
    return d;
}

LRB_INLINE lrb_v16i lrb_addsets_pi(lrb_ctx *c, lrb_v16i a, lrb_v16i b, lrb_k16 *signs)
{
    return lrb_addsets_pi_s3(c, a, lrb_reg_pi(b), signs);
}

LRB_INLINE lrb_v16i lrb_mask_addsets_pi_s3(lrb_ctx *c, lrb_v16i old, lrb_k16 k, lrb_v16i a, lrb_s3i b, lrb_k16 *signs)
{
    uint32_t bits;
    lrb_v16i d = {.lanes = lanes_merge_pi(k.bits, old.lanes, lanes_addsets_pi(a.lanes, b.lanes, &bits))};
    uint32_t event = lrb_emit_masked(c, LRB_OP_addsets_pi, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), b.address);
    *signs = (lrb_k16){.bits = bits & k.bits};
    LRB_SET_FROM(*signs, event);
    LRB_SET_FROM(d, event);
    return d;
}

LRB_INLINE lrb_v16i lrb_mask_addsets_pi(lrb_ctx *c, lrb_v16i old, lrb_k16 k, lrb_v16i a, lrb_v16i b, lrb_k16 *signs)
{
    return lrb_mask_addsets_pi_s3(c, old, k, a, lrb_reg_pi(b), signs);
}

#endif
