/* Rounding to fixed point, exponents, mantissas, scaling, fix-up and the transcendentals. The lane formulas are in ops.def. */
#ifndef LRBNI_OPS_EXPONENT_H
#define LRBNI_OPS_EXPONENT_H

#include "lrbni/ops/convert.h"

LRB_CONVERT(round_ps, ps, ps, all, fixed, lanes_round_ps(b.lanes, mode, adjust))
LRB_CONVERT(round_pd, pd, pd, all, fixed, lanes_round_pd(b.lanes, mode, adjust))
LRB_UNARY(getexp_ps, ps, lanes_getexp_ps(b.lanes))
LRB_UNARY(getexp_pd, pd, lanes_getexp_pd(b.lanes))
LRB_CONVERT(getmant_ps, ps, ps, all, mantissa, lanes_getmant_ps(b.lanes, interval, sign))
LRB_CONVERT(getmant_pd, pd, pd, all, mantissa, lanes_getmant_pd(b.lanes, interval, sign))
LRB_BINARY_OF(scale_ps, ps, pi, lanes_scale_ps(a.lanes, b.lanes))

/* The same table for all lanes, as an immediate, or one in each lane of S3. */
LRB_INSERT(fixup_ps, ps, ps, all, table, lanes_fixup_ps(d.lanes, b.lanes, lanes_load_1to16_pi(&table)))
LRB_TERNARY_OF(fixupnan_ps, ps, pi, lanes_fixupnan_ps(d.lanes, a.lanes, b.lanes))
LRB_TERNARY_OF(fixupnan_pd, pd, pq, lanes_fixupnan_pd(d.lanes, a.lanes, b.lanes))

LRB_CONVERT(exp223_ps, ps, pi, all, none, lanes_exp223_ps(b.lanes))
LRB_UNARY(log2_ps, ps, lanes_log2_ps(b.lanes))
LRB_UNARY(rcp23_ps, ps, lanes_rcp23_ps(b.lanes))
LRB_UNARY(rsqrt23_ps, ps, lanes_rsqrt23_ps(b.lanes))
LRB_UNARY(exp2lut_ps, ps, lanes_exp2lut_ps(b.lanes))
LRB_UNARY(log2lut_ps, ps, lanes_log2lut_ps(b.lanes))
LRB_UNARY(rsqrtlut_ps, ps, lanes_rsqrtlut_ps(b.lanes))

#endif
