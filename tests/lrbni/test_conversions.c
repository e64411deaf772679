/* Conversions on the way to and from memory, one lane at a time: every element of every format, every float around each boundary, the sRGB
 * table against MPFR, and the list itself. The loops of the back ends are tested by test_load_store.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "lrbni/conversions.h"
#include "tests/lrbni/operands.h"
#include "tests/lrbni/oracle.h"

#if defined(WITH_MPFR)
#include <mpfr.h>
#endif

typedef uint32_t lane_fn(uint32_t bits);

static lane_fn *const ups_ps[] = {
#define UP_PS(id, ...) lrb_up_ps_##id,
#include "lrbni/conversions.def"
};
static lane_fn *const ups_pi[] = {
#define UP_PI(id, ...) lrb_up_pi_##id,
#include "lrbni/conversions.def"
};
static lane_fn *const downs_ps[] = {
#define DOWN_PS(id, ...) lrb_down_ps_##id,
#include "lrbni/conversions.def"
};
static lane_fn *const downs_pi[] = {
#define DOWN_PI(id, ...) lrb_down_pi_##id,
#include "lrbni/conversions.def"
};

static void check_up(int up, uint32_t m)
{
    const unsigned char element[4] = {(unsigned char)m, (unsigned char)(m >> 8), (unsigned char)(m >> 16), (unsigned char)(m >> 24)};
    const bool integer = up >= LRB_UP_PS_COUNT;
    const int number = integer ? up - LRB_UP_PS_COUNT : up;
    const uint32_t got = integer ? ups_pi[number](m) : ups_ps[number](m);
    const uint32_t expected = integer ? ref_load_up_pi(number, element) : ref_load_up_ps(number, element);
    if (got != expected)
        fail_msg("up %s %s of %08x: got %08x, expected %08x", lrb_ups[up].lanes, lrb_ups[up].id, m, got, expected);
}

/* All elements of 8 and 16 bits; of words all values of each field of 10 and 11 bits, and random ones. */
static void up__every_element__as_references(void **state)
{
    (void)state;
    base_random random = {.state = 65};
    for (int up = 0; up < LRB_UP_PS_COUNT + LRB_UP_PI_COUNT; up++) {
        for (uint32_t m = 0; m < 65536 && (m < 256 || lrb_ups[up].bytes > 1); m++)
            check_up(up, m);
        for (uint32_t m = 0; m < 2048 && lrb_ups[up].bytes == 4; m++)
            for (int shift = 0; shift < 32; shift++)
                check_up(up, m << shift);
        for (int n = 0; n < 100000 && lrb_ups[up].bytes == 4; n++)
            check_up(up, (uint32_t)base_random_bits(&random));
    }
}

static void check_down(int down, uint32_t a)
{
    const bool integer = down >= LRB_DOWN_PS_COUNT;
    const int number = integer ? down - LRB_DOWN_PS_COUNT : down;
    unsigned char element[4] = {0};
    uint32_t got = integer ? downs_pi[number](a) : downs_ps[number](a), expected;
    if (integer)
        ref_store_down_pi(number, a, element);
    else
        ref_store_down_ps(number, a, element);
    expected = element[0] + 256u * element[1] + 65536u * element[2] + 16777216u * element[3];
    if (got != expected)
        fail_msg("down %s %s of %08x: got %x, expected %x", lrb_downs[down].lanes, lrb_downs[down].id, a, got, expected);
}

/* In the other rounding modes of the machine. */
static void check_modes(lrb_down_ps down, uint32_t a)
{
    const uint32_t ones = lrb_downs[down].bytes == 1 ? 0xff : 0xffff;
    for (int mode = LRB_RN; mode <= LRB_RZ; mode++) {
        unsigned char element[4] = {0};
        ref_down_in_state((ref_control){.rounding = mode}, (int)down, a, element);
        const uint32_t got = lrb_down_ps_in_mode(down, a, (lrb_rounding)mode) & ones, expected = element[0] + 256u * element[1];
        if (got != expected)
            fail_msg("down %s of %08x in mode %d: got %x, expected %x", lrb_downs[down].id, a, mode, got, expected);
    }
}

static bool has_modes(int down)
{
    return down == LRB_DOWN_PS_float16 || down == LRB_DOWN_PS_uint8 || down == LRB_DOWN_PS_sint8 || down == LRB_DOWN_PS_uint16 ||
           down == LRB_DOWN_PS_sint16;
}

static uint32_t bits_of(double value)
{
    return lrb_float_bits((float)value);
}

/* A float, its neighbours, and their negatives. */
static void check_around(int down, double value)
{
    const uint32_t bits = bits_of(value);
    for (uint32_t near = bits > 2 ? bits - 2 : 0; near <= bits + 2; near++) {
        check_down(down, near);
        check_down(down, near ^ 0x80000000u);
        if (has_modes(down))
            check_modes((lrb_down_ps)down, near), check_modes((lrb_down_ps)down, near ^ 0x80000000u);
    }
}

/* Floats around every element's value and around every point halfway between two, so around every place where a result changes. */
static void down_ps__around_every_boundary__as_references(void **state)
{
    (void)state;
    for (uint32_t half = 0; half < 0x7c00; half++) {
        const uint32_t below = lrb_up_ps_float16(half), above = half == 0x7bff ? 0x47800000u : lrb_up_ps_float16(half + 1);
        const double low = (double)lrb_bits_float(below), high = (double)lrb_bits_float(above);
        for (int down = LRB_DOWN_PS_float16; down <= LRB_DOWN_PS_float16_rz; down++) {
            check_around(down, low);
            check_around(down, (low + high) / 2);
        }
    }
    static const struct { lrb_down_ps down; double scale; } formats[] = {
        {LRB_DOWN_PS_uint8, 1}, {LRB_DOWN_PS_sint8, 1}, {LRB_DOWN_PS_unorm8, 255}, {LRB_DOWN_PS_snorm8, 127},
        {LRB_DOWN_PS_uint16, 1}, {LRB_DOWN_PS_sint16, 1}, {LRB_DOWN_PS_unorm16, 65535}, {LRB_DOWN_PS_snorm16, 32767}};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        for (int twice = 0; twice <= 2 * 65537; twice++)
            check_around((int)formats[i].down, twice / 2.0 / formats[i].scale);
}

