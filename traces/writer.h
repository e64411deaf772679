/* Writes a trace file. Tiles may come from several threads and in any order: the file is the same, byte for byte. */
#ifndef TRACES_WRITER_H
#define TRACES_WRITER_H

#include <stdint.h>

#include "lrbni/base/status.h"
#include "traces/encoder.h"

typedef struct trace_writer trace_writer;

/**
 * Begin a file beside its final name.
 *
 * @param tiles  that will be put, each once
 * @param text   JSON: what was run; at most 1 MiB; not kept
 * @param out    free with trace_writer_destroy
 *
 * Errors: those of base_output_begin; BASE_ERR_INPUT for a text that is too long; BASE_ERR_NOMEM.
 */
base_status trace_writer_create(const char *path, uint32_t tiles, const char *text, trace_writer **out, base_error *err);

/**
 * Put one tile. Any thread may call this. Tiles that come before their turn are kept in memory, compressed.
 *
 * Errors: BASE_ERR_IO naming the file; BASE_ERR_NOMEM.
 */
base_status trace_writer_put(trace_writer *w, uint32_t tile, const trace_tile *bytes, base_error *err);

/**
 * Finish the file once all tiles have been put, and rename it. Only trace_writer_destroy is left to be called then.
 *
 * @param text  JSON: what the run counted; at most 1 MiB; not kept
 *
 * Errors: those of base_output_commit; BASE_ERR_INPUT for a text that is too long.
 */
base_status trace_writer_commit(trace_writer *w, const char *text, base_error *err);

/** Free a writer; a file that was not committed is gone. Sets the pointer to NULL; NULL contents are fine. */
void trace_writer_destroy(trace_writer **w);

#endif
