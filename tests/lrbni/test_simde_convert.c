/* Conversions and the like against SIMDe (simde_convert.def): ten million and more random lanes for each, with SIMDe in plain C
 * and with this CPU's instructions. Where both results of a conversion of floats are NaN they count as equal: SIMDe's plain C
 * leaves the payload to the compiler. So do zeros of either sign where SIMDe rounds in plain C: clang makes code of it that loses
 * the sign, which golden case 27 and the instructions keep.
 */
#include "tests/lrbni/case.h"
#include "tests/lrbni/simde_convert.h"

/* SIMDE_LANES, random lanes for each op, is given by the build: fewer with sanitizers. */

typedef enum lanes { FLOATS, INTEGERS, DOUBLES } lanes;
typedef enum except { NONE, OVERFLOW, INSTRUCTIONS, TWICE } except;

typedef struct row {
    const char *name;
    lanes from;
    except but;
    bool doubles; /* the result has 8 lanes */
    void (*run)(lrb_ctx *c, const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], uint32_t out[16]);
} row;

#define PUT_ps(v) lanes_store_ps(out, (v).lanes)
#define PUT_pi(v) lanes_store_pi(out, (v).lanes)
#define PUT_pd(v) lanes_store_pd(out, (v).lanes)
#define SIMDE_CONVERT(name, source, result, except, ours, theirs)                                                                  \
    static __attribute__((noinline)) void run_##name(lrb_ctx *c, const uint32_t d[16], const uint32_t a[16], const uint32_t b[16], \
                                                     uint32_t out[16])                                                     \
    {                                                                                                                      \
        (void)d, (void)a;                                                                                                  \
        ours;                                                                                                              \
    }
#include "tests/lrbni/simde_convert.def"

static const row rows[] = {
#define SIMDE_CONVERT(name, source, result, except, ours, theirs) \
    {#name, source, except, result == DOUBLES, run_##name}, /* {"cvtpi2ps", INTEGERS, NONE, false, run_cvtpi2ps}, */
#include "tests/lrbni/simde_convert.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

/* Floats in half the lanes near the integers, integers of all sizes. */
static void draw(lanes from, uint32_t b[16], base_random *random)
{
    for (int i = 0; i < 16; i++) {
        uint64_t bits = base_random_bits(random);
        if (from == INTEGERS)
            b[i] = bits >> 63 ? (uint32_t)bits >> (bits >> 40 & 31) : (uint32_t)((int32_t)bits >> (bits >> 40 & 31));
        else if (from == FLOATS)
            b[i] = bits >> 63 ? random_bits(random) : ((uint32_t)bits & 0x807fffff) | (uint32_t)(118 + (bits >> 40 & 63)) << 23;
        else if (i % 2 == 0)
            case_set(b, true, i / 2, bits >> 63 ? random_bits64(random)
                                                : (base_random_bits(random) & 0x800fffffffffffff) | (1014 + (bits & 63)) << 52);
    }
}

/* Whether the lane of the source has no place among the 32-bit integers, or none with room for rounding. */
static bool overflows(const row *r, const uint32_t b[16], int lane)
{
    if (r->from == DOUBLES && lane >= 8)
        return false;
    double x = r->from == DOUBLES ? lrb_bits_double(case_get(b, true, lane)) : (double)lrb_bits_float(b[lane]);
    return !(x > -0x1p31 - 0.5 && x < 0x1p31 - 0.5);
}

static bool is_nan(bool wide, uint64_t bits)
{
    return wide ? (bits & INT64_MAX) > 0x7ff0000000000000 : (bits & INT32_MAX) > 0x7f800000;
}

static bool is_zero(bool wide, uint64_t bits)
{
    return (bits & (wide ? INT64_MAX : INT32_MAX)) == 0;
}

static void compare(const row *r, const uint32_t b[16], const uint32_t got[16], const uint32_t theirs[16], bool any_zero)
{
    if (memcmp(got, theirs, 64) == 0)
        return;
    for (int i = 0; i < case_lanes(r->doubles); i++) {
        uint64_t ours = case_get(got, r->doubles, i), simde = case_get(theirs, r->doubles, i);
        if (ours == simde || (r->but == OVERFLOW ? overflows(r, b, i) : is_nan(r->doubles, ours) && is_nan(r->doubles, simde)))
            continue;
        if (any_zero && is_zero(r->doubles, ours) && is_zero(r->doubles, simde))
            continue;
        fail_msg("%s lane %d: b %08x %08x: got %llx, SIMDe gives %llx", r->name, i, b[i], b[(i + 1) % 16],
                 (unsigned long long)ours, (unsigned long long)simde);
    }
}

/* Whether SIMDe's results for that op are known to be wrong. */
static bool is_left_out(const row *r, const simde_conversions *simde)
{
    return !simde->avx512 && (r->but == INSTRUCTIONS || (r->but == TWICE && !simde->plain));
}

static void as_simde(lrb_ctx *c, const simde_conversions *simde)
{
    base_random random = {.state = 70};
    for (int n = 0; n * 8 < SIMDE_LANES; n++) {
        alignas(64) uint32_t b[3][16], a[16], d[16];
        for (int from = FLOATS; from <= DOUBLES; from++)
            draw((lanes)from, b[from], &random);
        draw(FLOATS, a, &random);
        draw(FLOATS, d, &random);
        lrb_ctx_begin(c);
        for (int i = 0; i < ROWS; i++) {
            const row *r = &rows[i];
            bool narrow = !r->doubles && r->from != DOUBLES;
            if (narrow && n % 2)
                continue; /* sixteen lanes at a time */
            if (is_left_out(r, simde))
                continue;
            uint32_t got[16], theirs[16] = {0};
            r->run(c, d, a, b[r->from], got);
            simde->functions[i](d, a, b[r->from], theirs);
            compare(r, b[r->from], got, theirs, !simde->avx512);
        }
    }
    printf("# %d conversions, %d lanes each, SIMDe in %s%s\n", ROWS, SIMDE_LANES, simde->how,
           simde->avx512 ? "" : ", without those that need AVX-512's instructions");
}

static void random_lanes__simde_in_plain_c__same(void **state)
{
    as_simde(*state, &simde_convert_plain);
}

static void random_lanes__simde_with_instructions__same(void **state)
{
    as_simde(*state, &simde_convert_instructions);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_lanes__simde_in_plain_c__same),
        cmocka_unit_test(random_lanes__simde_with_instructions__same),
    };
    return cmocka_run_group_tests_name("simde_convert " LRB_BACKEND, tests, case_setup, case_teardown);
}
