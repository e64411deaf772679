#include "cli/recorder.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_EVENTS = 1 << 16 };

void recording_free(recording *r)
{
    free(r->events);
    *r = (recording){0};
}

/* Room for `count` more events. */
static bool grow(recording *r, size_t count)
{
    size_t capacity = r->capacity ? r->capacity : FIRST_EVENTS;
    while (capacity - r->count < count)
        capacity *= 2;
    if (capacity == r->capacity)
        return true;
    lrb_event *events = realloc(r->events, capacity * sizeof *events);
    if (!events)
        return false;
    r->events = events;
    r->capacity = capacity;
    return true;
}

static void append(void *user, const lrb_event *events, uint32_t count)
{
    recording *r = ((recorder *)user)->into;
    r->failed |= !grow(r, count);
    if (r->failed)
        return;
    memcpy(r->events + r->count, events, count * sizeof *events);
    r->count += count;
}

base_status recorder_create(const kernel_info *kernel, const kernel_job *job, const sim_machine *machine, kernel_counts *tile_counts,
                            recorder *out, base_error *err)
{
    *out = (recorder){.kernel = kernel, .job = job, .tile_counts = tile_counts};
    base_status status = sim_chain_meter_create(machine, &out->meter, err);
    return status == BASE_OK ? lrb_ctx_create(append, out, &out->ctx, err) : status;
}

void recorder_destroy(recorder *r)
{
    lrb_ctx_destroy(&r->ctx);
    sim_chain_meter_destroy(&r->meter);
}

base_status recorder_tile(recorder *r, size_t tile, recording *into, base_error *err)
{
    kernel_counts counts = {{0}};
    r->into = into;
    into->count = 0;
    into->failed = !grow(into, 1);
    lrb_ctx_begin(r->ctx);
    r->kernel->tile[LRB_RECORD](r->ctx, r->job, (uint32_t)tile, &counts);
    lrb_ctx_end(r->ctx);
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        r->counts.n[i] += counts.n[i];
    if (r->tile_counts)
        r->tile_counts[tile] = counts;
    if (!into->failed)
        sim_chain_meter_tile(r->meter, into->events, into->count, &r->chains);
    return into->failed ? base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory for the events of a tile") : BASE_OK;
}
