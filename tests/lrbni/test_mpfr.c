/* Everything that rounds against MPFR: all triples of the boundary list, and random ones. NaN results are compared as NaNs;
 * their bits are the matter of op/vector. */
#include <mpfr.h>

#include "tests/lrbni/case.h"

enum { RANDOM_VECTORS = 20000 };

/* MPFR set up as single precision: 24 bits, the exponents of floats, subnormals. */
typedef struct single {
    mpfr_t a, b, c, r;
} single;

static void single_init(single *s)
{
    mpfr_set_emin(-148); /* of the smallest subnormal, as MPFR counts: 0.1 * 2^-148 in binary */
    mpfr_set_emax(128);
    mpfr_inits2(24, s->a, s->b, s->c, s->r, (mpfr_ptr)0);
}

static void single_clear(single *s)
{
    mpfr_clears(s->a, s->b, s->c, s->r, (mpfr_ptr)0);
    mpfr_free_cache();
}

static void set(mpfr_t x, uint32_t bits)
{
    mpfr_set_flt(x, lrb_bits_float(bits), MPFR_RNDN);
}

static uint32_t rounded(single *s, int ternary)
{
    ternary = mpfr_check_range(s->r, ternary, MPFR_RNDN);
    mpfr_subnormalize(s->r, ternary, MPFR_RNDN);
    return lrb_float_bits(mpfr_get_flt(s->r, MPFR_RNDN));
}

/* x * y + z, x * y - z or z - x * y. */
typedef enum combination { PLUS, MINUS, REVERSED } combination;

static uint32_t fused(single *s, uint32_t x, uint32_t y, uint32_t z, combination how)
{
    set(s->a, how == REVERSED ? x ^ 0x80000000 : x);
    set(s->b, y);
    set(s->c, z);
    return rounded(s, how == MINUS ? mpfr_fms(s->r, s->a, s->b, s->c, MPFR_RNDN) : mpfr_fma(s->r, s->a, s->b, s->c, MPFR_RNDN));
}

static void expect(const char *id, uint32_t d, uint32_t a, uint32_t b, uint32_t got, uint32_t mpfr)
{
    if (got != mpfr && !(ref_is_nan(got) && ref_is_nan(mpfr)))
        fail_msg("%s: d %08x a %08x b %08x: got %08x, MPFR gives %08x", id, d, a, b, got, mpfr);
}

static void multiply_adds(single *s, lrb_ctx *c, const uint32_t d[16], const uint32_t a[16], const uint32_t b[16])
{
    lrb_v16f vd = case_ps(d), va = case_ps(a), vb = case_ps(b);
    uint32_t out[5][16];
    lanes_store_ps(out[0], lrb_madd132_ps(c, vd, va, vb).lanes);
    lanes_store_ps(out[1], lrb_madd213_ps(c, vd, va, vb).lanes);
    lanes_store_ps(out[2], lrb_madd231_ps(c, vd, va, vb).lanes);
    lanes_store_ps(out[3], lrb_msub231_ps(c, vd, va, vb).lanes);
    lanes_store_ps(out[4], lrb_msubr231_ps(c, vd, va, vb).lanes);
    for (int i = 0; i < 16; i++) {
        expect("madd132_ps", d[i], a[i], b[i], out[0][i], fused(s, d[i], b[i], a[i], PLUS));
        expect("madd213_ps", d[i], a[i], b[i], out[1][i], fused(s, a[i], d[i], b[i], PLUS));
        expect("madd231_ps", d[i], a[i], b[i], out[2][i], fused(s, a[i], b[i], d[i], PLUS));
        expect("msub231_ps", d[i], a[i], b[i], out[3][i], fused(s, a[i], b[i], d[i], MINUS));
        expect("msubr231_ps", d[i], a[i], b[i], out[4][i], fused(s, a[i], b[i], d[i], REVERSED));
    }
}

