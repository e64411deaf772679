/* Loops over single ops, one table a back end; the tables have the same rows. */
#ifndef TESTS_BENCH_OP_LOOPS_H
#define TESTS_BENCH_OP_LOOPS_H

#include <stdint.h>

#include "lrbni/ctx.h"

typedef struct op_loop {
    lrb_op_id op;
    void (*run)(lrb_ctx *c, uint64_t count); /* the op `count` times */
} op_loop;

typedef struct op_loops {
    const char *backend;
    const op_loop *loops;
    int count;
    void (*fill)(void); /* set the operands; to be called before a loop runs */
} op_loops;

extern const op_loops op_loops_portable, op_loops_avx2, op_loops_avx512;

#endif
