/* Every op whose lanes change their kind or that has immediates against its reference: all forms, all masks, all immediates,
 * boundary values, numbers close to where rounding and saturation change, and random bits. */
#include <inttypes.h>

#include "tests/lrbni/case.h"

/* Which lanes of the source go to which of the result: to the same; from half a vector to 8 wider lanes; from 8 lanes to half
 * a vector, with zeros in the other half or what was there. */
typedef enum place { SAME, FROM_LOW, FROM_HIGH, TO_LOW_AND_ZEROS, TO_LOW, TO_HIGH } place;

/* What the two immediates are. */
typedef enum immediates { NONE, FIXED, MODE, MANTISSA, U10_FIELD, F11_FIELD, TABLE } immediates;

/* One row of ops.def: the op in the forms that the case asks for, and its reference. */
typedef struct row {
    const char *id;
    lrb_op_id op;
    bool wide_result, wide_source, float_source;
    void (*run)(lrb_ctx *c, const vector_case *v, const uint32_t n[2], uint32_t out[16]);
    uint64_t (*ref)(uint64_t d, uint64_t a, uint64_t b, const uint32_t n[2]);
    lrb_ctx *c;
    place where;
    immediates kind;
    uint32_t n[2];
} row;

/* Half a vector is read from memory by a form of its own. */
static __attribute__((noinline)) lrb_s3f half_s3_ps(const vector_case *v)
{
    return v->form == S3_FULL ? lrb_half_ps(case_memory(v)) : case_s3_ps(v);
}

static __attribute__((noinline)) lrb_s3i half_s3_pi(const vector_case *v)
{
    return v->form == S3_FULL ? lrb_half_pi(case_memory(v)) : case_s3_pi(v);
}

/* RUN(cvtps2pi, pi, ps, case_s3_ps, , , IMM_II, ref_cvtps2pi(b, n[0], n[1])): the plain and masked register form, and the
 * plain and masked S3 form; `old` is the destination as a source, `a` what stands before the last source */
#define RUN(id, to, from, s3, old, a, immediates, result)                                                               \
    static __attribute__((noinline)) void run_##id(lrb_ctx *c, const vector_case *v, const uint32_t n[2], uint32_t out[16]) \
    {                                                                                                                   \
        lrb_k16 k = lrb_mask(v->mask);                                                                                  \
        (void)n;                                                                                                        \
        if (v->form == S3_REGISTER)                                                                                     \
            lanes_store_##to(out, (v->masked ? lrb_mask_##id(c, case_##to(v->d), k, a case_##from(v->b) immediates)     \
                                             : lrb_##id(c, old a case_##from(v->b) immediates)).lanes);                 \
        else                                                                                                            \
            lanes_store_##to(out, (v->masked ? lrb_mask_##id##_s3(c, case_##to(v->d), k, a s3(v) immediates)            \
                                             : lrb_##id##_s3(c, old a s3(v) immediates)).lanes);                        \
    }                                                                                                                   \
    static uint64_t lane_##id(uint64_t d, uint64_t a64, uint64_t b64, const uint32_t n[2])                              \
    {                                                                                                                   \
        (void)d, (void)a64, (void)n;                                                                                    \
        return result;                                                                                                  \
    }
