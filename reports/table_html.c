/* Tables as a fragment of HTML. */
#include "reports/table_data.h"

#include <string.h>

enum { LONGEST_LINE = 60 }; /* bytes */

static void put_element(FILE *out, const char *start, const char *text, const char *end)
{
    fputs(start, out);
    report_text_print_html(out, text);
    fputs(end, out);
}

static const char *class_of(report_align align)
{
    switch (align) {
    case REPORT_ALIGN_RIGHT:
        return " class=\"right\"";
    case REPORT_ALIGN_CENTRE:
        return " class=\"centre\"";
    default:
        return "";
    }
}

static void put_header(const report_table *t, FILE *out)
{
    fputs("<thead>\n<tr>", out);
    for (size_t i = 0; i < t->columns_count; i++) {
        const table_column *c = &t->columns[i];
        fprintf(out, "<th scope=\"col\"%s>", class_of(c->align));
        report_text_print_html(out, c->name);
        if (c->unit)
            put_element(out, "<br><span class=\"unit\">", c->unit, "</span>");
        fputs("</th>", out);
    }
    fputs("</tr>\n</thead>\n", out);
}

/* A cell stays on one line unless it holds whole sentences. */
static void put_cell(const table_column *c, const table_cell *cell, bool heads_row, FILE *out)
{
    char number[REPORT_NUMBER_BYTES];
    const char *element = heads_row ? "th" : "td", *text = table_cell_shown(c, cell, number);
    const char *class = c->kind == REPORT_TEXT && strlen(text) > LONGEST_LINE ? " class=\"prose\"" : class_of(c->align);
    fprintf(out, "<%s%s%s>", element, heads_row ? " scope=\"row\"" : "", class);
    report_text_print_html(out, text);
    fprintf(out, "</%s>", element);
}

/* Each group is a <tbody>; a label is its first row. */
static void put_rows(const report_table *t, FILE *out)
{
    fputs("<tbody>\n", out);
    for (size_t row = 0; row < t->rows_count; row++) {
        const table_group *group = table_group_at(t, row);
        if (group && row)
            fputs("</tbody>\n<tbody>\n", out);
        if (group && group->label) {
            fprintf(out, "<tr class=\"group\"><th scope=\"rowgroup\" colspan=\"%zu\">", t->columns_count);
            put_element(out, "", group->label, "</th></tr>\n");
        }
        fputs("<tr>", out);
        for (size_t i = 0; i < t->columns_count; i++)
            put_cell(&t->columns[i], table_cell_at(t, row, i), i == 0 && t->columns[i].kind == REPORT_TEXT, out);
        fputs("</tr>\n", out);
    }
    fputs("</tbody>\n", out);
}

base_status report_table_write_html(const report_table *t, FILE *out, base_error *err)
{
    base_status status = table_check(t, err);
    if (status != BASE_OK)
        return status;
    put_element(out, "<figure class=\"table\">\n<figcaption><strong>", t->title, "</strong>");
    if (t->caption)
        put_element(out, "<br>", t->caption, "");
    fputs("</figcaption>\n<div class=\"scroll\">\n<table>\n", out);
    put_header(t, out);
    put_rows(t, out);
    fputs("</table>\n</div>\n", out);
    if (t->notes_count)
        fputs("<ul class=\"notes\">\n", out);
    for (size_t i = 0; i < t->notes_count; i++)
        put_element(out, "<li>", t->notes[i], "</li>\n");
    if (t->notes_count)
        fputs("</ul>\n", out);
    fputs("</figure>\n", out);
    return BASE_OK;
}
