/* Programs of ops: an interpreter that is compiled once per back end and level, so that they can be compared on the same
 * bytes. Any bytes are a program. */
#ifndef TESTS_LRBNI_PROGRAM_H
#define TESTS_LRBNI_PROGRAM_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/ctx.h"

enum {
    PROGRAM_REGISTERS = 8,
    PROGRAM_MEMORY = 1024,
    PROGRAM_STEP = 8 /* bytes of an instruction: op (low byte), form and mask, d, a, b, two of address, op (high byte) */
};

/* Everything that ops can change; also where a program starts from. */
typedef struct program_state {
    uint32_t v[PROGRAM_REGISTERS][16]; /* vectors */
    uint32_t k[PROGRAM_REGISTERS];     /* masks; the upper halves are cut off on entry */
    uint64_t r[PROGRAM_REGISTERS];
    uint8_t flags;     /* zero, carry, less: bits 0, 1, 2 */
    uint32_t p;        /* simulated address that a pointer ended at */
    _Alignas(64) unsigned char memory[PROGRAM_MEMORY];
} program_state;

/* Run `size` bytes as a program. */
typedef void program_fn(lrb_ctx *c, program_state *s, const uint8_t *code, size_t size);
program_fn program_run_portable, program_run_avx2, program_run_avx512; /* at LRB_RECORD */
program_fn program_run_native, program_run_count, program_run_record, program_run_touch, program_run_annotated; /* with the back end chosen at configure time */

#endif
