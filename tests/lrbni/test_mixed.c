/* Ops whose lanes depend on more than their own operands, or that leave a mask beside the vector: blends, scale and bias of a
 * group, sums with their signs. Each in all forms, under all masks, against its reference. */
#include "tests/lrbni/case.h"

typedef struct fixture {
    lrb_ctx *c;
    lrb_k16 (*run)(lrb_ctx *c, const vector_case *v, uint32_t out[16]); /* returns the mask beside the vector, or none */
    uint64_t (*ref)(const vector_case *v, int lane, bool *sign);
    lrb_op_id op;
    bool all_written; /* the mask is an operand: the event says that all lanes are written */
} fixture;

static void check(void *user, const vector_case *v)
{
    const fixture *f = user;
    const char *id = lrb_op_table[f->op].id;
    uint32_t out[16], signs = 0;
    lrb_ctx_begin(f->c);
    uint32_t got_signs = f->run(f->c, v, out).bits;
    for (int i = 0; i < case_lanes(v->wide); i++) {
        bool sign = false;
        uint64_t expected = f->ref(v, i, &sign);
        signs |= (uint32_t)sign << i;
        if (case_get(out, v->wide, i) != expected)
            fail_msg("%s lane %d, mask %04x, form %d: got %llx, expected %llx", id, i, v->masked ? v->mask : 0xffff, v->form,
                     (unsigned long long)case_get(out, v->wide, i), (unsigned long long)expected);
    }
    if (got_signs != signs)
        fail_msg("%s: mask %04x beside the vector, expected %04x", id, got_signs, signs);
    vector_case written = *v;
    written.masked = v->masked && !f->all_written;
    case_check_event(f->c, f->op, &written);
}

/* Boundary values, then random ones. */
static void check_all(fixture *f, bool wide)
{
    base_random random = {.state = 8};
    case_all_pairs(wide, &random, check, f);
    case_random(20000, wide, &random, check, f);
}

static lrb_k16 no_mask(void) { return lrb_mask(0); }

