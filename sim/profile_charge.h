/* How the timing models fill a profile. Private to sim. */
#ifndef SIM_PROFILE_CHARGE_H
#define SIM_PROFILE_CHARGE_H

#include <stdbool.h>

#include "sim/op_price.h"
#include "sim/profile.h"

/* What a place cost, as the models sum it up. The gap is the bucket SIM_BUCKET_NONE. */
typedef struct sim_cost {
    uint64_t ops, vector_ops, idle_lanes;
    uint64_t issued_one, issued_pair;
    uint64_t waited[SIM_BUCKETS];
} sim_cost;

typedef struct sim_line_cost {
    uint32_t site;
    bool used;
    sim_cost cost;
} sim_line_cost;

/* Where in the kernel a thread is. */
typedef struct sim_whereabouts {
    uint32_t phase; /* below SIM_MAX_PHASES */
    uint32_t site;
    size_t line;    /* place in the table of lines; the table may have grown since, or be another one's: see the site */
} sim_whereabouts;

struct sim_profile {
    sim_cost op[LRB_OP_COUNT], phase[SIM_MAX_PHASES];
    sim_line_cost *lines; /* a hash table by site */
    size_t line_count, line_capacity; /* a power of two */
    sim_whereabouts last_at; /* of the op that issued first in the last cycle */
    unsigned last_id;
    bool failed;          /* there was no memory for a line */
};

/** The op issues: first in its cycle, or beside the op of the last charge. */
void sim_profile_issue(sim_profile *p, sim_whereabouts *at, unsigned id, unsigned lanes, unsigned mask, bool joins);

/** Cycles waited for the op, before it issues. */
void sim_profile_wait(sim_profile *p, sim_whereabouts *at, unsigned id, unsigned bucket, uint64_t cycles);

/** Put buckets into the members of *to; the gap is left alone. */
void sim_cycles_of_buckets(const uint64_t waited[SIM_BUCKETS], sim_cycles *to);

#endif
