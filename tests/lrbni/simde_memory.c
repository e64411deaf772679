/* Compiled twice: SIMDE_MEMORY_NAME is simde_memory_plain with SIMDE_NO_NATIVE, or simde_memory_instructions for this CPU. */
#include "tests/lrbni/simde_memory.h"

#include <simde/x86/avx2.h>
#include <simde/x86/avx512/cast.h>
#include <simde/x86/avx512/compress.h>
#include <simde/x86/avx512/cvts.h>
#include <simde/x86/avx512/expand.h>
#include <simde/x86/avx512/loadu.h>
#include <simde/x86/f16c.h>

#define I(x) simde_mm512_loadu_si512(x)
#define F(x) simde_mm512_castsi512_ps(I(x))
#define D(x) simde_mm512_castsi512_pd(I(x))
#define H(x) simde_mm256_loadu_si256(x)
#define Q(x) simde_mm_loadu_si128(x)
#define AS_F(x) simde_mm256_castsi256_ps(x)
#define AS_I(x) simde_mm256_castps_si256(x)
#define LOW H(lanes)
#define HIGH H(lanes + 8)
#define PUT_LOW(x) simde_mm256_storeu_si256(lanes, x)
#define PUT_HIGH(x) simde_mm256_storeu_si256(lanes + 8, x)
#define BITS(x) __builtin_popcount(x)

/* All ones in the lanes whose bit is set. */
static simde__m256i expand_mask(uint32_t k)
{
    int32_t lanes[8];
    for (int i = 0; i < 8; i++)
        lanes[i] = k >> i & 1 ? -1 : 0;
    return H(lanes);
}
#define EXPAND(x) expand_mask(x)

#define SIMDE_MEMORY(name, ours, theirs)                                                        \
    static void name(unsigned char *m, uint32_t k, const uint32_t index[16], uint32_t lanes[16]) \
    {                                                                                           \
        (void)m, (void)k, (void)index, (void)lanes;                                             \
        theirs;                                                                                 \
    }
#include "tests/lrbni/simde_memory.def"

static simde_memory_fn *const functions[] = {
#define SIMDE_MEMORY(name, ours, theirs) name, /* compress_ps, */
#include "tests/lrbni/simde_memory.def"
};

const simde_memory_ops SIMDE_MEMORY_NAME = {
#if defined(SIMDE_NO_NATIVE)
    .how = "plain C",
#else
    .how = "instructions",
#endif
    .functions = functions,
};
