/* Tables: what each writer prints, to the byte. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reports/table.h"

typedef base_status write_fn(const report_table *table, FILE *out, base_error *err);

/* What a writer prints, for free(). */
static char *written(const report_table *table, write_fn *write)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_int_equal(write(table, out, NULL), BASE_OK);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_written(const report_table *table, write_fn *write, const char *expected)
{
    char *text = written(table, write);
    assert_string_equal(text, expected);
    free(text);
}

/* One table with everything: units, groups, missing cells, wide characters, quotes, all kinds of numbers. */
static report_table *sample(void)
{
    report_table *t = report_table_create("Cost of a ray");
    report_table_set_caption(t, "Primary rays, 1024 x 1024.");
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "triangles", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "rays", .kind = REPORT_INTEGER, .decimals = 2,
                                                .digits = REPORT_DIGITS_SCALED});
    report_table_add_column(t, &(report_column){.name = "ops", .unit = "1/ray", .kind = REPORT_REAL, .decimals = 2});
    report_table_add_column(t, &(report_column){.name = "kind", .align = REPORT_ALIGN_CENTRE});
    report_table_begin_group(t, "Architecture");
    report_table_begin_row(t);
    report_table_add_text(t, "rooms-804");
    report_table_add_integer(t, 804);
    report_table_add_integer(t, 1048576);
    report_table_add_real(t, 12.345);
    report_table_add_text(t, "a \"b\", c");
    report_table_begin_row(t);
    report_table_add_text(t, "h\u00e4ll-60k");
    report_table_add_integer(t, 60123);
    report_table_add_missing(t);
    report_table_add_real(t, (double)NAN);
    report_table_add_text(t, NULL);
    report_table_begin_group(t, "Plants & co");
    report_table_begin_row(t);
    report_table_add_text(t, "\u690d");
    report_table_add_integer(t, -5);
    report_table_add_integer(t, 12);
    report_table_add_real(t, 1234567.0);
    report_table_add_text(t, "<x>");
    report_table_begin_row(t);
    report_table_add_text(t, "short");
    report_table_add_note(t, "An em dash: not measured.");
    report_table_add_note(t, "Second note.");
    return t;
}

static void text__full_table__matches_the_golden_text(void **state)
{
    (void)state;
    report_table *t = sample();
    assert_written(t, report_table_write_text,
                   "Cost of a ray\n"
                   "Primary rays, 1024 x 1024.\n"
                   "\n"
                   "scene      triangles   rays           ops    kind\n"
                   "                                  [1/ray]\n"
                   "---------  ---------  -----  ------------  --------\n"
                   "Architecture\n"
                   "rooms-804        804  1.05M         12.35  a \"b\", c\n"
                   "h\u00e4ll-60k      60,123      \u2014             \u2014     \u2014\n"
                   "\n"
                   "Plants & co\n"
                   "\u690d                -5     12  1,234,567.00    <x>\n"
                   "short              \u2014      \u2014             \u2014     \u2014\n"
                   "\n"
                   "An em dash: not measured.\n"
                   "Second note.\n");
    report_table_destroy(&t);
    assert_null(t);
}

static void csv__full_table__follows_rfc_4180_with_all_digits(void **state)
{
    (void)state;
    report_table *t = sample();
    assert_written(t, report_table_write_csv,
                   "group,scene,triangles,rays,ops (1/ray),kind\r\n"
                   "Architecture,rooms-804,804,1048576,12.35,\"a \"\"b\"\", c\"\r\n"
                   "Architecture,h\u00e4ll-60k,60123,,,\r\n"
                   "Plants & co,\u690d,-5,12,1234567.00,<x>\r\n"
                   "Plants & co,short,,,,\r\n");
    report_table_destroy(&t);
}

static void csv__comma_in_name_or_unit__quotes_the_header(void **state)
{
    (void)state;
    report_table *t = report_table_create("t");
    report_table_add_column(t, &(report_column){.name = "a, \"b\"", .unit = "s"});
    report_table_add_column(t, &(report_column){.name = "c", .unit = "m,n"});
    report_table_add_column(t, &(report_column){.name = "\"d\""});
    assert_written(t, report_table_write_csv, "\"a, \"\"b\"\" (s)\",\"c (m,n)\",\"\"\"d\"\"\"\r\n");
    report_table_destroy(&t);
}

