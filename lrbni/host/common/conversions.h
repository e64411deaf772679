/* Conversions of a whole register, from and to `m`, where all its elements are: one loop a format over the function for one
 * lane, of which compilers make vector instructions. A back end that has an instruction for halves defines LANES_HALF first. */
#ifndef LRBNI_HOST_COMMON_CONVERSIONS_H
#define LRBNI_HOST_COMMON_CONVERSIONS_H

#include <stdbool.h>
#include <string.h>

#include "lrbni/conversions.h"

/* LANES_UP(ps, f32x16, float16, 2): lanes_up_ps_float16 */
#define LANES_UP(suffix, vector, id, bytes)                                                        \
    static inline lrb_##vector lanes_up_##suffix##_##id(const void *m)                             \
    {                                                                                              \
        uint32_t lanes[16];                                                                        \
        for (int i = 0; i < 16; i++) {                                                             \
            uint32_t element = 0;                                                                  \
            memcpy(&element, (const unsigned char *)m + (bytes) * i, bytes);                       \
            lanes[i] = lrb_up_##suffix##_##id(element);                                            \
        }                                                                                          \
        return lanes_load_##suffix(lanes);                                                         \
    }

/* LANES_DOWN(ps, f32x16, float16, 2): lanes_down_ps_float16 */
#define LANES_DOWN(suffix, vector, id, bytes)                                                      \
    static inline void lanes_down_##suffix##_##id(void *m, lrb_##vector a)                         \
    {                                                                                              \
        uint32_t lanes[16];                                                                        \
        lanes_store_##suffix(lanes, a);                                                            \
        for (int i = 0; i < 16; i++) {                                                             \
            uint32_t element = lrb_down_##suffix##_##id(lanes[i]);                                 \
            memcpy((unsigned char *)m + (bytes) * i, &element, bytes);                             \
        }                                                                                          \
    }

#define UP_PS(id, bytes, ...) LANES_UP(ps, f32x16, id, bytes)
#define UP_PI(id, bytes, ...) LANES_UP(pi, i32x16, id, bytes)
#define DOWN_PS(id, bytes, ...) LANES_DOWN(ps, f32x16, id, bytes)
#define DOWN_PI(id, bytes, ...) LANES_DOWN(pi, i32x16, id, bytes)
#include "lrbni/conversions.def"
#undef LANES_UP
#undef LANES_DOWN

/* 16 floats from 16 elements at m. */
static inline lrb_f32x16 lanes_up_ps(const void *m, lrb_up_ps up)
{
#ifdef LANES_HALF
    if (up == LRB_UP_PS_float16)
        return lanes_up_half(m);
#endif
    switch (up) {
#define UP_PS(id, ...) case LRB_UP_PS_##id: return lanes_up_ps_##id(m);
#include "lrbni/conversions.def"
    default: return lanes_load_ps(m);
    }
}

static inline lrb_i32x16 lanes_up_pi(const void *m, lrb_up_pi up)
{
    switch (up) {
#define UP_PI(id, ...) case LRB_UP_PI_##id: return lanes_up_pi_##id(m);
#include "lrbni/conversions.def"
    default: return lanes_load_pi(m);
    }
}

static inline lrb_f64x8 lanes_up_pd(const void *m, lrb_up_pd up) { return (void)up, lanes_load_pd(m); }
static inline lrb_i64x8 lanes_up_pq(const void *m, lrb_up_pq up) { return (void)up, lanes_load_pq(m); }

/* 16 elements at m from 16 floats. */
static inline void lanes_down_ps(void *m, lrb_f32x16 a, lrb_down_ps down)
{
#ifdef LANES_HALF
    if (down == LRB_DOWN_PS_float16) {
        lanes_down_half(m, a);
        return;
    }
#endif
    switch (down) {
#define DOWN_PS(id, ...) case LRB_DOWN_PS_##id: lanes_down_ps_##id(m, a); break;
#include "lrbni/conversions.def"
    default: break;
    }
}

/* The same in a rounding mode of the machine. */
static inline void lanes_down_in_mode_ps(void *m, lrb_f32x16 a, lrb_down_ps down, lrb_rounding mode)
{
    const bool looks = down == LRB_DOWN_PS_float16 || down == LRB_DOWN_PS_uint8 || down == LRB_DOWN_PS_sint8 ||
                       down == LRB_DOWN_PS_uint16 || down == LRB_DOWN_PS_sint16;
    if (mode == LRB_RN || !looks) {
        lanes_down_ps(m, a, down);
        return;
    }
    uint32_t lanes[16];
    const unsigned bytes = lrb_down_ps_bytes(down);
    lanes_store_ps(lanes, a);
    for (unsigned i = 0; i < 16; i++) {
        uint32_t element = lrb_down_ps_in_mode(down, lanes[i], mode);
        memcpy((unsigned char *)m + bytes * i, &element, bytes);
    }
}

static inline void lanes_down_pi(void *m, lrb_i32x16 a, lrb_down_pi down)
{
    switch (down) {
#define DOWN_PI(id, ...) case LRB_DOWN_PI_##id: lanes_down_pi_##id(m, a); break;
#include "lrbni/conversions.def"
    default: break;
    }
}

static inline void lanes_down_pd(void *m, lrb_f64x8 a, lrb_down_pd down) { (void)down, lanes_store_pd(m, a); }
static inline void lanes_down_pq(void *m, lrb_i64x8 a, lrb_down_pq down) { (void)down, lanes_store_pq(m, a); }

#endif
