#include "traces/decoder.h"

#include <stdlib.h>
#include <zstd.h>

#include "traces/columns.h"
#include "traces/predictor.h"

struct trace_decoder {
    trace_predictor predictor;
    trace_column column[TRACE_COLUMNS];
    uint32_t run;    /* events as expected that are still to come */
    bool difference; /* and behind them comes one that differs */
    uint32_t left;   /* events of the tile that are still to come */
    const char *what;
    ZSTD_DCtx *zstd;
    trace_column plain;
};

base_status trace_decoder_create(trace_decoder **out, base_error *err)
{
    trace_decoder *d = calloc(1, sizeof *d);
    if (d)
        d->zstd = ZSTD_createDCtx();
    if (!d || !d->zstd) {
        trace_decoder_destroy(&d);
        return base_fail(err, BASE_ERR_NOMEM, "trace decoder", "out of memory");
    }
    *out = d;
    return BASE_OK;
}

void trace_decoder_destroy(trace_decoder **d)
{
    if (*d) {
        free((*d)->plain.bytes);
        ZSTD_freeDCtx((*d)->zstd);
        free(*d);
    }
    *d = NULL;
}

static base_status damaged(const trace_decoder *d, const char *why, base_error *err)
{
    return base_fail(err, BASE_ERR_INPUT, d->what, "damaged: %s", why);
}

base_status trace_decoder_begin(trace_decoder *d, const trace_tile *tile, const char *what, base_error *err)
{
    d->what = what;
    if (tile->plain_size > TRACE_MAX_TILE_BYTES)
        return damaged(d, "a tile of more than 1 GiB", err);
    d->plain.next = d->plain.bytes;
    if (trace_column_reserve(&d->plain, tile->plain_size) != BASE_OK)
        return base_fail(err, BASE_ERR_NOMEM, what, "out of memory for a tile of %u bytes", tile->plain_size);
    size_t size = ZSTD_decompressDCtx(d->zstd, d->plain.bytes, tile->plain_size, tile->bytes, tile->size);
    if (ZSTD_isError(size) || size != tile->plain_size)
        return damaged(d, ZSTD_isError(size) ? ZSTD_getErrorName(size) : "a tile of another size", err);
    return trace_decoder_begin_plain(d, d->plain.bytes, size, tile->events, what, err);
}

base_status trace_decoder_begin_plain(trace_decoder *d, unsigned char *columns, size_t size, uint32_t events, const char *what,
                                      base_error *err)
{
    trace_column head = {.next = columns, .end = columns + size};
    d->what = what;
    if (size < TRACE_COLUMNS_HEAD || events > UINT32_MAX - LRB_FAR)
        return damaged(d, "no tile", err);
    unsigned char *next = columns + TRACE_COLUMNS_HEAD;
    for (int i = 0; i < TRACE_COLUMNS; i++) {
        uint32_t bytes;
        if (!trace_column_get(&head, &bytes, 4) || bytes > (size_t)(columns + size - next))
            return damaged(d, "a column ends behind its tile", err);
        d->column[i] = (trace_column){.next = next, .end = next + bytes};
        next += bytes;
    }
    if (next != columns + size)
        return damaged(d, "bytes behind the last column", err);
    if (events > (uint64_t)TRACE_LONG_RUN * (size_t)(d->column[TRACE_COLUMN_RUNS].end - d->column[TRACE_COLUMN_RUNS].next))
        return damaged(d, "more events than its runs can have", err);
    trace_predictor_begin(&d->predictor);
    d->run = 0;
    d->difference = false;
    d->left = events;
    return BASE_OK;
}

/* Read how many events are as expected, once those of the last run are through. */
static bool get_run(trace_decoder *d)
{
    if (!trace_column_get(&d->column[TRACE_COLUMN_RUNS], &d->run, 1))
        return false;
    d->difference = d->run < TRACE_LONG_RUN;
    return true;
}

