/* The source files that ops come from, as they were when the program was built: what `line` markers point into. */
#ifndef KERNELS_SOURCES_H
#define KERNELS_SOURCES_H

#include <stddef.h>

typedef struct kernel_source {
    unsigned number;  /* LRB_SOURCE */
    const char *path; /* from the top of the source tree: "kernels/slab16.h" */
    const char *text; /* ASCII, `size` bytes and a 0 */
    size_t size;
} kernel_source;

/** All of them; *count entries. */
const kernel_source *kernel_source_list(size_t *count);

/** The source of that number, or NULL. */
const kernel_source *kernel_source_find(unsigned number);

/* A line of a source, without its line feed; points into the text. */
typedef struct kernel_source_line {
    const char *text;
    size_t length;
} kernel_source_line;

/** Number of lines. */
unsigned kernel_source_lines(const kernel_source *source);

/** Line `number`, from 1; text NULL if there is none. */
kernel_source_line kernel_source_at(const kernel_source *source, unsigned number);

/**
 * Name of the function that a line is in: the last one whose body begins, with a brace in the first column, at or before
 * it. The name points into the text; text NULL if there is none.
 */
kernel_source_line kernel_source_function(const kernel_source *source, unsigned number);

#endif
