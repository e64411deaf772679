/* Mask registers, general registers, compares of them and branches. */
#ifndef LRBNI_OPS_SCALAR_H
#define LRBNI_OPS_SCALAR_H

#include "lrbni/ops/bits.h"
#include "lrbni/ops/operand.h"

/* LRB_MASK_BINARY(kand, a.bits & b.bits) */
#define LRB_MASK_BINARY(id, result)                                                                       \
    LRB_INLINE lrb_k16 lrb_##id(lrb_ctx *c, lrb_k16 a, lrb_k16 b)                                         \
    {                                                                                                     \
        lrb_k16 r = {.bits = (result) & 0xffffu};                                                         \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));          \
        return r;                                                                                         \
    }
LRB_MASK_BINARY(kand, a.bits & b.bits)
LRB_MASK_BINARY(kandn, ~a.bits & b.bits)
LRB_MASK_BINARY(kor, a.bits | b.bits)
LRB_MASK_BINARY(kxor, a.bits ^ b.bits)
LRB_MASK_BINARY(kxnor, ~(a.bits ^ b.bits))
LRB_MASK_BINARY(kandnr, a.bits & ~b.bits)
LRB_MASK_BINARY(kswapb, a.bits >> 8 | (b.bits & 0xff) << 8)
LRB_MASK_BINARY(kmovlhb, (a.bits & 0xff) | (b.bits & 0xff) << 8)
#undef LRB_MASK_BINARY

/* LRB_MASK_UNARY(knot, ~a.bits) */
#define LRB_MASK_UNARY(id, result)                                                                        \
    LRB_INLINE lrb_k16 lrb_##id(lrb_ctx *c, lrb_k16 a)                                                    \
    {                                                                                                     \
        lrb_k16 r = {.bits = (result) & 0xffffu};                                                         \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));                    \
        return r;                                                                                         \
    }
LRB_MASK_UNARY(knot, ~a.bits)
LRB_MASK_UNARY(kmov_kk, a.bits)
#undef LRB_MASK_UNARY

/* LRB_MASK_CONCATENATE(kconcath, 32): two masks in bits shift + 31 to shift of a general register, a above b, 0 elsewhere */
#define LRB_MASK_CONCATENATE(id, shift)                                                                   \
    LRB_INLINE lrb_r64 lrb_##id(lrb_ctx *c, lrb_k16 a, lrb_k16 b)                                         \
    {                                                                                                     \
        lrb_r64 r = {.value = (uint64_t)(a.bits << 16 | b.bits) << (shift)};                              \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));          \
        return r;                                                                                         \
    }
LRB_MASK_CONCATENATE(kconcath, 32)
LRB_MASK_CONCATENATE(kconcatl, 0)
#undef LRB_MASK_CONCATENATE

