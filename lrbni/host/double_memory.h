/* What 8 doubles share with 8 integers of the same bits; included by the back ends, which define the latter. */
#ifndef LRBNI_HOST_DOUBLE_MEMORY_H
#define LRBNI_HOST_DOUBLE_MEMORY_H

static inline lrb_f64x8 lanes_load_pd(const void *m) { return lanes_bits_pq(lanes_load_pq(m)); }
static inline lrb_f64x8 lanes_load_1to8_pd(const void *m) { return lanes_bits_pq(lanes_load_1to8_pq(m)); }
static inline lrb_f64x8 lanes_load_4to8_pd(const void *m) { return lanes_bits_pq(lanes_load_4to8_pq(m)); }
static inline lrb_f64x8 lanes_mask_load_pd(lrb_f64x8 old, uint32_t k, const void *m)
{
    return lanes_bits_pq(lanes_mask_load_pq(lanes_bits_pd(old), k, m));
}
static inline void lanes_store_pd(void *m, lrb_f64x8 a) { lanes_store_pq(m, lanes_bits_pd(a)); }
static inline void lanes_mask_store_pd(void *m, uint32_t k, lrb_f64x8 a) { lanes_mask_store_pq(m, k, lanes_bits_pd(a)); }
static inline lrb_f64x8 lanes_merge_pd(uint32_t k, lrb_f64x8 old, lrb_f64x8 new_lanes)
{
    return lanes_bits_pq(lanes_merge_pq(k, lanes_bits_pd(old), lanes_bits_pd(new_lanes)));
}
static inline lrb_f64x8 lanes_swizzle_pd(lrb_f64x8 a, unsigned words)
{
    return lanes_bits_pq(lanes_swizzle_pq(lanes_bits_pd(a), words));
}

#endif
