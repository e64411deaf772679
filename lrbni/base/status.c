#include "lrbni/base/status.h"

#include <stdarg.h>
#include <stdio.h>

static void one_line(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ')
            *text = ' ';
}

base_status base_fail(base_error *err, base_status status, const char *what, const char *why, ...)
{
    if (err) {
        va_list args;
        err->status = status;
        snprintf(err->what, sizeof err->what, "%s", what);
        va_start(args, why);
        vsnprintf(err->why, sizeof err->why, why, args);
        va_end(args);
        one_line(err->what);
        one_line(err->why);
    }
    return status;
}

int base_exit_code(base_status status)
{
    switch (status) {
    case BASE_OK:
        return 0;
    case BASE_ERR_USAGE:
    case BASE_ERR_INPUT:
    case BASE_ERR_UNSUPPORTED:
        return 2;
    case BASE_ERR_NOMEM:
    case BASE_ERR_IO:
        return 3;
    }
    return 3;
}
