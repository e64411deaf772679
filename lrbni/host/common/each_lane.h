/* Conversions, exponents and transcendentals lane after lane, by the scalar functions: what a back end has that knows no
 * instruction for them. lanes_each_X is the reference of lanes_X. Included by the back ends, which define loads and stores.
 */
#ifndef LRBNI_HOST_COMMON_EACH_LANE_H
#define LRBNI_HOST_COMMON_EACH_LANE_H

#include "lrbni/convert.h"
#include "lrbni/exponent.h"
#include "lrbni/transcendental.h"

#define LANES_TYPE_ps lrb_f32x16
#define LANES_TYPE_pi lrb_i32x16
#define LANES_TYPE_pd lrb_f64x8
#define LANES_TYPE_pq lrb_i64x8

/* What comes after the vectors among the parameters: immediates. */
#define LANES_NONE
#define LANES_MODE , lrb_rounding mode
#define LANES_FIXED , lrb_rounding mode, lrb_adjust adjust
#define LANES_MANTISSA , lrb_mantissa interval, lrb_mantissa_sign sign
#define LANES_FIELD , unsigned field

/* Shared loops are functions, not inlined: no kernel should grow by one for each use. */
#define LANES_SHARED static __attribute__((noinline, unused))

/* LANES_EACH(cvtps2pi, pi, int32_t, ps, float, LANES_FIXED, lrb_cvt_f32_i32(b[i], mode, adjust)): lane i of the result from
 * lane i of the source, as far as both go; lanes beyond are 0 */
#define LANES_EACH(name, to_suffix, to, from_suffix, from, immediates, result)                                \
    LANES_SHARED LANES_TYPE_##to_suffix lanes_each_##name(LANES_TYPE_##from_suffix source immediates)         \
    {                                                                                                         \
        enum { FROM = 64 / sizeof(from), TO = 64 / sizeof(to), LANES = FROM < TO ? FROM : TO };               \
        from b[FROM];                                                                                         \
        to r[TO] = {0};                                                                                       \
        lanes_store_##from_suffix(b, source);                                                                 \
        for (int i = 0; i < LANES; i++)                                                                       \
            r[i] = result;                                                                                    \
        return lanes_load_##to_suffix(r);                                                                     \
    }
LANES_EACH(cvtps2pi, pi, int32_t, ps, float, LANES_FIXED, lrb_cvt_f32_i32(b[i], mode, adjust))
LANES_EACH(cvtps2pu, pi, uint32_t, ps, float, LANES_FIXED, lrb_cvt_f32_u32(b[i], mode, adjust))
LANES_EACH(cvtpi2ps, ps, float, pi, int32_t, LANES_FIXED, lrb_cvt_i32_f32(b[i], mode, adjust))
LANES_EACH(cvtpu2ps, ps, float, pi, uint32_t, LANES_FIXED, lrb_cvt_u32_f32(b[i], mode, adjust))
LANES_EACH(cvtpd2ps, ps, float, pd, double, LANES_MODE, lrb_float_of_double(b[i], mode))
LANES_EACH(cvtpd2pi, pi, int32_t, pd, double, LANES_MODE, lrb_cvt_f64_i32(b[i], mode))
LANES_EACH(cvtpd2pu, pi, uint32_t, pd, double, LANES_MODE, lrb_cvt_f64_u32(b[i], mode))
LANES_EACH(cvtps2pd, pd, double, ps, float, LANES_NONE, lrb_double_of_float(b[i]))
LANES_EACH(cvtpi2pd, pd, double, pi, int32_t, LANES_NONE, (double)b[i])
LANES_EACH(cvtpu2pd, pd, double, pi, uint32_t, LANES_NONE, (double)b[i])
LANES_EACH(cvtps2srgb8, pi, int32_t, ps, float, LANES_NONE, lrb_cvt_f32_srgb8(b[i]))
LANES_EACH(round_ps, ps, float, ps, float, LANES_FIXED, lrb_f32_round(b[i], mode, adjust))
LANES_EACH(round_pd, pd, double, pd, double, LANES_FIXED, lrb_f64_round(b[i], mode, adjust))
LANES_EACH(getexp_ps, ps, float, ps, float, LANES_NONE, lrb_f32_getexp(b[i]))
LANES_EACH(getexp_pd, pd, double, pd, double, LANES_NONE, lrb_f64_getexp(b[i]))
LANES_EACH(getmant_ps, ps, float, ps, float, LANES_MANTISSA, lrb_f32_getmant(b[i], interval, sign))
LANES_EACH(getmant_pd, pd, double, pd, double, LANES_MANTISSA, lrb_f64_getmant(b[i], interval, sign))
LANES_EACH(exp223_ps, ps, float, pi, int32_t, LANES_NONE, lrb_f32_exp223(b[i]))
LANES_EACH(log2_ps, ps, float, ps, float, LANES_NONE, lrb_f32_log2(b[i]))
LANES_EACH(rcp23_ps, ps, float, ps, float, LANES_NONE, lrb_f32_rcp23(b[i]))
LANES_EACH(rsqrt23_ps, ps, float, ps, float, LANES_NONE, lrb_f32_rsqrt23(b[i]))
LANES_EACH(exp2lut_ps, ps, float, ps, float, LANES_NONE, lrb_f32_exp2lut(b[i]))
LANES_EACH(log2lut_ps, ps, float, ps, float, LANES_NONE, lrb_f32_log2lut(b[i]))
LANES_EACH(rsqrtlut_ps, ps, float, ps, float, LANES_NONE, lrb_f32_rsqrtlut(b[i]))
#undef LANES_EACH