static void json__full_table__reads_back_exactly(void **state)
{
    (void)state;
    report_table *t = sample();
    char *text = written(t, report_table_write_json);
    json_t *root = json_loads(text, 0, NULL);
    json_t *expected = json_loads(
        "{\"title\": \"Cost of a ray\", \"caption\": \"Primary rays, 1024 x 1024.\", \"columns\": ["
        "{\"name\": \"group\", \"unit\": null, \"kind\": \"text\"},"
        "{\"name\": \"scene\", \"unit\": null, \"kind\": \"text\"},"
        "{\"name\": \"triangles\", \"unit\": null, \"kind\": \"integer\"},"
        "{\"name\": \"rays\", \"unit\": null, \"kind\": \"integer\"},"
        "{\"name\": \"ops\", \"unit\": \"1/ray\", \"kind\": \"real\"},"
        "{\"name\": \"kind\", \"unit\": null, \"kind\": \"text\"}], \"rows\": ["
        "[\"Architecture\", \"rooms-804\", 804, 1048576, 12.35, \"a \\\"b\\\", c\"],"
        "[\"Architecture\", \"h\u00e4ll-60k\", 60123, null, null, null],"
        "[\"Plants & co\", \"\u690d\", -5, 12, 1234567.0, \"<x>\"],"
        "[\"Plants & co\", \"short\", null, null, null, null]],"
        "\"notes\": [\"An em dash: not measured.\", \"Second note.\"]}", 0, NULL);
    assert_non_null(root);
    assert_non_null(expected);
    assert_true(json_equal(root, expected));
    assert_true(strstr(text, "12.35,") && !strstr(text, "12.3499"));
    assert_ptr_equal(strstr(text, "{\n  \"title\": \"Cost of a ray\",\n  \"caption\": "), text);
    assert_string_equal(text + strlen(text) - 2, "}\n");
    json_decref(root);
    json_decref(expected);
    free(text);
    report_table_destroy(&t);
}

