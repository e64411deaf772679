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
#define D_pq VECTOR(pq, lrb_v8q, at.d[i])
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

/* Carries, shifts and bit-fields, permutes. */
#define ROW_VI_VI(id) LOOP(id, PUT(pi, lrb_##id(c, B_pi, 5)))
#define ROW_VI_VIII(id) LOOP(id, PUT(pi, lrb_##id(c, B_pi, 5, 3, 17)))
#define ROW_VI_VVIII(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, B_pi, 5, 3, 17)))
#define ROW_VIK_VKV(id) LOOP(id, lrb_k16 carry; PUT(pi, lrb_##id(c, D_pi, K, B_pi, &carry)); PUT_K(carry))
#define ROW_VIK_V(id) LOOP(id, lrb_k16 carry; PUT(pi, lrb_##id(c, D_pi, B_pi, &carry)); PUT_K(carry))
#define ROW_VIK_VV(id) LOOP(id, lrb_k16 signs; PUT(pi, lrb_##id(c, A_pi, B_pi, &signs)); PUT_K(signs))
#define ROW_VI_XII(id) LOOP(id, PUT(pi, lrb_##id(c, A_pi, 0x1b, 0x4e)))
#define ROW_VI_XI(id) LOOP(id, PUT(pi, lrb_##id(c, B_pi, 0x1b)))
#define ROW_V_XI(id) LOOP(id, PUT(ps, lrb_##id(c, B_ps, 0x1b)))
#define ROW_VI_XX(id) LOOP(id, PUT(pi, lrb_##id(c, A_pi, B_pi)))
#define ROW_VI_XXI(id) LOOP(id, PUT(pi, lrb_##id(c, A_pi, B_pi, 3)))
#define ROW_K_R(id) LOOP(id, PUT_K(lrb_##id(c, R)))
#define ROW_R_K(id) LOOP(id, PUT_R(lrb_##id(c, K)))
#define ROW_R_RI(id) LOOP(id, PUT_R(lrb_##id(c, R, 5)))
#define ROW_R_KK(id) LOOP(id, PUT_R(lrb_##id(c, K, KB)))
#define ROW_K_RI(id) LOOP(id, PUT_K(lrb_##id(c, R, 2)))
#define ROW_R_RIII(id) LOOP(id, PUT_R(lrb_##id(c, R, 5, 3, 17)))
#define ROW_R_RRIII(id) LOOP(id, PUT_R(lrb_##id(c, R, RB, 5, 3, 17)))

/* Conversions: to nearest, without an adjustment of the exponent. */
#define NEAREST (lrb_rounding)0
#define ROW_VI_ps_II(id) LOOP(id, PUT(pi, lrb_##id(c, B_ps, NEAREST, LRB_ADJUST_NONE)))
#define ROW_V_pi_II(id) LOOP(id, PUT(ps, lrb_##id(c, B_pi, NEAREST, LRB_ADJUST_NONE)))
#define ROW_V_V_II(id) LOOP(id, PUT(ps, lrb_##id(c, B_ps, NEAREST, LRB_ADJUST_NONE)))
#define ROW_VD_V_II(id) LOOP(id, PUT(pd, lrb_##id(c, B_pd, NEAREST, LRB_ADJUST_NONE)))
#define ROW_V_V_NS(id) LOOP(id, PUT(ps, lrb_##id(c, B_ps, (lrb_mantissa)0, (lrb_mantissa_sign)0)))
#define ROW_VD_V_NS(id) LOOP(id, PUT(pd, lrb_##id(c, B_pd, (lrb_mantissa)0, (lrb_mantissa_sign)0)))
#define ROW_VD_ps(id) LOOP(id, PUT(pd, lrb_##id(c, B_ps)))
#define ROW_VD_pi(id) LOOP(id, PUT(pd, lrb_##id(c, B_pi)))
#define ROW_V_pd_I(id) LOOP(id, PUT(ps, lrb_##id(c, B_pd, NEAREST)))
#define ROW_VI_pd_I(id) LOOP(id, PUT(pi, lrb_##id(c, B_pd, NEAREST)))
#define ROW_V_Vpd_I(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, B_pd, NEAREST)))
#define ROW_VI_Vpd_I(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, B_pd, NEAREST)))
#define ROW_VI_ps(id) LOOP(id, PUT(pi, lrb_##id(c, B_ps)))
#define ROW_V_pi(id) LOOP(id, PUT(ps, lrb_##id(c, B_pi)))
#define ROW_VI_Vps_I(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, B_ps, 1)))
#define ROW_V_Vpi(id) LOOP(id, PUT(ps, lrb_##id(c, A_ps, B_pi)))
#define ROW_V_VV_I(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, B_ps, 0x12345)))
#define ROW_V_VVpi(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, A_ps, B_pi)))
#define ROW_VD_VVpq(id) LOOP(id, PUT(pd, lrb_##id(c, D_pd, A_pd, B_pq)))

