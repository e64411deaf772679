/* Ops whose lanes depend on more than the lanes of two sources: immediates, a mask in or out, other lanes. Each against its
 * reference in all forms that it takes, under all masks, with boundary values and random bits. */
#include "tests/lrbni/case.h"

/* What a case has beside its vectors. */
typedef struct extra {
    uint32_t k;              /* mask that is a source */
    unsigned n, low, high;   /* immediates; the row says which */
} extra;

/* One row of ops.def. Both functions give lanes and a mask; `expect` does so for an op without write-mask. */
typedef struct row {
    const char *id;
    lrb_op_id op;
    unsigned forms; /* set of the s3_forms that it takes */
    unsigned most;  /* the largest n */
    bool wide;
    enum { NO_MASK_OUT, KEEPS_MASK, CLEARS_MASK } out; /* what lanes that are masked off leave in the mask result */
    bool unmasked; /* there is no masked form */
    void (*run)(lrb_ctx *c, const vector_case *v, const extra *x, uint32_t out[16], lrb_k16 *k);
    void (*expect)(const vector_case *v, const extra *x, uint32_t out[16], uint32_t *k);
} row;

typedef struct fixture {
    const row *row;
    lrb_ctx *c;
    base_random random;
} fixture;

enum {
    ALL_FORMS = (1 << S3_FORMS) - 1,
    WHOLE_FORMS = 1 << S3_REGISTER | 1 << S3_FULL,
    GROUP_FORMS = WHOLE_FORMS | 1 << S3_4TO16,
    REGISTER_FORM = 1 << S3_REGISTER
};

/* RUN(slli_pi, pi, NONE, MASK_D, N, ...): what comes before S3 in the plain and in the masked form, and after it; the reference
 * sets lane i */
#define RUN(id, suffix, plain, under_mask, after, reference)                                                      \
    static __attribute__((noinline)) void run_##id(lrb_ctx *c, const vector_case *v, const extra *x, uint32_t out[16], lrb_k16 *k) \
    {                                                                                                          \
        lrb_k16 write = lrb_mask(v->mask);                                                                     \
        (void)x, (void)k, (void)write;                                                                         \
        if (v->form == S3_REGISTER)                                                                            \
            lanes_store_##suffix(out, (v->masked ? under_mask(id, , suffix, case_##suffix(v->b) after)             \
                                                 : lrb_##id(c plain(suffix), case_##suffix(v->b) after)).lanes); \
        else                                                                                                   \
            lanes_store_##suffix(out, (v->masked ? under_mask(id, _s3, suffix, case_s3_##suffix(v) after)          \
                                                 : lrb_##id##_s3(c plain(suffix), case_s3_##suffix(v) after)).lanes); \
    }                                                                                                          \
    static void expect_##id(const vector_case *v, const extra *x, uint32_t out[16], uint32_t *k)               \
    {                                                                                                          \
        (void)x, (void)k;                                                                                      \
        for (int i = 0; i < case_lanes(v->wide); i++)                                                          \
            reference;                                                                                         \
    }

/* Lanes of the case, and what is written to the result. */
#define D_ (uint32_t)case_get(v->d, false, i)
#define A_ (uint32_t)case_get(v->a, false, i)
#define B_ (uint32_t)case_b(v, i)
#define LANE(value) out[i] = (value)
#define SUM(sum)                                 \
    {                                            \
        ref_carry s = sum;                         \
        out[i] = s.value, *k |= (uint32_t)s.bit << i; \
    }

