/* Compiled with PROGRAM_RUN as the name of the entry, for one back end, at one level. */
#include <string.h>

#include "tests/lrbni/program.h"

#define LRB_SOURCE 1
#define LRB_CONTROL 1
#include "lrbni/lrbni.h"

enum { MEMORY_ADDRESS = 0x10000 };

/* The registers with their origins, and one instruction: op, form, and operand numbers. */
typedef struct machine {
    lrb_ctx *c;
    lrb_v16f v[PROGRAM_REGISTERS];
    lrb_k16 k[PROGRAM_REGISTERS];
    lrb_r64 r[PROGRAM_REGISTERS];
    lrb_flags flags;
    lrb_ptr p;
    lrb_ptr memory;
    const uint8_t *code; /* of this step */
    size_t skip;         /* steps to leave out: a jump was taken */
} machine;

#define REGISTER(n) (m->code[n] % PROGRAM_REGISTERS)
#define MASKED (m->code[1] & 0x80)
#define FORM (m->code[1] & 0x0f)
#define K m->k[m->code[1] >> 4 & 7]
#define D m->v[REGISTER(2)]
#define A m->v[REGISTER(3)]
#define B m->v[REGISTER(4)]
#define AI lrb_castps_pi(A)
#define BI lrb_castps_pi(B)
#define DI lrb_castps_pi(D)
#define AQ lrb_castps_pq(A)
#define BQ lrb_castps_pq(B)
#define DQ lrb_castps_pq(D)
#define AD lrb_castps_pd(A)
#define BD lrb_castps_pd(B)
#define DD lrb_castps_pd(D)
#define RD m->r[REGISTER(2)]
#define RA m->r[REGISTER(3)]
#define RB m->r[REGISTER(4)]
#define KD m->k[REGISTER(2)]
#define KA m->k[REGISTER(3)]
#define KB m->k[REGISTER(4)]

/* A place in memory with room for `bytes`, aligned to `align`. */
static lrb_mem place(const machine *m, int32_t align, int32_t bytes)
{
    int32_t offset = (m->code[5] | m->code[6] << 8) % (PROGRAM_MEMORY - bytes + 1);
    return lrb_at(m->memory, offset / align * align);
}

/* DEFINE_S3(ps, lrb_s3f, lrb_v16f, 1to16, 4, 4to16, 16): the last source in the form that the instruction asks for */
#define DEFINE_S3(suffix, s3, vector, one, one_bytes, four, four_bytes)                                     \
    static __attribute__((noinline)) s3 s3_##suffix(const machine *m, vector b)                             \
    {                                                                                                       \
        switch (FORM) {                                                                                     \
        case 0: return lrb_full_##suffix(place(m, 64, 64));                                                 \
        case 1: return lrb_##one##_##suffix(place(m, one_bytes, one_bytes));                                \
        case 2: return lrb_##four##_##suffix(place(m, four_bytes, four_bytes));                             \
        case 3: return lrb_swizzle_##suffix(b, LRB_DCBA);                                                   \
        case 4: return lrb_swizzle_##suffix(b, LRB_CDAB);                                                   \
        case 5: return lrb_swizzle_##suffix(b, LRB_BADC);                                                   \
        case 6: return lrb_swizzle_##suffix(b, LRB_AAAA);                                                   \
        case 7: return lrb_swizzle_##suffix(b, LRB_BBBB);                                                   \
        case 8: return lrb_swizzle_##suffix(b, LRB_CCCC);                                                   \
        case 9: return lrb_swizzle_##suffix(b, LRB_DDDD);                                                   \
        case 10: return lrb_swizzle_##suffix(b, LRB_DACB);                                                  \
        default: return lrb_reg_##suffix(b);                                                                \
        }                                                                                                   \
    }
DEFINE_S3(ps, lrb_s3f, lrb_v16f, 1to16, 4, 4to16, 16)
DEFINE_S3(pi, lrb_s3i, lrb_v16i, 1to16, 4, 4to16, 16)
DEFINE_S3(pd, lrb_s3d, lrb_v8d, 1to8, 8, 4to8, 32)
DEFINE_S3(pq, lrb_s3q, lrb_v8q, 1to8, 8, 4to8, 32)

/* The forms that ops on groups of four lanes take. */
static __attribute__((noinline)) lrb_s3f s3_groups(const machine *m, lrb_v16f b)
{
    return FORM == 0 || FORM == 2 ? s3_ps(m, b) : lrb_reg_ps(b);
}
#define S3 s3_ps(m, B)
#define S3I s3_pi(m, BI)
#define S3D s3_pd(m, BD)
#define S3Q s3_pq(m, BQ)

