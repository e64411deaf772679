/* All ops of the vector ISA, for kernels: define LRB_LEVEL and LRB_SOURCE, then include this. */
#ifndef LRBNI_LRBNI_H
#define LRBNI_LRBNI_H

#include "lrbni/ops/arith.h"
#include "lrbni/ops/compare.h"
#include "lrbni/ops/hints.h"
#include "lrbni/ops/load_store.h"
#include "lrbni/ops/scalar.h"

#ifdef LRB_ANNOTATED
#include "lrbni/annotate.h"
#endif

#endif
