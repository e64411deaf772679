/* Memory formats of vector loads and stores: what one lane becomes on its way from memory and to memory.
 *
 * Every function is exact, or rounds once, by integers and by IEEE operations on floats and doubles alone: no library
 * function, so equal on every host. Lanes and elements are passed as their bits; an element's upper bits are 0.
 */
#ifndef LRBNI_CONVERSIONS_H
#define LRBNI_CONVERSIONS_H

#include "lrbni/numeric.h"
#include "lrbni/op_table.h"
#include "lrbni/rounding.h"
#include "lrbni/srgb8_decode.h"

/* What loads convert from: LRB_UP_PS_none, LRB_UP_PS_float16, ..., LRB_UP_PI_none, ... */
#define UP_PS(id, ...) LRB_UP_PS_##id,
typedef enum lrb_up_ps {
#include "lrbni/conversions.def"
    LRB_UP_PS_COUNT
} lrb_up_ps;
#define UP_PI(id, ...) LRB_UP_PI_##id,
typedef enum lrb_up_pi {
#include "lrbni/conversions.def"
    LRB_UP_PI_COUNT
} lrb_up_pi;
#define UP_PD(id, ...) LRB_UP_PD_##id,
typedef enum lrb_up_pd {
#include "lrbni/conversions.def"
    LRB_UP_PD_COUNT
} lrb_up_pd;
#define UP_PQ(id, ...) LRB_UP_PQ_##id,
typedef enum lrb_up_pq {
#include "lrbni/conversions.def"
    LRB_UP_PQ_COUNT
} lrb_up_pq;

/* And what stores convert to. */
#define DOWN_PS(id, ...) LRB_DOWN_PS_##id,
typedef enum lrb_down_ps {
#include "lrbni/conversions.def"
    LRB_DOWN_PS_COUNT
} lrb_down_ps;
#define DOWN_PI(id, ...) LRB_DOWN_PI_##id,
typedef enum lrb_down_pi {
#include "lrbni/conversions.def"
    LRB_DOWN_PI_COUNT
} lrb_down_pi;
#define DOWN_PD(id, ...) LRB_DOWN_PD_##id,
typedef enum lrb_down_pd {
#include "lrbni/conversions.def"
    LRB_DOWN_PD_COUNT
} lrb_down_pd;
#define DOWN_PQ(id, ...) LRB_DOWN_PQ_##id,
typedef enum lrb_down_pq {
#include "lrbni/conversions.def"
    LRB_DOWN_PQ_COUNT
} lrb_down_pq;

/* A row of conversions.def. */
typedef struct lrb_conversion {
    const char *lanes; /* "ps", "pi", "pd", "pq" */
    const char *id;
    unsigned bytes; /* of an element in memory */
    lrb_chips chips, s3; /* s3 of stores: LRB_CHIPS_NONE */
    const char *source, *formula;
} lrb_conversion;

