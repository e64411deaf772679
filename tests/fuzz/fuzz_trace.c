/* libFuzzer target for traces. Inputs that begin with the letter C are a tile's columns, behind its number of events; all others
 * are a whole file. Whatever is accepted must be events that the simulator takes. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "lrbni/ctx.h"
#include "sim/core.h"
#include "sim/issue.h"
#include "traces/decoder.h"
#include "traces/reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_EVENTS = 1 << 16 }; /* of a tile: runs of expected events are long in few bytes */

static sim_issue *issue;
static sim_core *core;
static lrb_event tile[MOST_EVENTS]; /* what has been decoded of it */
static size_t tile_count;
static trace_decoder *decoder;

static void must(base_status status)
{
    if (status != BASE_OK)
        abort();
}

static void set_up(void)
{
    static sim_machine *machine;
    must(sim_machine_load("larrabee", &machine, NULL));
    must(sim_issue_create(machine, &issue, NULL));
    must(sim_core_create(machine, &core, NULL));
    must(trace_decoder_create(&decoder, NULL));
}

static void keep(const lrb_event *events, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if ((events[i].op & LRB_EVENT_ID) >= LRB_OP_COUNT)
            abort();
    if (tile_count + count > MOST_EVENTS)
        abort();
    memcpy(tile + tile_count, events, count * sizeof *events);
    tile_count += count;
}

/* The tile, once. */
static base_status next_tile(void *user, unsigned thread, const lrb_event **events, size_t *count, base_error *err)
{
    bool *given = user;
    (void)thread, (void)err;
    *events = *given ? NULL : tile;
    *count = tile_count;
    *given = true;
    return BASE_OK;
}

static void simulate(void)
{
    uint64_t regions[SIM_MAX_REGIONS + 1];
    bool given = false;
    const sim_core_feed feed = {.next = next_tile, .user = &given};
    sim_issue_begin(issue);
    sim_issue_events(issue, tile, (uint32_t)tile_count);
    sim_issue_end(issue, regions);
    must(sim_core_run(core, &feed, NULL));
}

static void fuzz_columns(const uint8_t *data, size_t size)
{
    lrb_event events[LRB_BATCH];
    uint32_t total, count = 1;
    if (size < sizeof total)
        return;
    memcpy(&total, data, sizeof total);
    size -= sizeof total;
    uint8_t *columns = malloc(size + 1); /* of its own, so that a read behind its end is seen */
    memcpy(columns, data + sizeof total, size);
    base_status status = trace_decoder_begin_plain(decoder, columns, size, total % MOST_EVENTS, "fuzz", NULL);
    tile_count = 0;
    while (status == BASE_OK && count) {
        status = trace_decoder_next(decoder, events, LRB_BATCH, &count, NULL);
        if (status == BASE_OK)
            keep(events, count);
    }
    simulate();
    free(columns);
}

static void fuzz_file(const uint8_t *data, size_t size)
{
    char path[64];
    trace_reader *reader = NULL;
    trace_source *source = NULL;
    int file = memfd_create("fuzz", 0);
    if (file < 0 || write(file, data, size) != (ssize_t)size)
        abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    if (trace_reader_open(path, &reader, NULL) == BASE_OK && trace_source_create(reader, &source, NULL) == BASE_OK) {
        for (uint32_t i = 0; i < trace_reader_tiles(reader); i++) {
            const lrb_event *events;
            uint32_t count = 1;
            base_status status = trace_source_seek(source, i, NULL);
            tile_count = 0;
            while (status == BASE_OK && count && trace_reader_tile_events(reader, i) < MOST_EVENTS) {
                status = trace_source_next(source, &events, &count, NULL);
                if (status == BASE_OK)
                    keep(events, count);
            }
            simulate();
        }
    }
    trace_source_destroy(&source);
    trace_reader_close(&reader);
    close(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!issue)
        set_up();
    if (size && data[0] == 'C')
        fuzz_columns(data + 1, size - 1);
    else
        fuzz_file(data, size);
    return 0;
}
