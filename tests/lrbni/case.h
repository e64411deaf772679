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
    S3_1TO16,
    S3_4TO16,
    S3_FORMS
} s3_form;

/* One application of one op to 16 lanes; floats as bits. */
typedef struct vector_case {
    alignas(64) uint32_t b[16];
    uint32_t d[16], a[16];
    bool masked;
    uint32_t mask;
    s3_form form;
    int word; /* of b that {1to16} reads; its group of four is what {4to16} reads */
} vector_case;

enum { CASE_ADDRESS = 0x3000 }; /* simulated address of b */

static inline lrb_v16i case_pi(const uint32_t lanes[16])
{
    lrb_v16i v = {.lanes = lanes_load_pi(lanes)};
    return v;
}

static inline lrb_v16f case_ps(const uint32_t lanes[16])
{
    lrb_v16f v = {.lanes = lanes_load_ps(lanes)};
    return v;
}

/* Offset in b of the first byte that the form reads. */
static inline int32_t case_offset(const vector_case *v)
{
    return v->form == S3_1TO16 ? 4 * v->word : v->form == S3_4TO16 ? 4 * (v->word & 12) : 0;
}

static inline lrb_mem case_memory(const vector_case *v)
{
    lrb_segment segment = {.host = (unsigned char *)v->b, .address = CASE_ADDRESS, .size = sizeof v->b};
    return lrb_at(lrb_segment_at(segment, 0), case_offset(v));
}

/* The swizzles are written out, so that they are constants as in kernels. */
static inline lrb_s3f case_s3_ps(const vector_case *v)
{
    lrb_v16f b = case_ps(v->b);
    switch ((int)v->form) {
    case S3_SWIZZLE: return lrb_swizzle_ps(b, LRB_DCBA);
    case S3_SWIZZLE + 1: return lrb_swizzle_ps(b, LRB_CDAB);
    case S3_SWIZZLE + 2: return lrb_swizzle_ps(b, LRB_BADC);
    case S3_SWIZZLE + 3: return lrb_swizzle_ps(b, LRB_AAAA);
    case S3_SWIZZLE + 4: return lrb_swizzle_ps(b, LRB_BBBB);
    case S3_SWIZZLE + 5: return lrb_swizzle_ps(b, LRB_CCCC);
    case S3_SWIZZLE + 6: return lrb_swizzle_ps(b, LRB_DDDD);
    case S3_SWIZZLE + 7: return lrb_swizzle_ps(b, LRB_DACB);
    case S3_FULL: return lrb_full_ps(case_memory(v));
    case S3_1TO16: return lrb_1to16_ps(case_memory(v));
    case S3_4TO16: return lrb_4to16_ps(case_memory(v));
    default: return lrb_reg_ps(b);
    }
}

static inline lrb_s3i case_s3_pi(const vector_case *v)
{
    switch ((int)v->form) {
    case S3_FULL: return lrb_full_pi(case_memory(v));
    case S3_1TO16: return lrb_1to16_pi(case_memory(v));
    case S3_4TO16: return lrb_4to16_pi(case_memory(v));
    default: return lrb_reg_pi(case_pi(v->b));
    }
}

/* What the last source is in that lane, by isa-facts 2.6 and 2.8. */
static inline uint32_t case_b(const vector_case *v, int lane)
{
    if (v->form >= S3_SWIZZLE && v->form < S3_FULL)
        return v->b[lane / 4 * 4 + ref_swizzles[v->form - S3_SWIZZLE][lane % 4]];
    if (v->form == S3_1TO16)
        return v->b[v->word];
    return v->form == S3_4TO16 ? v->b[v->word / 4 * 4 + lane % 4] : v->b[lane];
}

