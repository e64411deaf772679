/* Arithmetic and logic between vector registers. The lane formulas are in ops.def, the forms of an op in forms.h. */
#ifndef LRBNI_OPS_ARITH_H
#define LRBNI_OPS_ARITH_H

#include "lrbni/ops/forms.h"

LRB_BINARY(add_ps, ps, lanes_add_ps(a.lanes, b.lanes))
LRB_BINARY(sub_ps, ps, lanes_sub_ps(a.lanes, b.lanes))
LRB_BINARY(subr_ps, ps, lanes_sub_ps(b.lanes, a.lanes))
LRB_BINARY(mul_ps, ps, lanes_mul_ps(a.lanes, b.lanes))
LRB_BINARY(min_ps, ps, lanes_min_ps(a.lanes, b.lanes))
LRB_BINARY(max_ps, ps, lanes_max_ps(a.lanes, b.lanes))
LRB_BINARY(add_pi, pi, lanes_add_pi(a.lanes, b.lanes))
LRB_BINARY(sub_pi, pi, lanes_sub_pi(a.lanes, b.lanes))
LRB_BINARY(and_pi, pi, lanes_and_pi(a.lanes, b.lanes))
LRB_BINARY(or_pi, pi, lanes_or_pi(a.lanes, b.lanes))
LRB_BINARY(xor_pi, pi, lanes_xor_pi(a.lanes, b.lanes))

LRB_TERNARY(madd132_ps, ps, lanes_fmadd_ps(d.lanes, b.lanes, a.lanes))
LRB_TERNARY(madd213_ps, ps, lanes_fmadd_ps(a.lanes, d.lanes, b.lanes))
LRB_TERNARY(madd231_ps, ps, lanes_fmadd_ps(a.lanes, b.lanes, d.lanes))
LRB_TERNARY(msub231_ps, ps, lanes_fmsub_ps(a.lanes, b.lanes, d.lanes))
LRB_TERNARY(msubr231_ps, ps, lanes_fnmadd_ps(a.lanes, b.lanes, d.lanes))

/* One Newton step towards 1/b from the estimate a. */
LRB_INLINE lrb_f32x16 lanes_rcprefine_ps(lrb_f32x16 a, lrb_f32x16 b)
{
    static const float two = 2.0f;
    return lanes_mul_ps(a, lanes_fnmadd_ps(a, b, lanes_load_1to16_ps(&two)));
}
LRB_BINARY(rcprefine_ps, ps, lanes_rcprefine_ps(a.lanes, b.lanes))
LRB_UNARY(rcpres_ps, ps, lanes_rcpres_ps(b.lanes))

#endif
