/* The export for Chrome's trace viewer and Perfetto: 'X' events, complete with their beginnings and durations. */
#include <inttypes.h>

#include "traces/export_form.h"

/* A JSON string. */
static void write_string(FILE *out, const char *text)
{
    fputc('"', out);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(out, "\\%c", *c);
        else if (*c < 0x20)
            fprintf(out, "\\u%04x", *c);
        else
            fputc(*c, out);
    }
    fputc('"', out);
}

static void begin(trace_export *x, const char *title)
{
    fputs("{\"displayTimeUnit\": \"ns\", \"otherData\": {\"unit\": \"one microsecond is one cycle\"}, \"traceEvents\": [\n", x->out);
    fputs("{\"ph\": \"M\", \"name\": \"process_name\", \"pid\": 0, \"args\": {\"name\": ", x->out);
    write_string(x->out, title);
    fputs("}}", x->out);
    for (unsigned t = 0; t < x->threads; t++)
        fprintf(x->out, ",\n{\"ph\": \"M\", \"name\": \"thread_name\", \"pid\": 0, \"tid\": %u, \"args\": {\"name\": \"hardware thread %u\"}}", t, t);
}

/* The events themselves are too many for a timeline: tiles and phases are in it. */
static void skip_event(trace_export *x, const export_event *e)
{
    (void)x, (void)e;
}

static void write_span(trace_export *x, unsigned thread, uint64_t from)
{
    uint64_t to = x->thread[thread].last;
    fprintf(x->out, ", \"ph\": \"X\", \"pid\": 0, \"tid\": %u, \"ts\": %" PRIu64 ", \"dur\": %" PRIu64, thread, from, to - from);
}

static void end_phase(trace_export *x, unsigned thread)
{
    char text[16];
    fputs(",\n{\"cat\": \"phase\", \"name\": ", x->out);
    write_string(x->out, export_phase_name(x, x->thread[thread].phase, text));
    write_span(x, thread, x->thread[thread].phase_begun);
    fputs("}", x->out);
}

static void end_tile(trace_export *x, unsigned thread)
{
    const export_thread *t = &x->thread[thread];
    fprintf(x->out, ",\n{\"cat\": \"tile\", \"name\": \"tile %" PRIu32 "\"", t->tile);
    write_span(x, thread, t->begun);
    fprintf(x->out, ", \"args\": {\"tile\": %" PRIu32 ", \"ops\": %" PRIu32 "}}", t->tile, t->number);
}

static void end(trace_export *x)
{
    fputs("\n]}\n", x->out);
}

const export_form export_chrome = {.begin = begin, .event = skip_event, .end_phase = end_phase, .end_tile = end_tile, .end = end};
