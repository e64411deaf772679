/* Text and numbers: widths, cleaning, formats, and no influence of the locale. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <float.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/random.h"
#include "reports/text.h"

static void assert_clean(const char *text, const char *expected)
{
    char *clean = report_text_clean(text);
    assert_string_equal(clean, expected);
    free(clean);
}

static void clean__good_utf8__is_unchanged(void **state)
{
    (void)state;
    assert_clean("", "");
    assert_clean("abc \u00e4\u2014\U0001f600", "abc \u00e4\u2014\U0001f600");
    assert_clean("\xf4\x8f\xbf\xbf", "\xf4\x8f\xbf\xbf"); /* the last character there is */
}

static void clean__bad_bytes_and_controls__are_replaced(void **state)
{
    (void)state;
    assert_clean("a\nb\tc\x7f", "a b c ");
    assert_clean("\xff", "\ufffd");
    assert_clean("\xc3", "\ufffd");                   /* cut short by the end */
    assert_clean("\xe2\x80", "\ufffd\ufffd");
    assert_clean("\xc3(", "\ufffd(");
    assert_clean("\xc0\xaf", "\ufffd\ufffd");         /* a slash in too many bytes */
    assert_clean("\xe0\x80\xaf", "\ufffd");           /* the same in three: one wrong character */
    assert_clean("\xed\xa0\x80", "\ufffd");           /* half of a surrogate pair */
    assert_clean("\xf4\x90\x80\x80", "\ufffd");       /* beyond the last character */
    assert_clean("\xc2\x85", " ");                    /* a control character of its own */
}

static void width__kinds_of_characters__count_terminal_cells(void **state)
{
    (void)state;
    assert_int_equal(report_text_width(""), 0);
    assert_int_equal(report_text_width("abc"), 3);
    assert_int_equal(report_text_width("\u00e4\u2014"), 2);
    assert_int_equal(report_text_width("e\u0301"), 1); /* a combining accent */
    assert_int_equal(report_text_width("\u6f22\u5b57"), 4);
    assert_int_equal(report_text_width("\U0001f600"), 2);
    assert_int_equal(report_text_width("\xff\xff"), 2);
}

static void integer__extremes_and_groups__are_exact(void **state)
{
    (void)state;
    char text[REPORT_NUMBER_BYTES];
    static const struct {
        int64_t value;
        const char *plain, *grouped;
    } cases[] = {
        {0, "0", "0"},
        {999, "999", "999"},
        {1000, "1000", "1,000"},
        {-123456, "-123456", "-123,456"},
        {-999, "-999", "-999"},
        {INT64_MAX, "9223372036854775807", "9,223,372,036,854,775,807"},
        {INT64_MIN, "-9223372036854775808", "-9,223,372,036,854,775,808"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        report_format_integer(text, cases[i].value, false);
        assert_string_equal(text, cases[i].plain);
        report_format_integer(text, cases[i].value, true);
        assert_string_equal(text, cases[i].grouped);
    }
}

static void real__boundaries__are_rounded_and_never_minus_zero(void **state)
{
    (void)state;
    char text[REPORT_NUMBER_BYTES];
    static const struct {
        double value;
        int decimals;
        const char *expected;
    } cases[] = {
        {0, 0, "0"},           {-0.0, 2, "0.00"},        {-0.004, 2, "0.00"},   {-0.006, 2, "-0.01"},
        {0.125, 2, "0.12"},    {0.375, 2, "0.38"},       {999.999, 2, "1,000.00"}, {1234567.25, 1, "1,234,567.2"},
        {-1234.5, 0, "-1,234"}, {1e15, 3, "1,000,000,000,000,000.000"}, {5e-324, 17, "0.00000000000000000"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        report_format_real(text, cases[i].value, cases[i].decimals, true);
        assert_string_equal(text, cases[i].expected);
    }
    report_format_real(text, -DBL_MAX, REPORT_MAX_DECIMALS, true); /* the longest there is fits */
    assert_int_equal(strlen(text), 1 + 309 + 102 + 1 + REPORT_MAX_DECIMALS);
}

/* In the C locale printf must agree, whatever the value. */
static void real__random_values__agree_with_printf(void **state)
{
    (void)state;
    base_random random = {7};
    for (int i = 0; i < 20000; i++) {
        uint64_t bits = base_random_bits(&random);
        double value;
        char text[REPORT_NUMBER_BYTES], expected[REPORT_NUMBER_BYTES];
        memcpy(&value, &bits, sizeof value);
        int decimals = i % (REPORT_MAX_DECIMALS + 1);
        snprintf(expected, sizeof expected, "%.*f", decimals, value);
        if (!(value - value == 0) || !strpbrk(expected, "123456789"))
            continue;
        report_format_real(text, value, decimals, false);
        assert_string_equal(text, expected);
    }
}

/* Needs the locale that the build makes where it can; without one there is nothing to see. */
static void real__comma_locale__still_has_a_point(void **state)
{
    (void)state;
    char text[REPORT_NUMBER_BYTES];
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8")) { /* cmocka's skip() would print "not ok" */
        print_message("# skipped: no locale with a decimal comma could be made\n");
        return;
    }
    assert_string_equal(localeconv()->decimal_point, ",");
    report_format_real(text, 1234.5, 2, true);
    setlocale(LC_NUMERIC, "C");
    assert_string_equal(text, "1,234.50");
}

static void scaled__around_the_units__has_at_most_three_whole_digits(void **state)
{
    (void)state;
    char text[REPORT_NUMBER_BYTES];
    static const struct {
        double value;
        int decimals;
        const char *expected;
    } cases[] = {
        {0, 2, "0"},          {12, 2, "12"},         {12.5, 2, "12.50"},    {999, 1, "999"},       {999.96, 1, "1.0K"},
        {1000, 1, "1.0K"},    {1048576, 2, "1.05M"}, {999949, 1, "999.9K"}, {999950, 1, "1.0M"},   {-2500, 1, "-2.5K"},
        {3.2e9, 1, "3.2G"},   {7e12, 0, "7T"},       {1.5e16, 1, "15,000.0T"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        report_format_scaled(text, cases[i].value, cases[i].decimals);
        assert_string_equal(text, cases[i].expected);
    }
}

static void html__special_characters__are_escaped(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    report_text_print_html(out, "<a href=\"x\">'&' \xff\x01\u00e4</a>");
    fclose(out);
    assert_string_equal(text, "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39; \ufffd \u00e4&lt;/a&gt;");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clean__good_utf8__is_unchanged),
        cmocka_unit_test(clean__bad_bytes_and_controls__are_replaced),
        cmocka_unit_test(width__kinds_of_characters__count_terminal_cells),
        cmocka_unit_test(integer__extremes_and_groups__are_exact),
        cmocka_unit_test(real__boundaries__are_rounded_and_never_minus_zero),
        cmocka_unit_test(real__random_values__agree_with_printf),
        cmocka_unit_test(real__comma_locale__still_has_a_point),
        cmocka_unit_test(scaled__around_the_units__has_at_most_three_whole_digits),
        cmocka_unit_test(html__special_characters__are_escaped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
