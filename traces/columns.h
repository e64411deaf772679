/* A tile's differences from what was expected, in columns of like numbers, little-endian (docs/trace-format.md, 'Tiles'). */
#ifndef TRACES_COLUMNS_H
#define TRACES_COLUMNS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "lrbni/base/status.h"

typedef enum trace_column_id {
    TRACE_COLUMN_RUNS,      /* 8 bits: events as expected before the next difference; 255: so many, and no difference yet */
    TRACE_COLUMN_FLAGS,     /* 8 bits: what differs, TRACE_DIFFERS_... */
    TRACE_COLUMN_OPS,       /* 16 bits */
    TRACE_COLUMN_DISTANCES, /* 16 bits */
    TRACE_COLUMN_MASKS,     /* 16 bits */
    TRACE_COLUMN_AUX,       /* 32 bits: what was expected is to be added, modulo 2^32 */
    TRACE_COLUMNS
} trace_column_id;

enum { TRACE_DIFFERS_SOURCE = 1 /* << source */, TRACE_DIFFERS_MASK = 16, TRACE_DIFFERS_AUX = 32, TRACE_DIFFERS_OP = 64 };
enum { TRACE_LONG_RUN = 255 };

#define TRACE_COLUMNS_HEAD (4u * TRACE_COLUMNS) /* bytes of each column, 32 bits each */
#define TRACE_MAX_TILE_BYTES (UINT32_C(1) << 30) /* of a tile's columns together */

/* A column that is being written, or read from `next` up to `end`. */
typedef struct trace_column {
    unsigned char *bytes, *next, *end;
} trace_column;

/** Room for `more` bytes behind what has been written. Errors: BASE_ERR_NOMEM. */
base_status trace_column_reserve(trace_column *c, size_t more);

/** Bytes that have been written. */
static inline size_t trace_column_size(const trace_column *c) { return (size_t)(c->next - c->bytes); }

/** Put `size` bytes of a little-endian number into a column that has room for them. */
static inline void trace_column_put(trace_column *c, uint32_t value, size_t size)
{
    memcpy(c->next, &value, size);
    c->next += size;
}

/** Get one; false if the column has ended. */
static inline bool trace_column_get(trace_column *c, uint32_t *value, size_t size)
{
    if ((size_t)(c->end - c->next) < size)
        return false;
    *value = 0;
    memcpy(value, c->next, size);
    c->next += size;
    return true;
}

#endif
