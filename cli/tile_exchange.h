/* Several readers of one trace, each in a host thread of its own and each from the first tile to the last: a tile is decoded by
 * the first that needs it, and waits for the others. Who runs ahead of the last by too many tiles is held up, so
 * memory stays bounded; not more than so many of the threads run at the same time. */
#ifndef CLI_TILE_EXCHANGE_H
#define CLI_TILE_EXCHANGE_H

#include "traces/reader.h"

typedef struct tile_exchange tile_exchange;

/** @param members  readers that will come. @param jobs  of these that may run at the same time. Errors: BASE_ERR_NOMEM. */
base_status tile_exchange_create(const trace_reader *trace, unsigned members, unsigned jobs, tile_exchange **out, base_error *err);
void tile_exchange_destroy(tile_exchange **x);

/** A member begins to run, and ends: with its last tile, or earlier. */
void tile_exchange_enter(tile_exchange *x);
void tile_exchange_leave(tile_exchange *x, unsigned member);

/**
 * A copy of a member's next tile; tiles are asked for in order.
 *
 * @param source  the member's own
 * @param events  out, room for all events of the tile
 *
 * Errors: those of trace_source_seek and trace_source_read; BASE_ERR_NOMEM.
 */
base_status tile_exchange_take(tile_exchange *x, unsigned member, trace_source *source, uint32_t tile, lrb_event *events,
                               uint32_t *count, base_error *err);

#endif
