/* Reads a trace file, tile by tile, in any order and from several threads; no more of the file is in memory than its index and
 * the tiles that are being read. */
#ifndef TRACES_READER_H
#define TRACES_READER_H

#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"

typedef struct trace_reader trace_reader;

/**
 * Open a file and check all but its tiles.
 *
 * Errors: BASE_ERR_INPUT naming the file: it cannot be read, is no trace, of another version, of another set of ops,
 * truncated or damaged; BASE_ERR_IO, BASE_ERR_NOMEM.
 */
base_status trace_reader_open(const char *path, trace_reader **out, base_error *err);

/** Close the file; sets the pointer to NULL. NULL contents are fine. */
void trace_reader_close(trace_reader **r);

/** What the writer was told: of the run at its beginning, and at its end. JSON texts that end in 0; live as long as the reader. */
const char *trace_reader_head_text(const trace_reader *r);
const char *trace_reader_tail_text(const trace_reader *r);

uint32_t trace_reader_tiles(const trace_reader *r);
/** Events of the file and of one tile, markers too. */
uint64_t trace_reader_events(const trace_reader *r);
uint32_t trace_reader_tile_events(const trace_reader *r, uint32_t tile);
/** Bytes of the file. */
uint64_t trace_reader_bytes(const trace_reader *r);

/* Where a thread gets events of tiles from. One thread at a time; any number of sources may use one reader. */
typedef struct trace_source trace_source;

/** @param r  must outlive the source. Errors: BASE_ERR_NOMEM. */
base_status trace_source_create(const trace_reader *r, trace_source **out, base_error *err);
void trace_source_destroy(trace_source **s);

/** Go to the beginning of a tile. Errors: BASE_ERR_INPUT naming file and tile; BASE_ERR_IO, BASE_ERR_NOMEM. */
base_status trace_source_seek(trace_source *s, uint32_t tile, base_error *err);

/**
 * The next events of the tile.
 *
 * @param count  out: how many, at most LRB_BATCH; 0 at the end of the tile
 *
 * Returns them in *events, which belong to the source and hold until its next call. Errors: BASE_ERR_INPUT naming file and tile.
 */
base_status trace_source_next(trace_source *s, const lrb_event **events, uint32_t *count, base_error *err);

/** The same into memory of the caller's, with room for `room` events. */
base_status trace_source_read(trace_source *s, lrb_event *events, uint32_t room, uint32_t *count, base_error *err);

#endif
