/* SIMDe's emulation of AVX-512, for comparison: sixteen lanes at a time, floats as bits. */
#ifndef TESTS_LRBNI_SIMDE_OPS_H
#define TESTS_LRBNI_SIMDE_OPS_H

#include <stdint.h>

/* Where the operation has fewer operands, the others are not read. `k` is a write-mask for mask_mov: k ? a : c. Compares
   write their 16 bits to out[0]. */
typedef void simde_fn(const uint32_t a[16], const uint32_t b[16], const uint32_t c[16], uint32_t k, uint32_t out[16]);

typedef struct simde_ops {
    const char *how;  /* "plain C" or "instructions" */
    int fused;        /* whether multiply-add rounds once: SIMDe's plain C rounds twice */
    simde_fn *add, *sub, *mul, *fmadd, *fmsub, *fnmadd, *min, *max;
    simde_fn *add_epi32, *sub_epi32, *and_epi32, *or_epi32, *xor_epi32, *mask_mov;
    simde_fn *cmp[8]; /* eq lt le unord neq nlt nle ord */
} simde_ops;

extern const simde_ops simde_plain;        /* any host */
extern const simde_ops simde_instructions; /* compiled for this CPU */

#endif
