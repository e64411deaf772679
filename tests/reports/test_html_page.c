/* Pages: self-contained, well-formed, everything escaped, pictures inside. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "reports/html_page.h"
#include "tests/base/files.h"

/* A PNG of one black pixel, made by hand from the format's description; only its head matters here. */
static const unsigned char tiny_png[] = {
    0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 'I',  'H',  'D',  'R',  0x00,
    0x00, 0x01, 0x02, 0x00, 0x00, 0x00, 0x07, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55,
};

static void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    fclose(out);
}

/* Not inlined: gcc 12 would take the text for a pointer to this function's own variable, and warn. */
static __attribute__((noinline)) char *written(report_page *page)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_int_equal(report_page_write(page, out, NULL), BASE_OK);
    fclose(out);
    assert_int_equal(strlen(text), size);
    return text;
}

static int is_void_element(const char *name)
{
    static const char *const names[] = {"meta", "br", "img"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

/* Reads the name behind a '<'; returns the position of the closing '>'. */
static const char *tag_end(const char *tag, char name[16])
{
    size_t length = 0;
    while (isalnum((unsigned char)tag[length]) && length < 15)
        length++;
    assert_in_range(length, 1, 14);
    memcpy(name, tag, length);
    name[length] = '\0';
    const char *end = strchr(tag, '>');
    assert_non_null(end);
    int quotes = 0;
    for (const char *c = tag; c < end; c++) {
        assert_int_not_equal(*c, '<');
        quotes += *c == '"';
    }
    assert_int_equal(quotes % 2, 0);
    return end;
}

/* Every element that is opened is closed, in order; no stray angle bracket or ampersand. */
static void assert_balanced(const char *html)
{
    char open[64][16];
    int depth = 0;
    const char *at = html;
    assert_memory_equal(at, "<!DOCTYPE html>\n", 16);
    for (at += 16; *at; at++) {
        char name[16];
        if (*at == '&')
            assert_true(!strncmp(at, "&amp;", 5) || !strncmp(at, "&lt;", 4) || !strncmp(at, "&gt;", 4) ||
                        !strncmp(at, "&quot;", 6) || !strncmp(at, "&#39;", 5));
        assert_int_not_equal(*at, '>'); /* tags are skipped whole below */
        if (*at != '<')
            continue;
        if (at[1] == '/') {
            at = tag_end(at + 2, name);
            assert_true(depth > 0);
            assert_string_equal(name, open[--depth]);
            continue;
        }
        at = tag_end(at + 1, name);
        if (!is_void_element(name)) {
            assert_true(depth < 64);
            strcpy(open[depth++], name);
        }
        if (strcmp(name, "style") == 0) /* its text is no markup, and may hold '>' */
            at = strstr(at, "</style") - 1;
    }
    assert_int_equal(depth, 0);
}

static void page__all_parts__is_well_formed_and_self_contained(void **state)
{
    char *directory = files_make_directory();
    char *png = files_path(directory, "a.png");
    (void)state;
    write_bytes(png, tiny_png, sizeof tiny_png);
    report_page *page = report_page_create("Cost & <speed>");
    report_page_add_paragraph(page, "A \"quoted\" paragraph with <script>alert('x')</script> & more.");
    report_page_add_heading(page, 1, "One <b>");
    report_page_add_heading(page, 1, "Two");
    report_page_add_heading(page, 2, "Two and a half");
    report_page_add_heading(page, 1, "Three");
    report_page_add_code(page, "lanetrace report --out <dir>\nsecond line & more");
    report_table *t = report_table_create("Table </table>");
    report_table_add_column(t, &(report_column){.name = "<td>", .unit = "\">"});
    report_table_begin_row(t);
    report_table_add_text(t, "</td>");
    report_table_add_note(t, "a < b");
    assert_int_equal(report_page_add_table(page, t, NULL), BASE_OK);
    const report_figure figures[] = {
        {.path = png, .alt = "a \"black\" <pixel>", .caption = "first & best"},
        {.path = png, .alt = "the same"},
    };
    assert_int_equal(report_page_add_pictures(page, figures, 2, NULL), BASE_OK);
    assert_int_equal(report_page_add_pictures(page, figures, 1, NULL), BASE_OK);
    char *html = written(page), *again = written(page);
    assert_string_equal(html, again);
    assert_balanced(html);
    assert_null(strstr(html, "<script"));
    assert_null(strstr(html, "http"));
    assert_null(strstr(html, "url("));
    assert_non_null(strstr(html, "<title>Cost &amp; &lt;speed&gt;</title>"));
    assert_non_null(strstr(html, "<li><a href=\"#section-1\">One &lt;b&gt;</a></li>"));
    assert_non_null(strstr(html, "<h2 id=\"section-3\">Three</h2>"));
    assert_non_null(strstr(html, "<pre><code>lanetrace report --out &lt;dir&gt;\nsecond line &amp; more</code></pre>"));
    assert_non_null(strstr(html, "width=\"258\" height=\"7\" alt=\"a &quot;black&quot; &lt;pixel&gt;\""));
    assert_non_null(strstr(html, "<figcaption>first &amp; best</figcaption>"));
    free(html);
    free(again);
    report_table_destroy(&t);
    report_page_destroy(&page);
    files_remove_directory(directory);
    free(png);
}

static void page__two_sections__have_no_list_of_contents(void **state)
{
    (void)state;
    report_page *page = report_page_create("t");
    report_page_add_heading(page, 1, "One");
    report_page_add_heading(page, 1, "Two");
    char *html = written(page);
    assert_null(strstr(html, "<nav"));
    assert_balanced(html);
    free(html);
    report_page_destroy(&page);
}

/* Decode independently of the encoder: by looking digits up in the order that RFC 4648 lists them. */
static size_t decode_base64(const char *text, unsigned char *out)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t bits = 0;
    int held = 0;
    size_t size = 0;
    for (; *text != '"'; text++) {
        if (*text == '\n' || *text == '=')
            continue;
        const char *digit = strchr(digits, *text);
        assert_non_null(digit);
        bits = bits << 6 | (uint32_t)(digit - digits);
        held += 6;
        if (held >= 8) {
            held -= 8;
            out[size++] = (unsigned char)(bits >> held);
        }
    }
    return size;
}

static void pictures__files_of_all_lengths__come_back_byte_for_byte(void **state)
{
    (void)state;
    char *directory = files_make_directory();
    char *png = files_path(directory, "a.png");
    enum { MOST = 200000 };
    unsigned char *bytes = malloc(MOST), *back = malloc(MOST);
    static const size_t sizes[] = {33, 34, 35, 57 * 4, 65536, 65537, 131072, MOST};
    memcpy(bytes, tiny_png, sizeof tiny_png);
    for (size_t i = sizeof tiny_png; i < MOST; i++)
        bytes[i] = (unsigned char)(i * 7 + i / 251);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        report_page *page = report_page_create("t");
        const report_figure figure = {.path = png, .alt = ""};
        write_bytes(png, bytes, sizes[i]);
        assert_int_equal(report_page_add_pictures(page, &figure, 1, NULL), BASE_OK);
        char *html = written(page);
        const char *data = strstr(html, "base64,");
        assert_non_null(data);
        assert_int_equal(decode_base64(data + 7, back), sizes[i]);
        assert_memory_equal(back, bytes, sizes[i]);
        free(html);
        report_page_destroy(&page);
    }
    free(bytes);
    free(back);
    files_remove_directory(directory);
    free(png);
}

