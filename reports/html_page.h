/* One plain HTML page that holds everything it shows: no scripts, no links to other files, pictures inside. */
#ifndef REPORTS_HTML_PAGE_H
#define REPORTS_HTML_PAGE_H

#include <stddef.h>
#include <stdio.h>

#include "lrbni/base/status.h"
#include "reports/table.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct report_page report_page;

/* A picture of a page. */
typedef struct report_figure {
    const char *path;    /* a .png file, read at once and stored in the page */
    const char *alt;     /* what a reader who cannot see it should know; not NULL */
    const char *caption; /* NULL for none */
} report_figure;

/**
 * An empty page. Text is UTF-8 and always taken literally: nothing in it acts as HTML. Calls that return nothing
 * remember a lack of memory, and report_page_write then returns BASE_ERR_NOMEM.
 *
 * @return NULL if there is no memory; every function below accepts that NULL
 */
report_page *report_page_create(const char *title);

/** Free a page and set the pointer to NULL. */
void report_page_destroy(report_page **page);

/** A heading: level 1 starts a section (listed at the top of the page if there are three or more), 2 a subsection. */
void report_page_add_heading(report_page *page, int level, const char *text);

void report_page_add_paragraph(report_page *page, const char *text);

/** Lines in a typewriter face, line breaks kept: a command, a file. */
void report_page_add_code(report_page *page, const char *text);

/** A table with its title, caption and notes. Errors: BASE_ERR_NOMEM. */
base_status report_page_add_table(report_page *page, const report_table *table, base_error *err);

/**
 * Pictures side by side, as many in a row as fit; one alone takes the width it needs.
 *
 * Errors: BASE_ERR_INPUT naming the file (cannot be read, no PNG), BASE_ERR_NOMEM. On failure nothing is added.
 */
base_status report_page_add_pictures(report_page *page, const report_figure *figures, size_t count, base_error *err);

/**
 * Write the whole page. The same calls and files give the same bytes. Errors: BASE_ERR_NOMEM; write errors are for
 * the owner of the stream to find (base_output_commit).
 */
base_status report_page_write(report_page *page, FILE *out, base_error *err);

#ifdef __cplusplus
}
#endif
#endif
