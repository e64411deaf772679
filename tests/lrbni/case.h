/* What tests of vector ops share: one op's operands in every form that it takes, and the event that it must leave.
 * Compiled for one back end at LRB_RECORD. */
#ifndef TESTS_LRBNI_CASE_H
#define TESTS_LRBNI_CASE_H

#include <setjmp.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define LRB_SOURCE 1
#include "lrbni/lrbni.h"
#include "tests/lrbni/operands.h"
#include "tests/lrbni/oracle.h"

/* How the last source is given. */
typedef enum s3_form {
    S3_REGISTER,
    S3_SWIZZLE, /* and the seven after it */
    S3_FULL = S3_SWIZZLE + 8,
    S3_1TO16, /* {1to8} of 64-bit lanes */
    S3_4TO16, /* {4to8} */
    S3_FORMS
} s3_form;

/* One application of one op to 16 lanes of 32 bits or, if `wide`, 8 of 64; floats as bits. */
typedef struct vector_case {
    alignas(64) uint32_t b[16];
    uint32_t d[16], a[16];
    bool wide;
    bool masked;
    uint32_t mask;
    s3_form form;
    int word; /* lane of b that {1to16} reads; its group of four is what {4to16} reads */
} vector_case;

enum { CASE_ADDRESS = 0x3000 }; /* simulated address of b */

static inline int case_lanes(bool wide) { return wide ? 8 : 16; }

/** A lane of a register, and the setting of one. */
static inline uint64_t case_get(const uint32_t words[16], bool wide, int lane)
{
    return wide ? words[2 * lane] | (uint64_t)words[2 * lane + 1] << 32 : words[lane];
}

static inline void case_set(uint32_t words[16], bool wide, int lane, uint64_t bits)
{
    words[wide ? 2 * lane : lane] = (uint32_t)bits;
    if (wide)
        words[2 * lane + 1] = (uint32_t)(bits >> 32);
}

/** Whether the op writes that lane. */
static inline bool case_live(const vector_case *v, int lane)
{
    return !v->masked || (v->mask >> lane & 1);
}

/* Offset in b of the first byte that the form reads. */
static inline int32_t case_offset(const vector_case *v)
{
    int32_t bytes = v->wide ? 8 : 4;
    return v->form == S3_1TO16 ? bytes * v->word : v->form == S3_4TO16 ? bytes * (v->word & ~3) : 0;
}

static inline lrb_mem case_memory(const vector_case *v)
{
    lrb_segment segment = {.host = (unsigned char *)v->b, .address = CASE_ADDRESS, .size = sizeof v->b};
    return lrb_at(lrb_segment_at(segment, 0), case_offset(v));
}

/* CASE_OPERANDS(ps, lrb_v16f, lrb_s3f, 1to16, 4to16): case_ps, a register; case_s3_ps, the last source as the case has it. The
 * swizzles are written out, so that they are constants as in kernels; nothing is inlined, which would be done for every op. */
