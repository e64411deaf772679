/* Operands to test ops with: a list of boundary bits, a shorter one for triples, masks, and random bits. */
#ifndef TESTS_LRBNI_OPERANDS_H
#define TESTS_LRBNI_OPERANDS_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/base/random.h"

/* Floats at the ends of everything, NaNs of both signs and several payloads; as integers they are as good as any. */
static const uint32_t boundary_bits[] = {
    0x00000000, 0x80000000, /* zeros */
    0x00000001, 0x80000001, 0x007fffff, 0x807fffff, /* smallest and largest subnormals */
    0x00800000, 0x80800000, 0x00800001, 0x00ffffff, /* smallest normals */
    0x3f800000, 0xbf800000, 0x3f800001, 0x3f7fffff, 0xbf7fffff, /* 1, and its neighbours */
    0x3f800800, 0xbf801000, 0x33800000, 0x34000000, /* 1 + 2^-12, -1 - 2^-11, 2^-24, 2^-23 */
    0x4b7fffff, 0x4b800000, 0x4b800001, 0xcb800000, /* around 2^24 */
    0x01000001, 0x40000000, 0x40400000, 0x7e800000, 0x7f000000, /* 2^24 + 1 as an integer; 2, 3, 2^126, 2^127 */
    0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, /* largest, infinite */
    0x7fc00000, 0xffc00000, 0x7fc00011, 0xffc00022, 0x7fffffff, 0xffffffff, /* quiet NaNs */
    0x7f800001, 0xff800001, 0x7f812345, 0x7fbfffff, 0xffbfffff, /* signalling NaNs */
    0x55555555, 0xaaaaaaaa, 0x0000ffff, 0xffff0000,
    0x0000001f, 0x00000020, 0x00000021, 0x0000003f, /* 31, 32, 33, 63: where counts of shifts turn over */
};
enum { BOUNDARY_BITS = sizeof boundary_bits / sizeof boundary_bits[0] };

static const uint32_t triple_bits[] = {
    0x00000000, 0x80000000, 0x00000001, 0x807fffff, 0x00800000, 0x3f800000, 0xbf800000, 0x3f800800, 0xbf801000, 0x40000000,
    0x4b800001, 0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, 0x7fc00011, 0xffc00022, 0x7f800033, 0xffbfffff,
};
enum { TRIPLE_BITS = sizeof triple_bits / sizeof triple_bits[0] };

/* The same kinds of doubles, at the same places of the lists. */
static const uint64_t boundary_bits64[] = {
    0x0000000000000000, 0x8000000000000000, /* zeros */
    0x0000000000000001, 0x8000000000000001, 0x000fffffffffffff, 0x800fffffffffffff, /* smallest and largest subnormals */
    0x0010000000000000, 0x8010000000000000, 0x0010000000000001, 0x001fffffffffffff, /* smallest normals */
    0x3ff0000000000000, 0xbff0000000000000, 0x3ff0000000000001, 0x3fefffffffffffff, 0xbfefffffffffffff, /* 1, and its neighbours */
    0x3ff0000002000000, 0xbff0000004000000, 0x3ca0000000000000, 0x3cb0000000000000, /* 1 + 2^-27, -1 - 2^-26, 2^-53, 2^-52 */
    0x433fffffffffffff, 0x4340000000000000, 0x4340000000000001, 0xc340000000000000, /* around 2^53 */
    0x0020000000000001, 0x4000000000000000, 0x4008000000000000, 0x7fd0000000000000, 0x7fe0000000000000, /* 2^53 + 1 as an integer; 2, 3, 2^1022, 2^1023 */
    0x7fefffffffffffff, 0xffefffffffffffff, 0x7ff0000000000000, 0xfff0000000000000, /* largest, infinite */
    0x7ff8000000000000, 0xfff8000000000000, 0x7ff8000000000011, 0xfff8000000000022, 0x7fffffffffffffff, 0xffffffffffffffff, /* quiet NaNs */
    0x7ff0000000000001, 0xfff0000000000001, 0x7ff0000012345678, 0x7ff7ffffffffffff, 0xfff7ffffffffffff, /* signalling NaNs */
    0x5555555555555555, 0xaaaaaaaaaaaaaaaa, 0x00000000ffffffff, 0xffffffff00000000,
    0x000000000000001f, 0x0000000000000020, 0x0000002100000021, 0x0000003f0000003f,
};