#define NOTHING
#define OLD(to) case_##to(v->d),
#define FIRST(to) case_##to(v->a),
#define IMM_II , (lrb_rounding)n[0], (lrb_adjust)n[1]
#define IMM_NS , (lrb_mantissa)n[0], (lrb_mantissa_sign)n[1]
#define IMM_R , (lrb_rounding)n[0]
#define IMM_I , n[0]
#define D32 (uint32_t)d
#define A32 (uint32_t)a64
#define B32 (uint32_t)b64
#define N0 (int)n[0]
#define N1 (int)n[1]
#define ROW_VI_ps_II(id) RUN(id, pi, ps, case_s3_ps, NOTHING, NOTHING, IMM_II, ref_##id(B32, N0, N1))
#define ROW_V_pi_II(id) RUN(id, ps, pi, case_s3_pi, NOTHING, NOTHING, IMM_II, ref_##id(B32, N0, N1))
#define ROW_V_V_II(id) RUN(id, ps, ps, case_s3_ps, NOTHING, NOTHING, IMM_II, ref_##id(B32, N0, N1))
#define ROW_VD_V_II(id) RUN(id, pd, pd, case_s3_pd, NOTHING, NOTHING, IMM_II, ref_##id(b64, N0, N1))
#define ROW_V_V_NS(id) RUN(id, ps, ps, case_s3_ps, NOTHING, NOTHING, IMM_NS, ref_##id(B32, N0, N1))
#define ROW_VD_V_NS(id) RUN(id, pd, pd, case_s3_pd, NOTHING, NOTHING, IMM_NS, ref_##id(b64, N0, N1))
#define ROW_VD_ps(id) RUN(id, pd, ps, half_s3_ps, NOTHING, NOTHING, NOTHING, ref_##id(B32))
#define ROW_VD_pi(id) RUN(id, pd, pi, half_s3_pi, NOTHING, NOTHING, NOTHING, ref_##id(B32))
#define ROW_V_pd_I(id) RUN(id, ps, pd, case_s3_pd, NOTHING, NOTHING, IMM_R, ref_##id(b64, N0))
#define ROW_VI_pd_I(id) RUN(id, pi, pd, case_s3_pd, NOTHING, NOTHING, IMM_R, ref_##id(b64, N0))
#define ROW_V_Vpd_I(id) RUN(id, ps, pd, case_s3_pd, OLD(ps), NOTHING, IMM_R, ref_##id(b64, N0))
#define ROW_VI_Vpd_I(id) RUN(id, pi, pd, case_s3_pd, OLD(pi), NOTHING, IMM_R, ref_##id(b64, N0))
#define ROW_VI_ps(id) RUN(id, pi, ps, case_s3_ps, NOTHING, NOTHING, NOTHING, ref_##id(B32))
#define ROW_V_pi(id) RUN(id, ps, pi, case_s3_pi, NOTHING, NOTHING, NOTHING, ref_##id(B32))
#define ROW_VI_Vps_I(id) RUN(id, pi, ps, case_s3_ps, OLD(pi), NOTHING, IMM_I, ref_##id(D32, B32, N0))
#define ROW_V_Vpi(id) RUN(id, ps, pi, case_s3_pi, NOTHING, FIRST(ps), NOTHING, ref_##id(A32, B32))
#define ROW_V_VV_I(id) RUN(id, ps, ps, case_s3_ps, OLD(ps), NOTHING, IMM_I, ref_##id(D32, B32, n[0]))
#define ROW_V_VVpi(id) RUN(id, ps, pi, case_s3_pi, OLD(ps), FIRST(ps), NOTHING, ref_##id(D32, A32, B32))
#define ROW_VD_VVpq(id) RUN(id, pd, pq, case_s3_pq, OLD(pd), FIRST(pd), NOTHING, ref_##id(d, a64, b64))
#include "tests/lrbni/rows.h"
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* run_cvtps2pi, lane_cvtps2pi */
#include "lrbni/ops.def"

/* The 32-bit words of the result that the op writes. */
static uint32_t words_written(const row *r, const vector_case *v)
{
    uint32_t words = 0;
    for (int lane = 0; lane < 8; lane++)
        words |= (uint32_t)case_live(v, lane) << lane;
    if (r->where == TO_LOW)
        return words;
    if (r->where == TO_HIGH)
        return words << 8;
    if (r->where == TO_LOW_AND_ZEROS)
        return words | 0xff00;
    for (int i = 0; i < 16; i++)
        words = (words & ~(1u << i)) | (uint32_t)case_live(v, r->wide_result ? i / 2 : i) << i;
    return words;
}

/* What a lane of the result must be. */
static uint64_t expected_lane(const row *r, const vector_case *v, int lane)
{
    uint64_t old = case_get(v->d, r->wide_result, lane);
    int from = r->where == FROM_HIGH ? lane + 8 : r->where == TO_HIGH ? lane - 8 : lane;
    int last = r->where == TO_LOW || r->where == TO_LOW_AND_ZEROS ? 8 : 16;
    if (from < 0 || lane >= last)
        return r->where == TO_LOW_AND_ZEROS ? 0 : old;
    if (!case_live(v, r->where == FROM_HIGH ? lane : from))
        return old;
    uint64_t a = r->where == SAME ? case_get(v->a, v->wide, lane) : 0;
    return r->ref(old, a, case_b(v, from), r->n);
}

