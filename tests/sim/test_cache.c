/* A cache's contents: who is replaced, who is evicted, which shapes there are; and random accesses against a list. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/random.h"
#include "sim/cache.h"

static sim_cache *cache_of(unsigned size, unsigned ways, unsigned line)
{
    sim_cache *cache = NULL;
    assert_int_equal(sim_cache_create(size, ways, line, &cache, NULL), BASE_OK);
    return cache;
}

static void touch__full_set__least_recently_used_goes(void **state)
{
    sim_cache *cache = cache_of(4 * 64, 4, 64); /* one set */
    (void)state;
    for (uint64_t line = 0; line < 4; line++)
        assert_false(sim_cache_touch(cache, line));
    assert_true(sim_cache_touch(cache, 0)); /* now 1 is the oldest */
    assert_false(sim_cache_touch(cache, 4));
    assert_true(sim_cache_touch(cache, 0));
    assert_false(sim_cache_touch(cache, 1)); /* 2 goes */
    assert_true(sim_cache_touch(cache, 3));
    assert_false(sim_cache_touch(cache, 2));
    sim_cache_destroy(&cache);
    assert_null(cache);
}

static void touch__other_set__disturbs_nothing(void **state)
{
    sim_cache *cache = cache_of(2 * 64, 1, 64);
    (void)state;
    assert_false(sim_cache_touch(cache, 6));
    assert_false(sim_cache_touch(cache, 7));
    assert_true(sim_cache_touch(cache, 6));
    assert_false(sim_cache_touch(cache, 4));
    assert_true(sim_cache_touch(cache, 7));
    assert_false(sim_cache_touch(cache, 6));
    sim_cache_destroy(&cache);
}

static void evict__line__gone_and_its_place_free(void **state)
{
    sim_cache *cache = cache_of(2 * 64, 2, 64);
    (void)state;
    sim_cache_touch(cache, 1);
    sim_cache_touch(cache, 2);
    sim_cache_evict(cache, 1);
    sim_cache_evict(cache, 9); /* is not there */
    assert_false(sim_cache_touch(cache, 3));
    assert_true(sim_cache_touch(cache, 2)); /* 3 took the free place */
    sim_cache_destroy(&cache);
}

static void line__address__by_the_size_of_a_line(void **state)
{
    sim_cache *cache = cache_of(1024, 1, 128);
    (void)state;
    assert_int_equal(sim_cache_line(cache, 127), 0);
    assert_int_equal(sim_cache_line(cache, 128), 1);
    assert_int_equal(sim_cache_line(cache, UINT64_MAX), UINT64_MAX >> 7);
    sim_cache_destroy(&cache);
}

static void create__no_power_of_two__refused(void **state)
{
    static const unsigned shapes[][3] = {{0, 1, 64}, {64, 0, 64}, {64, 1, 0}, {96, 1, 96}, {192, 1, 64}, {100, 1, 64}, {64, 2, 64}};
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        sim_cache *cache = NULL;
        base_error err = {0};
        assert_int_equal(sim_cache_create(shapes[i][0], shapes[i][1], shapes[i][2], &cache, &err), BASE_ERR_USAGE);
        assert_null(cache);
    }
}

/* The same cache as one list of lines with the time of their last use. */
typedef struct list {
    uint64_t line[64], used[64], now;
} list;

static bool list_touch(list *l, uint64_t line, unsigned sets, unsigned ways)
{
    unsigned first = (unsigned)(line % sets) * ways, oldest = first;
    for (unsigned i = first; i < first + ways; i++) {
        if (l->used[i] && l->line[i] == line) {
            l->used[i] = ++l->now;
            return true;
        }
        if (l->used[i] < l->used[oldest])
            oldest = i;
    }
    l->line[oldest] = line;
    l->used[oldest] = ++l->now;
    return false;
}

static void touch__random_lines__as_a_list(void **state)
{
    static const unsigned shapes[][2] = {{1, 1}, {1, 8}, {8, 8}, {16, 1}, {16, 3}};
    base_random random = {.state = 1};
    (void)state;
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        unsigned sets = shapes[s][0], ways = shapes[s][1];
        sim_cache *cache = cache_of(sets * ways * 64, ways, 64);
        list l = {0};
        for (int i = 0; i < 100000; i++) {
            uint64_t bits = base_random_bits(&random), line = bits % (sets * ways * 3);
            if (bits >> 60 == 0) {
                sim_cache_evict(cache, line);
                for (unsigned j = 0; j < sets * ways; j++)
                    if (l.line[j] == line)
                        l.used[j] = 0;
            } else {
                assert_int_equal(sim_cache_touch(cache, line), list_touch(&l, line, sets, ways));
            }
        }
        sim_cache_destroy(&cache);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(touch__full_set__least_recently_used_goes), cmocka_unit_test(touch__other_set__disturbs_nothing),
        cmocka_unit_test(evict__line__gone_and_its_place_free),      cmocka_unit_test(line__address__by_the_size_of_a_line),
        cmocka_unit_test(create__no_power_of_two__refused),          cmocka_unit_test(touch__random_lines__as_a_list),
    };
    return cmocka_run_group_tests_name("cache", tests, NULL, NULL);
}
