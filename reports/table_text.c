/* Tables as aligned text:
 *
 *   Title
 *   Caption.
 *
 *   scene      triangles   time
 *                          [ms]
 *   ---------  ---------  -----
 *   rooms-804        804   1.25
 *   hall-60k      60,000      —
 *
 *   Note.
 */
#include <stdlib.h>

#include "reports/table_data.h"

enum { COLUMN_GAP = 2 };

/* Blanks that are owed to the current line; they are only paid when something follows, so no line ends in blanks. */
typedef struct text_line {
    FILE *out;
    int owed;
} text_line;

static void put_field(text_line *line, const char *text, int width, report_align align)
{
    int spare = width - report_text_width(text);
    int before = align == REPORT_ALIGN_RIGHT ? spare : align == REPORT_ALIGN_CENTRE ? spare / 2 : 0;
    line->owed += before;
    if (*text) {
        fprintf(line->out, "%*s%s", line->owed, "", text);
        line->owed = 0;
    }
    line->owed += spare - before + COLUMN_GAP;
}

static void end_line(text_line *line)
{
    fputc('\n', line->out);
    line->owed = 0;
}

static void widen(int *width, const char *text, int extra)
{
    int needed = report_text_width(text) + extra;
    if (needed > *width)
        *width = needed;
}

static int column_width(const report_table *t, size_t column)
{
    const table_column *c = &t->columns[column];
    char number[REPORT_NUMBER_BYTES];
    int width = 0;
    widen(&width, c->name, 0);
    if (c->unit)
        widen(&width, c->unit, 2); /* its brackets */
    for (size_t row = 0; row < t->rows_count; row++)
        widen(&width, table_cell_shown(c, table_cell_at(t, row, column), number), 0);
    return width;
}

static void put_rule(const report_table *t, const int *widths, FILE *out)
{
    for (size_t i = 0; i < t->columns_count; i++) {
        fprintf(out, "%*s", i ? COLUMN_GAP : 0, "");
        for (int k = 0; k < widths[i]; k++)
            fputc('-', out);
    }
    fputc('\n', out);
}

/* The unit in brackets takes the alignment of its column; two fields would need a buffer, so it is padded here. */
static void put_unit(text_line *line, const char *unit, int width, report_align align)
{
    int spare = width - report_text_width(unit) - 2;
    int before = align == REPORT_ALIGN_RIGHT ? spare : align == REPORT_ALIGN_CENTRE ? spare / 2 : 0;
    fprintf(line->out, "%*s[%s]", line->owed + before, "", unit);
    line->owed = spare - before + COLUMN_GAP;
}

static void put_header(const report_table *t, const int *widths, FILE *out)
{
    text_line line = {.out = out};
    bool any_unit = false;
    for (size_t i = 0; i < t->columns_count; i++) {
        put_field(&line, t->columns[i].name, widths[i], t->columns[i].align);
        any_unit = any_unit || t->columns[i].unit;
    }
    end_line(&line);
    for (size_t i = 0; any_unit && i < t->columns_count; i++) {
        if (t->columns[i].unit)
            put_unit(&line, t->columns[i].unit, widths[i], t->columns[i].align);
        else
            put_field(&line, "", widths[i], REPORT_ALIGN_LEFT);
    }
    if (any_unit)
        end_line(&line);
    put_rule(t, widths, out);
}

static void put_row(const report_table *t, const int *widths, size_t row, FILE *out)
{
    text_line line = {.out = out};
    char number[REPORT_NUMBER_BYTES];
    const table_group *group = table_group_at(t, row);
    if (group && group->label)
        fprintf(out, "%s%s\n", row ? "\n" : "", group->label);
    else if (group && row)
        put_rule(t, widths, out);
    for (size_t i = 0; i < t->columns_count; i++) {
        const table_column *c = &t->columns[i];
        put_field(&line, table_cell_shown(c, table_cell_at(t, row, i), number), widths[i], c->align);
    }
    end_line(&line);
}

base_status report_table_write_text(const report_table *t, FILE *out, base_error *err)
{
    base_status status = table_check(t, err);
    if (status != BASE_OK)
        return status;
    int *widths = calloc(t->columns_count + 1, sizeof *widths);
    if (!widths)
        return base_fail(err, BASE_ERR_NOMEM, t->title, "out of memory");
    for (size_t i = 0; i < t->columns_count; i++)
        widths[i] = column_width(t, i);
    fprintf(out, "%s\n", t->title);
    if (t->caption)
        fprintf(out, "%s\n", t->caption);
    fputc('\n', out);
    put_header(t, widths, out);
    for (size_t row = 0; row < t->rows_count; row++)
        put_row(t, widths, row, out);
    if (t->notes_count)
        fputc('\n', out);
    for (size_t i = 0; i < t->notes_count; i++)
        fprintf(out, "%s\n", t->notes[i]);
    free(widths);
    return BASE_OK;
}
