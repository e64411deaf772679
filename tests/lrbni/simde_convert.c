/* Compiled twice: SIMDE_NAME is simde_plain with SIMDE_NO_NATIVE, or simde_instructions for this CPU. */
#include "tests/lrbni/simde_convert.h"

#include <simde/x86/avx.h>
#include <simde/x86/avx512/cast.h>
#include <simde/x86/avx512/cvt.h>
#include <simde/x86/avx512/div.h>
#include <simde/x86/avx512/fixupimm.h>
#include <simde/x86/avx512/loadu.h>
#include <simde/x86/avx512/roundscale.h>
#include <simde/x86/avx512/scalef.h>
#include <simde/x86/avx512/set1.h>
#include <simde/x86/avx512/storeu.h>

/* Counts of vscaleps as floats, which SIMDe's function takes. */
static simde__m512 counts(const uint32_t b[16])
{
    float n[16];
    for (int i = 0; i < 16; i++)
        n[i] = (float)(int32_t)b[i];
    return simde_mm512_loadu_ps(n);
}

/* The tables of vfixupnanps as those of AVX-512: four bits for each of quiet NaN, signalling NaN, zero, one, -inf, +inf,
 * negative, positive, and other numbers for what is asked. AVX-512 knows one zero, so the sign of a's picks the bits. */
static simde__m512i tables(const uint32_t a[16], const uint32_t b[16])
{
    static const uint32_t asked[8] = {0, 4, 7, 8, 5, 3, 14, 15};
    uint32_t t[16];
    for (int i = 0; i < 16; i++) {
        uint32_t kind[7];
        for (int k = 0; k < 7; k++)
            kind[k] = asked[b[i] >> 3 * k & 7];
        uint32_t zero = a[i] >> 31 ? kind[2] : kind[3];
        t[i] = 2 | 2 << 4 | zero << 8 | kind[4] << 12 | kind[0] << 16 | kind[5] << 20 | kind[1] << 24 | kind[4] << 28;
    }
    return simde_mm512_loadu_si512(t);
}

#define FROM(words) simde_mm512_castsi512_ps(simde_mm512_loadu_si512(words))
#define I16 simde_mm512_loadu_si512(b)
#define F16 FROM(b)
#define D8 simde_mm512_castsi512_pd(I16)
#define I8(word) simde_mm256_loadu_si256((const void *)(b + (word)))
#define F8(word) simde_mm256_castsi256_ps(I8(word))
#define D4(word) simde_mm256_castsi256_pd(I8(word))
#define I4(word) simde_mm_loadu_si128((const void *)(b + (word)))
#define F4(word) simde_mm_castsi128_ps(I4(word))
#define PUT_PS16(x) simde_mm512_storeu_si512(out, simde_mm512_castps_si512(x));
#define PUT_PD8(x) simde_mm512_storeu_si512(out, simde_mm512_castpd_si512(x));
#define PUT_I8(word, x) simde_mm256_storeu_si256((void *)(out + (word)), x);
#define PUT_PS8(word, x) PUT_I8(word, simde_mm256_castps_si256(x))
#define PUT_PD4(word, x) PUT_I8(word, simde_mm256_castpd_si256(x))
#define PUT_I4(word, x) simde_mm_storeu_si128((void *)(out + (word)), x);
#define PUT_PS4(word, x) PUT_I4(word, simde_mm_castps_si128(x))

#define SIMDE_CONVERT(name, source, result, except, ours, theirs)                                                        \
    static void name(const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], uint32_t out[16])         \
    {                                                                                                            \
        (void)d, (void)a;                                                                                        \
        theirs                                                                                                   \
    }
#include "tests/lrbni/simde_convert.def"

static simde_convert_fn *const functions[] = {
#define SIMDE_CONVERT(name, source, result, except, ours, theirs) name, /* cvtpi2ps, */
#include "tests/lrbni/simde_convert.def"
};

const simde_conversions SIMDE_NAME = {
#if defined(SIMDE_NO_NATIVE)
    .how = "plain C",
    .plain = 1,
#else
    .how = "instructions",
#endif
#if defined(SIMDE_X86_AVX512F_NATIVE)
    .avx512 = 1,
#endif
    .functions = functions,
};
