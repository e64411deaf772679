/* Compares: a mask from two vectors; lanes whose bit in the write-mask is 0 give 0. */
#ifndef LRBNI_OPS_COMPARE_H
#define LRBNI_OPS_COMPARE_H

#include "lrbni/ops/forms.h"

LRB_COMPARE(cmpeq_ps, ps)
LRB_COMPARE(cmplt_ps, ps)
LRB_COMPARE(cmple_ps, ps)
LRB_COMPARE(cmpunord_ps, ps)
LRB_COMPARE(cmpneq_ps, ps)
LRB_COMPARE(cmpnlt_ps, ps)
LRB_COMPARE(cmpnle_ps, ps)
LRB_COMPARE(cmpord_ps, ps)
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
