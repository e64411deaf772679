/* Arithmetic and logic between vector registers. The lane formulas are in ops.def, the forms of an op in forms.h. */
#ifndef LRBNI_OPS_ARITH_H
#define LRBNI_OPS_ARITH_H

#include "lrbni/ops/control.h"

/* LRB_SUM(add, ps, add, a.lanes, b.lanes): lrb_add_ps in all its forms, and with a rounding mode */
#define LRB_SUM(base, suffix, kind, x, y)                                                     \
    LRB_BINARY(base##_##suffix, suffix, LRB_ARITH2(LRB_STATE(c), kind, suffix, x, y))         \
    LRB_BINARY_ROUND(base, suffix, LRB_ARITH2(control, kind, suffix, x, y))
/* LRB_FUSED(madd231, ps, fmadd, a.lanes, b.lanes, d.lanes): the same for a multiply-add */
#define LRB_FUSED(base, suffix, kind, x, y, z)                                                \
    LRB_TERNARY(base##_##suffix, suffix, LRB_ARITH3(LRB_STATE(c), kind, suffix, x, y, z))     \
    LRB_TERNARY_ROUND(base, suffix, LRB_ARITH3(control, kind, suffix, x, y, z))
/* LRB_CHOICE(min_ps, ps, lanes_min_ps): no rounding */
#define LRB_CHOICE(id, suffix, lanes_function) \
    LRB_BINARY(id, suffix, lanes_function(LRB_READ(c, suffix, a.lanes), LRB_READ(c, suffix, b.lanes)))

/* LRB_FLOAT_ARITH(ps): what floats and doubles have alike */
#define LRB_FLOAT_ARITH(suffix)                                         \
    LRB_SUM(add, suffix, add, a.lanes, b.lanes)                         \
    LRB_SUM(addn, suffix, addn, a.lanes, b.lanes)                       \
    LRB_SUM(sub, suffix, sub, a.lanes, b.lanes)                         \
    LRB_SUM(subr, suffix, sub, b.lanes, a.lanes)                        \
    LRB_SUM(mul, suffix, mul, a.lanes, b.lanes)                         \
    LRB_FUSED(madd132, suffix, fmadd, d.lanes, b.lanes, a.lanes)        \
    LRB_FUSED(madd213, suffix, fmadd, a.lanes, d.lanes, b.lanes)        \
    LRB_FUSED(madd231, suffix, fmadd, a.lanes, b.lanes, d.lanes)        \
    LRB_FUSED(msub132, suffix, fmsub, d.lanes, b.lanes, a.lanes)        \
    LRB_FUSED(msub213, suffix, fmsub, a.lanes, d.lanes, b.lanes)        \
    LRB_FUSED(msub231, suffix, fmsub, a.lanes, b.lanes, d.lanes)        \
    LRB_FUSED(msubr132, suffix, fnmadd, d.lanes, b.lanes, a.lanes)      \
    LRB_FUSED(msubr213, suffix, fnmadd, a.lanes, d.lanes, b.lanes)      \
    LRB_FUSED(msubr231, suffix, fnmadd, a.lanes, b.lanes, d.lanes)      \
    LRB_FUSED(maddn132, suffix, fnmsub, d.lanes, b.lanes, a.lanes)      \
    LRB_FUSED(maddn213, suffix, fnmsub, a.lanes, d.lanes, b.lanes)      \
    LRB_FUSED(maddn231, suffix, fnmsub, a.lanes, b.lanes, d.lanes)      \
    LRB_BINARY(msubr23c1_##suffix, suffix, LRB_ARITH3(LRB_STATE(c), fnmadd, suffix, a.lanes, b.lanes, lanes_one_##suffix())) \
    LRB_CHOICE(min_##suffix, suffix, lanes_min_##suffix)                \
    LRB_CHOICE(max_##suffix, suffix, lanes_max_##suffix)                \
    LRB_CHOICE(gmin_##suffix, suffix, lanes_gmin_##suffix)              \
    LRB_CHOICE(gmax_##suffix, suffix, lanes_gmax_##suffix)

LRB_INLINE lrb_f32x16 lanes_one_ps(void)
{
    static const float one = 1.0f;
    return lanes_load_1to16_ps(&one);
}

LRB_INLINE lrb_f64x8 lanes_one_pd(void)
{
    static const double one = 1.0;
    return lanes_load_1to8_pd(&one);
}

/* The larger of the lanes without their signs. */
LRB_INLINE lrb_f32x16 lanes_maxabs_ps(lrb_f32x16 a, lrb_f32x16 b) { return lanes_max_ps(lanes_abs_ps(a), lanes_abs_ps(b)); }
LRB_INLINE lrb_f32x16 lanes_gmaxabs_ps(lrb_f32x16 a, lrb_f32x16 b) { return lanes_gmax_ps(lanes_abs_ps(a), lanes_abs_ps(b)); }

LRB_FLOAT_ARITH(ps)
LRB_FLOAT_ARITH(pd)
LRB_CHOICE(maxabs_ps, ps, lanes_maxabs_ps)
LRB_CHOICE(gmaxabs_ps, ps, lanes_gmaxabs_ps)
LRB_CHOICE(clampz_ps, ps, lanes_clampz_ps)

/* a times the second, plus the first of each group of four: a scale and a bias that the group shares. S3 is a register as it
 * is, or memory in full or {4to16} (ODB). */
#define LRB_MADD233(control) \
    LRB_ARITH3(control, fmadd, ps, a.lanes, lanes_swizzle_ps(b.lanes, LRB_BBBB), lanes_swizzle_ps(b.lanes, LRB_AAAA))
LRB_BINARY(madd233_ps, ps, (assert(lrb_is_group_form(b.form)), LRB_MADD233(LRB_STATE(c))))
LRB_BINARY_ROUND(madd233, ps, LRB_MADD233(control))

/** Sums, and in *signs their sign bits; both only in the lanes of k, where bits of *signs beyond k are 0. */
LRB_INLINE lrb_v16f lrb_addsets_ps_s3(lrb_ctx *c, lrb_v16f a, lrb_s3f b, lrb_k16 *signs)
{
    lrb_v16f d = {.lanes = LRB_ARITH2(LRB_STATE(c), add, ps, a.lanes, b.lanes)};
    LRB_SET_FROM(d, lrb_emit(c, LRB_OP_addsets_ps, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, b.address));
    signs->bits = lanes_signs_ps(d.lanes);
    LRB_SET_FROM(*signs, LRB_FROM(d));
    return d;
}

LRB_INLINE lrb_v16f lrb_addsets_ps(lrb_ctx *c, lrb_v16f a, lrb_v16f b, lrb_k16 *signs)
{
    return lrb_addsets_ps_s3(c, a, lrb_reg_ps(b), signs);
}

LRB_INLINE lrb_v16f lrb_mask_addsets_ps_s3(lrb_ctx *c, lrb_v16f old, lrb_k16 k, lrb_v16f a, lrb_s3f b, lrb_k16 *signs)
{
    lrb_f32x16 sum = LRB_ARITH2(LRB_STATE(c), add, ps, a.lanes, b.lanes);
    lrb_v16f d = {.lanes = lanes_merge_ps(k.bits, old.lanes, sum)};
    LRB_SET_FROM(d, lrb_emit_masked(c, LRB_OP_addsets_ps, b.form, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), b.address));
    signs->bits = lanes_signs_ps(sum) & k.bits;
    LRB_SET_FROM(*signs, LRB_FROM(d));
    return d;
}

LRB_INLINE lrb_v16f lrb_mask_addsets_ps(lrb_ctx *c, lrb_v16f old, lrb_k16 k, lrb_v16f a, lrb_v16f b, lrb_k16 *signs)
{
    return lrb_mask_addsets_ps_s3(c, old, k, a, lrb_reg_ps(b), signs);
}
#undef LRB_SUM
#undef LRB_FUSED
#undef LRB_CHOICE
#undef LRB_FLOAT_ARITH
#undef LRB_MADD233

LRB_BINARY(add_pi, pi, lanes_add_pi(a.lanes, b.lanes))
LRB_BINARY(sub_pi, pi, lanes_sub_pi(a.lanes, b.lanes))
LRB_BINARY(and_pi, pi, lanes_and_pi(a.lanes, b.lanes))
LRB_BINARY(or_pi, pi, lanes_or_pi(a.lanes, b.lanes))
LRB_BINARY(xor_pi, pi, lanes_xor_pi(a.lanes, b.lanes))

/* One Newton step towards 1/b from the estimate a. */
LRB_INLINE lrb_f32x16 lanes_rcprefine_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    static const float two = 2.0f;
    return lanes_mul_ps(a, lanes_fnmadd_ps(a, b, lanes_load_1to16_ps(&two)));
}
LRB_BINARY(rcprefine_ps, ps, lanes_rcprefine_ps(a.lanes, b.lanes))
LRB_UNARY(rcpres_ps, ps, lanes_rcpres_ps(b.lanes))

#endif
