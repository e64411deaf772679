/* Reductions, each beside its ops: 8+8, 4+4, badc, cdab (golden case 69), of doubles 4+4, badc, cdab; then lane 0 by way of memory. */
#include "tests/library/written_calls.h"

static lrb_mem leaving(call_side *s) { return lrb_at(lrb_segment_at(s->c->scratch, LRB_SCRATCH_BYTES - 128), 0); }

static void leave_pi(call_side *s, lrb_v16i v)
{
    lrb_store_1_pi(s->c, leaving(s), v);
    note_bits(s, lrb_load32(s->c, leaving(s)).value);
}

static void leave_pq(call_side *s, lrb_v8q v)
{
    lrb_store_1_pq(s->c, leaving(s), v);
    note_bits(s, lrb_load64(s->c, leaving(s)).value);
}

static void reduce_ps(call_side *s, lrb_v16f v, lrb_v16f (*op)(lrb_ctx *, lrb_v16f, lrb_v16f), lrb_v16f (*op_s3)(lrb_ctx *, lrb_v16f, lrb_s3f))
{
    v = op(s->c, v, lrb_permf32x4_ps(s->c, v, 0x4e));
    v = op(s->c, v, lrb_permf32x4_ps(s->c, v, 0xb1));
    v = op_s3(s->c, v, lrb_swizzle_ps(v, LRB_BADC));
    leave_pi(s, lrb_castps_pi(op_s3(s->c, v, lrb_swizzle_ps(v, LRB_CDAB))));
}

static void reduce_pi(call_side *s, lrb_v16i v, lrb_v16i (*op)(lrb_ctx *, lrb_v16i, lrb_v16i), lrb_v16i (*op_s3)(lrb_ctx *, lrb_v16i, lrb_s3i))
{
    v = op(s->c, v, lrb_castps_pi(lrb_permf32x4_ps(s->c, lrb_castpi_ps(v), 0x4e)));
    v = op(s->c, v, lrb_castps_pi(lrb_permf32x4_ps(s->c, lrb_castpi_ps(v), 0xb1)));
    v = op_s3(s->c, v, lrb_swizzle_pi(v, LRB_BADC));
    leave_pi(s, op_s3(s->c, v, lrb_swizzle_pi(v, LRB_CDAB)));
}

static void reduce_pd(call_side *s, lrb_v8d v, lrb_v8d (*op)(lrb_ctx *, lrb_v8d, lrb_v8d), lrb_v8d (*op_s3)(lrb_ctx *, lrb_v8d, lrb_s3d))
{
    v = op(s->c, v, lrb_castpq_pd(lrb_castps_pq(lrb_permf32x4_ps(s->c, lrb_castpq_ps(lrb_castpd_pq(v)), 0x4e))));
    v = op_s3(s->c, v, lrb_swizzle_pd(v, LRB_BADC));
    leave_pq(s, lrb_castpd_pq(op_s3(s->c, v, lrb_swizzle_pd(v, LRB_CDAB))));
}

static void reduce_pq(call_side *s, lrb_v8q v, lrb_v8q (*op)(lrb_ctx *, lrb_v8q, lrb_v8q), lrb_v8q (*op_s3)(lrb_ctx *, lrb_v8q, lrb_s3q))
{
    v = op(s->c, v, lrb_castps_pq(lrb_permf32x4_ps(s->c, lrb_castpq_ps(v), 0x4e)));
    v = op_s3(s->c, v, lrb_swizzle_pq(v, LRB_BADC));
    leave_pq(s, op_s3(s->c, v, lrb_swizzle_pq(v, LRB_CDAB)));
}

/* What changes nothing, in the lanes that a mask leaves out. */
static lrb_v16i neutral_pi(call_side *s, int a) { return a ? lrb_load_1to16_pi(s->c, pool(s, &a, sizeof a)) : zero(s); }
static lrb_v16f neutral_ps(call_side *s, float a) { return a != 0 ? lrb_load_1to16_ps(s->c, pool(s, &a, sizeof a)) : lrb_castpi_ps(zero(s)); }
static lrb_v8q neutral_pq(call_side *s, int64_t a) { return a ? lrb_load_1to8_pq(s->c, pool(s, &a, sizeof a)) : lrb_castpi_pq(zero(s)); }
static lrb_v8d neutral_pd(call_side *s, double a)
{
    return a != 0 ? lrb_load_1to8_pd(s->c, pool(s, &a, sizeof a)) : lrb_castpq_pd(lrb_castpi_pq(zero(s)));
}

static void note_float(call_side *s, float a) { note_bits(s, lrb_float_bits(a)); }
static void note_double(call_side *s, double a) { note_bits(s, lrb_double_bits(a)); }

/* i_mm512_reduce_add_ps and o_mm512_reduce_add_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_reduce.def"
#undef CALL

extern const call_pair calls_written_reduce[];
const call_pair calls_written_reduce[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_reduce_add_ps", i_mm512_reduce_add_ps, o...}, */
#include "tests/library/written_reduce.def"
#undef CALL
    {0, 0, 0},
};
