/* Tiles recorded ahead of a simulated core, in order, by other host threads: at most so many tiles ahead that memory stays
 * bounded. What the core sees does not depend on who recorded it, or when. */
#ifndef CLI_RECORD_AHEAD_H
#define CLI_RECORD_AHEAD_H

#include "cli/recorder.h"

typedef struct record_ahead record_ahead;

/**
 * Start recording tiles first, first + 1, ... end - 1 on host threads of its own.
 *
 * @param recorders  `count` of them, one a host thread; owned by the caller, who leaves them alone until record_ahead_stop
 * @param held       recordings that the consumer may hold at the same time
 *
 * Errors: BASE_ERR_NOMEM, also if the host has no thread to give.
 */
base_status record_ahead_start(recorder *recorders, unsigned count, size_t first, size_t end, unsigned held, record_ahead **out,
                               base_error *err);

/** Wait for a tile; tiles are asked for in order. Errors: those of recorder_tile. */
base_status record_ahead_take(record_ahead *a, size_t tile, recording **out, base_error *err);

/** Give a recording back. */
void record_ahead_release(record_ahead *a, recording *r);

/** End the threads and free everything; sets the pointer to NULL, which it may be. */
void record_ahead_stop(record_ahead **a);

#endif
