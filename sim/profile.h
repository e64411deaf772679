/* Where the cycles went, by place: by phase, by op and by line of the kernel's source. A timing model that is given a
 * profile charges every cycle of the core to the op that issued first in it, or that was waited for, and so to that op's
 * places; over the places of a kind, cycles and ops sum to the model's own.
 *
 * Lines are those of `line` markers, which annotated kernels put into their streams (lrbni/annotate.h).
 */
#ifndef SIM_PROFILE_H
#define SIM_PROFILE_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/op_table.h"
#include "sim/cycles.h"

/* What a place cost. */
typedef struct sim_place {
    uint32_t site;         /* of a line: source << 16 | line; 0: ops before the first marker */
    uint64_t ops;          /* issued, markers left out */
    uint64_t vector_ops;
    uint64_t idle_lanes;   /* lanes of vector ops that their masks switched off */
    sim_cycles cycles;
} sim_place;

typedef struct sim_profile sim_profile;

/** An empty profile. Errors: BASE_ERR_NOMEM. */
base_status sim_profile_create(sim_profile **out, base_error *err);

/** Free a profile; sets the pointer to NULL. */
void sim_profile_destroy(sim_profile **p);

/** Cycles of all buckets. */
uint64_t sim_cycles_sum(const sim_cycles *c);

/** Add `from` to `to`, but for the site. */
void sim_place_add(sim_place *to, const sim_place *from);

/** What a phase cost; phase below SIM_MAX_PHASES. */
sim_place sim_profile_phase(const sim_profile *p, unsigned phase);

/** What the ops of one id cost. */
sim_place sim_profile_op(const sim_profile *p, lrb_op_id id);

/**
 * What each line cost, by site.
 *
 * @param lines  out: *count of them, for free()
 *
 * Errors: BASE_ERR_NOMEM, also if the profile had no memory for a line while it was made.
 */
base_status sim_profile_lines(const sim_profile *p, sim_place **lines, size_t *count, base_error *err);

/** Add `from` to `to`. Errors: BASE_ERR_NOMEM. */
base_status sim_profile_add(sim_profile *to, const sim_profile *from, base_error *err);

#endif
