#include "traces/export.h"

#include <inttypes.h>
#include <stdlib.h>

#include "lrbni/op_table.h"
#include "traces/export_form.h"

const char *const trace_export_names[TRACE_EXPORT_KINDS] = {"konata", "chrome", "csv"};

base_status trace_export_create(trace_export_kind kind, FILE *out, unsigned threads, const char *title, const char *const *phases,
                                unsigned phase_count, trace_export **result, base_error *err)
{
    static const export_form *const forms[TRACE_EXPORT_KINDS] = {&export_konata, &export_chrome, &export_csv};
    trace_export *x = calloc(1, sizeof *x);
    if (x) {
        x->form = forms[kind];
        x->out = out;
        x->threads = threads;
        x->phases = phases;
        x->phase_count = phase_count;
        x->thread = calloc(threads, sizeof *x->thread);
        x->konata.ids = calloc(kind == TRACE_EXPORT_KONATA ? threads * KONATA_REMEMBERED : 1, sizeof *x->konata.ids);
    }
    if (!x || !x->thread || !x->konata.ids) {
        trace_export_destroy(&x);
        return base_fail(err, BASE_ERR_NOMEM, "--export", "out of memory");
    }
    x->form->begin(x, title);
    *result = x;
    return BASE_OK;
}

void trace_export_begin_tile(trace_export *x, unsigned thread, uint32_t tile, uint64_t cycle)
{
    x->thread[thread] = (export_thread){.open = true, .tile = tile, .begun = cycle, .last = cycle, .phase_begun = cycle};
}

static void end_phase(trace_export *x, unsigned thread, uint32_t next)
{
    export_thread *t = &x->thread[thread];
    if (x->form->end_phase && t->last > t->phase_begun)
        x->form->end_phase(x, thread);
    t->phase = next;
    t->phase_begun = t->last;
}

void trace_export_event(trace_export *x, unsigned thread, const lrb_event *event, uint64_t cycle, uint64_t ready, bool in_v)
{
    export_thread *t = &x->thread[thread];
    lrb_op_id id = (lrb_op_id)(event->op & LRB_EVENT_ID);
    export_event e = {.event = *event, .thread = thread, .tile = t->tile, .number = t->number, .before = t->last, .cycle = cycle,
                      .ready = ready, .in_v = in_v, .marker = lrb_op_table[id].class_id == LRB_CLASS_marker};
    if (e.marker) {
        e.cycle = e.ready = t->last;
        if (id == LRB_OP_phase)
            end_phase(x, thread, event->aux);
    }
    x->form->event(x, &e);
    if (!e.marker) {
        t->last = cycle;
        t->number++;
    }
}

void trace_export_end_tile(trace_export *x, unsigned thread)
{
    end_phase(x, thread, 0);
    if (x->form->end_tile)
        x->form->end_tile(x, thread);
    x->thread[thread].open = false;
}

base_status trace_export_finish(trace_export *x, base_error *err)
{
    x->form->end(x);
    return x->out_of_memory ? base_fail(err, BASE_ERR_NOMEM, "--export", "out of memory") : BASE_OK;
}

void trace_export_destroy(trace_export **x)
{
    if (*x) {
        free((*x)->thread);
        free((*x)->konata.heap);
        free((*x)->konata.ids);
        free(*x);
    }
    *x = NULL;
}

const char *export_phase_name(const trace_export *x, uint32_t phase, char text[16])
{
    if (phase < x->phase_count)
        return x->phases[phase];
    snprintf(text, 16, "phase %" PRIu32, phase % 1000000);
    return text;
}

const char *export_form_name(uint16_t op)
{
    static const char *const names[16] = {
        [0] = "",
        [LRB_FORM_SWIZZLE >> 12] = "swizzle",
        [LRB_FORM_MEMORY >> 12] = "memory",
        [LRB_FORM_4_BYTES >> 12] = "4 bytes",
        [LRB_FORM_8_BYTES >> 12] = "8 bytes",
        [LRB_FORM_16_BYTES >> 12] = "16 bytes",
        [LRB_FORM_32_BYTES >> 12] = "32 bytes",
        [(LRB_FORM_MEMORY | LRB_FORM_4_BYTES) >> 12] = "memory 4 bytes",
        [(LRB_FORM_MEMORY | LRB_FORM_8_BYTES) >> 12] = "memory 8 bytes",
        [(LRB_FORM_MEMORY | LRB_FORM_16_BYTES) >> 12] = "memory 16 bytes",
        [(LRB_FORM_MEMORY | LRB_FORM_32_BYTES) >> 12] = "memory 32 bytes",
    };
    const char *name = names[op >> 12];
    return name ? name : "other";
}
