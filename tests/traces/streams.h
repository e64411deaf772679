/* Event streams to record: of the kernels, and random ones. */
#ifndef TESTS_TRACES_STREAMS_H
#define TESTS_TRACES_STREAMS_H

#include <stddef.h>

#include "lrbni/base/random.h"
#include "lrbni/event.h"

/* One tile's events. */
typedef struct stream {
    lrb_event *events;
    size_t count;
} stream;

/* The tiles of a small picture. */
typedef struct stream_set {
    stream *tiles;
    uint32_t count;
    size_t events; /* of all tiles */
} stream_set;

/** Trace builtin:rooms-804 at size x size pixels. A failure ends the program with a message. */
stream_set stream_kernel(const char *kernel, unsigned size);

/** Random events that a kernel could have emitted: no source lies before the tile, markers have none. */
stream stream_random(base_random *random, size_t count);

void stream_free(stream *s);
void stream_set_free(stream_set *set);

#endif
