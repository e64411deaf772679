/* A table built by code and written as text, CSV, JSON or HTML. A pure function of its contents: no clock, no host. */
#ifndef REPORTS_TABLE_H
#define REPORTS_TABLE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

struct json_t; /* jansson's json_t */

typedef struct report_table report_table;

typedef enum report_kind {
    REPORT_TEXT = 0,
    REPORT_INTEGER, /* int64_t */
    REPORT_REAL     /* double, printed with the column's decimals everywhere */
} report_kind;

typedef enum report_align {
    REPORT_ALIGN_AUTO = 0, /* text left, numbers right */
    REPORT_ALIGN_LEFT,
    REPORT_ALIGN_RIGHT,
    REPORT_ALIGN_CENTRE
} report_align;

/* How text and HTML show a number. CSV and JSON always have all its digits and no separators. */
typedef enum report_digits {
    REPORT_DIGITS_GROUPED = 0, /* 1,048,576 */
    REPORT_DIGITS_PLAIN,       /* 1048576 */
    REPORT_DIGITS_SCALED       /* 1.05M, with the column's decimals */
} report_digits;

typedef struct report_column {
    const char *name; /* copied; unique in its table */
    const char *unit; /* copied; NULL for none */
    report_kind kind;
    report_align align;
    int decimals; /* of reals, and of scaled numbers; 0 to 17 */
    report_digits digits;
} report_column;

/**
 * An empty table. Calls that add to a table cannot fail visibly: a lack of memory is remembered, and every writer
 * then returns BASE_ERR_NOMEM. All text is copied, and cleaned as report_text_clean does.
 *
 * @param title  a line; not NULL
 * @return NULL if there is no memory; every function below accepts that NULL
 */
report_table *report_table_create(const char *title);

/** Free a table and set the pointer to NULL. */
void report_table_destroy(report_table **table);

/** A sentence or two printed under the title. Replaces an earlier one. */
void report_table_set_caption(report_table *table, const char *caption);

/** A remark printed below the table; any number of them. */
void report_table_add_note(report_table *table, const char *note);

/** Add a column; all columns come before the first row. Asserts 0 <= decimals <= 17. */
void report_table_add_column(report_table *table, const report_column *column);

/** Add a column of reals; unit NULL: none. */
void report_table_add_real_column(report_table *table, const char *name, const char *unit, int decimals);

/**
 * Start a new group: a rule, or a line with the label, stands before the next row in text and HTML. If any group has
 * a label, CSV and JSON get a first column `group` that holds it.
 *
 * @param label  NULL for none
 */
void report_table_begin_group(report_table *table, const char *label);

/** Start a row. Its cells are added from left to right; the ones not added are missing. */
void report_table_begin_row(report_table *table);

/** Add a cell to the last row; asserts that the next column has this kind. NULL text is a missing cell. */
void report_table_add_text(report_table *table, const char *text);
void report_table_add_integer(report_table *table, int64_t value);

/** The same; a value that is not finite (a ratio to zero) is a missing cell. */
void report_table_add_real(report_table *table, double value);

/** Add a cell without a value to the last row: an em dash in text and HTML, empty in CSV, null in JSON. */
void report_table_add_missing(report_table *table);

/** Number of rows so far. */
size_t report_table_rows(const report_table *table);

/**
 * Write the table to a stream. Errors: BASE_ERR_NOMEM. That the stream took the bytes is for the one who opened it
 * to check (base_output_commit).
 *
 * Text: title, caption, aligned columns (widths in terminal cells), notes. CSV: RFC 4180, CRLF line ends, a header
 * row `name` or `name (unit)`, UTF-8 without a mark, rows only. HTML: a <figure class="table"> with title, caption and
 * notes, for any page.
 */
base_status report_table_write_text(const report_table *table, FILE *out, base_error *err);
base_status report_table_write_csv(const report_table *table, FILE *out, base_error *err);
base_status report_table_write_html(const report_table *table, FILE *out, base_error *err);

/**
 * The table as JSON: {"title", "caption"?, "notes"?, "columns": [{"name", "unit", "kind"}], "rows": [[...]]}.
 * @return a new reference for json_decref, or NULL if there is no memory
 */
struct json_t *report_table_json(const report_table *table);

/** A JSON number with no more than `decimals` digits after the point when written by report_json_write. */
struct json_t *report_json_real(double value, int decimals);

/**
 * Write any JSON value: two blanks of indentation, keys in the order in which they were set, reals with at most 15
 * significant digits, a final line feed. Errors: BASE_ERR_NOMEM (also for a NULL value).
 */
base_status report_json_write(const struct json_t *value, FILE *out, base_error *err);

/** report_table_json through report_json_write. */
base_status report_table_write_json(const report_table *table, FILE *out, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
