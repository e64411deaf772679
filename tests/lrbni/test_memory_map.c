/* Simulated addresses: a matter of sizes and order alone; full memory is an error with words. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/ctx.h"
#include "lrbni/memory.h"

static const size_t sizes[] = {1, 64, 4095, 4096, 4097, 100000, 1 << 20};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void map__same_sizes_elsewhere__same_addresses(void **state)
{
    (void)state;
    static _Alignas(64) unsigned char here[128];
    lrb_memory first = lrb_memory_empty(), second = lrb_memory_empty();
    uint32_t next = LRB_PAGE_BYTES;
    for (int i = 0; i < SIZES; i++) {
        lrb_segment a, b;
        assert_int_equal(lrb_memory_map(&first, "a", here, sizes[i], &a, NULL), BASE_OK);
        assert_int_equal(lrb_memory_map(&second, "b", here + 64, sizes[i], &b, NULL), BASE_OK);
        assert_int_equal(a.address, next);
        assert_int_equal(b.address, next);
        assert_ptr_equal(a.host, here);
        assert_ptr_equal(b.host, here + 64);
        assert_int_equal(a.size, sizes[i]);
        next += (uint32_t)((sizes[i] + LRB_PAGE_BYTES - 1) / LRB_PAGE_BYTES) * LRB_PAGE_BYTES;
    }
}

static void map__address_zero__never_given(void **state)
{
    (void)state;
    static _Alignas(64) unsigned char here[64];
    lrb_memory memory = lrb_memory_empty();
    lrb_segment s;
    assert_int_equal(lrb_memory_map(&memory, "s", here, sizeof here, &s, NULL), BASE_OK);
    assert_true(s.address >= LRB_PAGE_BYTES && s.address % LRB_PAGE_BYTES == 0);
}

/* Nothing is read of the host's memory, so its size need not be real. */
static void map__memory_full__input_error_and_nothing_mapped(void **state)
{
    (void)state;
    static _Alignas(64) unsigned char here[64];
    lrb_memory memory = lrb_memory_empty();
    lrb_segment s, untouched = {.address = 1};
    base_error err = {0};
    const size_t all = LRB_SCRATCH_ADDRESS - 2 * LRB_PAGE_BYTES;
    assert_int_equal(lrb_memory_map(&memory, "scene", here, all + 1, &untouched, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "scene");
    assert_non_null(strstr(err.why, "4 GiB"));
    assert_int_equal(untouched.address, 1);
    assert_int_equal(lrb_memory_map(&memory, "scene", here, SIZE_MAX, &untouched, NULL), BASE_ERR_INPUT);
    assert_int_equal(memory.next, LRB_PAGE_BYTES);
    assert_int_equal(lrb_memory_map(&memory, "scene", here, all, &s, &err), BASE_OK);
    assert_int_equal(s.address, LRB_PAGE_BYTES);
    assert_true((uint64_t)s.address + s.size <= LRB_SCRATCH_ADDRESS);
    assert_int_equal(lrb_memory_map(&memory, "more", here, 1, &untouched, &err), BASE_ERR_INPUT);
    assert_string_equal(err.what, "more");
}

static void context__scratch__zeros_at_its_address(void **state)
{
    (void)state;
    lrb_ctx *c = NULL;
    assert_int_equal(lrb_ctx_create(NULL, NULL, &c, NULL), BASE_OK);
    assert_int_equal(c->scratch.address, LRB_SCRATCH_ADDRESS);
    assert_int_equal(c->scratch.size, LRB_SCRATCH_BYTES);
    assert_int_equal((uintptr_t)c->scratch.host % 64, 0);
    for (size_t i = 0; i < c->scratch.size; i++)
        assert_int_equal(c->scratch.host[i], 0);
    lrb_ctx_destroy(&c);
    assert_null(c);
    lrb_ctx_destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(map__same_sizes_elsewhere__same_addresses),
        cmocka_unit_test(map__address_zero__never_given),
        cmocka_unit_test(map__memory_full__input_error_and_nothing_mapped),
        cmocka_unit_test(context__scratch__zeros_at_its_address),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
