#include "traces/columns.h"

#include <stdlib.h>

base_status trace_column_reserve(trace_column *c, size_t more)
{
    size_t used = trace_column_size(c), room = (size_t)(c->end - c->bytes);
    if (room - used >= more)
        return BASE_OK;
    room = used + more + room / 2;
    unsigned char *bytes = realloc(c->bytes, room);
    if (!bytes)
        return BASE_ERR_NOMEM;
    *c = (trace_column){.bytes = bytes, .next = bytes + used, .end = bytes + room};
    return BASE_OK;
}
