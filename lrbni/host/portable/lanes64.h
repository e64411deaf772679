/* The same register as eight lanes of 64 bits, in plain C. Bits 8 and up of a mask are not looked at. */
#ifndef LRBNI_HOST_PORTABLE_LANES64_H
#define LRBNI_HOST_PORTABLE_LANES64_H

#include "lrbni/host/portable/lanes.h"

typedef struct lrb_f64x8 {
    double f[8];
} lrb_f64x8;

typedef struct lrb_i64x8 {
    int64_t i[8];
} lrb_i64x8;

/* LANES_SAME_BITS(lanes_bits_pd, f64x8, i64x8): the register seen as other lanes */
#define LANES_SAME_BITS(name, from, to)             \
    static inline lrb_##to name(lrb_##from a)       \
    {                                               \
        lrb_##to r;                                 \
        memcpy(&r, &a, sizeof r);                   \
        return r;                                   \
    }
LANES_SAME_BITS(lanes_bits_pd, f64x8, i64x8)
LANES_SAME_BITS(lanes_bits_pq, i64x8, f64x8)
LANES_SAME_BITS(lanes_pi_from_pq, i64x8, i32x16)
LANES_SAME_BITS(lanes_pq_from_pi, i32x16, i64x8)
#undef LANES_SAME_BITS

static inline lrb_i64x8 lanes_merge_pq(uint32_t k, lrb_i64x8 old, lrb_i64x8 new_lanes)
{
    lrb_i64x8 r;
    for (int i = 0; i < 8; i++)
        r.i[i] = k & lanes_bit[i] ? new_lanes.i[i] : old.i[i];
    return r;
}

/* Lane 4g+j of the result is lane 4g + word j of the source; `words` holds two bits per j, lowest first. */
static inline lrb_i64x8 lanes_swizzle_pq(lrb_i64x8 a, unsigned words)
{
    lrb_i64x8 r;
    for (unsigned g = 0; g < 2; g++)
        for (unsigned j = 0; j < 4; j++)
            r.i[4 * g + j] = a.i[4 * g + (words >> (2 * j) & 3)];
    return r;
}

static inline lrb_i64x8 lanes_load_pq(const void *m)
{
    lrb_i64x8 r;
    memcpy(&r, m, sizeof r);
    return r;
}

static inline lrb_i64x8 lanes_load_1to8_pq(const void *m)
{
    int64_t word;
    memcpy(&word, m, sizeof word);
    lrb_i64x8 r;
    for (int i = 0; i < 8; i++)
        r.i[i] = word;
    return r;
}

static inline lrb_i64x8 lanes_load_4to8_pq(const void *m)
{
    lrb_i64x8 r;
    memcpy(&r.i[0], m, 32);
    memcpy(&r.i[4], m, 32);
    return r;
}

/* Reads the selected lanes only; the others come from `old`. */
static inline lrb_i64x8 lanes_mask_load_pq(lrb_i64x8 old, uint32_t k, const void *m)
{
    for (int i = 0; i < 8; i++)
        if (k >> i & 1)
            memcpy(&old.i[i], (const char *)m + 8 * i, 8);
    return old;
}

static inline void lanes_store_pq(void *m, lrb_i64x8 a) { memcpy(m, &a, sizeof a); }

/* Writes the selected lanes only. */
static inline void lanes_mask_store_pq(void *m, uint32_t k, lrb_i64x8 a)
{
    for (int i = 0; i < 8; i++)
        if (k >> i & 1)
            memcpy((char *)m + 8 * i, &a.i[i], 8);
}

#include "lrbni/host/double_memory.h"

#endif
