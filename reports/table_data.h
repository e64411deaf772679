/* What a table holds: for the table's own writers only. */
#ifndef REPORTS_TABLE_DATA_H
#define REPORTS_TABLE_DATA_H

#include <stdbool.h>

#include "reports/table.h"
#include "reports/text.h"

typedef struct table_column {
    char *name, *unit; /* unit may be NULL */
    report_kind kind;
    report_align align; /* never AUTO */
    int decimals;
    report_digits digits;
} table_column;

typedef struct table_cell {
    bool present;
    char *text;
    int64_t integer;
    double real;
} table_cell;

typedef struct table_group {
    char *label;      /* may be NULL */
    size_t first_row; /* the group ends where the next one starts */
} table_group;

struct report_table {
    char *title, *caption; /* caption may be NULL */
    char **notes;
    table_column *columns;
    table_cell *cells; /* rows * columns_count, row after row */
    table_group *groups;
    size_t notes_count, columns_count, rows_count, groups_count;
    size_t next_cell; /* column of the last row that the next cell fills */
    bool no_memory;
};

static inline const table_cell *table_cell_at(const report_table *t, size_t row, size_t column)
{
    return &t->cells[row * t->columns_count + column];
}

/* The group that starts at a row, or NULL. */
const table_group *table_group_at(const report_table *t, size_t row);

/* Whether any group has a label, so that CSV and JSON need a column for it. */
bool table_has_labels(const report_table *t);

/* Label of the group that a row lies in, or NULL. */
const char *table_label_of(const report_table *t, size_t row);

/* A cell as people read it (text, HTML): its text, or `number` filled in; an em dash when missing. */
const char *table_cell_shown(const table_column *column, const table_cell *cell, char number[REPORT_NUMBER_BYTES]);

/* A present cell with all its digits and no separators (CSV). */
const char *table_cell_exact(const table_column *column, const table_cell *cell, char number[REPORT_NUMBER_BYTES]);

/* BASE_OK, or the failure that was remembered while the table was built. */
base_status table_check(const report_table *t, base_error *err);

#endif
