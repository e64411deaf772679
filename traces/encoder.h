/* Encodes one tile's events at a time; for one thread. */
#ifndef TRACES_ENCODER_H
#define TRACES_ENCODER_H

#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"

/* A tile as the file has it. */
typedef struct trace_tile {
    const unsigned char *bytes; /* a zstd frame of the columns */
    uint32_t size, plain_size;  /* of the frame, and of the columns in it */
    uint32_t events;            /* markers too */
} trace_tile;

typedef struct trace_encoder trace_encoder;

/** Free it with trace_encoder_destroy. Errors: BASE_ERR_NOMEM. */
base_status trace_encoder_create(trace_encoder **out, base_error *err);

/** Sets the pointer to NULL; NULL contents are fine. */
void trace_encoder_destroy(trace_encoder **e);

/** Begin a tile. */
void trace_encoder_begin(trace_encoder *e);

/** Take the next events of the tile. Has the signature of lrb_event_sink; `e` is the trace_encoder. Errors wait for the end. */
void trace_encoder_events(void *e, const lrb_event *events, uint32_t count);

/**
 * End the tile.
 *
 * @param out  its bytes belong to the encoder, and hold until the next tile ends
 *
 * Errors: BASE_ERR_NOMEM; BASE_ERR_INPUT for events that no kernel emits (an op that does not exist, a source before
 * the tile) and for tiles beyond the limits of the format.
 */
base_status trace_encoder_end(trace_encoder *e, trace_tile *out, base_error *err);

#endif
