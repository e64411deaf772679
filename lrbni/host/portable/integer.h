/* Integer lanes in plain C: products, extremes, shifts, unsigned compare, permutes. */
#ifndef LRBNI_HOST_PORTABLE_INTEGER_H
#define LRBNI_HOST_PORTABLE_INTEGER_H

#include "lrbni/host/portable/lanes.h"

/* LANES_I2(min_pi, a.i[i] < b.i[i] ? a.i[i] : b.i[i]): r.i[i] of every lane; ua, ub are the lanes without sign */
#define LANES_I2(name, expression)                                              \
    static inline lrb_i32x16 lanes_##name(lrb_i32x16 a, lrb_i32x16 b)           \
    {                                                                           \
        lrb_i32x16 r;                                                           \
        for (int i = 0; i < 16; i++) {                                          \
            const uint32_t ua = (uint32_t)a.i[i], ub = (uint32_t)b.i[i];        \
            (void)ua, (void)ub;                                                 \
            r.i[i] = (int32_t)(expression);                                     \
        }                                                                       \
        return r;                                                               \
    }
LANES_I2(mull_pi, ua *ub)
LANES_I2(mulh_pi, ((int64_t)a.i[i] * b.i[i]) >> 32)
LANES_I2(mulh_pu, ((uint64_t)ua * ub) >> 32)
LANES_I2(andn_pi, ~ua &ub)
LANES_I2(min_pi, a.i[i] < b.i[i] ? a.i[i] : b.i[i])
LANES_I2(max_pi, a.i[i] > b.i[i] ? a.i[i] : b.i[i])
LANES_I2(min_pu, ua < ub ? ua : ub)
LANES_I2(max_pu, ua > ub ? ua : ub)
/* Counts are unsigned; above 31 nothing is left but signs. */
LANES_I2(sllv_pi, ub < 32 ? ua << (ub & 31) : 0)
LANES_I2(srlv_pi, ub < 32 ? ua >> (ub & 31) : 0)
LANES_I2(srav_pi, a.i[i] >> (ub < 31 ? ub : 31))
/* Lane a[i] mod 16 of b. */
LANES_I2(permd_pi, b.i[ua & 15])
#undef LANES_I2

static inline uint32_t lanes_cmplt_pu(lrb_i32x16 a, lrb_i32x16 b)
{
    uint32_t k = 0;
    for (int i = 0; i < 16; i++)
        k |= (uint32_t)a.i[i] < (uint32_t)b.i[i] ? lanes_bit[i] : 0;
    return k;
}

/* Lanes n and up of b, then the first n of a; n in 0..15. */
static inline lrb_i32x16 lanes_alignd_pi(lrb_i32x16 a, lrb_i32x16 b, unsigned n)
{
    lrb_i32x16 r;
    for (unsigned i = 0; i < 16; i++)
        r.i[i] = i + n < 16 ? b.i[i + n] : a.i[i + n - 16];
    return r;
}

#endif
