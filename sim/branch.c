#include "sim/branch.h"

#include <stdlib.h>

#include "sim/cache.h"

/* An entry: site << 8 | counter; of a free place the site is one that no branch has. */
#define FREE UINT64_MAX

enum { STRONGLY_TAKEN = 3, TAKEN = 2 };

struct sim_predictor {
    unsigned ways;
    uint32_t sets;     /* a power of two */
    uint64_t *entries; /* sets x ways, in each set the most recently used first */
};

base_status sim_predictor_create(unsigned entries, unsigned ways, sim_predictor **out, base_error *err)
{
    if (!sim_cache_fits(entries, ways, 1))
        return base_fail(err, BASE_ERR_USAGE, "branch.btb_entries", "%u is not a power of two times %u", entries, ways);
    sim_predictor *p = calloc(1, sizeof *p);
    if (p)
        p->entries = malloc(entries * sizeof *p->entries);
    if (!p || !p->entries) {
        sim_predictor_destroy(&p);
        return base_fail(err, BASE_ERR_NOMEM, "branch.btb_entries", "out of memory");
    }
    p->ways = ways;
    p->sets = entries / ways;
    for (unsigned i = 0; i < entries; i++)
        p->entries[i] = FREE;
    *out = p;
    return BASE_OK;
}

void sim_predictor_destroy(sim_predictor **p)
{
    if (*p)
        free((*p)->entries);
    free(*p);
    *p = NULL;
}

/* Make an entry the most recently used one of its set; what was at `place` goes. */
static void put_first(uint64_t *set, unsigned place, uint64_t entry)
{
    for (; place > 0; place--)
        set[place] = set[place - 1];
    set[0] = entry;
}

sim_prediction sim_predictor_branch(sim_predictor *p, uint32_t site, bool taken)
{
    uint64_t *set = p->entries + (size_t)(site & (p->sets - 1)) * p->ways;
    unsigned place = 0;
    while (place < p->ways && set[place] >> 8 != site)
        place++;
    if (place == p->ways) {
        if (!taken)
            return SIM_PREDICTED;
        put_first(set, place - 1, (uint64_t)site << 8 | STRONGLY_TAKEN);
        return SIM_BTB_MISS;
    }
    uint64_t entry = set[place];
    unsigned counter = entry & 0xff;
    bool right = (counter >= TAKEN) == taken;
    if (taken)
        entry += counter < STRONGLY_TAKEN;
    else
        entry -= counter > 0;
    put_first(set, place, entry);
    return right ? SIM_PREDICTED : SIM_MISPREDICTED;
}