static void multiply_add__boundary_triples__as_mpfr(void **state)
{
    enum { ALL = TRIPLE_BITS * TRIPLE_BITS * TRIPLE_BITS };
    single s;
    single_init(&s);
    for (int first = 0; first < ALL; first += 16) {
        uint32_t d[16], a[16], b[16];
        for (int i = 0; i < 16; i++) {
            int triple = (first + i) % ALL;
            d[i] = triple_bits[triple % TRIPLE_BITS];
            a[i] = triple_bits[triple / TRIPLE_BITS % TRIPLE_BITS];
            b[i] = triple_bits[triple / (TRIPLE_BITS * TRIPLE_BITS)];
        }
        multiply_adds(&s, *state, d, a, b);
    }
    single_clear(&s);
}

/* A third of the addends lies close to the product, where a second rounding or a lost bit would show. */
static void multiply_add__random_triples__as_mpfr(void **state)
{
    base_random random = {.state = 30};
    single s;
    single_init(&s);
    for (int n = 0; n < RANDOM_VECTORS; n++) {
        uint32_t d[16], a[16], b[16];
        for (int i = 0; i < 16; i++) {
            a[i] = random_bits(&random), b[i] = random_bits(&random), d[i] = random_bits(&random);
            if (n % 3 == 0)
                d[i] = (ref_mul_ps(a[i], b[i]) ^ 0x80000000u) + (d[i] & 3u);
        }
        multiply_adds(&s, *state, d, a, b);
    }
    single_clear(&s);
}

static void sums_and_products__random_pairs__as_mpfr(void **state)
{
    base_random random = {.state = 31};
    single s;
    single_init(&s);
    for (int n = 0; n < RANDOM_VECTORS; n++) {
        uint32_t a[16], b[16], sum[16], difference[16], product[16];
        for (int i = 0; i < 16; i++)
            a[i] = random_bits(&random), b[i] = random_bits(&random);
        lanes_store_ps(sum, lrb_add_ps(*state, case_ps(a), case_ps(b)).lanes);
        lanes_store_ps(difference, lrb_sub_ps(*state, case_ps(a), case_ps(b)).lanes);
        lanes_store_ps(product, lrb_mul_ps(*state, case_ps(a), case_ps(b)).lanes);
        for (int i = 0; i < 16; i++) {
            set(s.a, a[i]);
            set(s.b, b[i]);
            expect("add_ps", 0, a[i], b[i], sum[i], rounded(&s, mpfr_add(s.r, s.a, s.b, MPFR_RNDN)));
            expect("sub_ps", 0, a[i], b[i], difference[i], rounded(&s, mpfr_sub(s.r, s.a, s.b, MPFR_RNDN)));
            expect("mul_ps", 0, a[i], b[i], product[i], rounded(&s, mpfr_mul(s.r, s.a, s.b, MPFR_RNDN)));
        }
    }
    single_clear(&s);
}

static void rcpres__random_bits__mpfr_quotient_cut(void **state)
{
    base_random random = {.state = 32};
    single s;
    single_init(&s);
    for (int n = 0; n < RANDOM_VECTORS; n++) {
        uint32_t b[16], out[16];
        for (int i = 0; i < 16; i++)
            b[i] = n < 64 ? boundary_bits[(16 * n + i) % BOUNDARY_BITS] : random_bits(&random);
        lanes_store_ps(out, lrb_rcpres_ps(*state, case_ps(b)).lanes);
        for (int i = 0; i < 16; i++) {
            set(s.b, b[i]);
            /* the sign of a zero divisor reaches the quotient */
            expect("rcpres_ps", 0, 0, b[i], out[i], rounded(&s, mpfr_ui_div(s.r, 1, s.b, MPFR_RNDN)) & 0xfffff000u);
        }
    }
    single_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiply_add__boundary_triples__as_mpfr),
        cmocka_unit_test(multiply_add__random_triples__as_mpfr),
        cmocka_unit_test(sums_and_products__random_pairs__as_mpfr),
        cmocka_unit_test(rcpres__random_bits__mpfr_quotient_cut),
    };
    return cmocka_run_group_tests_name("mpfr " LRB_BACKEND, tests, case_setup, case_teardown);
}
