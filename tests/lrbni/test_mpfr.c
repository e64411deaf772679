/* Everything that rounds against MPFR: all triples of the boundary list, and random ones; floats and doubles, in all rounding
 * modes, with and without flush-to-zero and denormals-are-zero. NaN results are compared as NaNs; their bits are the matter of
 * op/vector. */
#include <mpfr.h>

#define LRB_CONTROL 1
#include "tests/lrbni/case.h"

enum { RANDOM_VECTORS = 20000, STATES = 16 };

/* MPFR set up as a binary format: its bits, its exponents, subnormals. */
typedef struct number {
    bool wide;
    mpfr_t x, y, z, r;
} number;

static void number_init(number *n, bool wide)
{
    n->wide = wide;
    mpfr_set_emin(wide ? -1073 : -148); /* of the smallest subnormal, as MPFR counts: 0.1 * 2^-148 in binary */
    mpfr_set_emax(wide ? 1024 : 128);
    mpfr_inits2(wide ? 53 : 24, n->x, n->y, n->z, n->r, (mpfr_ptr)0);
}

static void number_clear(number *n)
{
    mpfr_clears(n->x, n->y, n->z, n->r, (mpfr_ptr)0);
    mpfr_free_cache();
}

static void set(const number *n, mpfr_t x, uint64_t bits)
{
    mpfr_set_d(x, ref_value(n->wide, bits), MPFR_RNDN);
}

/* The format's bits of n->r, which was rounded with those bits and the exponents of the format. */
static uint64_t rounded(number *n, int ternary, mpfr_rnd_t mode)
{
    ternary = mpfr_check_range(n->r, ternary, mode);
    mpfr_subnormalize(n->r, ternary, mode);
    return ref_bits(n->wide, mpfr_get_d(n->r, mode));
}

/* What an op does: x * y + z, sums without a factor, products without an addend, each part negated or not. */
typedef struct formula {
    const char *id;
    enum { SUM, PRODUCT, FUSED } kind;
    bool negate_product, negate_addend;
} formula;

static int compute(const formula *f, number *n, mpfr_rnd_t mode)
{
    if (f->negate_product)
        mpfr_neg(n->x, n->x, MPFR_RNDN);
    if (f->negate_addend)
        mpfr_neg(n->z, n->z, MPFR_RNDN);
    return f->kind == SUM       ? mpfr_add(n->r, n->x, n->z, mode)
           : f->kind == PRODUCT ? mpfr_mul(n->r, n->x, n->y, mode)
                                : mpfr_fma(n->r, n->x, n->y, n->z, mode);
}

/* Subnormal sources become zeros of their sign. */
static void flush(const number *n, mpfr_t x)
{
    if (mpfr_regular_p(x) && mpfr_get_exp(x) <= (n->wide ? -1022 : -126))
        mpfr_set_zero(x, mpfr_signbit(x) ? -1 : 1);
}

static uint64_t by_mpfr(const formula *f, number *n, ref_control control, const uint64_t sources[3])
{
    static const mpfr_rnd_t modes[] = {MPFR_RNDN, MPFR_RNDD, MPFR_RNDU, MPFR_RNDZ};
    mpfr_rnd_t mode = modes[control.rounding];
    set(n, n->x, sources[0]), set(n, n->y, sources[1]), set(n, n->z, sources[2]);
    if (control.denormals_are_zero)
        flush(n, n->x), flush(n, n->y), flush(n, n->z);
    if (!control.flush_to_zero)
        return rounded(n, compute(f, n, mode), mode);
    mpfr_exp_t least = mpfr_get_emin(), most = mpfr_get_emax();
    mpfr_set_emin(mpfr_get_emin_min()); /* tiny is what lies below 2^-126 after rounding with an exponent of any size */
    int ternary = compute(f, n, mode);
    flush(n, n->r);
    mpfr_set_emin(least);
    mpfr_set_emax(most);
    return rounded(n, ternary, mode);
}

