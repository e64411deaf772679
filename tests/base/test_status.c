/* Errors: filled in whole, on one line, shortened where too long, optional; and the exit codes that are promised. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "lrbni/base/status.h"

static void fail__format__status_what_and_why(void **state)
{
    (void)state;
    base_error err;
    memset(&err, 0x7f, sizeof err);
    assert_int_equal(base_fail(&err, BASE_ERR_INPUT, "scene.glb", "%d bytes of %s", 7, "header"), BASE_ERR_INPUT);
    assert_int_equal(err.status, BASE_ERR_INPUT);
    assert_string_equal(err.what, "scene.glb");
    assert_string_equal(err.why, "7 bytes of header");
}

static void fail__no_error_asked_for__status_only(void **state)
{
    (void)state;
    assert_int_equal(base_fail(NULL, BASE_ERR_NOMEM, "what", "%s", "why"), BASE_ERR_NOMEM);
}

/* An error that passes through a second failure says what the second one says. */
static void fail__twice__the_last_words(void **state)
{
    (void)state;
    base_error err = {0};
    base_fail(&err, BASE_ERR_USAGE, "--size", "is not a number");
    base_error inner = err;
    assert_int_equal(base_fail(&err, BASE_ERR_IO, inner.what, "%s, and then the disk was full", inner.why), BASE_ERR_IO);
    assert_int_equal(err.status, BASE_ERR_IO);
    assert_string_equal(err.what, "--size");
    assert_string_equal(err.why, "is not a number, and then the disk was full");
    base_fail(&err, BASE_ERR_USAGE, "b", "c");
    assert_string_equal(err.what, "b");
    assert_string_equal(err.why, "c");
}

static void fail__control_characters__blanks(void **state)
{
    (void)state;
    base_error err;
    base_fail(&err, BASE_ERR_INPUT, "two\nlines", "%s", "tab\there\r\nand \x01 there");
    assert_string_equal(err.what, "two lines");
    assert_string_equal(err.why, "tab here  and   there");
}

static void fail__bytes_above_ascii__kept(void **state)
{
    (void)state;
    base_error err;
    base_fail(&err, BASE_ERR_INPUT, "stra\xc3\x9f" "e.glb", "caf\xc3\xa9");
    assert_string_equal(err.what, "stra\xc3\x9f" "e.glb");
    assert_string_equal(err.why, "caf\xc3\xa9");
}

/* Lengths around the ends of both fields. */
static void fail__long_words__cut_at_the_end(void **state)
{
    (void)state;
    char text[600];
    for (size_t length = 200; length < sizeof text - 1; length++) {
        base_error err;
        memset(text, 'x', length);
        text[length] = '\0';
        base_fail(&err, BASE_ERR_INPUT, text, "%s", text);
        size_t what = length < sizeof err.what - 1 ? length : sizeof err.what - 1;
        size_t why = length < sizeof err.why - 1 ? length : sizeof err.why - 1;
        assert_int_equal(strlen(err.what), what);
        assert_int_equal(strlen(err.why), why);
        assert_int_equal(strspn(err.what, "x"), what);
        assert_int_equal(strspn(err.why, "x"), why);
    }
}

static void exit_code__each_status__as_promised(void **state)
{
    (void)state;
    assert_int_equal(base_exit_code(BASE_OK), 0);
    assert_int_equal(base_exit_code(BASE_ERR_USAGE), 2);
    assert_int_equal(base_exit_code(BASE_ERR_INPUT), 2);
    assert_int_equal(base_exit_code(BASE_ERR_UNSUPPORTED), 2);
    assert_int_equal(base_exit_code(BASE_ERR_NOMEM), 3);
    assert_int_equal(base_exit_code(BASE_ERR_IO), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fail__format__status_what_and_why),
        cmocka_unit_test(fail__no_error_asked_for__status_only),
        cmocka_unit_test(fail__twice__the_last_words),
        cmocka_unit_test(fail__control_characters__blanks),
        cmocka_unit_test(fail__bytes_above_ascii__kept),
        cmocka_unit_test(fail__long_words__cut_at_the_end),
        cmocka_unit_test(exit_code__each_status__as_promised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
