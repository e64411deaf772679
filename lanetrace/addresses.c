#include "lanetrace/addresses.h"

#include <stdlib.h>
#include <string.h>

address_arrays address_arrays_empty(void)
{
    return (address_arrays){.memory = lrb_memory_empty()};
}

void address_arrays_free(address_arrays *a)
{
    free(a->segments);
    *a = (address_arrays){0};
}

/* Number of arrays that begin at or below a host address. */
static size_t arrays_up_to(const address_arrays *a, uintptr_t host)
{
    size_t low = 0, high = a->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if ((uintptr_t)a->segments[middle].host <= host)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

base_status address_arrays_map(address_arrays *a, const char *name, void *host, size_t size, lrb_segment *out, base_error *err)
{
    lrb_segment segment;
    uintptr_t first = (uintptr_t)host;
    size_t place = arrays_up_to(a, first);
    if (size > UINTPTR_MAX - first)
        return base_fail(err, BASE_ERR_USAGE, name, "%zu bytes reach beyond the end of memory", size);
    if ((place > 0 && first - (uintptr_t)a->segments[place - 1].host < a->segments[place - 1].size) ||
        (place < a->count && (uintptr_t)a->segments[place].host - first < size))
        return base_fail(err, BASE_ERR_USAGE, name, "overlaps an array that is mapped");
    if (size > ADDRESS_UNMAPPED - LRB_PAGE_BYTES - a->memory.next)
        return base_fail(err, BASE_ERR_INPUT, name, "%zu bytes more do not fit in the simulated machine's 2 GiB of arrays", size);
    lrb_segment *segments = realloc(a->segments, (a->count + 1) * sizeof *segments);
    if (!segments)
        return base_fail(err, BASE_ERR_NOMEM, name, "out of memory");
    a->segments = segments;
    base_status status = lrb_memory_map(&a->memory, name, NULL, size, &segment, err); /* an address alone: any host address will do */
    if (status != BASE_OK)
        return status;
    segment.host = host;
    memmove(&segments[place + 1], &segments[place], (a->count - place) * sizeof *segments);
    segments[place] = segment;
    a->count++;
    if (out)
        *out = segment;
    return BASE_OK;
}

void address_arrays_unmap(address_arrays *a, const void *host)
{
    size_t place = arrays_up_to(a, (uintptr_t)host);
    if (place == 0 || a->segments[place - 1].host != host)
        return;
    memmove(&a->segments[place - 1], &a->segments[place], (a->count - place) * sizeof *a->segments);
    a->count--;
}

const lrb_segment *address_arrays_find(const address_arrays *a, const void *host)
{
    size_t place = arrays_up_to(a, (uintptr_t)host);
    if (place == 0)
        return NULL;
    const lrb_segment *s = &a->segments[place - 1];
    return (uintptr_t)host - (uintptr_t)s->host < s->size ? s : NULL;
}

void address_lines_begin(address_lines *lines)
{
    if (lines->piece == UINT32_MAX) { /* the mark of old entries would come round */
        memset(lines->entries, 0, lines->size * sizeof *lines->entries);
        lines->piece = 0;
    }
    lines->piece++;
    lines->count = 0;
    lines->status = BASE_OK;
}

/* The entry of a line, or the empty one where it belongs; there is always an empty one. */
static struct address_line *entry_of(const address_lines *lines, uintptr_t line)
{
    size_t place = (size_t)((uint64_t)line * UINT64_C(0x9e3779b97f4a7c15) >> 32) & (lines->size - 1);
    while (lines->entries[place].piece == lines->piece && lines->entries[place].line != line)
        place = (place + 1) & (lines->size - 1);
    return &lines->entries[place];
}

/* Make the table twice as large. */
static bool grow(address_lines *lines)
{
    address_lines larger = *lines;
    larger.size = lines->size ? 2 * lines->size : 256;
    larger.entries = calloc(larger.size, sizeof *larger.entries);
    if (!larger.entries)
        return false;
    for (size_t i = 0; i < lines->size; i++)
        if (lines->entries[i].piece == lines->piece)
            *entry_of(&larger, lines->entries[i].line) = lines->entries[i];
    free(lines->entries);
    *lines = larger;
    return true;
}

uint32_t address_lines_touch(address_lines *lines, const void *host)
{
    uintptr_t line = (uintptr_t)host / ADDRESS_LINE_BYTES;
    uint32_t offset = (uint32_t)((uintptr_t)host % ADDRESS_LINE_BYTES);
    if (2 * (lines->count + 1) > lines->size && !grow(lines)) {
        lines->status = BASE_ERR_NOMEM;
        return ADDRESS_UNMAPPED + offset;
    }
    struct address_line *e = entry_of(lines, line);
    if (e->piece != lines->piece) {
        if (lines->count == (LRB_SCRATCH_ADDRESS - ADDRESS_UNMAPPED) / ADDRESS_LINE_BYTES) {
            lines->status = BASE_ERR_INPUT;
            return ADDRESS_UNMAPPED + offset;
        }
        *e = (struct address_line){.line = line, .piece = lines->piece,
                                   .address = ADDRESS_UNMAPPED + (uint32_t)lines->count++ * ADDRESS_LINE_BYTES};
    }
    return e->address + offset;
}

void address_lines_free(address_lines *lines)
{
    free(lines->entries);
    *lines = (address_lines){0};
}
