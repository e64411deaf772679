#include "sim/cache.h"

#include <stdlib.h>
#include <string.h>

enum { NO_LINE_BYTE = 0xff }; /* fills the number of no line */

struct sim_cache {
    unsigned ways, line_bits;
    uint64_t sets; /* a power of two */
    uint64_t *lines; /* sets x ways, in each set the most recently used first; UINT64_MAX: none */
};

base_status sim_cache_create(unsigned size_bytes, unsigned ways, unsigned line_bytes, sim_cache **out, base_error *err)
{
    uint64_t set_bytes = (uint64_t)ways * line_bytes, sets = set_bytes ? size_bytes / set_bytes : 0;
    if (line_bytes < 2 || line_bytes & (line_bytes - 1) || !sets || sets & (sets - 1) || sets * set_bytes != size_bytes)
        return base_fail(err, BASE_ERR_USAGE, "cache", "%u bytes are no power of two of sets of %u lines of %u bytes", size_bytes,
                         ways, line_bytes);
    sim_cache *cache = calloc(1, sizeof *cache);
    if (cache)
        cache->lines = malloc(sets * ways * sizeof *cache->lines);
    if (!cache || !cache->lines) {
        sim_cache_destroy(&cache);
        return base_fail(err, BASE_ERR_NOMEM, "cache", "out of memory");
    }
    cache->ways = ways;
    cache->line_bits = (unsigned)__builtin_ctz(line_bytes);
    cache->sets = sets;
    memset(cache->lines, NO_LINE_BYTE, sets * ways * sizeof *cache->lines);
    *out = cache;
    return BASE_OK;
}

void sim_cache_destroy(sim_cache **cache)
{
    if (*cache)
        free((*cache)->lines);
    free(*cache);
    *cache = NULL;
}

uint64_t sim_cache_line(const sim_cache *cache, uint64_t address)
{
    return address >> cache->line_bits;
}

static uint64_t *set_of(const sim_cache *cache, uint64_t line)
{
    return cache->lines + (line & (cache->sets - 1)) * cache->ways;
}

bool sim_cache_touch(sim_cache *cache, uint64_t line)
{
    uint64_t *set = set_of(cache, line);
    unsigned way = 0;
    while (way < cache->ways - 1 && set[way] != line)
        way++;
    bool hit = set[way] == line;
    memmove(set + 1, set, way * sizeof *set); /* of a miss: all but the last, which goes */
    set[0] = line;
    return hit;
}

void sim_cache_evict(sim_cache *cache, uint64_t line)
{
    uint64_t *set = set_of(cache, line);
    for (unsigned way = 0; way < cache->ways; way++)
        if (set[way] == line) {
            memmove(set + way, set + way + 1, (cache->ways - 1 - way) * sizeof *set);
            memset(&set[cache->ways - 1], NO_LINE_BYTE, sizeof *set);
            return;
        }
}
