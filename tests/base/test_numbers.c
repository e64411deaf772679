/* Random numbers and the hash against values published elsewhere. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/hash.h"
#include "lrbni/base/random.h"

/* The sequence that Rosetta Code gives for SplitMix64 from the seed 1234567. */
static void random__published_seed__published_numbers(void **state)
{
    (void)state;
    const uint64_t expected[] = {UINT64_C(6457827717110365317), UINT64_C(3203168211198807973), UINT64_C(9817491932198370423),
                                 UINT64_C(4593380528125082431), UINT64_C(16408922859458223821)};
    base_random random = {.state = 1234567};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++)
        assert_true(base_random_bits(&random) == expected[i]);
}

/* The first number from the seed 0: e220a8397b1dcdaf, as in the authors' reference code. */
static void random__seed_zero__published_number(void **state)
{
    (void)state;
    base_random random = {.state = 0};
    assert_true(base_random_bits(&random) == UINT64_C(0xe220a8397b1dcdaf));
}

static void unit__many__in_range_and_spread(void **state)
{
    (void)state;
    base_random random = {.state = 5};
    unsigned tenths[10] = {0};
    for (int i = 0; i < 100000; i++) {
        double x = base_random_unit(&random);
        assert_true(x >= 0.0 && x < 1.0);
        tenths[(int)(10 * x)]++;
    }
    for (int i = 0; i < 10; i++)
        assert_in_range(tenths[i], 9500, 10500); /* 10000, five standard deviations of 95 */
}

/* The 53 highest bits, as a fraction. */
static void unit__published_seed__top_bits(void **state)
{
    (void)state;
    base_random random = {.state = 1234567};
    assert_true(base_random_unit(&random) == (double)(UINT64_C(6457827717110365317) >> 11) / 9007199254740992.0);
}

static void range__many__in_range(void **state)
{
    (void)state;
    base_random random = {.state = 6};
    double least = 1e9, most = -1e9;
    for (int i = 0; i < 10000; i++) {
        double x = base_random_range(&random, -3.0, 5.0);
        assert_true(x >= -3.0 && x < 5.0);
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    assert_true(least < -2.9 && most > 4.9);
}

/* Test vectors of FNV-1a, 64 bits (Noll). */
static void hash__published_texts__published_values(void **state)
{
    (void)state;
    assert_true(base_hash(BASE_HASH_START, "", 0) == UINT64_C(0xcbf29ce484222325));
    assert_true(base_hash(BASE_HASH_START, "a", 1) == UINT64_C(0xaf63dc4c8601ec8c));
    assert_true(base_hash(BASE_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8));
}

static void hash__in_pieces__as_in_one(void **state)
{
    (void)state;
    const char text[] = "sixteen lanes at a time";
    uint64_t whole = base_hash(BASE_HASH_START, text, sizeof text);
    for (size_t cut = 0; cut <= sizeof text; cut++)
        assert_true(base_hash(base_hash(BASE_HASH_START, text, cut), text + cut, sizeof text - cut) == whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random__published_seed__published_numbers),
        cmocka_unit_test(random__seed_zero__published_number),
        cmocka_unit_test(unit__many__in_range_and_spread),
        cmocka_unit_test(unit__published_seed__top_bits),
        cmocka_unit_test(range__many__in_range),
        cmocka_unit_test(hash__published_texts__published_values),
        cmocka_unit_test(hash__in_pieces__as_in_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
