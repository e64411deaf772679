/* Descriptions to test with: the file of a built-in machine, whole or with one piece replaced. */
#ifndef TESTS_SIM_MACHINE_TEXT_H
#define TESTS_SIM_MACHINE_TEXT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sim/machine.h"

/* The contents of a file, to be freed by the caller. */
static inline char *read_whole(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot open %s", path);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    size_t size = fread(text, 1, (1 << 20) - 1, file);
    assert_true(size > 0);
    fclose(file);
    return text;
}

/* A description with `old` replaced by `new`, once; `old` must be there. The caller frees it. */
static inline char *edited(const char *old, const char *new)
{
    char *text = read_whole(MACHINE_INI);
    char *at = strstr(text, old);
    if (!at)
        fail_msg("'%s' is not in the description", old);
    size_t size = strlen(text) + strlen(new) + 1;
    char *result = calloc(1, size);
    assert_non_null(result);
    snprintf(result, size, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
    free(text);
    return result;
}

/* Hash of a description that must be good. */
static inline uint64_t hash_of_text(const char *text)
{
    sim_machine *machine = NULL;
    base_error err = {0};
    if (sim_machine_parse("test.ini", text, strlen(text), &machine, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    uint64_t hash = sim_machine_hash(machine);
    sim_machine_destroy(&machine);
    return hash;
}

#endif
