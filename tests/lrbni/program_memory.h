/* What ops that load, store or hint do with an instruction's operands; part of program.c, whose macros it uses. */
#ifndef TESTS_LRBNI_PROGRAM_MEMORY_H
#define TESTS_LRBNI_PROGRAM_MEMORY_H

/* The register operands as lanes of each suffix, and back. */
#define PROGRAM_ps(v) (v)
#define PROGRAM_pi(v) lrb_castps_pi(v)
#define PROGRAM_pd(v) lrb_castps_pd(v)
#define PROGRAM_pq(v) lrb_castps_pq(v)
#define PROGRAM_FROM_ps(v) (v)
#define PROGRAM_FROM_pi(v) lrb_castpi_ps(v)
#define PROGRAM_FROM_pd(v) lrb_castpd_ps(v)
#define PROGRAM_FROM_pq(v) lrb_castpq_ps(v)

/* Memory for a stream that may reach 64 bytes above its start; a high part's address is 64 bytes up. */
static lrb_mem place_stream(const machine *m, int32_t bytes, bool high)
{
    lrb_mem start = place(m, bytes, 192);
    start.host += high ? 64 : 0;
    start.address += high ? 64 : 0;
    return start;
}

/* The lanes of B, cut down to indices that stay in memory on both sides of its middle. */
static lrb_v16i indices(const machine *m, int32_t bytes)
{
    int32_t number[16];
    const int32_t half = PROGRAM_MEMORY / 2 / bytes;
    lanes_store_pi(number, BI.lanes);
    for (int i = 0; i < 16; i++)
        number[i] = (number[i] & (2 * half - 1) & (m->code[5] % 2 ? -1 : 7)) - (m->code[5] % 2 ? half : 0);
    lrb_v16i v = BI;
    v.lanes = lanes_load_pi(number);
    return v;
}
#define MIDDLE lrb_at(m->memory, PROGRAM_MEMORY / 2)

/* PROGRAM_LOAD(load_ps, ps, 4, 1to16, 4to16): the row's own load, or a broadcast */
#define PROGRAM_LOAD(id, suffix, bytes, one, four)                                                                   \
    switch (FORM % 8) {                                                                                              \
    case 0:                                                                                                          \
        D = PROGRAM_FROM_##suffix(MASKED ? lrb_mask_load_##one##_##suffix(c, PROGRAM_##suffix(D), K, place(m, bytes, bytes)) \
                                         : lrb_load_##one##_##suffix(c, place(m, bytes, bytes)));                    \
        break;                                                                                                       \
    case 1:                                                                                                          \
        D = PROGRAM_FROM_##suffix(MASKED ? lrb_mask_load_##four##_##suffix(c, PROGRAM_##suffix(D), K, place(m, 4 * bytes, 4 * bytes)) \
                                         : lrb_load_##four##_##suffix(c, place(m, 4 * bytes, 4 * bytes)));           \
        break;                                                                                                       \
    default:                                                                                                         \
        D = PROGRAM_FROM_##suffix(MASKED ? lrb_mask_##id(c, PROGRAM_##suffix(D), K, place(m, 64, 64))                \
                                         : lrb_##id(c, place(m, 64, 64)));                                           \
    }
#define STEP_V_M(id) PROGRAM_LOAD(id, ps, 4, 1to16, 4to16)
#define STEP_VI_M(id) PROGRAM_LOAD(id, pi, 4, 1to16, 4to16)
#define STEP_VD_M(id) PROGRAM_LOAD(id, pd, 8, 1to8, 4to8)
#define STEP_VQ_M(id) PROGRAM_LOAD(id, pq, 8, 1to8, 4to8)

/* PROGRAM_STORE(store_ps, ps, 4): the row's own store, or one of the lowest lanes */
#define PROGRAM_STORE(id, suffix, bytes)                                                                             \
    if (FORM % 8 == 0)                                                                                               \
        lrb_mask_store_1_##suffix(c, place(m, bytes, bytes), K, PROGRAM_##suffix(A));                                \
    else if (FORM % 8 == 1)                                                                                          \
        lrb_store_4_##suffix(c, place(m, 4 * bytes, 4 * bytes), PROGRAM_##suffix(A));                                \
    else if (MASKED)                                                                                                 \
        lrb_mask_##id(c, place(m, 64, 64), K, PROGRAM_##suffix(A));                                                  \
    else                                                                                                             \
        lrb_##id(c, place(m, 64, 64), PROGRAM_##suffix(A));
#define STEP_M_V(id) PROGRAM_STORE(id, ps, 4)
#define STEP_M_VI(id) PROGRAM_STORE(id, pi, 4)
#define STEP_M_VD(id) PROGRAM_STORE(id, pd, 8)
#define STEP_M_VQ(id) PROGRAM_STORE(id, pq, 8)
#define STEP_ML_V(id) lrb_##id(c, place(m, 64, 64), A);
#define STEP_ML_VD(id) lrb_##id(c, place(m, 64, 64), PROGRAM_pd(A));

