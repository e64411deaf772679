/* The export for the pipeline viewer Konata: Kanata 0004. An op waits (W) from the cycle in which the one before it issued, issues
 * in U or V, and executes (X) until its result is ready; arrows come from the makers of its sources.
 *
 * A log cannot go back, but only when an op issues is it known since when it has waited: lines are kept in a heap until
 * no thread can have anything to say of earlier cycles.
 */
#include <inttypes.h>
#include <stdlib.h>

#include "lrbni/op_table.h"
#include "traces/export_form.h"

static bool is_before(const konata_line *a, const konata_line *b)
{
    return a->cycle != b->cycle ? a->cycle < b->cycle : a->order < b->order;
}

static void swap(konata_line *a, konata_line *b)
{
    konata_line kept = *a;
    *a = *b;
    *b = kept;
}

static void push(trace_export *x, konata_line line, uint64_t cycle)
{
    konata_state *k = &x->konata;
    if (k->lines == k->room) {
        size_t room = k->room ? 2 * k->room : 256;
        konata_line *heap = realloc(k->heap, room * sizeof *heap);
        x->out_of_memory |= !heap;
        if (!heap)
            return;
        k->heap = heap;
        k->room = room;
    }
    line.cycle = cycle;
    line.order = k->order++;
    size_t i = k->lines++;
    k->heap[i] = line;
    for (; i > 0 && is_before(&k->heap[i], &k->heap[(i - 1) / 2]); i = (i - 1) / 2)
        swap(&k->heap[i], &k->heap[(i - 1) / 2]);
}

static konata_line pop(konata_state *k)
{
    konata_line first = k->heap[0];
    k->heap[0] = k->heap[--k->lines];
    for (size_t i = 0;;) {
        size_t least = i, left = 2 * i + 1;
        for (size_t child = left; child < left + 2 && child < k->lines; child++)
            least = is_before(&k->heap[child], &k->heap[least]) ? child : least;
        if (least == i)
            return first;
        swap(&k->heap[i], &k->heap[least]);
        i = least;
    }
}

static uint64_t *id_of(trace_export *x, unsigned thread, uint32_t number)
{
    return &x->konata.ids[thread * (size_t)KONATA_REMEMBERED + number % KONATA_REMEMBERED];
}

/* "vmadd231ps 0x00ff [0x00001000 memory 4 bytes]" */
static void write_op(trace_export *x, const lrb_event *e)
{
    lrb_op_id id = (lrb_op_id)(e->op & LRB_EVENT_ID);
    const char *form = export_form_name(e->op);
    fputs(lrb_op_table[id].mnemonic, x->out);
    if (lrb_op_kind_of(id) == LRB_KIND_BRANCH)
        fputs(e->mask & 1 ? " taken" : " not taken", x->out);
    else if (e->mask != 0xffff)
        fprintf(x->out, " 0x%04x", e->mask);
    if (e->op & LRB_FORM_MEMORY || lrb_op_access_of(id) != LRB_ACCESS_NONE)
        fprintf(x->out, " [0x%08" PRIx32 "%s%s]", e->aux, *form ? " " : "", form);
    else if (*form)
        fprintf(x->out, " %s", form);
}

/* Note who makes the op's sources: later their places may belong to other ops. */
static void find_makers(trace_export *x, konata_line *line)
{
    for (int i = 0; i < 4; i++) {
        uint32_t distance = line->e.event.src[i];
        bool remembered = distance && distance <= line->e.number && distance < KONATA_REMEMBERED;
        line->maker[i] = remembered ? *id_of(x, line->e.thread, line->e.number - distance) : KONATA_NOBODY;
    }
}

