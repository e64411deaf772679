/* Moves between vector registers, and a register seen as other lanes. */
#ifndef LRBNI_OPS_MOVE_H
#define LRBNI_OPS_MOVE_H

#include "lrbni/ops/forms.h"

LRB_UNARY(mov_ps, ps, b.lanes)
LRB_UNARY(mov_pi, pi, b.lanes)
LRB_UNARY(mov_pd, pd, b.lanes)
LRB_UNARY(mov_pq, pq, b.lanes)

/* LRB_BLEND(blendm_ps, ps): lrb_blendm_ps(c, k, a, b), b in the lanes whose bit in k is 1, a in the others; all are written */
#define LRB_BLEND(id, suffix)                                                                             \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id##_s3(lrb_ctx *c, lrb_k16 k, LRB_VECTOR_##suffix a, LRB_S3_##suffix b) \
    {                                                                                                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(k.bits, a.lanes, b.lanes)};                \
        LRB_SET_FROM(d, lrb_emit(c, LRB_OP_##id, b.form, 0xffff, LRB_FROM(a), LRB_FROM(b), LRB_FROM(k), 0, b.address)); \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_##id(lrb_ctx *c, lrb_k16 k, LRB_VECTOR_##suffix a, LRB_VECTOR_##suffix b) \
    {                                                                                                     \
        return lrb_##id##_s3(c, k, a, lrb_reg_##suffix(b));                                               \
    }
LRB_BLEND(blendm_ps, ps)
LRB_BLEND(blendm_pd, pd)
LRB_BLEND(blendm_pi, pi)
LRB_BLEND(blendm_pq, pq)


/* LRB_CAST(lrb_castps_pi, lrb_v16f, lrb_v16i, lanes_bits_ps(a.lanes)): the same register seen as other lanes; no op */
#define LRB_CAST(name, from, to, result)        \
    LRB_INLINE to name(from a)                  \
    {                                           \
        to r = {.lanes = result};               \
        LRB_SET_FROM(r, LRB_FROM(a));           \
        return r;                               \
    }
LRB_CAST(lrb_castps_pi, lrb_v16f, lrb_v16i, lanes_bits_ps(a.lanes))
LRB_CAST(lrb_castpi_ps, lrb_v16i, lrb_v16f, lanes_bits_pi(a.lanes))
LRB_CAST(lrb_castpi_pq, lrb_v16i, lrb_v8q, lanes_pq_from_pi(a.lanes))
LRB_CAST(lrb_castpq_pi, lrb_v8q, lrb_v16i, lanes_pi_from_pq(a.lanes))
LRB_CAST(lrb_castpd_pq, lrb_v8d, lrb_v8q, lanes_bits_pd(a.lanes))
LRB_CAST(lrb_castpq_pd, lrb_v8q, lrb_v8d, lanes_bits_pq(a.lanes))
LRB_CAST(lrb_castps_pq, lrb_v16f, lrb_v8q, lanes_pq_from_pi(lanes_bits_ps(a.lanes)))
LRB_CAST(lrb_castpq_ps, lrb_v8q, lrb_v16f, lanes_bits_pi(lanes_pi_from_pq(a.lanes)))
LRB_CAST(lrb_castps_pd, lrb_v16f, lrb_v8d, lanes_bits_pq(lanes_pq_from_pi(lanes_bits_ps(a.lanes))))
LRB_CAST(lrb_castpd_ps, lrb_v8d, lrb_v16f, lanes_bits_pi(lanes_pi_from_pq(lanes_bits_pd(a.lanes))))
#undef LRB_CAST

#endif
