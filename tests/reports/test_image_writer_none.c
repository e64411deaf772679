/* The picture writer of a build without OpenImageIO. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "reports/image_writer.h"

static void write__without_the_library__is_unsupported_and_says_so(void **state)
{
    (void)state;
    report_image image;
    base_error err;
    assert_int_equal(report_image_create(1, 1, 3, &image, NULL), BASE_OK);
    assert_int_equal(report_image_write("lanetrace-test-none.png", &image, &err), BASE_ERR_UNSUPPORTED);
    assert_non_null(strstr(err.why, "images"));
    assert_int_equal(base_exit_code(err.status), 2);
    FILE *file = fopen("lanetrace-test-none.png", "rb");
    assert_null(file);
    report_image_destroy(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(write__without_the_library__is_unsupported_and_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