#define UP(suffix, TYPE) (lrb_up_##suffix)(m->code[4] % LRB_UP_##TYPE##_COUNT)
#define DOWN(suffix, TYPE) (lrb_down_##suffix)(m->code[4] % LRB_DOWN_##TYPE##_COUNT)
#define PROGRAM_LOAD_UP(id, suffix, TYPE)                                                                            \
    D = PROGRAM_FROM_##suffix(MASKED ? lrb_mask_##id(c, PROGRAM_##suffix(D), K, place(m, 64, 64), UP(suffix, TYPE))  \
                                     : lrb_##id(c, place(m, 64, 64), UP(suffix, TYPE)));
#define STEP_V_MC(id) PROGRAM_LOAD_UP(id, ps, PS)
#define STEP_VI_MC(id) PROGRAM_LOAD_UP(id, pi, PI)
#define STEP_MC_V(id) lrb_mask_##id(c, place(m, 64, 64), MASKED ? K : lrb_mask(0xffff), A, DOWN(ps, PS));
#define STEP_MC_VI(id) lrb_mask_##id(c, place(m, 64, 64), MASKED ? K : lrb_mask(0xffff), AI, DOWN(pi, PI));

#define PROGRAM_HIGH(id) (strstr(#id, "unpackh") || strstr(#id, "storeh"))
#define PROGRAM_UNPACK(id, suffix, bytes) \
    D = PROGRAM_FROM_##suffix(lrb_##id(c, PROGRAM_##suffix(D), K, place_stream(m, bytes, PROGRAM_HIGH(id))));
#define STEP_V_MS(id) PROGRAM_UNPACK(id, ps, 4)
#define STEP_VI_MS(id) PROGRAM_UNPACK(id, pi, 4)
#define STEP_VD_MS(id) PROGRAM_UNPACK(id, pd, 8)
#define STEP_VQ_MS(id) PROGRAM_UNPACK(id, pq, 8)
#define STEP_MS_V(id) lrb_##id(c, place_stream(m, 4, PROGRAM_HIGH(id)), K, A);
#define STEP_MS_VI(id) lrb_##id(c, place_stream(m, 4, PROGRAM_HIGH(id)), K, AI);
#define STEP_MS_VD(id) lrb_##id(c, place_stream(m, 8, PROGRAM_HIGH(id)), K, PROGRAM_pd(A));
#define STEP_MS_VQ(id) lrb_##id(c, place_stream(m, 8, PROGRAM_HIGH(id)), K, PROGRAM_pq(A));
#define STEP_V_MSC(id) D = lrb_##id(c, D, K, place_stream(m, 4, PROGRAM_HIGH(id)), UP(ps, PS));
#define STEP_VI_MSC(id) D = lrb_castpi_ps(lrb_##id(c, DI, K, place_stream(m, 4, PROGRAM_HIGH(id)), UP(pi, PI)));
#define STEP_MSC_V(id) lrb_##id(c, place_stream(m, 4, PROGRAM_HIGH(id)), K, A, DOWN(ps, PS));
#define STEP_MSC_VI(id) lrb_##id(c, place_stream(m, 4, PROGRAM_HIGH(id)), K, AI, DOWN(pi, PI));

#define PROGRAM_GATHER(id, suffix, bytes) \
    D = PROGRAM_FROM_##suffix(lrb_##id(c, PROGRAM_##suffix(D), &K, MIDDLE, indices(m, bytes), bytes));
#define STEP_V_MVI(id) PROGRAM_GATHER(id, ps, 4)
#define STEP_VI_MVI(id) PROGRAM_GATHER(id, pi, 4)
#define STEP_VD_MVI(id) PROGRAM_GATHER(id, pd, 8)
#define STEP_VQ_MVI(id) PROGRAM_GATHER(id, pq, 8)
#define STEP_MVI_V(id) lrb_##id(c, MIDDLE, &K, indices(m, 4), 4, A);
#define STEP_MVI_VI(id) lrb_##id(c, MIDDLE, &K, indices(m, 4), 4, AI);
#define STEP_MVI_VD(id) lrb_##id(c, MIDDLE, &K, indices(m, 8), 8, PROGRAM_pd(A));
#define STEP_MVI_VQ(id) lrb_##id(c, MIDDLE, &K, indices(m, 8), 8, PROGRAM_pq(A));
#define STEP_H_MVI(id) lrb_##id(c, &K, MIDDLE, indices(m, 1), 8);
#define STEP_H_VIM(id) lrb_##id(c, K, MIDDLE, indices(m, 1), 8);

#define STEP_R_M(id) RD = lrb_##id(c, place(m, 1, 8));
#define STEP_M_R(id) lrb_##id(c, place(m, 1, 8), RA);
#define STEP_H_M(id) lrb_##id(c, place(m, 1, 1));

#endif
