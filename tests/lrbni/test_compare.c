/* Every compare against its reference: all forms, all masks, boundary values and random bits. */
#include <inttypes.h>

#include "tests/lrbni/case.h"

typedef struct row {
    const char *id;
    lrb_op_id op;
    bool wide;
    lrb_k16 (*run)(lrb_ctx *c, const vector_case *v);
    bool (*ref)(uint64_t a, uint64_t b);
    lrb_ctx *c;
} row;

/* RUN(cmplt_ps, ps, NARROW): the plain and masked register form, and the plain and masked S3 form */
#define RUN(id, suffix, lane)                                                                                  \
    static __attribute__((noinline)) lrb_k16 run_##id(lrb_ctx *c, const vector_case *v)                        \
    {                                                                                                          \
        lrb_k16 k = lrb_mask(v->mask);                                                                         \
        if (v->form == S3_REGISTER)                                                                            \
            return v->masked ? lrb_mask_##id(c, k, case_##suffix(v->a), case_##suffix(v->b))                   \
                             : lrb_##id(c, case_##suffix(v->a), case_##suffix(v->b));                          \
        return v->masked ? lrb_mask_##id##_s3(c, k, case_##suffix(v->a), case_s3_##suffix(v))                  \
                         : lrb_##id##_s3(c, case_##suffix(v->a), case_s3_##suffix(v));                         \
    }                                                                                                          \
    static bool ref2_##id(uint64_t a, uint64_t b) { return ref_##id(lane(a), lane(b)); }
#define NARROW(bits) ((uint32_t)(bits))
#define ROW_K_VV(id) RUN(id, ps, NARROW)
#define ROW_KI_VV(id) RUN(id, pi, NARROW)
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_cmplt_ps, ref2_cmplt_ps */
#include "lrbni/ops.def"

/* Bits beyond the lanes are 0. */
static void check(void *user, const vector_case *v)
{
    const row *r = user;
    lrb_ctx_begin(r->c);
    uint32_t bits = r->run(r->c, v).bits;
    for (int i = 0; i < 32; i++) {
        int lane = i % case_lanes(v->wide);
        uint64_t a = case_get(v->a, v->wide, lane), b = case_b(v, lane);
        bool expected = i == lane && case_live(v, i) && r->ref(a, b);
        if ((bits >> i & 1) != expected)
            fail_msg("%s bit %d of %08x, mask %04x%s, form %d: a %08" PRIx64 " b %08" PRIx64, r->id, i, bits, v->mask,
                     v->masked ? "" : " (unused)", v->form, a, b);
    }
    case_check_event(r->c, r->op, v);
}

static void boundary_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 4};
    case_all_pairs(r->wide, &random, check, r);
}

static void random_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 5};
    case_random(20000, r->wide, &random, check, r);
}

#undef RUN
#define RUN(id, suffix, lane) {#id, LRB_OP_##id, sizeof lane(UINT64_C(0)) == 8, run_##id, ref2_##id, NULL},
static const row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"cmplt_ps", ...}, */
#include "lrbni/ops.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

int main(void)
{
    static row with_context[ROWS];
    static char names[2 * ROWS][64];
    struct CMUnitTest tests[2 * ROWS];
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
    int failed = _cmocka_run_group_tests("compare " LRB_BACKEND, tests, 2 * ROWS, NULL, NULL);
    case_teardown(&c);
    return failed;
}