static void pictures__missing_or_wrong_file__is_an_input_error_and_adds_nothing(void **state)
{
    (void)state;
    char *directory = files_make_directory();
    char *good = files_path(directory, "good.png"), *text = files_path(directory, "text.png");
    char *cut = files_path(directory, "cut.png"), *none = files_path(directory, "none.png");
    const char *bad[] = {text, cut, none, directory};
    write_bytes(good, tiny_png, sizeof tiny_png);
    write_bytes(cut, tiny_png, 23);
    files_write(text, "this is no picture at all, whatever it is called");
    report_page *page = report_page_create("t");
    char *before = written(page);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const report_figure figures[] = {{.path = good, .alt = ""}, {.path = bad[i], .alt = ""}};
        base_error err;
        assert_int_equal(report_page_add_pictures(page, figures, 2, &err), BASE_ERR_INPUT);
        assert_string_equal(err.what, bad[i]);
    }
    char *after = written(page);
    assert_string_equal(before, after);
    free(before);
    free(after);
    report_page_destroy(&page);
    files_remove_directory(directory);
    free(good);
    free(text);
    free(cut);
    free(none);
}

static void write__null_page__is_no_memory(void **state)
{
    (void)state;
    base_error err;
    report_page_add_paragraph(NULL, "x");
    report_page_add_heading(NULL, 1, "x");
    report_page_add_code(NULL, "x");
    assert_int_equal(report_page_add_table(NULL, NULL, &err), BASE_ERR_NOMEM);
    assert_int_equal(report_page_add_pictures(NULL, NULL, 0, &err), BASE_ERR_NOMEM);
    assert_int_equal(report_page_write(NULL, stdout, &err), BASE_ERR_NOMEM);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page__all_parts__is_well_formed_and_self_contained),
        cmocka_unit_test(page__two_sections__have_no_list_of_contents),
        cmocka_unit_test(pictures__files_of_all_lengths__come_back_byte_for_byte),
        cmocka_unit_test(pictures__missing_or_wrong_file__is_an_input_error_and_adds_nothing),
        cmocka_unit_test(write__null_page__is_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