static const uint64_t triple_bits64[] = {
    0x0000000000000000, 0x8000000000000000, 0x0000000000000001, 0x800fffffffffffff, 0x0010000000000000, 0x3ff0000000000000,
    0xbff0000000000000, 0x3ff0000002000000, 0xbff0000004000000, 0x4000000000000000, 0x4340000000000001, 0x7fefffffffffffff,
    0xffefffffffffffff, 0x7ff0000000000000, 0xfff0000000000000, 0x7ff8000000000011, 0xfff8000000000022, 0x7ff0000000000033,
    0xfff7ffffffffffff,
};
_Static_assert(sizeof boundary_bits64 == 2 * sizeof boundary_bits, "the lists go together");
_Static_assert(sizeof triple_bits64 == 2 * sizeof triple_bits, "the lists go together");

/** Entry `number` of the lists, as a lane of 64 bits (`wide`) or of 32. */
static inline uint64_t boundary_lane(bool wide, int number) { return wide ? boundary_bits64[number] : boundary_bits[number]; }
static inline uint64_t triple_lane(bool wide, int number) { return wide ? triple_bits64[number] : triple_bits[number]; }

/* Masks tried with every vector of operands; the 16 single bits come on top. */
static const uint32_t some_masks[] = {0x0000, 0xffff, 0x5555, 0x00ff};
enum { SOME_MASKS = sizeof some_masks / sizeof some_masks[0], MASKS = SOME_MASKS + 16 + 1 };

/** Mask `number` of MASKS: those above, single bits, and a random one. */
static inline uint32_t mask_number(int number, base_random *random)
{
    if (number < SOME_MASKS)
        return some_masks[number];
    return number < SOME_MASKS + 16 ? 1u << (number - SOME_MASKS) : (uint32_t)base_random_bits(random) & 0xffffu;
}

/** Random bits that are uniform in half the cases; else a float near 1 or near another, so that sums cancel and tie. */
static inline uint32_t random_bits(base_random *random)
{
    uint64_t bits = base_random_bits(random);
    uint32_t word = (uint32_t)bits;
    switch (bits >> 60) {
    case 0:
        return boundary_bits[word % BOUNDARY_BITS];
    case 1:
    case 2:
        return (word & 0x80000fff) | 0x3f800000; /* 1 + a little */
    case 3:
    case 4:
        return (word & 0x807ff000) | (120 + (word & 15)) << 23; /* few bits, near 1 */
    case 5:
        return word & 0x81ffffff; /* subnormal or close */
    case 6:
        return (word & 0x81ffffff) | 0x7e000000; /* huge, infinite or NaN */
    default:
        return word;
    }
}

/** The same for doubles. */
static inline uint64_t random_bits64(base_random *random)
{
    uint64_t kind = base_random_bits(random), bits = base_random_bits(random);
    switch (kind >> 60) {
    case 0:
        return boundary_bits64[bits % BOUNDARY_BITS];
    case 1:
    case 2:
        return (bits & 0x8000000000000fff) | 0x3ff0000000000000; /* 1 + a little */
    case 3:
    case 4:
        return (bits & 0x800fffff00000000) | (1016 + (bits & 15)) << 52; /* few bits, near 1 */
    case 5:
        return bits & 0x803fffffffffffff; /* subnormal or close */
    case 6:
        return (bits & 0x803fffffffffffff) | 0x7fc0000000000000; /* huge, infinite or NaN */
    default:
        return bits;
    }
}

static inline uint64_t random_lane(bool wide, base_random *random)
{
    return wide ? random_bits64(random) : random_bits(random);
}

#endif
