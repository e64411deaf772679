/* Mask registers, general registers, flags, branches and markers against their references. */
#include "tests/lrbni/case.h"

/* 64-bit boundary values; their low halves are what masks are made from. */
static const uint64_t words[] = {
    0, 1, 2, 3, 7, 15, 16, 31, 32, 33, 62, 63, 64, 65, 0x90, 0x8000, 0x00ff, 0xff00, 0xffff, 0x10000, 0x5555, 0xaaaa,
    0x7fffffff, 0x80000000, 0xffffffff, 0x100000000, 0x7fffffffffffffff, 0x8000000000000000, 0xffffffffffffffff,
    0xfffffffffffffffe, 0x5555555555555555, 0xdeadbeefcafef00d, 0x0123456789abcdef,
};
enum { WORDS = sizeof words / sizeof words[0], TRIALS = WORDS * WORDS + 20000 };

/* Pair `n`: all pairs of boundary values, then random bits. */
static void pair(int n, base_random *random, uint64_t *a, uint64_t *b)
{
    *a = n < WORDS * WORDS ? words[n / WORDS] : base_random_bits(random) >> (base_random_bits(random) & 63);
    *b = n < WORDS * WORDS ? words[n % WORDS] : base_random_bits(random) >> (base_random_bits(random) & 63);
}

/* The op left one event of its own, unmasked, without sources. */
static void check_event(lrb_ctx *c, unsigned op, unsigned mask, uint32_t aux)
{
    const lrb_event *e = &c->events[0];
    static const uint16_t none[4] = {0};
    if (c->next_event != LRB_FAR + 1 || e->op != op || e->mask != mask || e->aux != aux || memcmp(e->src, none, sizeof none))
        fail_msg("%s: event op %04x mask %04x aux %x", lrb_op_table[op].id, e->op, e->mask, e->aux);
    lrb_ctx_begin(c);
}

static void check_value(const char *id, uint64_t a, uint64_t b, uint64_t got, uint64_t expected)
{
    if (got != expected)
        fail_msg("%s of %llx, %llx: got %llx, expected %llx", id, (unsigned long long)a, (unsigned long long)b,
                 (unsigned long long)got, (unsigned long long)expected);
}

static void check_flags(const char *id, uint64_t a, uint64_t b, lrb_flags got, ref_flags expected)
{
    unsigned bits = got.zero * 4u + got.carry * 2u + got.less, right = expected.zero * 4u + expected.carry * 2u + expected.less;
    check_value(id, a, b, bits, right);
}

