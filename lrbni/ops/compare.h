/* Compares: a mask from two vectors; lanes whose bit in the write-mask is 0 give 0. */
#ifndef LRBNI_OPS_COMPARE_H
#define LRBNI_OPS_COMPARE_H

#include "lrbni/ops/control.h"

/* LRB_FLOAT_COMPARE(cmplt_ps, ps) */
#define LRB_FLOAT_COMPARE(id, suffix) \
    LRB_MASK_RESULT(id, suffix, lanes_##id(LRB_READ(c, suffix, a.lanes), LRB_READ(c, suffix, b.lanes)))
#define LRB_FLOAT_COMPARES(suffix)                   \
    LRB_FLOAT_COMPARE(cmpeq_##suffix, suffix)        \
    LRB_FLOAT_COMPARE(cmplt_##suffix, suffix)        \
    LRB_FLOAT_COMPARE(cmple_##suffix, suffix)        \
    LRB_FLOAT_COMPARE(cmpunord_##suffix, suffix)     \
    LRB_FLOAT_COMPARE(cmpneq_##suffix, suffix)       \
    LRB_FLOAT_COMPARE(cmpnlt_##suffix, suffix)       \
    LRB_FLOAT_COMPARE(cmpnle_##suffix, suffix)       \
    LRB_FLOAT_COMPARE(cmpord_##suffix, suffix)
LRB_FLOAT_COMPARES(ps)
LRB_FLOAT_COMPARES(pd)
#undef LRB_FLOAT_COMPARE
#undef LRB_FLOAT_COMPARES
LRB_COMPARE(cmpeq_pi, pi)
LRB_COMPARE(cmplt_pi, pi)
LRB_COMPARE(cmple_pi, pi)
LRB_COMPARE(cmpneq_pi, pi)
LRB_COMPARE(cmpnlt_pi, pi)
LRB_COMPARE(cmpnle_pi, pi)
LRB_COMPARE(cmpeq_pu, pi)
LRB_COMPARE(cmplt_pu, pi)
LRB_COMPARE(cmple_pu, pi)
LRB_COMPARE(cmpneq_pu, pi)
LRB_COMPARE(cmpnlt_pu, pi)
LRB_COMPARE(cmpnle_pu, pi)
LRB_COMPARE(test_pi, pi)

#endif
