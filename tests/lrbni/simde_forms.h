/* How SIMDe's functions are wrapped: arrays of bits in and out. Included after SIMDe's own headers. */
#ifndef TESTS_LRBNI_SIMDE_FORMS_H
#define TESTS_LRBNI_SIMDE_FORMS_H

#include <simde/x86/avx512/cast.h>
#include <simde/x86/avx512/loadu.h>
#include <simde/x86/avx512/storeu.h>
#include <stdint.h>

/* FN(add, f(simde_mm512_add_ps(F(a), F(b)))): void add(a, b, c, k, out) */
#define FN(name, statement)                                                                                              \
    static void name(const uint32_t a[16], const uint32_t b[16], const uint32_t c[16], uint32_t k, uint32_t out[16])    \
    {                                                                                                                    \
        (void)a, (void)b, (void)c, (void)k;                                                                              \
        statement;                                                                                                       \
    }
#define I(x) simde_mm512_loadu_si512(x)
#define F(x) simde_mm512_castsi512_ps(I(x))
#define PUT_I(x) simde_mm512_storeu_si512(out, x)
#define PUT_F(x) PUT_I(simde_mm512_castps_si512(x))

#endif
