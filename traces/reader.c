#include "traces/reader.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lrbni/base/hash.h"
#include "lrbni/op_table.h"
#include "traces/columns.h"
#include "traces/format.h"
#include "traces/reader_file.h"

static base_status fail(const trace_reader *r, const char *why, base_error *err)
{
    return base_fail(err, BASE_ERR_INPUT, r->path, "%s", why);
}

base_status trace_reader_read(const trace_reader *r, uint64_t offset, void *out, size_t size, base_error *err)
{
    for (size_t done = 0; done < size;) {
        ssize_t n = pread(r->fd, (char *)out + done, size - done, (off_t)(offset + done));
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return base_fail(err, BASE_ERR_IO, r->path, "cannot be read: %s", strerror(errno));
        if (n == 0)
            return fail(r, "truncated: it has become shorter", err);
        done += (size_t)n;
    }
    return BASE_OK;
}

/* A text of the file, with a 0 behind it. */
static base_status read_text(const trace_reader *r, uint64_t offset, uint32_t size, char **out, base_error *err)
{
    *out = malloc((size_t)size + 1);
    if (!*out)
        return base_fail(err, BASE_ERR_NOMEM, r->path, "out of memory");
    (*out)[size] = 0;
    return trace_reader_read(r, offset, *out, size, err);
}

static base_status read_head(trace_reader *r, trace_head *head, base_error *err)
{
    if (r->bytes < sizeof *head)
        return fail(r, "no trace: too short", err);
    base_status status = trace_reader_read(r, 0, head, sizeof *head, err);
    if (status != BASE_OK)
        return status;
    if (memcmp(head->magic, TRACE_MAGIC, TRACE_MAGIC_BYTES) != 0)
        return fail(r, "no trace: it does not begin like one", err);
    if (head->version != TRACE_VERSION)
        return base_fail(err, BASE_ERR_INPUT, r->path, "a trace of version %" PRIu32 "; this program reads version %u", head->version,
                         TRACE_VERSION);
    if (head->text_bytes > TRACE_MAX_TEXT_BYTES || head->text_bytes > r->bytes - sizeof *head)
        return fail(r, "damaged: its text is too long", err);
    status = read_text(r, sizeof *head, head->text_bytes, &r->head_text, err);
    if (status != BASE_OK)
        return status;
    uint64_t hash = base_hash(BASE_HASH_START, head, offsetof(trace_head, hash));
    if (base_hash(hash, r->head_text, head->text_bytes) != head->hash)
        return fail(r, "damaged: the checksum of its head is wrong", err);
    if (head->ops_hash != lrb_op_table_hash())
        return base_fail(err, BASE_ERR_INPUT, r->path,
                         "recorded with another set of ops (%016" PRIx64 "; this program has %016" PRIx64 ")", head->ops_hash,
                         lrb_op_table_hash());
    r->tiles = head->tiles;
    return BASE_OK;
}

static base_status read_tail(trace_reader *r, trace_tail *tail, base_error *err)
{
    uint64_t end = r->bytes - sizeof *tail, index_size = r->tiles * sizeof(trace_entry);
    if (r->bytes < r->first_tile + sizeof *tail)
        return fail(r, "truncated: it ends in its head", err);
    base_status status = trace_reader_read(r, end, tail, sizeof *tail, err);
    if (status != BASE_OK)
        return status;
    if (memcmp(tail->magic, TRACE_TAIL_MAGIC, TRACE_MAGIC_BYTES) != 0)
        return fail(r, "truncated: it does not end like a trace", err);
    if (tail->text_bytes > TRACE_MAX_TEXT_BYTES || tail->index_offset > end || end - tail->index_offset != index_size + tail->text_bytes)
        return fail(r, "damaged: its index is not where it should be", err);
    r->index = malloc(index_size + 1);
    if (!r->index)
        return base_fail(err, BASE_ERR_NOMEM, r->path, "out of memory for an index of %" PRIu32 " tiles", r->tiles);
    status = trace_reader_read(r, tail->index_offset, r->index, index_size, err);
    if (status == BASE_OK)
        status = read_text(r, end - tail->text_bytes, tail->text_bytes, &r->tail_text, err);
    if (status != BASE_OK)
        return status;
    uint64_t hash = base_hash(base_hash(BASE_HASH_START, r->index, index_size), r->tail_text, tail->text_bytes);
    if (base_hash(hash, tail, offsetof(trace_tail, hash)) != tail->hash)
        return fail(r, "damaged: the checksum of its index is wrong", err);
    r->events = tail->events;
    return BASE_OK;
}

/* Tiles fill the file from its head to its index. */
static base_status check_index(const trace_reader *r, uint64_t index_offset, base_error *err)
{
    uint64_t offset = r->first_tile, events = 0;
    for (uint32_t tile = 0; tile < r->tiles; tile++) {
        const trace_entry *entry = &r->index[tile];
        if (entry->offset != offset || entry->size > index_offset - offset || entry->plain_size > TRACE_MAX_TILE_BYTES ||
            entry->events > TRACE_MAX_TILE_EVENTS)
            return base_fail(err, BASE_ERR_INPUT, r->path, "damaged: the index is wrong for tile %" PRIu32, tile);
        offset += entry->size;
        events += entry->events;
    }
    if (offset != index_offset || events != r->events)
        return fail(r, "damaged: its index does not add up", err);
    return BASE_OK;
}

static base_status open_file(trace_reader *r, base_error *err)
{
    struct stat status;
    r->fd = open(r->path, O_RDONLY | O_CLOEXEC);
    if (r->fd < 0 || fstat(r->fd, &status) != 0)
        return base_fail(err, BASE_ERR_INPUT, r->path, "cannot be read: %s", strerror(errno));
    if (!S_ISREG(status.st_mode))
        return fail(r, "cannot be read: not a file", err);
    r->bytes = (uint64_t)status.st_size;
    return BASE_OK;
}

static base_status read_file(trace_reader *r, base_error *err)
{
    trace_head head;
    trace_tail tail;
    base_status status = open_file(r, err);
    if (status == BASE_OK)
        status = read_head(r, &head, err);
    if (status != BASE_OK)
        return status;
    r->first_tile = sizeof head + head.text_bytes;
    status = read_tail(r, &tail, err);
    return status == BASE_OK ? check_index(r, tail.index_offset, err) : status;
}

base_status trace_reader_open(const char *path, trace_reader **out, base_error *err)
{
    trace_reader *r = calloc(1, sizeof *r);
    if (r) {
        r->fd = -1;
        r->path = strdup(path);
    }
    base_status status = !r || !r->path ? base_fail(err, BASE_ERR_NOMEM, path, "out of memory") : read_file(r, err);
    if (status != BASE_OK)
        trace_reader_close(&r);
    *out = r;
    return status;
}

void trace_reader_close(trace_reader **reader)
{
    trace_reader *r = *reader;
    if (r) {
        if (r->fd >= 0)
            close(r->fd);
        free(r->path);
        free(r->head_text);
        free(r->tail_text);
        free(r->index);
        free(r);
    }
    *reader = NULL;
}

const char *trace_reader_head_text(const trace_reader *r) { return r->head_text; }
const char *trace_reader_tail_text(const trace_reader *r) { return r->tail_text; }
uint32_t trace_reader_tiles(const trace_reader *r) { return r->tiles; }
uint64_t trace_reader_events(const trace_reader *r) { return r->events; }
uint32_t trace_reader_tile_events(const trace_reader *r, uint32_t tile) { return r->index[tile].events; }
uint64_t trace_reader_bytes(const trace_reader *r) { return r->bytes; }
