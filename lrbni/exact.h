/* Arithmetic in any state of the machine (lrbni/control.h), in integers: the same bits on every host. Where the state is not the
 * default one, every back end calls this.
 *
 * The rules are those of numeric.h: one rounding; the first NaN of x, y, z, made quiet; an invalid operation gives the default
 * NaN. Beyond them:
 *
 * - A result is tiny if, rounded with an exponent of any size, it lies below the smallest normal number (the rule of x86 is
 *   assumed, golden case 10); flush-to-zero gives a zero of its sign.
 * - An exact zero from a sum of opposite numbers is -0 when rounding down and +0 otherwise (IEEE 754).
 * - An overflow gives infinity or the largest number, as the rounding mode directs (IEEE 754).
 */
#ifndef LRBNI_EXACT_H
#define LRBNI_EXACT_H

#include <stdint.h>

#include "lrbni/control.h"

/* Named as the lane functions of the back ends are. */
typedef enum lrb_exact_op {
    LRB_EXACT_add,    /* x + y */
    LRB_EXACT_sub,    /* x - y */
    LRB_EXACT_addn,   /* (-x) + (-y) */
    LRB_EXACT_mul,    /* x * y */
    LRB_EXACT_fmadd,  /* x * y + z */
    LRB_EXACT_fmsub,  /* x * y - z */
    LRB_EXACT_fnmadd, /* z - x * y */
    LRB_EXACT_fnmsub  /* (-z) - x * y */
} lrb_exact_op;

/** 16 floats or 8 doubles, as bits; two-source ops do not look at z. */
void lrb_exact_ps(lrb_control control, lrb_exact_op op, uint32_t r[16], const uint32_t x[16], const uint32_t y[16],
                  const uint32_t z[16]);
void lrb_exact_pd(lrb_control control, lrb_exact_op op, uint64_t r[8], const uint64_t x[8], const uint64_t y[8],
                  const uint64_t z[8]);

/** A subnormal number as a zero of its sign, anything else as it is. */
static inline uint32_t lrb_flushed_ps(uint32_t bits)
{
    return bits & UINT32_C(0x7f800000) ? bits : bits & UINT32_C(0x80000000);
}

static inline uint64_t lrb_flushed_pd(uint64_t bits)
{
    return bits & UINT64_C(0x7ff0000000000000) ? bits : bits & UINT64_C(0x8000000000000000);
}

#endif
