/* What the forms of an export share: for export.c and the forms only. */
#ifndef TRACES_EXPORT_FORM_H
#define TRACES_EXPORT_FORM_H

#include "traces/export.h"

/* Where a hardware thread is. */
typedef struct export_thread {
    bool open;       /* it is in a tile */
    uint32_t tile;
    uint64_t begun;  /* cycle behind which the tile begins */
    uint64_t last;   /* cycle in which the thread issued last, in this tile; or begun */
    uint32_t number; /* of the next op in the tile */
    uint32_t phase;
    uint64_t phase_begun;
} export_thread;

/* An event as it is exported. */
typedef struct export_event {
    lrb_event event;
    unsigned thread;
    uint32_t tile, number;         /* of the op in its tile; of a marker: of the op behind it */
    uint64_t before, cycle, ready; /* before: when the op before it issued */
    bool in_v, marker;
} export_event;

struct trace_export;

typedef struct export_form {
    void (*begin)(trace_export *x, const char *title);
    void (*event)(trace_export *x, const export_event *e);
    void (*end_phase)(trace_export *x, unsigned thread); /* or NULL; at a phase's marker and at the end of a tile, before ... */
    void (*end_tile)(trace_export *x, unsigned thread);  /* ... this, or NULL */
    void (*end)(trace_export *x);
} export_form;

extern const export_form export_konata, export_chrome, export_csv;

typedef enum konata_stage { KONATA_WAIT, KONATA_ISSUE, KONATA_EXECUTE, KONATA_RETIRE } konata_stage;

/* An op that Konata's log has still something to say of. */
typedef struct konata_line {
    export_event e;
    konata_stage stage; /* that begins next */
    uint64_t cycle; /* when */
    uint64_t order; /* of lines of the same cycle */
    uint64_t id;    /* in the log, once it has begun */
    uint64_t maker[4]; /* ids of those that made its sources, once it has begun; KONATA_NOBODY: long ago */
} konata_line;

/* Ops under way, for Konata's log, whose lines must be in the order of their cycles. */
typedef struct konata_state {
    konata_line *heap; /* the earliest line first */
    size_t lines, room;
    uint64_t order, next_id, cycle;
    uint64_t *ids; /* by thread and number of the op modulo KONATA_REMEMBERED */
} konata_state;
enum { KONATA_REMEMBERED = 4096 };
#define KONATA_NOBODY UINT64_MAX

struct trace_export {
    const export_form *form;
    FILE *out;
    unsigned threads;
    export_thread *thread;
    const char *const *phases;
    unsigned phase_count;
    bool out_of_memory;
    konata_state konata;
};

/** Name of a phase, or "phase 17" in `text`. */
const char *export_phase_name(const trace_export *x, uint32_t phase, char text[16]);

/** How the last source of an op was given: "", "swizzle", "memory 4 bytes", ... */
const char *export_form_name(uint16_t op);

#endif
