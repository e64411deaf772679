/* Compiled with PROGRAM_RUN as the name of the entry, for one back end, at LRB_RECORD. */
#include <string.h>

#include "tests/lrbni/program.h"

#define LRB_SOURCE 1
#include "lrbni/base/hash.h"
#include "lrbni/lrbni.h"

enum { STEP_BYTES = 8, MEMORY_ADDRESS = 0x10000 };

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

static lrb_s3f s3_ps(const machine *m, lrb_v16f b)
{
    switch (FORM) {
    case 0: return lrb_full_ps(place(m, 64, 64));
    case 1: return lrb_1to16_ps(place(m, 4, 4));
    case 2: return lrb_4to16_ps(place(m, 16, 16));
    case 3: return lrb_swizzle_ps(b, LRB_DCBA);
    case 4: return lrb_swizzle_ps(b, LRB_CDAB);
    case 5: return lrb_swizzle_ps(b, LRB_BADC);
    case 6: return lrb_swizzle_ps(b, LRB_AAAA);
    case 7: return lrb_swizzle_ps(b, LRB_BBBB);
    case 8: return lrb_swizzle_ps(b, LRB_CCCC);
    case 9: return lrb_swizzle_ps(b, LRB_DDDD);
    case 10: return lrb_swizzle_ps(b, LRB_DACB);
    default: return lrb_reg_ps(b);
    }
}

static lrb_s3i s3_pi(const machine *m, lrb_v16i b)
{
    switch (FORM) {
    case 0: return lrb_full_pi(place(m, 64, 64));
    case 1: return lrb_1to16_pi(place(m, 4, 4));
    case 2: return lrb_4to16_pi(place(m, 16, 16));
    default: return lrb_reg_pi(b);
    }
}

/* What an op of each shape does with the instruction's operands. */
#define STEP_V_V(id) D = MASKED ? lrb_mask_##id##_s3(c, D, K, s3_ps(m, B)) : lrb_##id##_s3(c, s3_ps(m, B));
#define STEP_V_VV(id) D = MASKED ? lrb_mask_##id##_s3(c, D, K, A, s3_ps(m, B)) : lrb_##id##_s3(c, A, s3_ps(m, B));
#define STEP_V_VVV(id) D = MASKED ? lrb_mask_##id##_s3(c, D, K, A, s3_ps(m, B)) : lrb_##id##_s3(c, D, A, s3_ps(m, B));
#define STEP_VI_V(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, s3_pi(m, BI)) : lrb_##id##_s3(c, s3_pi(m, BI)));
#define STEP_VI_VV(id) \
    D = lrb_castpi_ps(MASKED ? lrb_mask_##id##_s3(c, DI, K, AI, s3_pi(m, BI)) : lrb_##id##_s3(c, AI, s3_pi(m, BI)));
#define STEP_V_VII(id) \
    D = MASKED ? lrb_mask_##id(c, D, K, A, m->code[4], m->code[5]) : lrb_##id(c, A, m->code[4], m->code[5]);
#define LOAD(suffix, old)                                                               \
    FORM % 4 == 0   ? lrb_load_##suffix(c, place(m, 64, 64))                            \
    : FORM % 4 == 1 ? lrb_load_1to16_##suffix(c, place(m, 4, 4))                        \
    : FORM % 4 == 2 ? lrb_load_4to16_##suffix(c, place(m, 16, 16))                      \
                    : lrb_mask_load_##suffix(c, old, K, place(m, 64, 64))
#define STEP_V_M(id) D = LOAD(ps, D);
#define STEP_VI_M(id) D = lrb_castpi_ps(LOAD(pi, DI));
#define STEP_M_V(id) \
    if (MASKED) lrb_mask_##id(c, place(m, 64, 64), K, A); else lrb_##id(c, place(m, 64, 64), A);
#define STEP_M_VI(id) \
    if (MASKED) lrb_mask_##id(c, place(m, 64, 64), K, AI); else lrb_##id(c, place(m, 64, 64), AI);
#define STEP_K_VV(id) KD = MASKED ? lrb_mask_##id##_s3(c, K, A, s3_ps(m, B)) : lrb_##id##_s3(c, A, s3_ps(m, B));
#define STEP_KI_VV(id) KD = MASKED ? lrb_mask_##id##_s3(c, K, AI, s3_pi(m, BI)) : lrb_##id##_s3(c, AI, s3_pi(m, BI));
#define STEP_K_KK(id) KD = lrb_##id(c, KA, KB);
#define STEP_K_K(id) KD = lrb_##id(c, KA);
#define STEP_F_KK(id) m->flags = lrb_##id(c, KA, KB);
#define STEP_K_R(id) KD = lrb_##id(c, RA);
#define STEP_R_K(id) RD = lrb_##id(c, KA);
#define STEP_R_R(id) RD = lrb_##id(c, RA);
#define STEP_R_RR(id) RD = lrb_##id(c, RA, RB);
#define STEP_R_RI(id) RD = lrb_##id(c, RA, m->code[4] % 64);
#define STEP_P_PR(id) m->p = lrb_##id(c, m->memory, lrb_imm(m->code[5]), 1u << (m->code[4] & 1), m->code[6]);
#define STEP_R_M(id) RD = lrb_##id(c, place(m, 1, 4));
#define STEP_M_R(id) lrb_##id(c, place(m, 1, 4), RA);
#define STEP_F_RR(id) m->flags = lrb_##id(c, RA, RB);
#define STEP_B_F(id) \
    if (m->code[2] & 1 ? lrb_jl(c, m->flags) : lrb_jz(c, m->flags)) m->skip = 1;
#define STEP_B(id) lrb_##id(c);
#define STEP_H_M(id) lrb_##id(c, place(m, 1, 1));
#define STEP_H_R(id) lrb_##id(c, RA);
#define STEP_MARK(id) lrb_##id(c, m->code[2]);

static void step(machine *m)
{
    lrb_ctx *c = m->c;
    switch (m->code[0] % LRB_OP_COUNT) {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) \
    case LRB_OP_##id:                                                \
        STEP_##shape(id) break; /* case LRB_OP_add_ps: D = MASKED ? lrb_mask_add_ps_s3(...) : lrb_add_ps_s3(...); break; */
#include "lrbni/ops.def"
    }
}

static void hash_events(void *user, const lrb_event *events, uint32_t count)
{
    uint64_t *hash = user;
    *hash = base_hash(*hash, events, count * sizeof *events);
}

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

int PROGRAM_RUN(program_state *s, const uint8_t *code, size_t size)
{
    machine m = {0};
    s->events = BASE_HASH_START;
    if (lrb_ctx_create(hash_events, &s->events, &m.c, NULL) != BASE_OK)
        return -1;
    lrb_ctx_begin(m.c);
    load_state(&m, s);
    for (size_t at = 0; at < size / STEP_BYTES; at += 1 + m.skip) {
        m.code = code + at * STEP_BYTES;
        m.skip = 0;
        step(&m);
    }
    store_state(&m, s);
    lrb_ctx_end(m.c);
    lrb_ctx_destroy(&m.c);
    return 0;
}
