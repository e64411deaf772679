/* The state of the machine: its register, and what every op that rounds gives in each of the 16 states, set by ldvxcsr or taken
 * from the instruction, against sums and products in fixed point. */
#include <math.h>

#define LRB_CONTROL 1
#include "tests/lrbni/vector_ops.h"

enum { STATES = 16 };

static ref_control state_number(int n)
{
    return (ref_control){.rounding = n % 4, .flush_to_zero = n / 4 % 2, .denormals_are_zero = n / 8};
}

static lrb_control control_of(ref_control control)
{
    return (lrb_control){(uint8_t)control.rounding, control.flush_to_zero, control.denormals_are_zero};
}

static lrb_mem word_at(uint32_t *word)
{
    lrb_segment segment = {.host = (unsigned char *)word, .address = CASE_ADDRESS, .size = 4};
    return lrb_at(lrb_segment_at(segment, 0), 0);
}

static void check_event(const lrb_ctx *c, unsigned op)
{
    assert_int_equal(c->next_event, LRB_FAR + 1);
    assert_int_equal(c->events[0].op, op);
    assert_int_equal(c->events[0].aux, CASE_ADDRESS);
}

#define LOADS_STATE(id)                                                                    \
    static void id##__every_upper_and_lower_byte__as_oracle(void **state)                  \
    {                                                                                      \
        lrb_ctx *c = *state;                                                               \
        for (uint32_t bits = 0; bits < 0x10000; bits++) {                                  \
            uint32_t word = bits | bits << 16;                                             \
            lrb_ctx_begin(c);                                                              \
            lrb_##id(c, word_at(&word));                                                   \
            ref_control expected = ref_##id((const unsigned char *)&word);                 \
            assert_int_equal(c->control.rounding, expected.rounding);                      \
            assert_int_equal(c->control.flush_to_zero, expected.flush_to_zero);            \
            assert_int_equal(c->control.denormals_are_zero, expected.denormals_are_zero);  \
            check_event(c, LRB_OP_##id);                                                   \
        }                                                                                  \
    }
#define STORES_STATE(id)                                                                   \
    static void id##__every_state__as_oracle(void **state)                                 \
    {                                                                                      \
        lrb_ctx *c = *state;                                                               \
        for (int n = 0; n < STATES; n++) {                                                 \
            uint32_t word = 0x55aa55aa, expected;                                          \
            lrb_ctx_begin(c);                                                              \
            c->control = control_of(state_number(n));                                      \
            lrb_##id(c, word_at(&word));                                                   \
            ref_##id((unsigned char *)&expected, state_number(n));                         \
            assert_int_equal(word, expected);                                              \
            check_event(c, LRB_OP_##id);                                                   \
        }                                                                                  \
    }
LOADS_STATE(ldvxcsr)
STORES_STATE(stvxcsr)

/* What an op computes: x * y + z, with signs; kinds of formulas. */
typedef enum formula { SUM, DIFFERENCE, REVERSED, NEGATED_SUM, PRODUCT, FUSED_132, FUSED_213, FUSED_231 } formula;

/* An op that rounds, with its static rounding form. */
typedef struct rounding_op {
    lrb_op_id op;
    formula formula;
    bool negate_product, negate_addend;
    void (*round)(lrb_ctx *c, const vector_case *v, lrb_rounding rounding, uint32_t out[16]);
} rounding_op;

/* ROUND2(add, ps), ROUND3(madd231, ps): the form with a rounding mode, plain or masked */
#define ROUND2(base, suffix)                                                                                    \
    static __attribute__((noinline)) void round_##base##_##suffix(lrb_ctx *c, const vector_case *v,             \
                                                                  lrb_rounding rounding, uint32_t out[16])      \
    {                                                                                                           \
        LRB_VECTOR_##suffix d = case_##suffix(v->d), a = case_##suffix(v->a), b = case_##suffix(v->b);          \
        lanes_store_##suffix(out, (v->masked ? lrb_mask_##base##_round_##suffix(c, d, lrb_mask(v->mask), a, b, rounding) \
                                             : lrb_##base##_round_##suffix(c, a, b, rounding)).lanes);          \
    }
#define ROUND3(base, suffix)                                                                                    \
    static __attribute__((noinline)) void round_##base##_##suffix(lrb_ctx *c, const vector_case *v,             \
                                                                  lrb_rounding rounding, uint32_t out[16])      \
    {                                                                                                           \
        LRB_VECTOR_##suffix d = case_##suffix(v->d), a = case_##suffix(v->a), b = case_##suffix(v->b);          \
        lanes_store_##suffix(out, (v->masked ? lrb_mask_##base##_round_##suffix(c, d, lrb_mask(v->mask), a, b, rounding) \
                                             : lrb_##base##_round_##suffix(c, d, a, b, rounding)).lanes);       \
    }
