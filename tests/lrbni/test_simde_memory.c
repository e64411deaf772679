/* Memory ops against SIMDe, where it has the same (simde_memory.def): ten million and more random lanes for each, with SIMDe in plain C and
 * with this CPU's instructions. The halves and floats have no NaN among them: SIMDe's plain C leaves its payload to the compiler. */
#include "tests/lrbni/case.h"
#include "tests/lrbni/simde_memory.h"

enum { BLOCK = 256 };

/* SIMDE_LANES, random lanes for each op, is given by the build: fewer with sanitizers. */

typedef struct operands {
    alignas(64) unsigned char memory[BLOCK];
    uint32_t index[16], lanes[16], k;
} operands;

#define M lrb_at(lrb_segment_at(segment, 0), 0)
#define K lrb_mask(o->k)
#define INDEX case_pi(o->index)
#define V case_ps(o->lanes)
#define VI case_pi(o->lanes)
#define VD case_pd(o->lanes)
#define VQ case_pq(o->lanes)
#define PUT_PS(v) lanes_store_ps(o->lanes, (v).lanes)
#define PUT_PI(v) lanes_store_pi(o->lanes, (v).lanes)

#define SIMDE_MEMORY(name, ours, theirs)                                                                   \
    static __attribute__((noinline)) void name(lrb_ctx *c, operands *o)                                    \
    {                                                                                                      \
        lrb_segment segment = {.host = o->memory, .address = CASE_ADDRESS, .size = BLOCK};                 \
        lrb_ctx_begin(c);                                                                                  \
        ours;                                                                                              \
    }
#include "tests/lrbni/simde_memory.def"

static const struct {
    const char *name;
    void (*run)(lrb_ctx *c, operands *o);
} ops[] = {
#define SIMDE_MEMORY(name, ours, theirs) {#name, name}, /* {"compress_ps", compress_ps}, */
#include "tests/lrbni/simde_memory.def"
};
enum { OPS = sizeof ops / sizeof ops[0] };

static uint32_t no_nan(uint32_t bits)
{
    if ((bits & 0x7fffffff) > 0x7f800000)
        bits &= 0xbfffffff;
    for (int shift = 0; shift <= 16; shift += 16)
        if ((bits >> shift & 0x7fff) > 0x7c00)
            bits &= ~(0x4000u << shift);
    return bits;
}

static void draw(operands *o, base_random *random)
{
    for (int i = 0; i < BLOCK; i += 4) {
        uint32_t word = no_nan(random_bits(random));
        memcpy(o->memory + i, &word, sizeof word);
    }
    for (int i = 0; i < 16; i++) {
        uint32_t bits = random_bits(random);
        /* a third within the halves, a third within 16 bits as integers */
        o->lanes[i] = no_nan(i % 3 == 0 ? (bits & 0x8fffffff) + 0x30000000 : i % 3 == 1 ? (uint32_t)((int32_t)bits >> 14) : bits);
        o->index[i] = (uint32_t)base_random_bits(random) % (BLOCK / 4);
    }
    o->k = (uint32_t)base_random_bits(random) & 0xffff;
}

static void as_simde(lrb_ctx *c, const simde_memory_ops *simde)
{
    base_random random = {.state = 68};
    for (int n = 0; n * 8 < SIMDE_LANES; n++) {
        operands drawn;
        draw(&drawn, &random);
        for (int i = 0; i < OPS; i++) {
            const bool wide = strstr(ops[i].name, "_pd") || strstr(ops[i].name, "_pq");
            if (n % 2 && !wide)
                continue; /* sixteen lanes at a time */
            operands ours = drawn, theirs = drawn;
            ops[i].run(c, &ours);
            simde->functions[i](theirs.memory, theirs.k, theirs.index, theirs.lanes);
            if (memcmp(ours.memory, theirs.memory, BLOCK) != 0 || memcmp(ours.lanes, theirs.lanes, sizeof ours.lanes) != 0)
                fail_msg("%s, vector %d, mask %04x: not as SIMDe has it in %s", ops[i].name, n, drawn.k, simde->how);
        }
    }
}

static void ops__random_lanes__as_simde_in_plain_c(void **state) { as_simde(*state, &simde_memory_plain); }
static void ops__random_lanes__as_simde_with_instructions(void **state) { as_simde(*state, &simde_memory_instructions); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ops__random_lanes__as_simde_in_plain_c),
        cmocka_unit_test(ops__random_lanes__as_simde_with_instructions),
    };
    return cmocka_run_group_tests_name("simde_memory " LRB_BACKEND, tests, case_setup, case_teardown);
}
