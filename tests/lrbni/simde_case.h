/* What comparisons with SIMDe share: random operands, and the loop that puts them through an op and through SIMDe. */
#ifndef TESTS_LRBNI_SIMDE_CASE_H
#define TESTS_LRBNI_SIMDE_CASE_H

#include "tests/lrbni/case.h"

enum { VECTORS = 65536 + 64 }; /* of 16 lanes: 1,049,600 */

/* Operands of one comparison. */
typedef struct operands {
    uint32_t a[16], b[16], c[16];
} operands;

static inline void draw(operands *o, base_random *random, bool exact_product)
{
    for (int i = 0; i < 16; i++) {
        o->a[i] = random_bits(random);
        o->b[i] = random_bits(random);
        o->c[i] = random_bits(random);
        if (exact_product) { /* mantissas of 12 bits; exponents from -31 to 32 */
            o->a[i] = (o->a[i] & 0x81fff000) + 0x30000000;
            o->b[i] = (o->b[i] & 0x81fff000) + 0x30000000;
        }
    }
}

static inline void compare(const char *name, const operands *o, const uint32_t got[16], const uint32_t theirs[16], bool any_nan)
{
    for (int i = 0; i < 16; i++)
        if (got[i] != theirs[i] && !(any_nan && ref_is_nan(got[i]) && ref_is_nan(theirs[i])))
            fail_msg("%s: a %08x b %08x c %08x: got %08x, SIMDe gives %08x", name, o->a[i], o->b[i], o->c[i], got[i], theirs[i]);
}

/* SAME(ps, add, lrb_add_ps(c, a, b), any_nan, exact): VECTORS vectors through the op and through SIMDe's function */
#define SAME(suffix, name, op, any_nan, exact)                                                          \
    for (int n = 0; n < VECTORS; n++) {                                                                 \
        operands o;                                                                                     \
        uint32_t got[16], theirs[16];                                                                   \
        draw(&o, &random, exact);                                                                       \
        uint32_t k = (uint32_t)base_random_bits(&random) & 0xffffu;                                     \
        lrb_v16f a = case_ps(o.a), b = case_ps(o.b), d = case_ps(o.c);                                  \
        lrb_v16i ai = case_pi(o.a), bi = case_pi(o.b);                                                  \
        (void)k, (void)a, (void)b, (void)d, (void)ai, (void)bi;                                         \
        lanes_store_##suffix(got, (op).lanes);                                                          \
        s->name(o.a, o.b, o.c, k, theirs);                                                              \
        compare(#name, &o, got, theirs, any_nan);                                                       \
    }

#endif