#define ROUNDING_OPS(suffix, OP2, OP3)                     \
    OP2(add, suffix, SUM, false, false)                    \
    OP2(addn, suffix, NEGATED_SUM, true, true)             \
    OP2(sub, suffix, DIFFERENCE, false, true)              \
    OP2(subr, suffix, REVERSED, false, true)               \
    OP2(mul, suffix, PRODUCT, false, false)                \
    OP3(madd132, suffix, FUSED_132, false, false)          \
    OP3(madd213, suffix, FUSED_213, false, false)          \
    OP3(madd231, suffix, FUSED_231, false, false)          \
    OP3(msub132, suffix, FUSED_132, false, true)           \
    OP3(msub213, suffix, FUSED_213, false, true)           \
    OP3(msub231, suffix, FUSED_231, false, true)           \
    OP3(msubr132, suffix, FUSED_132, true, false)          \
    OP3(msubr213, suffix, FUSED_213, true, false)          \
    OP3(msubr231, suffix, FUSED_231, true, false)          \
    OP3(maddn132, suffix, FUSED_132, true, true)           \
    OP3(maddn213, suffix, FUSED_213, true, true)           \
    OP3(maddn231, suffix, FUSED_231, true, true)
#define DEFINE2(base, suffix, formula, negate_product, negate_addend) ROUND2(base, suffix)
#define DEFINE3(base, suffix, formula, negate_product, negate_addend) ROUND3(base, suffix)
ROUNDING_OPS(ps, DEFINE2, DEFINE3)
ROUNDING_OPS(pd, DEFINE2, DEFINE3)

