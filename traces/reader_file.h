/* An open trace file: for the reader and its sources only. */
#ifndef TRACES_READER_FILE_H
#define TRACES_READER_FILE_H

#include <stddef.h>

#include "traces/format.h"
#include "traces/reader.h"

struct trace_reader {
    int fd;
    char *path;
    uint64_t bytes, events;
    uint64_t first_tile; /* where the first tile begins */
    uint32_t tiles;
    char *head_text, *tail_text;
    trace_entry *index; /* by tile, checked */
};

/** Read `size` bytes at `offset`; any thread. Errors: BASE_ERR_INPUT if the file ends before, BASE_ERR_IO. */
base_status trace_reader_read(const trace_reader *r, uint64_t offset, void *out, size_t size, base_error *err);

#endif
