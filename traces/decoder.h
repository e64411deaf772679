/* Decodes one tile at a time; for one thread. Bytes from anywhere are decoded to events that every simulator can take, or
 * refused. */
#ifndef TRACES_DECODER_H
#define TRACES_DECODER_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "traces/encoder.h"

typedef struct trace_decoder trace_decoder;

/** Free it with trace_decoder_destroy. Errors: BASE_ERR_NOMEM. */
base_status trace_decoder_create(trace_decoder **out, base_error *err);

/** Sets the pointer to NULL; NULL contents are fine. */
void trace_decoder_destroy(trace_decoder **d);

/**
 * Begin a tile.
 *
 * @param tile  its bytes are not needed afterwards
 * @param what  names the file and the tile in errors; kept until the next tile begins
 *
 * Errors: BASE_ERR_INPUT if this is no tile; BASE_ERR_NOMEM.
 */
base_status trace_decoder_begin(trace_decoder *d, const trace_tile *tile, const char *what, base_error *err);

/** The same from the columns themselves, `size` bytes that must last until the tile's end, and its number of events. */
base_status trace_decoder_begin_plain(trace_decoder *d, unsigned char *columns, size_t size, uint32_t events, const char *what,
                                      base_error *err);

/**
 * Decode the next events of the tile.
 *
 * @param events  out, room for `room` of them
 * @param count   out: how many there are; fewer than `room` only at the end of the tile
 *
 * Errors: BASE_ERR_INPUT if the tile is damaged; what was decoded is then of no use.
 */
base_status trace_decoder_next(trace_decoder *d, lrb_event *events, uint32_t room, uint32_t *count, base_error *err);

#endif