/* The sources of an event that differs: as expected, or read. */
static bool get_sources(trace_decoder *d, trace_site *s, uint32_t flags, lrb_event *event)
{
    trace_predictor *p = &d->predictor;
    for (unsigned i = 0; i < TRACE_SOURCES; i++) {
        uint32_t distance = trace_expected_distance(p, s->maker[i]);
        if (flags & TRACE_DIFFERS_SOURCE << i) {
            if (!trace_column_get(&d->column[TRACE_COLUMN_DISTANCES], &distance, 2) ||
                !trace_distance_is_good(p, (uint16_t)distance))
                return false;
            trace_learn_source(p, s, i, (uint16_t)distance);
        }
        event->src[i] = (uint16_t)distance;
    }
    return true;
}

/* Decode an event that differs from what was expected; false if there is no such event. */
static bool get_difference(trace_decoder *d, lrb_event *event)
{
    trace_predictor *p = &d->predictor;
    trace_site *s = &p->site[p->at];
    uint32_t flags, op = s->op, aux = 0, mask;
    if (!trace_column_get(&d->column[TRACE_COLUMN_FLAGS], &flags, 1))
        return false;
    if (flags & TRACE_DIFFERS_OP) {
        if (!trace_column_get(&d->column[TRACE_COLUMN_OPS], &op, 2) || (op & LRB_EVENT_ID) >= LRB_OP_COUNT)
            return false;
        s = &p->site[trace_predictor_turn(p, p->at, (uint16_t)op)];
    }
    if (op == TRACE_NO_OP || !get_sources(d, s, flags, event))
        return false;
    if (flags & TRACE_DIFFERS_AUX && !trace_column_get(&d->column[TRACE_COLUMN_AUX], &aux, 4))
        return false;
    event->aux = trace_expected_aux(p, s) + aux;
    if (flags & TRACE_DIFFERS_AUX)
        trace_learn_aux(p, s, event->aux);
    mask = trace_expected_mask(p, s);
    if (flags & TRACE_DIFFERS_MASK) {
        if (!trace_column_get(&d->column[TRACE_COLUMN_MASKS], &mask, 2))
            return false;
        trace_learn_mask(p, s, (uint16_t)mask);
    }
    event->op = (uint16_t)op;
    event->mask = (uint16_t)mask;
    trace_predictor_advance(p, s, event->mask, event->aux);
    return true;
}

/* Decode `count` events that are as expected; false if nothing is expected. */
static bool get_expected(trace_predictor *p, lrb_event *events, uint32_t count)
{
    for (lrb_event *event = events; event < events + count; event++) {
        trace_site *s = &p->site[p->at];
        uint64_t sources = trace_expected_distances(p, s);
        event->op = s->op;
        event->mask = trace_expected_mask(p, s);
        memcpy(event->src, &sources, sizeof sources);
        event->aux = trace_expected_aux(p, s);
        if (s->op == TRACE_NO_OP)
            return false;
        trace_predictor_advance(p, s, event->mask, event->aux);
    }
    return true;
}

/* Whether the tile ends where its columns do. */
static bool all_read(const trace_decoder *d)
{
    for (int i = 0; i < TRACE_COLUMNS; i++)
        if (d->column[i].next != d->column[i].end)
            return false;
    return d->run == 0;
}

base_status trace_decoder_next(trace_decoder *d, lrb_event *events, uint32_t room, uint32_t *count, base_error *err)
{
    uint32_t wanted = room < d->left ? room : d->left, done = 0;
    while (done < wanted) {
        bool good = true;
        if (d->run) {
            uint32_t run = d->run < wanted - done ? d->run : wanted - done;
            good = get_expected(&d->predictor, events + done, run);
            d->run -= run;
            done += run;
        } else if (d->difference) {
            good = get_difference(d, events + done++);
            d->difference = false;
        } else {
            good = get_run(d);
        }
        if (!good)
            return damaged(d, "events that cannot be", err);
    }
    d->left -= done;
    *count = done;
    if (d->left == 0 && !all_read(d))
        return damaged(d, "more differences than events", err);
    return BASE_OK;
}
