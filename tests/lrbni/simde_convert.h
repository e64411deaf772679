/* SIMDe's conversions and the like, for comparison: registers as words in and out. */
#ifndef TESTS_LRBNI_SIMDE_CONVERT_H
#define TESTS_LRBNI_SIMDE_CONVERT_H

#include <stdint.h>

typedef void simde_convert_fn(const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], uint32_t out[16]);

typedef struct simde_conversions {
    const char *how; /* "plain C" or "instructions" */
    int plain;       /* whether no function is made of instructions */
    int avx512;      /* whether AVX-512's functions are instructions */
    simde_convert_fn *const *functions; /* in the order of simde_convert.def */
} simde_conversions;

extern const simde_conversions simde_convert_plain;        /* any host */
extern const simde_conversions simde_convert_instructions; /* compiled for this CPU */

#endif
