/* Events with the cycles in which a model issued them, in forms that other programs read:
 *
 *   konata  the log of the pipeline viewer Konata, format Kanata 0004 (docs/kanata-log-format.md in its repository)
 *   chrome  JSON of Chrome's trace viewer and of Perfetto: a row for each thread, tiles and in them phases; one microsecond
 *           there is one cycle here
 *   csv     one line for each event
 *
 * Cycles may not go back from one call to the next.
 */
#ifndef TRACES_EXPORT_H
#define TRACES_EXPORT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"

typedef enum trace_export_kind { TRACE_EXPORT_KONATA, TRACE_EXPORT_CHROME, TRACE_EXPORT_CSV, TRACE_EXPORT_KINDS } trace_export_kind;

/** "konata", "chrome", "csv". */
extern const char *const trace_export_names[TRACE_EXPORT_KINDS];

typedef struct trace_export trace_export;

/**
 * Begin an export.
 *
 * @param out      kept until trace_export_finish; its errors are the caller's to find
 * @param threads  hardware threads, at least 1
 * @param title    of what was run, and on which machine
 * @param phases   names of the first `phase_count` phases; kept
 *
 * Errors: BASE_ERR_NOMEM.
 */
base_status trace_export_create(trace_export_kind kind, FILE *out, unsigned threads, const char *title, const char *const *phases,
                                unsigned phase_count, trace_export **x, base_error *err);

/** A thread begins a tile behind this cycle. */
void trace_export_begin_tile(trace_export *x, unsigned thread, uint32_t tile, uint64_t cycle);

/** An event of the tile that the thread is in: an op issues in `cycle`, in V or in U, and its result is ready in `ready`. */
void trace_export_event(trace_export *x, unsigned thread, const lrb_event *event, uint64_t cycle, uint64_t ready, bool in_v);

/** The tile has ended with its last op. */
void trace_export_end_tile(trace_export *x, unsigned thread);

/** Write what is left. Errors: BASE_ERR_NOMEM, also for memory that was missing earlier. */
base_status trace_export_finish(trace_export *x, base_error *err);

/** Sets the pointer to NULL; NULL contents are fine. */
void trace_export_destroy(trace_export **x);

#endif
