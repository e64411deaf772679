#include "traces/encoder.h"

#include <stdlib.h>
#include <zstd.h>

#include "traces/columns.h"
#include "traces/predictor.h"

enum { ZSTD_LEVEL = 1 }; /* the columns hold what could not be foreseen: higher levels take longer and find little */

struct trace_encoder {
    trace_predictor predictor;
    trace_column column[TRACE_COLUMNS];
    uint32_t run; /* events as expected since the last difference */
    uint64_t events;
    const char *fault; /* of the first event that cannot be encoded, or NULL */
    base_status status;
    ZSTD_CCtx *zstd;
    trace_column plain, packed;
};

/* Bytes that one event puts into each column at most. */
static const unsigned char most[TRACE_COLUMNS] = {1, 1, 2, 8, 2, 4};

base_status trace_encoder_create(trace_encoder **out, base_error *err)
{
    trace_encoder *e = calloc(1, sizeof *e);
    if (e)
        e->zstd = ZSTD_createCCtx();
    if (!e || !e->zstd) {
        trace_encoder_destroy(&e);
        return base_fail(err, BASE_ERR_NOMEM, "trace encoder", "out of memory");
    }
    *out = e;
    return BASE_OK;
}

void trace_encoder_destroy(trace_encoder **e)
{
    if (*e) {
        for (int i = 0; i < TRACE_COLUMNS; i++)
            free((*e)->column[i].bytes);
        free((*e)->plain.bytes);
        free((*e)->packed.bytes);
        ZSTD_freeCCtx((*e)->zstd);
        free(*e);
    }
    *e = NULL;
}

void trace_encoder_begin(trace_encoder *e)
{
    trace_predictor_begin(&e->predictor);
    for (int i = 0; i < TRACE_COLUMNS; i++)
        e->column[i].next = e->column[i].bytes;
    e->run = 0;
    e->events = 0;
    e->fault = NULL;
    e->status = BASE_OK;
}

/* Put down the sources that differ; returns their flags. */
static unsigned put_sources(trace_encoder *e, trace_site *s, const lrb_event *event)
{
    trace_predictor *p = &e->predictor;
    unsigned flags = 0;
    for (unsigned i = 0; i < TRACE_SOURCES; i++) {
        if (trace_expected_distance(p, s->maker[i]) == event->src[i])
            continue;
        if (!trace_distance_is_good(p, event->src[i])) {
            e->fault = "an event has a source before the beginning of its tile";
            continue;
        }
        flags |= TRACE_DIFFERS_SOURCE << i;
        trace_column_put(&e->column[TRACE_COLUMN_DISTANCES], event->src[i], 2);
        trace_learn_source(p, s, i, event->src[i]);
    }
    return flags;
}

/* Put down how an event differs from what was expected; returns the site that it has come to. */
static trace_site *put_difference(trace_encoder *e, trace_site *s, const lrb_event *event)
{
    trace_predictor *p = &e->predictor;
    unsigned flags = 0;
    if ((event->op & LRB_EVENT_ID) >= LRB_OP_COUNT) {
        e->fault = "an event's op does not exist";
        return s;
    }
    trace_column_put(&e->column[TRACE_COLUMN_RUNS], e->run, 1);
    e->run = 0;
    if (s->op != event->op) {
        flags |= TRACE_DIFFERS_OP;
        trace_column_put(&e->column[TRACE_COLUMN_OPS], event->op, 2);
        s = &p->site[trace_predictor_turn(p, (uint32_t)(s - p->site), event->op)];
    }
    flags |= put_sources(e, s, event);
    uint32_t aux = trace_expected_aux(p, s);
    if (aux != event->aux) {
        flags |= TRACE_DIFFERS_AUX;
        trace_column_put(&e->column[TRACE_COLUMN_AUX], event->aux - aux, 4);
        trace_learn_aux(p, s, event->aux);
    }
    if (trace_expected_mask(p, s) != event->mask) {
        flags |= TRACE_DIFFERS_MASK;
        trace_column_put(&e->column[TRACE_COLUMN_MASKS], event->mask, 2);
        trace_learn_mask(p, s, event->mask);
    }
    trace_column_put(&e->column[TRACE_COLUMN_FLAGS], flags, 1);
    return s;
}

