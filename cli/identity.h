/* What a run was: the part of its statistics that no model has a say in. A trace carries it from the recording to the replay. */
#ifndef CLI_IDENTITY_H
#define CLI_IDENTITY_H

#include <jansson.h>

#include "cli/run.h"
#include "traces/reader.h"

/** `kernel`, `params`, `scene` and `image` of a run, as statistics have them. A new reference, NULL if out of memory. */
json_t *identity_json(const run_result *result);

/** `counts` of a run. A new reference, NULL if out of memory. */
json_t *identity_counts_json(const run_result *result);

/** The texts that go into a trace, for free(): what is run, and what was counted. NULL if out of memory. */
char *identity_head_text(const run_result *result);
char *identity_tail_text(const run_result *result);

/* What a trace says of its run. */
typedef struct identity {
    json_t *json;          /* as identity_json; owned */
    const char *scene_name; /* belongs to json */
    unsigned triangles;
    kernel_info kernel;    /* its name, which belongs to json, its counters and phases; nothing else */
    kernel_counts counts;
    unsigned width, height;
    unsigned first_pass; /* tiles of it; those beyond are a second one */
} identity;

/**
 * Read it from a trace.
 *
 * @param path  names the trace in errors
 * @param out   free with identity_destroy, also after a failure
 *
 * Errors: BASE_ERR_INPUT naming the field that is missing or wrong.
 */
base_status identity_read(const char *path, const trace_reader *trace, identity *out, base_error *err);

void identity_destroy(identity *id);

#endif
