/* Every op from vector registers and S3 against its reference: all forms, all masks, boundary values and random bits. */
#include <inttypes.h>

#include "tests/lrbni/vector_ops.h"

typedef struct fixture {
    const vector_op *op;
    lrb_ctx *c;
} fixture;

/* What lane i becomes; of a compare, bit i. */
static uint64_t expected_lane(const vector_op *op, const vector_case *v, int i)
{
    uint64_t d = case_get(v->d, v->wide, i);
    if (case_live(v, i))
        return op->ref(d, case_get(v->a, v->wide, i), case_b(v, i));
    return op->kind == VECTOR_COMPARE ? 0 : d;
}

static void check(void *user, const vector_case *v)
{
    const fixture *f = user;
    uint32_t out[16];
    lrb_ctx_begin(f->c);
    f->op->run(f->c, v, out);
    for (int i = 0; i < case_lanes(v->wide); i++) {
        uint64_t expected = expected_lane(f->op, v, i);
        uint64_t got = f->op->kind == VECTOR_COMPARE ? out[0] >> i & 1 : case_get(out, v->wide, i);
        if (got != expected)
            fail_msg("%s lane %d, mask %04x%s, form %d: d %08" PRIx64 " a %08" PRIx64 " b %08" PRIx64 ": got %08" PRIx64
                     ", expected %08" PRIx64, f->op->id, i, v->mask, v->masked ? "" : " (unused)", v->form,
                     case_get(v->d, v->wide, i), case_get(v->a, v->wide, i), case_b(v, i), got, expected);
    }
    if (f->op->kind == VECTOR_COMPARE && out[0] >> case_lanes(v->wide))
        fail_msg("%s: %08x has bits beyond the lanes", f->op->id, out[0]);
    case_check_event(f->c, f->op->op, v);
}

static void boundary_values(void **state)
{
    fixture *f = *state;
    base_random random = {.state = 1};
    if (f->op->ternary)
        case_all_triples(f->op->wide, &random, check, f);
    else
        case_all_pairs(f->op->wide, &random, check, f);
}

static void random_values(void **state)
{
    fixture *f = *state;
    base_random random = {.state = 2};
    case_random(20000, f->op->wide, &random, check, f);
}

/* The permute has immediates in place of a second source: every block choice with every word choice. */
static void shuf128x32_ps__every_immediate__as_oracle(void **state)
{
    lrb_ctx *c = *state;
    vector_case v = {.form = S3_REGISTER};
    base_random random = {.state = 3};
    for (unsigned blocks = 0; blocks < 256; blocks++)
        for (unsigned words = 0; words < 256; words++) {
            for (int i = 0; i < 16; i++)
                v.d[i] = random_bits(&random), v.a[i] = random_bits(&random);
            v.masked = words % 3 == 0;
            v.mask = mask_number((int)(blocks % MASKS), &random);
            uint32_t out[16];
            lrb_ctx_begin(c);
            lrb_v16f a = case_ps(v.a);
            lanes_store_ps(out, (v.masked ? lrb_mask_shuf128x32_ps(c, case_ps(v.d), lrb_mask(v.mask), a, blocks, words)
                                          : lrb_shuf128x32_ps(c, a, blocks, words)).lanes);
            for (int i = 0; i < 16; i++) {
                uint32_t expected = case_live(&v, i) ? v.a[ref_shuf128x32_ps(i, blocks, words)] : v.d[i];
                if (out[i] != expected)
                    fail_msg("lane %d, blocks %02x, words %02x, mask %04x: got %08x, expected %08x", i, blocks, words, v.mask,
                             out[i], expected);
            }
            case_check_event(c, LRB_OP_shuf128x32_ps, &v);
        }
}

int main(void)
{
    static fixture fixtures[VECTOR_OPS];
    static char names[2 * VECTOR_OPS][64];
    struct CMUnitTest tests[2 * VECTOR_OPS + 1];
    void *c = NULL;
    if (case_setup(&c) != 0)
        return 1;
    for (int i = 0; i < VECTOR_OPS; i++) {
        fixtures[i] = (fixture){&vector_ops[i], c};
        snprintf(names[2 * i], sizeof names[0], "%s__boundary_values__as_oracle", vector_ops[i].id);
        snprintf(names[2 * i + 1], sizeof names[0], "%s__random_bits__as_oracle", vector_ops[i].id);
        tests[2 * i] = (struct CMUnitTest){names[2 * i], boundary_values, NULL, NULL, &fixtures[i]};
        tests[2 * i + 1] = (struct CMUnitTest){names[2 * i + 1], random_values, NULL, NULL, &fixtures[i]};
    }
    tests[2 * VECTOR_OPS] = (struct CMUnitTest){"shuf128x32_ps__every_immediate__as_oracle",
                                                shuf128x32_ps__every_immediate__as_oracle, NULL, NULL, c};
    int failed = _cmocka_run_group_tests("vector " LRB_BACKEND, tests, 2 * VECTOR_OPS + 1, NULL, NULL);
    case_teardown(&c);
    return failed;
}
