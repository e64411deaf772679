/* Conversions between the formats that vectors have, and into packed ones. The lane formulas are in ops.def.
 *
 * Eight doubles go to and from a half of a vector of 32-bit lanes: the low one, or the high one in the cvthi forms. A source
 * of half a vector is read from 32 bytes of memory (lrb_half_ps, lrb_half_pi), or broadcast as ever. The write-mask's bits 7
 * to 0 are those of the eight elements, in whatever half they are.
 */
#ifndef LRBNI_OPS_CONVERT_H
#define LRBNI_OPS_CONVERT_H

#include "lrbni/ops/forms.h"

/* The immediates that an op may have, as parameters and as arguments. */
#define LRB_PARAMETERS_none
#define LRB_PARAMETERS_mode , lrb_rounding mode
#define LRB_PARAMETERS_fixed , lrb_rounding mode, lrb_adjust adjust
#define LRB_PARAMETERS_mantissa , lrb_mantissa interval, lrb_mantissa_sign sign
#define LRB_PARAMETERS_field , unsigned field
#define LRB_PARAMETERS_table , uint32_t table
#define LRB_ARGUMENTS_none
#define LRB_ARGUMENTS_mode , mode
#define LRB_ARGUMENTS_fixed , mode, adjust
#define LRB_ARGUMENTS_mantissa , interval, sign
#define LRB_ARGUMENTS_field , field
#define LRB_ARGUMENTS_table , table

/* Lanes of the result that an op writes under a mask: those of the mask; eight, and zeros above; one half. */
#define LRB_LANES_all(k) (k)
#define LRB_LANES_low_and_zeros(k) ((k) | 0xff00u)
#define LRB_LANES_low(k) ((k) & 0x00ffu)
#define LRB_LANES_high(k) (((k) & 0x00ffu) << 8)

/* LRB_CONVERT(cvtps2pi, pi, ps, all, fixed, lanes_cvtps2pi(b.lanes, mode, adjust)): lrb_cvtps2pi, lrb_cvtps2pi_s3,
 * lrb_mask_cvtps2pi, lrb_mask_cvtps2pi_s3, from S3 of other lanes than the result's, with immediates */
