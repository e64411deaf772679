/* Integer lanes that every back end makes from its own primitives in the same way. */
#ifndef LRBNI_HOST_COMMON_INTEGER_H
#define LRBNI_HOST_COMMON_INTEGER_H

/* The same word in every lane. */
static inline lrb_i32x16 lanes_all_pi(uint32_t word) { return lanes_load_1to16_pi(&word); }

/* Compares from equal and less. */
static inline uint32_t lanes_cmpneq_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmpeq_pi(a, b) ^ 0xffffu; }
static inline uint32_t lanes_cmpnlt_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pi(a, b) ^ 0xffffu; }
static inline uint32_t lanes_cmpnle_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pi(b, a); }
static inline uint32_t lanes_cmpeq_pu(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmpeq_pi(a, b); }
static inline uint32_t lanes_cmple_pu(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pu(b, a) ^ 0xffffu; }
static inline uint32_t lanes_cmpneq_pu(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmpneq_pi(a, b); }
static inline uint32_t lanes_cmpnlt_pu(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pu(a, b) ^ 0xffffu; }
static inline uint32_t lanes_cmpnle_pu(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmplt_pu(b, a); }
static inline uint32_t lanes_test_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_cmpneq_pi(lanes_and_pi(a, b), lanes_all_pi(0)); }

/* Each lane plus its carry, which is a bit of k: minus -1. `carry` receives those out. */
static inline lrb_i32x16 lanes_adc_pi(lrb_i32x16 a, lrb_i32x16 b, uint32_t k, uint32_t *carry)
{
    lrb_i32x16 sum = lanes_add_pi(a, b);
    lrb_i32x16 r = lanes_sub_pi(sum, lanes_merge_pi(k, lanes_all_pi(0), lanes_all_pi(UINT32_MAX)));
    *carry = lanes_cmplt_pu(sum, a) | lanes_cmplt_pu(r, sum);
    return r;
}

/* The same for a difference and its borrows. */
static inline lrb_i32x16 lanes_sbb_pi(lrb_i32x16 a, lrb_i32x16 b, uint32_t k, uint32_t *borrow)
{
    lrb_i32x16 difference = lanes_sub_pi(a, b);
    lrb_i32x16 r = lanes_add_pi(difference, lanes_merge_pi(k, lanes_all_pi(0), lanes_all_pi(UINT32_MAX)));
    *borrow = lanes_cmplt_pu(a, b) | lanes_cmplt_pu(difference, r);
    return r;
}

static inline lrb_i32x16 lanes_addsets_pi(lrb_i32x16 a, lrb_i32x16 b, uint32_t *sign)
{
    lrb_i32x16 r = lanes_add_pi(a, b);
    *sign = lanes_cmplt_pi(r, lanes_all_pi(0));
    return r;
}

static inline lrb_i32x16 lanes_madd231_pi(lrb_i32x16 d, lrb_i32x16 a, lrb_i32x16 b) { return lanes_add_pi(lanes_mull_pi(a, b), d); }

static inline lrb_i32x16 lanes_clampz_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_max_pi(lanes_min_pi(a, b), lanes_all_pi(0)); }

/* Shifts by an immediate, and by counts modulo 32. */
static inline lrb_i32x16 lanes_slli_pi(lrb_i32x16 a, unsigned n) { return lanes_sllv_pi(a, lanes_all_pi(n)); }
static inline lrb_i32x16 lanes_srli_pi(lrb_i32x16 a, unsigned n) { return lanes_srlv_pi(a, lanes_all_pi(n)); }
static inline lrb_i32x16 lanes_srai_pi(lrb_i32x16 a, unsigned n) { return lanes_srav_pi(a, lanes_all_pi(n)); }
static inline lrb_i32x16 lanes_sll_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_sllv_pi(a, lanes_and_pi(b, lanes_all_pi(31))); }
static inline lrb_i32x16 lanes_srl_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_srlv_pi(a, lanes_and_pi(b, lanes_all_pi(31))); }
static inline lrb_i32x16 lanes_sra_pi(lrb_i32x16 a, lrb_i32x16 b) { return lanes_srav_pi(a, lanes_and_pi(b, lanes_all_pi(31))); }

