/* Sources: the part of the reader that a thread has for itself. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "lrbni/base/hash.h"
#include "lrbni/ctx.h"
#include "traces/columns.h"
#include "traces/decoder.h"
#include "traces/reader.h"
#include "traces/reader_file.h"

struct trace_source {
    const trace_reader *reader;
    trace_decoder *decoder;
    trace_column packed; /* the tile as in the file */
    lrb_event *events;   /* LRB_BATCH of them */
    char what[300];      /* file and tile, for errors */
};

base_status trace_source_create(const trace_reader *r, trace_source **out, base_error *err)
{
    trace_source *s = calloc(1, sizeof *s);
    base_status status = s ? trace_decoder_create(&s->decoder, err) : base_fail(err, BASE_ERR_NOMEM, r->path, "out of memory");
    if (status == BASE_OK) {
        s->reader = r;
        s->events = malloc(LRB_BATCH * sizeof *s->events);
        if (!s->events)
            status = base_fail(err, BASE_ERR_NOMEM, r->path, "out of memory");
    }
    if (status != BASE_OK)
        trace_source_destroy(&s);
    *out = s;
    return status;
}

void trace_source_destroy(trace_source **source)
{
    if (*source) {
        trace_decoder_destroy(&(*source)->decoder);
        free((*source)->packed.bytes);
        free((*source)->events);
        free(*source);
    }
    *source = NULL;
}

base_status trace_source_seek(trace_source *s, uint32_t tile, base_error *err)
{
    const trace_entry *entry = &s->reader->index[tile];
    snprintf(s->what, sizeof s->what, "%.256s, tile %" PRIu32, s->reader->path, tile);
    s->packed.next = s->packed.bytes;
    if (trace_column_reserve(&s->packed, entry->size) != BASE_OK)
        return base_fail(err, BASE_ERR_NOMEM, s->what, "out of memory for %" PRIu32 " bytes", entry->size);
    base_status status = trace_reader_read(s->reader, entry->offset, s->packed.bytes, entry->size, err);
    if (status != BASE_OK)
        return status;
    if (base_hash(BASE_HASH_START, s->packed.bytes, entry->size) != entry->hash)
        return base_fail(err, BASE_ERR_INPUT, s->what, "damaged: its checksum is wrong");
    trace_tile bytes = {.bytes = s->packed.bytes, .size = entry->size, .plain_size = entry->plain_size, .events = entry->events};
    return trace_decoder_begin(s->decoder, &bytes, s->what, err);
}

base_status trace_source_next(trace_source *s, const lrb_event **events, uint32_t *count, base_error *err)
{
    *events = s->events;
    return trace_decoder_next(s->decoder, s->events, LRB_BATCH, count, err);
}

base_status trace_source_read(trace_source *s, lrb_event *events, uint32_t room, uint32_t *count, base_error *err)
{
    return trace_decoder_next(s->decoder, events, room, count, err);
}