/* An op begins to wait. */
static void write_begin(trace_export *x, konata_line *line)
{
    const export_event *e = &line->e;
    find_makers(x, line);
    line->id = x->konata.next_id++;
    *id_of(x, e->thread, e->number) = line->id;
    fprintf(x->out, "I\t%" PRIu64 "\t%" PRIu32 "\t%u\nL\t%" PRIu64 "\t0\t", line->id, e->number, e->thread, line->id);
    write_op(x, &e->event);
    fprintf(x->out, "\nL\t%" PRIu64 "\t1\ttile %" PRIu32 ", op %" PRIu32 " (%s), aux 0x%08" PRIx32 "\n", line->id, e->tile, e->number,
            lrb_op_table[e->event.op & LRB_EVENT_ID].id, e->event.aux);
    if (e->before < e->cycle)
        fprintf(x->out, "S\t%" PRIu64 "\t0\tW\n", line->id);
}

/* It issues: its sources have come. */
static void write_issue(trace_export *x, const konata_line *line)
{
    const export_event *e = &line->e;
    if (e->before < e->cycle)
        fprintf(x->out, "E\t%" PRIu64 "\t0\tW\n", line->id);
    fprintf(x->out, "S\t%" PRIu64 "\t0\t%s\n", line->id, e->in_v ? "V" : "U");
    for (int i = 0; i < 4; i++)
        if (line->maker[i] != KONATA_NOBODY)
            fprintf(x->out, "W\t%" PRIu64 "\t%" PRIu64 "\t0\n", line->id, line->maker[i]);
}

static void write_retire(trace_export *x, const konata_line *line)
{
    const char *stage = line->e.ready > line->e.cycle + 1 ? "X" : line->e.in_v ? "V" : "U";
    fprintf(x->out, "E\t%" PRIu64 "\t0\t%s\nR\t%" PRIu64 "\t%" PRIu64 "\t0\n", line->id, stage, line->id, line->id);
}

/* When an op leaves the log: when its result is ready, and not before it has been seen for a cycle. */
static uint64_t retired(const export_event *e)
{
    return e->ready > e->cycle ? e->ready : e->cycle + 1;
}

/* Write what an op has to say of the cycle of its line, and keep what it will have to say later. */
static void write_line(trace_export *x, konata_line line)
{
    const export_event *e = &line.e;
    if (line.cycle > x->konata.cycle)
        fprintf(x->out, "C\t%" PRIu64 "\n", line.cycle - x->konata.cycle);
    x->konata.cycle = line.cycle;
    switch (line.stage) {
    case KONATA_WAIT:
        write_begin(x, &line);
        line.stage = KONATA_ISSUE;
        push(x, line, e->cycle);
        break;
    case KONATA_ISSUE:
        write_issue(x, &line);
        line.stage = e->ready > e->cycle + 1 ? KONATA_EXECUTE : KONATA_RETIRE;
        push(x, line, e->cycle + 1);
        break;
    case KONATA_EXECUTE:
        fprintf(x->out, "E\t%" PRIu64 "\t0\t%s\nS\t%" PRIu64 "\t0\tX\n", line.id, e->in_v ? "V" : "U", line.id);
        line.stage = KONATA_RETIRE;
        push(x, line, retired(e));
        break;
    case KONATA_RETIRE:
        write_retire(x, &line);
        break;
    }
}

/* Write all lines of cycles before `horizon`. */
static void write_before(trace_export *x, uint64_t horizon)
{
    while (x->konata.lines && x->konata.heap[0].cycle < horizon)
        write_line(x, pop(&x->konata));
}

static void begin(trace_export *x, const char *title)
{
    (void)title; /* the log has no place for it */
    fputs("Kanata\t0004\nC=\t0\n", x->out);
}

static void add_event(trace_export *x, const export_event *e)
{
    uint64_t horizon = e->cycle;
    if (e->marker)
        return;
    push(x, (konata_line){.e = *e, .stage = KONATA_WAIT}, e->before);
    for (unsigned t = 0; t < x->threads; t++)
        if (x->thread[t].open && t != e->thread && x->thread[t].last < horizon)
            horizon = x->thread[t].last;
    write_before(x, horizon);
}

static void end(trace_export *x)
{
    write_before(x, UINT64_MAX);
}

const export_form export_konata = {.begin = begin, .event = add_event, .end = end};
