/* The lanes of the back end chosen at configure time (Meson option 'host_backend'). */
#ifndef LRBNI_HOST_LANES_H
#define LRBNI_HOST_LANES_H

#if defined(LRB_HOST_AVX512)
#include "lrbni/host/avx512/arith.h"
#include "lrbni/host/avx512/convert.h"
#include "lrbni/host/avx512/half.h"
#include "lrbni/host/avx512/integer.h"
#elif defined(LRB_HOST_AVX2)
#include "lrbni/host/avx2/arith.h"
#include "lrbni/host/avx2/convert.h"
#include "lrbni/host/avx2/half.h"
#include "lrbni/host/avx2/integer.h"
#else
#include "lrbni/host/portable/arith.h"
#include "lrbni/host/portable/convert.h"
#include "lrbni/host/portable/integer.h"
#endif
#include "lrbni/host/common/conversions.h"
#include "lrbni/host/common/integer.h"

#endif