static void check(void *user, const vector_case *v)
{
    const row *r = user;
    uint32_t out[16];
    if (r->where == FROM_HIGH && v->form >= S3_FULL)
        return; /* the high half is a register's */
    lrb_ctx_begin(r->c);
    r->run(r->c, v, r->n, out);
    for (int i = 0; i < case_lanes(r->wide_result); i++) {
        uint64_t got = case_get(out, r->wide_result, i), expected = expected_lane(r, v, i);
        if (got != expected)
            fail_msg("%s(%u, %u) lane %d, mask %04x%s, form %d: d %08" PRIx64 " b %08" PRIx64 ": got %08" PRIx64
                     ", expected %08" PRIx64, r->id, r->n[0], r->n[1], i, v->mask, v->masked ? "" : " (unused)", v->form,
                     case_get(v->d, r->wide_result, i), case_get(v->b, v->wide, i % case_lanes(v->wide)), got, expected);
    }
    unsigned bits = r->where == FROM_LOW && v->form == S3_FULL ? LRB_FORM_MEMORY | LRB_FORM_32_BYTES : case_form_bits(v);
    case_check_words(r->c, r->op, v, bits, words_written(r, v));
}

static const uint32_t adjusts[] = {0, 4, 5, 8, 16, 24, 31, 32};

/* How many immediates of each kind are tried in turn, and which the number says. */
static int immediates_of(immediates kind)
{
    static const int counts[] = {1, 4 * 8, 4, 4 * 3, 4, 3, 64};
    return counts[kind];
}

static void set_immediates(row *r, int number, base_random *random)
{
    uint32_t u = (uint32_t)number;
    r->n[0] = r->kind == TABLE ? (uint32_t)base_random_bits(random) & 0x1fffff : r->kind == MANTISSA ? u / 3 : u % 4;
    r->n[1] = r->kind == FIXED ? adjusts[u / 4] : r->kind == MANTISSA ? u % 3 : 0;
}

static void boundary_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 60};
    for (int n = 0; n < immediates_of(r->kind); n++) {
        vector_case v = {.wide = r->wide_source};
        set_immediates(r, n, &random);
        for (int first = 0; first < BOUNDARY_BITS; first += case_lanes(v.wide)) {
            for (int i = 0; i < case_lanes(v.wide); i++) {
                case_set(v.a, v.wide, i, boundary_lane(v.wide, (first + 7 * n + i) % BOUNDARY_BITS));
                case_set(v.b, v.wide, i, boundary_lane(v.wide, (first + i) % BOUNDARY_BITS));
            }
            for (int i = 0; i < 16; i++)
                v.d[i] = 0x7fa5c300u + (uint32_t)i;
            case_every_form(&v, &random, check, r);
        }
    }
}

/* A number close to where something changes: whole and halves, the ends of the integers, all with the adjust taken off. */
static double close_call(int adjust, base_random *random)
{
    uint64_t bits = base_random_bits(random);
    double scale = lrb_power_of_two(-adjust), sign = bits & 1 ? -1 : 1;
    switch (bits >> 61) {
    case 0:
    case 1:
        return sign * scale * (double)(bits >> 8 & 0xff) / 2;
    case 2:
        return sign * scale * ((double)(bits >> 8 & 0x3fffff) + (double)(bits >> 40 & 3) / 4);
    case 3:
        return sign * scale * (0x1p31 + (double)((int)(bits >> 8 & 15) - 8) * 0x1p-1);
    case 4:
        return sign * scale * (0x1p32 + (double)((int)(bits >> 8 & 15) - 8) * 0x1p-1);
    case 5:
        return sign * scale * 0x1p31 * (1 + (double)((int)(bits >> 8 & 7) - 4) * 0x1p-24);
    case 6:
        return (double)(bits >> 8 & 0xffffff) * 0x1p-24;
    default:
        return sign * scale * (double)(bits >> 8 & 0xffffffffff) * 0x1p-8;
    }
}

