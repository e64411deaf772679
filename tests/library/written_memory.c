/* Loads, stores and hints: each beside its ops. */
#include "tests/library/written_calls.h"

/* i_mm512_load_ps and o_mm512_load_ps: with the intrinsic, and with ops */
#define CALL(name, first, second)                              \
    static CALL_NOINLINE void i##name(call_side *s) { first; } \
    static CALL_NOINLINE void o##name(call_side *s) { second; }
#include "tests/library/written_memory.def"
#undef CALL

extern const call_pair calls_written_memory[];
const call_pair calls_written_memory[] = {
#define CALL(name, first, second) {#name, i##name, o##name}, /* {"_mm512_load_ps", i_mm512_load_ps, o_mm512_load_ps}, */
#include "tests/library/written_memory.def"
#undef CALL
    {0, 0, 0},
};