/** Mask from 16 bits of a general register: the highest for n = 0, the lowest for n = 3. */
LRB_INLINE lrb_k16 lrb_kextract(lrb_ctx *c, lrb_r64 a, unsigned n)
{
    assert(n < 4);
    lrb_k16 r = {.bits = (uint32_t)(a.value >> (48 - 16 * n)) & 0xffffu};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_kextract, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

/** Mask from the low 16 bits of a general register, and back. */
LRB_INLINE lrb_k16 lrb_kmov_kr(lrb_ctx *c, lrb_r64 a)
{
    lrb_k16 r = {.bits = (uint32_t)a.value & 0xffffu};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_kmov_kr, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

LRB_INLINE lrb_r64 lrb_kmov_rk(lrb_ctx *c, lrb_k16 a)
{
    lrb_r64 r = {.value = a.bits};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_kmov_rk, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

/** Flags of a | b: zero if no bit is set, carry if all 16 are. */
LRB_INLINE lrb_flags lrb_kortest(lrb_ctx *c, lrb_k16 a, lrb_k16 b)
{
    lrb_flags f = {.zero = (a.bits | b.bits) == 0, .carry = (a.bits | b.bits) == 0xffffu};
    LRB_SET_FROM(f, lrb_emit(c, LRB_OP_kortest, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));
    return f;
}

/* LRB_SCALAR_BINARY(add, a.value + b.value) */
#define LRB_SCALAR_BINARY(id, result)                                                                     \
    LRB_INLINE lrb_r64 lrb_##id(lrb_ctx *c, lrb_r64 a, lrb_r64 b)                                         \
    {                                                                                                     \
        lrb_r64 r = {.value = result};                                                                    \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));          \
        return r;                                                                                         \
    }
LRB_SCALAR_BINARY(add, a.value + b.value)
LRB_SCALAR_BINARY(sub, a.value - b.value)
LRB_SCALAR_BINARY(and, a.value & b.value)
LRB_SCALAR_BINARY(or, a.value | b.value)
LRB_SCALAR_BINARY(xor, a.value ^ b.value)
LRB_SCALAR_BINARY(imul, a.value *b.value)
LRB_SCALAR_BINARY(bsfi, lrb_bit_above(a.value, b.value))
LRB_SCALAR_BINARY(bsri, lrb_bit_below(a.value, b.value))
LRB_SCALAR_BINARY(tzcnti, lrb_zeros_from(a.value, b.value))
LRB_SCALAR_BINARY(bitinterleave11, lrb_interleave(a.value, b.value, 1))
LRB_SCALAR_BINARY(bitinterleave21, lrb_interleave(a.value, b.value, 2))
LRB_SCALAR_BINARY(bts, a.value | UINT64_C(1) << (b.value & 63))
#undef LRB_SCALAR_BINARY

/* LRB_SCALAR_UNARY(popcnt, ...) */
#define LRB_SCALAR_UNARY(id, result)                                                                      \
    LRB_INLINE lrb_r64 lrb_##id(lrb_ctx *c, lrb_r64 a)                                                    \
    {                                                                                                     \
        lrb_r64 r = {.value = result};                                                                    \
        LRB_SET_FROM(r, lrb_emit(c, LRB_OP_##id, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));                    \
        return r;                                                                                         \
    }
LRB_SCALAR_UNARY(mov, a.value)
LRB_SCALAR_UNARY(popcnt, (uint64_t)__builtin_popcountll(a.value))
LRB_SCALAR_UNARY(bsff, lrb_bit_above(UINT64_MAX, a.value))
LRB_SCALAR_UNARY(bsrf, lrb_bit_below(64, a.value))
LRB_SCALAR_UNARY(tzcnt, lrb_zeros_from(0, a.value))
LRB_SCALAR_UNARY(lzcnt, 63 - lrb_bit_below(64, a.value))
LRB_SCALAR_UNARY(quadmask16, lrb_quads(a.value))
#undef LRB_SCALAR_UNARY

LRB_INLINE lrb_r64 lrb_shl(lrb_ctx *c, lrb_r64 a, unsigned n)
{
    assert(n < 64);
    lrb_r64 r = {.value = a.value << n};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_shl, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

LRB_INLINE lrb_r64 lrb_shr(lrb_ctx *c, lrb_r64 a, unsigned n)
{
    assert(n < 64);
    lrb_r64 r = {.value = a.value >> n};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_shr, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

/** Bits low to high of a rotated left by n, 0 elsewhere; and a with those bits of b in place of its own. */
LRB_INLINE lrb_r64 lrb_rotatefield(lrb_ctx *c, lrb_r64 a, unsigned n, unsigned low, unsigned high)
{
    assert(n < 64 && low <= high && high < 64);
    lrb_r64 r = {.value = lrb_field(a.value, n, low, high)};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_rotatefield, 0, 0xffff, LRB_FROM(a), 0, 0, 0, 0));
    return r;
}

LRB_INLINE lrb_r64 lrb_insertfield(lrb_ctx *c, lrb_r64 a, lrb_r64 b, unsigned n, unsigned low, unsigned high)
{
    assert(n < 64 && low <= high && high < 64);
    lrb_r64 r = {.value = (a.value & ~lrb_field(UINT64_MAX, 0, low, high)) | lrb_field(b.value, n, low, high)};
    LRB_SET_FROM(r, lrb_emit(c, LRB_OP_insertfield, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));
    return r;
}

/** Pointer base + index * scale + displacement, scale 1, 2, 4 or 8. */
LRB_INLINE lrb_ptr lrb_lea(lrb_ctx *c, lrb_ptr base, lrb_r64 index, unsigned scale, int32_t displacement)
{
    lrb_mem m = lrb_at_index(base, index, scale, displacement);
    lrb_ptr p = {.host = m.host, .address = m.address};
    LRB_SET_FROM(p, lrb_emit(c, LRB_OP_lea, 0, 0xffff, LRB_FROM(base), LRB_FROM(index), 0, 0, 0));
    return p;
}

/** Flags of a - b, and of a & b. */
LRB_INLINE lrb_flags lrb_cmp(lrb_ctx *c, lrb_r64 a, lrb_r64 b)
{
    lrb_flags f = {.zero = a.value == b.value, .carry = a.value < b.value, .less = (int64_t)a.value < (int64_t)b.value};
    LRB_SET_FROM(f, lrb_emit(c, LRB_OP_cmp, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));
    return f;
}

LRB_INLINE lrb_flags lrb_test(lrb_ctx *c, lrb_r64 a, lrb_r64 b)
{
    lrb_flags f = {.zero = (a.value & b.value) == 0, .less = (int64_t)(a.value & b.value) < 0};
    LRB_SET_FROM(f, lrb_emit(c, LRB_OP_test, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));
    return f;
}

/** Flags of the comparison of two addresses. */
LRB_INLINE lrb_flags lrb_cmp_ptr(lrb_ctx *c, lrb_ptr a, lrb_ptr b)
{
    lrb_flags f = {.zero = a.address == b.address, .carry = a.address < b.address};
    LRB_SET_FROM(f, lrb_emit(c, LRB_OP_cmp, 0, 0xffff, LRB_FROM(a), LRB_FROM(b), 0, 0, 0));
    return f;
}

/*
 * Branches. lrb_jz(c, flags) and so on jump, and say so, if the condition holds: `if (lrb_jz(c, f)) ...`. The site,
 * which tells one branch of a kernel from another, is the number of the source file (LRB_SOURCE, defined by the file)
 * and the line.
 */
#define LRB_SITE ((uint32_t)(LRB_SOURCE) << 16 | __LINE__)

LRB_INLINE bool lrb_jump_if(lrb_ctx *c, uint32_t site, lrb_flags f, bool taken)
{
    lrb_emit(c, LRB_OP_jcc, 0, taken, LRB_FROM(f), 0, 0, 0, site);
    return taken;
}

#define lrb_jz(c, flags) lrb_jump_if_zero(c, LRB_SITE, flags)
#define lrb_jnz(c, flags) lrb_jump_if_not_zero(c, LRB_SITE, flags)
#define lrb_jb(c, flags) lrb_jump_if_below(c, LRB_SITE, flags)
#define lrb_jl(c, flags) lrb_jump_if_less(c, LRB_SITE, flags)
#define lrb_jkzd(c, k) lrb_jump_if_mask_zero(c, LRB_SITE, k)
#define lrb_jknzd(c, k) lrb_jump_if_mask_not_zero(c, LRB_SITE, k)

LRB_INLINE bool lrb_jump_if_zero(lrb_ctx *c, uint32_t site, lrb_flags f) { return lrb_jump_if(c, site, f, f.zero); }
LRB_INLINE bool lrb_jump_if_not_zero(lrb_ctx *c, uint32_t site, lrb_flags f) { return lrb_jump_if(c, site, f, !f.zero); }
LRB_INLINE bool lrb_jump_if_below(lrb_ctx *c, uint32_t site, lrb_flags f) { return lrb_jump_if(c, site, f, f.carry); }
LRB_INLINE bool lrb_jump_if_less(lrb_ctx *c, uint32_t site, lrb_flags f) { return lrb_jump_if(c, site, f, f.less); }

/* The jumps of Knights Corner on a mask that is zero, or not. */
LRB_INLINE bool lrb_jump_if_mask_zero(lrb_ctx *c, uint32_t site, lrb_k16 k)
{
    lrb_emit(c, LRB_OP_jkzd, 0, k.bits == 0, LRB_FROM(k), 0, 0, 0, site);
    return k.bits == 0;
}

LRB_INLINE bool lrb_jump_if_mask_not_zero(lrb_ctx *c, uint32_t site, lrb_k16 k)
{
    lrb_emit(c, LRB_OP_jknzd, 0, k.bits != 0, LRB_FROM(k), 0, 0, 0, site);
    return k.bits != 0;
}

/** An unconditional jump. */
#define lrb_jmp(c) lrb_jump(c, LRB_SITE)

LRB_INLINE void lrb_jump(lrb_ctx *c, uint32_t site) { lrb_emit(c, LRB_OP_jmp, 0, 1, 0, 0, 0, 0, site); }

/* Markers: no instruction, no cycle; they tell the models where the stream is. Only LRB_RECORD has them. */
/** What follows belongs to that phase of the kernel (a number of the kernel's own list of phases). */
LRB_INLINE void lrb_phase(lrb_ctx *c, uint32_t phase) { lrb_mark(c, LRB_OP_phase, phase); }

/** What follows is done for that region of the tile (kernels/kernel.h); LRB_WHOLE_TILE: for all of it. */
#define LRB_WHOLE_TILE UINT32_MAX
LRB_INLINE void lrb_region(lrb_ctx *c, uint32_t region) { lrb_mark(c, LRB_OP_region, region); }

/** What follows is written in that source and line (LRB_SITE); what lrb_put_far tells. Annotated kernels have them from their ops. */
LRB_INLINE void lrb_line(lrb_ctx *c, uint32_t site) { lrb_mark(c, LRB_OP_line, site); }
LRB_INLINE void lrb_far(lrb_ctx *c, uint32_t number) { lrb_mark(c, LRB_OP_far, number); }

#endif