/* Memory: the context's scratch, aligned, in the host's first cache; streams and gathers under half masks, gathers of one line. */
#define M lrb_at(lrb_segment_at(c->scratch, 0), 4096)
#define INDEX ((lrb_v16i){.lanes = lanes_load_pi(places)})
static const int32_t places[16] = {0, 5, 2, 7, 4, 1, 6, 3, 1, 3, 5, 7, 0, 2, 4, 6};
#define ROW_V_M(id) LOOP(id, PUT(ps, lrb_##id(c, M)))
#define ROW_VI_M(id) LOOP(id, PUT(pi, lrb_##id(c, M)))
#define ROW_VD_M(id) LOOP(id, PUT(pd, lrb_##id(c, M)))
#define ROW_VQ_M(id) LOOP(id, PUT(pq, lrb_##id(c, M)))
#define ROW_M_V(id) LOOP(id, lrb_##id(c, M, A_ps))
#define ROW_M_VI(id) LOOP(id, lrb_##id(c, M, A_pi))
#define ROW_M_VD(id) LOOP(id, lrb_##id(c, M, A_pd))
#define ROW_M_VQ(id) LOOP(id, lrb_##id(c, M, A_pq))
#define ROW_ML_V(id) LOOP(id, lrb_##id(c, M, A_ps))
#define ROW_ML_VD(id) LOOP(id, lrb_##id(c, M, A_pd))
#define ROW_V_MC(id) LOOP(id, PUT(ps, lrb_##id(c, M, (lrb_up_ps)1)))
#define ROW_VI_MC(id) LOOP(id, PUT(pi, lrb_##id(c, M, (lrb_up_pi)1)))
#define ROW_MC_V(id) LOOP(id, lrb_mask_##id(c, M, K, A_ps, (lrb_down_ps)1))
#define ROW_MC_VI(id) LOOP(id, lrb_mask_##id(c, M, K, A_pi, (lrb_down_pi)1))
#define ROW_V_MS(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, K, M)))
#define ROW_VI_MS(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, K, M)))
#define ROW_VD_MS(id) LOOP(id, PUT(pd, lrb_##id(c, D_pd, K, M)))
#define ROW_VQ_MS(id) LOOP(id, PUT(pq, lrb_##id(c, D_pq, K, M)))
#define ROW_MS_V(id) LOOP(id, lrb_##id(c, M, K, A_ps))
#define ROW_MS_VI(id) LOOP(id, lrb_##id(c, M, K, A_pi))
#define ROW_MS_VD(id) LOOP(id, lrb_##id(c, M, K, A_pd))
#define ROW_MS_VQ(id) LOOP(id, lrb_##id(c, M, K, A_pq))
#define ROW_V_MSC(id) LOOP(id, PUT(ps, lrb_##id(c, D_ps, K, M, (lrb_up_ps)1)))
#define ROW_VI_MSC(id) LOOP(id, PUT(pi, lrb_##id(c, D_pi, K, M, (lrb_up_pi)1)))
#define ROW_MSC_V(id) LOOP(id, lrb_##id(c, M, K, A_ps, (lrb_down_ps)1))
#define ROW_MSC_VI(id) LOOP(id, lrb_##id(c, M, K, A_pi, (lrb_down_pi)1))
#define ROW_V_MVI(id) LOOP(id, lrb_k16 k = K; PUT(ps, lrb_##id(c, D_ps, &k, M, INDEX, 4)); PUT_K(k))
#define ROW_VI_MVI(id) LOOP(id, lrb_k16 k = K; PUT(pi, lrb_##id(c, D_pi, &k, M, INDEX, 4)); PUT_K(k))
#define ROW_VD_MVI(id) LOOP(id, lrb_k16 k = K; PUT(pd, lrb_##id(c, D_pd, &k, M, INDEX, 8)); PUT_K(k))
#define ROW_VQ_MVI(id) LOOP(id, lrb_k16 k = K; PUT(pq, lrb_##id(c, D_pq, &k, M, INDEX, 8)); PUT_K(k))
#define ROW_MVI_V(id) LOOP(id, lrb_k16 k = K; lrb_##id(c, M, &k, INDEX, 4, A_ps); PUT_K(k))
#define ROW_MVI_VI(id) LOOP(id, lrb_k16 k = K; lrb_##id(c, M, &k, INDEX, 4, A_pi); PUT_K(k))
#define ROW_MVI_VD(id) LOOP(id, lrb_k16 k = K; lrb_##id(c, M, &k, INDEX, 8, A_pd); PUT_K(k))
#define ROW_MVI_VQ(id) LOOP(id, lrb_k16 k = K; lrb_##id(c, M, &k, INDEX, 8, A_pq); PUT_K(k))
#define ROW_R_M(id) LOOP(id, PUT_R(lrb_##id(c, M)))
#define ROW_M_R(id) LOOP(id, lrb_##id(c, M, R))
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