/* S3 of ops that take no swizzle, and no broadcast or none but {4to16}. */
#define S3_WHOLE (FORM & 1 ? lrb_full_ps(place(m, 64, 64)) : lrb_reg_ps(B))
#define S3I_WHOLE (FORM & 1 ? lrb_full_pi(place(m, 64, 64)) : lrb_reg_pi(BI))
#define S3I_GROUPS (FORM & 2 ? lrb_4to16_pi(place(m, 16, 16)) : S3I_WHOLE)

static const lrb_adjust adjusts[] = {LRB_ADJUST_NONE, LRB_ADJUST_4, LRB_ADJUST_5, LRB_ADJUST_8,
                                     LRB_ADJUST_16, LRB_ADJUST_24, LRB_ADJUST_31, LRB_ADJUST_32};

/* Whether a conversion of half a vector reads memory; the high half is a register's. */
static bool half(const machine *m, lrb_op_id op)
{
    return FORM == 0 && op != LRB_OP_cvthi_ps2pd && op != LRB_OP_cvthi_pi2pd && op != LRB_OP_cvthi_pu2pd;
}

/* What an op of each shape does with the instruction's operands. UNARY(mov_pi, lrb_castpi_ps, DI, S3I): the plain or the masked
 * form, from the old destination and S3; its result becomes the register. */
