#include "cli/run_trace.h"

#include <stdlib.h>

#include "cli/identity.h"

base_status run_trace_begin(const run_result *result, run_trace *out, base_error *err)
{
    *out = (run_trace){.jobs = result->options.jobs};
    if (!result->options.trace)
        return BASE_OK;
    char *text = identity_head_text(result);
    out->workers = calloc(out->jobs, sizeof *out->workers);
    base_status status = BASE_OK;
    if (!text || !out->workers)
        status = base_fail(err, BASE_ERR_NOMEM, "--trace", "out of memory");
    for (unsigned i = 0; status == BASE_OK && i < out->jobs; i++)
        status = trace_encoder_create(&out->workers[i].encoder, err);
    if (status == BASE_OK)
        status = trace_writer_create(result->options.trace, (uint32_t)kernel_job_tiles(result->job), text, &out->writer, err);
    free(text);
    return status;
}

void run_trace_begin_tile(run_trace *t, unsigned worker)
{
    trace_encoder_begin(t->workers[worker].encoder);
}

void run_trace_end_tile(run_trace *t, unsigned worker, uint32_t tile)
{
    run_trace_worker *w = &t->workers[worker];
    trace_tile bytes;
    if (w->err.status == BASE_OK && trace_encoder_end(w->encoder, &bytes, &w->err) == BASE_OK)
        trace_writer_put(t->writer, tile, &bytes, &w->err);
}

base_status run_trace_commit(run_trace *t, const run_result *result, base_error *err)
{
    if (!t->writer)
        return BASE_OK;
    for (unsigned i = 0; i < t->jobs; i++)
        if (t->workers[i].err.status != BASE_OK)
            return base_fail(err, t->workers[i].err.status, t->workers[i].err.what, "%s", t->workers[i].err.why);
    char *text = identity_tail_text(result);
    base_status status = text ? trace_writer_commit(t->writer, text, err) : base_fail(err, BASE_ERR_NOMEM, "--trace", "out of memory");
    free(text);
    return status;
}

void run_trace_destroy(run_trace *t)
{
    trace_writer_destroy(&t->writer);
    for (unsigned i = 0; t->workers && i < t->jobs; i++)
        trace_encoder_destroy(&t->workers[i].encoder);
    free(t->workers);
    *t = (run_trace){0};
}
