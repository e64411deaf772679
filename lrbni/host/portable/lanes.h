/* Sixteen lanes in plain C: the reference that the other back ends match bit for bit. */
#ifndef LRBNI_HOST_PORTABLE_LANES_H
#define LRBNI_HOST_PORTABLE_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "lrbni/numeric.h"

#define LRB_BACKEND "portable"

typedef struct lrb_f32x16 {
    float f[16];
} lrb_f32x16;

typedef struct lrb_i32x16 {
    int32_t i[16];
} lrb_i32x16;

static inline lrb_f32x16 lanes_rcpres_ps(lrb_f32x16 a)
{
    lrb_f32x16 r;
    for (int i = 0; i < 16; i++)
        r.f[i] = lrb_f32_rcpres(a.f[i]);
    return r;
}

/* LANES_I2(add, +): r.i[i] = a.i[i] + b.i[i] mod 2^32 */
#define LANES_I2(name, operator)                                                        \
    static inline lrb_i32x16 lanes_##name##_pi(lrb_i32x16 a, lrb_i32x16 b)              \
    {                                                                                   \
        lrb_i32x16 r;                                                                   \
        for (int i = 0; i < 16; i++)                                                    \
            r.i[i] = (int32_t)((uint32_t)a.i[i] operator (uint32_t) b.i[i]);            \
        return r;                                                                       \
    }
LANES_I2(add, +)
LANES_I2(sub, -)
LANES_I2(and, &)
LANES_I2(or, |)
LANES_I2(xor, ^)
#undef LANES_I2

static const uint32_t lanes_bit[16] = {0x0001, 0x0002, 0x0004, 0x0008, 0x0010, 0x0020, 0x0040, 0x0080,
                                       0x0100, 0x0200, 0x0400, 0x0800, 0x1000, 0x2000, 0x4000, 0x8000};

/* LANES_CMP(cmplt_pi, i32, a.i[i] < b.i[i]): bit i of the result */
#define LANES_CMP(name, type, condition)                                       \
    static inline uint32_t lanes_##name(lrb_##type##x16 a, lrb_##type##x16 b)  \
    {                                                                          \
        uint32_t k = 0;                                                        \
        for (int i = 0; i < 16; i++)                                           \
            k |= (condition) ? lanes_bit[i] : 0;                               \
        return k;                                                              \
    }
LANES_CMP(cmpeq_pi, i32, a.i[i] == b.i[i])
LANES_CMP(cmplt_pi, i32, a.i[i] < b.i[i])
LANES_CMP(cmple_pi, i32, a.i[i] <= b.i[i])
#undef LANES_CMP

/* The merge rule: lane i of `new` where bit i of k is 1, of `old` elsewhere. */
static inline lrb_i32x16 lanes_merge_pi(uint32_t k, lrb_i32x16 old, lrb_i32x16 new_lanes)
{
    lrb_i32x16 r;
    for (int i = 0; i < 16; i++)
        r.i[i] = k & lanes_bit[i] ? new_lanes.i[i] : old.i[i];
    return r;
}

static inline lrb_i32x16 lanes_bits_ps(lrb_f32x16 a)
{
    lrb_i32x16 r;
    memcpy(&r, &a, sizeof r);
    return r;
}

static inline lrb_f32x16 lanes_bits_pi(lrb_i32x16 a)
{
    lrb_f32x16 r;
    memcpy(&r, &a, sizeof r);
    return r;
}

static inline lrb_f32x16 lanes_merge_ps(uint32_t k, lrb_f32x16 old, lrb_f32x16 new_lanes)
{
    return lanes_bits_pi(lanes_merge_pi(k, lanes_bits_ps(old), lanes_bits_ps(new_lanes)));
}

/* Lane 4g+j of the result is lane 4g + word j of the source; `words` holds two bits per j, lowest first. */
static inline lrb_f32x16 lanes_swizzle_ps(lrb_f32x16 a, unsigned words)
{
    lrb_f32x16 r;
    for (unsigned g = 0; g < 4; g++)
        for (unsigned j = 0; j < 4; j++)
            r.f[4 * g + j] = a.f[4 * g + (words >> (2 * j) & 3)];
    return r;
}

static inline lrb_f32x16 lanes_shuf128x32_ps(lrb_f32x16 a, unsigned blocks, unsigned words)
{
    lrb_f32x16 r;
    for (unsigned g = 0; g < 4; g++)
        for (unsigned j = 0; j < 4; j++)
            r.f[4 * g + j] = a.f[4 * (blocks >> (2 * g) & 3) + (words >> (2 * j) & 3)];
    return r;
}

static inline lrb_i32x16 lanes_load_pi(const void *m)
{
    lrb_i32x16 r;
    memcpy(&r, m, sizeof r);
    return r;
}

static inline lrb_i32x16 lanes_load_1to16_pi(const void *m)
{
    int32_t word;
    memcpy(&word, m, sizeof word);
    lrb_i32x16 r;
    for (int i = 0; i < 16; i++)
        r.i[i] = word;
    return r;
}

static inline lrb_i32x16 lanes_load_4to16_pi(const void *m)
{
    lrb_i32x16 r;
    for (int i = 0; i < 16; i += 4)
        memcpy(&r.i[i], m, 16);
    return r;
}

/* Reads the selected lanes only; the others come from `old`. */
static inline lrb_i32x16 lanes_mask_load_pi(lrb_i32x16 old, uint32_t k, const void *m)
{
    for (int i = 0; i < 16; i++)
        if (k >> i & 1)
            memcpy(&old.i[i], (const char *)m + 4 * i, 4);
    return old;
}

static inline void lanes_store_pi(void *m, lrb_i32x16 a) { memcpy(m, &a, sizeof a); }

/* Writes the selected lanes only. */
static inline void lanes_mask_store_pi(void *m, uint32_t k, lrb_i32x16 a)
{
    for (int i = 0; i < 16; i++)
        if (k >> i & 1)
            memcpy((char *)m + 4 * i, &a.i[i], 4);
}

#include "lrbni/host/float_memory.h"

#endif
