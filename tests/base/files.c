#include "tests/base/files.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void must(int ok, const char *what)
{
    if (!ok) {
        perror(what);
        exit(99);
    }
}

char *files_make_directory(void)
{
    const char *parent = getenv("TMPDIR");
    char *name = files_path(parent && *parent ? parent : "/tmp", "lanetrace-test-XXXXXX");
    must(mkdtemp(name) != NULL, name);
    return name;
}

static int is_entry(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

void files_remove_directory(char *directory)
{
    DIR *dir = opendir(directory);
    must(dir != NULL, directory);
    for (struct dirent *entry; (entry = readdir(dir)) != NULL;)
        if (is_entry(entry)) {
            char *path = files_path(directory, entry->d_name);
            must(unlink(path) == 0, path);
            free(path);
        }
    closedir(dir);
    must(rmdir(directory) == 0, directory);
    free(directory);
}

char *files_path(const char *directory, const char *name)
{
    size_t size = strlen(directory) + strlen(name) + 2;
    char *path = malloc(size);
    must(path != NULL, "files_path");
    snprintf(path, size, "%s/%s", directory, name);
    return path;
}

char *files_read(const char *path, size_t *size)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return NULL;
    must(fseek(in, 0, SEEK_END) == 0, path);
    long length = ftell(in);
    must(length >= 0, path);
    rewind(in);
    char *bytes = malloc((size_t)length + 1);
    must(bytes != NULL, path);
    must(fread(bytes, 1, (size_t)length, in) == (size_t)length, path);
    bytes[length] = '\0';
    fclose(in);
    if (size)
        *size = (size_t)length;
    return bytes;
}

void files_write(const char *path, const char *text)
{
    FILE *out = fopen(path, "wb");
    must(out != NULL, path);
    must(fputs(text, out) >= 0, path);
    must(fclose(out) == 0, path);
}

int files_count(const char *directory)
{
    DIR *dir = opendir(directory);
    int count = 0;
    must(dir != NULL, directory);
    for (struct dirent *entry; (entry = readdir(dir)) != NULL;)
        count += is_entry(entry);
    closedir(dir);
    return count;
}
