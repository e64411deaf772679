/* SIMDe's memory operations, for comparison: 256 bytes of memory and a register, both changed in place. */
#ifndef TESTS_LRBNI_SIMDE_MEMORY_H
#define TESTS_LRBNI_SIMDE_MEMORY_H

#include <stdint.h>

typedef void simde_memory_fn(unsigned char *m, uint32_t k, const uint32_t index[16], uint32_t lanes[16]);

typedef struct simde_memory_ops {
    const char *how;                   /* "plain C" or "instructions" */
    simde_memory_fn *const *functions; /* in the order of simde_memory.def */
} simde_memory_ops;

extern const simde_memory_ops simde_memory_plain;        /* any host */
extern const simde_memory_ops simde_memory_instructions; /* compiled for this CPU */

#endif