static void json__reals__show_their_decimals_and_stay_reals(void **state)
{
    (void)state;
    static const struct {
        double value;
        int decimals;
        const char *expected;
    } cases[] = {
        {0.1, 17, "0.1\n"},   {0.1 + 0.2, 3, "0.3\n"},       {2, 0, "2.0\n"},
        {2.5, 0, "2.0\n"},    {-0.001, 2, "0.0\n"},          {1e6 / 3, 4, "333333.3333\n"},
        {1e300, 1, "1e300\n"}, {(double)NAN, 2, "null\n"}, {(double)INFINITY, 2, "null\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&text, &size);
        json_t *value = report_json_real(cases[i].value, cases[i].decimals);
        assert_int_equal(report_json_write(value, out, NULL), BASE_OK);
        fclose(out);
        assert_string_equal(text, cases[i].expected);
        json_decref(value);
        free(text);
    }
}

static void html__full_table__matches_the_golden_text(void **state)
{
    (void)state;
    report_table *t = sample();
    assert_written(
        t, report_table_write_html,
        "<figure class=\"table\">\n"
        "<figcaption><strong>Cost of a ray</strong><br>Primary rays, 1024 x 1024.</figcaption>\n"
        "<div class=\"scroll\">\n<table>\n<thead>\n"
        "<tr><th scope=\"col\">scene</th><th scope=\"col\" class=\"right\">triangles</th>"
        "<th scope=\"col\" class=\"right\">rays</th>"
        "<th scope=\"col\" class=\"right\">ops<br><span class=\"unit\">1/ray</span></th>"
        "<th scope=\"col\" class=\"centre\">kind</th></tr>\n</thead>\n<tbody>\n"
        "<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"5\">Architecture</th></tr>\n"
        "<tr><th scope=\"row\">rooms-804</th><td class=\"right\">804</td><td class=\"right\">1.05M</td>"
        "<td class=\"right\">12.35</td><td class=\"centre\">a &quot;b&quot;, c</td></tr>\n"
        "<tr><th scope=\"row\">h\u00e4ll-60k</th><td class=\"right\">60,123</td><td class=\"right\">\u2014</td>"
        "<td class=\"right\">\u2014</td><td class=\"centre\">\u2014</td></tr>\n"
        "</tbody>\n<tbody>\n"
        "<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"5\">Plants &amp; co</th></tr>\n"
        "<tr><th scope=\"row\">\u690d</th><td class=\"right\">-5</td><td class=\"right\">12</td>"
        "<td class=\"right\">1,234,567.00</td><td class=\"centre\">&lt;x&gt;</td></tr>\n"
        "<tr><th scope=\"row\">short</th><td class=\"right\">\u2014</td><td class=\"right\">\u2014</td>"
        "<td class=\"right\">\u2014</td><td class=\"centre\">\u2014</td></tr>\n"
        "</tbody>\n</table>\n</div>\n"
        "<ul class=\"notes\">\n<li>An em dash: not measured.</li>\n<li>Second note.</li>\n</ul>\n</figure>\n");
    report_table_destroy(&t);
}

static void group__without_label__is_a_rule_in_text_and_nothing_in_csv(void **state)
{
    (void)state;
    report_table *t = report_table_create("t");
    report_table_add_column(t, &(report_column){.name = "n", .kind = REPORT_INTEGER, .digits = REPORT_DIGITS_PLAIN});
    report_table_begin_row(t);
    report_table_add_integer(t, 1000);
    report_table_begin_group(t, NULL);
    report_table_begin_row(t);
    report_table_add_integer(t, 2);
    assert_written(t, report_table_write_text, "t\n\n   n\n----\n1000\n----\n   2\n");
    assert_written(t, report_table_write_csv, "n\r\n1000\r\n2\r\n");
    report_table_destroy(&t);
}

static void text__no_rows__has_its_header(void **state)
{
    (void)state;
    report_table *t = report_table_create("empty");
    report_table_add_column(t, &(report_column){.name = "a", .align = REPORT_ALIGN_RIGHT});
    report_table_add_column(t, &(report_column){.name = "b", .unit = "ms"});
    assert_int_equal(report_table_rows(t), 0);
    assert_written(t, report_table_write_text, "empty\n\na  b\n   [ms]\n-  ----\n");
    report_table_destroy(&t);
}

static void text__bad_bytes_and_line_breaks__do_not_break_lines(void **state)
{
    (void)state;
    report_table *t = report_table_create("a\nb");
    report_table_add_column(t, &(report_column){.name = "x"});
    report_table_begin_row(t);
    report_table_add_text(t, "1\r\n2\xff");
    assert_written(t, report_table_write_text, "a b\n\nx\n-----\n1  2\ufffd\n");
    assert_written(t, report_table_write_csv, "x\r\n1  2\ufffd\r\n");
    char *json = written(t, report_table_write_json);
    assert_non_null(strstr(json, "\"1  2\ufffd\""));
    free(json);
    report_table_destroy(&t);
}

static void rows__many__are_all_kept(void **state)
{
    (void)state;
    report_table *t = report_table_create("many");
    report_table_add_column(t, &(report_column){.name = "i", .kind = REPORT_INTEGER});
    report_table_add_column(t, &(report_column){.name = "s"});
    for (int i = 0; i < 1000; i++) {
        char text[16];
        snprintf(text, sizeof text, "row %d", i);
        report_table_begin_row(t);
        report_table_add_integer(t, i);
        report_table_add_text(t, text);
    }
    assert_int_equal(report_table_rows(t), 1000);
    char *csv = written(t, report_table_write_csv);
    const char *line = csv;
    for (int i = 0; i < 1000; i++) {
        char expected[40];
        snprintf(expected, sizeof expected, "\r\n%d,row %d\r\n", i, i);
        line = strstr(line, expected);
        assert_non_null(line);
        line += 2;
    }
    free(csv);
    report_table_destroy(&t);
}

static void write__null_table__is_no_memory(void **state)
{
    (void)state;
    base_error err;
    report_table *none = NULL;
    report_table_add_note(none, "x");
    report_table_begin_row(none);
    report_table_add_missing(none);
    assert_int_equal(report_table_write_text(none, stdout, &err), BASE_ERR_NOMEM);
    assert_int_equal(report_table_write_csv(none, stdout, &err), BASE_ERR_NOMEM);
    assert_int_equal(report_table_write_json(none, stdout, &err), BASE_ERR_NOMEM);
    assert_int_equal(report_table_write_html(none, stdout, &err), BASE_ERR_NOMEM);
    report_table_destroy(&none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text__full_table__matches_the_golden_text),
        cmocka_unit_test(csv__full_table__follows_rfc_4180_with_all_digits),
        cmocka_unit_test(csv__comma_in_name_or_unit__quotes_the_header),
        cmocka_unit_test(json__full_table__reads_back_exactly),
        cmocka_unit_test(json__reals__show_their_decimals_and_stay_reals),
        cmocka_unit_test(html__full_table__matches_the_golden_text),
        cmocka_unit_test(group__without_label__is_a_rule_in_text_and_nothing_in_csv),
        cmocka_unit_test(text__no_rows__has_its_header),
        cmocka_unit_test(text__bad_bytes_and_line_breaks__do_not_break_lines),
        cmocka_unit_test(rows__many__are_all_kept),
        cmocka_unit_test(write__null_table__is_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
