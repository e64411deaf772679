/* The ops against SIMDe, where it has the same operation: a million and more random lanes for each, with SIMDe in plain C
 * and with this CPU's instructions.
 *
 * Two rules. Where both results of an arithmetic operation are NaN they count as equal: SIMDe's plain C leaves the payload
 * to the compiler. Where SIMDe rounds a multiply-add twice, the factors have 12 significant bits and middling
 * exponents, so that the product is exact and both ways give the same.
 */
#include "tests/lrbni/simde_case.h"
#include "tests/lrbni/simde_ops.h"

static void arithmetic(lrb_ctx *c, const simde_ops *s)
{
    base_random random = {.state = 20};
    SAME(ps, add, lrb_add_ps(c, a, b), true, false)
    SAME(ps, sub, lrb_sub_ps(c, a, b), true, false)
    SAME(ps, sub, lrb_subr_ps(c, b, a), true, false)
    SAME(ps, mul, lrb_mul_ps(c, a, b), true, false)
}

static void multiply_add(lrb_ctx *c, const simde_ops *s)
{
    base_random random = {.state = 21};
    SAME(ps, fmadd, lrb_madd231_ps(c, d, a, b), true, !s->fused)
    SAME(ps, fmadd, lrb_madd213_ps(c, b, a, d), true, !s->fused)
    SAME(ps, fmadd, lrb_madd132_ps(c, a, d, b), true, !s->fused)
    SAME(ps, fmsub, lrb_msub231_ps(c, d, a, b), true, !s->fused)
    SAME(ps, fnmadd, lrb_msubr231_ps(c, d, a, b), true, !s->fused)
}

/* No rounding, so no excuse: bit for bit, NaNs too. */
static void selections(lrb_ctx *c, const simde_ops *s)
{
    base_random random = {.state = 22};
    SAME(ps, min, lrb_min_ps(c, a, b), false, false)
    SAME(ps, max, lrb_max_ps(c, a, b), false, false)
    SAME(ps, mask_mov, lrb_mask_mov_ps(c, d, lrb_mask(k), a), false, false)
    SAME(pi, and_epi32, lrb_and_pi(c, ai, bi), false, false)
    SAME(pi, or_epi32, lrb_or_pi(c, ai, bi), false, false)
    SAME(pi, xor_epi32, lrb_xor_pi(c, ai, bi), false, false)
    SAME(pi, add_epi32, lrb_add_pi(c, ai, bi), false, false)
    SAME(pi, sub_epi32, lrb_sub_pi(c, ai, bi), false, false)
}

static void compares(lrb_ctx *c, const simde_ops *s)
{
    base_random random = {.state = 23};
    for (int n = 0; n < VECTORS; n++) {
        operands o;
        draw(&o, &random, false);
        if (n % 2)
            for (int i = 0; i < 16; i += 1 + n % 5) /* equal operands are rare otherwise */
                o.b[i] = o.a[i];
        lrb_v16f a = case_ps(o.a), b = case_ps(o.b);
        const lrb_k16 got[8] = {lrb_cmpeq_ps(c, a, b),  lrb_cmplt_ps(c, a, b),  lrb_cmple_ps(c, a, b),  lrb_cmpunord_ps(c, a, b),
                                lrb_cmpneq_ps(c, a, b), lrb_cmpnlt_ps(c, a, b), lrb_cmpnle_ps(c, a, b), lrb_cmpord_ps(c, a, b)};
        for (int i = 0; i < 8; i++) {
            uint32_t theirs[16] = {0};
            s->cmp[i](o.a, o.b, o.c, 0, theirs);
            if (got[i].bits != theirs[0])
                fail_msg("compare %d: got %04x, SIMDe gives %04x", i, got[i].bits, theirs[0]);
        }
    }
}

/* BOTH(arithmetic): against SIMDe in plain C, and with instructions */
#define BOTH(group)                                                                                                    \
    static void group##__random_lanes__as_simde_in_plain_c(void **state) { group(*state, &simde_plain); }              \
    static void group##__random_lanes__as_simde_with_instructions(void **state) { group(*state, &simde_instructions); }
BOTH(arithmetic)
BOTH(multiply_add)
BOTH(selections)
BOTH(compares)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic__random_lanes__as_simde_in_plain_c),
        cmocka_unit_test(arithmetic__random_lanes__as_simde_with_instructions),
        cmocka_unit_test(multiply_add__random_lanes__as_simde_in_plain_c),
        cmocka_unit_test(multiply_add__random_lanes__as_simde_with_instructions),
        cmocka_unit_test(selections__random_lanes__as_simde_in_plain_c),
        cmocka_unit_test(selections__random_lanes__as_simde_with_instructions),
        cmocka_unit_test(compares__random_lanes__as_simde_in_plain_c),
        cmocka_unit_test(compares__random_lanes__as_simde_with_instructions),
    };
    return cmocka_run_group_tests_name("simde " LRB_BACKEND, tests, case_setup, case_teardown);
}
