/* Gathers and scatters: each beside its ops. */
#include "tests/library/written_calls.h"

/* All lanes of k, as a compiler writes it; the base is in the middle of memory. */
#define GATHERS(suffix, vector)                                                                                     \
    static vector gather_##suffix(call_side *s, vector d, lrb_k16 k, unsigned scale, lrb_up_##suffix up)            \
    {                                                                                                               \
        do                                                                                                          \
            d = lrb_gatherd_up_##suffix(s->c, d, &k, lrb_at(s->p, 512), s->index, scale, up);                       \
        while (lanetrace_again(s->c, k));                                                                           \
        return d;                                                                                                   \
    }                                                                                                               \
    static void scatter_##suffix(call_side *s, lrb_k16 k, vector v, unsigned scale, lrb_down_##suffix down)         \
    {                                                                                                               \
        do                                                                                                          \
            lrb_scatterd_down_##suffix(s->c, lrb_at(s->p, 512), &k, s->index, scale, v, down);                      \
        while (lanetrace_again(s->c, k));                                                                           \
    }
GATHERS(ps, lrb_v16f)
GATHERS(pi, lrb_v16i)
GATHERS(pd, lrb_v8d)
GATHERS(pq, lrb_v8q)

static void prefetch(call_side *s, lrb_k16 k, void (*op)(lrb_ctx *, lrb_k16 *, lrb_mem, lrb_v16i, unsigned))
{
    do
        op(s->c, &k, lrb_at(s->p, 512), s->index, 4);
    while (lanetrace_again(s->c, k));
}

/* i_mm512_i32gather_ps and o_mm512_i32gather_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_gathers.def"
#undef CALL

extern const call_pair calls_written_gathers[];
const call_pair calls_written_gathers[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_i32gather_ps", i_mm512_i32gather_ps, o_mm512_i32gather_ps}, */
#include "tests/library/written_gathers.def"
#undef CALL
    {0, 0, 0},
};
