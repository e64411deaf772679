/* What the ops on bits of general registers compute. Positions are signed; -1 says that there is no such bit. */
#ifndef LRBNI_OPS_BITS_H
#define LRBNI_OPS_BITS_H

#include <stdint.h>

/* Lowest set bit of b strictly above position a; a < 0 starts at bit 0. */
static inline uint64_t lrb_bit_above(uint64_t a, uint64_t b)
{
    int64_t position = (int64_t)a;
    if (position >= 63)
        return UINT64_MAX;
    uint64_t rest = position < 0 ? b : b & (~UINT64_C(0) << (position + 1));
    return rest ? (uint64_t)__builtin_ctzll(rest) : UINT64_MAX;
}

/* Highest set bit of b strictly below position a; a > 63 starts at the top. */
static inline uint64_t lrb_bit_below(uint64_t a, uint64_t b)
{
    int64_t position = (int64_t)a;
    if (position <= 0)
        return UINT64_MAX;
    uint64_t rest = position > 63 ? b : b & ~(~UINT64_C(0) << position);
    return rest ? 63 - (uint64_t)__builtin_clzll(rest) : UINT64_MAX;
}

/* Zeros of b from bit a up to its next 1 or to the end; a < 0 starts at bit 0, a > 63 gives 64 (KNCNI). */
static inline uint64_t lrb_zeros_from(uint64_t a, uint64_t b)
{
    int64_t start = (int64_t)a < 0 ? 0 : (int64_t)a;
    if (start > 63)
        return 64;
    uint64_t rest = b >> start;
    return rest ? (uint64_t)__builtin_ctzll(rest) : 64 - (uint64_t)start;
}

/* From bit 0 up: one bit of b, then `of_a` bits of a, and so on. */
static inline uint64_t lrb_interleave(uint64_t a, uint64_t b, unsigned of_a)
{
    uint64_t r = 0;
    for (unsigned at = 0; at < 64; at += 1 + of_a, b >>= 1, a >>= of_a)
        r |= ((b & 1) | (a & ((1u << of_a) - 1)) << 1) << at;
    return r;
}

/* Bits low to high of a rotated left by n, 0 elsewhere. */
static inline uint64_t lrb_field(uint64_t a, unsigned n, unsigned low, unsigned high)
{
    uint64_t rotated = a << n | a >> ((64 - n) & 63);
    return rotated & ~UINT64_C(0) << low & ~UINT64_C(0) >> (63 - high);
}

/* Bit j: whether any of bits 4j to 4j+3 is set; four of them. */
static inline uint64_t lrb_quads(uint64_t a)
{
    return (uint64_t)((a & 0xf) != 0) | (uint64_t)((a & 0xf0) != 0) << 1 | (uint64_t)((a & 0xf00) != 0) << 2 |
           (uint64_t)((a & 0xf000) != 0) << 3;
}

#endif
