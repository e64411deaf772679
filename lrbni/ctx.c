#include "lrbni/ctx.h"

#include <stdlib.h>
#include <string.h>

base_status lrb_ctx_create(lrb_event_sink *sink, void *user, lrb_ctx **out, base_error *err)
{
    lrb_ctx *c = calloc(1, sizeof *c);
    if (c) {
        c->sink = sink;
        c->sink_user = user;
        c->events = aligned_alloc(64, LRB_BATCH * sizeof *c->events);
        c->scratch.host = aligned_alloc(64, LRB_SCRATCH_BYTES);
        c->scratch.address = LRB_SCRATCH_ADDRESS;
        c->scratch.size = LRB_SCRATCH_BYTES;
    }
    if (!c || !c->events || !c->scratch.host) {
        lrb_ctx_destroy(&c);
        return base_fail(err, BASE_ERR_NOMEM, "kernel context", "out of memory");
    }
    memset(c->scratch.host, 0, LRB_SCRATCH_BYTES);
    c->events_end = c->events + LRB_BATCH;
    lrb_ctx_set_lines(c, 2, 1);
    lrb_ctx_begin(c);
    *out = c;
    return BASE_OK;
}

void lrb_ctx_destroy(lrb_ctx **c)
{
    if (*c) {
        free((*c)->events);
        free((*c)->scratch.host);
        free(*c);
    }
    *c = NULL;
}

void lrb_ctx_set_lines(lrb_ctx *c, unsigned line_bytes, uint64_t sets)
{
    c->line_bits = (uint32_t)__builtin_ctz(line_bytes);
    c->set_mask = (sets < LRB_TOUCH_SETS ? (uint32_t)sets : LRB_TOUCH_SETS) - 1;
}

void lrb_ctx_begin(lrb_ctx *c)
{
    c->control = (lrb_control){0};
    c->next_event = LRB_FAR;
    c->line = 0;
    c->free_event = c->events;
    memset(c->latest, 0xff, sizeof c->latest); /* scratch memory is another one's, perhaps */
}

/* Hand the batch to the sink. */
static __attribute__((noinline)) void flush(lrb_ctx *c)
{
    uint32_t count = (uint32_t)(c->free_event - c->events);
    c->free_event = c->events;
    if (c->sink && count)
        c->sink(c->sink_user, c->events, count);
}

void lrb_ctx_end(lrb_ctx *c)
{
    flush(c);
    lrb_ctx_begin(c);
}

/* An event has been written at the end of the batch. */
static inline void put(lrb_ctx *c, lrb_event *e)
{
    c->free_event = e + 1;
    if (__builtin_expect(e + 1 == c->events_end, 0))
        flush(c);
}

void lrb_put_marker(lrb_ctx *c, lrb_op_id marker, uint32_t number)
{
    lrb_event *e = c->free_event;
    *e = (lrb_event){.op = (uint16_t)marker, .aux = number};
    put(c, e);
}

/* Distance back from event `id` to the event that made a source; 0 if that was long ago, or there is none. */
static inline uint16_t distance(uint32_t id, uint32_t from)
{
    uint32_t d = id - from;
    return d < LRB_FAR ? (uint16_t)d : 0;
}

uint32_t lrb_put(lrb_ctx *c, uint64_t what, uint32_t s0, uint32_t s1, uint32_t s2, uint32_t s3)
{
    lrb_event *e = c->free_event;
    uint32_t id = c->next_event;
    *e = (lrb_event){.op = (uint16_t)(what >> 32), .mask = (uint16_t)(what >> 48), .aux = (uint32_t)what,
                     .src = {distance(id, s0), distance(id, s1), distance(id, s2), distance(id, s3)}};
    c->next_event = id + 1;
    put(c, e);
    return id;
}

static inline void put_what(lrb_ctx *c, uint64_t what)
{
    lrb_event *e = c->free_event;
    *e = (lrb_event){.op = (uint16_t)(what >> 32), .mask = (uint16_t)(what >> 48), .aux = (uint32_t)what};
    put(c, e);
}

void lrb_put_touch(lrb_ctx *c, uint64_t what)
{
    const uint32_t line = (uint32_t)what >> c->line_bits;
    c->latest[line & c->set_mask] = line;
    put_what(c, what);
}

void lrb_put_hint(lrb_ctx *c, uint64_t what)
{
    c->latest[(uint32_t)what >> c->line_bits & c->set_mask] = UINT32_MAX;
    put_what(c, what);
}

static void mark_far(lrb_ctx *c, uint32_t source, uint32_t from)
{
    if (from && c->next_event - from >= LRB_FAR)
        lrb_put_marker(c, LRB_OP_far, (c->next_event - from) << 2 | source);
}

uint32_t lrb_put_far(lrb_ctx *c, uint64_t what, uint32_t s0, uint32_t s1, uint32_t s2, uint32_t s3)
{
    mark_far(c, 0, s0), mark_far(c, 1, s1), mark_far(c, 2, s2), mark_far(c, 3, s3);
    return lrb_put(c, what, s0, s1, s2, s3);
}

void lrb_at_line(lrb_ctx *c, uint32_t site)
{
    if (c->line != site) {
        c->line = site;
        lrb_put_marker(c, LRB_OP_line, site);
    }
}