#define UNARY(id, cast, d, s3) D = cast(MASKED ? lrb_mask_##id##_s3(c, d, K, s3) : lrb_##id##_s3(c, s3));
#define BINARY(id, cast, d, a, s3) D = cast(MASKED ? lrb_mask_##id##_s3(c, d, K, a, s3) : lrb_##id##_s3(c, a, s3));
#define TERNARY(id, cast, d, a, s3) D = cast(MASKED ? lrb_mask_##id##_s3(c, d, K, a, s3) : lrb_##id##_s3(c, d, a, s3));
#define CONVERT(id, cast, d, s3, ...) \
    D = cast(MASKED ? lrb_mask_##id##_s3(c, d, K, s3, __VA_ARGS__) : lrb_##id##_s3(c, s3, __VA_ARGS__));
#define INSERT(id, cast, d, s3, ...) \
    D = cast(MASKED ? lrb_mask_##id##_s3(c, d, K, s3, __VA_ARGS__) : lrb_##id##_s3(c, d, s3, __VA_ARGS__));
#define MODE (lrb_rounding)(m->code[5] & 3)
#define FIXED MODE, adjusts[m->code[6] & 7]
#define MANTISSA (lrb_mantissa)(m->code[5] & 3), (lrb_mantissa_sign)(m->code[6] % 3)
#define COMPARE(id, a, s3) KD = MASKED ? lrb_mask_##id##_s3(c, K, a, s3) : lrb_##id##_s3(c, a, s3);
#define STEP_V_V(id) UNARY(id, , D, S3)
#define STEP_V_VV(id) BINARY(id, , D, A, S3)
#define STEP_V_VVV(id) TERNARY(id, , D, A, S3)
#define STEP_VI_V(id) UNARY(id, lrb_castpi_ps, DI, S3I)
#define STEP_VI_VV(id) BINARY(id, lrb_castpi_ps, DI, AI, S3I)
#define STEP_VD_V(id) UNARY(id, lrb_castpd_ps, DD, S3D)
#define STEP_VI_ps_II(id) CONVERT(id, lrb_castpi_ps, DI, S3, FIXED)
#define STEP_V_pi_II(id) CONVERT(id, , D, S3I, FIXED)
#define STEP_V_V_II(id) CONVERT(id, , D, S3, FIXED)
#define STEP_VD_V_II(id) CONVERT(id, lrb_castpd_ps, DD, S3D, FIXED)
#define STEP_V_V_NS(id) CONVERT(id, , D, S3, MANTISSA)
#define STEP_VD_V_NS(id) CONVERT(id, lrb_castpd_ps, DD, S3D, MANTISSA)
#define STEP_VD_ps(id) UNARY(id, lrb_castpd_ps, DD, (half(m, LRB_OP_##id) ? lrb_half_ps(place(m, 32, 32)) : lrb_reg_ps(B)))
#define STEP_VD_pi(id) UNARY(id, lrb_castpd_ps, DD, (half(m, LRB_OP_##id) ? lrb_half_pi(place(m, 32, 32)) : lrb_reg_pi(BI)))
#define STEP_V_pd_I(id) CONVERT(id, , D, S3D, MODE)
#define STEP_VI_pd_I(id) CONVERT(id, lrb_castpi_ps, DI, S3D, MODE)
#define STEP_V_Vpd_I(id) INSERT(id, , D, S3D, MODE)
#define STEP_VI_Vpd_I(id) INSERT(id, lrb_castpi_ps, DI, S3D, MODE)
#define STEP_VI_ps(id) UNARY(id, lrb_castpi_ps, DI, S3)
#define STEP_V_pi(id) UNARY(id, , D, S3I)
#define STEP_VI_Vps_I(id) INSERT(id, lrb_castpi_ps, DI, S3, m->code[5] % 3u)
#define STEP_V_Vpi(id) BINARY(id, , D, A, S3I)
#define STEP_V_VV_I(id) INSERT(id, , D, S3, m->code[5] * 0x2091u)
#define STEP_V_VVpi(id) TERNARY(id, , D, A, S3I)
#define STEP_VD_VVpq(id) TERNARY(id, lrb_castpd_ps, DD, AD, S3Q)
#define STEP_VD_VV(id) BINARY(id, lrb_castpd_ps, DD, AD, S3D)
#define STEP_VD_VVV(id) TERNARY(id, lrb_castpd_ps, DD, AD, S3D)
#define STEP_V_KVV(id) D = lrb_##id##_s3(c, K, A, S3);
#define STEP_VD_KVV(id) D = lrb_castpd_ps(lrb_##id##_s3(c, K, AD, S3D));
#define STEP_V_VX(id) BINARY(id, , D, A, s3_groups(m, B))
#define STEP_VK_VV(id) D = MASKED ? lrb_mask_##id##_s3(c, D, K, A, S3, &KD) : lrb_##id##_s3(c, A, S3, &KD);
#define STEP_V_VII(id) \
    D = MASKED ? lrb_mask_##id(c, D, K, A, m->code[4], m->code[5]) : lrb_##id(c, A, m->code[4], m->code[5]);
#define STEP_VI_VVV(id) TERNARY(id, lrb_castpi_ps, DI, AI, S3I)
#define STEP_VI_VX(id) BINARY(id, lrb_castpi_ps, DI, AI, S3I_GROUPS)
#define STEP_VQ_V(id) UNARY(id, lrb_castpq_ps, DQ, S3Q)
#define STEP_VQ_VV(id) BINARY(id, lrb_castpq_ps, DQ, AQ, S3Q)
#define STEP_VI_KVV(id) D = lrb_castpi_ps(lrb_##id##_s3(c, K, AI, S3I));
#define STEP_VQ_KVV(id) D = lrb_castpq_ps(lrb_##id##_s3(c, K, AQ, S3Q));
/* Immediates are bytes that serve as operands elsewhere. */
#define N (m->code[3])
#define LOW (m->code[5] & 31)
#define HIGH (LOW + m->code[6] % (32 - LOW))
#define STEP_VI_VI(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, S3I, N & (N & 1 ? 255 : 31)) : lrb_##id##_s3(c, S3I, N & (N & 1 ? 255 : 31)));
#define STEP_VI_VIII(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, S3I, N & 31, LOW, HIGH) : lrb_##id##_s3(c, S3I, N & 31, LOW, HIGH));
#define STEP_VI_VVIII(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, S3I, N & 31, LOW, HIGH) : lrb_##id##_s3(c, DI, S3I, N & 31, LOW, HIGH));
#define STEP_VIK_VKV(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, KA, S3I, &KD) : lrb_##id##_s3(c, DI, KA, S3I, &KD));
#define STEP_VIK_V(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, KA, S3I, &KD) : lrb_##id##_s3(c, DI, S3I, &KD));
#define STEP_VIK_VV(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, AI, S3I, &KD) : lrb_##id##_s3(c, AI, S3I, &KD));
#define STEP_VI_XII(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id(c, DI, K, AI, m->code[4], m->code[5]) : lrb_##id(c, AI, m->code[4], m->code[5]));
#define STEP_VI_XI(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, S3I_WHOLE, N) : lrb_##id##_s3(c, S3I_WHOLE, N));
#define STEP_V_XI(id) D = MASKED ? lrb_mask_##id##_s3(c, D, K, S3_WHOLE, N) : lrb_##id##_s3(c, S3_WHOLE, N);
#define STEP_VI_XX(id) BINARY(id, lrb_castpi_ps, DI, AI, S3I_WHOLE)
#define STEP_VI_XXI(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, AI, S3I_WHOLE, N % 16) : lrb_##id##_s3(c, AI, S3I_WHOLE, N % 16));
#define STEP_K_VV(id) COMPARE(id, A, S3)
#define STEP_KI_VV(id) COMPARE(id, AI, S3I)
#define STEP_KD_VV(id) COMPARE(id, AD, S3D)
#define STEP_K_KK(id) KD = lrb_##id(c, KA, KB);
#define STEP_K_K(id) KD = lrb_##id(c, KA);
#define STEP_F_KK(id) m->flags = lrb_##id(c, KA, KB);
#define STEP_K_R(id) KD = lrb_##id(c, RA);
#define STEP_R_K(id) RD = lrb_##id(c, KA);
#define STEP_R_R(id) RD = lrb_##id(c, RA);
#define STEP_R_RR(id) RD = lrb_##id(c, RA, RB);
#define STEP_R_RI(id) RD = lrb_##id(c, RA, m->code[4] % 64);
#define STEP_P_PR(id) m->p = lrb_##id(c, m->memory, lrb_imm(m->code[5]), 1u << (m->code[4] & 1), m->code[6]);
#define STEP_F_RR(id) m->flags = lrb_##id(c, RA, RB);
#define STEP_B_F(id) \
    if (m->code[2] & 1 ? lrb_jl(c, m->flags) : lrb_jz(c, m->flags)) m->skip = 1;
#define STEP_R_KK(id) RD = lrb_##id(c, KA, KB);
#define STEP_K_RI(id) KD = lrb_##id(c, RA, m->code[4] % 4);
#define STEP_R_RIII(id) RD = lrb_##id(c, RA, m->code[4] % 64, LOW, HIGH);
#define STEP_R_RRIII(id) RD = lrb_##id(c, RA, RB, m->code[6] % 64, LOW, 63 - LOW);
#define STEP_B_K(id) \
    if (lrb_##id(c, KA)) m->skip = 1;
#define STEP_B(id) lrb_##id(c);
#define STEP_C_M(id) lrb_##id(c, place(m, 1, 4));
#define STEP_M_C(id) lrb_##id(c, place(m, 1, 4));
#define STEP_H_R(id) lrb_##id(c, RA);
#define STEP_MARK(id) lrb_##id(c, m->code[2]);

#include "tests/lrbni/program_memory.h"

/* One function an op, none of them inlined: compilers stay fast however many ops there are. */
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) \
    static __attribute__((noinline)) void step_##id(machine *m)             \
    {                                                                       \
        lrb_ctx *c = m->c;                                                  \
        STEP_##shape(id) /* D = MASKED ? lrb_mask_add_ps_s3(...) : lrb_add_ps_s3(...); */ \
    }
#include "lrbni/ops.def"

static void (*const steps[LRB_OP_COUNT])(machine *m) = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) step_##id, /* step_add_ps, */
#include "lrbni/ops.def"
};