#define LRB_CONVERT(id, to, from, written, immediates, result)                                                      \
    LRB_INLINE LRB_VECTOR_##to lrb_##id##_s3(lrb_ctx *c, LRB_S3_##from b LRB_PARAMETERS_##immediates)               \
    {                                                                                                               \
        LRB_VECTOR_##to d = {.lanes = result};                                                                      \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, 0, LRB_FROM(b), 0, 0, b.address));                 \
        return d;                                                                                                   \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_##id(lrb_ctx *c, LRB_VECTOR_##from b LRB_PARAMETERS_##immediates)                \
    {                                                                                                               \
        return lrb_##id##_s3(c, lrb_reg_##from(b) LRB_ARGUMENTS_##immediates);                                      \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##to old, lrb_k16 k,                       \
                                                  LRB_S3_##from b LRB_PARAMETERS_##immediates)                      \
    {                                                                                                               \
        k.bits = LRB_LANES_##written(k.bits);                                                                       \
        LRB_VECTOR_##to d = {.lanes = lanes_merge_##to(k.bits, old.lanes, result)};                                 \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##to(c, LRB_OP_##id, b.form, k, 0, LRB_FROM(b), LRB_FROM(old), b.address)); \
        return d;                                                                                                   \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##to old, lrb_k16 k,                            \
                                             LRB_VECTOR_##from b LRB_PARAMETERS_##immediates)                       \
    {                                                                                                               \
        return lrb_mask_##id##_s3(c, old, k, lrb_reg_##from(b) LRB_ARGUMENTS_##immediates);                         \
    }

/* LRB_INSERT(cvtinsps2u10, pi, ps, all, field, lanes_cvtinsps2u10(d.lanes, b.lanes, field)): the same where the op reads its
 * old destination d, or writes a part of it */
#define LRB_INSERT(id, to, from, written, immediates, result)                                                       \
    LRB_INLINE LRB_VECTOR_##to lrb_mask_##id##_s3(lrb_ctx *c, LRB_VECTOR_##to d, lrb_k16 k,                         \
                                                  LRB_S3_##from b LRB_PARAMETERS_##immediates)                      \
    {                                                                                                               \
        k.bits = LRB_LANES_##written(k.bits);                                                                       \
        LRB_VECTOR_##to r = {.lanes = lanes_merge_##to(k.bits, d.lanes, result)};                                   \
        LRB_SET_FROM(r, LRB_EMIT_MASKED_##to(c, LRB_OP_##id, b.form, k, 0, LRB_FROM(b), LRB_FROM(d), b.address));   \
        return r;                                                                                                   \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_##id##_s3(lrb_ctx *c, LRB_VECTOR_##to d, LRB_S3_##from b LRB_PARAMETERS_##immediates) \
    {                                                                                                               \
        return lrb_mask_##id##_s3(c, d, lrb_mask(0xffff), b LRB_ARGUMENTS_##immediates);                            \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_##id(lrb_ctx *c, LRB_VECTOR_##to d, LRB_VECTOR_##from b LRB_PARAMETERS_##immediates) \
    {                                                                                                               \
        return lrb_##id##_s3(c, d, lrb_reg_##from(b) LRB_ARGUMENTS_##immediates);                                   \
    }                                                                                                               \
    LRB_INLINE LRB_VECTOR_##to lrb_mask_##id(lrb_ctx *c, LRB_VECTOR_##to d, lrb_k16 k,                              \
                                             LRB_VECTOR_##from b LRB_PARAMETERS_##immediates)                       \
    {                                                                                                               \
        return lrb_mask_##id##_s3(c, d, k, lrb_reg_##from(b) LRB_ARGUMENTS_##immediates);                           \
    }

/** S3 of eight lanes of 32 bits, from 32 bytes of memory: for ops that read the low half of their source. */
LRB_INLINE lrb_s3f lrb_half_ps(lrb_mem m)
{
    LRB_ASSERT_ALIGNED(m, 32);
    return lrb_s3_memory_ps(m, (lrb_s3f){.lanes = lanes_load_half_ps(m.host)}, LRB_FORM_32_BYTES);
}

LRB_INLINE lrb_s3i lrb_half_pi(lrb_mem m)
{
    LRB_ASSERT_ALIGNED(m, 32);
    return lrb_s3_memory_pi(m, (lrb_s3i){.lanes = lanes_load_half_pi(m.host)}, LRB_FORM_32_BYTES);
}

/* What an op of eight lanes takes of S3: the low half, which memory is half a vector for; or the high half of a register. */
LRB_INLINE lrb_f32x16 lrb_low_ps(lrb_s3f b)
{
    assert((b.form & (LRB_FORM_MEMORY | LRB_FORM_BYTES)) != LRB_FORM_MEMORY && "eight lanes are read with lrb_half");
    return b.lanes;
}

LRB_INLINE lrb_i32x16 lrb_low_pi(lrb_s3i b)
{
    assert((b.form & (LRB_FORM_MEMORY | LRB_FORM_BYTES)) != LRB_FORM_MEMORY && "eight lanes are read with lrb_half");
    return b.lanes;
}

LRB_INLINE lrb_f32x16 lrb_high_ps(lrb_s3f b)
{
    assert(!(b.form & LRB_FORM_MEMORY) && "the high half is a register's");
    return lanes_upper_half_ps(b.lanes);
}

LRB_INLINE lrb_i32x16 lrb_high_pi(lrb_s3i b)
{
    assert(!(b.form & LRB_FORM_MEMORY) && "the high half is a register's");
    return lanes_upper_half_pi(b.lanes);
}

/* Between floats and integers: scaled by 2^adjust, rounded, saturated. */
LRB_CONVERT(cvtps2pi, pi, ps, all, fixed, lanes_cvtps2pi(b.lanes, mode, adjust))
LRB_CONVERT(cvtps2pu, pi, ps, all, fixed, lanes_cvtps2pu(b.lanes, mode, adjust))
LRB_CONVERT(cvtpi2ps, ps, pi, all, fixed, lanes_cvtpi2ps(b.lanes, mode, adjust))
LRB_CONVERT(cvtpu2ps, ps, pi, all, fixed, lanes_cvtpu2ps(b.lanes, mode, adjust))

/* To doubles, from the low and from the high half. */
LRB_CONVERT(cvtps2pd, pd, ps, all, none, lanes_cvtps2pd(lrb_low_ps(b)))
LRB_CONVERT(cvtpi2pd, pd, pi, all, none, lanes_cvtpi2pd(lrb_low_pi(b)))
LRB_CONVERT(cvtpu2pd, pd, pi, all, none, lanes_cvtpu2pd(lrb_low_pi(b)))
LRB_CONVERT(cvthi_ps2pd, pd, ps, all, none, lanes_cvtps2pd(lrb_high_ps(b)))
LRB_CONVERT(cvthi_pi2pd, pd, pi, all, none, lanes_cvtpi2pd(lrb_high_pi(b)))
LRB_CONVERT(cvthi_pu2pd, pd, pi, all, none, lanes_cvtpu2pd(lrb_high_pi(b)))

/* From doubles: to the low half with zeros above, or to one half, the other kept. */
LRB_CONVERT(cvtpd2ps, ps, pd, low_and_zeros, mode, lanes_cvtpd2ps(b.lanes, mode))
LRB_CONVERT(cvtpd2pi, pi, pd, low_and_zeros, mode, lanes_cvtpd2pi(b.lanes, mode))
LRB_CONVERT(cvtpd2pu, pi, pd, low_and_zeros, mode, lanes_cvtpd2pu(b.lanes, mode))
LRB_INSERT(cvtlo_pd2ps, ps, pd, low, mode, lanes_cvtpd2ps(b.lanes, mode))
LRB_INSERT(cvtlo_pd2pi, pi, pd, low, mode, lanes_cvtpd2pi(b.lanes, mode))
LRB_INSERT(cvtlo_pd2pu, pi, pd, low, mode, lanes_cvtpd2pu(b.lanes, mode))
LRB_INSERT(cvthi_pd2ps, ps, pd, high, mode, lanes_to_upper_half_ps(lanes_cvtpd2ps(b.lanes, mode)))
LRB_INSERT(cvthi_pd2pi, pi, pd, high, mode, lanes_to_upper_half_pi(lanes_cvtpd2pi(b.lanes, mode)))
LRB_INSERT(cvthi_pd2pu, pi, pd, high, mode, lanes_to_upper_half_pi(lanes_cvtpd2pu(b.lanes, mode)))

/* Into the packed formats of graphics; field 0 is the lowest. */
LRB_CONVERT(cvtps2srgb8, pi, ps, all, none, lanes_cvtps2srgb8(b.lanes))
LRB_INSERT(cvtinsps2u10, pi, ps, all, field, lanes_cvtinsps2u10(d.lanes, b.lanes, field))
LRB_INSERT(cvtinsps2f11, pi, ps, all, field, lanes_cvtinsps2f11(d.lanes, b.lanes, field))

#endif