/** Bytes of an element in memory. */
static inline unsigned lrb_up_ps_bytes(lrb_up_ps up)
{
    switch (up) {
#define UP_PS(id, bytes, ...) case LRB_UP_PS_##id: return bytes;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

static inline unsigned lrb_up_pi_bytes(lrb_up_pi up)
{
    switch (up) {
#define UP_PI(id, bytes, ...) case LRB_UP_PI_##id: return bytes;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

static inline unsigned lrb_up_pd_bytes(lrb_up_pd up) { return (void)up, 8; }
static inline unsigned lrb_up_pq_bytes(lrb_up_pq up) { return (void)up, 8; }

static inline unsigned lrb_down_ps_bytes(lrb_down_ps down)
{
    switch (down) {
#define DOWN_PS(id, bytes, ...) case LRB_DOWN_PS_##id: return bytes;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

static inline unsigned lrb_down_pi_bytes(lrb_down_pi down)
{
    switch (down) {
#define DOWN_PI(id, bytes, ...) case LRB_DOWN_PI_##id: return bytes;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

static inline unsigned lrb_down_pd_bytes(lrb_down_pd down) { return (void)down, 8; }
static inline unsigned lrb_down_pq_bytes(lrb_down_pq down) { return (void)down, 8; }

/** Whether an arithmetic op of some chip takes it as its last source. */
static inline int lrb_up_ps_in_s3(lrb_up_ps up)
{
    switch (up) {
#define UP_PS(id, bytes, chips, s3, ...) case LRB_UP_PS_##id: return LRB_CHIPS_##s3 != LRB_CHIPS_NONE;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

static inline int lrb_up_pi_in_s3(lrb_up_pi up)
{
    switch (up) {
#define UP_PI(id, bytes, chips, s3, ...) case LRB_UP_PI_##id: return LRB_CHIPS_##s3 != LRB_CHIPS_NONE;
#include "lrbni/conversions.def"
    default: return 0;
    }
}

/** The rows by their enumerators: first of floats, then of integers, doubles and 64-bit integers. */
extern const lrb_conversion lrb_ups[LRB_UP_PS_COUNT + LRB_UP_PI_COUNT + LRB_UP_PD_COUNT + LRB_UP_PQ_COUNT];
extern const lrb_conversion lrb_downs[LRB_DOWN_PS_COUNT + LRB_DOWN_PI_COUNT + LRB_DOWN_PD_COUNT + LRB_DOWN_PQ_COUNT];

/* Floats of 5 exponent bits and fewer mantissa bits, without the sign: a NaN keeps its payload and becomes quiet. */
static inline uint32_t lrb_up_small_float(uint32_t bits, unsigned mantissa_bits)
{
    const uint32_t exponent = bits >> mantissa_bits, mantissa = bits & ((1u << mantissa_bits) - 1);
    const float unit = lrb_bits_float((127 - 14 - mantissa_bits) << 23); /* of subnormals; the product is exact */
    const uint32_t widened = mantissa << (23 - mantissa_bits);
    const uint32_t infinite = UINT32_C(0x7f800000) | widened | (mantissa ? LRB_NAN_QUIET : 0);
    const uint32_t finite = exponent ? (exponent + 127 - 15) << 23 | widened : lrb_float_bits((float)(int)mantissa * unit);
    return exponent == 31 ? infinite : finite;
}

static inline uint32_t lrb_up_ps_none(uint32_t m) { return m; }
static inline uint32_t lrb_up_ps_float16(uint32_t m) { return (m & 0x8000u) << 16 | lrb_up_small_float(m & 0x7fffu, 10); }
static inline uint32_t lrb_up_ps_srgb8(uint32_t m) { return lrb_srgb8_bits[m]; }
static inline uint32_t lrb_up_ps_uint8(uint32_t m) { return lrb_float_bits((float)(int)m); }
static inline uint32_t lrb_up_ps_sint8(uint32_t m) { return lrb_float_bits((float)(int8_t)m); }
static inline uint32_t lrb_up_ps_uint16(uint32_t m) { return lrb_float_bits((float)(int)m); }
static inline uint32_t lrb_up_ps_sint16(uint32_t m) { return lrb_float_bits((float)(int16_t)m); }

/* Norms: the quotient of two integers that are floats, rounded once. */
static inline uint32_t lrb_up_norm(int32_t m, int32_t one) { return lrb_float_bits((float)(m < -one ? -one : m) / (float)one); }
static inline uint32_t lrb_up_ps_unorm8(uint32_t m) { return lrb_up_norm((int32_t)m, 255); }
static inline uint32_t lrb_up_ps_snorm8(uint32_t m) { return lrb_up_norm((int8_t)m, 127); }
static inline uint32_t lrb_up_ps_unorm16(uint32_t m) { return lrb_up_norm((int32_t)m, 65535); }
static inline uint32_t lrb_up_ps_snorm16(uint32_t m) { return lrb_up_norm((int16_t)m, 32767); }

/* Fields of a word of 10, 10, 10 and 2 bits, and of 11, 11 and 10 bits; the first field is the lowest, as in Direct3D. */
static inline uint32_t lrb_up_ps_unorm10a(uint32_t m) { return lrb_up_norm((int32_t)(m & 0x3ff), 1023); }
static inline uint32_t lrb_up_ps_unorm10b(uint32_t m) { return lrb_up_norm((int32_t)(m >> 10 & 0x3ff), 1023); }
static inline uint32_t lrb_up_ps_unorm10c(uint32_t m) { return lrb_up_norm((int32_t)(m >> 20 & 0x3ff), 1023); }
static inline uint32_t lrb_up_ps_unorm2d(uint32_t m) { return lrb_up_norm((int32_t)(m >> 30), 3); }
static inline uint32_t lrb_up_ps_float11a(uint32_t m) { return lrb_up_small_float(m & 0x7ff, 6); }
static inline uint32_t lrb_up_ps_float11b(uint32_t m) { return lrb_up_small_float(m >> 11 & 0x7ff, 6); }
static inline uint32_t lrb_up_ps_float10c(uint32_t m) { return lrb_up_small_float(m >> 22, 5); }

static inline uint32_t lrb_up_pi_none(uint32_t m) { return m; }
static inline uint32_t lrb_up_pi_uint8(uint32_t m) { return m; }
static inline uint32_t lrb_up_pi_sint8(uint32_t m) { return (uint32_t)(int8_t)m; }
static inline uint32_t lrb_up_pi_uint16(uint32_t m) { return m; }
static inline uint32_t lrb_up_pi_sint16(uint32_t m) { return (uint32_t)(int16_t)m; }

/* The half of a float, without its sign: to nearest even, towards zero, or away from it. */
typedef enum lrb_half_rounding { LRB_HALF_NEAREST, LRB_HALF_TO_ZERO, LRB_HALF_AWAY } lrb_half_rounding;

static inline uint32_t lrb_down_half(uint32_t bits, lrb_half_rounding rounding)
{
    const uint32_t hidden = UINT32_C(0x00800000), exponent = bits >> 23;
    const uint32_t significand = exponent ? (bits & (hidden - 1)) | hidden : bits;
    const uint32_t distance = 126 - exponent; /* a subnormal half counts units of 2^-24 */
    const int subnormal = exponent < 127 - 14;
    const uint32_t shift = !subnormal ? 13 : distance > 31 ? 31 : distance;
    const uint32_t value = subnormal ? significand : bits - ((127 - 15) << 23);
    const uint32_t up = rounding == LRB_HALF_NEAREST ? (1u << (shift - 1)) - 1 + (value >> shift & 1)
                        : rounding == LRB_HALF_AWAY  ? (1u << shift) - 1
                                                     : 0;
    const uint32_t finite = bits >= UINT32_C(0x47800000) ? (rounding == LRB_HALF_TO_ZERO ? 0x7bff : 0x7c00) /* from 2^16 on */
                                                         : (value + up) >> shift;
    if (bits < UINT32_C(0x7f800000))
        return finite;
    return bits == UINT32_C(0x7f800000) ? 0x7c00 : 0x7e00 | (bits >> 13 & 0x3ff);
}

static inline uint32_t lrb_down_signed_half(uint32_t a, lrb_half_rounding rounding)
{
    return (a >> 16 & 0x8000u) | lrb_down_half(a & 0x7fffffffu, rounding);
}

static inline uint32_t lrb_down_ps_none(uint32_t a) { return a; }
static inline uint32_t lrb_down_ps_float16(uint32_t a) { return lrb_down_signed_half(a, LRB_HALF_NEAREST); }
static inline uint32_t lrb_down_ps_float16_rz(uint32_t a) { return lrb_down_signed_half(a, LRB_HALF_TO_ZERO); }

/* To nearest even, within [least, most], which fit in 22 bits; 0 of a NaN. Adding 1.5 * 2^23 leaves no bit behind the point. */
static inline uint32_t lrb_down_integer(uint32_t a, float least, float most)
{
    const float x = lrb_bits_float(a), shift = 12582912.0f;
    const float inside = x > most ? most : x < least ? least : x == x ? x : 0.0f;
    return lrb_float_bits(inside + shift) - lrb_float_bits(shift);
}

static inline uint32_t lrb_down_ps_uint8(uint32_t a) { return lrb_down_integer(a, 0.0f, 255.0f); }
static inline uint32_t lrb_down_ps_sint8(uint32_t a) { return lrb_down_integer(a, -128.0f, 127.0f) & 0xff; }
static inline uint32_t lrb_down_ps_uint16(uint32_t a) { return lrb_down_integer(a, 0.0f, 65535.0f); }
static inline uint32_t lrb_down_ps_sint16(uint32_t a) { return lrb_down_integer(a, -32768.0f, 32767.0f) & 0xffff; }

/* a * one to nearest, halves away from zero, a within [least, 1]; 0 of a NaN. In double the product is exact, and so is the
 * sum wherever it could reach the next integer. */
static inline uint32_t lrb_down_norm(uint32_t a, double least, double one)
{
    const double x = (double)lrb_bits_float(a);
    const double product = (x > 1.0 ? 1.0 : x < least ? least : x == x ? x : 0.0) * one;
    return (uint32_t)(int32_t)(product < 0.0 ? product - 0.5 : product + 0.5);
}

static inline uint32_t lrb_down_ps_unorm8(uint32_t a) { return lrb_down_norm(a, 0.0, 255.0); }
static inline uint32_t lrb_down_ps_snorm8(uint32_t a) { return lrb_down_norm(a, -1.0, 127.0) & 0xff; }
static inline uint32_t lrb_down_ps_unorm16(uint32_t a) { return lrb_down_norm(a, 0.0, 65535.0); }
static inline uint32_t lrb_down_ps_snorm16(uint32_t a) { return lrb_down_norm(a, -1.0, 32767.0) & 0xffff; }

/** The same in another rounding mode of the machine, for the formats that look at it: halves and integers. */
static inline uint32_t lrb_down_ps_in_mode(lrb_down_ps down, uint32_t a, lrb_rounding mode)
{
    const float least = down == LRB_DOWN_PS_sint8 ? -128.0f : down == LRB_DOWN_PS_sint16 ? -32768.0f : 0.0f;
    const float most = down == LRB_DOWN_PS_uint8    ? 255.0f
                       : down == LRB_DOWN_PS_sint8  ? 127.0f
                       : down == LRB_DOWN_PS_uint16 ? 65535.0f
                                                    : 32767.0f;
    const double whole = lrb_whole((double)lrb_bits_float(a), mode);
    const int32_t integer = whole > (double)most ? (int32_t)most : whole < (double)least ? (int32_t)least : whole == whole ? (int32_t)whole : 0;
    if (down == LRB_DOWN_PS_float16)
        return lrb_down_signed_half(a, mode == LRB_RN                          ? LRB_HALF_NEAREST
                                       : mode == (a >> 31 ? LRB_RD : LRB_RU) ? LRB_HALF_AWAY
                                                                              : LRB_HALF_TO_ZERO);
    return (uint32_t)integer;
}

static inline uint32_t lrb_saturate(uint32_t a, int32_t least, int32_t most)
{
    const int32_t x = (int32_t)a;
    return (uint32_t)(x < least ? least : x > most ? most : x);
}

static inline uint32_t lrb_down_pi_none(uint32_t a) { return a; }
static inline uint32_t lrb_down_pi_uint8(uint32_t a) { return a & 0xff; }
static inline uint32_t lrb_down_pi_sint8(uint32_t a) { return lrb_saturate(a, -128, 127) & 0xff; }
static inline uint32_t lrb_down_pi_uint16(uint32_t a) { return a & 0xffff; }
static inline uint32_t lrb_down_pi_sint16(uint32_t a) { return lrb_saturate(a, -32768, 32767) & 0xffff; }

#endif
