/* A profile's lines with what they stand for: source and function; and their cycles in the few groups that people compare. */
#ifndef CLI_PLACES_H
#define CLI_PLACES_H

#include "cli/run.h"
#include "kernels/sources.h"

/* Cycles by what the core did. */
typedef struct place_groups {
    uint64_t cycles;  /* all; sums the others */
    uint64_t issue;   /* one op or two issued */
    uint64_t operand; /* waited for a result, or for stored words */
    uint64_t memory;  /* waited for a line from beyond the first level, or for one fewer under way */
    uint64_t other;   /* the rest: busy class, blocked or delayed thread, branch, gap, no work */
} place_groups;

place_groups place_groups_of(const sim_cycles *cycles);

/* A line, a function, or a source. */
typedef struct place {
    const kernel_source *source; /* NULL: the program does not have it */
    kernel_source_line function; /* text NULL: none, or a source */
    sim_place cost;              /* the site: of a line; of others, of their first line */
} place;

typedef struct places {
    place *lines, *functions, *sources; /* lines by site; the others by cycles, most first */
    size_t line_count, function_count, source_count;
    sim_place total;
} places;

/** What result->profile says; destroy with places_destroy, also after a failure. Errors: BASE_ERR_NOMEM. */
base_status places_create(const run_result *result, places *out, base_error *err);

/** Free what *p owns. */
void places_destroy(places *p);

/** "slab16_test"; "(none)" where a place has no function. Valid until the next call. */
const char *place_function_name(const place *p, char name[64]);

/** Path of the source; "source 9" if the program does not have it. */
const char *place_source_name(const place *p, char name[64]);

#endif
