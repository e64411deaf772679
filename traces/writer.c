#include "traces/writer.h"

#include <assert.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "lrbni/base/hash.h"
#include "lrbni/base/output_file.h"
#include "lrbni/op_table.h"
#include "traces/format.h"

struct trace_writer {
    base_output out;
    uint32_t tiles;
    pthread_mutex_t mutex;   /* guards what follows, and the stream */
    uint32_t next;           /* tile to be written */
    uint64_t offset, events; /* of what has been written */
    trace_entry *index;      /* by tile */
    unsigned char **waiting; /* by tile: bytes that have come before their turn, or NULL */
};

static base_status check_text(const char *path, const char *text, base_error *err)
{
    if (strlen(text) > TRACE_MAX_TEXT_BYTES)
        return base_fail(err, BASE_ERR_INPUT, path, "a text of more than %u bytes does not go into a trace", TRACE_MAX_TEXT_BYTES);
    return BASE_OK;
}

static void write_head(trace_writer *w, const char *text)
{
    trace_head head = {.version = TRACE_VERSION, .text_bytes = (uint32_t)strlen(text), .ops_hash = lrb_op_table_hash(),
                       .tiles = w->tiles};
    memcpy(head.magic, TRACE_MAGIC, TRACE_MAGIC_BYTES);
    head.hash = base_hash(base_hash(BASE_HASH_START, &head, offsetof(trace_head, hash)), text, head.text_bytes);
    fwrite(&head, sizeof head, 1, w->out.stream);
    fwrite(text, 1, head.text_bytes, w->out.stream);
    w->offset = sizeof head + head.text_bytes;
}

base_status trace_writer_create(const char *path, uint32_t tiles, const char *text, trace_writer **out, base_error *err)
{
    base_status status = check_text(path, text, err);
    if (status != BASE_OK)
        return status;
    trace_writer *w = calloc(1, sizeof *w);
    if (w) {
        pthread_mutex_init(&w->mutex, NULL);
        w->tiles = tiles;
        w->index = calloc((size_t)tiles + 1, sizeof *w->index); /* + 1: no tiles need no error */
        w->waiting = calloc((size_t)tiles + 1, sizeof *w->waiting);
    }
    if (!w || !w->index || !w->waiting)
        status = base_fail(err, BASE_ERR_NOMEM, path, "out of memory for a trace of %u tiles", tiles);
    if (status == BASE_OK)
        status = base_output_begin(path, false, &w->out, err);
    if (status != BASE_OK) {
        trace_writer_destroy(&w);
        return status;
    }
    write_head(w, text);
    *out = w;
    return BASE_OK;
}

/* Write the next tile; the mutex is held. */
static void write_tile(trace_writer *w, const unsigned char *bytes)
{
    trace_entry *entry = &w->index[w->next++];
    entry->offset = w->offset;
    fwrite(bytes, 1, entry->size, w->out.stream);
    w->offset += entry->size;
    w->events += entry->events;
}

/* Write a tile, or keep it until those before it have come; the mutex is held. */
static base_status take_tile(trace_writer *w, uint32_t tile, const unsigned char *bytes)
{
    if (tile != w->next) {
        w->waiting[tile] = malloc(w->index[tile].size);
        if (!w->waiting[tile])
            return BASE_ERR_NOMEM;
        memcpy(w->waiting[tile], bytes, w->index[tile].size);
        return BASE_OK;
    }
    write_tile(w, bytes);
    while (w->waiting[w->next]) { /* behind the last tile there is always NULL */
        unsigned char *waiting = w->waiting[w->next];
        w->waiting[w->next] = NULL;
        write_tile(w, waiting);
        free(waiting);
    }
    return BASE_OK;
}

base_status trace_writer_put(trace_writer *w, uint32_t tile, const trace_tile *bytes, base_error *err)
{
    uint64_t hash = base_hash(BASE_HASH_START, bytes->bytes, bytes->size);
    pthread_mutex_lock(&w->mutex);
    assert(tile < w->tiles && w->index[tile].size == 0 && bytes->size > 0);
    w->index[tile] = (trace_entry){.size = bytes->size, .plain_size = bytes->plain_size, .events = bytes->events, .hash = hash};
    base_status status = take_tile(w, tile, bytes->bytes);
    bool failed = ferror(w->out.stream) != 0;
    pthread_mutex_unlock(&w->mutex);
    if (status != BASE_OK)
        return base_fail(err, status, w->out.path, "out of memory for a tile of %u bytes", bytes->size);
    return failed ? base_fail(err, BASE_ERR_IO, w->out.path, "cannot be written") : BASE_OK;
}

base_status trace_writer_commit(trace_writer *w, const char *text, base_error *err)
{
    trace_tail tail = {.index_offset = w->offset, .events = w->events, .text_bytes = (uint32_t)strlen(text)};
    size_t index_size = w->tiles * sizeof *w->index;
    base_status status = check_text(w->out.path, text, err);
    if (status != BASE_OK)
        return status;
    assert(w->next == w->tiles);
    memcpy(tail.magic, TRACE_TAIL_MAGIC, TRACE_MAGIC_BYTES);
    tail.hash = base_hash(BASE_HASH_START, w->index, index_size);
    tail.hash = base_hash(tail.hash, text, tail.text_bytes);
    tail.hash = base_hash(tail.hash, &tail, offsetof(trace_tail, hash));
    fwrite(w->index, 1, index_size, w->out.stream);
    fwrite(text, 1, tail.text_bytes, w->out.stream);
    fwrite(&tail, sizeof tail, 1, w->out.stream);
    return base_output_commit(&w->out, err);
}

void trace_writer_destroy(trace_writer **writer)
{
    trace_writer *w = *writer;
    if (w) {
        base_output_abort(&w->out);
        for (uint32_t tile = 0; w->waiting && tile < w->tiles; tile++)
            free(w->waiting[tile]);
        free(w->waiting);
        free(w->index);
        pthread_mutex_destroy(&w->mutex);
        free(w);
    }
    *writer = NULL;
}
