/* Every op between vector registers against its reference: all forms, all masks, boundary values and random bits. */
#include <inttypes.h>

#include "tests/lrbni/case.h"

/* One row of ops.def: the op in the forms that the case asks for, and its reference. */
typedef struct row {
    const char *id;
    lrb_op_id op;
    bool wide, ternary;
    void (*run)(lrb_ctx *c, const vector_case *v, uint32_t out[16]);
    uint64_t (*ref)(uint64_t d, uint64_t a, uint64_t b);
    lrb_ctx *c;
} row;

/* RUN(add_ps, ps, SOURCE(ps), NOTHING, ref_add_ps(a, b)): the plain and masked register form, and the plain and masked S3 form */
#define RUN(id, suffix, sources, before, result)                                                               \
    static __attribute__((noinline)) void run_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16])         \
    {                                                                                                          \
        lrb_k16 k = lrb_mask(v->mask);                                                                         \
        if (v->form == S3_REGISTER)                                                                            \
            lanes_store_##suffix(out, (v->masked ? lrb_mask_##id(c, case_##suffix(v->d), k sources, case_##suffix(v->b)) \
                                                 : lrb_##id(c before sources, case_##suffix(v->b))).lanes);    \
        else                                                                                                   \
            lanes_store_##suffix(out, (v->masked ? lrb_mask_##id##_s3(c, case_##suffix(v->d), k sources, case_s3_##suffix(v)) \
                                                 : lrb_##id##_s3(c before sources, case_s3_##suffix(v))).lanes); \
    }                                                                                                          \
    static uint64_t ref3_##id(uint64_t d, uint64_t a, uint64_t b)                                              \
    {                                                                                                          \
        (void)d, (void)a;                                                                                      \
        return result;                                                                                         \
    }
#define SOURCE(suffix) , case_##suffix(v->a)
#define OLD(suffix) , case_##suffix(v->d)
#define NOTHING

#define NARROW(bits) ((uint32_t)(bits))
#define UNARY(id, suffix, lane) RUN(id, suffix, NOTHING, NOTHING, ref_##id(lane(b)))
#define BINARY(id, suffix, lane) RUN(id, suffix, SOURCE(suffix), NOTHING, ref_##id(lane(a), lane(b)))
#define TERNARY(id, suffix, lane) RUN(id, suffix, SOURCE(suffix), OLD(suffix), ref_##id(lane(d), lane(a), lane(b)))
#define ROW_V_V(id) UNARY(id, ps, NARROW)
#define ROW_V_VV(id) BINARY(id, ps, NARROW)
#define ROW_V_VVV(id) TERNARY(id, ps, NARROW)
#define ROW_VI_V(id) UNARY(id, pi, NARROW)
#define ROW_VI_VV(id) BINARY(id, pi, NARROW)
#define ROW_VI_VVV(id) TERNARY(id, pi, NARROW)
#define ROW_VQ_V(id) UNARY(id, pq, )
#define ROW_VQ_VV(id) BINARY(id, pq, )
#define ROW_VD_V(id) UNARY(id, pd, )
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_add_ps, ref3_add_ps */
#include "lrbni/ops.def"

static void check(void *user, const vector_case *v)
{
    const row *r = user;
    uint32_t out[16];
    lrb_ctx_begin(r->c);
    r->run(r->c, v, out);
    for (int i = 0; i < case_lanes(v->wide); i++) {
        uint64_t d = case_get(v->d, v->wide, i), a = case_get(v->a, v->wide, i), b = case_b(v, i);
        uint64_t got = case_get(out, v->wide, i), expected = case_live(v, i) ? r->ref(d, a, b) : d;
        if (got != expected)
            fail_msg("%s lane %d, mask %04x%s, form %d: d %08" PRIx64 " a %08" PRIx64 " b %08" PRIx64 ": got %08" PRIx64
                     ", expected %08" PRIx64, r->id, i, v->mask, v->masked ? "" : " (unused)", v->form, d, a, b, got, expected);
    }
    case_check_event(r->c, r->op, v);
}

