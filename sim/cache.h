/* A cache's contents: sets of lines, the least recently used one replaced, lines allocated by reads and writes alike.
 *
 * It knows which lines are there and nothing of time: the model that owns it puts the latencies on.
 */
#ifndef SIM_CACHE_H
#define SIM_CACHE_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SIM_NO_LINE UINT64_MAX

/* Opaque but to the inline functions below and to sim/hierarchy.h. */
typedef struct sim_cache {
    unsigned ways, line_bits;
    uint64_t sets;  /* a power of two */
    uint64_t *lines; /* sets x ways, and one more that is always free; SIM_NO_LINE: a free place */
    uint64_t *used;  /* by place: when it was used last; free places, never: 0 */
    uint64_t uses;
} sim_cache;

/** Whether so many bytes are a power-of-two number of sets of `ways` lines of line_bytes; entries of a table: lines of 1. */
static inline bool sim_cache_fits(unsigned size_bytes, unsigned ways, unsigned line_bytes)
{
    uint64_t set_bytes = (uint64_t)ways * line_bytes, sets = set_bytes ? size_bytes / set_bytes : 0;
    return sets && (sets & (sets - 1)) == 0 && sets * set_bytes == size_bytes;
}

/**
 * An empty cache of size_bytes / (ways * line_bytes) sets.
 *
 * @param line_bytes  a power of two, at least 2
 *
 * Errors: BASE_ERR_USAGE if sim_cache_fits says no; BASE_ERR_NOMEM.
 */
base_status sim_cache_create(unsigned size_bytes, unsigned ways, unsigned line_bytes, sim_cache **out, base_error *err);

/** Free a cache, which may be NULL, and set the pointer to NULL. */
void sim_cache_destroy(sim_cache **cache);

/** Make a cache hold what another one of the same size, ways and lines holds. */
void sim_cache_assign(sim_cache *to, const sim_cache *from);

/** Number of the line that holds an address. */
static inline uint64_t sim_cache_line(const sim_cache *cache, uint64_t address) { return address >> cache->line_bits; }

/** The place of a line in the cache; UINT64_MAX if it is not there. All places of its set are looked at, so that a host need not
 * foresee which one it is. */
static inline uint64_t sim_cache_place(const sim_cache *cache, uint64_t line)
{
    const uint64_t first = (line & (cache->sets - 1)) * cache->ways;
    uint64_t place = UINT64_MAX;
    for (unsigned i = 0; i < cache->ways; i++)
        place = cache->lines[first + i] == line ? first + i : place;
    return place;
}

/** Whether a line is there; changes nothing. */
static inline bool sim_cache_holds(const sim_cache *cache, uint64_t line) { return sim_cache_place(cache, line) != UINT64_MAX; }

/** What sim_cache_touch does with a line that is not there. */
void sim_cache_fill(sim_cache *cache, uint64_t line);

/**
 * Read or write a line: it is there afterwards, as the most recently used one of its set.
 *
 * @param line  below UINT64_MAX
 * @return      whether it was there before
 */
static inline bool sim_cache_touch(sim_cache *cache, uint64_t line)
{
    const uint64_t place = sim_cache_place(cache, line);
    if (place != UINT64_MAX)
        cache->used[place] = ++cache->uses;
    else
        sim_cache_fill(cache, line);
    return place != UINT64_MAX;
}

/** Drop a line if it is there (clevict). */
void sim_cache_evict(sim_cache *cache, uint64_t line);

#ifdef __cplusplus
}
#endif
#endif
