/* Someone who is told of every event as a model comes to it: for pictures of a pipeline, not for numbers. A model without an
 * observer takes no longer for it. */
#ifndef SIM_OBSERVER_H
#define SIM_OBSERVER_H

#include <stdbool.h>
#include <stdint.h>

#include "lrbni/event.h"

/* An event, and when. Cycles never go back from one call to the next. */
typedef struct sim_issued {
    const lrb_event *event; /* valid during the call */
    uint64_t cycle;         /* in which the op issues; of a marker: of the last op before it, 0 if there is none */
    uint64_t ready;         /* when an ordinary reader can have the result */
    unsigned thread;        /* of the core */
    bool in_v;              /* it joined the op before it, in V */
} sim_issued;

typedef void sim_observer(void *user, const sim_issued *issued);

#endif
