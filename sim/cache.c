#include "sim/cache.h"

#include <stdlib.h>
#include <string.h>

#define NO_LINE UINT64_MAX

base_status sim_cache_create(unsigned size_bytes, unsigned ways, unsigned line_bytes, sim_cache **out, base_error *err)
{
    if (line_bytes < 2 || line_bytes & (line_bytes - 1) || !sim_cache_fits(size_bytes, ways, line_bytes))
        return base_fail(err, BASE_ERR_USAGE, "cache", "%u bytes are no power of two of sets of %u lines of %u bytes", size_bytes,
                         ways, line_bytes);
    size_t places = size_bytes / line_bytes;
    sim_cache *cache = calloc(1, sizeof *cache);
    if (cache)
        cache->lines = malloc(places * sizeof *cache->lines);
    if (!cache || !cache->lines) {
        sim_cache_destroy(&cache);
        return base_fail(err, BASE_ERR_NOMEM, "cache", "out of memory");
    }
    cache->ways = ways;
    cache->line_bits = (unsigned)__builtin_ctz(line_bytes);
    cache->sets = places / ways;
    for (size_t i = 0; i < places; i++)
        cache->lines[i] = NO_LINE;
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

static uint64_t *set_of(const sim_cache *cache, uint64_t line)
{
    return cache->lines + (line & (cache->sets - 1)) * cache->ways;
}

/* The place of a line in its set; `ways` if it is not there. */
static unsigned place_of(const sim_cache *cache, const uint64_t *set, uint64_t line)
{
    unsigned place = 0;
    while (place < cache->ways && set[place] != line)
        place++;
    return place;
}

bool sim_cache_holds(const sim_cache *cache, uint64_t line)
{
    return place_of(cache, set_of(cache, line), line) < cache->ways;
}

bool sim_cache_reorder(sim_cache *cache, uint64_t line)
{
    uint64_t *set = set_of(cache, line);
    unsigned place = place_of(cache, set, line);
    bool hit = place < cache->ways;
    for (unsigned i = hit ? place : cache->ways - 1; i > 0; i--) /* of a miss the last one goes */
        set[i] = set[i - 1];
    set[0] = line;
    return hit;
}

void sim_cache_evict(sim_cache *cache, uint64_t line)
{
    uint64_t *set = set_of(cache, line);
    unsigned place = place_of(cache, set, line);
    if (place == cache->ways)
        return;
    memmove(set + place, set + place + 1, (cache->ways - 1 - place) * sizeof *set);
    set[cache->ways - 1] = NO_LINE;
}
