/* The ops against SIMDe, where it has the same operation (simde.def): ten million and more random lanes for each, with SIMDe
 * in plain C and with this CPU's instructions.
 *
 * Two rules. Where both results of an op that rounds are NaN they count as equal: SIMDe's plain C leaves the payload to the
 * compiler. Where SIMDe rounds a multiply-add twice, the operands have half the significant bits and exponents near 0, so
 * that the product is exact and both ways give the same.
 */
#include <inttypes.h>

#include "tests/lrbni/simde_ops.h"
#include "tests/lrbni/vector_ops.h"

/* SIMDE_LANES, random lanes for each op, is given by the build: fewer with sanitizers. */

static bool is_nan(bool wide, uint64_t bits)
{
    return wide ? (bits & INT64_MAX) > 0x7ff0000000000000 : (bits & INT32_MAX) > 0x7f800000;
}

/* A significand of 12 or 26 bits, and an exponent near 0: products are exact. */
static uint64_t half(bool wide, uint64_t bits)
{
    return wide ? (bits & 0x803ffffff8000000) + 0x3fd0000000000000 : (bits & 0x81fff000) + 0x3e800000;
}

static void draw(vector_case *v, base_random *random, bool wide, bool exact_product)
{
    v->wide = wide;
    for (int i = 0; i < case_lanes(wide); i++) {
        uint64_t lanes[3]; /* d, a, b */
        for (int j = 0; j < 3; j++)
            lanes[j] = exact_product ? half(wide, base_random_bits(random)) : random_lane(wide, random);
        case_set(v->d, wide, i, lanes[0]);
        case_set(v->a, wide, i, lanes[1]);
        case_set(v->b, wide, i, lanes[base_random_bits(random) % 8 ? 2 : 1]); /* equal operands are rare otherwise */
    }
    v->mask = (uint32_t)base_random_bits(random) & 0xffffu;
}

static void compare(const vector_op *op, const vector_case *v, const uint32_t got[16], const uint32_t theirs[16])
{
    bool any_nan = lrb_op_table[op->op].round != LRB_ROUND_EXACT;
    if (op->kind == VECTOR_COMPARE && got[0] != theirs[0])
        fail_msg("%s: got %04x, SIMDe gives %04x", op->id, got[0], theirs[0]);
    if (op->kind == VECTOR_COMPARE || memcmp(got, theirs, 64) == 0)
        return;
    for (int i = 0; i < case_lanes(v->wide); i++) {
        uint64_t ours = case_get(got, v->wide, i), simde = case_get(theirs, v->wide, i);
        if (ours != simde && !(any_nan && is_nan(v->wide, ours) && is_nan(v->wide, simde)))
            fail_msg("%s: a %" PRIx64 " b %" PRIx64 " d %" PRIx64 ": got %" PRIx64 ", SIMDe gives %" PRIx64, op->id,
                     case_get(v->a, v->wide, i), case_get(v->b, v->wide, i), case_get(v->d, v->wide, i), ours, simde);
    }
}

/* Ops that take more than lanes: their masks and immediates are made from the case's mask, as in simde.def. */
#define MORE(id, suffix, call)                                                        \
    static void more_##id(lrb_ctx *c, const vector_case *v, uint32_t out[16])         \
    {                                                                                 \
        lanes_store_##suffix(out, (call).lanes);                                      \
    }
MORE(blendm_pi, pi, lrb_blendm_pi(c, lrb_mask(v->mask), case_pi(v->a), case_pi(v->b)))
MORE(blendm_pq, pq, lrb_blendm_pq(c, lrb_mask(v->mask), case_pq(v->a), case_pq(v->b)))
MORE(slli_pi, pi, lrb_slli_pi(c, case_pi(v->b), v->mask & 63))
MORE(srli_pi, pi, lrb_srli_pi(c, case_pi(v->b), v->mask & 63))
MORE(rotatefield_pi, pi, lrb_rotatefield_pi(c, case_pi(v->b), v->mask & 31, 0, 31))
MORE(permd_pi, pi, lrb_permd_pi(c, case_pi(v->a), case_pi(v->b)))
MORE(alignd_pi, pi, lrb_alignd_pi(c, case_pi(v->a), case_pi(v->b), v->mask & 15))
#define ENTRY(id, wide) {#id, LRB_OP_##id, VECTOR_MERGE, wide, false, more_##id, NULL}
static const vector_op more_ops[] = {ENTRY(blendm_pi, false), ENTRY(blendm_pq, true), ENTRY(slli_pi, false), ENTRY(srli_pi, false),
                                     ENTRY(rotatefield_pi, false), ENTRY(permd_pi, false), ENTRY(alignd_pi, false)};
enum { MORE_OPS = sizeof more_ops / sizeof more_ops[0] };

static const vector_op *op_of(lrb_op_id id)
{
    for (int i = 0; i < MORE_OPS; i++)
        if (more_ops[i].op == id)
            return &more_ops[i];
    for (int i = 0; i < VECTOR_OPS; i++)
        if (vector_ops[i].op == id)
            return &vector_ops[i];
    fail_msg("%s is in simde.def, but neither in vector_ops.h nor here", lrb_op_table[id].id);
    return NULL;
}

/* One draw of operands for each kind of them serves all ops. */
static void as_simde(lrb_ctx *c, const simde_ops *simde)
{
    base_random random = {.state = 20};
    for (int n = 0; n * 8 < SIMDE_LANES; n++) {
        vector_case drawn[2][2]; /* wide, exact_product */
        for (int i = 0; i < 4; i++) {
            drawn[i / 2][i % 2] = (vector_case){.form = S3_REGISTER};
            draw(&drawn[i / 2][i % 2], &random, i / 2, i % 2);
        }
        for (int i = 0; i < simde->count; i++) {
            const simde_op *theirs = &simde->ops[i];
            const vector_op *op = op_of(theirs->op);
            if (n % 2 && !op->wide)
                continue; /* sixteen lanes at a time */
            vector_case *v = &drawn[op->wide][theirs->form == SIMDE_FUSED && !simde->fused];
            uint32_t got[16], expected[16];
            v->masked = theirs->form == SIMDE_MASKED;
            op->run(c, v, got);
            theirs->run(v->d, v->a, v->b, v->mask, expected);
            compare(op, v, got, expected);
        }
    }
    printf("# %d ops, %d lanes each, SIMDe in %s\n", simde->count, SIMDE_LANES, simde->how);
}

static void random_lanes__simde_in_plain_c__same(void **state)
{
    as_simde(*state, &simde_plain);
}

static void random_lanes__simde_with_instructions__same(void **state)
{
    as_simde(*state, &simde_instructions);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_lanes__simde_in_plain_c__same),
        cmocka_unit_test(random_lanes__simde_with_instructions__same),
    };
    return cmocka_run_group_tests_name("simde " LRB_BACKEND, tests, case_setup, case_teardown);
}