/* EVERY_PAIR(kand, check_value(...)): a, b are general values, and their low 16 bits masks */
#define EVERY_PAIR(id, check)                                                \
    static void id##__pairs__as_oracle(void **state)                         \
    {                                                                        \
        lrb_ctx *c = *state;                                                 \
        base_random random = {.state = 10};                                  \
        lrb_ctx_begin(c);                                                    \
        for (int n = 0; n < TRIALS; n++) {                                   \
            uint64_t a, b;                                                   \
            pair(n, &random, &a, &b);                                        \
            uint32_t ka = a & 0xffff, kb = b & 0xffff;                       \
            (void)ka, (void)kb;                                              \
            check;                                                           \
            check_event(c, LRB_OP_##id, 0xffff, 0);                          \
        }                                                                    \
    }
#define ROW_K_KK(id) EVERY_PAIR(id, check_value(#id, ka, kb, lrb_##id(c, lrb_mask(ka), lrb_mask(kb)).bits, ref_##id(ka, kb)))
#define ROW_K_K(id) EVERY_PAIR(id, check_value(#id, ka, 0, lrb_##id(c, lrb_mask(ka)).bits, ref_##id(ka)))
#define ROW_F_KK(id) EVERY_PAIR(id, check_flags(#id, ka, kb, lrb_##id(c, lrb_mask(ka), lrb_mask(kb)), ref_##id(ka, kb)))
#define ROW_K_R(id) EVERY_PAIR(id, check_value(#id, a, 0, lrb_##id(c, lrb_imm(a)).bits, ref_##id(a)))
#define ROW_R_K(id) EVERY_PAIR(id, check_value(#id, ka, 0, lrb_##id(c, lrb_mask(ka)).value, ref_##id(ka)))
#define ROW_R_R(id) EVERY_PAIR(id, check_value(#id, a, 0, lrb_##id(c, lrb_imm(a)).value, ref_##id(a)))
#define ROW_R_RR(id) EVERY_PAIR(id, check_value(#id, a, b, lrb_##id(c, lrb_imm(a), lrb_imm(b)).value, ref_##id(a, b)))
#define ROW_R_RI(id) EVERY_PAIR(id, check_value(#id, a, b & 63, lrb_##id(c, lrb_imm(a), b & 63).value, ref_##id(a, b & 63)))
#define ROW_R_KK(id) EVERY_PAIR(id, check_value(#id, ka, kb, lrb_##id(c, lrb_mask(ka), lrb_mask(kb)).value, ref_##id(ka, kb)))
#define ROW_K_RI(id) EVERY_PAIR(id, check_value(#id, a, b & 3, lrb_##id(c, lrb_imm(a), b & 3).bits, ref_##id(a, b & 3)))
/* A field from `low` up, anywhere: its rotation and ends are made from b. */
#define FIELD(b) (unsigned)((b) & 63), (unsigned)((b) >> 6 & 63), (unsigned)((b) >> 6 & 63) + (unsigned)((b) >> 12) % (64 - (unsigned)((b) >> 6 & 63))
#define ROW_R_RIII(id) EVERY_PAIR(id, check_value(#id, a, b, lrb_##id(c, lrb_imm(a), FIELD(b)).value, ref_##id(a, FIELD(b))))
#define ROW_R_RRIII(id) \
    EVERY_PAIR(id, check_value(#id, a, b, lrb_##id(c, lrb_imm(a), lrb_imm(~b), FIELD(b)).value, ref_##id(a, ~b, FIELD(b))))
#define ROW_F_RR(id) EVERY_PAIR(id, check_flags(#id, a, b, lrb_##id(c, lrb_imm(a), lrb_imm(b)), ref_##id(a, b)))

/* ROW_P_PR(lea): addresses; the host pointer goes where the simulated address goes */
#define ROW_P_PR(id)                                                                                          \
    static void id##__bases_and_indices__as_oracle(void **state)                                              \
    {                                                                                                         \
        lrb_ctx *c = *state;                                                                                  \
        base_random random = {.state = 11};                                                                   \
        static unsigned char host[65536];                                                                     \
        lrb_ctx_begin(c);                                                                                     \
        for (int n = 0; n < TRIALS; n++) {                                                                    \
            uint32_t start = (uint32_t)base_random_bits(&random) % 4096 + 30000;                              \
            int64_t index = (int64_t)(base_random_bits(&random) % 4001) - 2000;                               \
            unsigned scale = 1u << (base_random_bits(&random) & 3);                                           \
            int32_t displacement = (int32_t)(base_random_bits(&random) % 4001) - 2000;                        \
            lrb_segment segment = {.host = host, .address = 0x20000000, .size = sizeof host};                 \
            lrb_ptr p = lrb_##id(c, lrb_segment_at(segment, start), lrb_imm((uint64_t)index), scale, displacement); \
            check_value(#id, start, (uint64_t)index, p.address,                                               \
                        ref_##id(0x20000000 + start, (uint64_t)index, scale, displacement));                  \
            check_value(#id, start, (uint64_t)index, (uint64_t)(p.host - host), p.address - 0x20000000u);     \
            check_event(c, LRB_OP_##id, 0xffff, 0);                                                           \
        }                                                                                                     \
    }

/* ROW_B_F(jcc): every condition on every combination of flags; the event tells the site, and whether it was taken */
#define ROW_B_F(id)                                                                                           \
    static void id##__every_condition__as_oracle(void **state)                                                \
    {                                                                                                         \
        lrb_ctx *c = *state;                                                                                  \
        lrb_ctx_begin(c);                                                                                     \
        for (int n = 0; n < 8 * REF_CONDITIONS; n++) {                                                        \
            ref_flags r = {.zero = n & 1, .carry = n >> 1 & 1, .less = n >> 2 & 1};                           \
            lrb_flags f = {.zero = r.zero, .carry = r.carry, .less = r.less};                                 \
            ref_condition condition = (ref_condition)(n / 8);                                                 \
            uint32_t site = __LINE__ | LRB_SOURCE << 16;                                                      \
            bool taken = condition == REF_ZERO ? lrb_jz(c, f) : condition == REF_NOT_ZERO ? lrb_jnz(c, f)     \
                         : condition == REF_BELOW      ? lrb_jb(c, f) : lrb_jl(c, f);                         \
            check_value(#id, (uint64_t)n, 0, taken, ref_##id(r, condition));                                  \
            check_event(c, LRB_OP_##id, ref_##id(r, condition), site);                                        \
        }                                                                                                     \
    }

/* ROW_B_K(jkzd): every mask */
#define ROW_B_K(id)                                                                                           \
    static void id##__every_mask__as_oracle(void **state)                                                     \
    {                                                                                                         \
        lrb_ctx *c = *state;                                                                                  \
        lrb_ctx_begin(c);                                                                                     \
        for (uint32_t bits = 0; bits < 65536; bits++) {                                                       \
            bool taken = lrb_##id(c, lrb_mask(bits));                                                         \
            check_value(#id, bits, 0, taken, ref_##id(bits));                                                 \
            check_event(c, LRB_OP_##id, ref_##id(bits), __LINE__ | LRB_SOURCE << 16);                         \
        }                                                                                                     \
    }

/* ROW_B(jmp): always taken */
#define ROW_B(id)                                                                 \
    static void id##__taken__as_oracle(void **state)                              \
    {                                                                             \
        lrb_ctx *c = *state;                                                      \
        lrb_ctx_begin(c);                                                         \
        lrb_##id(c), check_event(c, LRB_OP_##id, ref_##id(), __LINE__ | LRB_SOURCE << 16); \
    }

/* ROW_MARK(phase): one event, no id */
#define ROW_MARK(id)                                                              \
    static void id##__any_number__in_the_event(void **state)                      \
    {                                                                             \
        lrb_ctx *c = *state;                                                      \
        for (int n = 0; n < WORDS; n++) {                                         \
            lrb_ctx_begin(c);                                                     \
            lrb_##id(c, (uint32_t)words[n]);                                      \
            assert_int_equal(c->next_event, LRB_FAR);                             \
            assert_ptr_equal(c->free_event, c->events + 1);                       \
            assert_int_equal(c->events[0].op, LRB_OP_##id);                       \
            assert_int_equal(c->events[0].mask, 0);                               \
            assert_int_equal(c->events[0].aux, ref_##id((uint32_t)words[n]));     \
        }                                                                         \
    }

#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* kand__pairs__as_oracle */
#include "lrbni/ops.def"

/* The comparison of addresses is a cmp too: unsigned, of the simulated addresses alone. */
static void cmp_ptr__pairs__flags_of_addresses(void **state)
{
    lrb_ctx *c = *state;
    lrb_ctx_begin(c);
    for (int n = 0; n < WORDS * WORDS; n++) {
        lrb_ptr a = {.address = (uint32_t)words[n / WORDS]}, b = {.address = (uint32_t)words[n % WORDS]};
        ref_flags expected = ref_cmp(a.address, b.address);
        expected.less = false;
        check_flags("cmp_ptr", a.address, b.address, lrb_cmp_ptr(c, a, b), expected);
        check_event(c, LRB_OP_cmp, 0xffff, 0);
    }
}

#undef ROW_K_KK
#undef ROW_K_K
#undef ROW_F_KK
#undef ROW_K_R
#undef ROW_R_K
#undef ROW_R_R
#undef ROW_R_RR
#undef ROW_R_RI
#undef ROW_F_RR
#undef ROW_P_PR
#undef ROW_R_KK
#undef ROW_K_RI
#undef ROW_R_RIII
#undef ROW_R_RRIII
#undef ROW_B_F
#undef ROW_B_K
#undef ROW_B
#undef ROW_MARK
#define PAIRS(id) cmocka_unit_test(id##__pairs__as_oracle),
#define ROW_K_KK(id) PAIRS(id)
#define ROW_K_K(id) PAIRS(id)
#define ROW_F_KK(id) PAIRS(id)
#define ROW_K_R(id) PAIRS(id)
#define ROW_R_K(id) PAIRS(id)
#define ROW_R_R(id) PAIRS(id)
#define ROW_R_RR(id) PAIRS(id)
#define ROW_R_RI(id) PAIRS(id)
#define ROW_F_RR(id) PAIRS(id)
#define ROW_P_PR(id) cmocka_unit_test(id##__bases_and_indices__as_oracle),
#define ROW_B_F(id) cmocka_unit_test(id##__every_condition__as_oracle),
#define ROW_R_KK(id) PAIRS(id)
#define ROW_K_RI(id) PAIRS(id)
#define ROW_R_RIII(id) PAIRS(id)
#define ROW_R_RRIII(id) PAIRS(id)
#define ROW_B_K(id) cmocka_unit_test(id##__every_mask__as_oracle),
#define ROW_B(id) cmocka_unit_test(id##__taken__as_oracle),
#define ROW_MARK(id) cmocka_unit_test(id##__any_number__in_the_event),

int main(void)
{
    const struct CMUnitTest tests[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"kand__pairs__as_oracle", ...}, */
#include "lrbni/ops.def"
        cmocka_unit_test(cmp_ptr__pairs__flags_of_addresses),
    };
    return cmocka_run_group_tests_name("scalar " LRB_BACKEND, tests, case_setup, case_teardown);
}
