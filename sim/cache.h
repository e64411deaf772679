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

typedef struct sim_cache sim_cache;

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

/** Number of the line that holds an address. */
uint64_t sim_cache_line(const sim_cache *cache, uint64_t address);

/**
 * Read or write a line: it is there afterwards, as the most recently used one of its set.
 *
 * @param line  below UINT64_MAX
 * @return      whether it was there before
 */
bool sim_cache_touch(sim_cache *cache, uint64_t line);

/** Drop a line if it is there (clevict). */
void sim_cache_evict(sim_cache *cache, uint64_t line);

#ifdef __cplusplus
}
#endif
#endif
