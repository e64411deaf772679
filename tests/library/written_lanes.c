/* Constants, casts, swizzles, compares by predicate, sums with carries, masks, general registers: each beside its ops. */
#include "tests/library/written_calls.h"

static const float count_f[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
static const int count_i[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
static const double count_d[8] = {1, 2, 3, 4, 5, 6, 7, 8};
static const int64_t count_q[8] = {1, 2, 3, 4, 5, 6, 7, 8};

/* i_mm512_add_ps and o_mm512_add_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_lanes.def"
#undef CALL

extern const call_pair calls_written_lanes[];
const call_pair calls_written_lanes[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_add_ps", i_mm512_add_ps, o_mm512_add_ps}, */
#include "tests/library/written_lanes.def"
#undef CALL
    {0, 0, 0},
};
