/* Functional warming: which lines the caches of a core hold after a stream of events, without time.
 *
 * A line comes the moment it is asked for, and ops access memory in the order of their stream. So a tile costs little more than
 * its recording, and what the caches hold before any tile of a run can be kept and given to a core (sim_core_fill), which then
 * times that tile as if it had timed all before. The lines that come from memory say beforehand where the core will wait.
 *
 * R. E. Wunderlich et al., "SMARTS: accelerating microarchitecture simulation via rigorous statistical sampling", ISCA 2003, warm like
 * this between the units that they time.
 */
#ifndef SIM_WARM_H
#define SIM_WARM_H

#include <stddef.h>
#include <stdint.h>

#include "lrbni/base/status.h"
#include "lrbni/event.h"
#include "sim/cache.h"
#include "sim/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What two levels of cache hold. */
typedef struct sim_contents {
    sim_cache *l1, *l2; /* owned */
} sim_contents;

/** Cold caches of a machine. Errors: BASE_ERR_NOMEM. What was made is in *out then too. */
base_status sim_contents_create(const sim_machine *machine, sim_contents *out, base_error *err);

/** Free contents, which may be all zeros, and make them so. */
void sim_contents_destroy(sim_contents *c);

/** Make contents of the same machine equal. */
void sim_contents_assign(sim_contents *to, const sim_contents *from);

/* Lines that came to each level: to the first from the second, to the second from memory. */
typedef struct sim_lines {
    uint64_t l1, l2;
} sim_lines;

typedef struct sim_warmer sim_warmer;

/** A warmer with cold caches. Errors: BASE_ERR_NOMEM. */
base_status sim_warmer_create(const sim_machine *machine, sim_warmer **out, base_error *err);

/** Free a warmer, which may be NULL, and set the pointer to NULL. */
void sim_warmer_destroy(sim_warmer **w);

/**
 * Let events access the caches.
 *
 * @param thread  hardware thread whose scratch memory is theirs
 * @return        the lines that came
 */
sim_lines sim_warmer_events(sim_warmer *w, unsigned thread, const lrb_event *events, size_t count);

/** Make the caches hold what others of the same machine do. */
void sim_warmer_fill(sim_warmer *w, const sim_contents *contents);

/** What the caches hold now; the warmer's own. */
const sim_contents *sim_warmer_contents(const sim_warmer *w);

#ifdef __cplusplus
}
#endif
#endif
