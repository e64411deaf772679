/* Tables as JSON, through jansson. */
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "reports/table_data.h"

enum { SIGNIFICANT_DIGITS = 15 }; /* every decimal number of so many digits comes back as it was written */

json_t *report_json_real(double value, int decimals)
{
    char text[REPORT_NUMBER_BYTES];
    if (!isfinite(value))
        return json_null();
    report_format_real(text, value, decimals, false);
    if (!decimals)
        strcat(text, ".0"); /* so that it stays a real; the buffer has room for 17 decimals */
    /* jansson's own number reader, since strtod would obey the locale. */
    return json_loads(text, JSON_DECODE_ANY, NULL);
}

static json_t *text_or_null(const char *text)
{
    return text ? json_string(text) : json_null();
}

static json_t *cell_json(const table_column *column, const table_cell *cell)
{
    if (!cell->present)
        return json_null();
    switch (column->kind) {
    case REPORT_TEXT:
        return json_string(cell->text);
    case REPORT_INTEGER:
        return json_integer(cell->integer);
    case REPORT_REAL:
        return report_json_real(cell->real, column->decimals);
    }
    return NULL;
}

static const char *kind_name(report_kind kind)
{
    return kind == REPORT_TEXT ? "text" : kind == REPORT_INTEGER ? "integer" : "real";
}

/* Sets *ok to false and returns null when a piece is missing, so that one check at the end is enough. */
static json_t *columns_json(const report_table *t, bool labels, bool *ok)
{
    json_t *columns = json_array();
    if (labels) {
        json_t *group = json_pack("{s:s, s:n, s:s}", "name", "group", "unit", "kind", "text");
        *ok &= json_array_append_new(columns, group) == 0;
    }
    for (size_t i = 0; i < t->columns_count; i++) {
        const table_column *c = &t->columns[i];
        json_t *column = json_pack("{s:s, s:o, s:s}", "name", c->name, "unit", text_or_null(c->unit), "kind",
                                   kind_name(c->kind));
        *ok &= json_array_append_new(columns, column) == 0;
    }
    return columns;
}

static json_t *rows_json(const report_table *t, bool labels, bool *ok)
{
    json_t *rows = json_array();
    for (size_t row = 0; row < t->rows_count; row++) {
        json_t *cells = json_array();
        if (labels)
            *ok &= json_array_append_new(cells, text_or_null(table_label_of(t, row))) == 0;
        for (size_t i = 0; i < t->columns_count; i++)
            *ok &= json_array_append_new(cells, cell_json(&t->columns[i], table_cell_at(t, row, i))) == 0;
        *ok &= json_array_append_new(rows, cells) == 0;
    }
    return rows;
}

json_t *report_table_json(const report_table *t)
{
    bool ok = table_check(t, NULL) == BASE_OK;
    if (!ok)
        return NULL;
    bool labels = table_has_labels(t);
    json_t *root = json_object();
    ok &= json_object_set_new(root, "title", json_string(t->title)) == 0;
    if (t->caption)
        ok &= json_object_set_new(root, "caption", json_string(t->caption)) == 0;
    json_t *columns = columns_json(t, labels, &ok);
    json_t *rows = rows_json(t, labels, &ok);
    ok &= json_object_set_new(root, "columns", columns) == 0;
    ok &= json_object_set_new(root, "rows", rows) == 0;
    if (t->notes_count) {
        json_t *notes = json_array();
        for (size_t i = 0; i < t->notes_count; i++)
            ok &= json_array_append_new(notes, json_string(t->notes[i])) == 0;
        ok &= json_object_set_new(root, "notes", notes) == 0;
    }
    if (!ok) {
        json_decref(root);
        return NULL;
    }
    return root;
}

base_status report_json_write(const json_t *value, FILE *out, base_error *err)
{
    if (!value)
        return base_fail(err, BASE_ERR_NOMEM, "JSON", "out of memory");
    /* A failed write is the stream's to report, a failed conversion ours: so the text is made first. */
    char *text = json_dumps(value, JSON_INDENT(2) | JSON_ENCODE_ANY | JSON_REAL_PRECISION(SIGNIFICANT_DIGITS));
    if (!text)
        return base_fail(err, BASE_ERR_NOMEM, "JSON", "out of memory");
    fprintf(out, "%s\n", text);
    free(text);
    return BASE_OK;
}

base_status report_table_write_json(const report_table *t, FILE *out, base_error *err)
{
    json_t *root = report_table_json(t);
    base_status status = report_json_write(root, out, err);
    json_decref(root);
    return status;
}
