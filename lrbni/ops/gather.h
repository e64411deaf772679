/* Gathers and scatters: lane i's element lies at base + index[i] * scale, the index a signed integer of 32 bits.
 *
 * One execution completes, of the lanes whose mask bit is 1, those whose elements lie in the line of 64 bytes of the lowest such
 * lane, and clears their bits; the others wait for the next execution (MIC.H, ISAM p.300). An 8-wide op takes the low 8 indices
 * and leaves bits 15 to 8 of the mask 0. Scatters write from lane 0 upwards, so of equal places the highest lane's element
 * stays (assumed; the rule of AVX-512). Elements must be aligned to their size. The event of an execution has the completed lanes
 * as its mask and the address of the lowest of them.
 */
#ifndef LRBNI_OPS_GATHER_H
#define LRBNI_OPS_GATHER_H

#include "lrbni/ops/places.h"
#include "lrbni/ops/scalar.h"

/* What one execution completes. */
typedef struct lrb_execution {
    lrb_places places;
    uint32_t lanes;
    uint32_t address; /* of the lowest lane; of the base, if there is none */
} lrb_execution;

LRB_INLINE lrb_execution lrb_execute(uint32_t k, lrb_mem base, lrb_v16i index, unsigned scale)
{
    assert(scale == 1 || scale == 2 || scale == 4 || scale == 8);
    assert(LRB_INDEX_FROM(base) == 0 && "the index is a vector");
    lrb_execution x = {.places = lrb_places_indexed(index, scale), .address = base.address};
    if (k) {
        x.address += (uint32_t)x.places.at[__builtin_ctz(k)];
        x.lanes = lrb_lanes_in_line(&x.places, k, base.address, lrb_line_of(x.address));
    }
    return x;
}

/* An element that is not aligned to its size faults. */
LRB_INLINE void lrb_assert_elements_aligned(const lrb_execution *x, uint32_t base, unsigned bytes)
{
    for (uint32_t k = x->lanes; k; k &= k - 1)
        assert((base + (uint32_t)x->places.at[__builtin_ctz(k)]) % bytes == 0 && "misaligned vector access");
    (void)x, (void)base, (void)bytes;
}

/* The mask that an execution leaves, made by its event. */
LRB_INLINE void lrb_complete(lrb_k16 *k, uint32_t lanes, uint32_t completed, uint32_t id)
{
    k->bits &= lanes & ~completed;
    LRB_SET_FROM(*k, id);
}

/* LRB_GATHER(ps, PS): lrb_gatherd_ps(c, old, &k, base, index, scale), lrb_scatterd_ps(c, base, &k, index, scale, a), one
 * execution each, and the same with a conversion at the end: lrb_gatherd_up_ps, lrb_scatterd_down_ps */
