/* All ops of the vector ISA, for kernels: define LRB_LEVEL and LRB_SOURCE, then include this. */
#ifndef LRBNI_LRBNI_H
#define LRBNI_LRBNI_H

#include "lrbni/ops/arith.h"
#include "lrbni/ops/carry.h"
#include "lrbni/ops/compare.h"
#include "lrbni/ops/control.h"
#include "lrbni/ops/convert.h"
#include "lrbni/ops/exponent.h"
#include "lrbni/ops/gather.h"
#include "lrbni/ops/hints.h"
#include "lrbni/ops/integer.h"
#include "lrbni/ops/load_convert.h"
#include "lrbni/ops/load_store.h"
#include "lrbni/ops/move.h"
#include "lrbni/ops/pack.h"
#include "lrbni/ops/scalar.h"
#include "lrbni/ops/scalar_memory.h"
#include "lrbni/ops/shuffle.h"

#ifdef LRB_ANNOTATED
#include "lrbni/annotate.h"
#endif

#endif
