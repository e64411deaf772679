/* The branch predictor of a core: a branch target buffer with a two-bit counter an entry, shared by the threads.
 *
 * A branch is known by its site. The buffer has sets of `ways` entries, the least recently used one replaced; a site
 * belongs to the set of its number modulo the sets. A branch that is not there is predicted not to be taken, and comes in
 * when it is taken, its counter at 3 (AGN). Of one that is there, counter 2 or 3 predicts 'taken'; the counter then goes
 * up or down by one within 0..3.
 */
#ifndef SIM_BRANCH_H
#define SIM_BRANCH_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/base/status.h"

typedef struct sim_predictor sim_predictor;

typedef enum sim_prediction {
    SIM_PREDICTED,    /* right */
    SIM_MISPREDICTED, /* known, and wrong */
    SIM_BTB_MISS      /* taken, and not known */
} sim_prediction;

/** An empty predictor. Errors: BASE_ERR_USAGE if the sets are no power of two; BASE_ERR_NOMEM. */
base_status sim_predictor_create(unsigned entries, unsigned ways, sim_predictor **out, base_error *err);

/** Free a predictor, which may be NULL, and set the pointer to NULL. */
void sim_predictor_destroy(sim_predictor **p);

/** Predict a branch, say how that went, and learn from it. */
sim_prediction sim_predictor_branch(sim_predictor *p, uint32_t site, bool taken);

#endif
