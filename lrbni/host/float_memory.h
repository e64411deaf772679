/* Float loads and stores, as integer ones with the same bits; included by the back ends, which define the latter. */
#ifndef LRBNI_HOST_FLOAT_MEMORY_H
#define LRBNI_HOST_FLOAT_MEMORY_H

static inline lrb_f32x16 lanes_load_ps(const void *m) { return lanes_bits_pi(lanes_load_pi(m)); }
static inline lrb_f32x16 lanes_load_1to16_ps(const void *m) { return lanes_bits_pi(lanes_load_1to16_pi(m)); }
static inline lrb_f32x16 lanes_load_4to16_ps(const void *m) { return lanes_bits_pi(lanes_load_4to16_pi(m)); }
static inline lrb_f32x16 lanes_mask_load_ps(lrb_f32x16 old, uint32_t k, const void *m)
{
    return lanes_bits_pi(lanes_mask_load_pi(lanes_bits_ps(old), k, m));
}
static inline void lanes_store_ps(void *m, lrb_f32x16 a) { lanes_store_pi(m, lanes_bits_ps(a)); }
static inline void lanes_mask_store_ps(void *m, uint32_t k, lrb_f32x16 a) { lanes_mask_store_pi(m, k, lanes_bits_ps(a)); }
static inline lrb_i32x16 lanes_swizzle_pi(lrb_i32x16 a, unsigned words)
{
    return lanes_bits_ps(lanes_swizzle_ps(lanes_bits_pi(a), words));
}

#endif