/* LANES_EACH2(scale_ps, ps, float, ps, float, pi, int32_t, LANES_NONE, lrb_f32_scale(a[i], b[i])): the same from two sources */
#define LANES_EACH2(name, to_suffix, to, first_suffix, first_type, last_suffix, last_type, immediates, result) \
    LANES_SHARED LANES_TYPE_##to_suffix lanes_each_##name(LANES_TYPE_##first_suffix first, LANES_TYPE_##last_suffix last immediates) \
    {                                                                                                         \
        enum { LANES = 64 / sizeof(to) };                                                                     \
        first_type a[LANES];                                                                                  \
        last_type b[LANES];                                                                                   \
        to r[LANES];                                                                                          \
        lanes_store_##first_suffix(a, first);                                                                 \
        lanes_store_##last_suffix(b, last);                                                                   \
        for (int i = 0; i < LANES; i++)                                                                       \
            r[i] = result;                                                                                    \
        return lanes_load_##to_suffix(r);                                                                     \
    }
LANES_EACH2(scale_ps, ps, float, ps, float, pi, int32_t, LANES_NONE, lrb_f32_scale(a[i], b[i]))
LANES_EACH2(cvtinsps2u10, pi, uint32_t, pi, uint32_t, ps, float, LANES_FIELD, lrb_insert_u10(a[i], b[i], field))
LANES_EACH2(cvtinsps2f11, pi, uint32_t, pi, uint32_t, ps, float, LANES_FIELD, lrb_insert_f11(a[i], b[i], field))
#undef LANES_EACH2

/* LANES_FIX(fixupnan_pd, pd, double, pq, uint64_t, lrb_f64_fixupnan): the old destination, a source, and a table in each lane */
#define LANES_FIX(name, suffix, type, table_suffix, table_type, function)                                     \
    LANES_SHARED LANES_TYPE_##suffix lanes_each_##name(LANES_TYPE_##suffix old, LANES_TYPE_##suffix source,   \
                                                       LANES_TYPE_##table_suffix tables)                      \
    {                                                                                                         \
        enum { LANES = 64 / sizeof(type) };                                                                   \
        type d[LANES], a[LANES];                                                                              \
        table_type b[LANES];                                                                                  \
        lanes_store_##suffix(d, old);                                                                         \
        lanes_store_##suffix(a, source);                                                                      \
        lanes_store_##table_suffix(b, tables);                                                                \
        for (int i = 0; i < LANES; i++)                                                                       \
            d[i] = function(d[i], a[i], b[i]);                                                                \
        return lanes_load_##suffix(d);                                                                        \
    }
LANES_FIX(fixup_ps, ps, float, pi, uint32_t, lrb_f32_fixup)
LANES_FIX(fixupnan_ps, ps, float, pi, uint32_t, lrb_f32_fixupnan)
LANES_FIX(fixupnan_pd, pd, double, pq, uint64_t, lrb_f64_fixupnan)
#undef LANES_FIX

/* No back end has instructions for these. */
#define lanes_cvtps2srgb8 lanes_each_cvtps2srgb8
#define lanes_cvtinsps2u10 lanes_each_cvtinsps2u10
#define lanes_cvtinsps2f11 lanes_each_cvtinsps2f11
#define lanes_fixup_ps lanes_each_fixup_ps
#define lanes_fixupnan_ps lanes_each_fixupnan_ps
#define lanes_fixupnan_pd lanes_each_fixupnan_pd
#define lanes_exp223_ps lanes_each_exp223_ps
#define lanes_log2_ps lanes_each_log2_ps
#define lanes_exp2lut_ps lanes_each_exp2lut_ps
#define lanes_log2lut_ps lanes_each_log2lut_ps
#define lanes_rsqrtlut_ps lanes_each_rsqrtlut_ps

/* Half a vector from 32 bytes of memory; the upper lanes are 0. */
static inline lrb_i32x16 lanes_load_half_pi(const void *m)
{
    uint32_t words[16] = {0};
    memcpy(words, m, 32);
    return lanes_load_pi(words);
}

static inline lrb_f32x16 lanes_load_half_ps(const void *m) { return lanes_bits_pi(lanes_load_half_pi(m)); }

/* Lanes 8 to 15 in the place of 0 to 7, and the reverse. */
static inline lrb_f32x16 lanes_upper_half_ps(lrb_f32x16 a) { return lanes_shuf128x32_ps(a, 0xee, 0xe4); }
static inline lrb_f32x16 lanes_to_upper_half_ps(lrb_f32x16 a) { return lanes_shuf128x32_ps(a, 0x44, 0xe4); }
static inline lrb_i32x16 lanes_upper_half_pi(lrb_i32x16 a) { return lanes_bits_ps(lanes_upper_half_ps(lanes_bits_pi(a))); }
static inline lrb_i32x16 lanes_to_upper_half_pi(lrb_i32x16 a) { return lanes_bits_ps(lanes_to_upper_half_ps(lanes_bits_pi(a))); }

#endif
