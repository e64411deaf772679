/* Points on the light: nets, sets with one point a cell, 4x4 patterns of pixels (hard case B15). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "kernels/job_shadow.h"
#include "kernels/light_samples.h"

enum { MOST_SETS = 256 };

static light_samples sets[MOST_SETS];

/* Every combination of net, assignment and number of sets. */
static void for_all(void (*check)(kernel_assignment assignment, unsigned count))
{
    for (int net = KERNEL_NET_HAMMERSLEY; net <= KERNEL_NET_LARCHER; net++)
        for (int assignment = KERNEL_ASSIGN_PERMUTED; assignment <= KERNEL_ASSIGN_BITS; assignment++)
            for (unsigned count = 16; count <= MOST_SETS; count *= 4) {
                memset(sets, 0xff, sizeof sets);
                light_samples_fill((kernel_net)net, (kernel_assignment)assignment, count, sets);
                check((kernel_assignment)assignment, count);
            }
}

/* Every elementary interval of 1/n of the square, 2^-i by 2^(i-m), holds one point. */
static void check_net(kernel_assignment assignment, unsigned count)
{
    unsigned char seen[16 * MOST_SETS];
    const unsigned n = 16 * count;
    (void)assignment;
    for (unsigned columns = 1; columns <= n; columns *= 2) {
        const unsigned rows = n / columns;
        memset(seen, 0, sizeof seen);
        for (unsigned s = 0; s < count; s++)
            for (int j = 0; j < 16; j++) {
                assert_true(sets[s].a[j] >= 0 && sets[s].a[j] < 1 && sets[s].b[j] >= 0 && sets[s].b[j] < 1);
                unsigned column = (unsigned)(sets[s].a[j] * (float)columns), row = (unsigned)(sets[s].b[j] * (float)rows);
                assert_int_equal(seen[row * columns + column]++, 0);
            }
    }
}

static void samples__all_sets_together__a_net(void **state)
{
    (void)state;
    for_all(check_net);
}

/* Row by row, which the choice of four samples relies on. */
static void check_cells(kernel_assignment assignment, unsigned count)
{
    (void)assignment;
    for (unsigned s = 0; s < count; s++)
        for (int j = 0; j < 16; j++) {
            assert_int_equal((int)(4 * sets[s].a[j]), j & 3);
            assert_int_equal((int)(4 * sets[s].b[j]), j >> 2);
        }
}

static void samples__each_set__one_point_a_cell_in_order(void **state)
{
    (void)state;
    for_all(check_cells);
}

/* A lattice has 4 different first coordinates within its cells. */
static void samples__hammersley_permuted__no_lattice(void **state)
{
    (void)state;
    light_samples_fill(KERNEL_NET_HAMMERSLEY, KERNEL_ASSIGN_PERMUTED, 16, sets);
    for (int s = 0; s < 16; s++) {
        int different = 0;
        for (int j = 0; j < 16; j++) {
            int old = 0;
            for (int i = 0; i < j; i++)
                old |= (int)(4 * sets[s].a[i]) * 16 + fmodf(sets[s].a[i], 0.25f) * 64 ==
                       (int)(4 * sets[s].a[j]) * 16 + fmodf(sets[s].a[j], 0.25f) * 64;
            different += !old;
        }
        assert_true(different > 4);
    }
}

/* The first points of the net after Kollig and Keller, as published: 0, .5, .75, .25, .875, .375, .125, .625. */
static void samples__larcher_pillichshammer__published_start(void **state)
{
    static const float expected[8] = {0, .5f, .75f, .25f, .875f, .375f, .125f, .625f};
    (void)state;
    light_samples_fill(KERNEL_NET_LARCHER, KERNEL_ASSIGN_RANK, 16, sets);
    for (int i = 0; i < 8; i++) {
        int found = 0;
        for (int s = 0; s < 16; s++)
            for (int j = 0; j < 16; j++)
                found += sets[s].a[j] == (float)i / 256 && sets[s].b[j] == expected[i];
        assert_int_equal(found, 1);
    }
}

/* Any 4x4 window of pixels, wherever it lies, uses every set once; all passes of a pixel together use different sets. */
static void sets_of_pixels__any_window__every_set_once(void **state)
{
    (void)state;
    kernel_job job = {.params = {.interleaved = 1}};
    for (unsigned x0 = 0; x0 < 8; x0++)
        for (unsigned y0 = 0; y0 < 8; y0++)
            for (unsigned pass = 0; pass < 16; pass++) {
                unsigned seen = 0;
                for (unsigned i = 0; i < 16; i++) {
                    unsigned x = x0 + i % 4, y = y0 + i / 4;
                    seen |= 1u << job_shadow_set(&job, kernel_job_pixel(&job, x, y).pixel, pass);
                }
                assert_int_equal(seen, 0xffff);
            }
    for (unsigned pixel = 0; pixel < 16; pixel++)
        for (unsigned passes = 4; passes <= MOST_SETS; passes *= 4) {
            unsigned char seen[MOST_SETS] = {0};
            for (unsigned pass = 0; pass < passes; pass++) {
                unsigned set = job_shadow_set(&job, pixel, pass);
                assert_true(set < (passes > 16 ? passes : 16));
                assert_int_equal(seen[set]++, 0);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples__all_sets_together__a_net),
        cmocka_unit_test(samples__each_set__one_point_a_cell_in_order),
        cmocka_unit_test(samples__hammersley_permuted__no_lattice),
        cmocka_unit_test(samples__larcher_pillichshammer__published_start),
        cmocka_unit_test(sets_of_pixels__any_window__every_set_once),
    };
    return cmocka_run_group_tests_name("light_samples", tests, NULL, NULL);
}
