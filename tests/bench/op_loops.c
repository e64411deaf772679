/* One loop an op, compiled once a back end at LRB_NATIVE with OP_LOOPS as the name of the table. */
#include "tests/bench/op_loops.h"

#define LRB_SOURCE 1
#include "lrbni/lrbni.h"

enum { VECTORS = 16 }; /* of each operand: 8 KiB in all */

/* Operands that are no extremes: floats and doubles around 1, the bits of which are as good as integers. */
typedef struct operands {
    _Alignas(64) uint32_t a[VECTORS][16];
    uint32_t b[VECTORS][16], d[VECTORS][16];
    uint32_t k[VECTORS];
    uint64_t r[VECTORS];
} operands;

static operands at, out; /* sources and results */

static void fill(void)
{
    for (uint32_t i = 0; i < VECTORS; i++) {
        for (uint32_t j = 0; j < 16; j++) {
            at.a[i][j] = 0x3f800000u + 0x1357u * (16 * i + j);
            at.b[i][j] = 0x3f900000u + 0x2468u * (16 * j + i);
            at.d[i][j] = 0x3fa00000u + 0x0111u * (16 * i + j);
        }
        at.k[i] = (0x5a3cu * (i + 1)) & 0xffffu;
        at.r[i] = UINT64_C(0x123456789abcdef) * (i + 1);
    }
}

#define VECTOR(suffix, type, words) ((type){.lanes = lanes_load_##suffix(words)})
#define PUT(suffix, result) lanes_store_##suffix(out.d[i], (result).lanes)
#define PUT_K(result) out.k[i] = (result).bits
#define PUT_R(result) out.r[i] = (result).value
#define PUT_F(result) out.k[i] = (result).zero
#define A_ps VECTOR(ps, lrb_v16f, at.a[i])
#define B_ps VECTOR(ps, lrb_v16f, at.b[i])
#define D_ps VECTOR(ps, lrb_v16f, at.d[i])
#define A_pi VECTOR(pi, lrb_v16i, at.a[i])
#define B_pi VECTOR(pi, lrb_v16i, at.b[i])
#define D_pi VECTOR(pi, lrb_v16i, at.d[i])
#define A_pd VECTOR(pd, lrb_v8d, at.a[i])
#define B_pd VECTOR(pd, lrb_v8d, at.b[i])
#define D_pd VECTOR(pd, lrb_v8d, at.d[i])
#define A_pq VECTOR(pq, lrb_v8q, at.a[i])
#define B_pq VECTOR(pq, lrb_v8q, at.b[i])
#define K lrb_mask(at.k[i])
#define KB lrb_mask(at.k[i ^ 1])
#define R lrb_imm(at.r[i])
#define RB lrb_imm(at.r[i ^ 1])

/* LOOP(add_ps, PUT(ps, lrb_add_ps(c, A_ps, B_ps))): the operands come from memory and the result goes there */
#define LOOP(id, statement)                                                       \
    static __attribute__((noinline)) void loop_##id(lrb_ctx *c, uint64_t count)   \
    {                                                                             \
        for (uint64_t n = 0; n < count; n++) {                                    \
            unsigned i = (unsigned)n % VECTORS;                                   \
            statement;                                                            \
            __asm__ volatile("" ::: "memory");                                    \
        }                                                                         \
    }
#define ROW_V_V(id) LOOP(id, PUT(ps, lrb_##id(c, B_ps)))
#define ROW_V_VV(id) LOOP(id, PUT(ps, lrb_##id(c, A_ps, B_ps)))
#define ROW_V_VX(id) LOOP(id, PUT(ps, lrb_##id(c, A_ps, B_ps)))
#define ROW_V_VVV(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, A_ps, B_ps)))
#define ROW_V_KVV(id) LOOP(id, PUT(ps, lrb_##id(c, K, A_ps, B_ps)))
#define ROW_V_VII(id) LOOP(id, PUT(ps, lrb_##id(c, A_ps, 0x1b, 0x4e)))
#define ROW_VK_VV(id) LOOP(id, lrb_k16 signs; PUT(ps, lrb_##id(c, A_ps, B_ps, &signs)); PUT_K(signs))
#define ROW_K_VV(id) LOOP(id, PUT_K(lrb_##id(c, A_ps, B_ps)))
#define ROW_VI_V(id) LOOP(id, PUT(pi, lrb_##id(c, B_pi)))
#define ROW_VI_VV(id) LOOP(id, PUT(pi, lrb_##id(c, A_pi, B_pi)))
#define ROW_VI_VX(id) LOOP(id, PUT(pi, lrb_##id(c, A_pi, B_pi)))
#define ROW_VI_VVV(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, A_pi, B_pi)))
#define ROW_VI_KVV(id) LOOP(id, PUT(pi, lrb_##id(c, K, A_pi, B_pi)))
#define ROW_KI_VV(id) LOOP(id, PUT_K(lrb_##id(c, A_pi, B_pi)))
#define ROW_VD_V(id) LOOP(id, PUT(pd, lrb_##id(c, B_pd)))
#define ROW_VD_VV(id) LOOP(id, PUT(pd, lrb_##id(c, A_pd, B_pd)))
#define ROW_VD_VVV(id) LOOP(id, PUT(pd, lrb_##id(c, D_pd, A_pd, B_pd)))
#define ROW_VD_KVV(id) LOOP(id, PUT(pd, lrb_##id(c, K, A_pd, B_pd)))
#define ROW_KD_VV(id) LOOP(id, PUT_K(lrb_##id(c, A_pd, B_pd)))
#define ROW_VQ_V(id) LOOP(id, PUT(pq, lrb_##id(c, B_pq)))
#define ROW_VQ_VV(id) LOOP(id, PUT(pq, lrb_##id(c, A_pq, B_pq)))
#define ROW_VQ_KVV(id) LOOP(id, PUT(pq, lrb_##id(c, K, A_pq, B_pq)))
#define ROW_K_KK(id) LOOP(id, PUT_K(lrb_##id(c, K, KB)))
#define ROW_K_K(id) LOOP(id, PUT_K(lrb_##id(c, K)))
#define ROW_F_KK(id) LOOP(id, PUT_F(lrb_##id(c, K, KB)))
#define ROW_R_R(id) LOOP(id, PUT_R(lrb_##id(c, R)))
#define ROW_R_RR(id) LOOP(id, PUT_R(lrb_##id(c, R, RB)))
#define ROW_F_RR(id) LOOP(id, PUT_F(lrb_##id(c, R, RB)))
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* loop_add_ps */
#include "lrbni/ops.def"

#undef LOOP
#define LOOP(id, statement) {LRB_OP_##id, loop_##id},
static const op_loop loops[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {LRB_OP_add_ps, loop_add_ps}, */
#include "lrbni/ops.def"
};

const op_loops OP_LOOPS = {LRB_BACKEND, loops, sizeof loops / sizeof loops[0], fill};
