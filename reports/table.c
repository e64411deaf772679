#include "reports/table.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reports/table_data.h"

/* Make room for one more element: doubles the array at powers of two. NULL if that fails; the old array stays. */
static void *grow(void *array, size_t count, size_t element_bytes)
{
    if (count & (count - 1))
        return array;
    return reallocarray(array, count ? 2 * count : 1, element_bytes);
}

/* A cleaned copy, with a failure remembered; NULL stays NULL. */
static char *keep_text(report_table *t, const char *text)
{
    char *copy = text ? report_text_clean(text) : NULL;
    if (text && !copy)
        t->no_memory = true;
    return copy;
}

report_table *report_table_create(const char *title)
{
    report_table *t = calloc(1, sizeof *t);
    if (t)
        t->title = keep_text(t, title);
    return t;
}

void report_table_destroy(report_table **table)
{
    report_table *t = *table;
    *table = NULL;
    if (!t)
        return;
    for (size_t i = 0; i < t->notes_count; i++)
        free(t->notes[i]);
    for (size_t i = 0; i < t->groups_count; i++)
        free(t->groups[i].label);
    for (size_t i = 0; i < t->rows_count * t->columns_count; i++)
        free(t->cells[i].text);
    for (size_t i = 0; i < t->columns_count; i++) {
        free(t->columns[i].name);
        free(t->columns[i].unit);
    }
    free(t->title);
    free(t->caption);
    free(t->notes);
    free(t->groups);
    free(t->cells);
    free(t->columns);
    free(t);
}

void report_table_set_caption(report_table *t, const char *caption)
{
    if (!t)
        return;
    free(t->caption);
    t->caption = keep_text(t, caption);
}

void report_table_add_note(report_table *t, const char *note)
{
    if (!t)
        return;
    char *copy = keep_text(t, note);
    char **notes = copy ? grow(t->notes, t->notes_count, sizeof *notes) : NULL;
    if (!notes) {
        free(copy);
        t->no_memory = true;
        return;
    }
    t->notes = notes;
    t->notes[t->notes_count++] = copy;
}

void report_table_add_column(report_table *t, const report_column *column)
{
    assert(column->decimals >= 0 && column->decimals <= REPORT_MAX_DECIMALS);
    if (!t)
        return;
    assert(t->rows_count == 0);
    table_column *columns = grow(t->columns, t->columns_count, sizeof *columns);
    if (!columns) {
        t->no_memory = true;
        return;
    }
    report_align align = column->align;
    if (align == REPORT_ALIGN_AUTO)
        align = column->kind == REPORT_TEXT ? REPORT_ALIGN_LEFT : REPORT_ALIGN_RIGHT;
    t->columns = columns;
    t->columns[t->columns_count++] = (table_column){
        .name = keep_text(t, column->name),
        .unit = keep_text(t, column->unit),
        .kind = column->kind,
        .align = align,
        .decimals = column->decimals,
        .digits = column->digits,
    };
}

void report_table_add_real_column(report_table *t, const char *name, const char *unit, int decimals)
{
    report_table_add_column(t, &(report_column){.name = name, .unit = unit, .kind = REPORT_REAL, .decimals = decimals});
}

void report_table_begin_group(report_table *t, const char *label)
{
    if (!t)
        return;
    table_group *groups = grow(t->groups, t->groups_count, sizeof *groups);
    if (!groups) {
        t->no_memory = true;
        return;
    }
    t->groups = groups;
    t->groups[t->groups_count++] = (table_group){.label = keep_text(t, label), .first_row = t->rows_count};
}

void report_table_begin_row(report_table *t)
{
    if (!t || t->no_memory)
        return;
    assert(t->columns_count > 0);
    size_t row_bytes = t->columns_count * sizeof *t->cells;
    table_cell *cells = grow(t->cells, t->rows_count, row_bytes);
    if (!cells) {
        t->no_memory = true;
        return;
    }
    t->cells = cells;
    memset(&t->cells[t->rows_count * t->columns_count], 0, row_bytes);
    t->rows_count++;
    t->next_cell = 0;
}

/* The next cell of the last row, NULL after a failure that was remembered. */
static table_cell *next_cell(report_table *t)
{
    if (!t || t->no_memory)
        return NULL;
    assert(t->rows_count > 0 && t->next_cell < t->columns_count);
    return &t->cells[(t->rows_count - 1) * t->columns_count + t->next_cell++];
}

static report_kind kind_of_next(const report_table *t)
{
    assert(t->next_cell < t->columns_count);
    return t->columns[t->next_cell].kind;
}

void report_table_add_text(report_table *t, const char *text)
{
    assert(!t || t->no_memory || kind_of_next(t) == REPORT_TEXT);
    table_cell *cell = next_cell(t);
    if (cell && text) {
        cell->text = keep_text(t, text);
        cell->present = cell->text != NULL;
    }
}

void report_table_add_integer(report_table *t, int64_t value)
{
    assert(!t || t->no_memory || kind_of_next(t) == REPORT_INTEGER);
    table_cell *cell = next_cell(t);
    if (cell)
        *cell = (table_cell){.present = true, .integer = value};
}

void report_table_add_real(report_table *t, double value)
{
    assert(!t || t->no_memory || kind_of_next(t) == REPORT_REAL);
    table_cell *cell = next_cell(t);
    if (cell && isfinite(value))
        *cell = (table_cell){.present = true, .real = value};
}

void report_table_add_missing(report_table *t)
{
    next_cell(t); /* rows start with all cells missing */
}

size_t report_table_rows(const report_table *t)
{
    return t ? t->rows_count : 0;
}

const table_group *table_group_at(const report_table *t, size_t row)
{
    for (size_t i = t->groups_count; i-- > 0;)
        if (t->groups[i].first_row == row)
            return &t->groups[i];
    return NULL;
}

bool table_has_labels(const report_table *t)
{
    for (size_t i = 0; i < t->groups_count; i++)
        if (t->groups[i].label)
            return true;
    return false;
}

const char *table_label_of(const report_table *t, size_t row)
{
    for (size_t i = t->groups_count; i-- > 0;)
        if (t->groups[i].first_row <= row)
            return t->groups[i].label;
    return NULL;
}

const char *table_cell_shown(const table_column *column, const table_cell *cell, char number[REPORT_NUMBER_BYTES])
{
    bool grouped = column->digits == REPORT_DIGITS_GROUPED;
    if (!cell->present)
        return "\u2014";
    if (column->kind == REPORT_TEXT)
        return cell->text;
    if (column->digits == REPORT_DIGITS_SCALED)
        report_format_scaled(number, column->kind == REPORT_REAL ? cell->real : (double)cell->integer,
                             column->decimals);
    else if (column->kind == REPORT_REAL)
        report_format_real(number, cell->real, column->decimals, grouped);
    else
        report_format_integer(number, cell->integer, grouped);
    return number;
}

const char *table_cell_exact(const table_column *column, const table_cell *cell, char number[REPORT_NUMBER_BYTES])
{
    if (column->kind == REPORT_TEXT)
        return cell->text;
    if (column->kind == REPORT_REAL)
        report_format_real(number, cell->real, column->decimals, false);
    else
        report_format_integer(number, cell->integer, false);
    return number;
}

base_status table_check(const report_table *t, base_error *err)
{
    if (!t || t->no_memory)
        return base_fail(err, BASE_ERR_NOMEM, t && t->title ? t->title : "table", "out of memory");
    return BASE_OK;
}
