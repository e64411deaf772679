#include "sim/warm.h"

#include <stdbool.h>
#include <stdlib.h>

#include "lrbni/memory.h"
#include "sim/op_price.h"

enum { NOTHING, ACCESS, HINT };

struct sim_warmer {
    sim_contents contents;
    uint8_t *touch;   /* by the op field of an event: NOTHING, ACCESS or HINT */
    unsigned line_bits;
    bool prefetches;
};

base_status sim_contents_create(const sim_machine *machine, sim_contents *out, base_error *err)
{
    *out = (sim_contents){0};
    base_status status = sim_cache_create(machine->l1.size_bytes, machine->l1.ways, machine->l1.line_bytes, &out->l1, err);
    if (status == BASE_OK)
        status = sim_cache_create(machine->l2.size_bytes, machine->l2.ways, machine->l2.line_bytes, &out->l2, err);
    return status;
}

void sim_contents_destroy(sim_contents *c)
{
    sim_cache_destroy(&c->l1);
    sim_cache_destroy(&c->l2);
}

void sim_contents_assign(sim_contents *to, const sim_contents *from)
{
    sim_cache_assign(to->l1, from->l1);
    sim_cache_assign(to->l2, from->l2);
}

static bool find_touches(sim_warmer *w, const sim_machine *machine)
{
    sim_op_price *price = sim_op_prices(machine);
    w->touch = calloc((size_t)UINT16_MAX + 1, sizeof *w->touch);
    for (size_t op = 0; price && w->touch && op <= UINT16_MAX; op++) {
        const unsigned flags = price[op].flags;
        w->touch[op] = flags & (SIM_PRICE_READS | SIM_PRICE_STORE) ? ACCESS : flags & SIM_PRICE_HINT ? HINT : NOTHING;
    }
    free(price);
    return price && w->touch;
}

base_status sim_warmer_create(const sim_machine *machine, sim_warmer **out, base_error *err)
{
    sim_warmer *w = *out = calloc(1, sizeof *w);
    if (!w)
        return base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    base_status status = sim_contents_create(machine, &w->contents, err);
    if (status == BASE_OK) {
        w->line_bits = w->contents.l1->line_bits;
        w->prefetches = machine->memory.prefetches_per_core > 0;
        if (!find_touches(w, machine))
            status = base_fail(err, BASE_ERR_NOMEM, "core model", "out of memory");
    }
    if (status != BASE_OK)
        sim_warmer_destroy(out);
    return status;
}

void sim_warmer_destroy(sim_warmer **w)
{
    if (*w) {
        sim_contents_destroy(&(*w)->contents);
        free((*w)->touch);
    }
    free(*w);
    *w = NULL;
}

static void access_line(sim_warmer *w, uint64_t line, sim_lines *came)
{
    if (sim_cache_touch(w->contents.l1, line))
        return;
    came->l1++;
    came->l2 += !sim_cache_touch(w->contents.l2, line);
}

static void take_hint(sim_warmer *w, lrb_hint hint, uint64_t line, sim_lines *came)
{
    sim_contents *c = &w->contents;
    switch (hint) {
    case LRB_HINT_PREFETCH1:
        if (w->prefetches && !sim_cache_holds(c->l1, line))
            access_line(w, line, came);
        break;
    case LRB_HINT_PREFETCH2:
        if (w->prefetches && !sim_cache_holds(c->l2, line))
            came->l2 += !sim_cache_touch(c->l2, line);
        break;
    case LRB_HINT_EVICT1:
        sim_cache_evict(c->l1, line);
        break;
    case LRB_HINT_EVICT2:
        sim_cache_evict(c->l2, line);
        break;
    case LRB_HINT_NONE:
    case LRB_HINT_DELAY:
        break;
    }
}

sim_lines sim_warmer_events(sim_warmer *w, unsigned thread, const lrb_event *events, size_t count)
{
    const uint64_t scratch = (uint64_t)thread * LRB_SCRATCH_BYTES;
    sim_lines came = {0};
    for (const lrb_event *e = events; e < events + count; e++) {
        const uint64_t line = (e->aux + (e->aux >= LRB_SCRATCH_ADDRESS ? scratch : 0)) >> w->line_bits;
        if (e->mask == 0 && !(e->op & LRB_FORM_MEMORY))
            continue;
        if (w->touch[e->op] == ACCESS)
            access_line(w, line, &came);
        else if (w->touch[e->op] == HINT)
            take_hint(w, lrb_op_hint_of((lrb_op_id)(e->op & LRB_EVENT_ID)), line, &came);
    }
    return came;
}

void sim_warmer_fill(sim_warmer *w, const sim_contents *contents) { sim_contents_assign(&w->contents, contents); }

const sim_contents *sim_warmer_contents(const sim_warmer *w) { return &w->contents; }
