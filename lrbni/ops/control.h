/* Float ops and the state of the machine.
 *
 * A kernel that changes the state defines LRB_CONTROL as 1 before it includes lrbni/lrbni.h. In other kernels the state is the
 * default one, and nothing looks at it. Every tile starts in the default state. The forms with _round take a rounding mode of
 * their own, as Knights Corner's {rn}, {rd}, {ru}, {rz}; they are there in every kernel.
 */
#ifndef LRBNI_OPS_CONTROL_H
#define LRBNI_OPS_CONTROL_H

#include "lrbni/ops/forms.h"

#ifndef LRB_CONTROL
#define LRB_CONTROL 0
#endif

#if LRB_CONTROL
#define LRB_STATE(c) ((c)->control)

/** The state from 32 bits of memory (lrbni/control.h). */
LRB_INLINE void lrb_ldvxcsr(lrb_ctx *c, lrb_mem m)
{
    uint32_t bits;
    memcpy(&bits, m.host, sizeof bits);
    c->control = lrb_control_of(bits);
    lrb_emit(c, LRB_OP_ldvxcsr, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, 0, m.address);
}
#else
#define LRB_STATE(c) ((void)(c), (lrb_control){0})
#endif

/** The state into 32 bits of memory. */
LRB_INLINE void lrb_stvxcsr(lrb_ctx *c, lrb_mem m)
{
    uint32_t bits = lrb_control_bits(LRB_STATE(c));
    memcpy(m.host, &bits, sizeof bits);
    lrb_emit(c, LRB_OP_stvxcsr, 0, 0xffff, LRB_BASE_FROM(m), LRB_INDEX_FROM(m), 0, 0, m.address);
}

/* LRB_ARITH2(control, add, ps, x, y), LRB_ARITH3(control, fmadd, ps, x, y, z): lanes by the host's instructions in the default
 * state, in integers otherwise. */
#define LRB_ARITH2(control, kind, suffix, x, y)                                     \
    (lrb_control_is_default(control) ? lanes_##kind##_##suffix(x, y)                \
                                     : lanes_exact_##suffix(control, LRB_EXACT_##kind, x, y, y))
#define LRB_ARITH3(control, kind, suffix, x, y, z)                                  \
    (lrb_control_is_default(control) ? lanes_##kind##_##suffix(x, y, z)             \
                                     : lanes_exact_##suffix(control, LRB_EXACT_##kind, x, y, z))

/* A source that is compared: subnormal lanes count as zeros where the state says so (assumed for compares, minima and maxima). */
#define LRB_READ(c, suffix, x) (LRB_STATE(c).denormals_are_zero ? lanes_flushed_##suffix(x) : (x))

/* LRB_BINARY_ROUND(add, ps, result): lrb_add_round_ps(c, a, b, rounding) and lrb_mask_add_round_ps; `control` is the state with
 * that rounding mode */
#define LRB_BINARY_ROUND(base, suffix, result)                                                            \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##base##_round_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b, \
                                                               lrb_rounding rounding)                     \
    {                                                                                                     \
        lrb_control control = lrb_control_rounding(LRB_STATE(c), rounding);                               \
        LRB_VECTOR_##suffix d = {.lanes = result};                                                        \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##base##_##suffix, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##base##_round_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 k, \
                                                                    LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b, \
                                                                    lrb_rounding rounding)                \
    {                                                                                                     \
        lrb_control control = lrb_control_rounding(LRB_STATE(c), rounding);                               \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, old.lanes, result)};               \
        LRB_SET_FROM(d, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##base##_##suffix, 0, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(old), 0)); \
        return d;                                                                                         \
    }

/* LRB_TERNARY_ROUND(madd231, ps, result): lrb_madd231_round_ps(c, d, a, b, rounding) and lrb_mask_madd231_round_ps */
#define LRB_TERNARY_ROUND(base, suffix, result)                                                           \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##base##_round_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix d, LRB_VECTOR_##suffix a, \
                                                               LRB_VECTOR_##suffix b, lrb_rounding rounding) \
    {                                                                                                     \
        lrb_control control = lrb_control_rounding(LRB_STATE(c), rounding);                               \
        LRB_VECTOR_##suffix r = {.lanes = result};                                                        \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##base##_##suffix, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, LRB_FROM(d), 0)); \
        return r;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_mask_##base##_round_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix d, lrb_k16 k, \
                                                                    LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b, \
                                                                    lrb_rounding rounding)                \
    {                                                                                                     \
        lrb_control control = lrb_control_rounding(LRB_STATE(c), rounding);                               \
        LRB_VECTOR_##suffix r = {.lanes = lanes_merge_##suffix(k.bits, d.lanes, result)};                 \
        LRB_SET_FROM(r, LRB_EMIT_MASKED_##suffix(c, LRB_OP_##base##_##suffix, 0, k, LRB_FROM(a), LRB_FROM(b), LRB_FROM(d), 0)); \
        return r;                                                                                         \
    }

#endif
