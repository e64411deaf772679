/* The state of the machine that float ops depend on: VXCSR on Larrabee, MXCSR on Knights Corner. */
#ifndef LRBNI_CONTROL_H
#define LRBNI_CONTROL_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/rounding.h"

/* All zeros is the default: to nearest even, subnormals kept. */
typedef struct lrb_control {
    uint8_t rounding;        /* lrb_rounding */
    bool flush_to_zero;      /* results that are tiny after rounding become zeros of their sign */
    bool denormals_are_zero; /* subnormal sources are read as zeros of their sign */
} lrb_control;

/* Where they are in the register (MIC.H for VXCSR, ISAM 2.3 for MXCSR, whose bit 6 VXCSR is not known to have). Exceptions never
 * trap (RAH), and their flags are not modelled: a stored register has no flag set and all exceptions masked. */
#define LRB_CONTROL_ROUNDING_SHIFT 13
#define LRB_CONTROL_FLUSH_TO_ZERO UINT32_C(0x8000)
#define LRB_CONTROL_DENORMALS_ARE_ZERO UINT32_C(0x0040)
#define LRB_CONTROL_MASKS UINT32_C(0x1f80)

/** State from the register's bits, and back. */
static inline lrb_control lrb_control_of(uint32_t bits)
{
    return (lrb_control){.rounding = (uint8_t)(bits >> LRB_CONTROL_ROUNDING_SHIFT & 3),
                         .flush_to_zero = (bits & LRB_CONTROL_FLUSH_TO_ZERO) != 0,
                         .denormals_are_zero = (bits & LRB_CONTROL_DENORMALS_ARE_ZERO) != 0};
}

static inline uint32_t lrb_control_bits(lrb_control control)
{
    return LRB_CONTROL_MASKS | (uint32_t)control.rounding << LRB_CONTROL_ROUNDING_SHIFT |
           (control.flush_to_zero ? LRB_CONTROL_FLUSH_TO_ZERO : 0) |
           (control.denormals_are_zero ? LRB_CONTROL_DENORMALS_ARE_ZERO : 0);
}

/** The same state with another rounding mode. */
static inline lrb_control lrb_control_rounding(lrb_control control, lrb_rounding rounding)
{
    control.rounding = (uint8_t)rounding;
    return control;
}

static inline bool lrb_control_is_default(lrb_control control)
{
    return !control.rounding && !control.flush_to_zero && !control.denormals_are_zero;
}

#endif
