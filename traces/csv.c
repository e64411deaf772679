/* The export of events as lines of comma-separated values. */
#include <inttypes.h>

#include "lrbni/op_table.h"
#include "traces/export_form.h"

static void begin(trace_export *x, const char *title)
{
    (void)title; /* a table has a head, and no place for a title */
    fputs("tile,number,thread,cycle,ready,pipe,op,mnemonic,form,mask,source0,source1,source2,source3,aux\n", x->out);
}

static void write_event(trace_export *x, const export_event *e)
{
    const lrb_op_info *op = &lrb_op_table[e->event.op & LRB_EVENT_ID];
    const uint16_t *src = e->event.src;
    fprintf(x->out, "%" PRIu32 ",%" PRIu32 ",%u,%" PRIu64 ",%" PRIu64 ",%s,%s,%s,%s,0x%04x,%u,%u,%u,%u,0x%08" PRIx32 "\n", e->tile, e->number,
            e->thread, e->cycle, e->ready, e->marker ? "" : e->in_v ? "V" : "U", op->id, op->mnemonic, export_form_name(e->event.op),
            e->event.mask, src[0], src[1], src[2], src[3], e->event.aux);
}

static void end(trace_export *x)
{
    (void)x;
}

const export_form export_csv = {.begin = begin, .event = write_event, .end = end};