static inline bool as_expected(const trace_predictor *p, const trace_site *s, const lrb_event *e)
{
    uint64_t sources;
    memcpy(&sources, e->src, sizeof sources);
    return ((trace_expected_distances(p, s) ^ sources) | (trace_expected_aux(p, s) ^ e->aux) |
            (unsigned)(trace_expected_mask(p, s) ^ e->mask) | (unsigned)(s->op ^ e->op) | (s->op == TRACE_NO_OP)) == 0;
}

void trace_encoder_events(void *encoder, const lrb_event *events, uint32_t count)
{
    trace_encoder *e = encoder;
    trace_predictor *p = &e->predictor;
    for (int i = 0; i < TRACE_COLUMNS && e->status == BASE_OK; i++)
        e->status = trace_column_reserve(&e->column[i], (size_t)count * most[i]);
    e->events += count;
    if (e->events > UINT32_MAX - LRB_FAR)
        e->fault = "a tile has too many events";
    if (e->status != BASE_OK || e->fault)
        return;
    for (const lrb_event *event = events; event < events + count; event++) {
        trace_site *s = &p->site[p->at];
        if (!as_expected(p, s, event)) {
            s = put_difference(e, s, event);
        } else if (++e->run == TRACE_LONG_RUN) {
            trace_column_put(&e->column[TRACE_COLUMN_RUNS], TRACE_LONG_RUN, 1);
            e->run = 0;
        }
        trace_predictor_advance(p, s, event->mask, event->aux);
    }
}

/* The columns one behind the other, their sizes in front. */
static base_status gather_columns(trace_encoder *e)
{
    size_t size = TRACE_COLUMNS_HEAD;
    for (int i = 0; i < TRACE_COLUMNS; i++)
        size += trace_column_size(&e->column[i]);
    if (size > TRACE_MAX_TILE_BYTES) {
        e->fault = "a tile's differences have more than 1 GiB";
        return BASE_OK;
    }
    e->plain.next = e->plain.bytes;
    base_status status = trace_column_reserve(&e->plain, size);
    for (int i = 0; i < TRACE_COLUMNS && status == BASE_OK; i++)
        trace_column_put(&e->plain, (uint32_t)trace_column_size(&e->column[i]), 4);
    for (int i = 0; i < TRACE_COLUMNS && status == BASE_OK; i++) {
        size = trace_column_size(&e->column[i]);
        if (size) /* nothing may have no address */
            memcpy(e->plain.next, e->column[i].bytes, size);
        e->plain.next += size;
    }
    return status;
}

base_status trace_encoder_end(trace_encoder *e, trace_tile *out, base_error *err)
{
    if (e->status == BASE_OK)
        e->status = trace_column_reserve(&e->column[TRACE_COLUMN_RUNS], 1);
    if (e->status == BASE_OK && e->run) /* those behind the last difference */
        trace_column_put(&e->column[TRACE_COLUMN_RUNS], e->run, 1);
    if (e->status == BASE_OK && !e->fault)
        e->status = gather_columns(e);
    if (e->fault)
        return base_fail(err, BASE_ERR_INPUT, "trace", "%s", e->fault);
    size_t plain_size = trace_column_size(&e->plain), room = ZSTD_compressBound(plain_size), size = 0;
    e->packed.next = e->packed.bytes;
    if (e->status == BASE_OK)
        e->status = trace_column_reserve(&e->packed, room);
    if (e->status == BASE_OK) {
        size = ZSTD_compressCCtx(e->zstd, e->packed.bytes, room, e->plain.bytes, plain_size, ZSTD_LEVEL);
        if (ZSTD_isError(size))
            e->status = BASE_ERR_NOMEM; /* the only way in which it can fail: there is room */
    }
    if (e->status != BASE_OK)
        return base_fail(err, e->status, "trace", "out of memory");
    *out = (trace_tile){.bytes = e->packed.bytes, .size = (uint32_t)size, .plain_size = (uint32_t)plain_size,
                        .events = (uint32_t)e->events};
    return BASE_OK;
}
