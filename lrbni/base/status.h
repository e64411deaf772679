/* How functions fail: a status is returned, and the caller's base_error, if it gave one, receives the words. */
#ifndef LRBNI_BASE_STATUS_H
#define LRBNI_BASE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum base_status {
    BASE_OK = 0,
    BASE_ERR_USAGE,       /* an option, parameter or name that does not exist or is out of range */
    BASE_ERR_INPUT,       /* a file that cannot be read or written, or whose contents are wrong */
    BASE_ERR_UNSUPPORTED, /* asked for something that this build leaves out */
    BASE_ERR_NOMEM,       /* the host ran out of memory */
    BASE_ERR_IO           /* the host failed while reading or writing (disk full) */
} base_status;

/* What failed (a file, field or option) and why; each a single line without a full stop. */
typedef struct base_error {
    base_status status;
    char what[256];
    char why[512];
} base_error;

/**
 * Fill in an error and return its status, so that `return base_fail(err, ...)` is a whole failure path.
 *
 * @param err     may be NULL: then only the status is returned
 * @param status  not BASE_OK
 * @param what    the file, field or option at fault; copied, shortened if too long
 * @param why     printf format of the reason; line breaks in the result become blanks
 */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
base_status base_fail(base_error *err, base_status status, const char *what, const char *why, ...);

/** Exit code that the command line promises for a status: 0, 2 (usage or input) or 3 (the host let us down). */
int base_exit_code(base_status status);

#ifdef __cplusplus
}
#endif
#endif
