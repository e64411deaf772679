/* A number of things that may be under way at once, each until a known time. Private to sim. */
#ifndef SIM_SLOTS_H
#define SIM_SLOTS_H

#include <stdint.h>

typedef struct sim_slots {
    unsigned count;    /* at least 1 */
    unsigned earliest; /* the slot that is free first */
    uint64_t free_at;  /* when it is; a time that has passed if it is free */
    uint64_t *until;   /* of every slot, owned by whoever owns the slots */
} sim_slots;

/** Take the slot that is free first. */
static inline void sim_slots_take(sim_slots *s, uint64_t until)
{
    s->until[s->earliest] = until;
    for (unsigned i = 0; i < s->count; i++)
        if (s->until[i] < s->until[s->earliest])
            s->earliest = i;
    s->free_at = s->until[s->earliest];
}

#endif
