/* libFuzzer target: any bytes as a start state and a program of ops, which every back end of this CPU must run to the same
 * registers, memory and events. */
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "tests/lrbni/program.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
    if (lrb_ctx_create(hash_events, &hash, &c, NULL) != BASE_OK)
        exit(1); /* no memory */
    run(c, s, code, size);
    lrb_ctx_end(c);
    lrb_ctx_destroy(&c);
    return hash;
}

static void must_agree(const program_state *start, const program_state *expected, uint64_t events, program_fn *run,
                       const uint8_t *code, size_t size)
{
    program_state s = *start;
    if (events_of(run, &s, code, size) != events || memcmp(s.v, expected->v, sizeof s.v) || memcmp(s.k, expected->k, sizeof s.k) || memcmp(s.r, expected->r, sizeof s.r) ||
        memcmp(s.memory, expected->memory, sizeof s.memory) || s.flags != expected->flags || s.p != expected->p)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    program_state start, expected;
    memset(&start, 0, sizeof start);
    size_t half = size / 2, registers = half < sizeof start.v ? half : sizeof start.v;
    memcpy(start.v, data, registers); /* the first half of the input: vectors, then memory */
    size_t rest = half - registers < sizeof start.memory ? half - registers : sizeof start.memory;
    memcpy(start.memory, data + registers, rest);
    for (int i = 0; i < PROGRAM_REGISTERS; i++) {
        start.k[i] = start.v[i][3];
        start.r[i] = start.v[i][5] * UINT64_C(0x100000001) >> (i * 8);
    }
    expected = start;
    uint64_t events = events_of(program_run_portable, &expected, data + half, size - half);
#ifdef PROGRAM_AVX2
    must_agree(&start, &expected, events, program_run_avx2, data + half, size - half);
#endif
#ifdef PROGRAM_AVX512
    must_agree(&start, &expected, events, program_run_avx512, data + half, size - half);
#endif
    must_agree(&start, &expected, events, program_run_portable, data + half, size - half);
    return 0;
}
