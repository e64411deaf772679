/* Simulated addresses of host memory: of mapped arrays, and of lines in the order of first touch. Private to lanetrace. */
#ifndef LANETRACE_ADDRESSES_H
#define LANETRACE_ADDRESSES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lrbni/memory.h"

enum { ADDRESS_LINE_BYTES = 64 };
#define ADDRESS_UNMAPPED UINT32_C(0x80000000) /* lines of unmapped memory lie from here to the scratch */

/* The arrays that a session has mapped. */
typedef struct address_arrays {
    lrb_memory memory;
    lrb_segment *segments; /* by host address, no two overlap */
    size_t count;
} address_arrays;

/** No arrays; free with address_arrays_free. */
address_arrays address_arrays_empty(void);
void address_arrays_free(address_arrays *a);

/** See lanetrace_map. */
base_status address_arrays_map(address_arrays *a, const char *name, void *host, size_t size, lrb_segment *out, base_error *err);
void address_arrays_unmap(address_arrays *a, const void *host);

/** The array that holds a byte, or NULL. */
const lrb_segment *address_arrays_find(const address_arrays *a, const void *host);

/* The unmapped lines that one piece of work has touched: a hash table of line numbers. */
typedef struct address_lines {
    struct address_line {
        uintptr_t line; /* host address / 64 */
        uint32_t address;
        uint32_t piece; /* the entry is empty unless it is the table's */
    } *entries;
    size_t size;  /* a power of two, or 0 */
    size_t count; /* touched in this piece */
    uint32_t piece;
    base_status status; /* what went wrong in this piece: BASE_ERR_NOMEM or BASE_ERR_INPUT */
} address_lines;

/** Forget all lines: a new piece begins. */
void address_lines_begin(address_lines *lines);

/** Simulated address of a byte; after a failure, which `status` keeps, that of the first line. */
uint32_t address_lines_touch(address_lines *lines, const void *host);

void address_lines_free(address_lines *lines);

#endif
