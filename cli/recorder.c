#include "cli/recorder.h"

#include <stdlib.h>
#include <string.h>

#include "sim/spill.h"

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

base_status recorder_create(const recorder_input *input, const sim_machine *machine, unsigned worker, recorder *out, base_error *err)
{
    *out = (recorder){.input = input, .worker = worker};
    base_status status = input->sampled ? BASE_OK : sim_chain_meter_create(machine, &out->meter, err);
    if (status == BASE_OK && input->registers)
        status = sim_registers_create(sim_file_registers, &out->registers, err);
    if (status != BASE_OK)
        return status;
    return input->replayed ? trace_source_create(input->replayed, &out->source, err) : lrb_ctx_create(append, out, &out->ctx, err);
}

void recorder_destroy(recorder *r)
{
    lrb_ctx_destroy(&r->ctx);
    trace_source_destroy(&r->source);
    sim_chain_meter_destroy(&r->meter);
    sim_registers_destroy(&r->registers);
}

static base_status out_of_memory(base_error *err)
{
    return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory for the events of a tile");
}

static base_status read_tile(recorder *r, uint32_t tile, recording *into, base_error *err)
{
    const recorder_input *input = r->input;
    const uint32_t size = trace_reader_tile_events(input->replayed, tile);
    uint32_t count = 0;
    base_status status = input->exchange ? BASE_OK : trace_source_seek(r->source, tile, err);
    if (status == BASE_OK && !grow(into, size))
        return out_of_memory(err);
    if (status == BASE_OK && input->exchange)
        status = tile_exchange_take(input->exchange, input->member, r->source, tile, into->events, &count, err);
    else if (status == BASE_OK)
        status = trace_source_read(r->source, into->events, size, &count, err);
    into->count = count;
    return status;
}

/* Give a recorded tile to the trace. */
static void record_trace(const recorder *r, uint32_t tile, const recording *recorded)
{
    run_trace *trace = r->input->trace;
    run_trace_begin_tile(trace, r->worker);
    for (size_t i = 0; i < recorded->count; i += LRB_BATCH) {
        size_t count = recorded->count - i;
        trace_encoder_events(trace->workers[r->worker].encoder, recorded->events + i, (uint32_t)(count < LRB_BATCH ? count : LRB_BATCH));
    }
    run_trace_end_tile(trace, r->worker, tile);
}

/* What registers the tile needs; what does not fit is spilled, among its events. */
static base_status fit_registers(recorder *r, recording *into, base_error *err)
{
    size_t spill_count = 0;
    sim_registers_events(r->registers, into->events, (uint32_t)into->count);
    base_status status = sim_registers_end(r->registers, err);
    const sim_spill *spills = sim_registers_spills(r->registers, &spill_count);
    if (status != BASE_OK || spill_count == 0)
        return status;
    recording spilled = {0};
    status = sim_spill_events(into->events, into->count, spills, spill_count, &spilled.events, &spilled.count, err);
    if (status != BASE_OK)
        return status;
    spilled.capacity = spilled.count;
    recording_free(into);
    *into = spilled;
    return BASE_OK;
}

static base_status record_tile(recorder *r, uint32_t tile, recording *into, base_error *err)
{
    const recorder_input *input = r->input;
    kernel_counts counts = {{0}};
    lrb_ctx_begin(r->ctx);
    (input->annotated ? input->kernel->annotated : input->kernel->tile[LRB_RECORD])(r->ctx, input->job, tile, &counts);
    lrb_ctx_end(r->ctx);
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++)
        r->counts.n[i] += counts.n[i];
    if (input->tile_counts)
        input->tile_counts[tile] = counts;
    if (into->failed)
        return out_of_memory(err);
    if (input->trace && input->trace->writer)
        record_trace(r, tile, into);
    return r->registers ? fit_registers(r, into, err) : BASE_OK;
}

base_status recorder_tile(recorder *r, size_t tile, recording *into, base_error *err)
{
    r->into = into;
    into->count = 0;
    into->failed = !grow(into, 1);
    base_status status = r->source ? read_tile(r, (uint32_t)tile, into, err) : record_tile(r, (uint32_t)tile, into, err);
    if (status == BASE_OK && r->meter)
        sim_chain_meter_tile(r->meter, into->events, into->count, &r->chains);
    return status;
}
