/* What one thread of a pipeline remembers of its youngest ops: when their results and their stored words are ready.
 * The inner steps of the timing models' loops. Private to sim. */
#ifndef SIM_PIPELINE_H
#define SIM_PIPELINE_H

#include <stdbool.h>

#include "lrbni/event.h"
#include "sim/op_price.h"

enum { SIM_STORE_LINES = 64 };

typedef struct sim_store_line {
    uint32_t line;    /* address / 64 */
    uint32_t words;   /* bit i: 32-bit word i was stored */
    sim_blamed ready; /* when a load may read them */
} sim_store_line;

/*
 * The loops are the hottest of the program. A host waits for a chain from each op's issue time to the next one's, so
 * what can be predicted is a branch, which the host runs ahead of, and not a conditional move, which it waits for: kernels
 * are loops, and their ops meet the same waits again and again. The empty statement keeps compilers from turning
 * the branch into a move.
 */
static inline void sim_need(sim_blamed ready, sim_blamed *at)
{
    if (ready > *at) {
        __asm__("" : "+r"(ready));
        *at = ready;
    }
}

/* Source i must be ready. Distance 0 and distances beyond the window: long ago. */
static inline void sim_need_source(const sim_result *results, uint32_t window, uint32_t next, const sim_op_price *p,
                                   const lrb_event *e, unsigned i, sim_blamed *at)
{
    uint32_t distance = e->src[i];
    if (distance - 1 < window - 1)
        sim_need(results[(next - distance) & (window - 1)].ready[p->consumer[i]], at);
}

/* Leave the times at which the result is ready. */
static inline void sim_put_result(sim_result *r, const sim_result *latency, sim_blamed now)
{
    for (int kind = 0; kind < SIM_CONSUMERS; kind++)
        r->ready[kind] = now + latency->ready[kind];
}

/* So many results must be kept: two ops a cycle, so that many of them take longer than any latency. A power of two. */
static inline uint32_t sim_window(const sim_machine *machine)
{
    uint32_t window = 64;
    while (window < 2 * (sim_longest_latency(machine) + 1))
        window *= 2;
    return window;
}

/* The 32-bit words of its line that an access touches. */
static inline uint32_t sim_words_of(const sim_op_price *p, const lrb_event *e)
{
    return p->words ? p->words << (e->aux / 4 & p->word_shift) : e->mask;
}

static inline void sim_remember_store(sim_store_line stores[SIM_STORE_LINES], const sim_op_price *p, const lrb_event *e,
                                      sim_blamed now)
{
    sim_store_line *line = &stores[e->aux / 64 % SIM_STORE_LINES];
    uint32_t words = sim_words_of(p, e);
    sim_blamed ready = now + sim_blame(sim_time_of(p->latency.ready[SIM_CONSUMER_PLAIN]), SIM_BUCKET_STORE);
    if (line->line == e->aux / 64 && line->ready > sim_end_of_cycle(now)) {
        words |= line->words; /* stores to one line that follow each other closely count as one, ready with the last of them */
        ready = ready > line->ready ? ready : line->ready;
    }
    *line = (sim_store_line){.line = e->aux / 64, .words = words, .ready = ready};
}

/* What was stored where the op reads must be there. */
static inline void sim_need_stored(const sim_store_line stores[SIM_STORE_LINES], const sim_op_price *p, const lrb_event *e,
                                   sim_blamed *at)
{
    const sim_store_line *line = &stores[e->aux / 64 % SIM_STORE_LINES];
    if (line->ready > *at && line->line == e->aux / 64 && line->words & sim_words_of(p, e))
        *at = line->ready;
}

#endif
