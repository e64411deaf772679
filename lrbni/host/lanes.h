/* The lanes of the back end chosen at configure time (Meson option 'host_backend'). */
#ifndef LRBNI_HOST_LANES_H
#define LRBNI_HOST_LANES_H

#if defined(LRB_HOST_AVX512)
#include "lrbni/host/avx512/lanes64.h"
#elif defined(LRB_HOST_AVX2)
#include "lrbni/host/avx2/lanes64.h"
#else
#include "lrbni/host/portable/lanes64.h"
#endif

#endif