#define ENTRY(base, suffix, formula, negate_product, negate_addend) \
    {LRB_OP_##base##_##suffix, formula, negate_product, negate_addend, round_##base##_##suffix},
static const rounding_op rounding_ops[] = {ROUNDING_OPS(ps, ENTRY, ENTRY) ROUNDING_OPS(pd, ENTRY, ENTRY)};
enum { ROUNDING_OPS_COUNT = sizeof rounding_ops / sizeof rounding_ops[0] };

static uint64_t reference(const rounding_op *o, ref_control control, const vector_case *v, int lane)
{
    const bool wide = v->wide;
    uint64_t d = case_get(v->d, wide, lane), a = case_get(v->a, wide, lane), b = case_get(v->b, wide, lane);
    ref_sources s = {.negate_product = o->negate_product, .negate_addend = o->negate_addend};
    switch (o->formula) {
    case PRODUCT:
        return ref_product(wide, control, a, b);
    case FUSED_132:
        s.x = d, s.y = b, s.z = a;
        return ref_fused(wide, control, s);
    case FUSED_213:
        s.x = a, s.y = d, s.z = b;
        return ref_fused(wide, control, s);
    case FUSED_231:
        s.x = a, s.y = b, s.z = d;
        return ref_fused(wide, control, s);
    case REVERSED:
        return ref_sum(wide, control, b, a, false, true);
    default:
        return ref_sum(wide, control, a, b, o->negate_product, o->negate_addend);
    }
}

typedef struct fixture {
    lrb_ctx *c;
    const rounding_op *o;
    const vector_op *vector;
    uint32_t cases;
} fixture;

static void compare(const fixture *f, ref_control control, const vector_case *v, const uint32_t out[16], const char *how)
{
    for (int i = 0; i < case_lanes(v->wide); i++) {
        uint64_t expected = case_live(v, i) ? reference(f->o, control, v, i) : case_get(v->d, v->wide, i);
        uint64_t got = case_get(out, v->wide, i);
        if (got != expected)
            fail_msg("%s, %s, rounding %d, flush %d, denormals are zero %d: d %llx a %llx b %llx: got %llx, expected %llx",
                     f->vector->id, how, control.rounding, control.flush_to_zero, control.denormals_are_zero,
                     (unsigned long long)case_get(v->d, v->wide, i), (unsigned long long)case_get(v->a, v->wide, i),
                     (unsigned long long)case_get(v->b, v->wide, i), (unsigned long long)got, (unsigned long long)expected);
    }
}

/* One state a case, the next one for the next case: by the register, then by the instruction over another mode there. */
static void check(void *user, const vector_case *given)
{
    fixture *f = user;
    vector_case v = *given;
    if (v.form > S3_SWIZZLE)
        return; /* all states are reached without the other forms, which change b alone */
    ref_control control = state_number((int)(f->cases++ % STATES));
    uint32_t out[16], word = lrb_control_bits(control_of(control));
    v.form = S3_REGISTER;
    lrb_ctx_begin(f->c);
    lrb_ldvxcsr(f->c, word_at(&word));
    f->vector->run(f->c, &v, out);
    compare(f, control, &v, out, "by the register");

    ref_control other = control;
    other.rounding ^= 1;
    lrb_ctx_begin(f->c);
    f->c->control = control_of(other);
    f->o->round(f->c, &v, (lrb_rounding)control.rounding, out);
    compare(f, control, &v, out, "by the instruction");
    case_check_event(f->c, f->o->op, &v);
    assert_int_equal(f->c->control.rounding, other.rounding);
}

/* A third of the addends lies close to the product, where a second rounding or a lost bit would show. */
static void check_near(void *user, const vector_case *given)
{
    vector_case v = *given;
    const bool wide = v.wide;
    for (int i = 0; i < case_lanes(wide); i += 3) {
        uint64_t product = ref_product(wide, (ref_control){0}, case_get(v.a, wide, i), case_get(v.b, wide, i));
        case_set(v.d, wide, i, (product ^ (wide ? UINT64_C(1) << 63 : UINT64_C(1) << 31)) + (case_get(v.d, wide, i) & 3));
    }
    check(user, &v);
}

static const vector_op *vector_of(lrb_op_id id)
{
    for (int i = 0; i < VECTOR_OPS; i++)
        if (vector_ops[i].op == id)
            return &vector_ops[i];
    fail_msg("%s has no shape of vector_ops.h", lrb_op_table[id].id);
    return NULL;
}

static void rounding_ops__every_state__as_oracle(void **state)
{
    for (int i = 0; i < ROUNDING_OPS_COUNT; i++) {
        fixture f = {.c = *state, .o = &rounding_ops[i], .vector = vector_of(rounding_ops[i].op)};
        base_random random = {.state = 60};
        if (f.vector->ternary)
            case_all_triples(f.vector->wide, &random, check, &f);
        else
            case_all_pairs(f.vector->wide, &random, check, &f);
        case_random(20000, f.vector->wide, &random, check_near, &f);
    }
}

/* What does not round: subnormal sources count as zeros where the state says so, and nothing else changes (assumed). */
static const lrb_op_id choices[] = {
    LRB_OP_min_ps,      LRB_OP_max_ps,    LRB_OP_gmin_ps,   LRB_OP_gmax_ps,   LRB_OP_maxabs_ps, LRB_OP_gmaxabs_ps,
    LRB_OP_clampz_ps,   LRB_OP_min_pd,    LRB_OP_max_pd,    LRB_OP_gmin_pd,   LRB_OP_gmax_pd,   LRB_OP_cmpeq_ps,
    LRB_OP_cmplt_ps,    LRB_OP_cmple_ps,  LRB_OP_cmpneq_ps, LRB_OP_cmpnlt_ps, LRB_OP_cmpnle_ps, LRB_OP_cmpord_ps,
    LRB_OP_cmpunord_ps, LRB_OP_cmpeq_pd,  LRB_OP_cmplt_pd,  LRB_OP_cmple_pd,  LRB_OP_cmpneq_pd, LRB_OP_cmpnlt_pd,
    LRB_OP_cmpnle_pd,   LRB_OP_cmpord_pd, LRB_OP_cmpunord_pd,
};
enum { CHOICES = sizeof choices / sizeof choices[0] };

static void flush_lanes(uint32_t words[16], bool wide)
{
    for (int i = 0; i < case_lanes(wide); i++) {
        double d = ref_value(wide, case_get(words, wide, i));
        if (fabs(d) < (wide ? 0x1p-1022 : 0x1p-126))
            case_set(words, wide, i, ref_bits(wide, copysign(0, d)));
    }
}

static void check_choice(void *user, const vector_case *v)
{
    fixture *f = user;
    ref_control control = state_number((int)(f->cases++ % STATES));
    vector_case read = *v;
    uint32_t out[16] = {0}, expected[16] = {0};
    if (control.denormals_are_zero) {
        flush_lanes(read.a, v->wide);
        flush_lanes(read.b, v->wide);
    }
    lrb_ctx_begin(f->c);
    f->vector->run(f->c, &read, expected);
    lrb_ctx_begin(f->c);
    f->c->control = control_of(control);
    f->vector->run(f->c, v, out);
    if (memcmp(out, expected, sizeof out) != 0)
        fail_msg("%s with denormals are zero %d: got %08x..., expected %08x...", f->vector->id, control.denormals_are_zero, out[0],
                 expected[0]);
}

static void choices__every_state__denormals_read_as_said(void **state)
{
    for (int i = 0; i < CHOICES; i++) {
        fixture f = {.c = *state, .vector = vector_of(choices[i])};
        base_random random = {.state = 61};
        case_all_pairs(f.vector->wide, &random, check_choice, &f);
    }
}

/* Ops of other shapes give what the op gives that they are made of. */
static void composed_ops__every_state__as_their_parts(void **state)
{
    lrb_ctx *c = *state;
    base_random random = {.state = 62};
    for (int n = 0; n < 3200; n++) {
        uint32_t words[2][16], got[3][16], parts[3][16];
        for (int i = 0; i < 32; i++)
            words[i / 16][i % 16] = random_bits(&random);
        lrb_v16f a = case_ps(words[0]), b = case_ps(words[1]), one = {.lanes = lanes_one_ps()};
        lrb_k16 signs;
        lrb_ctx_begin(c);
        c->control = control_of(state_number(n % STATES));
        lanes_store_ps(got[0], lrb_madd233_ps(c, a, b).lanes);
        lrb_v16f bias = lrb_mov_ps_s3(c, lrb_swizzle_ps(b, LRB_AAAA)), scale = lrb_mov_ps_s3(c, lrb_swizzle_ps(b, LRB_BBBB));
        lanes_store_ps(parts[0], lrb_madd231_ps(c, bias, a, scale).lanes);
        lanes_store_ps(got[1], lrb_addsets_ps(c, a, b, &signs).lanes);
        lanes_store_ps(parts[1], lrb_add_ps(c, a, b).lanes);
        lanes_store_ps(got[2], lrb_msubr23c1_ps(c, a, b).lanes);
        lanes_store_ps(parts[2], lrb_msubr231_ps(c, one, a, b).lanes);
        assert_memory_equal(got, parts, sizeof got);
        for (int i = 0; i < 16; i++)
            assert_int_equal(signs.bits >> i & 1, got[1][i] >> 31);
        lanes_store_ps(got[0], lrb_madd233_round_ps(c, a, b, LRB_RU).lanes);
        lanes_store_ps(parts[0], lrb_madd231_round_ps(c, bias, a, scale, LRB_RU).lanes);
        assert_memory_equal(got[0], parts[0], sizeof got[0]);
    }
}

static void begin__after_a_change__default_state(void **state)
{
    lrb_ctx *c = *state;
    c->control = control_of(state_number(STATES - 1));
    lrb_ctx_begin(c);
    assert_true(lrb_control_is_default(c->control));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ldvxcsr__every_upper_and_lower_byte__as_oracle),
        cmocka_unit_test(stvxcsr__every_state__as_oracle),
        cmocka_unit_test(rounding_ops__every_state__as_oracle),
        cmocka_unit_test(choices__every_state__denormals_read_as_said),
        cmocka_unit_test(composed_ops__every_state__as_their_parts),
        cmocka_unit_test(begin__after_a_change__default_state),
    };
    return cmocka_run_group_tests_name("control " LRB_BACKEND, tests, case_setup, case_teardown);
}
