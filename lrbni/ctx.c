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
    c->events_end = c->events + LRB_BATCH;
    memset(c->scratch.host, 0, LRB_SCRATCH_BYTES);
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

void lrb_ctx_begin(lrb_ctx *c)
{
    c->control = (lrb_control){0};
    c->next_event = LRB_FAR;
    c->line = 0;
    c->free_event = c->events;
}

void lrb_ctx_flush(lrb_ctx *c)
{
    uint32_t count = (uint32_t)(c->free_event - c->events);
    c->free_event = c->events;
    if (c->sink && count)
        c->sink(c->sink_user, c->events, count);
}

void lrb_ctx_end(lrb_ctx *c)
{
    lrb_ctx_flush(c);
    lrb_ctx_begin(c);
}
