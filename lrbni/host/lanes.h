/* The 16 lanes of the back end chosen at configure time (Meson option 'host_backend'). */
#ifndef LRBNI_HOST_LANES_H
#define LRBNI_HOST_LANES_H

#if defined(LRB_HOST_AVX512)
#include "lrbni/host/avx512/lanes.h"
#elif defined(LRB_HOST_AVX2)
#include "lrbni/host/avx2/lanes.h"
#else
#include "lrbni/host/portable/lanes.h"
#endif

#endif