/* BLEND(blendm_ps, ps, uint32_t) */
#define BLEND(id, suffix, lane)                                                                               \
    static lrb_k16 run_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16])                               \
    {                                                                                                         \
        lrb_k16 k = lrb_mask(v->masked ? v->mask : 0xffff);                                                   \
        lanes_store_##suffix(out, (v->form == S3_REGISTER                                                     \
                                       ? lrb_##id(c, k, case_##suffix(v->a), case_##suffix(v->b))             \
                                       : lrb_##id##_s3(c, k, case_##suffix(v->a), case_s3_##suffix(v))).lanes); \
        return no_mask();                                                                                     \
    }                                                                                                         \
    static uint64_t lane_##id(const vector_case *v, int i, bool *sign)                                        \
    {                                                                                                         \
        (void)sign;                                                                                           \
        return ref_##id(case_live(v, i), (lane)case_get(v->a, v->wide, i), (lane)case_b(v, i));               \
    }                                                                                                         \
    static void id##__all_forms_and_masks__as_oracle(void **state)                                            \
    {                                                                                                         \
        fixture f = {.c = *state, .run = run_##id, .ref = lane_##id, .op = LRB_OP_##id, .all_written = true}; \
        check_all(&f, sizeof(lane) == 8);                                                                     \
    }
#define ROW_V_KVV(id) BLEND(id, ps, uint32_t)
#define ROW_VD_KVV(id) BLEND(id, pd, uint64_t)

/* Only the forms that ODB lists: a register, memory in full, {4to16}. */
static lrb_k16 run_groups(lrb_ctx *c, const vector_case *v, uint32_t out[16],
                          lrb_v16f (*plain)(lrb_ctx *, lrb_v16f, lrb_s3f),
                          lrb_v16f (*masked)(lrb_ctx *, lrb_v16f, lrb_k16, lrb_v16f, lrb_s3f))
{
    lrb_v16f a = case_ps(v->a);
    lrb_s3f b = case_s3_ps(v);
    lanes_store_ps(out, (v->masked ? masked(c, case_ps(v->d), lrb_mask(v->mask), a, b) : plain(c, a, b)).lanes);
    return no_mask();
}

static void check_group_form(void *user, const vector_case *v)
{
    if (v->form == S3_REGISTER || v->form == S3_FULL || v->form == S3_4TO16)
        check(user, v);
}

#define ROW_V_VX(id)                                                                                          \
    static lrb_k16 run_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16])                               \
    {                                                                                                         \
        return run_groups(c, v, out, lrb_##id##_s3, lrb_mask_##id##_s3);                                      \
    }                                                                                                         \
    static uint64_t lane_##id(const vector_case *v, int i, bool *sign)                                        \
    {                                                                                                         \
        uint32_t group[4];                                                                                    \
        (void)sign;                                                                                           \
        for (int j = 0; j < 4; j++)                                                                           \
            group[j] = (uint32_t)case_b(v, i / 4 * 4 + j);                                                    \
        return case_live(v, i) ? ref_##id(v->a[i], group) : v->d[i];                                          \
    }                                                                                                         \
    static void id##__all_forms_and_masks__as_oracle(void **state)                                            \
    {                                                                                                         \
        fixture f = {.c = *state, .run = run_##id, .ref = lane_##id, .op = LRB_OP_##id};                      \
        base_random random = {.state = 9};                                                                    \
        case_all_pairs(false, &random, check_group_form, &f);                                                 \
        case_random(80000, false, &random, check_group_form, &f);                                             \
    }

#define ROW_VK_VV(id)                                                                                         \
    static lrb_k16 run_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16])                               \
    {                                                                                                         \
        lrb_k16 k = lrb_mask(v->mask), signs = lrb_mask(0x5555); /* what it holds does not matter */          \
        lrb_v16f d = case_ps(v->d), a = case_ps(v->a), b = case_ps(v->b);                                     \
        if (v->form == S3_REGISTER)                                                                           \
            d = v->masked ? lrb_mask_##id(c, d, k, a, b, &signs) : lrb_##id(c, a, b, &signs);                 \
        else                                                                                                  \
            d = v->masked ? lrb_mask_##id##_s3(c, d, k, a, case_s3_ps(v), &signs)                             \
                          : lrb_##id##_s3(c, a, case_s3_ps(v), &signs);                                       \
        lanes_store_ps(out, d.lanes);                                                                         \
        return signs;                                                                                         \
    }                                                                                                         \
    static uint64_t lane_##id(const vector_case *v, int i, bool *sign)                                        \
    {                                                                                                         \
        return case_live(v, i) ? ref_##id(v->a[i], (uint32_t)case_b(v, i), sign) : v->d[i];                   \
    }                                                                                                         \
    static void id##__all_forms_and_masks__as_oracle(void **state)                                            \
    {                                                                                                         \
        fixture f = {.c = *state, .run = run_##id, .ref = lane_##id, .op = LRB_OP_##id};                      \
        check_all(&f, false);                                                                                 \
    }
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* blendm_ps__all_forms_... */
#include "lrbni/ops.def"

/* The write-mask and the signs may be the same register: k1 of the instruction. */
static void addsets_ps__signs_into_the_mask__read_before_written(void **state)
{
    const uint32_t words[16] = {0xbf800000, 0xbf800000};
    lrb_k16 k = lrb_mask(0x0006);
    lrb_v16f a = case_ps(words);
    lrb_v16f d = lrb_mask_addsets_ps(*state, a, k, a, a, &k);
    uint32_t out[16];
    lanes_store_ps(out, d.lanes);
    assert_int_equal(k.bits, 0x0002);
    assert_int_equal(out[0], 0xbf800000);
    assert_int_equal(out[1], 0xc0000000);
}

#undef ROW_V_KVV
#undef ROW_VD_KVV
#undef ROW_V_VX
#undef ROW_VK_VV
#define ROW_V_KVV(id) cmocka_unit_test(id##__all_forms_and_masks__as_oracle),
#define ROW_VD_KVV(id) cmocka_unit_test(id##__all_forms_and_masks__as_oracle),
#define ROW_V_VX(id) cmocka_unit_test(id##__all_forms_and_masks__as_oracle),
#define ROW_VK_VV(id) cmocka_unit_test(id##__all_forms_and_masks__as_oracle),

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(addsets_ps__signs_into_the_mask__read_before_written),
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"blendm_ps__all_forms_...", ...}, */
#include "lrbni/ops.def"
    };
    return cmocka_run_group_tests_name("mixed " LRB_BACKEND, tests, case_setup, case_teardown);
}
