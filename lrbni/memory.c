#include "lrbni/memory.h"

#include <assert.h>

lrb_memory lrb_memory_empty(void)
{
    return (lrb_memory){.next = LRB_PAGE_BYTES}; /* address 0 stays unused: no valid pointer is null */
}

base_status lrb_memory_map(lrb_memory *memory, const char *name, void *host, size_t size, lrb_segment *out, base_error *err)
{
    assert((uintptr_t)host % 64 == 0);
    if (size > LRB_SCRATCH_ADDRESS - LRB_PAGE_BYTES - memory->next)
        return base_fail(err, BASE_ERR_INPUT, name, "%zu bytes more do not fit in the simulated machine's 4 GiB of memory", size);
    *out = (lrb_segment){.host = host, .address = memory->next, .size = size};
    size_t pages = size ? (size + LRB_PAGE_BYTES - 1) / LRB_PAGE_BYTES : 1; /* an empty segment has an address of its own */
    memory->next += (uint32_t)(pages * LRB_PAGE_BYTES);
    return BASE_OK;
}
