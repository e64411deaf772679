/* Reductions, in the order of Intel's compiler (golden case 69): halves, quarters, then pairs and neighbours within a quarter. The
 * result leaves the vector unit through memory. Included by lanetrace/lrbni_intrinsics.h. */
#ifndef LANETRACE_INTRINSICS_REDUCE_H
#define LANETRACE_INTRINSICS_REDUCE_H

#include <limits.h>

#include "lanetrace/intrinsics_lanes.h"

/* Blocks of 128 bits in another order. */
static inline lrb_v16f lanetrace_blocks_ps(lrb_ctx *c, lrb_v16f v, unsigned blocks) { return lrb_permf32x4_ps(c, v, blocks); }
static inline lrb_v16i lanetrace_blocks_pi(lrb_ctx *c, lrb_v16i v, unsigned blocks)
{
    return lrb_castps_pi(lrb_permf32x4_ps(c, lrb_castpi_ps(v), blocks));
}

static inline lrb_v8d lanetrace_blocks_pd(lrb_ctx *c, lrb_v8d v, unsigned blocks)
{
    return lrb_castpq_pd(lrb_castps_pq(lrb_permf32x4_ps(c, lrb_castpq_ps(lrb_castpd_pq(v)), blocks)));
}

static inline lrb_v8q lanetrace_blocks_pq(lrb_ctx *c, lrb_v8q v, unsigned blocks)
{
    return lrb_castps_pq(lrb_permf32x4_ps(c, lrb_castpq_ps(v), blocks));
}

/* Lane 0, by a store and a load of a general register; in the line below the constants. */
static inline uint32_t lanetrace_lane_0_pi(lrb_ctx *c, lrb_v16i v)
{
    lrb_mem m = lrb_at(lrb_segment_at(c->scratch, LRB_SCRATCH_BYTES - 128), 0);
    lrb_store_1_pi(c, m, v);
    return (uint32_t)lrb_load32(c, m).value;
}

static inline uint64_t lanetrace_lane_0_pq(lrb_ctx *c, lrb_v8q v)
{
    lrb_mem m = lrb_at(lrb_segment_at(c->scratch, LRB_SCRATCH_BYTES - 128), 0);
    lrb_store_1_pq(c, m, v);
    return lrb_load64(c, m).value;
}

static inline float lanetrace_lane_0_ps(lrb_ctx *c, lrb_v16f v) { return lrb_bits_float(lanetrace_lane_0_pi(c, lrb_castps_pi(v))); }
static inline double lanetrace_lane_0_pd(lrb_ctx *c, lrb_v8d v) { return lrb_bits_double(lanetrace_lane_0_pq(c, lrb_castpd_pq(v))); }

/* The value that changes nothing, where the mask has 0. */
static inline lrb_v16f lanetrace_others_ps(float a) { return a == 0 ? lanetrace_mm512_setzero_ps() : lanetrace_mm512_set1_ps(a); }
static inline lrb_v16i lanetrace_others_pi(int a) { return a == 0 ? lanetrace_mm512_setzero_epi32() : lanetrace_mm512_set1_epi32(a); }
static inline lrb_v8d lanetrace_others_pd(double a) { return a == 0 ? lanetrace_mm512_setzero_pd() : lanetrace_mm512_set1_pd(a); }
static inline lrb_v8q lanetrace_others_pq(int64_t a)
{
    return lrb_castpi_pq(a == 0 ? lanetrace_mm512_setzero_epi32() : lanetrace_mm512_set1_epi64(a));
}

/* LANETRACE_REDUCE(add_ps, add_ps, ps, float, lrb_v16f, lrb_v16f, , LANETRACE_QUARTERS, 0): reduce_add_ps, mask_reduce_add_ps.
 * `unwrap` makes the op's vector of the intrinsic's; eight lanes have no quarters of four. */
