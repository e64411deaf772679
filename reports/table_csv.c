/* Tables as comma-separated values, RFC 4180. */
#include <string.h>

#include "reports/table_data.h"

/* The fields of a header are put together from two or three pieces, so quoting takes them one by one. */
static void put_piece(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
}

static bool needs_quotes(const char *text)
{
    return strpbrk(text, ",\"") != NULL; /* line breaks never get into a table */
}

static void put_field(FILE *out, const char *text)
{
    bool quoted = needs_quotes(text);
    if (quoted)
        fputc('"', out);
    if (quoted)
        put_piece(out, text);
    else
        fputs(text, out);
    if (quoted)
        fputc('"', out);
}

static void put_column_name(FILE *out, const table_column *c)
{
    if (!c->unit) {
        put_field(out, c->name);
        return;
    }
    bool quoted = needs_quotes(c->name) || needs_quotes(c->unit);
    if (quoted)
        fputc('"', out);
    put_piece(out, c->name);
    fputs(" (", out);
    put_piece(out, c->unit);
    fputc(')', out);
    if (quoted)
        fputc('"', out);
}

static void put_row(const report_table *t, size_t row, bool labels, FILE *out)
{
    char number[REPORT_NUMBER_BYTES];
    const char *label = table_label_of(t, row);
    if (labels)
        put_field(out, label ? label : "");
    for (size_t i = 0; i < t->columns_count; i++) {
        const table_cell *cell = table_cell_at(t, row, i);
        if (i || labels)
            fputc(',', out);
        if (cell->present)
            put_field(out, table_cell_exact(&t->columns[i], cell, number));
    }
    fputs("\r\n", out);
}

base_status report_table_write_csv(const report_table *t, FILE *out, base_error *err)
{
    base_status status = table_check(t, err);
    if (status != BASE_OK)
        return status;
    bool labels = table_has_labels(t);
    if (labels)
        fputs("group", out);
    for (size_t i = 0; i < t->columns_count; i++) {
        if (i || labels)
            fputc(',', out);
        put_column_name(out, &t->columns[i]);
    }
    fputs("\r\n", out);
    for (size_t row = 0; row < t->rows_count; row++)
        put_row(t, row, labels, out);
    return BASE_OK;
}