/* Arguments before S3, and after it. */
#define NOTHING
#define NONE(suffix)
#define D(suffix) , case_##suffix(v->d)
#define A(suffix) , case_##suffix(v->a)
#define K_A(suffix) , lrb_mask(x->k), case_##suffix(v->a)
#define D_K(suffix) , case_##suffix(v->d), lrb_mask(x->k)
#define N , x->n
#define FIELD , x->n, x->low, x->high
#define OUT , k
#define MASK_D(id, s3, suffix, ...) lrb_mask_##id##s3(c, case_##suffix(v->d), write, __VA_ARGS__)
#define MASK_D_A(id, s3, suffix, ...) lrb_mask_##id##s3(c, case_##suffix(v->d), write, case_##suffix(v->a), __VA_ARGS__)
#define MASK_D_K(id, s3, suffix, ...) lrb_mask_##id##s3(c, case_##suffix(v->d), write, lrb_mask(x->k), __VA_ARGS__)
#define MASKED_NOT(id, s3, suffix, ...) lrb_##id##s3(c K_A(suffix), __VA_ARGS__)

#define ROW_VI_VX(id) RUN(id, pi, A, MASK_D_A, , LANE(ref_##id(A_, (const uint32_t[4]){group(v, i, 0), group(v, i, 1), group(v, i, 2), group(v, i, 3)})))
#define ROW_VI_VI(id) RUN(id, pi, NONE, MASK_D, N, LANE(ref_##id(B_, x->n)))
#define ROW_VI_VIII(id) RUN(id, pi, NONE, MASK_D, FIELD, LANE(ref_##id(B_, x->n, x->low, x->high)))
#define ROW_VI_VVIII(id) RUN(id, pi, D, MASK_D, FIELD, LANE(ref_##id(D_, B_, x->n, x->low, x->high)))
#define ROW_VIK_VKV(id) RUN(id, pi, D_K, MASK_D_K, OUT, SUM(ref_##id(D_, x->k >> i & 1, B_)))
#define ROW_VIK_V(id) RUN(id, pi, D, MASK_D_K, OUT, SUM(ref_##id(D_, B_)))
#define ROW_VIK_VV(id) RUN(id, pi, A, MASK_D_A, OUT, SUM(ref_##id(A_, B_)))
#define ROW_VI_KVV(id) RUN(id, pi, K_A, MASKED_NOT, , LANE(ref_##id(x->k >> i & 1, A_, B_)))
#define ROW_VQ_KVV(id) \
    RUN(id, pq, K_A, MASKED_NOT, , case_set(out, true, i, ref_##id(x->k >> i & 1, case_get(v->a, true, i), case_b(v, i))))
#define ROW_VI_XI(id) RUN(id, pi, NONE, MASK_D, N, LANE((uint32_t)case_b(v, ref_##id(i, x->n))))
#define ROW_V_XI(id) RUN(id, ps, NONE, MASK_D, N, LANE((uint32_t)case_b(v, ref_##id(i, x->n))))
#define ROW_VI_XX(id) RUN(id, pi, A, MASK_D_A, , LANE((uint32_t)case_b(v, ref_##id(i, A_))))
#define ROW_VI_XXI(id) RUN(id, pi, A, MASK_D_A, N, LANE(from_both(v, ref_##id(i, x->n))))
/* The source of this one is no S3. */
#define ROW_VI_XII(id)                                                                                         \
    static __attribute__((noinline)) void run_##id(lrb_ctx *c, const vector_case *v, const extra *x, uint32_t out[16], lrb_k16 *k) \
    {                                                                                                          \
        (void)k;                                                                                               \
        lrb_v16i a = case_pi(v->a);                                                                            \
        lanes_store_pi(out, (v->masked ? lrb_mask_##id(c, case_pi(v->d), lrb_mask(v->mask), a, x->n, x->low * 8) \
                                       : lrb_##id(c, a, x->n, x->low * 8)).lanes);                             \
    }                                                                                                          \
    static void expect_##id(const vector_case *v, const extra *x, uint32_t out[16], uint32_t *k)               \
    {                                                                                                          \
        (void)k;                                                                                               \
        for (int i = 0; i < 16; i++)                                                                           \
            out[i] = v->a[ref_##id(i, x->n, x->low * 8)];                                                      \
    }

/* Element j of the group of four that lane i belongs to, in S3. */
static uint32_t group(const vector_case *v, int i, int j) { return (uint32_t)case_b(v, i / 4 * 4 + j); }

/* Lane of S3, or from 16 on of a. */
static uint32_t from_both(const vector_case *v, int lane) { return lane < 16 ? (uint32_t)case_b(v, lane) : v->a[lane - 16]; }

#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_adc_pi, expect_adc_pi */
#include "lrbni/ops.def"

/* Lanes and mask that the op must leave, under the case's write-mask. */
static void merge(const row *r, const vector_case *v, const extra *x, uint32_t lanes[16], uint32_t *k)
{
    uint32_t bits = 0;
    r->expect(v, x, lanes, &bits);
    *k = 0;
    for (int i = 0; i < 16; i++) {
        if (!case_live(v, v->wide ? i / 2 : i))
            lanes[i] = v->d[i];
        bool kept = r->out == KEEPS_MASK && (x->k >> i & 1);
        *k |= (uint32_t)(case_live(v, i) ? bits >> i & 1 : kept) << i;
    }
}

static void check(void *user, const vector_case *given)
{
    fixture *f = user;
    const row *r = f->row;
    vector_case v = *given;
    if (!(r->forms >> v.form & 1))
        return;
    v.masked = v.masked && !r->unmasked;
    extra x = {.k = (uint32_t)base_random_bits(&f->random) & 0xffff};
    uint64_t bits = base_random_bits(&f->random);
    x.n = (unsigned)(bits >> 32) % ((bits & 1 && r->most > 31 ? 39 : r->most) + 1);
    x.low = (unsigned)(bits >> 8) % 32;
    x.high = x.low + (unsigned)(bits >> 16) % (32 - x.low);
    uint32_t out[16], lanes[16] = {0}, k;
    lrb_k16 got = lrb_mask(0);
    lrb_ctx_begin(f->c);
    r->run(f->c, &v, &x, out, &got);
    merge(r, &v, &x, lanes, &k);
    for (int i = 0; i < 16; i++)
        if (out[i] != lanes[i])
            fail_msg("%s word %d, mask %04x%s, form %d, k %04x, n %u, field %u to %u: d %08x a %08x b %08x: got %08x, expected %08x",
                     r->id, i, v.mask, v.masked ? "" : " (unused)", v.form, x.k, x.n, x.low, x.high, v.d[i], v.a[i], v.b[i], out[i],
                     lanes[i]);
    if (r->out != NO_MASK_OUT && got.bits != k)
        fail_msg("%s mask %04x%s, form %d, k %04x: got %04x, expected %04x", r->id, v.mask, v.masked ? "" : " (unused)", v.form, x.k,
                 got.bits, k);
    case_check_event(f->c, r->op, &v);
}

static void boundary_values(void **state)
{
    fixture *f = *state;
    base_random random = {.state = 6};
    case_all_pairs(f->row->wide, &random, check, f);
}

static void boundary_destinations(void **state)
{
    fixture *f = *state;
    base_random random = {.state = 7};
    case_all_triples(f->row->wide, &random, check, f);
}

static void random_values(void **state)
{
    fixture *f = *state;
    base_random random = {.state = 8};
    case_random(60000, f->row->wide, &random, check, f);
}

/* The destination and the mask may be sources and results of one statement. */
static void carries__in_place__as_apart(void **state)
{
    fixture *f = *state;
    const uint32_t ones[16] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX, 0, 0, 0, 0, 1};
    lrb_v16i v = case_pi(ones);
    lrb_k16 k = lrb_mask(0x0033);
    uint32_t lanes[16];
    lrb_ctx_begin(f->c);
    v = lrb_adc_pi(f->c, v, k, v, &k);
    lanes_store_pi(lanes, v.lanes);
    assert_int_equal(k.bits, 0x000f);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lanes[i], 2 * ones[i] + (0x0033 >> i & 1));
}

#undef RUN
#undef ROW_VI_VX
#undef ROW_VI_VI
#undef ROW_VI_VIII
#undef ROW_VI_VVIII
#undef ROW_VIK_VKV
#undef ROW_VIK_V
#undef ROW_VIK_VV
#undef ROW_VI_KVV
#undef ROW_VQ_KVV
#undef ROW_VI_XII
#undef ROW_VI_XI
#undef ROW_V_XI
#undef ROW_VI_XX
#undef ROW_VI_XXI
#define ENTRY(id, forms, most, wide, out, unmasked) {#id, LRB_OP_##id, forms, most, wide, out, unmasked, run_##id, expect_##id},
#define ROW_VI_VX(id) ENTRY(id, GROUP_FORMS, 0, false, NO_MASK_OUT, false)
#define ROW_VI_VI(id) ENTRY(id, ALL_FORMS, 255, false, NO_MASK_OUT, false)
#define ROW_VI_VIII(id) ENTRY(id, ALL_FORMS, 31, false, NO_MASK_OUT, false)
#define ROW_VI_VVIII(id) ENTRY(id, ALL_FORMS, 31, false, NO_MASK_OUT, false)
#define ROW_VIK_VKV(id) ENTRY(id, ALL_FORMS, 0, false, KEEPS_MASK, false)
#define ROW_VIK_V(id) ENTRY(id, ALL_FORMS, 0, false, KEEPS_MASK, false)
#define ROW_VIK_VV(id) ENTRY(id, ALL_FORMS, 0, false, CLEARS_MASK, false)
#define ROW_VI_KVV(id) ENTRY(id, ALL_FORMS, 0, false, NO_MASK_OUT, true)
#define ROW_VQ_KVV(id) ENTRY(id, ALL_FORMS, 0, true, NO_MASK_OUT, true)
#define ROW_VI_XII(id) ENTRY(id, REGISTER_FORM, 255, false, NO_MASK_OUT, false)
#define ROW_VI_XI(id) ENTRY(id, WHOLE_FORMS, 255, false, NO_MASK_OUT, false)
#define ROW_V_XI(id) ENTRY(id, WHOLE_FORMS, 255, false, NO_MASK_OUT, false)
#define ROW_VI_XX(id) ENTRY(id, WHOLE_FORMS, 0, false, NO_MASK_OUT, false)
#define ROW_VI_XXI(id) ENTRY(id, WHOLE_FORMS, 15, false, NO_MASK_OUT, false)
static const row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"adc_pi", LRB_OP_adc_pi, ...}, */
#include "lrbni/ops.def"
};
enum { ROWS = sizeof rows / sizeof rows[0], KINDS = 3 };

int main(void)
{
    static const struct {
        CMUnitTestFunction function;
        const char *name;
    } kinds[KINDS] = {{boundary_values, "boundary_values"}, {boundary_destinations, "boundary_destinations"}, {random_values, "random_bits"}};
    static fixture fixtures[ROWS];
    static char names[KINDS * ROWS][64];
    struct CMUnitTest tests[KINDS * ROWS + 1];
    void *c = NULL;
    if (case_setup(&c) != 0)
        return 1;
    for (int i = 0; i < ROWS; i++) {
        fixtures[i] = (fixture){.row = &rows[i], .c = c, .random = {.state = 9}};
        for (int kind = 0; kind < KINDS; kind++) {
            snprintf(names[KINDS * i + kind], sizeof names[0], "%s__%s__as_oracle", rows[i].id, kinds[kind].name);
            tests[KINDS * i + kind] = (struct CMUnitTest){names[KINDS * i + kind], kinds[kind].function, NULL, NULL, &fixtures[i]};
        }
    }
    tests[KINDS * ROWS] = (struct CMUnitTest){"carries__in_place__as_apart", carries__in_place__as_apart, NULL, NULL, &fixtures[0]};
    int failed = _cmocka_run_group_tests("integer " LRB_BACKEND, tests, KINDS * ROWS + 1, NULL, NULL);
    case_teardown(&c);
    return failed;
}