#define LANETRACE_REDUCE(name, op, suffix, type, vector, wide, unwrap, quarters, neutral)                           \
    static inline type lanetrace_reduce_##name(lrb_ctx *c, wide v)                                                  \
    {                                                                                                               \
        wide other = lanetrace_blocks_##suffix(c, v, 0x4e);                                                         \
        v = lrb_##op(c, v, other);                                                                                  \
        quarters(op, suffix)                                                                                        \
        v = lrb_##op##_s3(c, v, lrb_swizzle_##suffix(v, LRB_BADC));                                                 \
        v = lrb_##op##_s3(c, v, lrb_swizzle_##suffix(v, LRB_CDAB));                                                 \
        return (type)lanetrace_lane_0_##suffix(c, v);                                                               \
    }                                                                                                               \
    static inline type lanetrace_mm512_reduce_##name(vector v) { return lanetrace_reduce_##name(lanetrace_c(), unwrap(v)); } \
    static inline type lanetrace_mm512_mask_reduce_##name(unsigned k, vector v)                                     \
    {                                                                                                               \
        lrb_k16 mask = lanetrace_k(k);                                                                              \
        wide others = lanetrace_others_##suffix(neutral);                                                           \
        return lanetrace_reduce_##name(lanetrace_c(), lrb_mask_mov_##suffix(lanetrace_c(), others, mask, unwrap(v))); \
    }
#define LANETRACE_QUARTERS(op, suffix)                                                                              \
    other = lanetrace_blocks_##suffix(c, v, 0xb1);                                                                  \
    v = lrb_##op(c, v, other);
#define LANETRACE_NO_QUARTERS(op, suffix)
#define LANETRACE_REDUCE_PS(op, neutral) LANETRACE_REDUCE(op, op, ps, float, lrb_v16f, lrb_v16f, , LANETRACE_QUARTERS, neutral)
#define LANETRACE_REDUCE_PD(op, neutral) LANETRACE_REDUCE(op, op, pd, double, lrb_v8d, lrb_v8d, , LANETRACE_NO_QUARTERS, neutral)
#define LANETRACE_REDUCE_PI(name, op, type, neutral) LANETRACE_REDUCE(name, op, pi, type, lrb_v16i, lrb_v16i, , LANETRACE_QUARTERS, neutral)
#define LANETRACE_REDUCE_PQ(name, op, neutral) LANETRACE_REDUCE(name, op, pq, int64_t, lrb_v16i, lrb_v8q, lrb_castpi_pq, LANETRACE_NO_QUARTERS, neutral)
LANETRACE_REDUCE_PS(add_ps, 0)
LANETRACE_REDUCE_PS(mul_ps, 1)
LANETRACE_REDUCE_PS(min_ps, __builtin_inff())
LANETRACE_REDUCE_PS(max_ps, -__builtin_inff())
LANETRACE_REDUCE_PS(gmin_ps, __builtin_inff())
LANETRACE_REDUCE_PS(gmax_ps, -__builtin_inff())
LANETRACE_REDUCE_PD(add_pd, 0)
LANETRACE_REDUCE_PD(mul_pd, 1)
LANETRACE_REDUCE_PD(min_pd, __builtin_inf())
LANETRACE_REDUCE_PD(max_pd, -__builtin_inf())
LANETRACE_REDUCE_PD(gmin_pd, __builtin_inf())
LANETRACE_REDUCE_PD(gmax_pd, -__builtin_inf())
LANETRACE_REDUCE_PI(add_epi32, add_pi, int, 0)
LANETRACE_REDUCE_PI(mul_epi32, mull_pi, int, 1)
LANETRACE_REDUCE_PI(min_epi32, min_pi, int, INT_MAX)
LANETRACE_REDUCE_PI(max_epi32, max_pi, int, INT_MIN)
LANETRACE_REDUCE_PI(min_epu32, min_pu, unsigned, -1)
LANETRACE_REDUCE_PI(max_epu32, max_pu, unsigned, 0)
LANETRACE_REDUCE_PI(and_epi32, and_pi, int, -1)
LANETRACE_REDUCE_PI(or_epi32, or_pi, int, 0)
LANETRACE_REDUCE_PQ(and_epi64, and_pq, -1)
LANETRACE_REDUCE_PQ(or_epi64, or_pq, 0)
#undef LANETRACE_REDUCE
#undef LANETRACE_QUARTERS
#undef LANETRACE_NO_QUARTERS
#undef LANETRACE_REDUCE_PS
#undef LANETRACE_REDUCE_PD
#undef LANETRACE_REDUCE_PI
#undef LANETRACE_REDUCE_PQ

#endif