#define LRB_GATHER(suffix, TYPE)                                                                          \
    LRB_INLINE LRB_VECTOR_##suffix lrb_gatherd_up_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 *k, lrb_mem base, \
                                                           lrb_v16i index, unsigned scale, lrb_up_##suffix up) \
    {                                                                                                     \
        const unsigned bytes = lrb_up_##suffix##_bytes(up);                                               \
        const lrb_execution x = lrb_execute(k->bits & LRB_LANES_##suffix, base, index, scale);            \
        lrb_assert_elements_aligned(&x, base.address, bytes);                                             \
        const lrb_elements e = lrb_read_places(&x.places, x.lanes, base.host, bytes);                     \
        LRB_VECTOR_##suffix d = {.lanes = lanes_merge_##suffix(x.lanes, old.lanes, lanes_up_##suffix(e.bytes, up))}; \
        uint32_t id = LRB_EMIT_MASKED_##suffix(c, LRB_OP_gatherd_##suffix, lrb_form_of_line(x.lanes), lrb_moved(*k, x.lanes), \
                                               LRB_BASE_FROM(base), LRB_FROM(index), LRB_FROM(old), x.address); \
        LRB_SET_FROM(d, id);                                                                              \
        lrb_complete(k, LRB_LANES_##suffix, x.lanes, id);                                                 \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE LRB_VECTOR_##suffix lrb_gatherd_##suffix(lrb_ctx *c, LRB_VECTOR_##suffix old, lrb_k16 *k, lrb_mem base, \
                                                        lrb_v16i index, unsigned scale)                   \
    {                                                                                                     \
        return lrb_gatherd_up_##suffix(c, old, k, base, index, scale, LRB_UP_##TYPE##_none);              \
    }                                                                                                     \
    LRB_INLINE void lrb_scatterd_down_##suffix(lrb_ctx *c, lrb_mem base, lrb_k16 *k, lrb_v16i index, unsigned scale, \
                                               LRB_VECTOR_##suffix a, lrb_down_##suffix down)             \
    {                                                                                                     \
        const unsigned bytes = lrb_down_##suffix##_bytes(down);                                           \
        const lrb_execution x = lrb_execute(k->bits & LRB_LANES_##suffix, base, index, scale);            \
        lrb_assert_elements_aligned(&x, base.address, bytes);                                             \
        const lrb_elements e = lrb_down_elements_##suffix(c, a.lanes, down);                              \
        lrb_write_places(&x.places, x.lanes, base.host, bytes, &e);                                       \
        uint32_t id = LRB_EMIT_MASKED_##suffix(c, LRB_OP_scatterd_##suffix, lrb_form_of_line(x.lanes), lrb_moved(*k, x.lanes), \
                                               LRB_BASE_FROM(base), LRB_FROM(index), LRB_FROM(a), x.address); \
        lrb_complete(k, LRB_LANES_##suffix, x.lanes, id);                                                 \
    }                                                                                                     \
    LRB_INLINE void lrb_scatterd_##suffix(lrb_ctx *c, lrb_mem base, lrb_k16 *k, lrb_v16i index, unsigned scale, \
                                          LRB_VECTOR_##suffix a)                                          \
    {                                                                                                     \
        lrb_scatterd_down_##suffix(c, base, k, index, scale, a, LRB_DOWN_##TYPE##_none);                  \
    }
LRB_GATHER(ps, PS)
LRB_GATHER(pi, PI)
LRB_GATHER(pd, PD)
LRB_GATHER(pq, PQ)
#undef LRB_GATHER

/* LRB_GATHER_PREFETCH(gatherpfd): lrb_gatherpfd(c, &k, base, index, scale), one execution: the line is fetched, nothing is read */
#define LRB_GATHER_PREFETCH(id)                                                                           \
    LRB_INLINE void lrb_##id(lrb_ctx *c, lrb_k16 *k, lrb_mem base, lrb_v16i index, unsigned scale)        \
    {                                                                                                     \
        const lrb_execution x = lrb_execute(k->bits, base, index, scale);                                 \
        uint32_t event = lrb_emit_masked(c, LRB_OP_##id, lrb_form_of_line(x.lanes), lrb_moved(*k, x.lanes), LRB_BASE_FROM(base), \
                                         LRB_FROM(index), 0, x.address);                                  \
        lrb_complete(k, 0xffff, x.lanes, event);                                                          \
    }
LRB_GATHER_PREFETCH(gatherpfd)
LRB_GATHER_PREFETCH(gatherpf2d)
LRB_GATHER_PREFETCH(scatterpfd)
LRB_GATHER_PREFETCH(scatterpf2d)
#undef LRB_GATHER_PREFETCH

/* LRB_GATHER_HINT(gatherpf0hintd_ps, ps): lrb_gatherpf0hintd_ps(c, k, base, index, scale): a gather of the same lanes will
 * follow; no line is fetched, and the mask stays (KNCNI) */
#define LRB_GATHER_HINT(id, suffix)                                                                       \
    LRB_INLINE void lrb_##id(lrb_ctx *c, lrb_k16 k, lrb_mem base, lrb_v16i index, unsigned scale)         \
    {                                                                                                     \
        const lrb_execution x = lrb_execute(k.bits & LRB_LANES_##suffix, base, index, scale);             \
        LRB_EMIT_MASKED_##suffix(c, LRB_OP_##id, 0, lrb_moved(k, k.bits & LRB_LANES_##suffix), LRB_BASE_FROM(base), \
                                 LRB_FROM(index), 0, x.address);                                          \
    }
LRB_GATHER_HINT(gatherpf0hintd_ps, ps)
LRB_GATHER_HINT(gatherpf0hintd_pd, pd)
LRB_GATHER_HINT(scatterpf0hintd_ps, ps)
LRB_GATHER_HINT(scatterpf0hintd_pd, pd)
#undef LRB_GATHER_HINT

/*
 * All lanes of k, as a compiler writes it: execution, kortest and jump until no lane is left. The site of the jump is the line of the
 * call, so two of them do not go on one line.
 */
#define lrb_gather_all_ps(c, old, k, base, index, scale) lrb_gather_loop_ps(c, LRB_SITE, old, k, base, index, scale)
#define lrb_gather_all_pi(c, old, k, base, index, scale) lrb_gather_loop_pi(c, LRB_SITE, old, k, base, index, scale)
#define lrb_gather_all_pd(c, old, k, base, index, scale) lrb_gather_loop_pd(c, LRB_SITE, old, k, base, index, scale)
#define lrb_gather_all_pq(c, old, k, base, index, scale) lrb_gather_loop_pq(c, LRB_SITE, old, k, base, index, scale)
#define lrb_scatter_all_ps(c, base, k, index, scale, a) lrb_scatter_loop_ps(c, LRB_SITE, base, k, index, scale, a)
#define lrb_scatter_all_pi(c, base, k, index, scale, a) lrb_scatter_loop_pi(c, LRB_SITE, base, k, index, scale, a)
#define lrb_scatter_all_pd(c, base, k, index, scale, a) lrb_scatter_loop_pd(c, LRB_SITE, base, k, index, scale, a)
#define lrb_scatter_all_pq(c, base, k, index, scale, a) lrb_scatter_loop_pq(c, LRB_SITE, base, k, index, scale, a)

#define LRB_GATHER_LOOPS(suffix)                                                                          \
    LRB_INLINE LRB_VECTOR_##suffix lrb_gather_loop_##suffix(lrb_ctx *c, uint32_t site, LRB_VECTOR_##suffix d, lrb_k16 k, \
                                                            lrb_mem base, lrb_v16i index, unsigned scale) \
    {                                                                                                     \
        do                                                                                                \
            d = lrb_gatherd_##suffix(c, d, &k, base, index, scale);                                       \
        while (lrb_jump_if_not_zero(c, site, lrb_kortest(c, k, k)));                                      \
        return d;                                                                                         \
    }                                                                                                     \
    LRB_INLINE void lrb_scatter_loop_##suffix(lrb_ctx *c, uint32_t site, lrb_mem base, lrb_k16 k, lrb_v16i index, \
                                              unsigned scale, LRB_VECTOR_##suffix a)                      \
    {                                                                                                     \
        do                                                                                                \
            lrb_scatterd_##suffix(c, base, &k, index, scale, a);                                          \
        while (lrb_jump_if_not_zero(c, site, lrb_kortest(c, k, k)));                                      \
    }
LRB_GATHER_LOOPS(ps)
LRB_GATHER_LOOPS(pi)
LRB_GATHER_LOOPS(pd)
LRB_GATHER_LOOPS(pq)
#undef LRB_GATHER_LOOPS

#endif
