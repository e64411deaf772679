/* Compiled twice: SIMDE_NAME is simde_plain with SIMDE_NO_NATIVE, or simde_instructions for this CPU. */
#include "tests/lrbni/simde_ops.h"

#include <simde/x86/avx512/add.h>
#include <simde/x86/avx512/and.h>
#include <simde/x86/avx512/andnot.h>
#include <simde/x86/avx512/blend.h>
#include <simde/x86/avx512/cast.h>
#include <simde/x86/avx512/cmp.h>
#include <simde/x86/avx512/cmpeq.h>
#include <simde/x86/avx512/cmpge.h>
#include <simde/x86/avx512/cmpgt.h>
#include <simde/x86/avx512/cmple.h>
#include <simde/x86/avx512/fmadd.h>
#include <simde/x86/avx512/fmsub.h>
#include <simde/x86/avx512/fnmadd.h>
#include <simde/x86/avx512/fnmsub.h>
#include <simde/x86/avx512/loadu.h>
#include <simde/x86/avx512/max.h>
#include <simde/x86/avx512/min.h>
#include <simde/x86/avx512/mov.h>
#include <simde/x86/avx512/mul.h>
#include <simde/x86/avx512/mullo.h>
#include <simde/x86/avx512/or.h>
#include <simde/x86/avx512/permutex2var.h>
#include <simde/x86/avx512/permutexvar.h>
#include <simde/x86/avx512/rolv.h>
#include <simde/x86/avx512/sll.h>
#include <simde/x86/avx512/sllv.h>
#include <simde/x86/avx512/srl.h>
#include <simde/x86/avx512/srli.h>
#include <simde/x86/avx512/srlv.h>
#include <simde/x86/avx512/storeu.h>
#include <simde/x86/avx512/sub.h>
#include <simde/x86/avx512/test.h>
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
#define COUNT_FROM(n) simde_mm512_add_epi32(simde_mm512_set1_epi32(n), simde_mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0))

/* PUT_HALVES(simde_mm256_srav_epi32): a function of 256 bits, twice */
#define PUT_HALVES(f)                                                                                   \
    for (int half = 0; half < 16; half += 8)                                                            \
    simde_mm256_storeu_si256((simde__m256i *)(out + half), f(simde_mm256_loadu_si256((const simde__m256i *)(a + half)), \
                                                             simde_mm256_loadu_si256((const simde__m256i *)(b + half))))
/* PUT_HIGH_HALVES(simde_mm512_mul_epi32): of the 64-bit products of even lanes, and of those of odd lanes moved there */
#define PUT_HIGH_HALVES(f)                                                                              \
    {                                                                                                   \
        const simde__m512i even = f(AI, BI), odd = f(simde_mm512_srli_epi64(AI, 32), simde_mm512_srli_epi64(BI, 32)); \
        PUT_I(simde_mm512_mask_mov_epi32(simde_mm512_srli_epi64(even, 32), 0xaaaa, odd));               \
    }

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