static void load_state(machine *m, program_state *s)
{
    lrb_segment memory = {.host = s->memory, .address = MEMORY_ADDRESS, .size = sizeof s->memory};
    m->p = m->memory = lrb_segment_at(memory, 0);
    for (int i = 0; i < PROGRAM_REGISTERS; i++) {
        m->v[i] = (lrb_v16f){.lanes = lanes_load_ps(s->v[i])};
        m->k[i] = lrb_mask(s->k[i]);
        m->r[i] = lrb_imm(s->r[i]);
    }
    m->flags = (lrb_flags){.zero = s->flags & 1, .carry = s->flags >> 1 & 1, .less = s->flags >> 2 & 1};
}

static void store_state(const machine *m, program_state *s)
{
    for (int i = 0; i < PROGRAM_REGISTERS; i++) {
        lanes_store_ps(s->v[i], m->v[i].lanes);
        s->k[i] = m->k[i].bits;
        s->r[i] = m->r[i].value;
    }
    s->flags = (uint8_t)(m->flags.zero | m->flags.carry << 1 | m->flags.less << 2);
    s->p = m->p.address;
}

void PROGRAM_RUN(lrb_ctx *c, program_state *s, const uint8_t *code, size_t size)
{
    machine m = {.c = c};
    load_state(&m, s);
    for (size_t at = 0; at < size / PROGRAM_STEP; at += 1 + m.skip) {
        m.code = code + at * PROGRAM_STEP;
        m.skip = 0;
        steps[(m.code[0] | m.code[7] << 8) % LRB_OP_COUNT](&m);
    }
    store_state(&m, s);
}
