/* Directories that tests write to, and looks into them. A failing call ends the test program with a message. */
#ifndef TESTS_BASE_FILES_H
#define TESTS_BASE_FILES_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Make an empty directory below $TMPDIR or /tmp; the name is for free(). */
char *files_make_directory(void);

/** Remove a directory with the files in it (no directories below), and free the name. */
void files_remove_directory(char *directory);

/** directory/name, for free(). */
char *files_path(const char *directory, const char *name);

/** Contents with a terminating zero behind them, for free(); NULL if the file cannot be opened. `size` may be NULL. */
char *files_read(const char *path, size_t *size);

/** Make a file with this text. */
void files_write(const char *path, const char *text);

/** Number of entries, hidden ones too. */
int files_count(const char *directory);

#ifdef __cplusplus
}
#endif
#endif
