/* SIMDe's emulation of AVX-512, for comparison: sixteen lanes at a time, floats as bits. */
#ifndef TESTS_LRBNI_SIMDE_OPS_H
#define TESTS_LRBNI_SIMDE_OPS_H

#include <stdint.h>

#include "lrbni/op_table.h"

typedef enum simde_form { SIMDE_PLAIN, SIMDE_MASKED, SIMDE_FUSED } simde_form;

/* Sources in the order of the op; a compare writes its bits to out[0]. */
typedef void simde_fn(const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], uint32_t k, uint32_t out[16]);

typedef struct simde_op {
    lrb_op_id op;
    simde_form form;
    simde_fn *run;
} simde_op;

typedef struct simde_ops {
    const char *how; /* "plain C" or "instructions" */
    int fused;       /* whether multiply-add rounds once: SIMDe's plain C rounds twice */
    const simde_op *ops; /* simde.def */
    int count;
} simde_ops;

extern const simde_ops simde_plain;        /* any host */
extern const simde_ops simde_instructions; /* compiled for this CPU */

#endif
