#include "tests/lrbni/level_kernel.h"

#define LRB_SOURCE 1
#include "lrbni/lrbni.h"

#define PASTE(a, b) a##b
#define AT_LEVEL(name, level) PASTE(name, level)
#ifdef LRB_ANNOTATED
#define LEVEL annotated
#else
#define LEVEL LRB_LEVEL
#endif

/* Lanes nearer than the nearest so far, and what they are worth. */
static lrb_v16f weigh(lrb_ctx *c, lrb_v16f v, lrb_v16f nearest, lrb_ptr p, lrb_k16 *closer)
{
    lrb_v16f half = lrb_load_1to16_ps(c, lrb_at(p, 4));
    lrb_v16f w = lrb_mul_ps(c, v, half);
    w = lrb_madd231_ps(c, w, v, nearest);
    w = lrb_madd213_ps_s3(c, w, v, lrb_swizzle_ps(half, LRB_DACB));
    w = lrb_mask_madd132_ps(c, w, *closer, half, v);
    w = lrb_mask_msub231_ps_s3(c, w, *closer, v, lrb_full_ps(lrb_at(p, 0)));
    w = lrb_msubr231_ps(c, w, half, half);
    lrb_k16 k = lrb_cmplt_ps(c, v, nearest);
    k = lrb_mask_cmple_ps_s3(c, k, v, lrb_4to16_ps(lrb_at(p, 16)));
    k = lrb_kor(c, k, lrb_kand(c, lrb_cmpeq_ps(c, v, nearest), lrb_cmpneq_ps(c, w, v)));
    k = lrb_kxor(c, k, lrb_mask_cmpnlt_ps(c, k, w, v));
    k = lrb_kor(c, k, lrb_kandn(c, lrb_cmpnle_ps(c, w, half), lrb_cmpord_ps(c, w, v)));
    *closer = lrb_kor(c, k, lrb_cmpunord_ps(c, w, v));
    w = lrb_mask_min_ps(c, w, k, v, nearest);
    w = lrb_max_ps(c, w, lrb_sub_ps(c, lrb_subr_ps(c, v, w), lrb_add_ps(c, v, v)));
    return lrb_mask_shuf128x32_ps(c, w, *closer, lrb_rcprefine_ps(c, lrb_rcpres_ps(c, v), v), 0x1b, 0x4e);
}

/* Integer lanes of the same. */
static lrb_v16i scramble(lrb_ctx *c, lrb_v16f v, lrb_ptr p, lrb_k16 k)
{
    lrb_v16i i = lrb_castps_pi(v), m = lrb_load_4to16_pi(c, lrb_at(p, 32));
    lrb_k16 l = lrb_cmplt_pi(c, i, m);
    l = lrb_mask_cmple_pi_s3(c, l, i, lrb_full_pi(lrb_at(p, 0)));
    l = lrb_kor(c, l, lrb_knot(c, lrb_cmpeq_pi(c, i, m)));
    i = lrb_add_pi(c, lrb_xor_pi(c, i, m), lrb_and_pi(c, i, m));
    i = lrb_mask_or_pi(c, i, l, lrb_sub_pi(c, m, i), m);
    return lrb_mask_mov_pi(c, i, k, m);
}

void AT_LEVEL(level_kernel_, LEVEL)(lrb_ctx *c, lrb_segment data)
{
    lrb_ptr out = lrb_segment_at(c->scratch, 0), base = lrb_segment_at(data, 0);
    lrb_r64 left = lrb_mov(c, lrb_imm(LEVEL_VECTORS)), sum = lrb_imm(0), at = lrb_imm(0);
    lrb_v16f nearest = lrb_load_ps(c, lrb_at(base, 0));
    lrb_phase(c, 1);
    for (;;) {
        lrb_ptr p = lrb_lea(c, base, lrb_shl(c, at, 3), 8, 0);
        lrb_region(c, (uint32_t)at.value);
        lrb_prefetch1(c, lrb_at(p, 64));
        lrb_prefetch2(c, lrb_at(p, 128));
        lrb_evict1(c, lrb_at(p, 0));
        lrb_evict2(c, lrb_at(p, 0));
        lrb_delay(c, left);
        lrb_v16f v = lrb_load_ps(c, lrb_at(p, 0));
        lrb_k16 closer = lrb_cmplt_ps(c, v, nearest);
        lrb_v16f w = weigh(c, v, nearest, p, &closer);
        nearest = lrb_mask_mov_ps(c, nearest, closer, v);
        lrb_mask_store_ps(c, lrb_at(out, 0), closer, w);
        lrb_mask_store_pi(c, lrb_at(out, 64), closer, scramble(c, v, p, closer));
        closer = lrb_kand(c, closer, lrb_cmplt_ps(c, v, w)); /* few, and sometimes none */
        if (!lrb_jz(c, lrb_kortest(c, closer, closer))) {
            lrb_r64 bits = lrb_kmov_rk(c, closer);
            lrb_r64 first = lrb_bsfi(c, lrb_imm(UINT64_MAX), bits);
            sum = lrb_add(c, sum, lrb_imul(c, lrb_popcnt(c, bits), lrb_add(c, first, lrb_imm(1))));
            sum = lrb_bts(c, lrb_xor(c, sum, lrb_load32(c, lrb_at(p, 4))), lrb_and(c, lrb_load16(c, lrb_at(p, 6)), lrb_imm(63)));
            lrb_store32(c, lrb_at_index(out, lrb_and(c, at, lrb_imm(63)), 4, 256), lrb_or(c, sum, lrb_shr(c, sum, 32)));
        } else {
            lrb_jmp(c);
        }
        at = lrb_add(c, at, lrb_imm(1));
        left = lrb_sub(c, left, lrb_imm(1));
        if (lrb_jz(c, lrb_test(c, left, left)))
            break;
        if (lrb_jl(c, lrb_cmp(c, left, lrb_imm(0))))
            break;
    }
    lrb_store_ps(c, lrb_at(out, 512), nearest);
    lrb_store_pi(c, lrb_at(out, 576), lrb_mask_load_pi(c, lrb_castps_pi(nearest), lrb_kmov_kr(c, sum), lrb_at(base, 64)));
}