/* The op left one event that names it, its form, its mask and its address, and no sources. */
static inline void case_check_event(const lrb_ctx *c, unsigned op, const vector_case *v)
{
    static const unsigned form_bits[S3_FORMS - S3_FULL] = {
        LRB_FORM_MEMORY, LRB_FORM_MEMORY | LRB_FORM_4_BYTES, LRB_FORM_MEMORY | LRB_FORM_16_BYTES};
    const lrb_event *e = &c->events[0];
    unsigned bits = v->form >= S3_FULL ? form_bits[v->form - S3_FULL] : v->form >= S3_SWIZZLE ? LRB_FORM_SWIZZLE : 0;
    uint32_t address = v->form >= S3_FULL ? CASE_ADDRESS + (uint32_t)case_offset(v) : 0;
    if (c->next_event != LRB_FAR + 1 || e->op != (op | bits) || e->mask != (v->masked ? v->mask : 0xffff) || e->aux != address ||
        e->src[0] || e->src[1] || e->src[2] || e->src[3])
        fail_msg("%s: %u events, op %04x mask %04x aux %x src %u %u %u %u; form %d", lrb_op_table[op].id,
                 c->next_event - LRB_FAR, e->op, e->mask, e->aux, e->src[0], e->src[1], e->src[2], e->src[3], v->form);
}

/* Fill vectors, and call back for every form and mask, or for random ones. */
typedef void case_fn(void *user, const vector_case *v);

/** Number of a vector's last form plus 1: integer sources have no swizzles here. */
static inline bool case_has_form(bool integer, int form)
{
    return !integer || form < S3_SWIZZLE || form >= S3_FULL;
}

/** The vector unmasked and under every mask, in every form that the op takes. */
static inline void case_every_form(vector_case *v, bool integer, base_random *random, case_fn *fn, void *user)
{
    for (int form = 0; form < S3_FORMS; form++)
        for (int mask = -1; mask < MASKS && case_has_form(integer, form); mask++) {
            v->form = (s3_form)form;
            v->masked = mask >= 0;
            v->mask = mask < 0 ? 0 : mask_number(mask, random);
            v->word = (int)(base_random_bits(random) % 16);
            fn(user, v);
        }
}

/** `count` vectors of random bits, each in one random form under one random mask. */
static inline void case_random(int count, bool integer, base_random *random, case_fn *fn, void *user)
{
    vector_case v;
    for (int n = 0; n < count; n++) {
        for (int i = 0; i < 16; i++) {
            v.d[i] = random_bits(random);
            v.a[i] = random_bits(random);
            v.b[i] = random_bits(random);
        }
        do
            v.form = (s3_form)(base_random_bits(random) % S3_FORMS);
        while (!case_has_form(integer, v.form));
        v.masked = base_random_bits(random) & 1;
        v.mask = mask_number((int)(base_random_bits(random) % MASKS), random);
        v.word = (int)(base_random_bits(random) % 16);
        fn(user, &v);
    }
}

/** All pairs of boundary bits in a and b; d holds a poison that no op makes. */
static inline void case_all_pairs(bool integer, base_random *random, case_fn *fn, void *user)
{
    vector_case v;
    for (int first = 0; first < BOUNDARY_BITS * BOUNDARY_BITS; first += 16) {
        for (int i = 0; i < 16; i++) {
            int pair = (first + i) % (BOUNDARY_BITS * BOUNDARY_BITS);
            v.a[i] = boundary_bits[pair / BOUNDARY_BITS];
            v.b[i] = boundary_bits[pair % BOUNDARY_BITS];
            v.d[i] = 0x7fa5c300u + (uint32_t)i;
        }
        case_every_form(&v, integer, random, fn, user);
    }
}

/** All triples of the shorter list. */
static inline void case_all_triples(base_random *random, case_fn *fn, void *user)
{
    enum { ALL = TRIPLE_BITS * TRIPLE_BITS * TRIPLE_BITS };
    vector_case v;
    for (int first = 0; first < ALL; first += 16) {
        for (int i = 0; i < 16; i++) {
            int triple = (first + i) % ALL;
            v.d[i] = triple_bits[triple / (TRIPLE_BITS * TRIPLE_BITS)];
            v.a[i] = triple_bits[triple / TRIPLE_BITS % TRIPLE_BITS];
            v.b[i] = triple_bits[triple % TRIPLE_BITS];
        }
        case_every_form(&v, false, random, fn, user);
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