static void expect(const char *id, ref_control control, const number *n, uint64_t got, uint64_t mpfr)
{
    if (got != mpfr && !(ref_is_nan_lane(n->wide, got) && ref_is_nan_lane(n->wide, mpfr)))
        fail_msg("%s, rounding %d, flush %d, denormals are zero %d: x %g y %g z %g: got %llx, MPFR gives %llx", id, control.rounding,
                 control.flush_to_zero, control.denormals_are_zero, mpfr_get_d(n->x, MPFR_RNDN), mpfr_get_d(n->y, MPFR_RNDN),
                 mpfr_get_d(n->z, MPFR_RNDN), (unsigned long long)got, (unsigned long long)mpfr);
}

enum { FORMULAS = 9 };
static const formula formulas[FORMULAS] = {
    {"add", SUM, false, false},  {"sub", SUM, false, true},    {"addn", SUM, true, true},     {"mul", PRODUCT, false, false},
    {"madd", FUSED, false, false}, {"msub", FUSED, false, true}, {"msubr", FUSED, true, false}, {"maddn", FUSED, true, true},
    {"subr", SUM, true, false}, /* z - x */
};

/* COMPUTE(ps): all formulas of x, y, z by ops; the orders of the multiply-adds take turns */
#define COMPUTE(suffix, vector)                                                                                \
    static __attribute__((noinline)) void ops_##suffix(lrb_ctx *c, vector x, vector y, vector z, unsigned order, \
                                                       uint32_t out[FORMULAS][16])                             \
    {                                                                                                          \
        lanes_store_##suffix(out[0], lrb_add_##suffix(c, x, z).lanes);                                         \
        lanes_store_##suffix(out[1], lrb_sub_##suffix(c, x, z).lanes);                                         \
        lanes_store_##suffix(out[2], lrb_addn_##suffix(c, x, z).lanes);                                        \
        lanes_store_##suffix(out[3], lrb_mul_##suffix(c, x, y).lanes);                                         \
        lanes_store_##suffix(out[8], lrb_subr_##suffix(c, x, z).lanes);                                        \
        switch (order) {                                                                                       \
        case 0:                                                                                                \
            lanes_store_##suffix(out[4], lrb_madd132_##suffix(c, x, z, y).lanes);                              \
            lanes_store_##suffix(out[5], lrb_msub132_##suffix(c, x, z, y).lanes);                              \
            lanes_store_##suffix(out[6], lrb_msubr132_##suffix(c, x, z, y).lanes);                             \
            lanes_store_##suffix(out[7], lrb_maddn132_##suffix(c, x, z, y).lanes);                             \
            break;                                                                                             \
        case 1:                                                                                                \
            lanes_store_##suffix(out[4], lrb_madd213_##suffix(c, y, x, z).lanes);                              \
            lanes_store_##suffix(out[5], lrb_msub213_##suffix(c, y, x, z).lanes);                              \
            lanes_store_##suffix(out[6], lrb_msubr213_##suffix(c, y, x, z).lanes);                             \
            lanes_store_##suffix(out[7], lrb_maddn213_##suffix(c, y, x, z).lanes);                             \
            break;                                                                                             \
        default:                                                                                               \
            lanes_store_##suffix(out[4], lrb_madd231_##suffix(c, z, x, y).lanes);                              \
            lanes_store_##suffix(out[5], lrb_msub231_##suffix(c, z, x, y).lanes);                              \
            lanes_store_##suffix(out[6], lrb_msubr231_##suffix(c, z, x, y).lanes);                             \
            lanes_store_##suffix(out[7], lrb_maddn231_##suffix(c, z, x, y).lanes);                             \
            break;                                                                                             \
        }                                                                                                      \
    }
COMPUTE(ps, lrb_v16f)
COMPUTE(pd, lrb_v8d)

/* One vector of x, y, z (a, b, d of the case) in that state. */
static void check(lrb_ctx *c, number *n, const vector_case *v, unsigned order, int state)
{
    ref_control control = {.rounding = state % 4, .flush_to_zero = state / 4 % 2, .denormals_are_zero = state / 8};
    uint32_t out[FORMULAS][16];
    lrb_ctx_begin(c);
    c->control = (lrb_control){(uint8_t)control.rounding, control.flush_to_zero, control.denormals_are_zero};
    if (v->wide)
        ops_pd(c, case_pd(v->a), case_pd(v->b), case_pd(v->d), order, out);
    else
        ops_ps(c, case_ps(v->a), case_ps(v->b), case_ps(v->d), order, out);
    for (int f = 0; f < FORMULAS; f++)
        for (int i = 0; i < case_lanes(v->wide); i++) {
            const uint64_t sources[] = {case_get(v->a, v->wide, i), case_get(v->b, v->wide, i), case_get(v->d, v->wide, i)};
            expect(formulas[f].id, control, n, case_get(out[f], v->wide, i), by_mpfr(&formulas[f], n, control, sources));
        }
}

