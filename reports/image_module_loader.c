#include "reports/image_module_loader.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#if LANETRACE_IMAGES

/* Directory of the running program, without a slash at the end; false if the system does not tell. */
static bool program_directory(char directory[PATH_MAX])
{
    ssize_t length = readlink("/proc/self/exe", directory, PATH_MAX - 1);
    if (length <= 0)
        return false;
    directory[length] = '\0';
    char *slash = strrchr(directory, '/');
    if (!slash)
        return false;
    *slash = '\0';
    return true;
}

/* Put a path together; false if it is too long or nothing is there. */
static bool find_in(const char *directory, const char *below, char path[PATH_MAX])
{
    int length = snprintf(path, PATH_MAX, "%s%s/" REPORT_IMAGE_MODULE_FILE, directory, below);
    return length > 0 && length < PATH_MAX && access(path, R_OK) == 0;
}

static bool find_module(char path[PATH_MAX])
{
    char program[PATH_MAX];
    const char *chosen = getenv("LANETRACE_MODULE_PATH");
    if (chosen && *chosen)
        return find_in(chosen, "", path);
    if (program_directory(program) &&
        (find_in(program, "", path) || find_in(program, "/../reports", path) ||
         find_in(program, "/../" LANETRACE_LIBDIR "/lanetrace", path)))
        return true;
    return find_in(LANETRACE_PREFIX "/" LANETRACE_LIBDIR "/lanetrace", "", path);
}

base_status report_image_module_load(report_image_encode_fn **encode, base_error *err)
{
    char path[PATH_MAX];
    if (!find_module(path))
        return base_fail(err, BASE_ERR_UNSUPPORTED, REPORT_IMAGE_MODULE_FILE,
                         "the module that writes pictures is neither beside the program nor installed"
                         " (LANETRACE_MODULE_PATH names its directory)");
    /* Never closed: OpenImageIO's threads and exit handlers must not lose their code. */
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module)
        return base_fail(err, BASE_ERR_UNSUPPORTED, path, "cannot be loaded: %s", dlerror());
    void *symbol = dlsym(module, REPORT_IMAGE_ENCODE_SYMBOL);
    if (!symbol)
        return base_fail(err, BASE_ERR_UNSUPPORTED, path, "belongs to another version of lanetrace");
    memcpy(encode, &symbol, sizeof symbol); /* ISO C has no cast from an object to a function pointer */
    return BASE_OK;
}

#else

base_status report_image_module_load(report_image_encode_fn **encode, base_error *err)
{
    *encode = NULL;
    return base_fail(err, BASE_ERR_UNSUPPORTED, "pictures", "this build leaves them out (option 'images')");
}

#endif
