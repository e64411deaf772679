/* Random tiles of events: any op after any other, sources anywhere, a few hotly contended lines of memory. */
#ifndef TESTS_SIM_RANDOM_STREAM_H
#define TESTS_SIM_RANDOM_STREAM_H

#include <stdint.h>

#include "lrbni/base/random.h"
#include "lrbni/event.h"

/**
 * Fill a tile with events that a kernel could have emitted but for their sense: forms and addresses as the ops allow
 * them, sources up to 65535 ops back, beyond the tile's start as well.
 *
 * @param random  its state decides the tile
 * @param events  out, `count` of them
 */
void random_stream(base_random *random, lrb_event *events, uint32_t count);

#endif