/* Every triple in the default state and in one of the others. */
static void boundary_triples(lrb_ctx *c, bool wide)
{
    enum { ALL = TRIPLE_BITS * TRIPLE_BITS * TRIPLE_BITS };
    vector_case v = {.wide = wide};
    const int lanes = case_lanes(wide);
    number n;
    number_init(&n, wide);
    for (int first = 0, count = 0; first < ALL; first += lanes, count++) {
        for (int i = 0; i < lanes; i++) {
            int triple = (first + i) % ALL;
            case_set(v.d, wide, i, triple_lane(wide, triple % TRIPLE_BITS));
            case_set(v.a, wide, i, triple_lane(wide, triple / TRIPLE_BITS % TRIPLE_BITS));
            case_set(v.b, wide, i, triple_lane(wide, triple / (TRIPLE_BITS * TRIPLE_BITS)));
        }
        for (int state = 0; state < STATES; state += state ? 1 : 1 + count % 3)
            check(c, &n, &v, (unsigned)(count + state) % 3, state);
    }
    number_clear(&n);
}

/* A third of the addends lies close to the product, where a second rounding or a lost bit would show. */
static void random_triples(lrb_ctx *c, bool wide)
{
    base_random random = {.state = 30};
    vector_case v = {.wide = wide};
    number n;
    number_init(&n, wide);
    for (int count = 0; count < RANDOM_VECTORS; count++) {
        for (int i = 0; i < case_lanes(wide); i++) {
            uint64_t a = random_lane(wide, &random), b = random_lane(wide, &random), d = random_lane(wide, &random);
            if (count % 3 == 0)
                d = (ref_product(wide, (ref_control){0}, a, b) ^ (wide ? UINT64_C(1) << 63 : UINT64_C(1) << 31)) + (d & 3);
            case_set(v.a, wide, i, a), case_set(v.b, wide, i, b), case_set(v.d, wide, i, d);
        }
        check(c, &n, &v, (unsigned)count % 3, count % 2 ? 0 : count / 2 % STATES);
    }
    number_clear(&n);
}

static void floats__boundary_triples__as_mpfr(void **state) { boundary_triples(*state, false); }
static void floats__random_triples__as_mpfr(void **state) { random_triples(*state, false); }
static void doubles__boundary_triples__as_mpfr(void **state) { boundary_triples(*state, true); }
static void doubles__random_triples__as_mpfr(void **state) { random_triples(*state, true); }

static void rcpres__random_bits__mpfr_quotient_cut(void **state)
{
    base_random random = {.state = 32};
    number s;
    number_init(&s, false);
    for (int n = 0; n < RANDOM_VECTORS; n++) {
        uint32_t b[16], out[16];
        for (int i = 0; i < 16; i++)
            b[i] = n < 64 ? boundary_bits[(16 * n + i) % BOUNDARY_BITS] : random_bits(&random);
        lanes_store_ps(out, lrb_rcpres_ps(*state, case_ps(b)).lanes);
        for (int i = 0; i < 16; i++) {
            set(&s, s.y, b[i]);
            /* the sign of a zero divisor reaches the quotient */
            uint32_t quotient = (uint32_t)rounded(&s, mpfr_ui_div(s.r, 1, s.y, MPFR_RNDN), MPFR_RNDN);
            expect("rcpres_ps", (ref_control){0}, &s, out[i], quotient & 0xfffff000u);
        }
    }
    number_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats__boundary_triples__as_mpfr),
        cmocka_unit_test(floats__random_triples__as_mpfr),
        cmocka_unit_test(doubles__boundary_triples__as_mpfr),
        cmocka_unit_test(doubles__random_triples__as_mpfr),
        cmocka_unit_test(rcpres__random_bits__mpfr_quotient_cut),
    };
    return cmocka_run_group_tests_name("mpfr " LRB_BACKEND, tests, case_setup, case_teardown);
}
