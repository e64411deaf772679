/* SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators"): the one source of
   pseudo-random numbers in scenes and tests, so that a seed means the same on every host. */
#ifndef LRBNI_BASE_RANDOM_H
#define LRBNI_BASE_RANDOM_H

#include <stdint.h>

typedef struct base_random {
    uint64_t state; /* any value is a good seed */
} base_random;

/** Next 64 random bits. */
static inline uint64_t base_random_bits(base_random *r)
{
    uint64_t z = (r->state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/** Uniform double in [0, 1), a multiple of 2^-53. */
static inline double base_random_unit(base_random *r)
{
    return (double)(base_random_bits(r) >> 11) * 0x1p-53;
}

/** Uniform double in [low, high). */
static inline double base_random_range(base_random *r, double low, double high)
{
    return low + (high - low) * base_random_unit(r);
}

#endif
