/* Puts an address stream through sim/cache: cache_replay I1 D1 LL < STREAM, each as SIZE,WAYS,LINE. STREAM is what
 * `valgrind --tool=lackey --trace-mem=yes` prints. Prints the counts that cachegrind reports, in its order:
 * I refs, I1 misses, LL misses of I, D reads, D1 read misses, LL read misses, then the same three of writes.
 *
 * The rules are those that cachegrind documents: the second level is asked on a first-level miss; an access to two lines
 * counts once, touches both, and misses if one of them does; a read-modify-write is a read.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sim/cache.h"

enum { INSTRUCTION, READ, WRITE, KINDS };

static bool miss(sim_cache *cache, uint64_t address, unsigned size)
{
    uint64_t first = sim_cache_line(cache, address), last = sim_cache_line(cache, address + size - 1);
    bool hit = true;
    for (uint64_t line = first; line <= last; line++)
        hit &= sim_cache_touch(cache, line);
    return !hit;
}

static sim_cache *parse_cache(const char *text)
{
    unsigned size, ways, line;
    sim_cache *cache = NULL;
    base_error err = {0};
    if (sscanf(text, "%u,%u,%u", &size, &ways, &line) != 3 || sim_cache_create(size, ways, line, &cache, &err) != BASE_OK) {
        fprintf(stderr, "cache_replay: %s: not a cache\n", text);
        exit(2);
    }
    return cache;
}

int main(int argc, char **argv)
{
    uint64_t counts[KINDS][3] = {0};
    char line[256], kind;
    if (argc != 4)
        return 2;
    sim_cache *first[KINDS] = {parse_cache(argv[1]), parse_cache(argv[2]), NULL}, *last = parse_cache(argv[3]);
    first[WRITE] = first[READ];
    while (fgets(line, sizeof line, stdin)) {
        uint64_t address;
        unsigned size;
        if (sscanf(line, " %c %" SCNx64 ",%u", &kind, &address, &size) != 3 || !strchr("ILSM", kind))
            continue; /* valgrind's own lines */
        int k = kind == 'I' ? INSTRUCTION : kind == 'S' ? WRITE : READ;
        counts[k][0]++;
        if (miss(first[k], address, size)) {
            counts[k][1]++;
            counts[k][2] += miss(last, address, size);
        }
    }
    for (int k = 0; k < KINDS; k++)
        printf("%" PRIu64 " %" PRIu64 " %" PRIu64 "\n", counts[k][0], counts[k][1], counts[k][2]);
    sim_cache_destroy(&first[INSTRUCTION]);
    sim_cache_destroy(&first[READ]);
    sim_cache_destroy(&last);
    return 0;
}
