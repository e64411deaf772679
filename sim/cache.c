#include "sim/cache.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

base_status sim_cache_create(unsigned size_bytes, unsigned ways, unsigned line_bytes, sim_cache **out, base_error *err)
{
    if (line_bytes < 2 || line_bytes & (line_bytes - 1) || !sim_cache_fits(size_bytes, ways, line_bytes))
        return base_fail(err, BASE_ERR_USAGE, "cache", "%u bytes are no power of two of sets of %u lines of %u bytes", size_bytes,
                         ways, line_bytes);
    size_t places = size_bytes / line_bytes;
    sim_cache *cache = calloc(1, sizeof *cache);
    if (cache)
        cache->lines = malloc((places + 1) * sizeof *cache->lines);
    if (cache)
        cache->used = calloc(places + 1, sizeof *cache->used);
    if (!cache || !cache->lines || !cache->used) {
        sim_cache_destroy(&cache);
        return base_fail(err, BASE_ERR_NOMEM, "cache", "out of memory");
    }
    cache->ways = ways;
    cache->line_bits = (unsigned)__builtin_ctz(line_bytes);
    cache->sets = places / ways;
    for (size_t i = 0; i <= places; i++)
        cache->lines[i] = SIM_NO_LINE;
    *out = cache;
    return BASE_OK;
}

void sim_cache_destroy(sim_cache **cache)
{
    if (*cache) {
        free((*cache)->lines);
        free((*cache)->used);
    }
    free(*cache);
    *cache = NULL;
}

void sim_cache_assign(sim_cache *to, const sim_cache *from)
{
    assert(to->ways == from->ways && to->sets == from->sets && to->line_bits == from->line_bits);
    memcpy(to->lines, from->lines, from->sets * from->ways * sizeof *from->lines);
    memcpy(to->used, from->used, from->sets * from->ways * sizeof *from->used);
    to->uses = from->uses;
}

/* A free place, or else the one that was not used for longest. */
void sim_cache_fill(sim_cache *cache, uint64_t line)
{
    const uint64_t first = (line & (cache->sets - 1)) * cache->ways;
    uint64_t oldest = first;
    for (uint64_t place = first; place < first + cache->ways; place++)
        oldest = cache->used[place] < cache->used[oldest] ? place : oldest;
    cache->lines[oldest] = line;
    cache->used[oldest] = ++cache->uses;
}

void sim_cache_evict(sim_cache *cache, uint64_t line)
{
    const uint64_t place = sim_cache_place(cache, line);
    if (place == UINT64_MAX)
        return;
    cache->lines[place] = SIM_NO_LINE;
    cache->used[place] = 0;
}
