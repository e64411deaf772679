/* Compiled twice: SIMDE_NAME is simde_plain with SIMDE_NO_NATIVE, or simde_instructions for this CPU. */
#include "tests/lrbni/simde_ops.h"

#include <simde/x86/avx512/add.h>
#include <simde/x86/avx512/and.h>
#include <simde/x86/avx512/cast.h>
#include <simde/x86/avx512/cmp.h>
#include <simde/x86/avx512/fmadd.h>
#include <simde/x86/avx512/fmsub.h>
#include <simde/x86/avx512/fnmadd.h>
#include <simde/x86/avx512/fnmsub.h>
#include <simde/x86/avx512/loadu.h>
#include <simde/x86/avx512/max.h>
#include <simde/x86/avx512/min.h>
#include <simde/x86/avx512/mov.h>
#include <simde/x86/avx512/mul.h>
#include <simde/x86/avx512/or.h>
#include <simde/x86/avx512/storeu.h>
#include <simde/x86/avx512/sub.h>
#include <simde/x86/avx512/xor.h>

#define I(x) simde_mm512_loadu_si512(x)
#define A simde_mm512_castsi512_ps(I(a))
#define B simde_mm512_castsi512_ps(I(b))
#define D simde_mm512_castsi512_ps(I(d))
#define AI I(a)
#define BI I(b)
#define DI I(d)
#define AD simde_mm512_castsi512_pd(I(a))
#define BD simde_mm512_castsi512_pd(I(b))
#define DD simde_mm512_castsi512_pd(I(d))
#define PUT_I(x) simde_mm512_storeu_si512(out, x)
#define PUT(x) PUT_I(simde_mm512_castps_si512(x))
#define PUT_D(x) PUT_I(simde_mm512_castpd_si512(x))
#define PUT_K(x) out[0] = x

#define SIMDE(id, form, statement)                                                                                             \
    static void id##_(const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], uint32_t k, uint32_t out[16])          \
    {                                                                                                                          \
        (void)d, (void)a, (void)b, (void)k;                                                                                    \
        statement;                                                                                                             \
    }
#include "tests/lrbni/simde.def"

static const simde_op ops[] = {
#define SIMDE(id, form, statement) {LRB_OP_##id, SIMDE_##form, id##_}, /* {LRB_OP_add_ps, SIMDE_PLAIN, add_ps_}, */
#include "tests/lrbni/simde.def"
};

const simde_ops SIMDE_NAME = {
#if defined(SIMDE_NO_NATIVE)
    .how = "plain C",
#else
    .how = "instructions",
#endif
#if defined(__FMA__) && !defined(SIMDE_NO_NATIVE)
    .fused = 1,
#endif
    .ops = ops,
    .count = sizeof ops / sizeof ops[0],
};