static uint64_t source_lane(const row *r, base_random *random)
{
    uint64_t bits = base_random_bits(random);
    if (bits & 1)
        return random_lane(r->wide_source, random);
    if (!r->float_source) /* an integer that ties as a float, or fixed point of 24 bits */
        return (uint32_t)(bits >> 20) >> (bits >> 8 & 31);
    double x = close_call(r->kind == FIXED ? (int)r->n[1] : 0, random);
    return r->wide_source ? lrb_double_bits(x) : lrb_float_bits((float)x);
}

static void random_values(void **state)
{
    row *r = *state;
    base_random random = {.state = 61};
    for (int n = 0; n < 20000; n++) {
        vector_case v = {.wide = r->wide_source, .form = (s3_form)(base_random_bits(&random) % S3_FORMS)};
        set_immediates(r, n % immediates_of(r->kind), &random);
        for (int i = 0; i < case_lanes(v.wide); i++) {
            case_set(v.a, v.wide, i, random_lane(v.wide, &random));
            case_set(v.b, v.wide, i, source_lane(r, &random));
        }
        for (int i = 0; i < 16; i++)
            v.d[i] = random_bits(&random);
        v.masked = base_random_bits(&random) & 1;
        v.mask = mask_number((int)(base_random_bits(&random) % MASKS), &random);
        v.word = (int)(base_random_bits(&random) % (unsigned)case_lanes(v.wide));
        check(r, &v);
    }
}

/* The rows that are served here. */
#undef RUN
#define RUN(id, to, from, s3, old, a, immediates, result) \
    {#id, LRB_OP_##id, WIDE_##to, WIDE_##from, FLOAT_##from, run_##id, lane_##id, NULL, SAME, NONE, {0, 0}},
#define WIDE_ps false
#define WIDE_pi false
#define WIDE_pd true
#define WIDE_pq true
#define FLOAT_ps true
#define FLOAT_pi false
#define FLOAT_pd true
#define FLOAT_pq false
static row rows[] = {
#define OP(id, mnemonic, shape, class, mask, round, chips, source, formula) ROW_##shape(id) /* {"cvtps2pi", LRB_OP_cvtps2pi, ...}, */
#include "lrbni/ops.def"
};
enum { ROWS = sizeof rows / sizeof rows[0] };

/* Where the lanes go follows from their widths and the op's name, the immediates from the end of its shape's. */
static void complete(row *r, lrb_ctx *c)
{
    const char *shape = lrb_shape_table[lrb_op_table[r->op].shape].name, *end = strrchr(shape, '_');
    bool high = strncmp(r->id, "cvthi", 5) == 0, low = strncmp(r->id, "cvtlo", 5) == 0;
    r->c = c;
    if (r->wide_result && !r->wide_source)
        r->where = high ? FROM_HIGH : FROM_LOW;
    else if (!r->wide_result && r->wide_source)
        r->where = high ? TO_HIGH : low ? TO_LOW : TO_LOW_AND_ZEROS;
    if (strcmp(end, "_II") == 0)
        r->kind = FIXED;
    else if (strcmp(end, "_NS") == 0)
        r->kind = MANTISSA;
    else if (strcmp(end, "_I") == 0)
        r->kind = strstr(shape, "pd_I")           ? MODE
                  : r->op == LRB_OP_fixup_ps       ? TABLE
                  : r->op == LRB_OP_cvtinsps2u10   ? U10_FIELD
                                                   : F11_FIELD;
}

int main(void)
{
    static char names[2 * ROWS][64];
    struct CMUnitTest tests[2 * ROWS];
    void *c = NULL;
    if (case_setup(&c) != 0)
        return 1;
    for (int i = 0; i < ROWS; i++) {
        complete(&rows[i], c);
        snprintf(names[2 * i], sizeof names[0], "%s__boundary_values__as_oracle", rows[i].id);
        snprintf(names[2 * i + 1], sizeof names[0], "%s__random_values__as_oracle", rows[i].id);
        tests[2 * i] = (struct CMUnitTest){names[2 * i], boundary_values, NULL, NULL, &rows[i]};
        tests[2 * i + 1] = (struct CMUnitTest){names[2 * i + 1], random_values, NULL, NULL, &rows[i]};
    }
    int failed = _cmocka_run_group_tests("convert " LRB_BACKEND, tests, 2 * ROWS, NULL, NULL);
    case_teardown(&c);
    return failed;
}
