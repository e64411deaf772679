/* The intrinsics that are written by hand, each beside its ops. */
#include <math.h>

#include "tests/library/intrinsic_call.h"

#define BITS(k) ((k).bits)

static const float count_f[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
static const int count_i[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};

/* The constants' line, and constants from there. */
static lrb_mem pool(call_side *s, const void *value, size_t bytes)
{
    lrb_ptr p = lrb_segment_at(s->c->scratch, LRB_SCRATCH_BYTES - 64);
    memcpy(p.host, value, bytes);
    return lrb_at(p, 0);
}

static lrb_v16f constant_f(call_side *s, float a) { return lrb_load_1to16_ps(s->c, pool(s, &a, sizeof a)); }
static lrb_v16i constant_i(call_side *s, int a) { return lrb_load_1to16_pi(s->c, pool(s, &a, sizeof a)); }

/* What no op has made. */
static lrb_v16i nothing(void)
{
    static const int zeros[16];
    return (lrb_v16i){.lanes = lanes_load_pi(zeros), .from = 0};
}

static lrb_v16i zero(call_side *s) { return lrb_xor_pi(s->c, nothing(), nothing()); }

static lrb_v16f under_mask_f(call_side *s, lrb_v16f neutral) { return lrb_mask_mov_ps(s->c, neutral, s->k[0], s->f[0]); }
static lrb_v16i under_mask_i(call_side *s, lrb_v16i neutral) { return lrb_mask_mov_pi(s->c, neutral, s->k[0], s->i[0]); }

/* Golden case 69: 8+8, 4+4, badc, cdab; then lane 0 by way of memory. */
static void leave(call_side *s, lrb_v16i v)
{
    lrb_mem m = lrb_at(lrb_segment_at(s->c->scratch, LRB_SCRATCH_BYTES - 128), 0);
    lrb_mask_store_pi(s->c, m, lrb_mask(1), v);
    note_bits(s, lrb_load32(s->c, m).value);
}

static void reduce_f(call_side *s, lrb_v16f v, lrb_v16f (*op)(lrb_ctx *, lrb_v16f, lrb_v16f), lrb_v16f (*op_s3)(lrb_ctx *, lrb_v16f, lrb_s3f))
{
    v = op(s->c, v, lrb_shuf128x32_ps(s->c, v, 0x4e, 0xe4));
    v = op(s->c, v, lrb_shuf128x32_ps(s->c, v, 0xb1, 0xe4));
    v = op_s3(s->c, v, lrb_swizzle_ps(v, LRB_BADC));
    leave(s, lrb_castps_pi(op_s3(s->c, v, lrb_swizzle_ps(v, LRB_CDAB))));
}

static void reduce_i(call_side *s, lrb_v16i v, lrb_v16i (*op)(lrb_ctx *, lrb_v16i, lrb_v16i), lrb_v16i (*op_s3)(lrb_ctx *, lrb_v16i, lrb_s3i))
{
    v = op(s->c, v, lrb_castps_pi(lrb_shuf128x32_ps(s->c, lrb_castpi_ps(v), 0x4e, 0xe4)));
    v = op(s->c, v, lrb_castps_pi(lrb_shuf128x32_ps(s->c, lrb_castpi_ps(v), 0xb1, 0xe4)));
    v = op_s3(s->c, v, lrb_swizzle_pi(v, LRB_BADC));
    leave(s, op_s3(s->c, v, lrb_swizzle_pi(v, LRB_CDAB)));
}

static void note_float(call_side *s, float a) { note_bits(s, lrb_float_bits(a)); }

/* i_mm512_add_ps and o_mm512_add_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_calls.def"
#undef CALL

extern const call_pair calls_written[];
const call_pair calls_written[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_add_ps", i_mm512_add_ps, o_mm512_add_ps}, */
#include "tests/library/written_calls.def"
#undef CALL
    {0, 0, 0},
};
