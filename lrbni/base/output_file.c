#include "lrbni/base/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    NAME_KEPT_BYTES = 100, /* of the file's own name in the temporary one, so that long names stay below NAME_MAX */
    EXTENSION_MAX_BYTES = 20,
    TEMP_TRIES = 1000,
    SUFFIX_ROOM = 64 /* for the process, the number and the punctuation */
};

/* A full disk is the host's fault, a missing directory the caller's. */
static base_status status_of(int error)
{
    switch (error) {
    case ENOMEM:
        return BASE_ERR_NOMEM;
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
    case EMFILE:
    case ENFILE:
    case EPIPE:
        return BASE_ERR_IO;
    default:
        return BASE_ERR_INPUT;
    }
}

static base_status fail_errno(base_error *err, const char *path, const char *doing, int error)
{
    return base_fail(err, status_of(error), path, "%s: %s", doing, strerror(error));
}

static void output_clear(base_output *out)
{
    free(out->path);
    free(out->final_path);
    free(out->temp_path);
    *out = (base_output){0};
}

/* Where the last part of a path starts. */
static size_t base_name_offset(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash + 1 - path) : 0;
}

/* DIR/.NAME.PID-TRY.EXTENSION */
static void temp_name(char *text, size_t size, const char *path, unsigned number)
{
    size_t dir = base_name_offset(path);
    const char *name = path + dir;
    const char *dot = strrchr(name, '.');
    const char *extension = dot && strlen(dot) <= EXTENSION_MAX_BYTES ? dot : "";
    size_t kept = strlen(name) - strlen(extension);
    if (kept > NAME_KEPT_BYTES)
        kept = NAME_KEPT_BYTES;
    snprintf(text, size, "%.*s.%.*s.%ld-%u%s", (int)dir, path, (int)kept, name, (long)getpid(), number, extension);
}

/* Create a file that did not exist; the kernel applies the umask, which mkstemp would not. */
static int open_temp(base_output *out, base_error *err)
{
    size_t size = strlen(out->final_path) + SUFFIX_ROOM;
    int fd = -1;
    out->temp_path = malloc(size);
    if (!out->temp_path) {
        base_fail(err, BASE_ERR_NOMEM, out->path, "out of memory");
        return -1;
    }
    for (unsigned i = 0; i < TEMP_TRIES && fd < 0; i++) {
        temp_name(out->temp_path, size, out->final_path, i);
        fd = open(out->temp_path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST)
            break;
    }
    if (fd < 0) {
        fail_errno(err, out->path, "cannot be created", errno);
        free(out->temp_path);
        out->temp_path = NULL;
    }
    return fd;
}

/* Look at what the name means now: fills in final_path and tells whether to write directly into what is there. */
static base_status resolve(base_output *out, struct stat *old, bool *exists, bool *direct, base_error *err)
{
    struct stat link;
    *direct = false;
    *exists = stat(out->path, old) == 0;
    if (!*exists && errno != ENOENT)
        return fail_errno(err, out->path, "cannot be created", errno);
    if (!*exists && lstat(out->path, &link) == 0)
        return base_fail(err, BASE_ERR_INPUT, out->path, "cannot be created: a symbolic link to nothing");
    if (*exists && S_ISDIR(old->st_mode))
        return base_fail(err, BASE_ERR_INPUT, out->path, "cannot be written: is a directory");
    if (*exists && faccessat(AT_FDCWD, out->path, W_OK, AT_EACCESS) != 0)
        return fail_errno(err, out->path, "cannot be written", errno);
    *direct = *exists && !S_ISREG(old->st_mode);
    out->final_path = *exists && !*direct ? realpath(out->path, NULL) : strdup(out->path);
    if (!out->final_path)
        return fail_errno(err, out->path, "cannot be written", errno);
    return BASE_OK;
}

static base_status open_output(base_output *out, base_error *err)
{
    struct stat old;
    bool exists, direct;
    base_status status = resolve(out, &old, &exists, &direct, err);
    if (status != BASE_OK)
        return status;
    base_error local;
    base_error *why = err ? err : &local;
    int fd = direct ? open(out->final_path, O_WRONLY | O_CLOEXEC) : open_temp(out, why);
    if (fd < 0)
        return direct ? fail_errno(err, out->path, "cannot be written", errno) : why->status;
    if (exists && !direct)
        (void)fchmod(fd, old.st_mode & 0777); /* where a file system keeps no permissions, the file is still right */
    out->stream = fdopen(fd, "w");
    if (!out->stream) {
        int error = errno;
        close(fd);
        if (out->temp_path)
            unlink(out->temp_path);
        return fail_errno(err, out->path, "cannot be written", error);
    }
    return BASE_OK;
}

base_status base_output_begin(const char *path, bool stdout_allowed, base_output *out, base_error *err)
{
    bool to_stdout = stdout_allowed && strcmp(path, "-") == 0;
    *out = (base_output){0};
    if (!*path)
        return base_fail(err, BASE_ERR_INPUT, "output file", "the name is empty");
    out->path = strdup(to_stdout ? "standard output" : path);
    if (!out->path)
        return base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
    if (to_stdout) {
        out->stream = stdout;
        return BASE_OK;
    }
    base_status status = open_output(out, err);
    if (status != BASE_OK)
        output_clear(out);
    return status;
}

/* Flush and close; 0, or the errno of the first failure that is still known. */
static int close_stream(FILE *stream)
{
    int error = 0;
    errno = 0;
    if (fflush(stream) != 0)
        error = errno;
    if (ferror(stream) && !error)
        error = EIO; /* an earlier write failed, and its reason is gone */
    if (stream == stdout) {
        clearerr(stream);
        return error;
    }
    if (fclose(stream) != 0 && !error)
        error = errno;
    return error;
}

base_status base_output_commit(base_output *out, base_error *err)
{
    base_status status = BASE_OK;
    int error = close_stream(out->stream);
    if (error)
        status = base_fail(err, BASE_ERR_IO, out->path, "cannot be written: %s", strerror(error));
    else if (out->temp_path && rename(out->temp_path, out->final_path) != 0)
        status = fail_errno(err, out->path, "cannot be renamed into place", errno);
    if (status != BASE_OK && out->temp_path)
        unlink(out->temp_path);
    output_clear(out);
    return status;
}

void base_output_abort(base_output *out)
{
    if (out->stream)
        close_stream(out->stream);
    if (out->temp_path)
        unlink(out->temp_path);
    output_clear(out);
}
