/* libFuzzer target for traces. Inputs that begin with the letter C are a tile's columns, behind its number of events; all others
 * are a whole file. Whatever is accepted must be events that the simulator takes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "lrbni/ctx.h"
#include "sim/issue.h"
#include "traces/decoder.h"
#include "traces/reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_EVENTS = 1 << 22 }; /* of a tile: runs of expected events are long in few bytes */

static sim_issue *issue;
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
    must(trace_decoder_create(&decoder, NULL));
}

static void simulate(const lrb_event *events, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if ((events[i].op & LRB_EVENT_ID) >= LRB_OP_COUNT)
            abort();
    sim_issue_events(issue, events, count);
}

static void fuzz_columns(const uint8_t *data, size_t size)
{
    uint64_t regions[SIM_MAX_REGIONS + 1];
    lrb_event events[LRB_BATCH];
    uint32_t total, count = 1;
    if (size < sizeof total)
        return;
    memcpy(&total, data, sizeof total);
    size -= sizeof total;
    uint8_t *columns = malloc(size + 1); /* of its own, so that a read behind its end is seen */
    memcpy(columns, data + sizeof total, size);
    base_status status = trace_decoder_begin_plain(decoder, columns, size, total % MOST_EVENTS, "fuzz", NULL);
    sim_issue_begin(issue);
    while (status == BASE_OK && count) {
        status = trace_decoder_next(decoder, events, LRB_BATCH, &count, NULL);
        if (status == BASE_OK)
            simulate(events, count);
    }
    sim_issue_end(issue, regions);
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
        for (uint32_t tile = 0; tile < trace_reader_tiles(reader); tile++) {
            uint64_t regions[SIM_MAX_REGIONS + 1];
            const lrb_event *events;
            uint32_t count = 1;
            base_status status = trace_source_seek(source, tile, NULL);
            sim_issue_begin(issue);
            while (status == BASE_OK && count && trace_reader_tile_events(reader, tile) < MOST_EVENTS) {
                status = trace_source_next(source, &events, &count, NULL);
                if (status == BASE_OK)
                    simulate(events, count);
            }
            sim_issue_end(issue, regions);
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
