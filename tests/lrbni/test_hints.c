/* Hints: one event each, with the address or the cycles; no memory is touched, whatever the address (golden case 68). */
#include "tests/lrbni/case.h"

static void check_event(const lrb_ctx *c, unsigned op, uint32_t aux)
{
    const lrb_event *e = &c->events[0];
    if (c->next_event != LRB_FAR + 1 || e->op != op || e->mask != 0xffff || e->aux != aux || e->src[2] || e->src[3])
        fail_msg("%s: %u events, op %04x mask %04x aux %x, expected %x", lrb_op_table[op].id, c->next_event - LRB_FAR, e->op,
                 e->mask, e->aux, aux);
}

/* ROW_H_M(prefetch1): at addresses that no host memory is behind */
#define ROW_H_M(id)                                                                        \
    static void id##__any_address__an_event_and_no_access(void **state)                    \
    {                                                                                      \
        static const uint32_t addresses[] = {0, 1, 63, 64, 0x7fffffff, LRB_SCRATCH_ADDRESS, 0xffffffff}; \
        for (unsigned n = 0; n < sizeof addresses / sizeof addresses[0]; n++) {            \
            lrb_ctx_begin(*state);                                                         \
            lrb_##id(*state, (lrb_mem){.host = NULL, .address = addresses[n]});            \
            check_event(*state, LRB_OP_##id, ref_##id(addresses[n]));                      \
        }                                                                                  \
    }

/* ROW_H_R(delay) */
#define ROW_H_R(id)                                                                        \
    static void id##__any_number__in_the_event(void **state)                               \
    {                                                                                      \
        static const uint64_t numbers[] = {0, 1, 1000, 0xffffffff, 0x123456789a, UINT64_MAX}; \
        for (unsigned n = 0; n < sizeof numbers / sizeof numbers[0]; n++) {                \
            lrb_ctx_begin(*state);                                                         \
            lrb_##id(*state, lrb_imm(numbers[n]));                                         \
            check_event(*state, LRB_OP_##id, ref_##id(numbers[n]));                        \
        }                                                                                  \
    }

#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* prefetch1__any_address__... */
#include "lrbni/ops.def"

#undef ROW_H_M
#undef ROW_H_R
#define ROW_H_M(id) cmocka_unit_test(id##__any_address__an_event_and_no_access),
#define ROW_H_R(id) cmocka_unit_test(id##__any_number__in_the_event),

int main(void)
{
    const struct CMUnitTest tests[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"prefetch1__any_address__...", ...}, */
#include "lrbni/ops.def"
    };
    return cmocka_run_group_tests_name("hints " LRB_BACKEND, tests, case_setup, case_teardown);
}
