/* Output files that are either whole or not there: written beside their final name, then renamed. */
#ifndef LRBNI_BASE_OUTPUT_FILE_H
#define LRBNI_BASE_OUTPUT_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An output being written. Filled in by base_output_begin, ended by base_output_commit or base_output_abort. */
typedef struct base_output {
    FILE *stream;     /* write here; its errors are found by the commit, so single writes need no check */
    char *path;       /* the name that the caller gave, for messages; owned */
    char *final_path; /* what the file will be called: `path` with a symbolic link at its end resolved; owned */
    char *temp_path;  /* where the bytes go meanwhile; NULL: straight to stdout or into a device or pipe; owned */
} base_output;

/**
 * Start an output. An existing file of that name stays as it is until the commit.
 *
 * The temporary file lies in the same directory, starts with a dot and keeps the extension. An existing device or
 * pipe (/dev/null) is written to directly, never replaced. A replaced file's permissions go over to the new one.
 *
 * @param path          the final name; `-` is stdout if stdout_allowed, else a file of that name
 * @param stdout_allowed whether `-` has its special meaning
 * @param out           out, on success to be given to exactly one commit or abort; zeroed on failure
 *
 * Errors: BASE_ERR_INPUT naming the path (no such directory, no permission, a directory, a dangling link),
 * BASE_ERR_IO (disk full), BASE_ERR_NOMEM. Begin followed by abort is the test whether a name could be written.
 */
base_status base_output_begin(const char *path, bool stdout_allowed, base_output *out, base_error *err);

/**
 * Finish an output: flush, close, rename to the final name. After a failure the temporary file is gone and an old
 * file is untouched. `out` is zeroed either way; stdout stays open.
 *
 * Errors: BASE_ERR_IO naming the path if any write since the beginning failed; BASE_ERR_INPUT if the rename is refused.
 */
base_status base_output_commit(base_output *out, base_error *err);

/** Drop an output: close, remove the temporary file. Safe on a zeroed struct. What went to stdout cannot be undone. */
void base_output_abort(base_output *out);

#ifdef __cplusplus
}
#endif
#endif