static void boundary_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 1};
    if (r->ternary)
        case_all_triples(r->wide, &random, check, r);
    else
        case_all_pairs(r->wide, &random, check, r);
}

static void random_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 2};
    case_random(20000, r->wide, &random, check, r);
}

/* The permute has immediates in place of a second source: every block choice with every word choice. */
static void shuf128x32_ps__every_immediate__as_oracle(void **state)
{
    const row *r = *state;
    vector_case v = {.form = S3_REGISTER};
    base_random random = {.state = 3};
    for (unsigned blocks = 0; blocks < 256; blocks++)
        for (unsigned words = 0; words < 256; words++) {
            for (int i = 0; i < 16; i++)
                v.d[i] = random_bits(&random), v.a[i] = random_bits(&random);
            v.masked = words % 3 == 0;
            v.mask = mask_number((int)(blocks % MASKS), &random);
            uint32_t out[16];
            lrb_ctx_begin(r->c);
            lrb_v16f a = case_ps(v.a);
            lanes_store_ps(out, (v.masked ? lrb_mask_shuf128x32_ps(r->c, case_ps(v.d), lrb_mask(v.mask), a, blocks, words)
                                          : lrb_shuf128x32_ps(r->c, a, blocks, words)).lanes);
            for (int i = 0; i < 16; i++) {
                uint32_t expected = case_live(&v, i) ? v.a[ref_shuf128x32_ps(i, blocks, words)] : v.d[i];
                if (out[i] != expected)
                    fail_msg("lane %d, blocks %02x, words %02x, mask %04x: got %08x, expected %08x", i, blocks, words, v.mask,
                             out[i], expected);
            }
            case_check_event(r->c, LRB_OP_shuf128x32_ps, &v);
        }
}

/* The rows that are served here. */
#undef UNARY
#undef BINARY
#undef TERNARY
#define UNARY(id, suffix, lane) ENTRY(id, sizeof lane(UINT64_C(0)) == 8, false)
#define BINARY(id, suffix, lane) ENTRY(id, sizeof lane(UINT64_C(0)) == 8, false)
#define TERNARY(id, suffix, lane) ENTRY(id, sizeof lane(UINT64_C(0)) == 8, true)
#define ENTRY(id, wide, ternary) {#id, LRB_OP_##id, wide, ternary, run_##id, ref3_##id, NULL},
static const row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"add_ps", LRB_OP_add_ps, ...}, */
#include "lrbni/ops.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

int main(void)
{
    static row with_context[ROWS];
    static char names[2 * ROWS][64];
    struct CMUnitTest tests[2 * ROWS + 1];
    void *c = NULL;
    if (case_setup(&c) != 0)
        return 1;
    for (int i = 0; i < ROWS; i++) {
        with_context[i] = rows[i];
        with_context[i].c = c;
        snprintf(names[2 * i], sizeof names[0], "%s__boundary_values__as_oracle", rows[i].id);
        snprintf(names[2 * i + 1], sizeof names[0], "%s__random_bits__as_oracle", rows[i].id);
        tests[2 * i] = (struct CMUnitTest){names[2 * i], boundary_values, NULL, NULL, &with_context[i]};
        tests[2 * i + 1] = (struct CMUnitTest){names[2 * i + 1], random_values, NULL, NULL, &with_context[i]};
    }
    tests[2 * ROWS] = (struct CMUnitTest){"shuf128x32_ps__every_immediate__as_oracle", shuf128x32_ps__every_immediate__as_oracle,
                                          NULL, NULL, &with_context[0]};
    int failed = _cmocka_run_group_tests("arith " LRB_BACKEND, tests, 2 * ROWS + 1, NULL, NULL);
    case_teardown(&c);
    return failed;
}