#define CASE_OPERANDS(suffix, vector, s3, one, four)                                             \
    static inline vector case_##suffix(const uint32_t words[16])                                 \
    {                                                                                            \
        vector v = {.lanes = lanes_load_##suffix(words)};                                        \
        return v;                                                                                \
    }                                                                                            \
    static __attribute__((noinline, unused)) s3 case_s3_##suffix(const vector_case *v)           \
    {                                                                                            \
        vector b = case_##suffix(v->b);                                                          \
        switch ((int)v->form) {                                                                  \
        case S3_SWIZZLE: return lrb_swizzle_##suffix(b, LRB_DCBA);                               \
        case S3_SWIZZLE + 1: return lrb_swizzle_##suffix(b, LRB_CDAB);                           \
        case S3_SWIZZLE + 2: return lrb_swizzle_##suffix(b, LRB_BADC);                           \
        case S3_SWIZZLE + 3: return lrb_swizzle_##suffix(b, LRB_AAAA);                           \
        case S3_SWIZZLE + 4: return lrb_swizzle_##suffix(b, LRB_BBBB);                           \
        case S3_SWIZZLE + 5: return lrb_swizzle_##suffix(b, LRB_CCCC);                           \
        case S3_SWIZZLE + 6: return lrb_swizzle_##suffix(b, LRB_DDDD);                           \
        case S3_SWIZZLE + 7: return lrb_swizzle_##suffix(b, LRB_DACB);                           \
        case S3_FULL: return lrb_full_##suffix(case_memory(v));                                  \
        case S3_1TO16: return lrb_##one##_##suffix(case_memory(v));                              \
        case S3_4TO16: return lrb_##four##_##suffix(case_memory(v));                             \
        default: return lrb_reg_##suffix(b);                                                     \
        }                                                                                        \
    }
CASE_OPERANDS(ps, lrb_v16f, lrb_s3f, 1to16, 4to16)
CASE_OPERANDS(pi, lrb_v16i, lrb_s3i, 1to16, 4to16)
CASE_OPERANDS(pd, lrb_v8d, lrb_s3d, 1to8, 4to8)
CASE_OPERANDS(pq, lrb_v8q, lrb_s3q, 1to8, 4to8)
#undef CASE_OPERANDS

/* What the last source is in that lane, by isa-facts 2.6 and 2.8. */
static inline uint64_t case_b(const vector_case *v, int lane)
{
    if (v->form >= S3_SWIZZLE && v->form < S3_FULL)
        lane = lane / 4 * 4 + ref_swizzles[v->form - S3_SWIZZLE][lane % 4];
    else if (v->form == S3_1TO16)
        lane = v->word;
    else if (v->form == S3_4TO16)
        lane = v->word / 4 * 4 + lane % 4;
    return case_get(v->b, v->wide, lane);
}

/** The 32-bit words that an op under the case's mask writes. */
static inline uint32_t case_words(const vector_case *v)
{
    uint32_t words = 0;
    for (int i = 0; i < 16; i++)
        words |= (uint32_t)case_live(v, v->wide ? i / 2 : i) << i;
    return words;
}

/* The bits of an event's op that say how the last source was given. */
static inline unsigned case_form_bits(const vector_case *v)
{
    static const unsigned read[2][S3_FORMS - S3_FULL] = {{0, LRB_FORM_4_BYTES, LRB_FORM_16_BYTES},
                                                         {0, LRB_FORM_8_BYTES, LRB_FORM_32_BYTES}};
    return v->form >= S3_FULL ? LRB_FORM_MEMORY | read[v->wide][v->form - S3_FULL]
                              : v->form >= S3_SWIZZLE ? LRB_FORM_SWIZZLE : 0;
}

/* The op left one event that names it, its form, the words that it writes and its address, and no sources. */
static __attribute__((unused)) void case_check_words(const lrb_ctx *c, unsigned op, const vector_case *v, unsigned bits,
                                                     uint32_t words)
{
    const lrb_event *e = &c->events[0];
    uint32_t address = v->form >= S3_FULL ? CASE_ADDRESS + (uint32_t)case_offset(v) : 0;
    if (c->next_event != LRB_FAR + 1 || e->op != (op | bits) || e->mask != words || e->aux != address || e->src[0] ||
        e->src[1] || e->src[2] || e->src[3])
        fail_msg("%s: %u events, op %04x mask %04x aux %x src %u %u %u %u; form %d", lrb_op_table[op].id,
                 c->next_event - LRB_FAR, e->op, e->mask, e->aux, e->src[0], e->src[1], e->src[2], e->src[3], v->form);
}

/* The same for an op whose result has the lanes of its sources. */
static inline void case_check_event(const lrb_ctx *c, unsigned op, const vector_case *v)
{
    case_check_words(c, op, v, case_form_bits(v), case_words(v));
}

/* Fill vectors, and call back for every form and mask, or for random ones. */
typedef void case_fn(void *user, const vector_case *v);

/** The vector unmasked and under every mask, in every form. */
static __attribute__((unused)) void case_every_form(vector_case *v, base_random *random, case_fn *fn, void *user)
{
    for (int form = 0; form < S3_FORMS; form++)
        for (int mask = -1; mask < MASKS; mask++) {
            v->form = (s3_form)form;
            v->masked = mask >= 0;
            v->mask = mask < 0 ? 0 : mask_number(mask, random);
            v->word = (int)(base_random_bits(random) % (unsigned)case_lanes(v->wide));
            fn(user, v);
        }
}

/** `count` vectors of random bits, each in one random form under one random mask. */
static __attribute__((unused)) void case_random(int count, bool wide, base_random *random, case_fn *fn, void *user)
{
    vector_case v = {.wide = wide};
    for (int n = 0; n < count; n++) {
        for (int i = 0; i < case_lanes(wide); i++) {
            case_set(v.d, wide, i, random_lane(wide, random));
            case_set(v.a, wide, i, random_lane(wide, random));
            case_set(v.b, wide, i, random_lane(wide, random));
        }
        v.form = (s3_form)(base_random_bits(random) % S3_FORMS);
        v.masked = base_random_bits(random) & 1;
        v.mask = mask_number((int)(base_random_bits(random) % MASKS), random);
        v.word = (int)(base_random_bits(random) % (unsigned)case_lanes(wide));
        fn(user, &v);
    }
}

/** All pairs of boundary bits in a and b; d holds a poison that no op makes. */
static __attribute__((unused)) void case_all_pairs(bool wide, base_random *random, case_fn *fn, void *user)
{
    vector_case v = {.wide = wide};
    const int lanes = case_lanes(wide);
    for (int first = 0; first < BOUNDARY_BITS * BOUNDARY_BITS; first += lanes) {
        for (int i = 0; i < lanes; i++) {
            int pair = (first + i) % (BOUNDARY_BITS * BOUNDARY_BITS);
            case_set(v.a, wide, i, boundary_lane(wide, pair / BOUNDARY_BITS));
            case_set(v.b, wide, i, boundary_lane(wide, pair % BOUNDARY_BITS));
            case_set(v.d, wide, i, (wide ? 0x7ff5c30000000000u : 0x7fa5c300u) + (uint64_t)i);
        }
        case_every_form(&v, random, fn, user);
    }
}

/** All triples of the shorter list. */
static __attribute__((unused)) void case_all_triples(bool wide, base_random *random, case_fn *fn, void *user)
{
    enum { ALL = TRIPLE_BITS * TRIPLE_BITS * TRIPLE_BITS };
    vector_case v = {.wide = wide};
    const int lanes = case_lanes(wide);
    for (int first = 0; first < ALL; first += lanes) {
        for (int i = 0; i < lanes; i++) {
            int triple = (first + i) % ALL;
            case_set(v.d, wide, i, triple_lane(wide, triple / (TRIPLE_BITS * TRIPLE_BITS)));
            case_set(v.a, wide, i, triple_lane(wide, triple / TRIPLE_BITS % TRIPLE_BITS));
            case_set(v.b, wide, i, triple_lane(wide, triple % TRIPLE_BITS));
        }
        case_every_form(&v, random, fn, user);
    }
}

/** Context and first random state of a test program; run by group set-up and tear-down. */
static inline int case_setup(void **state)
{
    lrb_ctx *c = NULL;
    if (lrb_ctx_create(NULL, NULL, &c, NULL) != BASE_OK)
        return -1;
    *state = c;
    return 0;
}

static inline int case_teardown(void **state)
{
    lrb_ctx *c = *state;
    lrb_ctx_destroy(&c);
    return 0;
}

#endif
