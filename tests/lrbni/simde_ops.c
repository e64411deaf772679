/* Compiled twice: SIMDE_NAME is simde_plain with SIMDE_NO_NATIVE, or simde_instructions for this CPU. */
#include "tests/lrbni/simde_ops.h"

#include <simde/x86/avx512/add.h>
#include <simde/x86/avx512/and.h>
#include <simde/x86/avx512/cmp.h>
#include <simde/x86/avx512/fmadd.h>
#include <simde/x86/avx512/fmsub.h>
#include <simde/x86/avx512/fnmadd.h>
#include <simde/x86/avx512/max.h>
#include <simde/x86/avx512/min.h>
#include <simde/x86/avx512/mov.h>
#include <simde/x86/avx512/mul.h>
#include <simde/x86/avx512/or.h>
#include <simde/x86/avx512/sub.h>
#include <simde/x86/avx512/xor.h>

#include "tests/lrbni/simde_forms.h"

FN(add, PUT_F(simde_mm512_add_ps(F(a), F(b))))
FN(sub, PUT_F(simde_mm512_sub_ps(F(a), F(b))))
FN(mul, PUT_F(simde_mm512_mul_ps(F(a), F(b))))
FN(fmadd, PUT_F(simde_mm512_fmadd_ps(F(a), F(b), F(c))))
FN(fmsub, PUT_F(simde_mm512_fmsub_ps(F(a), F(b), F(c))))
FN(fnmadd, PUT_F(simde_mm512_fnmadd_ps(F(a), F(b), F(c))))
FN(min, PUT_F(simde_mm512_min_ps(F(a), F(b))))
FN(max, PUT_F(simde_mm512_max_ps(F(a), F(b))))
FN(add_epi32, PUT_I(simde_mm512_add_epi32(I(a), I(b))))
FN(sub_epi32, PUT_I(simde_mm512_sub_epi32(I(a), I(b))))
FN(and_epi32, PUT_I(simde_mm512_and_epi32(I(a), I(b))))
FN(or_epi32, PUT_I(simde_mm512_or_epi32(I(a), I(b))))
FN(xor_epi32, PUT_I(simde_mm512_xor_epi32(I(a), I(b))))
FN(mask_mov, PUT_F(simde_mm512_mask_mov_ps(F(c), (simde__mmask16)k, F(a))))
FN(cmp_eq, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_EQ_OQ))
FN(cmp_lt, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_LT_OS))
FN(cmp_le, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_LE_OS))
FN(cmp_unord, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_UNORD_Q))
FN(cmp_neq, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_NEQ_UQ))
FN(cmp_nlt, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_NLT_US))
FN(cmp_nle, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_NLE_US))
FN(cmp_ord, out[0] = simde_mm512_cmp_ps_mask(F(a), F(b), SIMDE_CMP_ORD_Q))

const simde_ops SIMDE_NAME = {
#if defined(SIMDE_NO_NATIVE)
    .how = "plain C",
#else
    .how = "instructions",
#endif
#if defined(__FMA__) && !defined(SIMDE_NO_NATIVE)
    .fused = 1,
#endif
    .add = add, .sub = sub, .mul = mul, .fmadd = fmadd, .fmsub = fmsub, .fnmadd = fnmadd, .min = min, .max = max,
    .add_epi32 = add_epi32, .sub_epi32 = sub_epi32, .and_epi32 = and_epi32, .or_epi32 = or_epi32, .xor_epi32 = xor_epi32,
    .mask_mov = mask_mov, .cmp = {cmp_eq, cmp_lt, cmp_le, cmp_unord, cmp_neq, cmp_nlt, cmp_nle, cmp_ord},
};
