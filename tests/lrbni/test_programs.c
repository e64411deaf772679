/* Random programs of ops leave the same registers, memory and events with every back end that this CPU runs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/hash.h"
#include "tests/lrbni/operands.h"
#include "tests/lrbni/program.h"

enum { PROGRAMS = 2000, STEPS = 60, BYTES = PROGRAM_STEP * STEPS };

static program_state random_state(base_random *random)
{
    program_state s;
    memset(&s, 0, sizeof s);
    for (int i = 0; i < PROGRAM_REGISTERS; i++) {
        for (int lane = 0; lane < 16; lane++)
            s.v[i][lane] = random_bits(random);
        s.k[i] = mask_number((int)(base_random_bits(random) % MASKS), random);
        s.r[i] = base_random_bits(random) >> (base_random_bits(random) & 63);
    }
    for (size_t i = 0; i + 4 <= sizeof s.memory; i += 4) {
        uint32_t word = random_bits(random);
        memcpy(s.memory + i, &word, sizeof word);
    }
    return s;
}

static void hash_events(void *user, const lrb_event *events, uint32_t count)
{
    uint64_t *hash = user;
    *hash = base_hash(*hash, events, count * sizeof *events);
}

/* Run the program; returns the hash of its events. */
static uint64_t events_of(program_fn *run, program_state *s, const uint8_t *code, size_t size)
{
    uint64_t hash = BASE_HASH_START;
    lrb_ctx *c = NULL;
    assert_int_equal(lrb_ctx_create(hash_events, &hash, &c, NULL), BASE_OK);
    run(c, s, code, size);
    lrb_ctx_end(c);
    lrb_ctx_destroy(&c);
    return hash;
}

/* SAME(v): the member is the same in both states */
#define SAME(member)                                                          \
    if (memcmp(&ours.member, &theirs.member, sizeof ours.member) != 0)        \
        fail_msg("program %d: " #member " differs from the portable back end", n);

static void agree(program_fn *run)
{
    base_random random = {.state = 50};
    for (int n = 0; n < PROGRAMS; n++) {
        program_state ours = random_state(&random), theirs = ours, start = ours;
        uint8_t code[BYTES];
        for (int i = 0; i < BYTES; i++)
            code[i] = (uint8_t)base_random_bits(&random);
        assert_true(events_of(program_run_portable, &ours, code, sizeof code) == events_of(run, &theirs, code, sizeof code));
        SAME(v)
        SAME(k)
        SAME(r)
        SAME(flags)
        SAME(p)
        SAME(memory)
        assert_memory_not_equal(&ours, &start, sizeof ours);
    }
}

static void portable__run_twice__same_state(void **state)
{
    (void)state;
    agree(program_run_portable);
}

#ifdef PROGRAM_AVX2
static void avx2__random_programs__as_portable(void **state)
{
    (void)state;
    agree(program_run_avx2);
}
#endif

#ifdef PROGRAM_AVX512
static void avx512__random_programs__as_portable(void **state)
{
    (void)state;
    agree(program_run_avx512);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(portable__run_twice__same_state),
#ifdef PROGRAM_AVX2
        cmocka_unit_test(avx2__random_programs__as_portable),
#endif
#ifdef PROGRAM_AVX512
        cmocka_unit_test(avx512__random_programs__as_portable),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