static void down__boundaries_and_random__as_references(void **state)
{
    (void)state;
    base_random random = {.state = 66};
    for (int down = 0; down < LRB_DOWN_PS_COUNT + LRB_DOWN_PI_COUNT; down++) {
        for (int i = 0; i < BOUNDARY_BITS; i++) {
            check_down(down, boundary_bits[i]);
            if (has_modes(down))
                check_modes((lrb_down_ps)down, boundary_bits[i]);
        }
        for (uint32_t a = 0; a < 70000; a++)
            check_down(down, a), check_down(down, 0u - a);
        for (int n = 0; n < 300000; n++)
            check_down(down, random_bits(&random));
    }
}

/* A half survives the way up and down, and so does every element of an exact format that has both. */
static void up_and_down__every_element__the_same(void **state)
{
    (void)state;
    for (uint32_t m = 0; m < 65536; m++) {
        const uint32_t quiet = (m & 0x7fff) > 0x7c00 ? 0x200 : 0;
        assert_int_equal(lrb_down_ps_float16(lrb_up_ps_float16(m)), m | quiet);
        assert_int_equal(lrb_down_ps_float16_rz(lrb_up_ps_float16(m)), m | quiet);
        assert_int_equal(lrb_down_ps_unorm16(lrb_up_ps_unorm16(m)), m);
        assert_int_equal(lrb_down_ps_snorm16(lrb_up_ps_snorm16(m)), m == 0x8000 ? 0x8001 : m);
        assert_int_equal(lrb_down_ps_uint16(lrb_up_ps_uint16(m)), m);
        assert_int_equal(lrb_down_ps_sint16(lrb_up_ps_sint16(m)), m);
        assert_int_equal(lrb_down_ps_unorm8(lrb_up_ps_unorm8(m & 0xff)), m & 0xff);
    }
}

/* The table is what the formula gives to 400 bits, rounded once. */
static void srgb8__every_value__correctly_rounded(void **state)
{
    (void)state;
#if defined(WITH_MPFR)
    mpfr_t x, y;
    mpfr_inits2(400, x, y, (mpfr_ptr)0);
    for (unsigned m = 0; m < 256; m++) {
        mpfr_set_ui(x, m, MPFR_RNDN);
        mpfr_div_ui(x, x, 255, MPFR_RNDN);
        if (100000 * m <= 4045 * 255) { /* x <= 0.04045 */
            mpfr_mul_ui(x, x, 100, MPFR_RNDN);
            mpfr_div_ui(x, x, 1292, MPFR_RNDN);
        } else { /* ((x + 0.055) / 1.055)^(12/5) */
            mpfr_mul_ui(x, x, 1000, MPFR_RNDN);
            mpfr_add_ui(x, x, 55, MPFR_RNDN);
            mpfr_div_ui(x, x, 1055, MPFR_RNDN);
            mpfr_pow_ui(y, x, 12, MPFR_RNDN);
            mpfr_rootn_ui(x, y, 5, MPFR_RNDN);
        }
        assert_int_equal(lrb_srgb8_bits[m], lrb_float_bits(mpfr_get_flt(x, MPFR_RNDN)));
    }
    mpfr_clears(x, y, (mpfr_ptr)0);
#else
    printf("# skipped: built without MPFR\n");
#endif
}

static void check_row(const lrb_conversion *row)
{
    if (!row->source[0] || !row->formula[0] || row->chips == LRB_CHIPS_NONE ||
        (row->bytes != 1 && row->bytes != 2 && row->bytes != 4 && row->bytes != 8))
        fail_msg("conversion %s %s: %u bytes, source '%s', formula '%s'", row->lanes, row->id, row->bytes, row->source, row->formula);
}

static void list__every_row__complete(void **state)
{
    (void)state;
    const size_t ups = sizeof lrb_ups / sizeof lrb_ups[0], downs = sizeof lrb_downs / sizeof lrb_downs[0];
    for (size_t i = 0; i < ups; i++)
        check_row(&lrb_ups[i]);
    for (size_t i = 0; i < downs; i++)
        check_row(&lrb_downs[i]);
    for (int i = 0; i < LRB_UP_PS_COUNT; i++) {
        assert_int_equal(lrb_up_ps_bytes((lrb_up_ps)i), lrb_ups[i].bytes);
        assert_int_equal(lrb_up_ps_in_s3((lrb_up_ps)i), lrb_ups[i].s3 != LRB_CHIPS_NONE);
    }
    assert_string_equal(lrb_ups[LRB_UP_PS_COUNT + LRB_UP_PI_sint16].id, "sint16");
    assert_string_equal(lrb_downs[LRB_DOWN_PS_COUNT + LRB_DOWN_PI_uint8].id, "uint8");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(up__every_element__as_references),
        cmocka_unit_test(down_ps__around_every_boundary__as_references),
        cmocka_unit_test(down__boundaries_and_random__as_references),
        cmocka_unit_test(up_and_down__every_element__the_same),
        cmocka_unit_test(srgb8__every_value__correctly_rounded),
        cmocka_unit_test(list__every_row__complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
