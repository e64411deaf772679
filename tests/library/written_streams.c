/* Streams: each beside its ops. */
#include "tests/library/written_calls.h"

/* i_mm512_loadunpacklo_ps and o_mm512_loadunpacklo_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_streams.def"
#undef CALL

extern const call_pair calls_written_streams[];
const call_pair calls_written_streams[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_loadunpacklo_ps", i_mm512_loadunpacklo_ps, o_mm512_loadunpacklo_ps}, */
#include "tests/library/written_streams.def"
#undef CALL
    {0, 0, 0},
};
