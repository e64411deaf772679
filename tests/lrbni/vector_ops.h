/* Every op from vector registers and S3, as a table: how to run it in the forms that a case asks for, and its reference.
 * Tests and benchmarks that treat all ops alike include this; an op of a shape that is served here needs no line of its own. */
#ifndef TESTS_LRBNI_VECTOR_OPS_H
#define TESTS_LRBNI_VECTOR_OPS_H

#include "tests/lrbni/case.h"

typedef enum vector_kind {
    VECTOR_MERGE,  /* 'out' receives lanes; those that the mask leaves out are d's */
    VECTOR_COMPARE /* out[0] receives a mask; bits that the mask leaves out are 0 */
} vector_kind;

typedef struct vector_op {
    const char *id;
    lrb_op_id op;
    vector_kind kind;
    bool wide, ternary; /* 8 lanes of 64 bits; d is a source */
    void (*run)(lrb_ctx *c, const vector_case *v, uint32_t out[16]);
    uint64_t (*ref)(uint64_t d, uint64_t a, uint64_t b); /* one lane; of a compare 0 or 1 */
} vector_op;

#define NARROW(bits) ((uint32_t)(bits))
#define WIDE(bits) (bits)

/* RUN(add_ps, put, masked, plain, masked_s3, plain_s3, ref): the four forms of an op, and one lane of its reference */
#define RUN(id, put, masked_call, call, masked_call_s3, call_s3, lane)                         \
    static __attribute__((noinline)) void run_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16]) \
    {                                                                                          \
        lrb_k16 k = lrb_mask(v->mask);                                                         \
        if (v->form == S3_REGISTER)                                                            \
            put(out, v->masked ? lrb_mask_##id masked_call : lrb_##id call);                   \
        else                                                                                   \
            put(out, v->masked ? lrb_mask_##id##_s3 masked_call_s3 : lrb_##id##_s3 call_s3);   \
    }                                                                                          \
    static uint64_t lane_##id(uint64_t d, uint64_t a, uint64_t b)                              \
    {                                                                                          \
        (void)d, (void)a;                                                                      \
        return lane;                                                                           \
    }
#define PUT_ps(out, v) lanes_store_ps(out, (v).lanes)
#define PUT_pi(out, v) lanes_store_pi(out, (v).lanes)
#define PUT_pd(out, v) lanes_store_pd(out, (v).lanes)
#define PUT_pq(out, v) lanes_store_pq(out, (v).lanes)
#define PUT_K(out, v) (out)[0] = (v).bits
#define VECTOR_A(suffix) case_##suffix(v->a)
#define VECTOR_B(suffix) case_##suffix(v->b)
#define VECTOR_D(suffix) case_##suffix(v->d)

#define VECTOR_UNARY(id, suffix, lane)                                                                    \
    RUN(id, PUT_##suffix, (c, VECTOR_D(suffix), k, VECTOR_B(suffix)), (c, VECTOR_B(suffix)),              \
        (c, VECTOR_D(suffix), k, case_s3_##suffix(v)), (c, case_s3_##suffix(v)), ref_##id(lane(b)))
#define VECTOR_BINARY(id, suffix, lane)                                                                   \
    RUN(id, PUT_##suffix, (c, VECTOR_D(suffix), k, VECTOR_A(suffix), VECTOR_B(suffix)),                   \
        (c, VECTOR_A(suffix), VECTOR_B(suffix)),                                                          \
        (c, VECTOR_D(suffix), k, VECTOR_A(suffix), case_s3_##suffix(v)),                                  \
        (c, VECTOR_A(suffix), case_s3_##suffix(v)), ref_##id(lane(a), lane(b)))
#define VECTOR_TERNARY(id, suffix, lane)                                                                  \
    RUN(id, PUT_##suffix, (c, VECTOR_D(suffix), k, VECTOR_A(suffix), VECTOR_B(suffix)),                   \
        (c, VECTOR_D(suffix), VECTOR_A(suffix), VECTOR_B(suffix)),                                        \
        (c, VECTOR_D(suffix), k, VECTOR_A(suffix), case_s3_##suffix(v)),                                  \
        (c, VECTOR_D(suffix), VECTOR_A(suffix), case_s3_##suffix(v)), ref_##id(lane(d), lane(a), lane(b)))
#define VECTOR_COMPARE_OP(id, suffix, lane)                                                               \
    RUN(id, PUT_K, (c, k, VECTOR_A(suffix), VECTOR_B(suffix)), (c, VECTOR_A(suffix), VECTOR_B(suffix)),   \
        (c, k, VECTOR_A(suffix), case_s3_##suffix(v)), (c, VECTOR_A(suffix), case_s3_##suffix(v)),        \
        ref_##id(lane(a), lane(b)))

#define ROW_V_V(id) VECTOR_UNARY(id, ps, NARROW)
#define ROW_VI_V(id) VECTOR_UNARY(id, pi, NARROW)
#define ROW_VD_V(id) VECTOR_UNARY(id, pd, WIDE)
#define ROW_V_VV(id) VECTOR_BINARY(id, ps, NARROW)
#define ROW_VD_VV(id) VECTOR_BINARY(id, pd, WIDE)
#define ROW_VD_VVV(id) VECTOR_TERNARY(id, pd, WIDE)
#define ROW_KD_VV(id) VECTOR_COMPARE_OP(id, pd, WIDE)
#define ROW_VI_VV(id) VECTOR_BINARY(id, pi, NARROW)
#define ROW_VQ_V(id) VECTOR_UNARY(id, pq, WIDE)
#define ROW_VQ_VV(id) VECTOR_BINARY(id, pq, WIDE)
#define ROW_V_VVV(id) VECTOR_TERNARY(id, ps, NARROW)
#define ROW_VI_VVV(id) VECTOR_TERNARY(id, pi, NARROW)
#define ROW_K_VV(id) VECTOR_COMPARE_OP(id, ps, NARROW)
#define ROW_KI_VV(id) VECTOR_COMPARE_OP(id, pi, NARROW)
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_add_ps, lane_add_ps */
#include "lrbni/ops.def"

/* The same rows once more, as entries of the table. */
#undef VECTOR_UNARY
#undef VECTOR_BINARY
#undef VECTOR_TERNARY
#undef VECTOR_COMPARE_OP
#define VECTOR_ENTRY(id, kind, lane, ternary) \
    {#id, LRB_OP_##id, kind, sizeof lane(UINT64_C(0)) == 8, ternary, run_##id, lane_##id},
#define VECTOR_UNARY(id, suffix, lane) VECTOR_ENTRY(id, VECTOR_MERGE, lane, false)
#define VECTOR_BINARY(id, suffix, lane) VECTOR_ENTRY(id, VECTOR_MERGE, lane, false)
#define VECTOR_TERNARY(id, suffix, lane) VECTOR_ENTRY(id, VECTOR_MERGE, lane, true)
#define VECTOR_COMPARE_OP(id, suffix, lane) VECTOR_ENTRY(id, VECTOR_COMPARE, lane, false)
static const vector_op vector_ops[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"add_ps", LRB_OP_add_ps, ...}, */
#include "lrbni/ops.def"
};
enum { VECTOR_OPS = sizeof vector_ops / sizeof vector_ops[0] };

#endif