/* Bits low to high of a rotated left by n, 0 elsewhere; and those bits in place of d's. */
static inline lrb_i32x16 lanes_rotatefield_pi(lrb_i32x16 a, unsigned n, unsigned low, unsigned high)
{
    lrb_i32x16 rotated = lanes_or_pi(lanes_slli_pi(a, n), lanes_srli_pi(a, 32 - n));
    return lanes_and_pi(rotated, lanes_all_pi(UINT32_MAX << low & UINT32_MAX >> (31 - high)));
}

static inline lrb_i32x16 lanes_insertfield_pi(lrb_i32x16 d, lrb_i32x16 a, unsigned n, unsigned low, unsigned high)
{
    lrb_i32x16 field = lanes_all_pi(UINT32_MAX << low & UINT32_MAX >> (31 - high));
    return lanes_or_pi(lanes_andn_pi(field, d), lanes_rotatefield_pi(a, n, low, high));
}

/* Those bits moved up by n. They must be ones that nothing stays on. */
static inline lrb_i32x16 lanes_lift_bits(lrb_i32x16 a, uint32_t bits, unsigned n)
{
    lrb_i32x16 up = lanes_all_pi(bits);
    return lanes_or_pi(lanes_andn_pi(up, a), lanes_slli_pi(lanes_and_pi(a, up), n));
}

/* Bit i moves to 2i, by halves: i has four binary digits, each of them moves the bits that have it by its value. */
static inline lrb_i32x16 lanes_every_second_bit(lrb_i32x16 a)
{
    a = lanes_lift_bits(lanes_and_pi(a, lanes_all_pi(0xffff)), 0xff00, 8);
    a = lanes_lift_bits(a, 0x00f000f0, 4);
    a = lanes_lift_bits(a, 0x0c0c0c0c, 2);
    return lanes_lift_bits(a, 0x22222222, 1);
}

/* Bit i moves to 3i. */
static inline lrb_i32x16 lanes_every_third_bit(lrb_i32x16 a)
{
    a = lanes_lift_bits(lanes_and_pi(a, lanes_all_pi(0x7ff)), 0x00000700, 16);
    a = lanes_lift_bits(a, 0x000000f0, 8);
    a = lanes_lift_bits(a, 0x0400c00c, 4);
    return lanes_lift_bits(a, 0x02082082, 2);
}

/* The pair of bits 2i, 2i+1 moves to 3i, 3i+1. */
static inline lrb_i32x16 lanes_pairs_of_thirds(lrb_i32x16 a)
{
    a = lanes_lift_bits(lanes_and_pi(a, lanes_all_pi(0x003fffff)), 0x003f0000, 8);
    a = lanes_lift_bits(a, 0x0000ff00, 4);
    a = lanes_lift_bits(a, 0x300f00f0, 2);
    return lanes_lift_bits(a, 0x0c30c30c, 1);
}

static inline lrb_i32x16 lanes_bitinterleave11_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return lanes_or_pi(lanes_every_second_bit(b), lanes_slli_pi(lanes_every_second_bit(a), 1));
}

static inline lrb_i32x16 lanes_bitinterleave21_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return lanes_or_pi(lanes_every_third_bit(b), lanes_slli_pi(lanes_pairs_of_thirds(a), 1));
}

/* Logic of 64 bits is that of 32. */
#define LANES_SAME_LOGIC(name)                                                                     \
    static inline lrb_i64x8 lanes_##name##_pq(lrb_i64x8 a, lrb_i64x8 b)                            \
    {                                                                                              \
        return lanes_pq_from_pi(lanes_##name##_pi(lanes_pi_from_pq(a), lanes_pi_from_pq(b)));      \
    }
LANES_SAME_LOGIC(and)
LANES_SAME_LOGIC(or)
LANES_SAME_LOGIC(xor)
LANES_SAME_LOGIC(andn)
#undef LANES_SAME_LOGIC

static inline lrb_i32x16 lanes_shuf128x32_pi(lrb_i32x16 a, unsigned blocks, unsigned words)
{
    return lanes_bits_ps(lanes_shuf128x32_ps(lanes_bits_pi(a), blocks, words));
}

/* Each group's words 1 and 0 as factor and addend. */
static inline lrb_i32x16 lanes_madd233_pi(lrb_i32x16 a, lrb_i32x16 b)
{
    return lanes_madd231_pi(lanes_swizzle_pi(b, 0x00), a, lanes_swizzle_pi(b, 0x55));
}

#endif
